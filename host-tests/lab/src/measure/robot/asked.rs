//! The questions asked on this machine: answers, verdicts beside the truth, and times.

use std::time::Instant;

use meshsweep_core::Verdict;
use meshsweep_suite::Observer;
use meshsweep_suite::ask::robot::{self, Answer, Laid, Memory};
use meshsweep_suite::fold::Fold;

use super::workload::{Single, Workload};

/// Runs, of which each question's fastest counts.
const RUNS: usize = 5;

/// The pose of a pair is rounded in another frame than the poses of its models: its distance may
/// differ from the true one by this, in metres.
const ROUNDED: f64 = 2e-6;

/// What was answered.
#[derive(Clone, Debug)]
pub struct Asked {
    /// What a board must print: hashes of all answers.
    pub expected: String,
    /// The fastest time of each question, nanoseconds.
    pub nanoseconds: Vec<f64>,
    /// Ticks that are said to be clear, and are not.
    pub false_clear: usize,
    /// Ticks that are not said to be clear, and are.
    pub false_alarm: usize,
    /// Ticks that are clear.
    pub clear: usize,
    /// Ticks that are not.
    pub stops: usize,
}

#[derive(Default)]
struct Watch {
    begun: Option<Instant>,
    each: Vec<f64>,
}

impl Observer for Watch {
    fn query_begins(&mut self) {
        self.begun = Some(Instant::now());
    }

    fn query_ends(&mut self) {
        let time = self.begun.take().map(|begun| begun.elapsed().as_secs_f64() * 1e9);
        self.each.extend(time);
    }
}

impl Asked {
    /// Asks all questions.
    ///
    /// # Errors
    /// A refusal, or an answer about a pair that is wrong.
    pub fn of(workload: &Workload, laid: &[u8]) -> Result<Self, String> {
        let refused = |error: meshsweep_suite::ask::Refused| {
            format!("the core refuses a blob: error {}", error.0)
        };
        let (read, bytes) = Laid::read(laid).map_err(refused)?;
        let mut asked = Self {
            expected: String::new(),
            nanoseconds: Vec::new(),
            false_clear: 0,
            false_alarm: 0,
            clear: 0,
            stops: 0,
        };
        for run in 0..RUNS {
            let mut memory = Box::new(Memory::new());
            let (mut watch, mut verdicts, mut answers) = (Watch::default(), Vec::new(), Vec::new());
            let mut folds = [Fold::new(), Fold::new()];
            robot::ticks(&read, &mut memory, &mut watch, |verdict| {
                robot::told(&mut folds[0], verdict);
                verdicts.push(*verdict);
            });
            robot::pairs(&read, &mut memory, &mut watch, |answer: &Answer| {
                answer.told(&mut folds[1]);
                answers.push(*answer);
            });
            if run > 0 {
                let fastest = asked.nanoseconds.iter_mut().zip(watch.each);
                fastest.for_each(|(least, time)| *least = least.min(time));
                continue;
            }
            asked.nanoseconds = watch.each;
            let hashes = folds.map(|fold| fold.finish());
            asked.expected = format!(
                "blob {bytes} {:016x}\nblock ticks 0 {:016x}\nblock pairs 0 {:016x}\ndone\n",
                Fold::of_bytes(&laid[..bytes]),
                hashes[0],
                hashes[1]
            );
            for (tick, verdict) in workload.ticks.iter().zip(verdicts) {
                let is_said = verdict.map_err(|error| error.to_string())? == Verdict::No;
                asked.false_clear += usize::from(is_said && !tick.is_clear());
                asked.false_alarm += usize::from(!is_said && tick.is_clear());
                *(if tick.is_clear() { &mut asked.clear } else { &mut asked.stops }) += 1;
            }
            let wrong = workload
                .singles
                .iter()
                .zip(answers)
                .find(|(single, answer)| !is_right(single, answer));
            if let Some((single, answer)) = wrong {
                return Err(format!("{answer:?} about {single:?}"));
            }
        }
        Ok(asked)
    }
}

/// Whether an answer may be the true one.
fn is_right(single: &Single, answer: &Answer) -> bool {
    match answer {
        Answer::Within(found) => match found.verdict {
            Verdict::Yes => single.beyond() < ROUNDED,
            Verdict::No => single.beyond() > -ROUNDED,
            _ => true,
        },
        Answer::Distance(found) => {
            let [lower, upper] = [found.distance.lower, found.distance.upper].map(f64::from);
            lower - ROUNDED <= single.truth && single.truth <= upper + ROUNDED
        }
        Answer::Refused(_) => false,
    }
}
