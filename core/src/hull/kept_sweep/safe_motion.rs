//! How far the point of a sweep may move before another triangle may be the nearest (Guéziec 2000,
//! 3.3).

use super::Sweep;
use super::enqueue::{Enqueue, bound_of};
use crate::hull::format::Instance;
use crate::num::tolerance::SUMMED;
use crate::query::ScratchEntry;

/// While the point moves less than `motion`, the nearest triangle is one of `near` (Guéziec 2000,
/// 3.3). The paper keeps one triangle. Triangles that share the closest vertex have no gap between
/// them, so several are kept.
#[derive(Debug)]
pub(super) struct SafeMotion {
    pub(super) motion: f64,
    pub(super) near: heapless::Vec<Instance, SAFE_TRIANGLES>,
    /// Answers that do not search for a safe motion, because an earlier search failed.
    pub(super) pause: u8,
}

impl SafeMotion {
    pub(super) const NONE: SafeMotion =
        SafeMotion { motion: -1.0, near: heapless::Vec::new(), pause: 0 };
}

/// Triangles that may be nearest within the safe motion: about the star of a vertex.
pub(super) const SAFE_TRIANGLES: usize = 12;
/// A search goes on until the safe motion is this many of the last step, while the triangles fit.
pub(super) const SAFE_STEPS: f64 = 4.0;
/// After a search that found too many triangles, so many answers search no farther than they must.
pub(super) const SAFE_PAUSE: u8 = 8;

impl Sweep<'_, '_> {
    /// Evaluates the near triangles that f32 cannot rule out. On a Cortex-M f64 is slow.
    pub(super) fn settle_near(&self, enqueue: &mut Enqueue) -> Option<()> {
        let margin = self.margin();
        for &instance in &self.safe.near {
            let candidate = self.front.look(instance)?;
            enqueue.limit_to(margin);
            if Some(instance) != self.best && enqueue.least(&candidate) <= enqueue.nearest.upper() {
                enqueue.nearest.evaluate(&candidate);
            }
        }
        Some(())
    }

    /// The motion up to which one of the triangles that were set aside stays the nearest. Nothing
    /// else is nearer than `others`.
    pub(super) fn find_safe_motion(&mut self, upper: f64, mut others: f64) {
        self.safe.near.clear();
        let bound = |entry: &ScratchEntry| bound_of(entry.key(), self.moved);
        // Half way to the nearest other triangle. Entries below it stay near.
        let threshold = upper + 0.5 * (others - upper);
        for entry in self.front.queue.aside() {
            if bound(entry) > threshold || self.safe.near.push(Instance(entry.node())).is_err() {
                others = others.min(bound(entry));
            }
        }
        // The gap is a difference of numbers with a rounding each.
        let gap = others * (2.0 - SUMMED) - upper * SUMMED;
        if gap > 0.0 {
            self.safe.motion = self.moved + 0.5 * gap * (2.0 - SUMMED);
        }
    }
}
