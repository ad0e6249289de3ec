//! Named steps, their times, and the summary that a CI reads.

use std::process::ExitCode;
use std::time::Instant;

use crate::process;

/// Steps from which on the summary lists the times.
const MANY: usize = 8;

/// The steps so far.
#[derive(Debug, Default)]
pub struct Steps {
    passed: usize,
    failed: Vec<String>,
    times: Vec<Time>,
}

/// What a step took.
#[derive(Debug)]
struct Time {
    name: String,
    seconds: f64,
    /// Of the step's processes, on all cores.
    processor: f64,
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
        let (begun, before) = (Instant::now(), process::processor_seconds());
        let result = step();
        let processor = process::processor_seconds() - before;
        self.tell(name, begun.elapsed().as_secs_f64(), processor, result)
    }

    /// A step that ran beside others, on one core.
    pub fn ended<T>(&mut self, name: &str, seconds: f64, result: Result<T, String>) -> Option<T> {
        self.tell(name, seconds, seconds, result)
    }

    fn tell<T>(
        &mut self,
        name: &str,
        seconds: f64,
        processor: f64,
        result: Result<T, String>,
    ) -> Option<T> {
        self.times.push(Time { name: name.to_owned(), seconds, processor });
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
            say!("\nseconds  of processors  step");
            for Time { name, seconds, processor } in &self.times {
                if *seconds >= 1.0 {
                    say!("{seconds:>7.1}  {processor:>13.1}  {name}");
                }
            }
            let all: f64 = self.times.iter().map(|time| time.processor).sum();
            say!("{all:>22.1}  all");
        }
        for name in &self.failed {
            say!("failed: {name}");
        }
        say!("{} passed, {} failed", self.passed, self.failed.len());
        if self.failed.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
    }
}
