//! A scene that remembers, from one question to the next, how far apart its pairs are.
//!
//! A pair keeps its clearance: how much farther than its distance it was proved to be. When models
//! have moved, their longest paths are taken off the clearances of all pairs, before any pair is
//! asked about: a `Yes` ends the question, and pairs not yet asked would miss the motion. A pair
//! with clearance left is clear. Every model also has a limit. While no path is longer than its
//! limit, every pair is clear, and no pair is looked at.

use super::pair::separation::search::SearchStart;
use super::pair::{MovingModel, PlacedModel};
use super::scene::PairSearch;
use crate::geom::Pose;
use crate::num::lesser;
use crate::num::tolerance::U32;
use crate::query::{Budget, Decided, QueryError, ScratchEntry, Undecided, Verdict, Work};

/// Two models of a [`CoherentScene`], and the distance that their surfaces are to keep.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct KeptPair {
    /// Indices into the models.
    pub models: [u16; 2],
    /// In the unit of the world.
    pub distance: f32,
}

/// Models that move little from one question to the next, and the pairs that are to keep a
/// distance. Pairs that are not in the list are never looked at.
///
/// RAM: 24 bytes for each pair; for each model a tree (some 200 bytes on a board) and some 140
/// bytes.
#[derive(Clone, Debug)]
pub struct CoherentScene<'a, const MODELS: usize, const PAIRS: usize> {
    models: [MovingModel<'a>; MODELS],
    paths: [ModelPath; MODELS],
    pairs: [RememberedPair; PAIRS],
    /// Questions since the motion was taken off the clearances.
    questions: u32,
    /// The pair that the last verdict other than `No` named.
    last_witness: usize,
}

/// A pair, and what is remembered of it.
#[derive(Clone, Copy, Debug)]
pub struct RememberedPair {
    kept: KeptPair,
    /// Proved clearance beyond the distance, less the motion that was taken off:
    /// [`ModelPath::moved`] is not. Nothing is proved unless it is above 0.
    left: f32,
    /// What the last search of the pair left to the next one.
    start: SearchStart,
}

impl RememberedPair {
    /// A pair of a scene of so many models, without memory.
    ///
    /// # Errors
    /// As [`CoherentScene::new`].
    pub fn new(kept: KeptPair, models: usize) -> Result<Self, QueryError> {
        let [a, b] = kept.models.map(usize::from);
        if a == b || a >= models || b >= models {
            return Err(QueryError::NoModel);
        }
        Budget::EXACT.with_absolute(kept.distance).check()?;
        Ok(RememberedPair { kept, left: 0.0, start: SearchStart::NONE })
    }
}

/// How far the points of a model went.
#[derive(Clone, Copy, Debug)]
pub struct ModelPath {
    /// The longest path of a point since motion was last taken off the clearances.
    moved: f32,
    /// While no model has a longer path than its limit, every pair is clear.
    limit: f32,
    /// The path that was taken off last.
    before: f32,
}

impl ModelPath {
    /// Nothing went anywhere, and nothing is proved.
    pub const NONE: ModelPath = ModelPath { moved: 0.0, limit: NO_LIMIT, before: 0.0 };
}

/// Every path is longer, so pairs are looked at.
const NO_LIMIT: f32 = -1.0;

/// Upper limit of [`Spent::times`], so that its product with a path stays in f32's range.
const MOST_TIMES: f32 = (1u64 << 60) as f32;

/// The pairs that used up their clearance.
struct Spent {
    /// The first one.
    first: usize,
    count: usize,
    /// How often all models may go as far as they went before, until a pair has no clearance left.
    times: f32,
}

/// How many of the last motions a proof by boxes is to outlast. No answer depends on it.
const MOTIONS_BY_BOXES: f32 = 16.0;

/// How many of the last motions a search looks beyond the distance. With fewer, pairs are searched
/// again sooner; with more, each search is longer. No verdict depends on it.
const MOTIONS_BY_SEARCH: f32 = 4.0;

impl<'a, const MODELS: usize, const PAIRS: usize> CoherentScene<'a, MODELS, PAIRS> {
    /// A scene without memory of earlier questions. Each model gets the
    /// [least ball](PlacedModel::with_least_ball).
    ///
    /// # Errors
    /// [`QueryError::NoModel`] if a pair names a model that there is not, or one twice;
    /// [`QueryError::Tolerance`] if a distance is negative, NaN or infinite.
    pub fn new(
        models: [PlacedModel<'a>; MODELS],
        pairs: [KeptPair; PAIRS],
    ) -> Result<Self, QueryError> {
        for kept in pairs {
            RememberedPair::new(kept, MODELS)?;
        }
        Ok(CoherentScene {
            models: models.map(MovingModel::new),
            paths: [ModelPath::NONE; MODELS],
            pairs: pairs.map(|kept| RememberedPair { kept, left: 0.0, start: SearchStart::NONE }),
            questions: 0,
            last_witness: 0,
        })
    }

    /// Moves a model to another pose. Models that stand still need no call. If the pose is refused,
    /// the model stays where it was. A matrix that changed little may be refused by the question
    /// that first looks at one of the model's pairs.
    ///
    /// Cost: some 60 operations in f32.
    ///
    /// # Errors
    /// [`QueryError::NoModel`], and those of [`PlacedModel::new`].
    pub fn move_to(&mut self, model: usize, pose: Pose) -> Result<(), QueryError> {
        self.erased().move_to(model, pose)
    }

    /// Whether the surfaces of any pair are at most the pair's distance apart.
    ///
    /// Verdict, witness and poses are as for [`Scene::within`](crate::Scene::within). If several
    /// pairs are too near, the witness may be another one of them. The verdict is the one without
    /// memory, except where either search reaches its limits, or the one without memory is undecided
    /// for resolution. It is about the poses of now: to cover the way to the next ones, add the
    /// longest path of a point of each of the two models to the distance. The bits depend on all
    /// questions before, and are the same on every target.
    ///
    /// `scratch`: [`Bvh::DISTANCE_ENTRIES`](crate::Bvh::DISTANCE_ENTRIES) are always enough. Of the
    /// budget only `steps` matters, those of all pairs together. The pair of the last verdict other
    /// than `No` comes first, then the others in their order. `work` counts the pairs that were
    /// looked at as `bounds`.
    ///
    /// Cost: one comparison for each model while no path is longer than its limit. Else ten
    /// operations for each pair with clearance left, and for the others as for
    /// [`Scene::within`](crate::Scene::within); a search looks farther than the distance by a few
    /// motions, so that it need not be repeated soon.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Bvh, CoherentScene, KeptPair, PlacedModel, Pose, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
    /// let (tree, mut scratch) = (Bvh::open(bytes)?, Scratch::<{ Bvh::DISTANCE_ENTRIES }>::new());
    /// let at = |x: f32| Pose { translation: [x, 0.0, 0.0], ..Pose::IDENTITY };
    /// let models = [PlacedModel::new(tree, at(0.0))?, PlacedModel::new(tree, at(300.0))?];
    /// let pairs = [KeptPair { models: [0, 1], distance: 20.0 }];
    /// let mut scene = CoherentScene::new(models, pairs)?;
    /// for step in 0..100 {
    ///     scene.move_to(1, at(300.0 - step as f32))?;
    ///     assert!(scene.within(Budget::EXACT, &mut scratch)?.is_clear());
    /// }
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`Scene::within`](crate::Scene::within).
    pub fn within(
        &mut self,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<Decided<[usize; 2]>, QueryError> {
        self.erased().within(budget, scratch)
    }

    /// Forgets all clearances.
    pub fn reset(&mut self) {
        self.erased().reset();
    }

    #[inline(always)]
    fn erased(&mut self) -> ErasedScene<'_, 'a> {
        let CoherentScene { models, paths, pairs, questions, last_witness } = self;
        ErasedScene { models, paths, pairs, questions, last_witness }
    }
}

/// A [`CoherentScene`] of any size. As one type, its questions are compiled once. The C interface
/// makes it of the caller's memory: `paths` has as many elements as `models`, and `questions` and
/// `last_witness` are 0 before the first question.
#[derive(Debug)]
#[allow(missing_docs, reason = "the fields of CoherentScene")]
pub struct ErasedScene<'q, 'a> {
    pub models: &'q mut [MovingModel<'a>],
    pub paths: &'q mut [ModelPath],
    pub pairs: &'q mut [RememberedPair],
    pub questions: &'q mut u32,
    pub last_witness: &'q mut usize,
}

impl ErasedScene<'_, '_> {
    /// As [`CoherentScene::move_to`].
    ///
    /// # Errors
    /// As there.
    #[inline(always)]
    pub fn move_to(self, model: usize, pose: Pose) -> Result<(), QueryError> {
        let mover = self.models.get_mut(model).ok_or(QueryError::NoModel)?;
        let step = mover.move_to(pose)?;
        let path = self.paths.get_mut(model).ok_or(QueryError::NoModel)?;
        path.moved = (path.moved + step) * (1.0 + 4.0 * U32);
        Ok(())
    }

    /// As [`CoherentScene::reset`].
    pub fn reset(self) {
        // By number: the end of an iterator of these would be a division without an instruction.
        for at in 0..self.pairs.len() {
            if let Some(pair) = self.pairs.get_mut(at) {
                (pair.left, pair.start) = (0.0, SearchStart::NONE);
            }
        }
        for at in 0..self.paths.len() {
            if let Some(path) = self.paths.get_mut(at) {
                path.limit = NO_LIMIT;
            }
        }
    }

    /// As [`CoherentScene::within`].
    ///
    /// # Errors
    /// As there.
    #[inline(never)]
    pub fn within(
        mut self,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<Decided<[usize; 2]>, QueryError> {
        budget.check_with(scratch)?;
        *self.questions = self.questions.saturating_add(1);
        // Most often no model went far enough. NaN keeps no limit.
        if self.paths.iter().all(|path| path.moved <= path.limit) {
            return Ok(Decided::CLEAR);
        }
        let mut spent = self.subtract_motion().ok_or(QueryError::Unchecked)?;
        let found = self.ask(&mut spent, budget, scratch)?;
        if found.is_clear() && spent.times >= f32::MIN_POSITIVE {
            // A path is 0 or at least 2^-50, so a product below f32's normal range is as good as 0.
            let times = spent.times * (1.0 - 16.0 * U32);
            self.paths.iter_mut().for_each(|path| path.limit = times * path.before);
        }
        Ok(found)
    }

    /// Takes the motion of both models off the clearance of every pair, before any is asked about.
    #[inline(always)]
    fn subtract_motion(&mut self) -> Option<Spent> {
        let mut spent = Spent { first: 0, count: 0, times: MOST_TIMES };
        for (at, RememberedPair { kept, left, .. }) in self.pairs.iter_mut().enumerate() {
            let moved = sum_of(self.paths, kept, |path| path.moved)?;
            *left = (*left - moved) * (1.0 - 4.0 * U32);
            // NaN is no clearance.
            if *left > 0.0 {
                spent.times = lesser(spent.times, *left / moved);
            } else {
                spent.first = if spent.count == 0 { at } else { spent.first };
                spent.count += 1;
            }
        }
        for path in self.paths.iter_mut() {
            *path = ModelPath { moved: 0.0, limit: NO_LIMIT, before: path.moved };
        }
        Some(spent)
    }

    /// Asks about the pairs without clearance, the one that was named last first.
    #[inline(always)]
    fn ask(
        &mut self,
        spent: &mut Spent,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<Decided<[usize; 2]>, QueryError> {
        let mut work = Work::NONE;
        let mut undecided: Option<(Undecided, [usize; 2])> = None;
        let questions = *self.questions as f32;
        *self.questions = 0;
        let last = *self.last_witness;
        let (mut at, mut next) = (last, spent.first);
        while spent.count > 0 && at < self.pairs.len() {
            if let Some(pair) = self.pairs.get_mut(at)
                && !has_clearance(pair)
            {
                spent.count -= 1;
                work.bounds = work.bounds.saturating_add(1);
                let kept = pair.kept;
                let witness = kept.models.map(usize::from);
                for index in witness {
                    self.models.get_mut(index).ok_or(QueryError::Unchecked)?.place()?;
                }
                let moved = sum_of(self.paths, &kept, |path| path.before);
                let moved = moved.ok_or(QueryError::Unchecked)?;
                let memory = (&mut pair.start, &mut *scratch);
                let asked = (&kept, moved / questions);
                let (verdict, left) = clearance(self.models, asked, budget, memory, &mut work)?;
                pair.left = left;
                spent.times = lesser(spent.times, left / moved);
                match verdict {
                    Verdict::Yes => {
                        *self.last_witness = at;
                        return Ok(Decided { verdict, witness: Some(witness), work });
                    }
                    Verdict::Undecided(why) if undecided.is_none() => {
                        *self.last_witness = at;
                        undecided = Some((why, witness));
                    }
                    _ => {}
                }
            }
            // The first one is not asked twice.
            at = if next == last { next.wrapping_add(1) } else { next };
            next = at.wrapping_add(1);
        }
        Ok(match undecided {
            Some((why, pair)) => {
                Decided { verdict: Verdict::Undecided(why), witness: Some(pair), work }
            }
            None => Decided { verdict: Verdict::No, witness: None, work },
        })
    }
}

/// NaN is no clearance.
#[inline(always)]
fn has_clearance(pair: &RememberedPair) -> bool {
    pair.left > 0.0
}

/// The paths of both models together. Either has room for the rounding of the sum.
#[inline(always)]
fn sum_of(paths: &[ModelPath], kept: &KeptPair, of: impl Fn(&ModelPath) -> f32) -> Option<f32> {
    let [a, b] = kept.models;
    Some(of(paths.get(usize::from(a))?) + of(paths.get(usize::from(b))?))
}

/// Whether a pair is nearer than its distance. If it is not, a proved clearance. Both models are
/// placed. `moved`: how far both go from one question to the next.
#[inline(always)]
fn clearance(
    models: &[MovingModel<'_>],
    (kept, moved): (&KeptPair, f32),
    budget: Budget,
    (start, scratch): (&mut SearchStart, &mut [ScratchEntry]),
    work: &mut Work,
) -> Result<(Verdict, f32), QueryError> {
    let [a, b] = kept.models.map(|index| models.get(usize::from(index)));
    let (a, b) = (a.ok_or(QueryError::Unchecked)?, b.ok_or(QueryError::Unchecked)?);
    let (one, other) = (&a.model, &b.model);
    let distance = kept.distance;
    // A pair that moves fast gains nothing by looking farther.
    let moved = if MOTIONS_BY_SEARCH * moved < distance { moved } else { 0.0 };
    let beyond = |motions: f32| lesser(motions * moved, distance);
    let more = beyond(MOTIONS_BY_BOXES);
    if let Some(proof) = one.apart(other, distance, more) {
        let left = (proof.gap() - distance) * (1.0 - 4.0 * U32);
        // The quick root may lose more than was proved.
        let left = if left <= 0.0 { proof.sharp_clearance(distance) } else { left };
        return Ok((Verdict::No, left));
    }
    let search = PairSearch { models: [one, other], distance, more: beyond(MOTIONS_BY_SEARCH) };
    let (verdict, left) = search.are_near(budget, start, scratch, work)?;
    // What is infinite would never be used up.
    let is_kept = verdict == Verdict::No && left < f32::INFINITY;
    Ok((verdict, if is_kept { left } else { 0.0 }))
}
