//! How queries ended, and the work that they took.

use meshsweep_core::{Ended, Work};

/// Words for queries that ended with `Ended::Resolution`: more work does not help them.
const RESOLUTION: &str =
    "left undecided: they may touch, or rounding or the blob (cut, or on a grid) leaves it open";

/// The same where the blob knows the mesh by a tight hull alone, which leaves most queries
/// undecided.
const BY_HULL: &str =
    "answered as far as the hull tells: it stands off from the mesh; a finer hull tells more";

/// Numbers of queries by the reason why they ended, and their work in all.
#[derive(Clone, Copy, Debug, Default)]
pub struct Tally {
    exact: usize,
    tolerance: usize,
    steps: usize,
    scratch: usize,
    resolution: usize,
    pub work: u64,
}

impl Tally {
    pub fn count(&mut self, ended: Ended, work: Work) {
        self.work += u64::from(work.total());
        *match ended {
            Ended::Exact => &mut self.exact,
            Ended::Tolerance => &mut self.tolerance,
            Ended::Steps => &mut self.steps,
            Ended::Scratch => &mut self.scratch,
            _ => &mut self.resolution,
        } += 1;
    }

    pub fn queries(&self) -> usize {
        self.exact + self.tolerance + self.steps + self.scratch + self.resolution
    }

    pub fn ended_early(&self) -> bool {
        self.exact < self.queries()
    }

    /// Counts and reasons, for people.
    pub fn describe(&self, is_by_hull: bool) -> String {
        let counts = [
            (self.exact, "exact"),
            (self.tolerance, "within tolerance"),
            (self.steps, "out of steps"),
            (self.scratch, "out of scratch memory"),
            (self.resolution, if is_by_hull { BY_HULL } else { RESOLUTION }),
        ];
        let counted = counts.into_iter().filter(|(count, _)| *count > 0);
        let said: Vec<String> = counted.map(|(count, why)| format!("{count} {why}")).collect();
        if said.is_empty() { "no query".to_owned() } else { said.join(", ") }
    }
}
