//! What a search found lately about an edge. Stars that share a face ask for the same point of the
//! mesh, and a search that begins with it passes over most of the mesh.

use glam::DVec3;
use rustc_hash::FxBuildHasher;
use std::hash::BuildHasher;
use std::sync::atomic::{AtomicU32, Ordering};

/// Hints: a hull of 1,000 faces has 3,000 pairs of a face and an edge.
const COUNT: usize = 1 << 13;

/// No hint.
const NONE: u32 = u32::MAX;

/// An item for an edge, shared by all threads. A hint may be of another edge or missing, so no
/// result may depend on it.
#[derive(Debug)]
pub(super) struct Hints(Box<[AtomicU32]>);

/// The hint for an edge.
pub(super) struct Hint<'h>(&'h AtomicU32);

impl Default for Hints {
    fn default() -> Self {
        Self((0..COUNT).map(|_| AtomicU32::new(NONE)).collect())
    }
}

/// A clone begins without hints.
impl Clone for Hints {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl Hints {
    /// The hint for an edge.
    pub fn about(&self, ends: [DVec3; 2]) -> Hint<'_> {
        let hash = FxBuildHasher.hash_one(ends.map(|p| p.to_array().map(f64::to_bits)));
        Hint(&self.0[hash as usize % COUNT])
    }
}

impl Hint<'_> {
    pub fn get(&self) -> Option<usize> {
        let item = self.0.load(Ordering::Relaxed);
        (item != NONE).then_some(item as usize)
    }

    pub fn set(&self, item: usize) {
        self.0.store(item as u32, Ordering::Relaxed);
    }
}
