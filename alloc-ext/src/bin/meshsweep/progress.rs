//! Progress bars, on a terminal only.

use indicatif::{ProgressBar, ProgressStyle};
use meshsweep::builder::Stage;
use std::io::IsTerminal;
use std::sync::Mutex;

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

/// A bar that several threads show. Its length is known at the first step.
pub struct SharedBar {
    doing: &'static str,
    things: &'static str,
    bar: Mutex<Option<Bar>>,
}

impl SharedBar {
    /// `doing` is a verb, `things` a noun.
    pub const fn new(doing: &'static str, things: &'static str) -> Self {
        Self { doing, things, bar: Mutex::new(None) }
    }

    /// So many of `of` things are done.
    pub fn show(&self, done: usize, of: usize) {
        if let Ok(mut bar) = self.bar.lock() {
            bar.get_or_insert_with(|| Bar::new(of, self.doing, self.things)).show(done);
        }
    }
}

/// A bar for each stage of a build.
#[derive(Default)]
pub struct StageBars {
    stage: Option<(&'static str, usize)>,
    bar: Option<Bar>,
}

impl StageBars {
    /// Stages without a count have no bar.
    pub fn show(&mut self, stage: Stage) {
        match stage {
            Stage::Collapsing { done, of } => self.step("collapsing", "faces", done, of),
            Stage::Shrinking { done, of } => self.step("wrapping", "faces", done, of),
            Stage::Polishing { done, of } => self.step("polishing", "steps", done, of),
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
