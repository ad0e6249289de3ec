//! The costs, by board and search.

use super::cost::{Board, Cost, Search};
use super::costs::COSTS;

/// The costs of a search on a board: fitted, or those of a look-up.
#[must_use]
pub fn cost(board: Board, search: Search) -> Option<&'static Cost> {
    if let Search::Field | Search::FieldTree = search {
        return Some(super::field::cost(board, search));
    }
    COSTS.iter().find(|(b, s, _)| (*b, *s) == (board, search)).map(|(.., cost)| cost)
}
