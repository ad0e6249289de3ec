//! Rows: each setting with its errors and costs, and which of them nothing else beats.

use super::ask::{Answer, Asked, ask};
use super::blobs::{NotBuilt, build_group};
use super::cost::{Board, Cost, Search};
use super::field;
use super::fitted::cost as fitted_cost;
use super::points::segments_of_curves;
use super::setting::{Question, Setting};
use super::truth::Truth;
use crate::builder::{Builder, Built, Recipe};
use crate::curve::Polyline;
use crate::load::{Loaded, Source};
use crate::mesh::Mesh;
use glam::DVec3;
use meshsweep_core::{QueryError, SdfLayout};
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Part of the triangles that are needles from which on predicted instructions are doubtful.
pub const MANY_NEEDLES: f64 = 0.1;

/// How many times the predicted instructions a comb of needles takes, on the boards of
/// [`Board::ALL`]. `cargo xtask fit` prints the share that is not predicted.
pub const COMB_OF_NEEDLES: [f64; 2] = [2.2, 4.5];

/// Of all queries the largest value and the median.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// The largest.
    pub most: f64,
    /// Half of the queries have no more.
    pub median: f64,
}

impl Spread {
    /// `None` without values.
    fn of(mut values: Vec<f64>) -> Option<Self> {
        values.sort_by(f64::total_cmp);
        let median = *values.get(values.len() / 2)?;
        values.last().map(|&most| Self { most, median })
    }
}

/// Predicted instructions of a board.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instructions {
    /// Of a mean query.
    pub mean: f64,
    /// Of the costliest one. Of a distance field alone: of any point.
    pub most: f64,
    /// Factor by which the costliest query may be costlier:
    /// [`Cost::missed_by`](super::Cost::missed_by), of a mesh of [many needles](MANY_NEEDLES) times
    /// that of [`COMB_OF_NEEDLES`].
    pub missed_by: f64,
    /// Largest relative error of a mean: [`Cost::error`](super::Cost::error).
    pub error: f64,
    /// The median of these errors on meshes that the fit has not seen.
    pub typical: f64,
}

impl Instructions {
    /// Of queries whose instructions a cost predicts.
    pub(super) fn of(cost: &Cost, all: &[f64]) -> Self {
        Self {
            mean: all.iter().sum::<f64>() / all.len() as f64,
            most: all.iter().copied().fold(0.0, f64::max),
            missed_by: cost.missed_by,
            error: cost.error,
            typical: cost.typical,
        }
    }

    /// Where a query asks a second search too, takes its errors if they are larger.
    fn take_larger_errors(&mut self, other: &Cost) {
        self.missed_by = self.missed_by.max(other.missed_by);
        self.error = self.error.max(other.error);
        self.typical = self.typical.max(other.typical);
    }

    /// Of the costliest query, with what the fit missed at most.
    #[must_use]
    pub fn at_most(&self) -> f64 {
        self.most * self.missed_by
    }
}

/// A setting, its errors and its costs. Lengths are in the mesh's unit.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Row {
    /// The setting.
    pub setting: Setting,
    /// The search whose costs it has. A field is known to be a tree or a lattice once it is built.
    pub search: Search,
    /// Width of the interval. `None` if the structure gives a lower bound only.
    pub guaranteed: Option<Spread>,
    /// The distance or free length in f64, less the lower end: the error of a caller that must keep
    /// clear.
    pub found_lower: Spread,
    /// The upper end, less it. `None` without an upper end.
    pub found_upper: Option<Spread>,
    /// Segments that are proved neither clear nor to meet the mesh; verdicts and sides that are
    /// undecided. 0 of closest points.
    pub undecided: usize,
    /// Of a mean query on this machine, on one thread. A box tree is searched in the order that is
    /// fastest here.
    pub nanoseconds: f64,
    /// Predicted, in the order of [`Board::ALL`]; `None` if no cost was fitted.
    pub boards: [Option<Instructions>; 2],
    /// Bytes of the processor's stack below the caller, at most, by board.
    pub stack: [u32; 2],
    /// Of a distance field, alone or before a box tree, how it lies in its bytes.
    pub layout: Option<SdfLayout>,
    /// Of a cut hierarchy the level that is left as the finest.
    pub level: Option<u32>,
    /// Bytes of the blob.
    pub flash: usize,
    /// Bytes of scratch, and of memory that is kept between queries.
    pub scratch: usize,
    /// Nodes, triangles, exact evaluations and splits of a mean query. Of a field alone the nodes
    /// are entries of its tree, or 0.
    pub work: [f64; 4],
    /// The part of the queries that the field answered alone, of a box tree with a field.
    pub by_field: Option<f64>,
}

impl Row {
    /// The structure and its size in words, with the layout of a field.
    #[must_use]
    pub fn name(&self) -> String {
        let name = self.setting.recipe.name();
        self.layout.map_or_else(|| name.clone(), |layout| format!("{name}, {}", layout.name()))
    }

    /// The options with which the program builds the blob; of a cut level also those of `cut`.
    #[must_use]
    pub fn build(&self) -> String {
        let recipe = self.setting.recipe;
        self.level.map_or_else(|| recipe.to_string(), |level| format!("{recipe} {level}"))
    }

    /// The row of a mesh of which so large a part are needles.
    fn of_needles(mut self, part: f64) -> Self {
        if part >= MANY_NEEDLES {
            let known = self.boards.iter_mut().zip(COMB_OF_NEEDLES);
            known.for_each(|(board, times)| {
                if let Some(board) = board {
                    board.missed_by *= times;
                }
            });
        }
        self
    }

    /// The widest of the intervals; infinite if the structure gives a lower bound only.
    #[must_use]
    pub fn error(&self) -> f64 {
        self.guaranteed.map_or(f64::INFINITY, |spread| spread.most)
    }

    /// What settings are compared by: the widest measured interval, the mean instructions of a
    /// Cortex-M4F, and the bytes of flash. `None` without an interval or a cost.
    fn measures(&self) -> Option<[f64; 3]> {
        let [m4f, _] = self.boards;
        Some([self.guaranteed?.most, m4f?.mean, self.flash as f64])
    }
}

/// A recipe that was not built, and why.
#[derive(Clone, Debug, PartialEq)]
pub struct Missing {
    /// Its recipe.
    pub recipe: Recipe,
    /// Why.
    pub reason: NotBuilt,
}

/// The rows of a measurement, and the recipes that were not built.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Trade {
    /// In the order of the settings.
    pub rows: Vec<Row>,
    /// Recipes that the mesh does not allow.
    pub missing: Vec<Missing>,
    /// The part of the triangles that are needles: fifty times as long as high, or more. Their
    /// bounds are refined, which no counter tells, so more instructions are needed than predicted.
    pub needles: f64,
    /// The blobs of the recipes.
    pub blobs: Vec<(Recipe, Built)>,
}

impl Trade {
    /// The blob of a recipe, if it was built.
    #[must_use]
    pub fn blob(&self, recipe: Recipe) -> Option<&[u8]> {
        let found = self.blobs.iter().find(|(of, _)| *of == recipe);
        found.map(|(_, built)| built.bytes())
    }
}

/// Measures each setting on a mesh.
///
/// `source` is the file, `repaired` the mesh that was made of it. `points` are in the mesh's unit;
/// each query takes [`Question::points`](super::Question::points) of them in a row. Without points
/// there are no rows. A recipe that cannot be built is in [`Trade::missing`]. `progress(done, all)`
/// is called from any thread.
///
/// Cost: a build for each recipe, on all cores; each query twice for each setting, and once against
/// all triangles in f64.
///
/// # Errors
/// A point that is not finite, and a setting whose structure does not serve its question.
pub fn measure(
    source: &Source,
    repaired: &Loaded,
    points: &[[f32; 3]],
    settings: &[Setting],
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<Trade, QueryError> {
    let recipes = recipes_of(settings);
    let (done, of) = (AtomicUsize::new(0), recipes.len() + settings.len());
    let step = || progress(done.fetch_add(1, Ordering::Relaxed) + 1, of);
    let truth = Truth::of(&repaired.mesh);
    let is_cut = |recipe: &Recipe| matches!(recipe, Recipe::CutLevel(_));
    let (cut, others): (Vec<Recipe>, Vec<Recipe>) = recipes.into_iter().partition(is_cut);
    let mut groups: Vec<Vec<Recipe>> = others.into_iter().map(|other| vec![other]).collect();
    groups.push(cut);
    let build = |group: &Vec<Recipe>| {
        let all = build_group(group, source, repaired);
        group.iter().for_each(|_| step());
        group.iter().copied().zip(all).collect::<Vec<_>>()
    };
    // The last ones take longest.
    let built = groups.par_iter().rev().with_max_len(1).flat_map_iter(build);
    let built: Vec<(Recipe, Result<Built, NotBuilt>)> = built.collect();
    let needles = needles(&repaired.mesh);
    let mut trade = Trade { rows: Vec::new(), missing: Vec::new(), needles, blobs: Vec::new() };
    for (recipe, result) in built.into_iter().rev() {
        match result {
            Ok(built) => trade.blobs.push((recipe, built)),
            Err(reason) => trade.missing.push(Missing { recipe, reason }),
        }
    }
    add_rows(&mut trade, points, settings, &truth, &step)?;
    Ok(trade)
}

/// Measures each setting on curves; its recipe is [`Recipe::Curve`].
///
/// As [`measure`]. Signed distances are asked of the points' x and y.
///
/// # Errors
/// A point that is not finite, and [`Question::Signed`] of curves that bound no area.
pub fn measure_curves(
    polylines: &[Polyline],
    points: &[[f32; 3]],
    settings: &[Setting],
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<Trade, QueryError> {
    let recipes = recipes_of(settings);
    let (done, of) = (AtomicUsize::new(0), recipes.len() + settings.len());
    let step = || progress(done.fetch_add(1, Ordering::Relaxed) + 1, of);
    let mut trade =
        Trade { rows: Vec::new(), missing: Vec::new(), needles: 0.0, blobs: Vec::new() };
    for recipe in recipes {
        match Builder::of(recipe).build_curves(polylines) {
            Ok(built) => trade.blobs.push((recipe, built)),
            Err(error) => trade.missing.push(Missing { recipe, reason: error.into() }),
        }
        step();
    }
    let truth = Truth::of_triangles(segments_of_curves(polylines));
    add_rows(&mut trade, points, settings, &truth, &step)?;
    Ok(trade)
}

fn recipes_of(settings: &[Setting]) -> Vec<Recipe> {
    let mut recipes: Vec<Recipe> = Vec::new();
    for setting in settings {
        if !recipes.contains(&setting.recipe) {
            recipes.push(setting.recipe);
        }
    }
    recipes
}

/// Asks the blobs at hand by each setting, and compares with the truth.
fn add_rows(
    trade: &mut Trade,
    points: &[[f32; 3]],
    settings: &[Setting],
    truth: &Truth,
    step: &dyn Fn(),
) -> Result<(), QueryError> {
    let [mut distances, mut free, mut flat] = [const { None::<Vec<f64>> }; 3];
    for setting in settings {
        if let Some((_, built)) = trade.blobs.iter().find(|(of, _)| *of == setting.recipe) {
            let asked = ask(setting, built.bytes(), points)?;
            let truths = match setting.question {
                Question::ClosestPoint | Question::Within(_) => {
                    distances.get_or_insert_with(|| truth.distances(points))
                }
                Question::Signed => flat.get_or_insert_with(|| truth.distances_in_plane(points)),
                Question::FirstHit => free.get_or_insert_with(|| truth.free_lengths(points)),
            };
            let row = row(*setting, built, &asked, truths);
            trade.rows.extend(row.map(|row| row.of_needles(trade.needles)));
        }
        step();
    }
    Ok(())
}

/// The distances of points from a mesh, in f64, from all of its triangles.
#[must_use]
pub fn distances(mesh: &Mesh, points: &[[f32; 3]]) -> Vec<f64> {
    Truth::of(mesh).distances(points)
}

/// Length over height from which on a triangle is a needle.
const NEEDLE: f64 = 50.0;

fn needles(mesh: &Mesh) -> f64 {
    let is_needle = |[a, b, c]: [DVec3; 3]| {
        let longest = (b - a).length_squared().max((c - b).length_squared());
        let longest = longest.max((a - c).length_squared());
        longest >= NEEDLE * (b - a).cross(c - a).length()
    };
    let count = mesh.corners_f64().filter(|&corners| is_needle(corners)).count();
    count as f64 / mesh.triangles.len().max(1) as f64
}

fn row(setting: Setting, built: &Built, asked: &Asked, truths: &[f64]) -> Option<Row> {
    let Asked { answers, nanoseconds, scratch } = asked;
    let lower = |i: usize| answers[i].lower;
    let upper = |i: usize| answers[i].upper;
    let each = |of: &dyn Fn(usize) -> f64| Spread::of((0..answers.len()).map(of).collect());
    let is_bounded = answers.iter().all(|answer| answer.upper.is_finite());
    let blob = built.blob();
    let field = blob.sdf().ok();
    let is_of_both = matches!(setting.recipe, Recipe::TreeWithSdf(_));
    let search = match (setting.search(), field) {
        (Search::Field, Some(of)) => Search::of_field(&of),
        (search, _) => search,
    };
    let boards = Board::ALL.map(|board| {
        let cost = fitted_cost(board, search)?;
        let of = |answer: &Answer| {
            let searched = answer.features.as_ref().map_or(0.0, |features| cost.of(features));
            let Some((search, features)) = &answer.beside else { return Some(searched) };
            Some(searched + fitted_cost(board, *search)?.of(features))
        };
        let all: Vec<f64> = answers.iter().map(of).collect::<Option<_>>()?;
        let mut found = Instructions::of(cost, &all);
        if let Some((search, _)) = answers.iter().find_map(|answer| answer.beside) {
            found.take_larger_errors(fitted_cost(board, search)?);
        }
        if let (Search::Field | Search::FieldTree, Some(of)) = (search, field) {
            found.most = field::most(board, &of);
        }
        Some(found)
    });
    let mean = |feature: usize| {
        // The look-up of a field before a box tree counts apart.
        let beside = |answer: &Answer| answer.beside.filter(|_| !is_of_both);
        let of = |answer: &Answer| {
            let all = answer.features.into_iter().chain(beside(answer).map(|(_, of)| of));
            all.map(|features| features[feature]).sum::<f64>()
        };
        answers.iter().map(of).sum::<f64>() / answers.len() as f64
    };
    let part = |is: fn(&Answer) -> bool| {
        answers.iter().filter(|answer| is(answer)).count() as f64 / answers.len().max(1) as f64
    };
    Some(Row {
        setting,
        search,
        guaranteed: each(&|i| upper(i) - lower(i)).filter(|_| is_bounded),
        found_lower: each(&|i| (truths[i] - lower(i)).max(0.0))?,
        found_upper: each(&|i| (upper(i) - truths[i]).max(0.0)).filter(|_| is_bounded),
        undecided: answers.iter().filter(|answer| answer.is_undecided).count(),
        nanoseconds: *nanoseconds,
        boards,
        stack: setting.stack(),
        layout: field.map(|of| of.layout()),
        level: built.cut_level(),
        flash: built.bytes().len(),
        scratch: *scratch,
        work: [2, 3, 4, 5].map(mean),
        by_field: is_of_both.then(|| part(|answer| answer.features.is_none())),
    })
}

/// The rows that nothing else beats, by their index: no other one has a smaller or equal guaranteed
/// error, fewer or as many instructions of a Cortex-M4F, and less or as much flash, and is better
/// in one of them. From the smallest error on. Of equal rows the first.
#[must_use]
pub fn pareto(rows: &[Row]) -> Vec<usize> {
    let all: Vec<(usize, [f64; 3])> =
        rows.iter().enumerate().filter_map(|(i, row)| Some((i, row.measures()?))).collect();
    let beats = |(i, a): &(usize, [f64; 3]), (j, b): &(usize, [f64; 3])| {
        a.iter().zip(b).all(|(a, b)| a <= b) && (a != b || i < j)
    };
    let mut best: Vec<_> =
        all.iter().filter(|one| !all.iter().any(|other| beats(other, one))).collect();
    best.sort_by(|(_, a), (_, b)| a[0].total_cmp(&b[0]));
    best.into_iter().map(|&(index, _)| index).collect()
}
