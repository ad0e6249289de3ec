//! The stages of a build, and how much of it is done.

use crate::tight;
use std::ops::ControlFlow;

/// What a build is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Stage {
    /// Reading and repairing the mesh.
    Loading,
    /// The hull hierarchy: edges collapse, then distances are certified.
    Hull {
        /// Faces that are gone.
        done: usize,
        /// Faces to go.
        of: usize,
    },
    /// The box tree.
    BoxTree,
    /// Triboxes.
    Triboxes,
    /// Tight hulls.
    Tight(tight::Stage),
    /// Curves.
    Curve,
    /// The blob is complete and was opened.
    Done,
}

/// A callback of progress.
pub(super) type OnProgress<'a> = dyn FnMut(Stage, f64) -> ControlFlow<()> + 'a;

/// How much of a build is done. Its parts come one after the other, each with a weight.
pub(super) struct Progress<'p, 'a> {
    on_progress: Option<&'p mut OnProgress<'a>>,
    /// The fraction that was told last.
    told: f64,
    /// The part that is done now.
    part: [f64; 2],
    weight: f64,
}

impl<'p, 'a> Progress<'p, 'a> {
    /// `weight` is that of all parts.
    pub fn new(on_progress: Option<&'p mut OnProgress<'a>>, weight: f64) -> Self {
        Self { on_progress, told: 0.0, part: [0.0; 2], weight }
    }

    /// Begins the next part.
    pub fn begin(&mut self, weight: f64) {
        self.part = [self.part[1], self.part[1] + weight / self.weight];
    }

    /// Tells how much of the part is done. Whether to go on.
    pub fn show(&mut self, stage: Stage, fraction: f64) -> bool {
        let [from, to] = self.part;
        self.told = self.told.max(from + (to - from) * fraction).min(1.0);
        let told = if stage == Stage::Done { 1.0 } else { self.told };
        self.on_progress.as_mut().is_none_or(|show| show(stage, told).is_continue())
    }
}

/// The fraction of a chain of tight hulls that is done.
pub(super) fn of_tight(stage: tight::Stage) -> f64 {
    match stage {
        tight::Stage::Wrapping { hull, of, progress } => {
            let [from, to] = match progress.stage {
                tight::HullStage::Collapsing => [0.0, 0.2],
                tight::HullStage::Wrapping => [0.2, 0.5],
                tight::HullStage::Polishing => [0.5, 0.9],
            };
            let of_stage = progress.done as f64 / progress.of.max(1) as f64;
            (hull as f64 + from + (to - from) * of_stage.min(1.0)) / of.max(1) as f64
        }
        // What was told last holds.
        tight::Stage::Certifying => 0.0,
    }
}
