//! A recipe and how it is asked, and the list that is measured by default.

use super::cost::{Board, Search};
use super::points::Points;
use crate::builder::Recipe;
use crate::emit::source::stack_bound;
use crate::surface::VertexBits;
use meshsweep_core::Budget;
use std::fmt;

/// The question of a measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Question {
    /// The closest point. A place is a point, and the error is the width of the distance.
    ClosestPoint,
    /// The first hit of a segment. A place is two points in a row, and the error is the width of
    /// the free length: how far the segment goes before it meets the mesh.
    FirstHit,
    /// Whether curves are within this distance. A place is a point, and there is no interval.
    Within(f32),
    /// The signed distance of a fence. A place is a point, whose z is not asked.
    Signed,
}

impl Question {
    /// Points of a place.
    #[must_use]
    pub const fn points(self) -> usize {
        match self {
            Self::FirstHit => 2,
            _ => 1,
        }
    }
}

/// What a query keeps of the one before, and how it measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum How {
    /// Nothing.
    Fresh,
    /// The leaf of the last answer, as in a batch.
    Hinted,
    /// A front of the box tree, the triangles of a sweep, or the queue of one about curves.
    Coherent,
    /// Nothing, and the box tree measures in f64.
    Precise,
}

/// A recipe, and how it is asked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Setting {
    /// The question.
    pub question: Question,
    /// The structure, and how it is built.
    pub recipe: Recipe,
    /// When a query may stop.
    pub budget: Budget,
    /// What a query keeps of the one before.
    pub how: How,
    /// Entries of scratch, at least one; more than suffice count as those that suffice. `None`: as
    /// many as suffice, twice as many for a box tree with a limit of steps,
    /// [`SWEEP_ENTRIES`](Self::SWEEP_ENTRIES) of a kept sweep, or
    /// [`BESIDE_SPLITS`](Self::BESIDE_SPLITS) of the refined hull.
    pub entries: Option<usize>,
}

impl Setting {
    setters! {
        /// Sets the [budget](Self::budget).
        with_budget: Budget => budget,
        /// Sets [what a query takes over from the one before](Self::how).
        ///
        /// Box trees take every [`How`]. Sweeps and curves take `Fresh` and `Coherent`. Other
        /// structures take `Fresh`, and are asked so whatever is set.
        with_how: How => how,
    }

    /// Entries of a kept sweep unless told otherwise: 4 KiB. It keeps triangles in them from query
    /// to query. Answers about far points may end for lack of them.
    pub const SWEEP_ENTRIES: usize = 512;

    /// Splits of the refined hull: 8 KiB. Segments that need more are undecided.
    pub const SPLITS: usize = 500;

    /// Entries of scratch beside the refined hull, unless told otherwise. With fewer it answers
    /// too, more slowly.
    pub const BESIDE_SPLITS: usize = 64;

    /// Fresh queries of closest points, to the end, with enough scratch.
    #[must_use]
    pub const fn new(recipe: Recipe) -> Self {
        let question = Question::ClosestPoint;
        Self { question, recipe, budget: Budget::EXACT, how: How::Fresh, entries: None }
    }

    /// First hits of segments, to the end, with enough scratch. Box trees for segments and sweeps
    /// answer them, and the refined hull. A segment that starts inside its box goes to the sweep.
    #[must_use]
    pub const fn first_hit(recipe: Recipe) -> Self {
        Self { question: Question::FirstHit, ..Self::new(recipe) }
    }

    /// Sets the [scratch](Self::entries).
    #[must_use]
    pub const fn with_entries(self, entries: usize) -> Self {
        Self { entries: Some(entries), ..self }
    }

    /// The search whose costs it has. A field counts as a lattice here: see
    /// [`Row::search`](super::Row::search).
    #[must_use]
    pub const fn search(&self) -> Search {
        if matches!(self.question, Question::FirstHit) {
            return match self.recipe {
                Recipe::Sweep(_) | Recipe::CutLevel(_) => Search::FirstHitOfHull,
                Recipe::Hull(_) => Search::OuterHit,
                Recipe::SegmentTree(VertexBits::Auto | VertexBits::Grid16) => Search::FirstHit,
                _ => Search::FirstHitF32,
            };
        }
        match (self.recipe, self.how) {
            (Recipe::Curve(_), How::Coherent) => Search::KeptCurve,
            (Recipe::Curve(_), _) => match self.question {
                Question::Within(_) => Search::CurveWithin,
                Question::Signed => Search::CurveSigned,
                _ => Search::Curve,
            },
            (Recipe::Tree(_), How::Coherent) => Search::Coherent,
            (Recipe::Tree(_), How::Hinted) => Search::Hinted,
            (Recipe::Tree(_), How::Precise) => Search::Precise,
            (Recipe::Tree(VertexBits::Auto | VertexBits::Grid16), How::Fresh) => Search::Tree,
            (Recipe::Tree(_) | Recipe::SegmentTree(_), _) => Search::TreeF32,
            (Recipe::Sweep(_) | Recipe::Hull(_) | Recipe::CutLevel(_), How::Coherent) => {
                Search::KeptSweep
            }
            (Recipe::Sweep(_) | Recipe::Hull(_) | Recipe::CutLevel(_), _) => Search::Sweep,
            (Recipe::Tight(_), _) => Search::Tight,
            (Recipe::Triboxes(_), _) => Search::Triboxes,
            (Recipe::Sdf(_), _) => Search::Field,
            // Where the field is not enough.
            (Recipe::TreeWithSdf(_), _) => Search::Tree,
        }
    }

    /// Bytes of the processor's stack below the caller that a query takes at most, by board.
    #[must_use]
    pub fn stack(&self) -> [u32; 2] {
        let search = match self.search() {
            // A segment that starts in the hull's box is asked of the sweep, which takes more.
            Search::OuterHit => Search::FirstHitOfHull,
            search => search,
        };
        Board::ALL.map(|board| match self.recipe {
            Recipe::TreeWithSdf(_) => stack_bound("field-first bounds", board.name()),
            _ => search.stack(board),
        })
    }

    /// Whether queries of its kind were counted when the costs were fitted. Of other kinds the
    /// error of a prediction is unknown.
    #[must_use]
    pub const fn is_counted(&self) -> bool {
        let is_of_fit = match self.recipe {
            Recipe::Tree(bits) | Recipe::SegmentTree(bits) => !matches!(bits, VertexBits::Grid24),
            Recipe::Sweep(bits) | Recipe::Hull(bits) => matches!(bits, VertexBits::F32),
            Recipe::Tight(faces) => faces == 200,
            Recipe::Triboxes(count) => count == 64,
            Recipe::Sdf(_) | Recipe::Curve(_) => true,
            Recipe::CutLevel(_) | Recipe::TreeWithSdf(_) => false,
        };
        is_of_fit && self.entries.is_none()
    }

    /// The dials, in words.
    #[must_use]
    pub fn dials(&self) -> String {
        let mut words = Vec::new();
        match self.question {
            Question::Within(distance) => words.push(format!("within {distance}")),
            Question::Signed => words.push("signed".to_owned()),
            _ => {}
        }
        match self.how {
            How::Fresh => {}
            How::Hinted => words.push("from the last leaf".to_owned()),
            How::Coherent => words.push("coherent".to_owned()),
            How::Precise => words.push("precise".to_owned()),
        }
        let Budget { relative, absolute, steps, .. } = self.budget;
        if relative > 0.0 {
            words.push(format!("rel {relative}"));
        }
        if absolute > 0.0 {
            words.push(format!("abs {absolute}"));
        }
        if steps != u32::MAX {
            words.push(format!("steps {steps}"));
        }
        if let Some(entries) = self.entries {
            words.push(format!("scratch {entries}"));
        }
        let is_named = matches!(self.question, Question::Within(_) | Question::Signed);
        if words.len() == usize::from(is_named) {
            words.push("exact".to_owned());
        }
        words.join(", ")
    }
}

impl fmt::Display for Setting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.recipe.name(), self.dials())
    }
}

/// Faces of the tight hulls that are measured. Hulls have no more faces than the mesh, but for the
/// two coarsest.
const FACES: [u32; 7] = [20, 50, 100, 200, 500, 1000, 2000];

/// Bytes of the distance fields that are measured.
const FIELDS: [u32; 2] = [2 << 10, 8 << 10];

/// The settings that are measured by default, for a mesh of this diagonal and so many triangles.
/// Coherent queries are among them if the points are a path, or the caller's own.
#[must_use]
pub fn standard(diagonal: f64, triangles: usize, points: Option<Points>) -> Vec<Setting> {
    let exact = Budget::EXACT;
    let near = |part: f64| one_digit(part * diagonal);
    let tree = Setting::new(Recipe::Tree(VertexBits::Grid16));
    let fine = Setting::new(Recipe::Tree(VertexBits::F32));
    let mut all = vec![tree];
    all.extend([0.001, 0.01, 0.1].map(|part| tree.with_budget(exact.with_relative(part))));
    all.extend([0.001, 0.01].map(|part| tree.with_budget(exact.with_absolute(near(part)))));
    all.extend([4, 8, 16, 32].map(|steps| tree.with_budget(exact.with_steps(steps))));
    all.push(tree.with_entries(8));
    all.push(tree.with_how(How::Hinted));
    let moves = points != Some(Points::Far) && points != Some(Points::Near);
    if moves {
        all.push(tree.with_how(How::Coherent));
    }
    all.extend([fine, fine.with_budget(exact.with_relative(0.01))]);
    all.push(fine.with_budget(exact.with_steps(16)));
    all.push(fine.with_how(How::Precise));
    let faces = FACES.into_iter().filter(|&faces| faces as usize <= triangles.max(50));
    all.extend(faces.map(|faces| Setting::new(Recipe::Tight(faces))));
    if triangles >= 200 {
        let hull = Setting::new(Recipe::Tight(200));
        all.push(hull.with_budget(exact.with_relative(0.1)));
        all.extend([4, 8].map(|steps| hull.with_budget(exact.with_steps(steps))));
    }
    all.extend([8, 64].map(|count| Setting::new(Recipe::Triboxes(count))));
    all.extend(FIELDS.map(|bytes| Setting::new(Recipe::Sdf(bytes))));
    let both = Setting::new(Recipe::TreeWithSdf(FIELDS[1]));
    all.push(both.with_budget(exact.with_relative(0.1)));
    all.push(both.with_budget(exact.with_absolute(near(0.01))));
    all.extend([0.05, 0.01].map(|part| Setting::new(Recipe::CutLevel(near(part)))));
    let bits = [VertexBits::Grid16, VertexBits::Grid24, VertexBits::F32];
    all.extend(bits.map(|bits| Setting::new(Recipe::Sweep(bits))));
    let sweep = Setting::new(Recipe::Sweep(VertexBits::F32));
    all.extend([0.01, 0.05, 0.2].map(|part| sweep.with_budget(exact.with_relative(part))));
    all.extend([16, 64].map(|steps| sweep.with_budget(exact.with_steps(steps))));
    if moves {
        all.push(sweep.with_how(How::Coherent));
    }
    all
}

/// The settings that are measured by default for first hits of segments.
#[must_use]
pub fn standard_of_segments() -> Vec<Setting> {
    let exact = Budget::EXACT;
    let tree = Setting::first_hit(Recipe::SegmentTree(VertexBits::Grid16));
    let mut all = vec![tree];
    all.extend([4, 8, 16, 32].map(|steps| tree.with_budget(exact.with_steps(steps))));
    all.push(tree.with_entries(8));
    all.push(Setting::first_hit(Recipe::SegmentTree(VertexBits::F32)));
    let bits = [VertexBits::Grid16, VertexBits::Grid24, VertexBits::F32];
    let sweeps = bits.map(|bits| Setting::first_hit(Recipe::Sweep(bits)));
    all.extend(sweeps);
    all.extend([16, 64].map(|steps| sweeps[2].with_budget(exact.with_steps(steps))));
    all.push(Setting::first_hit(Recipe::Hull(VertexBits::F32)));
    all
}

/// The settings that are measured by default for curves of this diagonal; `is_fence` if they bound
/// an area. Kept searches are among them if the points are a path, or the caller's own.
#[must_use]
pub fn standard_of_curves(diagonal: f64, is_fence: bool, points: Option<Points>) -> Vec<Setting> {
    let exact = Budget::EXACT;
    let tolerant = || {
        let relative = [0.01, 0.1].map(|part| exact.with_relative(part));
        let absolute = [0.001, 0.01].map(|part| one_digit(part * diagonal));
        relative.into_iter().chain(absolute.map(|near| exact.with_absolute(near)))
    };
    let brief = || [4, 8, 16, 32].map(|steps| exact.with_steps(steps));
    let [coarse, fine] =
        [VertexBits::Grid16, VertexBits::F32].map(|bits| Setting::new(Recipe::Curve(bits)));
    let mut all = vec![coarse];
    all.extend(tolerant().chain(brief()).map(|budget| coarse.with_budget(budget)));
    all.push(fine);
    if points.is_none_or(|points| points == Points::Path) {
        let kept = coarse.with_how(How::Coherent);
        all.push(kept);
        all.extend(tolerant().chain(brief()).map(|budget| kept.with_budget(budget)));
        all.push(fine.with_how(How::Coherent));
    }
    for part in [0.003, 0.03] {
        let within = Setting { question: Question::Within(one_digit(part * diagonal)), ..coarse };
        all.push(within);
        all.extend(brief().map(|budget| within.with_budget(budget)));
    }
    if is_fence {
        let signed = Setting { question: Question::Signed, ..coarse };
        all.push(signed);
        all.extend(tolerant().chain(brief()).map(|budget| signed.with_budget(budget)));
        all.push(Setting { question: Question::Signed, ..fine });
    }
    all
}

/// A length with one digit.
fn one_digit(length: f64) -> f32 {
    format!("{length:.0e}").parse().unwrap_or(length as f32)
}
