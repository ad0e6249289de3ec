//! A hull hierarchy as plain vectors. The builder fills them, a cut shortens them, and they are
//! written as sections.

use glam::Vec3;
use meshsweep_core::Hull;
use meshsweep_core::internal::geom::Aabb;
use meshsweep_core::internal::hull::format::layout::{BASE_GROUP, START_GROUP};
use meshsweep_core::internal::hull::format::{SplitIdx, TriIdx};
use meshsweep_core::internal::num::{Radius8, Radius16};
use meshsweep_core::{HullLevel, VertIdx};

use crate::surface::Grid;

/// A vertex split.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SplitRecord {
    /// The vertex that is replaced.
    pub vertex: u32,
    /// Where its ring begins in [`Tables::rings`].
    pub ring_start: u32,
    /// Position of the right wing in the ring.
    pub right: u8,
    /// Whether the triangles at the right and at the left wing are children of the coarse
    /// triangle before the wing.
    pub before: [bool; 2],
    /// No point of the fine triangles is farther than this from `vertex`.
    pub star_radius: Radius8,
    /// The largest finite radius of the coarse triangles.
    pub error: Radius8,
}

/// A hull hierarchy as a blob holds it.
#[derive(Clone, Debug, PartialEq)]
pub struct Tables {
    /// Input coordinate = local coordinate × 2^this.
    pub scale_exponent: i32,
    /// Coordinate format.
    pub grid: Grid,
    /// Bound of the distance between input and stored surface.
    pub surface_error: f32,
    /// Coordinates, local frame.
    pub vertices: Vec<Vec3>,
    /// Vertices of the base hull.
    pub base_vertices: u32,
    /// Triangles of the base hull.
    pub base: Vec<[u32; 3]>,
    /// Swept triangles, each around sixteen base triangles.
    pub groups: Vec<([u32; 3], Radius16)>,
    /// Splits, coarse to fine.
    pub splits: Vec<SplitRecord>,
    /// Rings of the splits.
    pub rings: Vec<u32>,
    /// Radii of base triangles, then of each split's fine triangles.
    pub radii: Vec<Radius8>,
    /// The split of each vertex.
    pub splits_with: Vec<Option<u32>>,
    /// Triangles of the surface before those of each eighth split.
    pub source_starts: Vec<u32>,
    /// Numbers in the input file of the triangles of the surface.
    pub source: Vec<u32>,
    /// Triangles of the input file.
    pub input_triangles: u32,
    /// Box of the surface.
    pub surface_box: Aabb,
    /// Levels, coarse to fine.
    pub levels: Vec<HullLevel>,
    /// Queue entries that a sweep may need.
    pub queue_capacity: u32,
    /// Whether finer levels were cut off.
    pub is_cut: bool,
    /// Whether every level encloses the surface.
    pub encloses: bool,
}

impl Tables {
    /// Box of all vertices.
    pub fn hull_box(&self) -> Aabb {
        let zero = Aabb { min: Vec3::ZERO, max: Vec3::ZERO };
        let Some(&first) = self.vertices.first() else { return zero };
        self.vertices.iter().fold(Aabb { min: first, max: first }, |b, &v| Aabb {
            min: b.min.min(v),
            max: b.max.max(v),
        })
    }

    /// Ring of a split.
    pub fn ring(&self, split: usize) -> &[u32] {
        let start = self.splits[split].ring_start as usize;
        let end =
            self.splits.get(split + 1).map_or(self.rings.len(), |next| next.ring_start as usize);
        &self.rings[start..end]
    }

    /// Longest chain of splits of which each needs the one before it.
    pub fn dependency_depth(&self) -> u32 {
        let mut depth = vec![0u32; self.splits.len()];
        for (index, split) in self.splits.iter().enumerate() {
            let needed = self.ring(index).iter().chain([&split.vertex]);
            let deepest = needed
                .filter_map(|&v| v.checked_sub(self.base_vertices))
                .map(|past| depth[past as usize / 2])
                .max()
                .unwrap_or(0);
            depth[index] = deepest + 1;
        }
        depth.into_iter().max().unwrap_or(0)
    }

    /// The tables of an opened blob. `None` cannot happen for a model that was opened.
    pub fn from_hull(hull: &Hull<'_>) -> Option<Tables> {
        let h = hull.header();
        let mut rings = Vec::with_capacity(h.rings as usize);
        let mut splits = Vec::with_capacity(h.splits as usize);
        for index in 0..h.splits {
            let split = hull.split(SplitIdx(index))?;
            let right = u8::try_from(split.right).ok()?;
            let before = [split.right_parent != split.right, split.left_parent != 0];
            let star_radius = Radius8::round_up(f64::from(split.star_radius));
            let error = Radius8::round_up(f64::from(split.error));
            splits.push(SplitRecord {
                vertex: split.vertex.0,
                ring_start: rings.len() as u32,
                right,
                before,
                star_radius,
                error,
            });
            for i in 0..split.ring_len() {
                rings.push(split.ring(i)?.0);
            }
        }
        let radii = h.base_triangles as usize + h.rings as usize + 2 * h.splits as usize;
        Some(Tables {
            scale_exponent: h.scale_exponent,
            grid: Grid {
                format: h.vertex_format,
                exponent: h.grid_exponent,
                origin: h.grid_origin,
            },
            surface_error: h.surface_error,
            vertices: (0..h.vertices).map(|v| hull.position(VertIdx(v))).collect::<Option<_>>()?,
            base_vertices: h.base_vertices,
            base: (0..h.base_triangles)
                .map(|t| hull.base_triangle(t).map(|c| c.map(|v| v.0)))
                .collect::<Option<_>>()?,
            groups: (0..h.base_triangles.div_ceil(BASE_GROUP))
                .map(|g| {
                    let (corners, radius) = hull.base_group(g)?;
                    Some((corners.map(|v| v.0), Radius16::round_up(f64::from(radius))))
                })
                .collect::<Option<_>>()?,
            splits,
            rings,
            radii: (0..radii as u32)
                .map(|t| hull.radius(t).map(|r| Radius8::round_up(f64::from(r))))
                .collect::<Option<_>>()?,
            splits_with: (0..h.vertices).map(|v| hull.split_of(VertIdx(v)).map(|s| s.0)).collect(),
            source_starts: if hull.is_cut() {
                Vec::new()
            } else {
                (0..h.splits.div_ceil(START_GROUP))
                    .map(|index| hull.source_start(index))
                    .collect::<Option<_>>()?
            },
            source: (0..h.surface_triangles)
                .map(|t| hull.source(TriIdx(t)))
                .collect::<Option<_>>()?,
            input_triangles: h.input_triangles,
            surface_box: Aabb::of(h.surface_box),
            levels: hull.levels().collect(),
            queue_capacity: h.queue_capacity,
            is_cut: hull.is_cut(),
            encloses: hull.encloses(),
        })
    }
}
