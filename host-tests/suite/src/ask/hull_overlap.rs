//! Questions of two split hierarchies, in an image of their own: with all others they are more than
//! the flash of the smallest board.

use meshsweep_core::{Budget, Pose, ScratchEntry};

use super::hull::Model;
use super::{Refused, Subject, timed};
use crate::fold::Fold;
use crate::place::{Bounds, Placer};
use crate::{Clock, Kind};

/// A split hierarchy, asked about its moved copy.
#[derive(Clone, Copy, Debug)]
pub struct Overlapping<'t>(Model<'t>);

/// Entries of the queue.
const QUEUE: usize = 256;

/// What the queries need beside the model.
#[derive(Debug)]
pub struct Scratch([ScratchEntry; QUEUE]);

impl Scratch {
    /// Scratch that no query has used.
    #[must_use]
    pub const fn new() -> Self {
        Self([ScratchEntry::EMPTY; QUEUE])
    }
}

impl Default for Scratch {
    fn default() -> Self {
        Self::new()
    }
}

impl<'t> Subject<'t> for Overlapping<'t> {
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

    fn memory(&self) -> usize {
        size_of::<Scratch>()
    }

    fn suits(kind: Kind) -> bool {
        matches!(kind, Kind::Overlap)
    }

    fn ask(
        &self,
        kind: Kind,
        place: &mut Placer,
        scratch: &mut Scratch,
        clock: &mut impl Clock,
        fold: &mut Fold,
    ) {
        if kind == Kind::Overlap {
            let (rotation, translation) = place.motion();
            let [a, b] = place.segment();
            let pose = Pose { rotation, translation };
            overlap(&self.0, pose, [a, b, place.far()], scratch, clock, fold);
        }
    }
}

/// Triangles that an overlap may open: what the question needs differs by orders of magnitude.
const STEPS: u32 = 48;

/// Whether the surface meets its moved copy, and a triangle.
fn overlap(
    model: &Model<'_>,
    pose: Pose,
    triangle: [[f32; 3]; 3],
    scratch: &mut Scratch,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    let queue = &mut scratch.0;
    let budget = Budget::EXACT.with_steps(STEPS);
    timed(clock, || {
        match model.hull.overlap(&model.hull, pose, budget, queue) {
            Ok(answer) => {
                let triangles = answer.triangles.unwrap_or([u32::MAX; 2]);
                triangles.into_iter().for_each(|number| fold.word(number));
                super::verdict(fold, answer.work, answer.verdict);
            }
            Err(error) => super::refusal(fold, error),
        }
        match model.hull.meets_triangle(triangle, Budget::EXACT, queue) {
            Ok(answer) => {
                super::number(fold, answer.triangle);
                super::verdict(fold, answer.work, answer.verdict);
            }
            Err(error) => super::refusal(fold, error),
        }
    });
}
