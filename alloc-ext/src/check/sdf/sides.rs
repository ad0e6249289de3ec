//! Winding numbers of the mesh and of the file, by exact crossings of a ray.

use super::parse::Field;
use crate::check::enclosure::{Surface, Winding};
use crate::check::input::is_closed;
use crate::mesh::Mesh;
use glam::DVec3;

/// What a winding number says of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Outside,
    Inside,
    /// Either: the interval must hold the distance with both signs.
    Both,
}

/// The surfaces of the mesh, as it winds for sides, and of the file.
pub(super) struct Sides {
    mesh: Option<Winding>,
    file: Option<Winding>,
}

impl Sides {
    pub(super) fn of(mesh: &Mesh, field: &Field) -> Self {
        let winding = |positions: &[[f32; 3]], triangles: &[[u32; 3]]| {
            let positions = positions.iter().map(|&p| field.place(p).to_array()).collect();
            Winding::new(&Surface { positions, triangles: triangles.to_vec() })
        };
        let is_sided = is_closed(mesh) && !mesh.has_merged_walls;
        let of_mesh = is_sided.then(|| winding(&mesh.positions, &mesh.triangles));
        let filed = mesh.filed.as_ref().filter(|_| is_sided);
        let of_file = filed.map(|filed| winding(&filed.positions, &filed.triangles));
        Self { mesh: of_mesh, file: of_file }
    }

    /// Of a point off the surface.
    pub(super) fn at(&self, p: DVec3) -> Side {
        let around = |winding: &Winding| winding.around(p.to_array()).ok();
        let Some(winding) = &self.mesh else { return Side::Both };
        match (around(winding), self.file.as_ref().map(around)) {
            (Some(0), None | Some(Some(0))) => Side::Outside,
            (Some(1), None | Some(Some(1 | -1))) => Side::Inside,
            _ => Side::Both,
        }
    }
}
