//! The processor's stack that questions take on boards.

use meshsweep_core::Blob;
use std::fmt::Write;

/// Bounds by question and board, with some room for other compilers. `cargo xtask tables` writes
/// them from the images' call graphs, and `cargo xtask test` compares them.
const BOUNDS: &str = include_str!("stack.csv");

/// Columns of the text.
const NAME: usize = 28;
const BOARD: usize = 15;

/// Whose functions ask.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Caller {
    /// The methods of the structures.
    Rust,
    /// The functions of `meshsweep.h`.
    C,
}

impl Caller {
    /// Whether a row of the table is about its functions.
    fn calls(self, name: &str) -> bool {
        name.starts_with("msw_") == (self == Self::C)
    }
}

/// Bytes that a question takes at most on a board, whichever optimisation; 0 if the table lacks it.
pub(crate) fn stack_bound(question: &str, board: &str) -> u32 {
    let mut rows = BOUNDS.lines().map(|row| row.split(','));
    let heads = rows.next().into_iter().flatten();
    let Some(row) = rows.find(|row| row.clone().next() == Some(question)) else { return 0 };
    let of_board = heads.zip(row).filter(|(head, _)| head.split(' ').next() == Some(board));
    of_board.filter_map(|(_, bytes)| bytes.parse().ok()).max().unwrap_or(0)
}

/// The bounds of the questions that a blob serves: a heading, then a line a question.
pub(super) fn lines(blob: &Blob<'_>, caller: Caller) -> Vec<String> {
    let served = served(blob);
    let mut rows = BOUNDS.lines().map(|row| row.split(','));
    let boards: Vec<&str> = rows.next().into_iter().flatten().skip(2).step_by(2).collect();
    let cpus = boards.iter().map(|board| board.split(' ').next().unwrap_or_default());
    let mut lines = vec![cpus.fold(" ".repeat(NAME), |mut line, cpu| {
        let _ = write!(line, "{cpu:>BOARD$}");
        line
    })];
    for mut row in rows {
        let (Some(name), Some(needs)) = (row.next(), row.next()) else { continue };
        if served.contains(&needs) && caller.calls(name) {
            let mut line = format!("{name:<NAME$}");
            while let (Some(small), Some(fast)) = (row.next(), row.next()) {
                let _ = write!(line, "{:>BOARD$}", format!("{small} / {fast}"));
            }
            lines.push(line);
        }
    }
    lines
}

/// What a blob has, as the table names it.
fn served(blob: &Blob<'_>) -> Vec<&'static str> {
    let tree = blob.bvh().ok();
    let of_tree = |serves: fn(&meshsweep_core::Bvh<'_>) -> bool| tree.as_ref().is_some_and(serves);
    let all = [
        ("any", true),
        ("tree", tree.is_some()),
        ("closest", of_tree(|tree| tree.serves_distances())),
        ("segment", of_tree(|tree| tree.serves_segments())),
        ("cull", of_tree(|tree| tree.serves_culling())),
        ("winding", of_tree(|tree| tree.serves_winding())),
        ("tight", blob.tight_hulls().is_ok()),
        ("hull", blob.hull().is_ok()),
        ("deform", blob.deformable_hull().is_ok()),
        ("triboxes", blob.triboxes().is_ok()),
        ("curve", blob.curve().is_ok()),
        ("sdf", blob.sdf().is_ok()),
        ("both", blob.bvh_with_sdf().is_ok()),
    ];
    all.into_iter().filter_map(|(name, is_served)| is_served.then_some(name)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_caller_has_a_bound_of_opening_and_of_a_closest_point() {
        let rows = |caller: Caller| {
            let names = BOUNDS.lines().skip(1).filter_map(|row| row.split(',').next());
            names.filter(move |name| caller.calls(name)).collect::<Vec<_>>()
        };
        for (caller, wanted) in [
            (Caller::Rust, ["open a box tree", "closest point"]),
            (Caller::C, ["msw_open", "msw_closest_point"]),
        ] {
            let rows = rows(caller);
            assert!(wanted.iter().all(|name| rows.contains(name)), "{caller:?}: {rows:?}");
        }
    }
}
