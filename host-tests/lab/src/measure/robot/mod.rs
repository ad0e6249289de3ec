//! An arm that guards itself: what a tick costs, and a pair of models, by their distance.
//!
//! ```text
//! arm (kinematics in f64) ─┬─ workload (poses, pairs, their true distances) ─ asked (on this machine)
//!                          └─ verdicts (random places, and pairs at their thresholds)
//! ```
//! The same bytes are asked on a board. An answer that is wrong is an error; a verdict that is not
//! the true one is counted.

pub mod arm;
mod asked;
mod verdicts;
mod workload;

pub use asked::Asked;
pub use verdicts::table_of_verdicts;
pub use workload::Workload;

use std::fmt::Write as _;

use meshsweep_suite::ask::robot::Question;
use meshsweep_xtask::table::{Cell, Table, fixed, row};

use workload::{APART, BEYOND, Range, Set, Single, is_in};

/// Costs of some questions.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cost {
    /// Of the mean one.
    pub mean: f64,
    /// Of the costliest one.
    pub most: f64,
    /// How many there are.
    pub count: usize,
}

impl Cost {
    fn of(costs: impl Iterator<Item = f64>) -> Self {
        let (mut sum, mut most, mut count) = (0.0, 0f64, 0);
        for cost in costs {
            (sum, most, count) = (sum + cost, most.max(cost), count + 1);
        }
        Self { mean: sum / count.max(1) as f64, most, count }
    }
}

/// Costs of all questions on one processor: of each tick, then of each pair.
#[derive(Clone, Copy, Debug)]
pub struct Costs<'a> {
    workload: &'a Workload,
    each: &'a [f64],
}

impl<'a> Costs<'a> {
    /// The costs of each question, in the order of asking.
    ///
    /// # Errors
    /// Their number is another than that of the questions.
    pub fn new(workload: &'a Workload, each: &'a [f64]) -> Result<Self, String> {
        let asked = workload.ticks.len() + workload.singles.len();
        if each.len() != asked {
            return Err(format!("{} costs of {asked} questions", each.len()));
        }
        Ok(Self { workload, each })
    }

    /// Of the ticks of one file: of all, or of those that are clear or not.
    fn ticks(&self, set: Set, is_clear: Option<bool>) -> Cost {
        let ticks = self.workload.ticks.iter().zip(self.each);
        let wanted = ticks.filter(|(tick, _)| {
            tick.set == set && is_clear.is_none_or(|is_clear| tick.is_clear() == is_clear)
        });
        Cost::of(wanted.map(|(_, cost)| *cost))
    }

    /// Of the pairs in a range.
    fn pairs(&self, question: Question, range: Range, key: fn(&Single) -> f64) -> Cost {
        let costs = &self.each[self.workload.ticks.len()..];
        let pairs = self.workload.singles.iter().zip(costs);
        let wanted = pairs
            .filter(|(single, _)| single.pair.question == question && is_in(range, key(single)));
        Cost::of(wanted.map(|(_, cost)| *cost))
    }

    /// All rows of the table.
    fn rows(&self) -> Vec<(String, Cost)> {
        let mut rows = vec![
            ("a tick, ticks.csv".to_owned(), self.ticks(Set::Ticks, None)),
            ("a tick, path.csv".to_owned(), self.ticks(Set::Path, None)),
            ("- clear ones".to_owned(), self.ticks(Set::Path, Some(true))),
            ("- stops".to_owned(), self.ticks(Set::Path, Some(false))),
        ];
        for (name, range) in BEYOND {
            let cost = self.pairs(Question::Within, range, Single::beyond);
            rows.push((format!("within_of, {name}"), cost));
        }
        for (name, range) in APART {
            let cost = self.pairs(Question::Distance, range, |single| single.truth);
            rows.push((format!("distance, {name}"), cost));
        }
        rows
    }

    /// The numbers of a target, by their keys.
    fn keys(&self) -> [(&'static str, f64); 8] {
        let (ticks, path) = (self.ticks(Set::Ticks, None), self.ticks(Set::Path, None));
        let beyond = |at: usize| self.pairs(Question::Within, BEYOND[at].1, Single::beyond).mean;
        let apart =
            |at: usize| self.pairs(Question::Distance, APART[at].1, |single| single.truth).mean;
        [
            ("tick_mean", ticks.mean),
            ("tick_most", ticks.most),
            ("path_mean", path.mean),
            ("path_most", path.most),
            ("within_far", beyond(5)),
            ("within_exact", beyond(3)),
            ("distance_near", apart(1)),
            ("distance_far", apart(3)),
        ]
    }
}

/// The table for people: instructions on a board, and microseconds here.
#[must_use]
pub fn table(cpu: &str, board: &Costs<'_>, here: &Costs<'_>, asked: &Asked) -> Table {
    let title = format!("An arm of 7 links, a table and a machine: 21 pairs, on a {cpu} and here");
    let columns = ["question", "count", "instructions", "most", "us here", "most, us"];
    let mut table = Table::new("robot", title, &columns);
    for ((name, cost), (_, time)) in board.rows().into_iter().zip(here.rows()) {
        table.push(if cost.count == 0 {
            row![name, 0usize, Cell::Empty, Cell::Empty, Cell::Empty, Cell::Empty]
        } else {
            let [mean, most] = [time.mean, time.most].map(|time| fixed(time / 1e3, 2));
            row![name, cost.count, fixed(cost.mean, 0), fixed(cost.most, 0), mean, most]
        });
    }
    let Asked { false_clear, false_alarm, clear, stops, .. } = asked;
    table.note(format!(
        "all places: {false_clear} false clears of {stops}, {false_alarm} false alarms of {clear}"
    ));
    table.note("a tick places all models and asks about all pairs; kinematics are not in it");
    table.note("us: the fastest of some runs; a tick of the board's counter is 40 instructions");
    table
}

/// The numbers of the targets: the board's, then this machine's in nanoseconds.
#[must_use]
pub fn json(board: &Costs<'_>, here: &Costs<'_>, asked: &Asked) -> String {
    let mut text = String::from("{\n");
    for (key, number) in board.keys() {
        let _ = writeln!(text, "  \"{key}\": {number:.0},");
    }
    let _ = writeln!(text, "  \"false_clear\": {},", asked.false_clear);
    let _ = writeln!(text, "  \"false_alarm\": {},", asked.false_alarm);
    let host = here.keys().map(|(key, number)| format!("    \"{key}\": {number:.0}"));
    let _ = writeln!(text, "  \"host_nanoseconds\": {{\n{}\n  }}\n}}", host.join(",\n"));
    text
}
