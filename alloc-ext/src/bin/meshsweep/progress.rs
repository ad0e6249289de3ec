//! The progress bar of the collapses, on a terminal only.

use indicatif::{ProgressBar, ProgressStyle};
use meshsweep_alloc::collapse::Progress;
use std::io::IsTerminal;

/// From a mesh's faces down to a hull's. It goes away when it is dropped.
pub struct Bar {
    bar: Option<ProgressBar>,
    from: usize,
}

impl Bar {
    pub fn new(from: usize, to: usize) -> Self {
        let bar = std::io::stderr().is_terminal().then(|| {
            let bar = ProgressBar::new(from.saturating_sub(to) as u64);
            let template = "collapsing {wide_bar} {pos}/{len} faces, {eta} left";
            if let Ok(style) = ProgressStyle::with_template(template) {
                bar.set_style(style);
            }
            bar
        });
        Bar { bar, from }
    }

    pub fn show(&self, progress: Progress) {
        if let Some(bar) = &self.bar {
            bar.set_position(self.from.saturating_sub(progress.faces) as u64);
        }
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
