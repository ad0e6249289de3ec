//! A ball that holds a model and is hardly larger than the least one.
//!
//! After Bădoiu and Clarkson, *Smaller core-sets for balls* (2003): the middle goes a part of the
//! way to the farthest vertex, 16 times. Any middle will do; only the last radius needs a proof.

use super::model_box::ModelBox;
use crate::bvh::tree::format::Bvh;
use crate::geom::fan::WIDTH;
use crate::num::tolerance::{MODEL_BOX, SQUARE_FLOOR, U32};
use crate::num::{difference, dot, sqrt_approx};
use glam::Vec3;

/// How often the middle moves. Measured on the links of a robot: the radius is within 1 % of the
/// least.
const MOVES: u16 = 16;

/// A ball that holds the surface of the input, input units. `core/docs/rounding.md` §24.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ModelBall {
    pub(crate) middle: Vec3,
    pub(crate) radius: f32,
}

impl ModelBall {
    /// The ball around a box.
    pub(crate) fn around(bounds: &ModelBox) -> ModelBall {
        let ModelBox { middle, half, .. } = *bounds;
        let radius = sqrt_approx(dot(half, half) + SQUARE_FLOOR) * (1.0 + MODEL_BOX * U32);
        ModelBall { middle, radius }
    }

    /// A smaller ball, of all vertices. `None` if a tree is unchecked, or is beyond f32.
    pub(crate) fn of(tree: &Bvh<'_>) -> Option<ModelBall> {
        let (low, high) = tree.grid_bounds();
        let mut middle = 0.5 * low + 0.5 * high;
        let mut best: Option<(Vec3, f32)> = None;
        for part in 2..2 + MOVES {
            let (vertex, square) = farthest(tree, middle)?;
            if best.is_none_or(|(_, least)| square < least) {
                best = Some((middle, square));
            }
            middle += (vertex - middle) / f32::from(part);
        }
        let (middle, square) = best?;
        let radius = sqrt_approx(square + SQUARE_FLOOR);
        let (units, error) = (tree.units(), tree.surface_error());
        let [x, y, z, radius] =
            [middle.x, middle.y, middle.z, radius].map(|x| units.outward(x, 1.0));
        let radius = (radius + error) * (1.0 + MODEL_BOX * U32) + 4.0 * f32::MIN_POSITIVE;
        radius.is_finite().then_some(ModelBall { middle: Vec3::new(x, y, z), radius })
    }
}

/// The vertex that is farthest from a place, and its squared distance, grid units.
fn farthest(tree: &Bvh<'_>, from: Vec3) -> Option<(Vec3, f32)> {
    let mut found = (from, 0.0);
    let mut look = |vertex: Vec3| {
        let offset = difference(vertex, from);
        let square = dot(offset, offset);
        if square > found.1 {
            found = (vertex, square);
        }
    };
    for node in 0..tree.most_steps() {
        let links = tree.links(node)?;
        for index in links.inner..links.count.min(WIDTH as u32) {
            let leaf = tree.leaf(node, index)?;
            let shape = leaf.shape();
            (0..shape.centres()).for_each(|which| look(leaf.centre(which)));
            (0..=shape.triangles()).for_each(|i| look(leaf.ring(i)));
        }
    }
    Some(found)
}
