//! How far a hull is from the mesh.

use super::obstacle::Obstacle;
use super::shell::Shell;
use crate::hull::{Farthest, Nearest, farthest};

/// Bounds of the largest distance from a point of the hull to the mesh. Cost: see [`farthest`].
pub(super) fn slack(shell: &Shell, obstacle: &Obstacle) -> Farthest {
    farthest(shell.alive().map(|f| shell.triangle(f)), 0.0, |p| {
        let (triangle, [lower, upper]) = obstacle.nearest(p)?;
        Some(Nearest { lower, upper, triangle: Some(triangle) })
    })
}
