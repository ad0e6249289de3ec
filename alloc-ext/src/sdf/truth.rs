//! The distances that the field must contain, and the sides of points.
//!
//! A side is told by the nearest triangles, if the surface has winding number 0 in front of each
//! and 1 behind it ([`Fronts`](crate::surface::Fronts)). If a point is in front of the plane of
//! every triangle that may be nearest, it is outside: a segment from it to a place inside of one of
//! them, next to its nearest point, meets the surface first at one of them, from its front. Behind
//! all of them it is inside. Otherwise the winding number is counted along a ray, exactly. It
//! is the same all over a box that the surface does not meet.

use super::domain::Domain;
use super::facet::Facet;
use super::region::{Facets, MARGIN, Near};
use crate::bvh::FileSides;
use crate::geom::FaceTree;
use crate::mesh::Mesh;
use glam::DVec3;
use meshsweep_core::SdfKind;

/// Side of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Outside,
    Inside,
    /// The winding number is neither 0 nor 1, or the file does not tell it.
    Undecided,
}

/// Counts windings around points.
struct Windings<'a> {
    sides: &'a FileSides,
    tree: FaceTree<'a>,
}

/// A mesh in a field's frame, and the field's kind.
pub(super) struct Truth<'a> {
    pub facets: Facets,
    pub kind: SdfKind,
    /// How far the input may be from the mesh, units.
    pub off: f64,
    domain: Domain,
    windings: Option<Windings<'a>>,
}

impl<'a> Truth<'a> {
    /// Of a mesh. Signed and solid fields need sides.
    pub fn new(mesh: &Mesh, domain: Domain, kind: SdfKind, sides: Option<&'a FileSides>) -> Self {
        let sides = sides.filter(|_| kind != SdfKind::Surface);
        let tells = |triangle: usize| {
            let is_proper = triangle < mesh.triangles.len();
            let is_sideless = |sides: &FileSides| sides.sideless.get(triangle) == Some(&true);
            is_proper && sides.is_some_and(|sides| !is_sideless(sides))
        };
        let facets = mesh
            .all_corners_f64()
            .enumerate()
            .map(|(triangle, at)| Facet::new(at.map(|p| domain.place(p)), tells(triangle)));
        let facets = Facets::new(facets.collect());
        let windings = sides.map(|sides| Windings { sides, tree: FaceTree::new(&sides.faces) });
        Self { facets, kind, off: 0.0, domain, windings }
    }

    /// The same of an input that may be so far from the mesh, units.
    pub fn with_off(self, off: f64) -> Self {
        Self { off, ..self }
    }

    /// The side of a point of the frame that is not on the surface. `nears` are the triangles that
    /// may be nearest to it; `None` if they do not tell.
    fn side_by(&self, p: DVec3, nears: impl Iterator<Item = Near>) -> Option<Side> {
        let mut side = None;
        for near in nears {
            let facet = self.facets.facet(near.facet()?);
            let away = p - near.point;
            let height = facet.normal.dot(away);
            let is_certain = height.abs() > facet.doubt * away.length() + MARGIN;
            if !facet.tells_side || !is_certain {
                return None;
            }
            let seen = if height > 0.0 { Side::Outside } else { Side::Inside };
            if *side.get_or_insert(seen) != seen {
                return None;
            }
        }
        side
    }

    /// The side of a point of the frame that is not on the surface.
    pub fn side(&self, p: DVec3, nears: impl Iterator<Item = Near>) -> Side {
        let Some(Windings { sides, tree }) = &self.windings else { return Side::Outside };
        if let Some(side) = self.side_by(p, nears) {
            return side;
        }
        if sides.is_mixed {
            return Side::Undecided;
        }
        let p = sides.place(self.domain.input_place(p));
        let winding = tree.winding(p, |_| 1);
        let filed =
            sides.times.as_ref().map_or(winding, |times| tree.winding(p, |face| times[face]));
        match (winding, filed) {
            (0, 0) => Side::Outside,
            (1, 1 | -1) => Side::Inside,
            _ => Side::Undecided,
        }
    }
}
