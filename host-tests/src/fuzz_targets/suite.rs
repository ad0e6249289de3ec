//! Every kind of query of the suite, on any bytes. A question that is new in the suite is asked
//! here without more.

use super::input::Input;
use meshsweep_core::{Budget, Bvh, Pose, QueryError, ScratchEntry, Work};
use meshsweep_suite::ask::{apart, tree};
use meshsweep_suite::fold::Fold;
use meshsweep_suite::place::{Ends, Motion, Place, Point};
use meshsweep_suite::questions::Question;
use meshsweep_suite::{Kind, Observer, Subject};

impl Place for Input<'_> {
    fn far(&mut self) -> Point {
        self.point()
    }

    fn near(&mut self, base: Point) -> Point {
        let by = self.point();
        std::array::from_fn(|axis| base[axis] + by[axis] / 1024.0)
    }

    fn step(&mut self) -> Point {
        self.point()
    }

    fn step_or_jump(&mut self) -> Point {
        self.point()
    }

    fn segment(&mut self) -> Ends {
        [self.point(), self.point()]
    }

    fn motion(&mut self) -> Motion {
        let Pose { rotation, translation, .. } = self.pose();
        (rotation, translation)
    }

    fn distance(&mut self) -> f32 {
        self.float()
    }

    fn share(&mut self) -> f32 {
        self.float()
    }

    fn word(&mut self) -> u32 {
        self.u32()
    }
}

/// Asks a blob every kind of query, if it opens and the suite's memory suffices. None panics, and
/// each ends.
pub(super) fn ask_all<'t, S: Subject<'t>>(
    blob: &'t [u8],
    mut scratch: S::Scratch,
    input: &mut Input<'_>,
) {
    let Ok(subject) = S::open(blob) else { return };
    if !subject.memory_suffices() {
        return;
    }
    let mut fold = Fold::new();
    for kind in Kind::ALL.into_iter().filter(|kind| S::suits(*kind)) {
        subject.ask(kind, input, &mut scratch, &mut (), &mut fold);
    }
}

/// Asks a box tree every question of the suite with so many entries of scratch. Each ends within
/// the descents of its row, where `descent` is more work than one can take. Each kind reads the
/// same places.
pub(super) fn ask_within_bounds(tree: &Bvh<'_>, descent: u64, entries: usize, input: &Input<'_>) {
    let (mut scratch, mut apart_scratch) = (tree::Scratch::new(), apart::Scratch::new());
    let (apart, fold) = (apart::Apart(*tree), &mut Fold::new());
    for kind in Kind::ALL {
        let Some(question) = Question::of_tree_kind(kind) else { continue };
        let most = question.descents.map(|descents| u64::from(descents) * descent);
        let mut bounded = Bounded { kind, most, steps: 0, entries };
        let mut places = Input(input.0);
        for _ in 0..3 {
            // One of the two has the kind; the other does nothing.
            tree.ask(kind, &mut places, &mut scratch, &mut bounded, fold);
            apart.ask(kind, &mut places, &mut apart_scratch, &mut bounded, fold);
        }
    }
}

/// Holds each answer to a bound of its work.
struct Bounded {
    kind: Kind,
    /// Bound of the work; `None` for two trees.
    most: Option<u64>,
    /// Steps of the budget.
    steps: u32,
    entries: usize,
}

/// Steps of a question about two trees. Without them the search ends too, but a fuzzer would not
/// wait for all pairs.
pub(super) const STEPS: u32 = 300;

impl Observer for Bounded {
    fn terms<'s>(
        &mut self,
        budget: Budget,
        scratch: &'s mut [ScratchEntry],
    ) -> (Budget, &'s mut [ScratchEntry]) {
        self.steps = if self.most.is_some() { budget.steps } else { budget.steps.min(STEPS) };
        let entries = self.entries.min(scratch.len());
        (budget.with_steps(self.steps), &mut scratch[..entries])
    }

    fn answered(&mut self, answer: Result<Work, QueryError>) {
        let Ok(work) = answer else { return };
        match self.most {
            Some(most) => assert!(u64::from(work.total()) <= most, "{:?}: {work:?}", self.kind),
            None => assert!(work.opened <= self.steps, "{:?}: {work:?}", self.kind),
        }
    }
}
