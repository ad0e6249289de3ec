//! Named steps, their times, and the summary that a CI reads.

use std::process::ExitCode;
use std::time::Instant;

/// Steps from which on the summary lists the times.
const MANY: usize = 8;

/// The steps so far.
#[derive(Debug, Default)]
pub struct Steps {
    passed: usize,
    failed: Vec<String>,
    times: Vec<(String, f64)>,
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
        self.ended(name, begun.elapsed().as_secs_f64(), result)
    }

    /// A step that ran beside others.
    pub fn ended<T>(&mut self, name: &str, seconds: f64, result: Result<T, String>) -> Option<T> {
        self.times.push((name.to_owned(), seconds));
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

    /// Takes steps that ran beside these.
    pub fn append(&mut self, mut others: Self) {
        self.passed += others.passed;
        self.failed.append(&mut others.failed);
        self.times.append(&mut others.times);
    }

    /// Prints the summary; the exit code tells whether every step passed.
    pub fn finish(self) -> ExitCode {
        if self.times.len() >= MANY {
            say!("\nseconds  step");
            for (name, seconds) in self.times.iter().filter(|(_, seconds)| *seconds >= 1.0) {
                say!("{seconds:>7.1}  {name}");
            }
        }
        for name in &self.failed {
            say!("failed: {name}");
        }
        say!("{} passed, {} failed", self.passed, self.failed.len());
        if self.failed.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
    }
}
