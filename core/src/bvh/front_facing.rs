//! Triangles that may face the eye: leaves that certainly show their back are left out.

use super::point_query::PointQuery;
use crate::bvh::format::{Bvh, FanLeaf};
use crate::geom::fan::{NormalCone, WIDTH};
use crate::query::QueryError;
use glam::Vec3;

/// How a scene is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sight {
    /// From a viewpoint, input units.
    From([f32; 3]),
    /// Along parallel lines, from the eye into the scene; any length but 0, with which nothing is
    /// left out.
    Along([f32; 3]),
}

/// What [`front_facing`] found; the triangles are in the caller's slice.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FrontFacing {
    /// Triangles in the slice.
    pub stored: usize,
    /// Triangles that did not fit.
    pub dropped: u32,
    /// Leaves in all.
    pub leaves: u32,
    /// Leaves that certainly show their back.
    pub culled_leaves: u32,
    /// Their triangles.
    pub culled: u32,
}

/// Triangles that may face the eye, as numbers in the input file, in blob order: all but those of
/// leaves whose cone of normals proves that they show their back (Galin & Akkouche 2005, 6.4). A
/// triangle faces a viewpoint if its corners run counter-clockwise seen from there; edge-on and
/// degenerate ones do not.
///
/// What is left out certainly shows its back: as stored, which with vertices on the grid may differ
/// from the input for triangles seen nearly edge-on. What is stored may face the eye or not: on
/// scans a leaf with its eight triangles spans an angle.
///
/// Cost: linear in the leaves, some fifteen operations for each fan; no memory.
///
/// # Errors
/// [`QueryError::NotFinite`]; [`QueryError::NotServed`] if the blob was built without cones.
pub fn front_facing(
    tree: &Bvh<'_>,
    sight: &Sight,
    triangles: &mut [u32],
) -> Result<FrontFacing, QueryError> {
    let eye = Eye::new(tree, sight)?;
    if !tree.serves_culling() {
        return Err(QueryError::NotServed);
    }
    let mut found = FrontFacing::default();
    for node in 0..tree.header().nodes {
        let links = tree.links(node).ok_or(QueryError::Model)?;
        for lane in links.inner..links.count.min(WIDTH as u32) {
            let leaf = tree.patch(links.vertex(lane), links.tag(lane)).ok_or(QueryError::Model)?;
            let cone = tree.cone(found.leaves).ok_or(QueryError::Model)?;
            let count = leaf.tag().triangles() as u32;
            found.leaves += 1;
            if NormalCone::read(cone).is_some_and(|cone| eye.is_behind(&cone, &leaf)) {
                found.culled_leaves += 1;
                found.culled += count;
                continue;
            }
            let first = links.triangle(lane);
            for triangle in first..first.saturating_add(count) {
                match triangles.get_mut(found.stored) {
                    Some(slot) => {
                        *slot = tree.source(triangle).ok_or(QueryError::Model)?;
                        found.stored += 1;
                    }
                    None => found.dropped += 1,
                }
            }
        }
    }
    Ok(found)
}

/// The eye in grid units.
enum Eye {
    At(Vec3),
    /// So far away that squares would leave f32's range: the ways to it are scaled down.
    FarAt(Vec3),
    /// Towards it, no component above 1.
    Towards(Vec3),
}

/// 2^-70.
const DOWN: f32 = 1.0 / ((1u64 << 35) as f32 * (1u64 << 35) as f32);

impl Eye {
    fn new(tree: &Bvh<'_>, sight: &Sight) -> Result<Eye, QueryError> {
        match *sight {
            Sight::From(point) => {
                let query = PointQuery::new(tree, point)?;
                Ok(if query.far { Eye::FarAt(query.p) } else { Eye::At(query.p) })
            }
            Sight::Along(along) => {
                let along = Vec3::from_array(along);
                if !along.is_finite() {
                    return Err(QueryError::NotFinite);
                }
                let [x, y, z] = along.to_array().map(f32::abs);
                let most = if x > y { x } else { y };
                let most = if z > most { z } else { most };
                Ok(Eye::Towards(if most > 0.0 { along / -most } else { Vec3::ZERO }))
            }
        }
    }

    /// Whether no triangle of a leaf faces it, for certain.
    fn is_behind(&self, cone: &NormalCone, leaf: &FanLeaf<'_>) -> bool {
        let all = |way: &dyn Fn(Vec3) -> Vec3| {
            (0..leaf.tag().centres()).all(|which| cone.is_behind(way(leaf.centre(which))))
        };
        match *self {
            Eye::Towards(way) => cone.is_behind(way),
            Eye::At(eye) => all(&|centre| eye - centre),
            Eye::FarAt(eye) => all(&|centre| (eye - centre) * DOWN),
        }
    }
}
