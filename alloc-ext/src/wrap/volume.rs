//! The volume that a mesh bounds, which the void of its hull is measured against; or why there is
//! none.

use super::boxes::{Bounds, BoxTree};
use super::connected::connected;
use super::predicates::{Face, are_apart, is_degenerate};
use crate::counted::Counted;
use crate::mesh::{self, EdgePlace, Enclosure, Mesh, MeshError, Volume, require_closed_manifold};
use glam::DVec3;
use std::fmt;

/// Why a mesh has no volume that the void of a hull can be measured against: the first of its
/// defects in the order of [`require_closed_manifold`], with one place where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoVolume {
    /// Edges have one triangle only.
    Open {
        /// How many.
        edges: usize,
        /// One of them.
        at: EdgePlace,
    },
    /// Edges have more than two triangles, as where a wall divides the inside.
    NonManifold {
        /// How many.
        edges: usize,
        /// Most triangles at an edge.
        most: usize,
        /// One of them.
        at: EdgePlace,
    },
    /// Several fans meet in a vertex; [`repair`](crate::mesh::repair) splits it.
    Pinched {
        /// How many vertices.
        vertices: usize,
        /// One of them.
        at: [f32; 3],
    },
    /// Parts have one side only, as a Klein bottle, which is closed, and a Möbius strip.
    OneSided {
        /// How many.
        parts: usize,
        /// Where sides change.
        at: EdgePlace,
    },
    /// Neighbours are wound against each other; [`repair`](crate::mesh::repair) turns them.
    MixedWinding {
        /// How many edges have such neighbours.
        edges: usize,
        /// One of them.
        at: EdgePlace,
    },
    /// Outermost parts face inwards; [`repair`](crate::mesh::repair) turns them.
    InsideOut {
        /// How many.
        parts: usize,
        /// A corner of one.
        at: [f32; 3],
    },
    /// A closed part whose volume cannot be told from 0.
    Flat {
        /// Its first triangle, as the input counts.
        triangle: u32,
        /// A corner of that.
        at: [f32; 3],
    },
    /// Parts overlap or lie in each other as solid in solid, or one crosses itself: then a volume
    /// counts what is there more than once.
    Overlapping,
    /// Rounding may be all that there is: cavities leave next to nothing.
    Indistinct,
    /// No triangle has an area.
    NoArea,
    /// An array breaks what [`Mesh`] promises.
    Invalid,
}

impl NoVolume {
    /// What was found first.
    fn of(error: &MeshError) -> Self {
        let named = match error {
            MeshError::Open { edge_count: edges, places, .. } => {
                places.first().map(|&at| NoVolume::Open { edges: *edges, at })
            }
            MeshError::NonManifoldEdges { count: edges, most, places } => {
                places.first().map(|&at| NoVolume::NonManifold { edges: *edges, most: *most, at })
            }
            MeshError::NonManifoldVertices { count: vertices, places } => {
                places.first().map(|&at| NoVolume::Pinched { vertices: *vertices, at })
            }
            MeshError::NonOrientable { part_count: parts, places } => {
                places.first().map(|&at| NoVolume::OneSided { parts: *parts, at })
            }
            MeshError::InconsistentWinding { edge_count: edges, places } => {
                places.first().map(|&at| NoVolume::MixedWinding { edges: *edges, at })
            }
            MeshError::InsideOut { part_count: parts, places } => {
                places.first().map(|&at| NoVolume::InsideOut { parts: *parts, at })
            }
            MeshError::ZeroVolume { triangle, at, .. } => {
                Some(NoVolume::Flat { triangle: *triangle, at: *at })
            }
            MeshError::NoArea { .. } => Some(NoVolume::NoArea),
            _ => None,
        };
        named.unwrap_or(NoVolume::Invalid)
    }
}

impl fmt::Display for NoVolume {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            NoVolume::Open { edges, at } => {
                write!(
                    f,
                    "the mesh is not closed: {}, {}",
                    Counted(edges, "boundary edge"),
                    Edge(at)
                )
            }
            NoVolume::NoArea => f.write_str("no triangle of the mesh has an area"),
            NoVolume::NonManifold { edges, most, at } => write!(
                f,
                "the mesh is not manifold: {} with up to {most} triangles, {}",
                Counted(edges, "edge"),
                Edge(at)
            ),
            NoVolume::Pinched { vertices, at } => {
                write!(
                    f,
                    "the mesh is not manifold: several fans meet in {}, {}",
                    Counted(vertices, "vertex"),
                    Point(at)
                )
            }
            NoVolume::OneSided { parts, at } => {
                write!(
                    f,
                    "the mesh has no outside: {}, {}",
                    Counted(parts, "one-sided part"),
                    Edge(at)
                )
            }
            NoVolume::MixedWinding { edges, at } => write!(
                f,
                "the mesh has no outside: triangles are wound against each other at {}, {}",
                Counted(edges, "edge"),
                Edge(at)
            ),
            NoVolume::InsideOut { parts, at } => {
                write!(
                    f,
                    "the mesh is inside out: {}, {}",
                    Counted(parts, "outermost part"),
                    Point(at)
                )
            }
            NoVolume::Flat { triangle, at } => {
                write!(
                    f,
                    "a part of the mesh, that of triangle {triangle}, has a volume that cannot be told from 0, {}",
                    Point(at)
                )
            }
            NoVolume::Overlapping => f.write_str(
                "the mesh overlaps itself, so that its volume counts places more than once",
            ),
            NoVolume::Indistinct => f.write_str("the mesh's volume cannot be told from 0"),
            NoVolume::Invalid => f.write_str("the mesh is not a valid one"),
        }
    }
}

/// One of several edges, or the only one.
struct Edge(EdgePlace);

impl fmt::Display for Edge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let EdgePlace { triangle, from, to } = self.0;
        write!(f, "as at triangle {triangle} from {from:?} to {to:?}")
    }
}

/// One of several places, or the only one.
struct Point([f32; 3]);

impl fmt::Display for Point {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "as at {:?}", self.0)
    }
}

/// A mesh that bounds a volume.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Solid {
    /// In the mesh's unit, above 0. What overlaps counts more than once.
    pub volume: f64,
    /// The same less what rounding may have added.
    least: f64,
}

impl Solid {
    pub fn of(mesh: &Mesh) -> Result<Self, NoVolume> {
        require_closed_manifold(mesh).map_err(|error| NoVolume::of(&error))?;
        let parts = parts(mesh);
        let (mut volume, mut bound) = (0.0, 0.0);
        let mut faces_out = Vec::new();
        for part in &parts {
            volume += signed(part);
            let of_part = mesh::volume(part);
            // As many roundings more as there are parts to add.
            bound +=
                of_part.bound + (parts.len() as f64 + 2.0) * f64::EPSILON * of_part.value.abs();
            faces_out.push(of_part.value > 0.0);
        }
        if volume <= -bound || winds_more_than_once(mesh, parts, &faces_out) {
            return Err(NoVolume::Overlapping);
        }
        if volume <= bound {
            return Err(NoVolume::Indistinct);
        }
        Ok(Self { volume, least: volume - 2.0 * bound })
    }

    /// Whether there is certainly more than a closed surface holds that encloses the mesh: then it
    /// overlaps. The surface by its triangles.
    pub fn is_more_than(&self, hull: &[[[f32; 3]; 3]]) -> bool {
        let Volume { value, bound } = mesh::volume(hull);
        value + bound < self.least
    }

    /// Volume of a hull beyond the mesh's, as a part of that.
    pub fn void(&self, hull: &Mesh, volume: f64) -> Result<f64, NoVolume> {
        let triangles: Vec<[[f32; 3]; 3]> =
            (0..hull.triangles.len()).filter_map(|t| hull.corners(t)).collect();
        if self.is_more_than(&triangles) {
            return Err(NoVolume::Overlapping);
        }
        // There is some, if rounding leaves less.
        let rounding = (self.volume - self.least) / self.volume;
        Ok((volume / self.volume - 1.0).max(rounding))
    }
}

/// The triangles of each connected part, by their corners.
fn parts(mesh: &Mesh) -> Vec<Vec<[[f32; 3]; 3]>> {
    let least = connected(mesh.positions.len(), &mesh.triangles);
    let mut number = vec![usize::MAX; mesh.positions.len()];
    let mut parts: Vec<Vec<[[f32; 3]; 3]>> = Vec::new();
    for triangle in &mesh.triangles {
        let part = &mut number[least[triangle[0] as usize] as usize];
        if *part == usize::MAX {
            *part = parts.len();
            parts.push(Vec::new());
        }
        parts[*part].push(triangle.map(|v| mesh.positions[v as usize]));
    }
    parts
}

/// Signed volume of a closed part.
fn signed(part: &[[[f32; 3]; 3]]) -> f64 {
    let wide = |p: [f32; 3]| DVec3::from(p.map(f64::from));
    // Around a vertex, so that nothing cancels far from the origin.
    let origin = part.first().map_or(DVec3::ZERO, |&[a, ..]| wide(a));
    let six = part.iter().map(|triangle| {
        let [a, b, c] = triangle.map(|p| wide(p) - origin);
        a.dot(b.cross(c))
    });
    six.sum::<f64>() / 6.0
}

/// Whether parts that do not meet lie in each other so that the mesh winds around a place other
/// than never or once: solids in solids, cavities in cavities. Where parts meet: false.
fn winds_more_than_once(mesh: &Mesh, parts: Vec<Vec<[[f32; 3]; 3]>>, faces_out: &[bool]) -> bool {
    if parts.len() < 2 {
        return false;
    }
    let parts: Vec<Enclosure> = parts.into_iter().map(Enclosure::new).collect();
    let boxes: Vec<Bounds> = parts.iter().map(Bounds::around).collect();
    let (tree, order) = BoxTree::new(&boxes);
    let is_wrong = |i: usize| {
        let p = parts[i].triangles[0][0];
        let at = Bounds::of(&[DVec3::from(p.map(f64::from))]);
        let mut around = 0;
        tree.visit(
            |of| of.meets(&at),
            |item| {
                let j = order[item] as usize;
                if j != i && parts[j].holds(p) {
                    around += if faces_out[j] { 1 } else { -1 };
                }
                true
            },
        );
        around != i32::from(!faces_out[i])
    };
    if !(0..parts.len()).any(is_wrong) {
        return false;
    }
    // What touches may be counted as in each other and is not.
    let positions: Vec<DVec3> =
        mesh.positions.iter().map(|p| DVec3::from(p.map(f64::from))).collect();
    !crosses_itself(&positions, &mesh.triangles)
}

/// Whether triangles with area have more points in common than the corners and edges that they
/// share: the surface crosses itself, or touches itself. Exact. Cost: that of a query of a tree of
/// boxes for each triangle.
pub(super) fn crosses_itself(positions: &[DVec3], triangles: &[[u32; 3]]) -> bool {
    let face = |ids: &[u32; 3]| Face { ids: *ids, at: ids.map(|v| positions[v as usize]) };
    let faces: Vec<Face> =
        triangles.iter().map(face).filter(|face| !is_degenerate(&face.at)).collect();
    let boxes: Vec<Bounds> = faces.iter().map(|face| Bounds::of(&face.at)).collect();
    let (tree, order) = BoxTree::new(&boxes);
    let crosses = |i: usize| {
        let mut clean = true;
        tree.visit(
            |of| of.meets(&boxes[i]),
            |item| {
                let j = order[item] as usize;
                clean &= j <= i || !boxes[j].meets(&boxes[i]) || are_apart(&faces[i], &faces[j]);
                clean
            },
        );
        !clean
    };
    (0..faces.len()).any(crosses)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A corner of a cube, counter-clockwise seen from outside.
    const CORNER: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

    fn volume(mesh: &Mesh) -> Result<f64, NoVolume> {
        Solid::of(mesh).map(|solid| solid.volume)
    }

    fn tetrahedron(size: f32, at: f32) -> Vec<[f32; 3]> {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0f32]];
        corners.map(|p| p.map(|x| x * size + at)).to_vec()
    }

    fn joined(parts: &[(Vec<[f32; 3]>, bool)]) -> Mesh {
        let (mut positions, mut triangles) = (Vec::new(), Vec::new());
        for (corners, inward) in parts {
            let first = positions.len() as u32;
            positions.extend(corners);
            let turned = |[a, b, c]: [u32; 3]| if *inward { [a, c, b] } else { [a, b, c] };
            triangles.extend(CORNER.map(|t| turned(t).map(|v| v + first)));
        }
        Mesh::new(positions, triangles)
    }

    #[test]
    fn solids_have_a_volume_and_cavities_take_from_it() {
        let solid = joined(&[(tetrahedron(6.0, 1e6), false)]);
        assert_eq!(volume(&solid), Ok(36.0));
        let hollow = joined(&[(tetrahedron(6.0, 0.0), false), (tetrahedron(3.0, 0.5), true)]);
        assert_eq!(volume(&hollow), Ok(36.0 - 4.5));
    }

    #[test]
    fn the_reason_is_the_mesh_s_own_defect() {
        let of = |positions: Vec<[f32; 3]>, triangles: &[[u32; 3]]| {
            volume(&Mesh::new(positions, triangles.to_vec())).unwrap_err()
        };
        let unit = || tetrahedron(1.0, 0.0);
        let said = |why: NoVolume, words: &str| {
            let text = why.to_string();
            assert!(text.contains(words), "{text}");
            why
        };
        let open = said(of(unit(), &CORNER[..3]), "not closed: 3 boundary edges, as at triangle");
        assert!(matches!(open, NoVolume::Open { edges: 3, .. }));
        let wall = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3], [0, 1, 4], [1, 2, 4], [2, 0, 4]];
        let five = [unit(), vec![[0.0, 0.0, -1.0]]].concat();
        let crowded = said(of(five, &wall), "not manifold: 3 edges with up to 3 triangles");
        assert!(matches!(crowded, NoVolume::NonManifold { edges: 3, most: 3, .. }));
        let mixed = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 2, 3]];
        let mixed = said(of(unit(), &mixed), "against each other at 3 edges");
        assert!(matches!(mixed, NoVolume::MixedWinding { edges: 3, .. }));
        let inverted = joined(&[(unit(), true)]);
        let inverted = said(
            volume(&inverted).unwrap_err(),
            "inside out: 1 outermost part, as at [0.0, 0.0, 0.0]",
        );
        assert_eq!(inverted, NoVolume::InsideOut { parts: 1, at: [0.0; 3] });
        let flat = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0f32]];
        let flat = said(of(flat, &CORNER), "has a volume that cannot be told from 0");
        assert_eq!(flat, NoVolume::Flat { triangle: 0, at: [0.0; 3] });
        let two = [unit(), unit()[1..].iter().map(|p| p.map(|x| -x)).collect()].concat();
        let tips = [
            [0, 2, 1],
            [0, 1, 3],
            [1, 2, 3],
            [2, 0, 3],
            [0, 4, 5],
            [0, 6, 4],
            [4, 6, 5],
            [5, 6, 0],
        ];
        let pinched = said(of(two, &tips), "several fans meet in 1 vertex, as at [0.0, 0.0, 0.0]");
        assert_eq!(pinched, NoVolume::Pinched { vertices: 1, at: [0.0; 3] });
        assert_eq!(said(of(unit(), &[[0, 1, 9]]), "not a valid one"), NoVolume::Invalid);
    }

    #[test]
    fn a_strip_that_ends_where_its_other_side_begins_has_no_outside() {
        // Closed: the real projective plane of six vertices. Where they are does not matter.
        let six = (0..6u8).map(f32::from).map(|k| [k, k * k, k * k * k]).collect();
        let faces = [
            [0, 1, 2],
            [0, 2, 3],
            [0, 3, 4],
            [0, 4, 5],
            [0, 5, 1],
            [1, 2, 4],
            [2, 3, 5],
            [3, 4, 1],
            [4, 5, 2],
            [5, 1, 3],
        ];
        let why = volume(&Mesh::new(six, faces.to_vec())).unwrap_err();
        assert!(matches!(why, NoVolume::OneSided { parts: 1, .. }), "{why:?}");
        assert!(why.to_string().contains("no outside: 1 one-sided part, as at triangle"), "{why}");
    }

    #[test]
    fn cavities_that_take_away_more_than_there_is_overlap() {
        let cavity = |at: f32| (tetrahedron(9.0, at), true);
        let hollow = joined(&[(tetrahedron(10.0, 0.0), false), cavity(0.1), cavity(0.2)]);
        assert_eq!(volume(&hollow), Err(NoVolume::Overlapping));
    }

    #[test]
    fn solids_in_solids_and_cavities_in_cavities_overlap_and_solids_in_cavities_do_not() {
        let of = |parts: &[(f32, f32, bool)]| {
            volume(&joined(
                &parts
                    .iter()
                    .map(|&(size, at, inward)| (tetrahedron(size, at), inward))
                    .collect::<Vec<_>>(),
            ))
        };
        let solid = (20.0, 0.0, false);
        assert_eq!(of(&[solid, (2.0, 1.0, false)]), Err(NoVolume::Overlapping));
        assert_eq!(of(&[solid, (8.0, 1.0, true), (2.0, 2.0, true)]), Err(NoVolume::Overlapping));
        let full = 20f64.powi(3) / 6.0;
        let hollow = of(&[solid, (8.0, 1.0, true), (2.0, 2.0, false)]).unwrap();
        assert!((hollow - (full - 512.0 / 6.0 + 8.0 / 6.0)).abs() < 1e-9, "{hollow}");
        // Hidden from all sums: a solid in the solid, and a cavity with more volume.
        assert_eq!(of(&[solid, (8.0, 0.1, true), (1.0, 4.0, false)]), Err(NoVolume::Overlapping));
        // Touching, so that either may count as in the other.
        let twin = of(&[(2.0, 0.0, false), (2.0, 0.0, false)]);
        assert_eq!(twin, Ok(16.0 / 6.0));
    }

    #[test]
    fn small_parts_far_apart_have_their_volume() {
        let far = joined(&[(tetrahedron(1.0, 0.0), false), (tetrahedron(1.0, 131_072.0), false)]);
        assert_eq!(volume(&far), Ok(1.0 / 3.0));
    }

    #[test]
    fn a_mesh_that_is_more_than_its_hull_overlaps() {
        // Two halves over each other in a hull that is a tenth larger than one.
        let twice = joined(&[(tetrahedron(1.0, 0.0), false), (tetrahedron(1.0, 0.01), false)]);
        let hull = joined(&[(tetrahedron(1.1, -0.01), false)]);
        let solid = Solid::of(&twice).unwrap();
        assert_eq!(solid.void(&hull, 1.331 / 6.0), Err(NoVolume::Overlapping));
        // A hull of the same volume proves nothing, whatever rounding says.
        let once = joined(&[(tetrahedron(1.1, -0.01), false)]);
        let volume = Solid::of(&once).unwrap().volume;
        let void = Solid::of(&once).unwrap().void(&hull, volume * (1.0 - 1e-12)).unwrap();
        assert!(void > 0.0 && void < 1e-9, "{void}");
    }

    #[test]
    fn crossing_and_touching_are_found_and_neighbours_are_not() {
        let crosses = |parts: &[(Vec<[f32; 3]>, bool)]| {
            let mesh = joined(parts);
            let positions: Vec<DVec3> =
                mesh.positions.iter().map(|p| DVec3::from(p.map(f64::from))).collect();
            crosses_itself(&positions, &mesh.triangles)
        };
        let one = || (tetrahedron(1.0, 0.0), false);
        assert!(!crosses(&[one()]));
        assert!(!crosses(&[one(), (tetrahedron(1.0, 2.0), false)]));
        assert!(!crosses(&[one(), (tetrahedron(0.1, 0.05), true)]), "a cavity");
        assert!(crosses(&[one(), (tetrahedron(1.0, 0.01), false)]));
        let touching = tetrahedron(1.0, 0.0).iter().map(|p| p.map(|x| -x)).collect();
        assert!(crosses(&[one(), (touching, true)]), "one corner for two");
    }
}
