//! How far wires are from the surface: what a hull hierarchy carries in its surface error.

use crate::bvh::{self, TreeOptions};
use crate::hausdorff::{Nearest, farthest};
use crate::mesh::Mesh;
use glam::DVec3;
use meshsweep_core::Budget;
use meshsweep_core::Bvh;
use meshsweep_core::ScratchEntry;

/// A distance, input units, that no point of a [wire](crate::mesh::Wire) is farther than from the
/// triangles with an area; 0 without wires, infinite without triangles.
///
/// The split tables hold triangles with an area only. So the hull hierarchy takes the wires for
/// points of the surface that were moved onto it by this distance at most.
///
/// Cost: a box tree of the mesh, and some dozen closest points for each wire.
#[must_use]
pub fn wires_off_surface(mesh: &Mesh) -> f64 {
    if mesh.wires.is_empty() {
        return 0.0;
    }
    if mesh.triangles.is_empty() {
        return f64::INFINITY;
    }
    let surface =
        Mesh { source: (0..mesh.triangles.len() as u32).collect(), ..mesh.without_wires() };
    let options = TreeOptions { segments: false, single: true, ..TreeOptions::default() };
    let surface = Mesh { rounding: 0.0, ..surface };
    let bytes = bvh::build(surface.as_input(), &options).0.to_bytes();
    let tree = Bvh::open(&bytes).expect("just built");
    let mut stack = vec![ScratchEntry::EMPTY; tree.header().stack_entries as usize];
    let wide = |p: [f32; 3]| DVec3::from(p.map(f64::from));
    let nearest = |point: DVec3| {
        // The query is rounded to f32: the distance to what was asked is part of the bound.
        let asked = point.as_vec3();
        let offset = (asked.as_dvec3() - point).length();
        let answer = tree.closest_point(asked.to_array(), Budget::EXACT, &mut stack).ok()?;
        let corners = answer.triangle.and_then(|triangle| surface.corners(triangle as usize));
        Some(Nearest {
            lower: f64::from(answer.distance.lower) - offset,
            upper: f64::from(answer.distance.upper) + offset,
            triangle: corners.map(|corners| corners.map(wide)),
        })
    };
    farthest(mesh.wire_corners().map(|corners| corners.map(wide)), 0.0, nearest).upper
}
