//! Triangles that may face the eye: leaves that certainly show their back are left out.

use super::query::{Asked, PreparedPoint};
use crate::bvh::tree::format::{Bvh, FanLeaf};
use crate::geom::fan::{NormalCone, WIDTH};
use crate::num::greater;
use crate::query::QueryError;
use glam::Vec3;

/// The point or direction that a scene is seen from.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Eye {
    /// From a viewpoint, input units.
    At([f32; 3]),
    /// Along parallel lines, from the eye into the scene. Any length but 0, with which nothing is
    /// left out.
    Along([f32; 3]),
}

/// The result of [`Bvh::front_facing`]. The triangles are in the caller's slice.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct FrontFacing {
    /// Triangles in the slice.
    pub stored: usize,
    /// Triangles that did not fit.
    pub dropped: u32,
    /// Leaves of the tree.
    pub leaves: u32,
    /// Leaves that certainly show their back.
    pub culled_leaves: u32,
    /// Triangles of these leaves.
    pub culled: u32,
}

impl Bvh<'_> {
    /// Triangles that may face the eye, as numbers in the input file, in blob order: all but those
    /// of leaves whose normal cone proves that they show their back (Galin & Akkouche 2005, 6.4).
    ///
    /// A triangle faces a viewpoint if its corners, in the order of the input file, run
    /// counter-clockwise seen from there. Edge-on and degenerate triangles do not. No triangle that
    /// is left out faces the eye, as it is stored. If a grid moved its vertices, the input's
    /// triangle may face the eye where it is seen nearly edge-on. A triangle in the slice may show
    /// its back: one cone holds the normals of all triangles of a leaf, up to eight.
    ///
    /// Cost: linear in the leaves, some fifteen operations for each fan. No scratch, no budget.
    ///
    /// ```
    /// use meshsweep_core::{Bvh, Eye};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
    /// let part = Bvh::open(bytes)?;
    /// let mut triangles = [0; 2048];
    /// let found = part.front_facing(Eye::At([0.0, 0.0, 50.0]), &mut triangles)?;
    /// assert!(found.culled > 0);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`QueryError::NotFinite`]; [`QueryError::NotServed`] if the blob was built without cones.
    pub fn front_facing(&self, eye: Eye, triangles: &mut [u32]) -> Result<FrontFacing, QueryError> {
        let eye = GridEye::new(self, eye)?;
        if !self.serves_culling() {
            return Err(QueryError::NO_CONES);
        }
        let mut found = FrontFacing::default();
        for node in 0..self.header().nodes {
            let links = self.links(node).ok_or(QueryError::Unchecked)?;
            for child in links.inner..links.count.min(WIDTH as u32) {
                let leaf = self.leaf_at(links.vertex(child), links.shape(child));
                let leaf = leaf.ok_or(QueryError::Unchecked)?;
                let cone = self.cone(found.leaves).ok_or(QueryError::Unchecked)?;
                let count = leaf.shape().triangles() as u32;
                found.leaves += 1;
                if NormalCone::read(cone).is_some_and(|cone| eye.is_behind(&cone, &leaf)) {
                    found.culled_leaves += 1;
                    found.culled += count;
                    continue;
                }
                let first = links.triangle(child);
                for triangle in first..first.saturating_add(count) {
                    match triangles.get_mut(found.stored) {
                        Some(slot) => {
                            *slot = self.source(triangle).ok_or(QueryError::Unchecked)?;
                            found.stored += 1;
                        }
                        None => found.dropped += 1,
                    }
                }
            }
        }
        Ok(found)
    }
}

/// The eye in grid units.
enum GridEye {
    At(Vec3),
    /// So far away that squares would leave f32's range: the ways to the eye are scaled down.
    FarAt(Vec3),
    /// Direction to the eye, no component above 1.
    Towards(Vec3),
}

/// 2^-70.
const DOWN: f32 = 1.0 / ((1u64 << 35) as f32 * (1u64 << 35) as f32);

impl GridEye {
    fn new(tree: &Bvh<'_>, eye: Eye) -> Result<GridEye, QueryError> {
        match eye {
            Eye::At(point) => {
                let prepared = PreparedPoint::new(tree, point)?;
                Ok(match prepared.asked() {
                    Asked::Near(query) => GridEye::At(query.p),
                    Asked::Far(far) => GridEye::FarAt(far.query.p),
                })
            }
            Eye::Along(along) => {
                let along = Vec3::from_array(along);
                if !along.is_finite() {
                    return Err(QueryError::NotFinite);
                }
                let [x, y, z] = along.to_array().map(f32::abs);
                let most = greater(y, x);
                let most = greater(most, z);
                Ok(GridEye::Towards(if most > 0.0 { along / -most } else { Vec3::ZERO }))
            }
        }
    }

    /// Whether certainly no triangle of a leaf faces the eye.
    fn is_behind(&self, cone: &NormalCone, leaf: &FanLeaf<'_>) -> bool {
        // A product with 1 keeps the bits.
        let (eye, scale) = match *self {
            GridEye::Towards(way) => return cone.is_behind(way),
            GridEye::At(eye) => (eye, 1.0),
            GridEye::FarAt(eye) => (eye, DOWN),
        };
        (0..leaf.shape().centres()).all(|which| cone.is_behind((eye - leaf.centre(which)) * scale))
    }
}
