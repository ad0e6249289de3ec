//! Verdicts about pairs of models, beside the truth in f64: random pairs, and pairs that were moved
//! until their distance is the threshold up to a millionth.

use meshsweep_core::{Budget, Bvh, PlacedModel, Pose, QueryError, Scene, ScratchEntry, Verdict};

use crate::generate::Rng;
use crate::oracle::placed::{Tree, distance};

/// One pair in so many is moved to the threshold.
const BISECTED: usize = 10;

/// How near it is moved, in the unit of the world.
const NEAR: f64 = 1e-6;

/// Halvings of the way on which it is.
const HALVINGS: usize = 60;

/// A model as the library has it, and as the oracle has it.
#[derive(Clone, Copy, Debug)]
pub struct Both<'a> {
    /// The library's.
    pub tree: Bvh<'a>,
    /// The oracle's.
    pub truth: &'a Tree,
}

/// A question: is the pair at most so far apart, each at its place in the world?
#[derive(Clone, Copy, Debug)]
pub struct Pair<'a> {
    /// The models.
    pub models: [Both<'a>; 2],
    /// Their places.
    pub poses: [Pose; 2],
    /// The threshold.
    pub distance: f32,
}

/// Verdicts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Questions.
    pub asked: usize,
    /// Those about a pair that was moved to the threshold.
    pub bisected: usize,
    /// Those that were decided, and of the bisected.
    pub decided: [usize; 2],
    /// `No`, and the models are not farther apart than the threshold.
    pub false_clear: usize,
    /// `Yes`, and they are.
    pub false_near: usize,
}

impl Pair<'_> {
    fn truth(&self) -> f64 {
        let [a, b] = &self.models;
        distance(&a.truth.at(&self.poses[0]), &b.truth.at(&self.poses[1]))
    }

    /// The second model moved along a line until the distance is the threshold. `None` if it
    /// is nowhere on the way.
    fn bisected(mut self, rng: &mut Rng) -> Option<Self> {
        let limit = f64::from(self.distance);
        let [first, _] = &self.models;
        let still = first.truth.at(&self.poses[0]);
        let [end, begun] = self.poses.map(|pose| pose.translation);
        // More or less towards the other model's origin.
        let aside = rng.direction();
        let way = [0, 1, 2].map(|k: usize| end[k] - begun[k] + 0.1 * aside[k]);
        let truth = |this: &mut Self, t: f64| {
            let place = |k: usize| (f64::from(begun[k]) + t * f64::from(way[k])) as f32;
            this.poses[1].translation = [0, 1, 2].map(place);
            distance(&still, &this.models[1].truth.at(&this.poses[1]))
        };
        let from_begin = truth(&mut self, 0.0) > limit;
        let [_, high] = self.models[1].tree.bounds();
        let size = high.iter().fold(1e-3, |most: f64, x| most.max(f64::from(x.abs())));
        let mut far = size;
        while (truth(&mut self, far) > limit) == from_begin {
            far *= -1.25;
            if far.abs() > 64.0 * size {
                return None;
            }
        }
        let (mut here, mut there) = (0.0, far);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (here + there);
            let found = truth(&mut self, middle);
            if (found - limit).abs() < NEAR {
                return Some(self);
            }
            *(if (found > limit) == from_begin { &mut here } else { &mut there }) = middle;
        }
        None
    }
}

/// Asks about `count` pairs that `draw` draws, a tenth of them moved to the threshold.
///
/// # Errors
/// The core's refusal of a question.
pub fn count<'a>(
    count: usize,
    rng: &mut Rng,
    mut draw: impl FnMut(&mut Rng) -> Pair<'a>,
) -> Result<Tally, QueryError> {
    let mut stack = vec![ScratchEntry::EMPTY; Bvh::DISTANCE_ENTRIES];
    let mut tally = Tally::default();
    for index in 0..count {
        let drawn = draw(rng);
        let moved = if index % BISECTED == 0 { drawn.bisected(rng) } else { None };
        let pair = moved.unwrap_or(drawn);
        let placed = |k: usize| PlacedModel::new(pair.models[k].tree, pair.poses[k]);
        let models = [placed(0)?, placed(1)?];
        let scene = Scene::new(&models);
        let found = scene.within(pair.distance, |_, _| true, Budget::EXACT, &mut stack)?;
        let (truth, limit) = (pair.truth(), f64::from(pair.distance));
        tally.asked += 1;
        tally.bisected += usize::from(moved.is_some());
        let is_decided = matches!(found.verdict, Verdict::Yes | Verdict::No);
        tally.decided[usize::from(moved.is_some())] += usize::from(is_decided);
        // The truth's own rounding, some units of f64.
        let slack = 1e-13;
        tally.false_clear += usize::from(found.verdict == Verdict::No && truth < limit - slack);
        tally.false_near += usize::from(found.verdict == Verdict::Yes && truth > limit + slack);
    }
    Ok(tally)
}
