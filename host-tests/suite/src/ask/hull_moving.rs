//! Questions about a hull hierarchy that moves: the kept sweep, and overlaps. They have an image
//! of their own, because all questions together are more than the flash of the smallest board.

use meshsweep_core::{Budget, ClosestPoint, Pose};

use super::hull::Model;
use super::{Refused, Subject, timed};
use crate::fold::Fold;
use crate::kind::Kind;
use crate::observer::Observer;
use crate::place::{Bounds, Place};

/// A hull hierarchy, asked about points that move and about its moved copy.
#[derive(Clone, Copy, Debug)]
pub struct Moving<'t>(Model<'t>);

/// Entries of the queue.
const QUEUE: usize = 256;

/// What the queries need beside the model.
pub type Scratch = meshsweep_core::Scratch<QUEUE>;

impl<'t> Subject<'t> for Moving<'t> {
    type Scratch = Scratch;

    fn open(bytes: &'t [u8]) -> Result<Self, Refused> {
        super::hull::open(bytes).map(Self)
    }

    fn bounds(&self) -> Bounds {
        super::hull::bounds(&self.0)
    }

    fn memory_suffices(&self) -> bool {
        self.0.hull.overlap_entries(&self.0.hull) <= QUEUE
    }

    asks! { Scratch, |self, place, scratch, observer, fold|
        Sweep => {
            let from = place.far();
            sweep(self, [from, place.near(from), place.far()], scratch, observer, fold);
        };
        Posed => {
            let (rotation, translation) = place.motion();
            let pose = Pose::rigid(rotation, translation);
            posed(self, pose, place.far(), scratch, observer, fold);
        };
        Overlap => {
            let (rotation, translation) = place.motion();
            let [a, b] = place.segment();
            let pose = Pose::rigid(rotation, translation);
            overlap(self, pose, [a, b, place.far()], scratch, observer, fold);
        };
    }
}

/// Triangles that an overlap may open: what the question needs differs by orders of magnitude.
const STEPS: u32 = 48;

/// Whether the surface meets its moved copy, and a triangle.
#[inline(never)]
pub fn overlap(
    Moving(model): &Moving<'_>,
    pose: Pose,
    triangle: [[f32; 3]; 3],
    scratch: &mut Scratch,
    observer: &mut impl Observer,
    fold: &mut Fold,
) {
    let queue = scratch;
    let budget = Budget::EXACT.with_steps(STEPS);
    timed(observer, || {
        match model.hull.overlap(&model.hull, pose, budget, queue) {
            Ok(answer) => {
                let triangles = answer.witness.unwrap_or([u32::MAX; 2]);
                triangles.into_iter().for_each(|number| fold.word(number));
                super::verdict(fold, answer.verdict);
            }
            Err(error) => super::refusal(fold, error),
        }
        match model.hull.meets_triangle(triangle, Budget::EXACT, queue) {
            Ok(answer) => {
                super::number(fold, answer.witness);
                super::verdict(fold, answer.verdict);
            }
            Err(error) => super::refusal(fold, error),
        }
    });
}

/// A sweep about three points, one after the other: a few steps at each, then its end, and the next
/// triangles of the last one.
#[inline(never)]
pub fn sweep(
    Moving(model): &Moving<'_>,
    points: [[f32; 3]; 3],
    scratch: &mut Scratch,
    observer: &mut impl Observer,
    fold: &mut Fold,
) {
    let queue = scratch;
    let mut found = [ClosestPoint::EMPTY; 9];
    let asked = timed(observer, || {
        let mut slots = found.iter_mut();
        let mut keep = |answer| slots.next().map(|slot| *slot = answer);
        let mut sweep = model.hull.sweep(points[0], queue)?;
        for point in points {
            sweep.move_to(point)?;
            for budget in [Budget::EXACT.with_steps(5), Budget::EXACT] {
                keep(sweep.closest_point(budget)?);
            }
        }
        for _ in 0..3 {
            keep(sweep.next_triangle(Budget::EXACT)?.unwrap_or(ClosestPoint::EMPTY));
        }
        Ok(())
    });
    found.iter().for_each(|answer| super::closest_point(fold, answer));
    if let Err(error) = asked {
        super::refusal(fold, error);
    }
}

/// Closest point of the moved model.
#[inline(never)]
pub fn posed(
    Moving(model): &Moving<'_>,
    pose: Pose,
    point: [f32; 3],
    scratch: &mut Scratch,
    observer: &mut impl Observer,
    fold: &mut Fold,
) {
    let asked = timed(observer, || {
        let here = pose.to_model(point)?;
        let near = model.hull.closest_point(here.point, Budget::EXACT, scratch)?;
        Ok((here.distance(near.distance), pose.to_world(near.point)))
    });
    match asked {
        Ok((distance, place)) => {
            fold.f32(distance.lower);
            fold.f32(distance.upper);
            fold.point(place);
        }
        Err(error) => super::refusal(fold, error),
    }
}
