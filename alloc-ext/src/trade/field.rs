//! The cost of a look-up in a distance field, and what the field tells of the surface.
//!
//! A look-up takes the same steps at every place of a field's lattice, so nothing is fitted. The
//! numbers are those of the suite on the boards: `field_distance` in `host-tests/costs.txt` within
//! the field, and `signed`, of which seven in eight points are outside. `cargo xtask count --board
//! "field field.msw"` prints the most.

use super::cost::{Board, Cost};
use meshsweep_core::{Interval, Sdf, SdfKind};

/// Instructions of a look-up outside of the field, and how many fewer it takes within.
const OUTSIDE: [[f64; 2]; 2] = [[450.0, 450.0 - 184.3], [8020.0, 8020.0 - 2152.0]];

/// How many times as many instructions the costliest place takes.
const COSTLIEST: [f64; 2] = [1.15, 1.5];

/// Most instructions of a look-up anywhere, whatever the points that were measured: a limit of time
/// takes this, and no search for a costly place. Fields that are measured are lattices: see
/// [`Recipe::Sdf`](crate::builder::Recipe::Sdf).
pub(super) fn most(board: Board) -> f64 {
    let [outside, ..] = cost(board).instructions;
    outside
}

const fn of_board(board: usize) -> Cost {
    let [outside, spared] = OUTSIDE[board];
    Cost {
        instructions: [outside, -spared, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        least: 0.0,
        missed_by: COSTLIEST[board],
        error: 0.05,
        typical: 0.05,
    }
}

static COSTS: [Cost; 2] = [of_board(0), of_board(1)];

/// The cost of a look-up on a board.
pub(super) fn cost(board: Board) -> &'static Cost {
    match board {
        Board::CortexM4F => &COSTS[0],
        Board::CortexM0 => &COSTS[1],
    }
}

/// Bounds of the distance to the surface, from the interval of a field. A field of kind solid tells
/// nothing of points that may be inside.
pub(super) fn to_surface(field: &Sdf<'_>, Interval { lower, upper }: Interval) -> Interval {
    if lower > 0.0 {
        Interval::new(lower, upper)
    } else if field.kind() == SdfKind::Solid {
        Interval::new(0.0, f32::INFINITY)
    } else if upper < 0.0 {
        Interval::new(-upper, -lower)
    } else {
        Interval::new(0.0, upper.max(-lower))
    }
}
