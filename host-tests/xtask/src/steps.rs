//! Named steps, their times, and the summary that a CI reads.

use std::process::ExitCode;
use std::time::Instant;

/// What was run so far.
#[derive(Debug, Default)]
pub struct Steps {
    passed: usize,
    failed: Vec<String>,
}

impl Steps {
    /// No step yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Runs a step and says how it went. A failed step yields `None`; the steps that need its
    /// result are the caller's to skip.
    pub fn run<T>(&mut self, name: &str, step: impl FnOnce() -> Result<T, String>) -> Option<T> {
        say!("── {name}");
        let begun = Instant::now();
        let result = step();
        let seconds = begun.elapsed().as_secs_f64();
        match result {
            Ok(value) => {
                say!("   {name}: ok ({seconds:.1} s)");
                self.passed += 1;
                Some(value)
            }
            Err(reason) => {
                say!("   {name}: FAILED ({seconds:.1} s)\n{reason}");
                self.failed.push(name.to_owned());
                None
            }
        }
    }

    /// Prints the summary; the exit code tells whether every step passed.
    pub fn finish(self) -> ExitCode {
        for name in &self.failed {
            say!("failed: {name}");
        }
        say!("{} passed, {} failed", self.passed, self.failed.len());
        if self.failed.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
    }
}
