//! The box of a placed model along the axes of the world.
//!
//! `Scene::nearest_pair` needs a lower bound for every pair, to begin with the nearest. This one is
//! cheap. [`PlacedModel::apart`] is tighter, and proves a given distance only.

use super::placed_model::PlacedModel;
use crate::num::sqrt_approx;
use crate::num::tolerance::{LEAST_WORLD_GAP, U32, WORLD_BOX};

/// An axis-aligned box in the world.
#[derive(Clone, Copy)]
pub(crate) struct WorldBox {
    middle: [f32; 3],
    /// Half of the edges, and room for the rounding of all.
    half: [f32; 3],
}

impl WorldBox {
    pub(crate) fn new(placed: &PlacedModel<'_>) -> WorldBox {
        let [low, high] = placed.tree.bounds();
        let error = placed.tree.surface_error();
        let mut found = WorldBox { middle: placed.pose.translation, half: [0.0; 3] };
        let sides = found.middle.iter_mut().zip(&mut found.half);
        for ((middle, half), row) in sides.zip(&placed.pose.rotation) {
            let mut size = middle.abs();
            for (entry, (low, high)) in row.iter().zip(low.iter().zip(&high)) {
                *middle += entry * (0.5 * low + 0.5 * high);
                *half += entry.abs() * (0.5 * high - 0.5 * low + error);
                size += entry.abs() * (low.abs() + high.abs() + error);
            }
            *half += size * (WORLD_BOX * U32) + f32::MIN_POSITIVE;
        }
        found
    }

    /// A lower bound of the distance; 0 where numbers leave f32's range.
    pub(crate) fn gap(&self, other: &WorldBox) -> f32 {
        let mut square = 0.0;
        let sides = self.middle.iter().zip(&self.half).zip(other.middle.iter().zip(&other.half));
        for ((a, half), (b, other_half)) in sides {
            let gap = (a - b).abs() - (half + other_half);
            // Not a number is no gap, nor is one with a square below f32's normal range.
            let gap = if gap > LEAST_WORLD_GAP { gap } else { 0.0 };
            square += gap * gap;
        }
        let gap = if square < f32::INFINITY { sqrt_approx(square) } else { 0.0 };
        gap * (1.0 - 16.0 * U32)
    }
}
