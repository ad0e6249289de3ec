//! A scene that remembers, from one question to the next, how far apart its pairs are.
//!
//! A pair keeps the clearance that was proved beyond its distance. Whatever moves takes the longest
//! path of its points off the clearance of all its pairs, before any pair is asked about: an answer
//! may end the question early. A pair with clearance left is clear.

use super::pair::separation::search::SearchStart;
use super::pair::{MovingModel, PlacedModel};
use super::scene::PairSearch;
use crate::geom::Pose;
use crate::num::tolerance::U32;
use crate::num::{greater, lesser};
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
    /// No point of each model went farther since the clearances were written.
    moved: [f32; MODELS],
    pairs: [RememberedPair; PAIRS],
    /// No pair had less clearance when they were written.
    least: f32,
    /// The pair that the last question ended with.
    last: usize,
}

/// A pair, and what is remembered of it.
#[derive(Clone, Copy, Debug)]
pub struct RememberedPair {
    kept: KeptPair,
    /// Proved clearance beyond the distance, less all motion since. Nothing is proved unless it is
    /// above 0.
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

/// How many of the last motions a proof by boxes is to outlast. No answer depends on it.
const MOTIONS_BY_BOXES: f32 = 16.0;

/// How many of the last motions a search looks beyond the distance. Measured by a prototype on an
/// arm: less is searched again too soon, more makes each search longer. No answer depends on it.
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
            moved: [0.0; MODELS],
            pairs: pairs.map(|kept| RememberedPair { kept, left: 0.0, start: SearchStart::NONE }),
            least: 0.0,
            last: 0,
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
    /// budget only `steps` matters, those of all pairs together. The pair that ended the last
    /// question comes first, then the others in their order. `work` counts the pairs that were
    /// looked at as `bounds`.
    ///
    /// Cost: ten operations for each pair whose clearance outlasted the motion. Otherwise as for
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
        let CoherentScene { models, moved, pairs, least, last } = self;
        ErasedScene { models, moved, pairs, least, last }
    }
}

/// A [`CoherentScene`] of any size. As one type, its questions are compiled once. The C interface
/// makes it of the caller's memory: `moved` has as many elements as `models`, and these, `least` and
/// `last` are 0 before the first question.
#[derive(Debug)]
#[allow(missing_docs, reason = "the fields of CoherentScene")]
pub struct ErasedScene<'q, 'a> {
    pub models: &'q mut [MovingModel<'a>],
    pub moved: &'q mut [f32],
    pub pairs: &'q mut [RememberedPair],
    pub least: &'q mut f32,
    pub last: &'q mut usize,
}

impl ErasedScene<'_, '_> {
    /// As [`CoherentScene::move_to`].
    ///
    /// # Errors
    /// As there.
    #[inline(always)]
    pub fn move_to(self, model: usize, pose: Pose) -> Result<(), QueryError> {
        let mover = self.models.get_mut(model).ok_or(QueryError::NoModel)?;
        let path = mover.move_to(pose)?;
        let moved = self.moved.get_mut(model).ok_or(QueryError::NoModel)?;
        *moved = (*moved + path) * (1.0 + 4.0 * U32);
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
        *self.least = 0.0;
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
        // NaN is not clear.
        let is_clear = |pair: &RememberedPair| {
            moved(self.moved, &pair.kept).is_some_and(|moved| pair.left > moved)
        };
        // Most often no pair can have used up the least clearance of all.
        let most = self.moved.iter().fold(0.0, |most, &moved| greater(most, moved));
        if *self.least > 2.0 * most || self.pairs.iter().all(is_clear) {
            return Ok(Decided::CLEAR);
        }
        *self.least = 0.0;
        self.subtract_motion().ok_or(QueryError::Unchecked)?;
        let found = self.ask(budget, scratch)?;
        if found.is_clear() {
            let left = |least: f32, pair: &RememberedPair| lesser(least, pair.left);
            *self.least = self.pairs.iter().fold(f32::INFINITY, left);
        }
        Ok(found)
    }

    /// Takes the motion of both models off the clearance of every pair, before any is asked about.
    fn subtract_motion(&mut self) -> Option<()> {
        for RememberedPair { kept, left, .. } in self.pairs.iter_mut() {
            *left = (*left - moved(self.moved, kept)?) * (1.0 - 4.0 * U32);
        }
        self.moved.iter_mut().for_each(|moved| *moved = 0.0);
        Some(())
    }

    fn ask(
        &mut self,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<Decided<[usize; 2]>, QueryError> {
        let mut work = Work::NONE;
        let mut undecided: Option<(Undecided, [usize; 2])> = None;
        let last = *self.last;
        let others = (0..self.pairs.len()).filter(|&at| at != last);
        for at in (last..last.saturating_add(1)).chain(others) {
            let Some(pair) = self.pairs.get_mut(at) else { continue };
            if pair.left > 0.0 {
                continue;
            }
            work.bounds = work.bounds.saturating_add(1);
            let kept = pair.kept;
            let witness = kept.models.map(usize::from);
            for index in witness {
                self.models.get_mut(index).ok_or(QueryError::Unchecked)?.place()?;
            }
            let memory = (&mut pair.start, &mut *scratch);
            let (verdict, left) = clearance(self.models, &kept, budget, memory, &mut work)?;
            pair.left = left;
            match verdict {
                Verdict::Yes => {
                    *self.last = at;
                    return Ok(Decided { verdict, witness: Some(witness), work });
                }
                Verdict::Undecided(why) if undecided.is_none() => {
                    *self.last = at;
                    undecided = Some((why, witness));
                }
                _ => {}
            }
        }
        Ok(match undecided {
            Some((why, pair)) => {
                Decided { verdict: Verdict::Undecided(why), witness: Some(pair), work }
            }
            None => Decided { verdict: Verdict::No, witness: None, work },
        })
    }
}

/// The paths of both models together. Either has room for the rounding of the sum.
#[inline(always)]
fn moved(moved: &[f32], kept: &KeptPair) -> Option<f32> {
    let [a, b] = kept.models;
    Some(moved.get(usize::from(a))? + moved.get(usize::from(b))?)
}

/// Whether a pair is nearer than its distance; if not, a proved clearance. Both are placed.
fn clearance(
    models: &[MovingModel<'_>],
    kept: &KeptPair,
    budget: Budget,
    (start, scratch): (&mut SearchStart, &mut [ScratchEntry]),
    work: &mut Work,
) -> Result<(Verdict, f32), QueryError> {
    let [a, b] = kept.models.map(|index| models.get(usize::from(index)));
    let (a, b) = (a.ok_or(QueryError::Unchecked)?, b.ok_or(QueryError::Unchecked)?);
    let (one, other, moved) = (&a.model, &b.model, a.step + b.step);
    let distance = kept.distance;
    // A pair that moves fast gains nothing by looking farther.
    let moved = if MOTIONS_BY_SEARCH * moved < distance { moved } else { 0.0 };
    let beyond = |motions: f32| lesser(motions * moved, distance);
    let mut proof = one.apart(other, distance + beyond(MOTIONS_BY_BOXES));
    if proof.is_none() && moved > 0.0 {
        proof = one.apart(other, distance);
    }
    if let Some(proof) = proof {
        return Ok((Verdict::No, (proof.gap() - distance) * (1.0 - 4.0 * U32)));
    }
    let search = PairSearch { models: [one, other], distance, more: beyond(MOTIONS_BY_SEARCH) };
    let (verdict, left) = search.are_near(budget, start, scratch, work)?;
    // What is infinite would never be used up.
    let is_kept = verdict == Verdict::No && left < f32::INFINITY;
    Ok((verdict, if is_kept { left } else { 0.0 }))
}
