//! Edge collapses: one greedy loop, priorities, conditions, placement by a linear program, and a
//! history that can be inverted.
//!
//! Progressive hulls after Platis & Theoharis 2003, 3.1. Topology never looks at positions
//! (`star`), placement never at topology (`placement` outside of the surface, `quadric` near it),
//! and the loop at neither (`greedy`).

mod engine;
mod greedy;
mod history;
mod options;
mod placement;
mod quadric;
mod star;
mod surface;
mod thin;

pub use engine::{Engine, Stuck};
pub(crate) use greedy::{Candidate, Collapsing, Schedule, run};
pub use history::{Collapse, History, VertexOrder};
pub use options::CollapseOptions;
pub use star::{Connectivity, MAX_STAR, Wings};
pub use thin::thin;

use crate::lp::Order;

/// How candidate edges are ordered (paper 000, 3.1.3).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Priority {
    /// Volume that the collapse would add, from the program's own optimum: tighter hulls.
    #[default]
    Program,
    /// Volume of the tetrahedra between the star and the centre of its link: no linear program
    /// before the collapse.
    Span,
}

impl Priority {
    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Program => "program",
            Self::Span => "span",
        }
    }
}

/// The paper's conditions (3.1.4), with its values as defaults (4.1), and the program's second
/// term.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conditions {
    /// Largest valence of the resulting vertex. Paper: 12.
    pub max_valence: usize,
    /// Least ratio of the star's worst compactness after and before. Paper: 0.8.
    pub compactness_ratio: f64,
    /// Largest deviation of a face's normal, as its cosine. Paper: cos π/4.
    pub min_normal_cosine: f64,
    /// Weight of the second term of the program, in the star's frame. It decides where a flat star
    /// puts the vertex, and it rounds off sharp ones. `DESIGN.md` has the measurement behind
    /// the default.
    pub second_term: f64,
    /// The order in which the program takes the planes of a star. The paper's is
    /// [`Order::Shuffled`]; the default is faster.
    pub order: Order,
    /// Faces left above which costs are evaluated lazily: the edges around a collapse keep their
    /// old cost until they reach the top of the queue. The paper evaluates them at once, as
    /// `usize::MAX` does.
    pub lazy_above: usize,
    /// Whether an edge of [`Priority::Span`] goes back into the queue if its collapse would add
    /// more than the span. The paper collapses it.
    pub puts_back: bool,
    /// Whether an edge is refused whose collapse would make the surface meet itself. A surface that
    /// does not meet itself then never does. It costs about as much as the collapses.
    pub keeps_apart: bool,
}

impl Conditions {
    /// The defaults.
    pub const STANDARD: Self = Self {
        max_valence: 12,
        compactness_ratio: 0.8,
        min_normal_cosine: core::f64::consts::FRAC_1_SQRT_2,
        second_term: 1e-3,
        order: Order::MostViolated,
        lazy_above: 4000,
        puts_back: true,
        keeps_apart: false,
    };

    /// The paper's algorithm: costs evaluated at once, no edge put back, Seidel's order. The second
    /// term stays, for a vertex has to be unique.
    pub const PAPER: Self = Self {
        order: Order::Shuffled(0),
        lazy_above: usize::MAX,
        puts_back: false,
        ..Self::STANDARD
    };
}

impl Default for Conditions {
    fn default() -> Self {
        Self::STANDARD
    }
}
