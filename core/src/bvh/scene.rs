//! A scene: a few dozen models, each at its place.
//!
//! Pairs are looked at one after the other: a scene needs no memory of its own. The boxes in the
//! world leave few pairs for the trees.

use crate::bvh::pair::placed_model::PlacedModel;
use crate::bvh::pair::placed_pair::PlacedPair;
use crate::bvh::pair::separation::grid_pose::GridPose;
use crate::bvh::pair::separation::search::{PairVerdict, SearchStart, separation};
use crate::bvh::pair::world_box::WorldBox;
use crate::num::tolerance::U32;
use crate::num::{greater, lesser};
use crate::query::{
    Budget, Decided, Ended, Interval, QueryError, ScratchEntry, Undecided, Verdict, Work,
};

/// Models at their places in the world. A model may stand in it several times.
#[derive(Clone, Copy, Debug)]
pub struct Scene<'s, 'a> {
    models: &'s [PlacedModel<'a>],
}

/// The nearest pair of models of a [`Scene`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct SceneDistance {
    /// The least distance of two surfaces, of all pairs asked about. From 0 to infinity if there is
    /// no pair.
    pub distance: Interval,
    /// The pair whose distance has the least upper end: indices into the models. `None` if there is
    /// no pair; then the numbers below are 0.
    pub models: Option<[usize; 2]>,
    /// A point of the surface of either model, nearest to each other, in the world and rounded to
    /// f32.
    pub points: [[f32; 3]; 2],
    /// The triangles of these points, by their numbers in the input files.
    pub triangles: [u32; 2],
    /// The work of all pairs, as in [`PairDistance::work`](crate::PairDistance::work). Pairs of
    /// models whose boxes were compared count as `bounds`.
    pub work: Work,
    /// Why the search ended.
    pub ended: Ended,
}

impl<'s, 'a> Scene<'s, 'a> {
    /// The scene of these models.
    pub const fn new(models: &'s [PlacedModel<'a>]) -> Self {
        Scene { models }
    }

    /// The pair of models whose surfaces are nearest, and their distance in the world.
    ///
    /// Only pairs for which `asks_about` is true count, the lesser index first. It is called twice
    /// a pair. Leave out neighbours that always touch. Lengths are in the unit of the world, which
    /// all models share. The poses' numbers are taken as exact. Only surfaces count, and each pair
    /// is as for [`Bvh::distance_to`](crate::Bvh::distance_to). Surfaces that meet have a distance
    /// from 0, and an upper end of a few roundings, because the pose of one model in the frame of
    /// the other is rounded.
    ///
    /// `scratch`: [`Bvh::DISTANCE_ENTRIES`](crate::Bvh::DISTANCE_ENTRIES) are always enough. The
    /// steps (pairs of nodes) of the budget are those of all pairs together. Pairs for which no
    /// steps are left are bounded by their boxes. The tolerances apply to each pair's
    /// distance.
    ///
    /// Cost: some hundred operations in f32 for each pair of models, twice. A distance for each
    /// pair whose boxes are nearer than the nearest pair so far, which begins with the nearest
    /// boxes.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Bvh, PlacedModel, Pose, Scene, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
    /// let (tree, mut scratch) = (Bvh::open(bytes)?, Scratch::<{ Bvh::DISTANCE_ENTRIES }>::new());
    /// let at = |x: f32| Pose { translation: [x, 0.0, 0.0], ..Pose::IDENTITY };
    /// let placed = |x: f32| PlacedModel::new(tree, at(x));
    /// let models = [placed(0.0)?, placed(300.0)?, placed(500.0)?];
    /// let near = Scene::new(&models).nearest_pair(|_, _| true, Budget::EXACT, &mut scratch)?;
    /// assert_eq!(near.models, Some([1, 2]));
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`Bvh::distance_to`](crate::Bvh::distance_to); [`QueryError::OutOfDomain`] if two
    /// models are farther from each other than f32 reaches.
    #[inline(never)]
    pub fn nearest_pair(
        &self,
        asks_about: impl Fn(usize, usize) -> bool,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<SceneDistance, QueryError> {
        budget.check_with(scratch)?;
        let mut search = NearestPair {
            models: self.models,
            budget,
            scratch,
            lower: f32::INFINITY,
            found: SceneDistance {
                distance: Interval::new(0.0, f32::INFINITY),
                models: None,
                points: [[0.0; 3]; 2],
                triangles: [0; 2],
                work: Work::default(),
                ended: Ended::Exact,
            },
        };
        let least = |one: ([usize; 2], f32), other: ([usize; 2], f32)| {
            if other.1 < one.1 { other } else { one }
        };
        let Some((begun, gap)) = self.gaps(&asks_about).reduce(least) else {
            return Ok(search.found);
        };
        search.measure(begun, gap)?;
        for (pair, gap) in self.gaps(&asks_about) {
            let work = &mut search.found.work;
            work.bounds = work.bounds.saturating_add(1);
            if pair != begun && gap < search.found.distance.upper {
                search.measure(pair, gap)?;
            }
        }
        search.found.distance.lower = lesser(search.lower, search.found.distance.upper);
        Ok(search.found)
    }

    /// Whether the surfaces of any two models are at most `distance` apart in the world.
    ///
    /// Pairs, units and poses as for [`nearest_pair`](Self::nearest_pair). Both verdicts are
    /// proved. It ends at the first pair that certainly is. The witness of a `Yes` is this pair,
    /// indices into the models; that of an undecided verdict is the first undecided pair. A
    /// distance of 0 asks whether surfaces meet; it is answered by `No` or left undecided, because
    /// poses are rounded: take an undecided answer as `Yes`.
    ///
    /// `scratch`: [`Bvh::DISTANCE_ENTRIES`](crate::Bvh::DISTANCE_ENTRIES) are always enough. Of the
    /// budget only `steps` matters, those of all pairs together. Each pair that is searched takes
    /// one step at least, so the steps bound the time.
    ///
    /// Cost: 30 operations in f32 for a pair whose balls are apart, some 200 for one whose boxes
    /// are, and a [`Bvh::within_of`](crate::Bvh::within_of) for each other one.
    ///
    /// # Errors
    /// Those of [`nearest_pair`](Self::nearest_pair); [`QueryError::Tolerance`] also for a distance
    /// that is negative, NaN or infinite.
    #[inline(never)]
    pub fn within(
        &self,
        distance: f32,
        asks_about: impl Fn(usize, usize) -> bool,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<Decided<[usize; 2]>, QueryError> {
        budget.check_about(distance, scratch)?;
        let mut work = Work::default();
        let mut undecided: Option<(Undecided, [usize; 2])> = None;
        for (pair, [one, other]) in self.pairs(&asks_about) {
            work.bounds = work.bounds.saturating_add(1);
            if one.apart(other, distance, 0.0).is_some() {
                continue;
            }
            let search = PairSearch { models: [one, other], distance, more: 0.0 };
            let mut start = SearchStart::NONE;
            match search.are_near(budget, &mut start, scratch, &mut work)?.0 {
                Verdict::Yes => {
                    return Ok(Decided { verdict: Verdict::Yes, witness: Some(pair), work });
                }
                Verdict::Undecided(why) if undecided.is_none() => undecided = Some((why, pair)),
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

    /// All pairs asked about.
    fn pairs(
        &self,
        asks_about: &impl Fn(usize, usize) -> bool,
    ) -> impl Iterator<Item = ([usize; 2], [&'s PlacedModel<'a>; 2])> {
        let models = self.models;
        models.iter().enumerate().flat_map(move |(a, one)| {
            let others = models.iter().enumerate().skip(a + 1);
            others
                .filter(move |(b, _)| asks_about(a, *b))
                .map(move |(b, other)| ([a, b], [one, other]))
        })
    }

    /// All pairs asked about, with lower bounds of their distances.
    fn gaps(
        &self,
        asks_about: &impl Fn(usize, usize) -> bool,
    ) -> impl Iterator<Item = ([usize; 2], f32)> {
        self.models.iter().enumerate().flat_map(move |(a, one)| {
            let around = WorldBox::new(one);
            let others = self.models.iter().enumerate().skip(a + 1);
            others
                .filter(move |(b, _)| asks_about(a, *b))
                .map(move |(b, other)| ([a, b], around.gap(&WorldBox::new(other))))
        })
    }
}

/// A pair to search: the distance asked about, and how much farther to look.
pub(super) struct PairSearch<'s, 'a> {
    pub(super) models: [&'s PlacedModel<'a>; 2],
    pub(super) distance: f32,
    pub(super) more: f32,
}

impl PairSearch<'_, '_> {
    /// Whether two models are within a distance of each other in the world, by their trees: in f32,
    /// and if that does not tell in f64. With a `No` how much farther they are, in the world.
    /// The budget's steps count with those of `work`. Each set-up is a step.
    #[inline(never)]
    pub(super) fn are_near(
        &self,
        budget: Budget,
        start: &mut SearchStart,
        scratch: &mut [ScratchEntry],
        work: &mut Work,
    ) -> Result<(Verdict, f32), QueryError> {
        let Self { models: [one, other], distance, more } = *self;
        let out_of_steps = (Verdict::Undecided(Undecided::Steps), 0.0);
        if work.opened >= budget.steps {
            return Ok(out_of_steps);
        }
        let pose = one.pose_of(other, distance + more);
        let trees = [&one.tree, &other.tree];
        if let Some(pose) = pose.and_then(|pose| GridPose::of(trees, &pose)) {
            let asked = [distance, more];
            match separation(&pose, asked, start, budget.steps, scratch, work) {
                PairVerdict::Apart(lower) => {
                    let left = greater(0.0, lower - distance) * (1.0 - 2.0 * U32);
                    return Ok((Verdict::No, left));
                }
                PairVerdict::Near(_) => return Ok((Verdict::Yes, 0.0)),
                PairVerdict::Undecided => {}
            }
        }
        self.are_near_f64(budget, scratch, work)
    }

    /// The same in f64.
    #[cold]
    #[inline(never)]
    fn are_near_f64(
        &self,
        budget: Budget,
        scratch: &mut [ScratchEntry],
        work: &mut Work,
    ) -> Result<(Verdict, f32), QueryError> {
        let Self { models: [one, other], distance, more } = *self;
        let out_of_steps = (Verdict::Undecided(Undecided::Steps), 0.0);
        let relative = PlacedPair::new(&one.pose, &other.pose, &other.tree)?;
        let mut ask = |asked: [f32; 2]| {
            let steps = budget.steps.saturating_sub(work.opened);
            if steps == 0 {
                return Ok(out_of_steps);
            }
            let (new, pose) = ((budget.with_steps(steps), Work::NONE), &relative.pose);
            let (found, lower) = one.tree.within_of_f64(&other.tree, pose, asked, new, scratch)?;
            *work = work.and(found.work.with_set_up());
            Ok::<_, QueryError>((found.verdict, lower))
        };
        let open = (Verdict::Undecided(Undecided::Resolution), 0.0);
        let most = relative.lengths.at_most(distance);
        // Beyond f32 no distance can be asked about.
        let found = if most < f32::INFINITY { ask([most, more])? } else { open };
        Ok(match found {
            (Verdict::No, lower) => {
                let Interval { lower, .. } = relative.lengths.in_world(Interval::new(lower, lower));
                (Verdict::No, greater(0.0, lower - distance) * (1.0 - 2.0 * U32))
            }
            // Within the larger bound of the distance. Only within the smaller one is `Yes` proved.
            (Verdict::Yes, _) => match relative.lengths.at_least(distance) {
                Some(least) => match ask([least, 0.0])? {
                    (Verdict::No, _) => open,
                    found => found,
                },
                None => open,
            },
            found => found,
        })
    }
}

fn two_of<'s, 'a>(
    models: &'s [PlacedModel<'a>],
    [a, b]: [usize; 2],
) -> Result<(&'s PlacedModel<'a>, &'s PlacedModel<'a>), QueryError> {
    models.get(a).zip(models.get(b)).ok_or(QueryError::Unchecked)
}

/// The nearest pair so far.
struct NearestPair<'r, 's, 'a> {
    models: &'s [PlacedModel<'a>],
    budget: Budget,
    scratch: &'r mut [ScratchEntry],
    /// Lower bound of all pairs so far.
    lower: f32,
    found: SceneDistance,
}

impl NearestPair<'_, '_, '_> {
    fn measure(&mut self, pair: [usize; 2], gap: f32) -> Result<(), QueryError> {
        let is_first = self.found.models.is_none();
        if !is_first && self.steps_left() == 0 {
            self.lower = lesser(self.lower, gap);
            self.found.ended = Ended::Steps;
            return Ok(());
        }
        let (one, other) = two_of(self.models, pair)?;
        let limit = self.found.distance.upper;
        if !is_first && limit < f32::INFINITY && one.apart(other, limit, 0.0).is_some() {
            return Ok(());
        }
        let relative = PlacedPair::new(&one.pose, &other.pose, &other.tree)?;
        let pose = relative.pose;
        // Most pairs are farther than the nearest one so far, and this is proved at less cost.
        let limit = relative.lengths.at_most(self.found.distance.upper);
        if !is_first && limit < f32::INFINITY {
            let budget = self.budget.with_steps(self.steps_left());
            let near = one.tree.within_of(&other.tree, pose, limit, budget, self.scratch)?;
            self.found.work = self.found.work.and(near.work.with_set_up());
            if near.is_clear() {
                return Ok(());
            }
        }
        let budget = self.budget.with_steps(self.steps_left());
        let near = one.tree.distance_to(&other.tree, pose, budget, self.scratch)?;
        self.found.work = self.found.work.and(near.work);
        let Interval { lower, upper } = relative.lengths.in_world(near.distance);
        self.lower = lesser(self.lower, greater(lower, gap));
        if is_first || upper < self.found.distance.upper {
            self.found.distance.upper = upper;
            self.found.models = Some(pair);
            self.found.points = near.points.map(|point| one.pose.to_world(point));
            self.found.triangles = near.triangles;
        }
        if near.ended != Ended::Exact {
            self.found.ended = near.ended;
        }
        Ok(())
    }

    fn steps_left(&self) -> u32 {
        self.budget.steps.saturating_sub(self.found.work.opened)
    }
}
