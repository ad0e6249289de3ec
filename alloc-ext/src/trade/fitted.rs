//! The fitted costs, by board and search.

use super::cost::{Board, Cost, Search};
use super::costs::COSTS;

/// The fitted costs of a search on a board.
#[must_use]
pub fn cost(board: Board, search: Search) -> Option<&'static Cost> {
    COSTS.iter().find(|(b, s, _)| (*b, *s) == (board, search)).map(|(.., cost)| cost)
}
