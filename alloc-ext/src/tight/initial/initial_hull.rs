//! A proved hull that a search may start from.

use crate::surface::Stored;
use crate::tight::deadline::Deadline;
use crate::tight::moves::{Rounding, Shell};
use crate::tight::proof::{Obstacle, is_outer_hull};
use crate::tight::report::Start;

/// A proved hull that a search may start from.
pub(crate) struct InitialHull {
    pub shell: Shell,
    pub start: Start,
    /// Connected components that were dropped, because they lay inside others.
    pub filled: usize,
}

impl InitialHull {
    /// Drops components inside others; `None` unless the rest is proved to be an outer hull.
    pub(super) fn proved(shell: Shell, start: Start, obstacle: &Obstacle) -> Option<Self> {
        let (shell, filled) = match shell.outermost() {
            Some(outermost) => outermost,
            None => (shell, 0),
        };
        let faces: Vec<_> = shell.alive().map(|f| shell.face(f)).collect();
        is_outer_hull(&faces, obstacle).then_some(Self { shell, start, filled })
    }
}

/// The inputs that all initial hulls share.
#[derive(Clone, Copy)]
pub(crate) struct InitialInput<'a> {
    /// Frame and grid of the surface that is collapsed.
    pub stored: &'a Stored,
    pub obstacle: &'a Obstacle,
    /// Rounding to the coordinates of the hull.
    pub rounding: Rounding,
    pub deadline: Deadline<'a>,
}
