//! Winding numbers of the mesh and of the file, by exact crossings of a ray.

use super::parse::Field;
use crate::check::enclosure::{Surface, Winding, as_filed};
use crate::check::input::is_closed;
use crate::mesh::Mesh;
use glam::DVec3;
use std::collections::HashMap;

/// What a winding number says of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Outside,
    Inside,
    /// Either: the interval must hold the distance with both signs.
    Both,
}

/// The surface of the mesh, as it winds for sides, and as the file winds the same triangles.
pub(super) struct Sides(Option<[Winding; 2]>);

impl Sides {
    pub(super) fn of(mesh: &Mesh, field: &Field) -> Self {
        if !is_closed(mesh) || mesh.has_merged_walls {
            return Self(None);
        }
        let positions = mesh.positions.iter().map(|&p| field.place(p).to_array()).collect();
        let surface = Surface { positions, triangles: mesh.triangles.clone() };
        let faces = mesh.triangles.len();
        let turned: Vec<bool> =
            (0..faces).map(|face| mesh.turned.get(face) == Some(&true)).collect();
        let filed = as_filed(&surface, &turned, &vec![true; faces], &crowded(mesh));
        Self(filed.ok().map(|filed| [Winding::new(&surface), filed]))
    }

    /// Of a point off the surface. Components that the file winds in part against the rest have no
    /// winding of the file; they are alone, and the mesh's counts.
    pub(super) fn at(&self, p: DVec3) -> Side {
        let Some(windings) = &self.0 else { return Side::Both };
        match windings.each_ref().map(|winding| winding.around(p.to_array())) {
            [Ok(0), Ok(0)] => Side::Outside,
            [Ok(1), Ok(-1..=1)] => Side::Inside,
            _ => Side::Both,
        }
    }
}

/// Whether more than two faces share an edge of each face.
fn crowded(mesh: &Mesh) -> Vec<bool> {
    let ends = |[a, b, c]: [u32; 3]| [(a, b), (b, c), (c, a)].map(|(u, v)| (u.min(v), u.max(v)));
    let mut uses: HashMap<(u32, u32), u32> = HashMap::new();
    for edge in mesh.triangles.iter().flat_map(|&t| ends(t)) {
        *uses.entry(edge).or_default() += 1;
    }
    mesh.triangles.iter().map(|&t| ends(t).iter().any(|edge| uses[edge] > 2)).collect()
}
