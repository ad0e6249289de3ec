//! A question about two models, and the pose at which it costs most.

use super::climb::{Climb, Domain};
use super::goal::{Found, Goal, Setup, Worst};
use crate::pose::{of_quaternion, of_row};
use crate::trade::{self, Board, features_of_pair};
use meshsweep_core::{Budget, Bvh, Interval, Pose, ScratchEntry, Work};

/// A question about two box trees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PairQuestion {
    /// Their distance.
    Distance,
    /// Whether they are within this one.
    Within(f32),
}

impl PairQuestion {
    /// The program's command that asks it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Distance => "clearance",
            Self::Within(_) => "clearance --within",
        }
    }
}

/// Two models, the second of which moves, and the question about them.
#[derive(Clone, Copy, Debug)]
pub struct Pair<'a> {
    /// Both were built for segments.
    pub trees: [Bvh<'a>; 2],
    /// The question.
    pub question: PairQuestion,
}

impl Pair<'_> {
    /// Searches the costliest pose; with a limit of steps the widest interval of the distance too.
    /// The second model's middle stays in twice the first one's box, enlarged by the second one's.
    /// See [`Climb::starts`].
    #[must_use]
    pub fn worst(&self, budget: Budget, starts: usize) -> Vec<Worst> {
        let is_limited = budget.steps != u32::MAX && self.question == PairQuestion::Distance;
        let goals: &[Goal] = if is_limited { &[Goal::Work, Goal::Width] } else { &[Goal::Work] };
        goals.iter().filter_map(|&goal| self.worst_of(goal, budget, starts)).collect()
    }

    fn worst_of(&self, goal: Goal, budget: Budget, starts: usize) -> Option<Worst> {
        let climb = Climb::default().with_starts(starts);
        let setup = Setup { goal, climb, entries: Bvh::DISTANCE_ENTRIES };
        let domain = self.domain();
        let seeds = self.seeds();
        let ask = |numbers: &[f32; 7], scratch: &mut [ScratchEntry]| {
            self.ask(of_row(of_quaternion(self.row(numbers)?)), budget, scratch)
        };
        let worst = setup.worst(&domain, &seeds, &ask)?;
        let numbers: &[f32; 7] = worst.query.as_slice().try_into().ok()?;
        Some(Worst { query: self.row(numbers)?.to_vec(), ..worst })
    }

    /// Places of the second model's middle, then quaternions.
    fn domain(&self) -> Domain<7> {
        let [first, second] = self.trees.map(|tree| tree.bounds());
        let (middle, [one, other]) = (middle_of(first), [half_of(first), half_of(second)]);
        let corner = |sign: f32, turn: f32| {
            let [x, y, z] = std::array::from_fn(|k| {
                (middle[k] + 2.0 * sign * (one[k] + other[k])).clamp(f32::MIN, f32::MAX)
            });
            [x, y, z, turn, turn, turn, turn]
        };
        Domain { low: corner(-1.0, -1.0), high: corner(1.0, 1.0) }
    }

    /// Poses at which faces along the axes are parallel: the boxes side by side, as far apart as
    /// the question asks, not turned and in quarter turns. Of parts with flat faces these are often
    /// the costliest.
    fn seeds(&self) -> Vec<[f32; 7]> {
        let [first, second] = self.trees.map(|tree| tree.bounds());
        let (middle, one, [x, y, z]) = (middle_of(first), half_of(first), half_of(second));
        let apart = match self.question {
            PairQuestion::Distance => 0.0,
            PairQuestion::Within(distance) => distance,
        };
        let turns = [
            ([1.0, 0.0, 0.0, 0.0], [x, y, z]),
            ([1.0, 1.0, 0.0, 0.0], [x, z, y]),
            ([1.0, 0.0, 1.0, 0.0], [z, y, x]),
            ([1.0, 0.0, 0.0, 1.0], [y, x, z]),
        ];
        let mut seeds = Vec::new();
        for ([w, a, b, c], other) in turns {
            for axis in 0..3 {
                for sign in [-1.0, 1.0] {
                    let mut at = middle;
                    at[axis] += sign * (one[axis] + other[axis] + apart);
                    seeds.push([at[0], at[1], at[2], w, a, b, c]);
                }
            }
        }
        seeds
    }

    /// The translation and the quaternion of a place of the middle. `None` of a quaternion of
    /// zeros.
    fn row(&self, numbers: &[f32; 7]) -> Option<[f32; 7]> {
        let [x, y, z, w, a, b, c] = *numbers;
        if [w, a, b, c] == [0.0; 4] {
            return None;
        }
        let turn = of_row(of_quaternion([0.0, 0.0, 0.0, w, a, b, c]));
        let from = turn.to_world(middle_of(self.trees[1].bounds()));
        let shift = [x - from[0], y - from[1], z - from[2]];
        Some([shift[0], shift[1], shift[2], w, a, b, c])
    }

    fn ask(&self, pose: Pose, budget: Budget, scratch: &mut [ScratchEntry]) -> Option<Found> {
        let [first, second] = &self.trees;
        match self.question {
            PairQuestion::Distance => {
                let found = first.distance_to(second, pose, budget, scratch).ok()?;
                let Interval { lower, upper } = found.distance;
                Some(Found { work: found.work, width: Some(upper - lower), instructions: None })
            }
            PairQuestion::Within(distance) => {
                let found = first.within_of(second, pose, distance, budget, scratch).ok()?;
                let instructions = self.instructions(&found.work);
                Some(Found { work: found.work, width: None, instructions })
            }
        }
    }

    /// As [`trade`] predicts them. No costs are known of trees with f32 vertices.
    fn instructions(&self, work: &Work) -> Option<[f64; 2]> {
        if self.trees.iter().any(|tree| tree.header().is_f32()) {
            return None;
        }
        let features = features_of_pair(work);
        let [m4f, m0] = Board::ALL.map(|board| trade::cost(board, trade::Search::PairOfTrees));
        Some([m4f?.of(&features), m0?.of(&features)])
    }
}

fn middle_of([low, high]: [[f32; 3]; 2]) -> [f32; 3] {
    std::array::from_fn(|k| 0.5 * low[k] + 0.5 * high[k])
}

fn half_of([low, high]: [[f32; 3]; 2]) -> [f32; 3] {
    std::array::from_fn(|k| 0.5 * high[k] - 0.5 * low[k])
}
