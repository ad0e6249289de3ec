//! `cargo xtask measure --robot`: an arm that guards itself, on a board and here.

use std::path::PathBuf;

use meshsweep_lab::measure::robot::{Asked, Costs, Workload, json, table, table_of_verdicts};
use meshsweep_xtask::boards::{BOARDS, Board, CORTEX_M7};
use meshsweep_xtask::reading::Reading;
use meshsweep_xtask::say;
use meshsweep_xtask::steps::Steps;
use meshsweep_xtask::{tools, workspace};

/// Pairs of each range of distances, at most, if all rows are asked.
const PAIRS: usize = 60;

/// What to measure.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Options {
    folder: PathBuf,
    every: usize,
    is_json: bool,
    /// Random pairs, of no board.
    oracle: Option<usize>,
    is_m7: bool,
}

impl Options {
    /// `DIR [--every COUNT] [--cpu m7] [--json] [--oracle PAIRS]`; `None` if that is not what the
    /// words are.
    pub fn parse(words: &[&str]) -> Option<Self> {
        let (mut folder, mut every, mut is_json, mut oracle) = (None, 1, false, None);
        let mut is_m7 = false;
        let mut words = words.iter();
        while let Some(&word) = words.next() {
            match word {
                "--every" => every = words.next()?.parse().ok().filter(|every| *every > 0)?,
                "--json" => is_json = true,
                "--cpu" => is_m7 = (*words.next()? == "m7").then_some(true)?,
                "--oracle" => oracle = Some(words.next()?.parse().ok()?),
                flag if flag.starts_with("--") => return None,
                name => {
                    if folder.replace(PathBuf::from(name)).is_some() {
                        return None;
                    }
                }
            }
        }
        Some(Self { folder: folder?, every, is_json, oracle, is_m7 })
    }
}

/// Asks on the first board and here; prints the table or the numbers.
pub fn run(steps: &mut Steps, options: &Options) {
    if options.is_json {
        say::aside();
    }
    if let Some(pairs) = options.oracle {
        steps.run("pairs beside the oracle", || {
            table_of_verdicts(&options.folder, pairs).map(|table| say::text(table.text()))
        });
        return;
    }
    let Some(tools) = tools::setup(steps) else { return };
    let read = || Workload::read(&options.folder, options.every, PAIRS.div_ceil(options.every));
    let Some(workload) = steps.run("the arm", read) else { return };
    let laid = workload.laid();
    let Some(here) = steps.run("here", || Asked::of(&workload, &laid)) else { return };
    let [first, ..] = BOARDS;
    let board: Board = if options.is_m7 { CORTEX_M7 } else { first };
    steps.run(board.cpu, || {
        let file = workspace::target().join("robot.bin");
        std::fs::write(&file, &laid).map_err(|error| format!("{}: {error}", file.display()))?;
        let image = tools.image(&board, "robot")?;
        let expected = Reading::parse(&here.expected, None)?;
        let reading = tools.asked(&board, &image, (&file, board.loaded), &expected, u32::MAX)?;
        let there = Costs::new(&workload, &reading.each)?;
        let times = Costs::new(&workload, &here.nanoseconds)?;
        if options.is_json {
            print!("{}", json(&there, &times, &here));
            return Ok(());
        }
        let mut table = table(board.cpu, &there, &times, &here);
        let stack = |kind: &str| {
            let found = reading.costs.iter().find(|cost| cost.kind == kind);
            found.map_or(0, |cost| cost.stack)
        };
        table.note(format!(
            "blobs {} bytes, the guard's memory {}; stack of a tick {}, of a pair {}",
            workload.bytes(),
            reading.scratch,
            stack("ticks"),
            stack("pairs"),
        ));
        say::text(table.text());
        Ok(())
    });
}

#[cfg(test)]
mod tests {
    use super::Options;
    use std::path::PathBuf;

    #[test]
    fn a_folder_and_flags_come_in_any_order() {
        let options = Options::parse(&["--every", "5", "arm", "--json"]).expect("fine");
        assert_eq!(
            options,
            Options {
                folder: PathBuf::from("arm"),
                every: 5,
                is_json: true,
                oracle: None,
                is_m7: false,
            }
        );
        assert_eq!(Options::parse(&["arm"]).expect("fine").every, 1);
        assert!(Options::parse(&["arm", "--cpu", "m7"]).expect("fine").is_m7);
        for words in [&["--json"][..], &["a", "b"], &["a", "--every", "0"], &["a", "--fast"]] {
            assert_eq!(Options::parse(words), None);
        }
    }
}
