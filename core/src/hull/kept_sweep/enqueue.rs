//! Triangles on their way into the queue of a sweep.

use crate::hull::front::{Candidate, Visit};
use crate::hull::nearest::Nearest;
use crate::query::{ScratchEntry, SweepQueue, key_of};

/// Puts triangles into the queue.
pub(super) struct Enqueuer {
    pub(super) nearest: Nearest,
    /// The bound of the triangle that was replaced. Its children are not nearer.
    pub(super) parent: f32,
    /// The path of the point so far: `Sweep::moved`.
    pub(super) moved: f64,
    pub(super) pruned: f32,
    /// The nearest of those that were just found, while no triangle of the surface is known.
    pub(super) next: Option<ScratchEntry>,
    /// The nearest new triangle is opened next, until one of the surface is known.
    pub(super) dives: bool,
}

impl Visit for Enqueuer {
    fn visit(&mut self, found: &[Candidate], queue: &mut SweepQueue<'_>) {
        for (bound, candidate) in self.nearest.bounds(found).into_iter().zip(found) {
            if bound == f32::INFINITY {
                self.pruned = self.pruned.min(key_of(self.nearest.limit(), self.moved));
                continue;
            }
            let key = key_of(f64::from(bound.max(self.parent)), self.moved);
            let entry = ScratchEntry::new(key, candidate.instance.0);
            match &mut self.next {
                Some(near) if entry.key() < near.key() => {
                    queue.push(core::mem::replace(near, entry));
                }
                None if self.dives => self.next = Some(entry),
                _ => queue.push(entry),
            }
        }
    }
}

impl Enqueuer {
    /// A lower bound of a triangle's distance, at most the limit.
    pub(super) fn least(&self, candidate: &Candidate) -> f64 {
        let [bound, ..] = self.nearest.bounds(core::slice::from_ref(candidate));
        f64::from(bound).min(self.nearest.limit())
    }

    /// Triangles farther than the nearest by more than this are not kept.
    pub(super) fn limit_to(&mut self, margin: f64) {
        self.nearest.set_limit(self.nearest.upper() + margin);
    }
}
