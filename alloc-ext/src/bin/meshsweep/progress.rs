//! Progress bars, on a terminal only.

use indicatif::{ProgressBar, ProgressStyle};
use meshsweep::builder::Stage;
use meshsweep::tight::{self, HullStage, Progress};
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

/// A bar for each stage of making hulls.
#[derive(Default)]
pub struct StageBars {
    stage: Option<(&'static str, usize)>,
    bar: Option<Bar>,
}

impl StageBars {
    pub fn show(&mut self, progress: Progress) {
        let (doing, things) = match progress.stage {
            HullStage::Collapsing => ("collapsing", "faces"),
            HullStage::Wrapping => ("wrapping", "faces"),
            HullStage::Polishing => ("polishing", "steps"),
        };
        self.step(doing, things, progress.done, progress.of);
    }

    /// Of a build, stages without a count have no bar.
    pub fn show_build(&mut self, stage: Stage) {
        match stage {
            Stage::Hull { done, of } => self.step("collapsing", "faces", done, of),
            Stage::Tight(tight::Stage::Wrapping { progress, .. }) => self.show(progress),
            _ => *self = Self::default(),
        }
    }

    fn step(&mut self, doing: &'static str, things: &str, done: usize, of: usize) {
        if self.stage != Some((doing, of)) {
            // Clears the old bar before the new one is drawn.
            self.bar = None;
            self.bar = Some(Bar::new(of, doing, things));
            self.stage = Some((doing, of));
        }
        if let Some(bar) = &self.bar {
            bar.show(done);
        }
    }
}
