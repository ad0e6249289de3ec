//! Progress bars, on a terminal only.

use indicatif::{ProgressBar, ProgressStyle};
use meshsweep::tight::{HullStage as Stage, Progress};
use std::io::IsTerminal;

/// A bar that is cleared when it is dropped.
pub struct Bar(Option<ProgressBar>);

impl Bar {
    /// A bar over `length` things. `doing` is a verb, `things` a noun.
    pub fn new(length: usize, doing: &str, things: &str) -> Self {
        let bar = std::io::stderr().is_terminal().then(|| {
            let bar = ProgressBar::new(length as u64);
            let template = format!("{doing} {{wide_bar}} {{pos}}/{{len}} {things}, {{eta}} left");
            if let Ok(style) = ProgressStyle::with_template(&template) {
                bar.set_style(style);
            }
            bar
        });
        Bar(bar)
    }

    pub fn show(&self, position: usize) {
        if let Some(bar) = &self.0 {
            bar.set_position(position as u64);
        }
    }

    pub fn advance(&self, by: usize) {
        if let Some(bar) = &self.0 {
            bar.inc(by as u64);
        }
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        if let Some(bar) = &self.0 {
            bar.finish_and_clear();
        }
    }
}

/// A bar for each stage of making a tight hull.
#[derive(Default)]
pub struct StageBars {
    stage: Option<(Stage, usize)>,
    bar: Option<Bar>,
}

impl StageBars {
    pub fn show(&mut self, progress: Progress) {
        let stage = (progress.stage, progress.of);
        if self.stage != Some(stage) {
            let (doing, things) = match progress.stage {
                Stage::Collapsing => ("collapsing", "faces"),
                Stage::Wrapping => ("wrapping", "faces"),
                Stage::Polishing => ("polishing", "steps"),
            };
            // Clears the old bar before the new one is drawn.
            self.bar = None;
            self.bar = Some(Bar::new(progress.of, doing, things));
            self.stage = Some(stage);
        }
        if let Some(bar) = &self.bar {
            bar.show(progress.done);
        }
    }
}
