//! Instructions of a board from the work of a query.
//!
//! The work of a query is the same on every target with floating point, in the order of boards. So
//! the instructions of a board are a sum over the counters of [`Work`], each times a cost that was
//! fitted to counts in an emulator. A cost is at least 0. `cargo xtask fit` fits them again, and
//! prints the error on meshes that the fit has not seen.

use crate::emit::source::stack_bound;
use meshsweep_core::{Budget, Bvh, Curve, Hull, Sdf, SdfLayout, TightHull, Triboxes, Work};

/// A processor whose instructions are predicted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Board {
    /// With a unit for f32.
    CortexM4F,
    /// Floats by instructions.
    CortexM0,
}

impl Board {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::CortexM4F, Self::CortexM0];

    /// Its name in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::CortexM4F => "Cortex-M4F",
            Self::CortexM0 => "Cortex-M0",
        }
    }
}

/// The searches whose costs differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Search {
    /// The box tree's closest point, vertices on a grid of 16 bits.
    Tree,
    /// The same with vertices in f32.
    TreeF32,
    /// The box tree's closest point in f64, vertices in f32.
    Precise,
    /// The box tree's closest point, from the leaf of the query before.
    Hinted,
    /// The box tree's closest point, by a front that is kept between queries.
    Coherent,
    /// The hull hierarchy's closest point, by a fresh sweep.
    Sweep,
    /// The same by one sweep that moves.
    KeptSweep,
    /// The distance of the mesh inside a tight hull.
    Tight,
    /// A lower bound of the distance from triboxes.
    Triboxes,
    /// The first hit of a segment in a box tree, vertices on a grid of 16 bits.
    FirstHit,
    /// The same with vertices in f32.
    FirstHitF32,
    /// The first hit of a segment in a hull hierarchy.
    FirstHitOfHull,
    /// The first hit of a segment from outside, on the refined hull.
    OuterHit,
    /// Whether two box trees, or two tight hulls, are within a distance of each other.
    PairOfTrees,
    /// Whether triboxes prove that two models are farther than a distance.
    PairOfTriboxes,
    /// The closest point of curves.
    Curve,
    /// The same by one search that moves.
    KeptCurve,
    /// Whether curves are within a distance.
    CurveWithin,
    /// The signed distance of a fence.
    CurveSigned,
    /// The distance of a lattice: one look-up, whose cost is known by its construction.
    Field,
    /// The distance of a tree of boxes: a look-up of so many steps as lead to the leaf.
    FieldTree,
}

impl Search {
    /// All whose costs are fitted.
    pub const ALL: [Self; 19] = [
        Self::Tree,
        Self::TreeF32,
        Self::Precise,
        Self::Hinted,
        Self::Coherent,
        Self::Sweep,
        Self::KeptSweep,
        Self::Tight,
        Self::Triboxes,
        Self::FirstHit,
        Self::FirstHitF32,
        Self::FirstHitOfHull,
        Self::OuterHit,
        Self::PairOfTrees,
        Self::PairOfTriboxes,
        Self::Curve,
        Self::KeptCurve,
        Self::CurveWithin,
        Self::CurveSigned,
    ];

    /// Of a distance field.
    #[must_use]
    pub const fn of_field(field: &Sdf<'_>) -> Self {
        match field.layout() {
            SdfLayout::Tree => Self::FieldTree,
            _ => Self::Field,
        }
    }

    /// Bytes of stack below the caller that the question takes at most on a board.
    #[must_use]
    pub fn stack(self, board: Board) -> u32 {
        stack_bound(self.question(), board.name())
    }

    /// The question, as the table of stacks names it.
    const fn question(self) -> &'static str {
        match self {
            Self::Tree | Self::TreeF32 => "closest point",
            Self::Precise => "closest point in f64",
            Self::Hinted => "closest point from a hint",
            Self::Coherent => "coherent query",
            Self::Sweep => "closest point of a hull",
            Self::KeptSweep => "sweep",
            Self::Tight => "closest point of tight hulls",
            Self::Triboxes => "triboxes apart",
            Self::FirstHit | Self::FirstHitF32 => "first hit",
            Self::FirstHitOfHull => "first hit of a hull",
            Self::OuterHit => "outer hits",
            Self::PairOfTrees => "distance of two models",
            Self::PairOfTriboxes => "within of triboxes",
            // Below `within` there is the same search, with less beside it.
            Self::Curve | Self::CurveWithin => "closest point of curves",
            Self::KeptCurve => "sweep of curves",
            Self::CurveSigned => "signed distance of curves",
            Self::Field | Self::FieldTree => "distance of a field",
        }
    }

    /// Its name in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Tree => "box tree",
            Self::TreeF32 => "box tree, f32",
            Self::Precise => "box tree, precise",
            Self::Hinted => "box tree, hinted",
            Self::Coherent => "box tree, coherent",
            Self::Sweep => "sweep",
            Self::KeptSweep => "sweep, kept",
            Self::Tight => "tight hull",
            Self::Triboxes => "triboxes",
            Self::FirstHit => "first hit",
            Self::FirstHitF32 => "first hit, f32",
            Self::FirstHitOfHull => "first hit, hull",
            Self::OuterHit => "first hit, refined",
            Self::PairOfTrees => "pair of trees",
            Self::PairOfTriboxes => "pair of triboxes",
            Self::Curve => "curve",
            Self::KeptCurve => "curve, kept",
            Self::CurveWithin => "curve, within",
            Self::CurveSigned => "curve, signed",
            Self::Field => "distance field, lattice",
            Self::FieldTree => "distance field, tree",
        }
    }
}

/// What the model multiplies by costs: see [`FEATURES`].
pub type Features = [f64; 8];

/// Names of the [`Features`]. `inside`: the point, or a point of the box about the segment, is in
/// the structure's box. `leaf`: triangles
/// divided by those of a mean leaf. `tolerant`: splits of a query with a tolerance.
pub const FEATURES: [&str; 8] =
    ["query", "inside", "node", "triangle", "exact", "split", "leaf", "tolerant"];

/// The features of a question about two models. `inside`: a search began.
#[must_use]
pub fn features_of_pair(work: &Work) -> Features {
    let counters = [work.bounds, work.triangles, work.exact, work.opened].map(f64::from);
    let [nodes, triangles, exact, splits] = counters;
    let searched = if work.total() > 0 { 1.0 } else { 0.0 };
    [1.0, searched, nodes, triangles, exact, splits, 0.0, 0.0]
}

/// What the features of a query need of its structure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shape {
    low: [f32; 3],
    high: [f32; 3],
    /// Triangles of a mean leaf; infinite if the structure has no leaves.
    leaf: f64,
}

impl Shape {
    /// Of a box tree.
    #[must_use]
    pub fn of_tree(tree: &Bvh<'_>) -> Self {
        let ([low, high], header) = (tree.bounds(), tree.header());
        Self { low, high, leaf: f64::from(header.triangles) / f64::from(header.leaves.max(1)) }
    }

    /// Of a hull hierarchy.
    #[must_use]
    pub fn of_hull(hull: &Hull<'_>) -> Self {
        let [low, high] = hull.bounds();
        Self { low, high, leaf: f64::INFINITY }
    }

    /// Of a tight hull.
    #[must_use]
    pub fn of_tight(hull: &TightHull<'_>) -> Self {
        Self::of_tree(hull.bvh())
    }

    /// Of a distance field.
    #[must_use]
    pub fn of_field(field: &Sdf<'_>) -> Self {
        let [low, high] = field.bounds();
        Self { low, high, leaf: f64::INFINITY }
    }

    /// Of curves.
    #[must_use]
    pub fn of_curve(curve: &Curve<'_>) -> Self {
        let [low, high] = curve.bounds();
        Self { low, high, leaf: f64::INFINITY }
    }

    /// Of triboxes. Every place counts as inside of turned ones.
    #[must_use]
    pub fn of_triboxes(triboxes: &Triboxes<'_>) -> Self {
        if triboxes.is_turned() {
            let all = f32::INFINITY;
            return Self { low: [-all; 3], high: [all; 3], leaf: f64::INFINITY };
        }
        let corner = |of: [f32; 9]| [of[0], of[1], of[2]];
        let corners = triboxes.node(0).map(|root| [root.low, root.high].map(corner));
        let [low, high] = corners.unwrap_or_default();
        Self { low, high, leaf: f64::INFINITY }
    }

    /// The features of a query at a point, or about the segment between two.
    #[must_use]
    pub fn features(&self, place: &[[f32; 3]], budget: &Budget, work: &Work) -> Features {
        let counters = [work.bounds, work.triangles, work.exact, work.opened].map(f64::from);
        let [nodes, triangles, exact, splits] = counters;
        let is_inside = (0..3).all(|k| {
            place.iter().any(|point| self.low[k] <= point[k])
                && place.iter().any(|point| point[k] <= self.high[k])
        });
        let is_tolerant = budget.relative > 0.0 || budget.absolute > 0.0;
        let of = |is: bool, count: f64| if is { count } else { 0.0 };
        let inside = of(is_inside, 1.0);
        let tolerant = of(is_tolerant, splits);
        [1.0, inside, nodes, triangles, exact, splits, triangles / self.leaf, tolerant]
    }
}

/// The costs of a search on a board.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cost {
    /// Instructions for one of each feature.
    pub instructions: Features,
    /// The least instructions of a query that the emulator counted.
    pub least: f64,
    /// Largest factor by which the costliest query of a question was costlier than the costliest
    /// prediction; a comb of needles is left out.
    pub missed_by: f64,
    /// Largest relative error of the mean of a question on all meshes of the fit and of its tests,
    /// but for a comb of needles.
    pub error: f64,
    /// The median of these errors on meshes that the fit has not seen.
    pub typical: f64,
}

impl Cost {
    /// Instructions of a query, or of a mean query.
    #[must_use]
    pub fn of(&self, features: &Features) -> f64 {
        let all = self.instructions.iter().zip(features);
        all.map(|(cost, count)| cost * count).sum::<f64>().max(self.least)
    }
}
