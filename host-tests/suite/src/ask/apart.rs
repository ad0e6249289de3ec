//! Questions to a box tree about other bodies: how far they are, and where they first meet it; and
//! its winding numbers. They have an image of their own, because all questions together are more
//! than the flash of the smallest board.

use meshsweep_core::{
    Budget, Bvh, CoherentPair, FirstHit, Interval, Motion, PlacedModel, Pose, QueryError, Relation,
    Scene, Solid,
};

use super::{Asked, Refused, Subject, tree};
use crate::fold::Fold;
use crate::kind::Kind;
use crate::observer::Observer;
use crate::place::{Bounds, Ends, Place};

/// A box tree, asked about its moved copy and about capsules.
#[derive(Clone, Debug)]
pub struct Apart<'t>(pub Bvh<'t>);

/// What the queries need beside the tree.
pub type Scratch = meshsweep_core::Scratch<{ Bvh::DISTANCE_ENTRIES }>;

impl<'t> Subject<'t> for Apart<'t> {
    type Scratch = Scratch;

    fn open(bytes: &'t [u8]) -> Result<Self, Refused> {
        tree::open(bytes).map(Self)
    }

    fn bounds(&self) -> Bounds {
        tree::bounds(&self.0)
    }

    fn memory_suffices(&self) -> bool {
        self.0.scratch_entries() <= Bvh::DISTANCE_ENTRIES
    }

    asks! { Scratch, |self, place, scratch, to|
        PairDistance => {
            let (rotation, translation) = place.motion();
            distance(self, Pose::rigid(rotation, translation), scratch, to);
        };
        Solid => solid(self, place.segment(), place.distance(), scratch, to);
        Contact => {
            let (start, end) = (place.far(), place.far());
            let motion = [[start, place.near(start)], [end, place.near(end)]];
            contact(self, motion, place.distance(), scratch, to);
        };
        Winding => winding(self, place.far(), scratch, to);
        Scene => {
            let poses = [place.motion(), place.motion(), place.motion()];
            scene(self, poses.map(tree::pose), place.distance(), scratch, to);
        };
        CoherentPair => {
            let (rotation, translation) = place.motion();
            let start = Pose::rigid(rotation, translation);
            let [here, there] = [place.step(), place.step()];
            coherent(self, start, [here, there], scratch, to);
        };
        Penetration => {
            let (rotation, translation) = place.motion();
            penetration(self, Pose::rigid(rotation, translation), scratch, to);
        };
    }
}

/// How far the surface is from its copy, at a pose and after each of three steps from the first
/// point to the second; after a fourth, whether it is within half of the last lower end.
#[inline(never)]
pub fn coherent(
    Apart(tree): &Apart<'_>,
    start: Pose,
    [from, end]: Ends,
    scratch: &mut Scratch,
    to: &mut Asked<'_, impl Observer>,
) {
    let mut pair = CoherentPair::<80>::new();
    let budget = Budget::EXACT.with_steps(STEPS);
    let mut pose = start;
    let mut half = 0.0;
    for _ in 0..4 {
        let (budget, scratch) = to.terms(budget, scratch);
        let found = to.answer(
            || pair.distance(tree, tree, pose, budget, scratch),
            |fold, answer| {
                nearest(fold, answer.distance, answer.points, answer.triangles);
                words(fold, &[answer.ended as u32]);
            },
        );
        half = found.map_or(half, |found| 0.5 * found.distance.lower);
        for (x, (from, end)) in pose.translation.iter_mut().zip(from.iter().zip(&end)) {
            *x += end - from;
        }
    }
    let (budget, scratch) = to.terms(budget, scratch);
    to.answer(
        || pair.within(tree, tree, pose, half, budget, scratch),
        |fold, answer| super::verdict(fold, answer.verdict),
    );
}

/// How deep the solid is in its moved copy.
#[inline(never)]
pub fn penetration(
    Apart(tree): &Apart<'_>,
    pose: Pose,
    scratch: &mut Scratch,
    to: &mut Asked<'_, impl Observer>,
) {
    let (budget, scratch) = to.terms(Budget::EXACT.with_steps(2 * STEPS), scratch);
    to.answer(
        || tree.penetration(tree, pose, budget, scratch),
        |fold, answer| {
            words(fold, &[answer.depth.lower.to_bits()]);
            words(fold, &[answer.depth.upper.to_bits()]);
            words(fold, &[u32::from(answer.relation == Relation::Apart)]);
            if let Some(apart) = answer.apart {
                words(fold, &apart.translation.map(f32::to_bits));
            }
            words(fold, &[answer.ended as u32]);
        },
    );
}

/// Which two of three moved copies are nearest, and whether any two are within a distance.
#[inline(never)]
pub fn scene(
    Apart(tree): &Apart<'_>,
    poses: [Pose; 3],
    distance: f32,
    scratch: &mut Scratch,
    to: &mut Asked<'_, impl Observer>,
) {
    let [Ok(first), Ok(second), Ok(third)] = poses.map(|pose| PlacedModel::new(*tree, pose)) else {
        return;
    };
    let models = [first, second, third];
    let scene = Scene::new(&models);
    let exact = Budget::EXACT.with_steps(STEPS);
    let (budget, entries) = to.terms(exact, scratch);
    to.answer(
        || scene.nearest_pair(|_, _| true, budget, entries),
        |fold, answer| {
            nearest(fold, answer.distance, answer.points, answer.triangles);
            words(fold, &[answer.ended as u32]);
        },
    );
    let (budget, entries) = to.terms(exact, scratch);
    to.answer(
        || scene.within(distance, |_, _| true, budget, entries),
        |fold, answer| super::verdict(fold, answer.verdict),
    );
}

/// Where two surfaces are nearest.
fn nearest(
    fold: &mut Fold,
    distance: Interval,
    [[a, b, c], [x, y, z]]: [[f32; 3]; 2],
    [first, second]: [u32; 2],
) {
    let [a, b, c, x, y, z] = [a, b, c, x, y, z].map(f32::to_bits);
    let (lower, upper) = (distance.lower.to_bits(), distance.upper.to_bits());
    words(fold, &[lower, upper, a, b, c, x, y, z, first, second]);
}

/// Folds words by a call: all is more than the flash of the smallest board.
#[inline(never)]
fn words(fold: &mut Fold, words: &[u32]) {
    words.iter().for_each(|&word| fold.word(word));
}

/// How often the surface encloses a point.
#[inline(never)]
pub fn winding(
    Apart(tree): &Apart<'_>,
    point: [f32; 3],
    scratch: &mut Scratch,
    to: &mut Asked<'_, impl Observer>,
) {
    let (budget, scratch) = to.terms(Budget::EXACT, scratch);
    to.answer(
        || tree.winding_number(point, budget, scratch),
        |fold, answer| {
            let number = answer.number;
            let ends = [number.lower, number.upper].map(f32::to_bits);
            words(fold, &[ends[0], ends[1], answer.ended as u32]);
        },
    );
}

/// Pairs of nodes that a search for the distance may open.
const STEPS: u32 = 16;

/// How far the surface is from its moved copy, whether it is within half of that, and how far it
/// can move on.
#[inline(never)]
pub fn distance(
    Apart(tree): &Apart<'_>,
    pose: Pose,
    scratch: &mut Scratch,
    to: &mut Asked<'_, impl Observer>,
) {
    let exact = Budget::EXACT.with_steps(STEPS);
    let (budget, entries) = to.terms(exact, scratch);
    let found = to.answer(
        || tree.distance_to(tree, pose, budget, entries),
        |fold, answer| {
            nearest(fold, answer.distance, answer.points, answer.triangles);
            words(fold, &[answer.ended as u32]);
        },
    );
    if let Some(found) = found {
        let half = 0.5 * found.distance.lower;
        let (budget, entries) = to.terms(exact, scratch);
        to.answer(
            || tree.within_of(tree, pose, half, budget, entries),
            |fold, answer| super::verdict(fold, answer.verdict),
        );
        let mut end = pose;
        end.translation = found.points[0];
        // A quarter of a turn farther.
        let [x, y, z] = pose.rotation;
        end.rotation = [y.map(|entry| -entry), x, z];
        let (budget, entries) = to.terms(exact, scratch);
        to.answer(
            || {
                let motion = Motion::screw(pose, end)?;
                tree.first_contact_of(tree, &motion, half, budget, entries)
            },
            |fold, answer| {
                words(fold, &[answer.clear_until.to_bits()]);
                answer.triangles.into_iter().for_each(|number| words(fold, &[number]));
                words(fold, &[answer.ended as u32]);
            },
        );
    }
}

/// How far a capsule is from the surface, and whether it is within half of that.
#[inline(never)]
pub fn solid(
    Apart(tree): &Apart<'_>,
    ends: Ends,
    radius: f32,
    scratch: &mut Scratch,
    to: &mut Asked<'_, impl Observer>,
) {
    let (budget, entries) = to.terms(Budget::EXACT, scratch);
    let found = to.answer(
        || {
            let capsule = Solid::new(&ends, radius)?;
            tree.solid_distance(&capsule, budget, entries)
        },
        |fold, answer| {
            words(fold, &[answer.distance.lower.to_bits()]);
            words(fold, &[answer.distance.upper.to_bits()]);
            answer.points.into_iter().for_each(|point| words(fold, &point.map(f32::to_bits)));
            words(fold, &[answer.triangle]);
            words(fold, &[answer.ended as u32]);
        },
    );
    if let Some(found) = found {
        let half = 0.5 * found.distance.lower;
        let (budget, entries) = to.terms(Budget::EXACT, scratch);
        to.answer(
            || {
                let capsule = Solid::new(&ends, radius)?;
                tree.solid_within(&capsule, half, budget, entries)
            },
            |fold, answer| super::verdict(fold, answer.verdict),
        );
    }
}

/// Where a capsule that goes from one place to another first meets the surface.
#[inline(never)]
pub fn contact(
    Apart(tree): &Apart<'_>,
    [from, end]: [Ends; 2],
    radius: f32,
    scratch: &mut Scratch,
    to: &mut Asked<'_, impl Observer>,
) {
    let (budget, entries) = to.terms(Budget::EXACT, scratch);
    let call = || -> Result<FirstHit, QueryError> {
        let (from, end) = (Solid::new(&from, radius)?, Solid::new(&end, radius)?);
        tree.solid_first_contact(&from, &end, budget, entries)
    };
    to.answer(call, |fold, answer| {
        words(fold, &[answer.t.lower.to_bits()]);
        words(fold, &[answer.t.upper.to_bits()]);
        if let Some(hit) = answer.hit {
            fold.point(hit.point);
            super::number(fold, hit.triangle);
        }
        words(fold, &[answer.ended as u32]);
    });
}
