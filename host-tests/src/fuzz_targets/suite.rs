//! Every kind of query of the suite, on any bytes. A question that is new in the suite is asked
//! here without more.

use super::input::Input;
use meshsweep_core::Pose;
use meshsweep_suite::fold::Fold;
use meshsweep_suite::place::{Ends, Motion, Place, Point};
use meshsweep_suite::{Kind, Subject};

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
