//! Stop rules and working memory of a search, and the note on how queries ended.

use super::args::SearchArgs;
use super::counted::Counted;
use super::threads::Asked;
use meshsweep_core::query::tree::ScratchEntry;
use meshsweep_core::query::{Budget, Ended, Work};
use meshsweep_core::{Bvh, Model, QueueEntry};
use std::fmt;
use std::io::Write;

/// Queue entries unless told otherwise: enough to search best first, and small beside a cache.
const COMFORTABLE_QUEUE: usize = 4096;

impl SearchArgs {
    /// The stop rule with the given tolerances.
    pub fn stop(&self, relative: f32, absolute: f32) -> Budget {
        Budget { relative, absolute, steps: self.steps.unwrap_or(u32::MAX) }
    }

    /// The stack to search the box tree with.
    pub fn stack(&self, tree: &Bvh<'_>) -> Vec<ScratchEntry> {
        vec![ScratchEntry::EMPTY; self.queue.unwrap_or(tree.header().stack_entries) as usize]
    }

    /// The queue to search the cover tree with.
    pub fn queue(&self, model: &Model<'_>) -> Vec<QueueEntry> {
        let needed = model.capacities().queue;
        let entries = self.queue.map_or(needed.max(COMFORTABLE_QUEUE), |entries| entries as usize);
        vec![QueueEntry::EMPTY; entries]
    }

    /// Says on the standard error how queries ended if any ended early, and what they took if
    /// asked. `by_hull`: of a mesh that is known by a tight hull alone.
    pub fn note<A>(&self, asked: &Asked<A>, by_hull: bool) {
        let Asked { tally, time, threads, .. } = asked;
        // A standard error that is closed is no reason to withhold the answers.
        let mut stderr = std::io::stderr();
        if self.time {
            let queries = tally.queries().max(1) as f64;
            let _ = writeln!(
                stderr,
                "{:.1} ns and {:.1} steps of work per query; {} in {:.3} s on {}",
                time.as_nanos() as f64 / queries,
                tally.work as f64 / queries,
                Counted(tally.queries(), "query"),
                time.as_secs_f64(),
                Counted(*threads, "thread")
            );
        }
        if self.time || tally.ended_early() {
            let _ = if by_hull {
                writeln!(stderr, "ended: {}", ByHull(tally))
            } else {
                writeln!(stderr, "ended: {tally}")
            };
        }
    }
}

/// How many queries ended for which reason.
#[derive(Clone, Copy, Debug, Default)]
pub struct Tally {
    exact: usize,
    tolerance: usize,
    steps: usize,
    capacity: usize,
    level: usize,
    work: u64,
}

impl Tally {
    pub fn count(&mut self, ended: Ended, work: Work) {
        self.work += u64::from(work.total());
        *match ended {
            Ended::Exact => &mut self.exact,
            Ended::Tolerance => &mut self.tolerance,
            Ended::Steps => &mut self.steps,
            Ended::Capacity => &mut self.capacity,
            Ended::Level => &mut self.level,
        } += 1;
    }

    pub fn add(&mut self, other: &Tally) {
        self.exact += other.exact;
        self.tolerance += other.tolerance;
        self.steps += other.steps;
        self.capacity += other.capacity;
        self.level += other.level;
        self.work += other.work;
    }

    fn queries(&self) -> usize {
        self.exact + self.tolerance + self.steps + self.capacity + self.level
    }

    fn ended_early(&self) -> bool {
        self.exact < self.queries()
    }
}

impl Tally {
    /// Counts and reasons; `level` says what left queries open for which more work is of no use.
    fn write(&self, f: &mut fmt::Formatter<'_>, level: &str) -> fmt::Result {
        let counts = [
            (self.exact, "exact"),
            (self.tolerance, "within tolerance"),
            (self.steps, "out of steps"),
            (self.capacity, "out of stack or queue"),
            (self.level, level),
        ];
        let mut is_first = true;
        for (count, reason) in counts.into_iter().filter(|(count, _)| *count > 0) {
            let comma = if std::mem::replace(&mut is_first, false) { "" } else { ", " };
            write!(f, "{comma}{count} {reason}")?;
        }
        if is_first { f.write_str("no query") } else { Ok(()) }
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write(
            f,
            "left open by rounding or the blob (cut, or vertices moved to a grid), or for touching",
        )
    }
}

/// The same of a mesh that is known by a tight hull alone: that a query is left open is the rule
/// then.
struct ByHull<'a>(&'a Tally);

impl fmt::Display for ByHull<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.write(
            f,
            "answered as far as the hull tells: it stands off from the mesh; a finer hull tells more",
        )
    }
}
