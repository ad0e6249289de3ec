//! Processor time of the calling thread, where the system tells it; else the wall clock's.

use std::time::Duration;

/// A running clock.
pub struct Stopwatch(Duration);

impl Stopwatch {
    /// Starts.
    pub fn start() -> Self {
        Self(now())
    }

    /// Seconds since the start.
    pub fn seconds(&self) -> f64 {
        now().saturating_sub(self.0).as_secs_f64()
    }

    /// Nanoseconds since the start, for each of `count`.
    pub fn nanoseconds_each(&self, count: usize) -> f64 {
        self.seconds() * 1.0e9 / count.max(1) as f64
    }
}

#[cfg(unix)]
fn now() -> Duration {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    Duration::new(time.tv_sec.try_into().unwrap_or(0), time.tv_nsec.try_into().unwrap_or(0))
}

#[cfg(not(unix))]
fn now() -> Duration {
    use std::sync::OnceLock;
    use std::time::Instant;
    static START: OnceLock<Instant> = OnceLock::new();
    START.get_or_init(Instant::now).elapsed()
}

/// Repetitions of a timed run, of which the fastest counts.
const ROUNDS: usize = 3;

/// Answers about all cases, and nanoseconds for one: the fastest of three runs.
///
/// # Errors
/// The first case's that fails.
pub fn answers<C, T>(
    cases: &[C],
    mut ask: impl FnMut(&C) -> Result<T, String>,
) -> Result<(Vec<T>, f64), String> {
    fastest(
        || {
            let watch = Stopwatch::start();
            let answers = cases.iter().map(&mut ask).collect::<Result<Vec<T>, String>>()?;
            Ok((answers, watch.nanoseconds_each(cases.len())))
        },
        |run| run.1,
    )
}

/// The fastest of three runs: others on the machine can only slow a run down. `time` reads a run's
/// time.
///
/// # Errors
/// The first run's that fails.
pub fn fastest<T>(
    mut run: impl FnMut() -> Result<T, String>,
    time: impl Fn(&T) -> f64,
) -> Result<T, String> {
    let mut best = run()?;
    for _ in 1..ROUNDS {
        let next = run()?;
        if time(&next) < time(&best) {
            best = next;
        }
    }
    Ok(best)
}
