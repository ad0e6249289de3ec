//! Processor time of this process, where the system tells it; else the wall clock's. The time of one
//! thread would leave out what that thread gives to rayon.

use std::time::{Duration, Instant};

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
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    Duration::new(time.tv_sec.try_into().unwrap_or(0), time.tv_nsec.try_into().unwrap_or(0))
}

#[cfg(not(unix))]
fn now() -> Duration {
    use std::sync::OnceLock;
    static START: OnceLock<Instant> = OnceLock::new();
    START.get_or_init(Instant::now).elapsed()
}

/// Rounds, of which the fastest counts: others on the machine can only slow a run down.
const ROUNDS: usize = 3;

/// A run that takes longer by the wall clock is not repeated.
const LONG: Duration = Duration::from_secs(20);

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

/// The fastest of three runs. `time` reads a run's time.
///
/// # Errors
/// The first run's that fails.
pub fn fastest<T>(
    mut run: impl FnMut() -> Result<T, String>,
    time: impl Fn(&T) -> f64,
) -> Result<T, String> {
    let best = rounds(&mut [()], |()| run(), time)?;
    best.into_iter().next().ok_or_else(|| "no run".to_owned())
}

/// The fastest run of each engine. Within a round every engine has its turn, so that a busy machine
/// hits all alike.
///
/// # Errors
/// The first run's that fails.
pub fn rounds<E, T>(
    engines: &mut [E],
    mut run: impl FnMut(&mut E) -> Result<T, String>,
    time: impl Fn(&T) -> f64,
) -> Result<Vec<T>, String> {
    let mut best: Vec<(Option<T>, Duration)> =
        engines.iter().map(|_| (None, Duration::ZERO)).collect();
    for _ in 0..ROUNDS {
        let turns = engines.iter_mut().zip(&mut best);
        for (engine, (best, took)) in turns.filter(|(_, (_, took))| *took <= LONG) {
            let begun = Instant::now();
            let next = run(engine)?;
            *took = begun.elapsed();
            if best.as_ref().is_none_or(|best| time(&next) < time(best)) {
                *best = Some(next);
            }
        }
    }
    Ok(best.into_iter().filter_map(|(best, _)| best).collect())
}

#[cfg(test)]
mod tests {
    use super::Stopwatch;

    #[test]
    fn the_work_of_another_thread_counts() {
        let watch = Stopwatch::start();
        let other = std::thread::spawn(|| {
            let own = Stopwatch::start();
            for step in 0..10_000_000 {
                std::hint::black_box(step);
            }
            own.seconds()
        });
        let theirs = other.join().expect("no panic");
        assert!(theirs > 0.0 && watch.seconds() >= theirs);
    }
}
