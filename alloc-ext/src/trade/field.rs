//! The cost of a look-up in a distance field, and what the field tells of the surface.
//!
//! A look-up takes the same steps at every place of a lattice. In a tree it reads as many entries as
//! lead to the leaf: `steps`. So nothing is fitted. `cargo xtask count --board "field field.msw"
//! "beyond field.msw"` prints mean and most within the field and about it, where seven in eight
//! points are outside. The numbers are those of a lattice of `bracket.stl` in 16 KiB, and of trees of
//! `bracket.stl` in 4 and 16 KiB and of `torus.ply` in 2 KiB, of 2.5 to 3.5 steps in the mean.

use super::cost::{Board, Cost, Search};
use meshsweep_core::internal::sdf::format::layout::tree::IS_LEAF;
use meshsweep_core::{Interval, Sdf, SdfKind, SdfLayout};

/// Instructions of a look-up outside of the field and how many fewer it takes within, by board: of
/// a lattice, and of a tree without its steps.
const OUTSIDE: [[[f64; 2]; 2]; 2] =
    [[[444.0, 264.0], [7630.0, 5590.0]], [[455.0, 300.0], [7590.0, 5600.0]]];

/// Instructions of an entry that a look-up in a tree reads.
const STEP: [f64; 2] = [20.0, 36.0];

/// Instructions that the costliest places outside take beside the mean, by board: without floating
/// point sums and products take longer for some numbers.
const COSTLIEST_OUTSIDE: [f64; 2] = [20.0, 400.0];

/// How many times as many instructions the costliest place takes, of a lattice and of a tree.
const COSTLIEST: [[f64; 2]; 2] = [[1.15, 1.5], [1.15, 1.5]];

/// Instructions of a look-up anywhere in or about a field, whatever the points that were measured:
/// outside, and with as many steps as any question of the field takes ([`Sdf::steps`]).
#[must_use]
pub fn most(board: Board, field: &Sdf<'_>) -> f64 {
    let [outside, _, step, ..] = cost(board, Search::of_field(field)).instructions;
    let more = match board {
        Board::CortexM4F => COSTLIEST_OUTSIDE[0],
        Board::CortexM0 => COSTLIEST_OUTSIDE[1],
    };
    outside + step * f64::from(field.steps()) + more
}

/// Entries of a tree that the look-up of a point reads; 0 of a lattice, whose cost has no steps.
/// A point outside is looked up at the nearest place of the field.
pub(super) fn steps(field: &Sdf<'_>, point: [f32; 3]) -> u32 {
    if field.layout() == SdfLayout::Lattice {
        return 0;
    }
    let header = field.header();
    let [x, y, _] = header.cells.map(usize::from);
    // In root cells, from the field's corner.
    let mut place: [f32; 3] = std::array::from_fn(|k| {
        let root = (1u32 << field.layout().cell_bits()) as f32;
        let last = f32::from(header.cells[k]).next_down();
        ((point[k] - header.origin[k]) * header.per_unit / root).clamp(0.0, last)
    });
    let root = place.map(|at| at as usize);
    place = place.map(f32::fract);
    let mut number = root[0] + x * (root[1] + y * root[2]);
    for steps in 1..field.steps() {
        let Some(&[a, b, _, kind, _]) = field.entries().get(number) else { return steps };
        if kind & IS_LEAF != 0 {
            return steps;
        }
        let (mut child, mut bit) = (0, 1);
        for axis in (0..3).filter(|axis| kind >> axis & 1 != 0) {
            let twice = 2.0 * place[axis];
            child += bit * usize::from(twice >= 1.0);
            bit *= 2;
            place[axis] = twice.fract();
        }
        number += 1 + usize::from(u16::from_le_bytes([a, b])) + child;
    }
    field.steps()
}

const fn of_board(layout: usize, board: usize) -> Cost {
    let ([outside, spared], step) = (OUTSIDE[layout][board], [0.0, STEP[board]][layout]);
    Cost {
        instructions: [outside, -spared, step, 0.0, 0.0, 0.0, 0.0, 0.0],
        least: 0.0,
        missed_by: COSTLIEST[layout][board],
        error: 0.05,
        typical: 0.05,
    }
}

static COSTS: [[Cost; 2]; 2] = [[of_board(0, 0), of_board(0, 1)], [of_board(1, 0), of_board(1, 1)]];

/// The cost of a look-up on a board, in a lattice or a tree.
pub(super) fn cost(board: Board, search: Search) -> &'static Cost {
    let of_layout = &COSTS[usize::from(search == Search::FieldTree)];
    match board {
        Board::CortexM4F => &of_layout[0],
        Board::CortexM0 => &of_layout[1],
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
