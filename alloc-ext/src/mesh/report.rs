//! The report of [`repair`](super::repair), with places.

use std::fmt;

use super::{LeftOut, MeshError, Polygons};
use crate::counted::Counted;

/// Most places of a list: enough to find the flaw, few enough to read.
pub(super) const PLACES_KEPT: usize = 5;

/// A place in the input file. Numbers count from 0; triangles after polygons are split.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Number of the triangle in the input, if the place is one.
    pub triangle: Option<u32>,
    /// Number of the vertex in the input, if the place is one.
    pub vertex: Option<u32>,
    /// The vertex, or the triangle's first corner, in the file's unit and frame, rounded to `f32`.
    pub at: [f32; 3],
}

/// A count with the first few places.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Finding {
    /// Number of places.
    pub count: usize,
    /// The first five at most.
    pub places: Vec<Place>,
}

impl Finding {
    pub(super) fn triangle(&mut self, triangle: u32, at: [f32; 3]) {
        self.push(Place { triangle: Some(triangle), vertex: None, at });
    }

    pub(super) fn vertex(&mut self, vertex: u32, at: [f32; 3]) {
        self.push(Place { triangle: None, vertex: Some(vertex), at });
    }

    fn push(&mut self, place: Place) {
        self.count += 1;
        if self.places.len() < PLACES_KEPT {
            self.places.push(place);
        }
    }
}

/// A kind of finding, and how to tell it.
#[derive(Clone, Copy, Debug)]
pub struct Found<'a> {
    /// Its name in JSON.
    pub key: &'static str,
    /// What was found, as a noun for one.
    pub noun: &'static str,
    /// What was done with it.
    pub what: &'static str,
    /// Count and places.
    pub finding: &'a Finding,
    /// Whether the mesh is no longer the input, triangle for triangle.
    pub is_change: bool,
}

/// Findings and changes of [`repair`](super::repair). `Display` prints a line for each kind.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RepairReport {
    /// Vertices in the input.
    pub vertices_read: usize,
    /// Triangles in the input.
    pub triangles_read: usize,
    /// Faces of the input with more than three corners, which were split into triangles.
    pub polygons: Polygons,
    /// Parts of the file that were not read as triangles.
    pub left_out: LeftOut,
    /// Vertices in the result.
    pub vertices_kept: usize,
    /// Triangles in the result.
    pub triangles_kept: usize,
    /// As [`Mesh::rounding`](super::Mesh::rounding).
    pub rounding: f64,
    /// Connected components of the result, by shared edges.
    pub component_count: usize,
    /// Vertices merged into an earlier one at the same position (after rounding to `f32`; −0.0
    /// equals 0.0).
    pub welded: Finding,
    /// Triangles dropped because two of their corners are the same vertex and edges of others cover
    /// their points. The mesh stays closed.
    pub repeated_corner: Finding,
    /// Zero-area triangles (three distinct collinear corners) removed by an edge flip with the
    /// neighbour across their longest edge. The surface is the same point set and stays
    /// closed; the triangle count too.
    pub flipped_caps: Finding,
    /// Zero-area triangles dropped because no neighbour could take them up and edges of others
    /// cover them. This can leave a slit, but no point is lost.
    pub zero_area: Finding,
    /// Triangles without area, or with a repeated corner, kept as [`Wire`](super::Wire)s: as
    /// segments and points that no other triangle covers.
    pub wires: Finding,
    /// Further copies of a triangle, same three vertices, same winding. The first stays.
    pub duplicate: Finding,
    /// Further copies of a triangle, opposite winding. The first stays, so that no surface is
    /// lost. Box trees for segments, culling or winding numbers store the others too.
    pub opposite_duplicate: Finding,
    /// Vertices that no triangle uses, before or after the above.
    pub unreferenced: Finding,
    /// Vertex copies added: one for each fan beyond the first at a vertex.
    pub split_vertices: Finding,
    /// Triangles wound anew to agree with the majority of their connected component.
    pub rewound: Finding,
    /// Closed outermost components that were inside out and were turned, together with all
    /// components inside them. One place each.
    pub turned_components: Finding,
    /// Closed components that lie inside another and face inwards: cavities, left as they are.
    pub cavities: Finding,
    /// Closed components that face inwards, and may be cavities or inside out: they cross or touch
    /// others or themselves, or lie in the box of an open one. They keep the file's winding.
    pub doubtful: Finding,
    /// One-sided components; left as they are, refused for a hull. The place is a triangle at which
    /// the winding fails.
    pub non_orientable: Finding,
    /// The corners of the first zero-area triangles that were taken out, for
    /// [`explain`](Self::explain).
    pub(super) dropped: Vec<(u32, [[f32; 3]; 3])>,
}

impl RepairReport {
    /// All findings.
    #[must_use]
    pub fn findings(&self) -> [Found<'_>; 14] {
        let change = |key, noun, what, finding| Found { key, noun, what, finding, is_change: true };
        let note = |key, noun, what, finding| Found { key, noun, what, finding, is_change: false };
        [
            note("welded", "vertex", "welded to an equal one", &self.welded),
            change(
                "repeated_corner",
                "triangle",
                "with a repeated corner dropped, covered by others",
                &self.repeated_corner,
            ),
            change("flipped_caps", "flat cap", "removed by an edge flip", &self.flipped_caps),
            change(
                "zero_area",
                "zero-area triangle",
                "dropped, covered by others",
                &self.zero_area,
            ),
            change("wires", "triangle", "without area kept as a segment or a point", &self.wires),
            change(
                "duplicate",
                "duplicate triangle",
                "kept for winding numbers only",
                &self.duplicate,
            ),
            change(
                "opposite_duplicate",
                "oppositely wound duplicate",
                "kept for facings and winding numbers only",
                &self.opposite_duplicate,
            ),
            note("unreferenced", "unreferenced vertex", "dropped", &self.unreferenced),
            change("split_vertices", "copy", "made of non-manifold vertices", &self.split_vertices),
            change(
                "rewound",
                "triangle",
                "rewound for sides only, to agree with the component around",
                &self.rewound,
            ),
            change(
                "turned_components",
                "inside-out component",
                "turned for sides only",
                &self.turned_components,
            ),
            note("cavities", "cavity", "found and kept", &self.cavities),
            note(
                "doubtful",
                "component",
                "facing inwards kept so: it crosses or touches others or itself, or lies in the \
                 box of an open one, so that it may be a cavity or inside out; winding numbers \
                 decide the sides of a cavity (--for closest,winding); reverse the triangles of a \
                 part that is inside out",
                &self.doubtful,
            ),
            change("non_orientable", "one-sided component", "found", &self.non_orientable),
        ]
    }

    /// True if the result is the input, triangle for triangle: nothing left out, dropped, split,
    /// flipped or rewound, and no polygon that crosses itself. Welding, unreferenced vertices and
    /// rounding do not count.
    #[must_use]
    pub fn is_clean(&self) -> bool {
        let nothing_left_out = self.left_out == LeftOut::default();
        nothing_left_out
            && self.polygons.doubts().next().is_none()
            && self.findings().iter().all(|found| found.finding.count == 0 || !found.is_change)
    }

    /// Sentences about what is doubtful or was left out of the file: faces that may be no polygons,
    /// and [other parts](LeftOut). Each names the first if it has a place.
    pub fn doubts(&self) -> impl Iterator<Item = String> {
        self.polygons.doubts().chain(self.left_out.sentences())
    }

    /// Says how far vertices moved when they were rounded to `f32`, if any did.
    #[must_use]
    pub fn rounding_note(&self) -> Option<String> {
        let moved = self.rounding;
        (moved > 0.0).then(|| format!("rounding to f32 moved vertices by up to {moved:e}"))
    }

    /// Adds to a [`MeshError::Open`] the zero-area triangle whose removal is the likely cause: one
    /// of the first dropped whose corner lies on one of the edges that the error lists. Any
    /// other error is returned as it is.
    #[must_use]
    pub fn explain(&self, mut error: MeshError) -> MeshError {
        if let MeshError::Open { places, dropped_triangle: cause @ None, .. } = &mut error {
            let on_hole = |corners: &[[f32; 3]; 3]| {
                places.iter().any(|e| corners.contains(&e.from) && corners.contains(&e.to))
            };
            *cause = self.dropped.iter().find(|(_, corners)| on_hole(corners)).map(|&(t, _)| t);
        }
        error
    }
}

impl fmt::Display for RepairReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{}, {} read; {}, {} kept in {}",
            Counted(self.vertices_read, "vertex"),
            Counted(self.triangles_read, "triangle"),
            Counted(self.vertices_kept, "vertex"),
            Counted(self.triangles_kept, "triangle"),
            Counted(self.component_count, "connected component")
        )?;
        let Polygons { split, by_ears, .. } = self.polygons;
        if split > 0 {
            write!(
                f,
                "\n  {} split: numbers of triangles count those that they were split into, in file \
                 order",
                Counted(split, "polygon")
            )?;
        }
        if by_ears > 0 {
            write!(f, "\n  {} split by ears", Counted(by_ears, "concave polygon"))?;
        }
        for said in self.doubts() {
            write!(f, "\n  {said}")?;
        }
        if let Some(note) = self.rounding_note() {
            write!(f, "\n  {note}")?;
        }
        for Found { noun, what, finding, .. } in self.findings() {
            if finding.count > 0 {
                write!(f, "\n  {} {what}", Counted(finding.count, noun))?;
                // Every vertex of an STL file is welded: there the places say nothing.
                if std::ptr::eq(finding, &self.welded) {
                    continue;
                }
                write!(f, ":")?;
                for place in &finding.places {
                    match (place.triangle, place.vertex) {
                        (Some(triangle), _) => write!(f, " triangle {triangle}")?,
                        (_, Some(vertex)) => write!(f, " vertex {vertex}")?,
                        _ => {}
                    }
                    write!(f, " {:?}", place.at)?;
                }
                if finding.count > finding.places.len() {
                    write!(f, " …")?;
                }
            }
        }
        Ok(())
    }
}
