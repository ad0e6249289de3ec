//! When a search has to end.

use crate::clock::Instant;
use std::sync::atomic::{AtomicBool, Ordering};

/// A time, or the caller's request to end before.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Deadline<'a> {
    pub at: Option<Instant>,
    /// Whether the caller's callback has asked to end.
    pub cancelled: Option<&'a AtomicBool>,
}

impl Deadline<'_> {
    pub fn is_cancelled(self) -> bool {
        self.cancelled.is_some_and(|cancelled| cancelled.load(Ordering::Relaxed))
    }

    pub fn has_passed(self) -> bool {
        self.is_cancelled() || self.at.is_some_and(|at| Instant::now() >= at)
    }

    /// Half of the time that is left.
    pub fn half(self) -> Self {
        let now = Instant::now();
        let half = self.at.map(|at| now + at.saturating_duration_since(now) / 2);
        Self { at: half, ..self }
    }
}
