//! How far the point of a sweep may move before another triangle may be the nearest (Guéziec 2000,
//! 3.3).

use crate::hull::format::Instance;

/// Until the path of the point reaches `until`, the nearest triangle is one of `near` (Guéziec
/// 2000, 3.3). The paper keeps one triangle. Triangles that share the closest vertex have no gap
/// between them, so several are kept.
#[derive(Debug)]
pub(super) struct SafeMotion {
    /// The value of `Sweep::moved` up to which this holds. −1: nothing is known.
    pub(super) until: f64,
    pub(super) near: heapless::Vec<Instance, SAFE_TRIANGLES>,
    /// This many searches to come go no farther than they must: an earlier one found too many
    /// triangles.
    pub(super) pause: u8,
}

impl SafeMotion {
    pub(super) const NONE: SafeMotion =
        SafeMotion { until: -1.0, near: heapless::Vec::new(), pause: 0 };
}

/// Triangles that may be nearest within the safe motion: about the star of a vertex.
pub(super) const SAFE_TRIANGLES: usize = 12;
/// A search goes on until the safe motion is this many of the last step, while the triangles fit.
pub(super) const SAFE_STEPS: f64 = 4.0;
/// After a search that found too many triangles, this many searches go no farther than they must.
pub(super) const SAFE_PAUSE: u8 = 8;
