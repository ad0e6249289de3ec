//! The trade of a mesh or of curves, measured: what each setting of each structure promises, finds
//! and costs.
//!
//! ```text
//! settings ─ blobs ─ ask ─┬─ intervals ──────────┬─ rows ─┬─ pareto
//! points ─┬───────────────┴─ work ─ cost, field ─┤        └─ limits ─ choice
//!         └─ truth ──────────────────────────────┘
//! ```
//!
//! `pairs` does the same for two models.
//!
//! | file | owns |
//! | --- | --- |
//! | `points` | points and segments far from a mesh or curves, near them, and along a path |
//! | `setting` | a recipe and how it is asked, and the list that [`measure()`] is given by default |
//! | `blobs` | the blob of a recipe, or why there is none |
//! | `ask` | the answers of a setting, their work, and the time of this machine |
//! | `truth` | the distance from every triangle, and where a segment meets one, in f64; it shares no code with queries |
//! | `cost` | instructions of a board from the work of a query |
//! | `field` | the cost of a look-up in a distance field, which is not fitted |
//! | `costs`, `fitted` | the fitted numbers, written by `cargo xtask fit`; looked up |
//! | `measure` | the rows, and which of them nothing else beats |
//! | `pairs` | two models that keep a distance: structures, verdicts and costs |
//! | `limits` | which row meets the limits of a device |
//!
//! A guaranteed error is the width of an interval that holds. It is the largest among the measured
//! queries, not a bound for all queries. Instructions are predicted by a linear model that was
//! fitted to counts in an emulator. Its errors are told by [`Cost`].

mod ask;
mod blobs;
mod cost;
mod costs;
mod field;
mod fitted;
mod limits;
mod measure;
mod pairs;
mod points;
mod setting;
mod truth;

pub use ask::intervals;
pub use blobs::{NotBuilt, build};
pub use cost::{Board, Cost, FEATURES, Features, Search, Shape, features_of_pair};
pub use field::most as most_of_field;
pub use fitted::cost;
pub use limits::{CYCLES, Choice, Cpu, Limits, Unmet};
pub use measure::{
    COMB_OF_NEEDLES, Instructions, MANY_NEEDLES, Missing, Row, Spread, Trade, distances, measure,
    measure_curves, pareto,
};
pub use pairs::{PairError, PairRow, PairStructure, PairTrade, measure_pair};
pub use points::{Points, diagonal, diagonal_of_curves, points, points_of_curves, segments};
pub use setting::{How, Question, Setting, standard, standard_of_curves, standard_of_segments};
