//! The mesh's bounding box, larger by the margin and a few steps of the grid.

use super::initial_hull::{InitialHull, InitialInput};
use super::lifted::LIFTS;
use crate::tight::moves::Shell;
use crate::tight::report::Start;
use glam::DVec3;

/// Corners of the box's faces, counter-clockwise seen from outside. Bits of a corner: x, y, z.
const QUADS: [[u32; 4]; 6] =
    [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];

/// The smallest of a few boxes that is proved to be a hull; `None` if the coordinates have no room
/// for one.
pub(crate) fn grown_box(input: &InitialInput<'_>) -> Option<InitialHull> {
    let InitialInput { obstacle, rounding, .. } = input;
    let bounds = obstacle.bounds().grown(obstacle.margin());
    let size = bounds.low.abs().max(bounds.high.abs()).max_element();
    LIFTS.into_iter().find_map(|lift| {
        let out = rounding.half_step(size) * lift;
        let (low, high) = (rounding.round(bounds.low - out)?, rounding.round(bounds.high + out)?);
        let corner = |c: u32| {
            let pick = |bit: u32, low: f64, high: f64| if c & bit == 0 { low } else { high };
            DVec3::new(pick(1, low.x, high.x), pick(2, low.y, high.y), pick(4, low.z, high.z))
        };
        let triangles: Vec<[u32; 3]> =
            QUADS.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        let shell = Shell::new((0..8).map(corner).collect(), &triangles);
        InitialHull::proved(shell, Start::Box, obstacle)
    })
}
