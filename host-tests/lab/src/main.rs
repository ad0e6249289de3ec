//! `cargo xtask measure`, `race` and `rival`: this file only dispatches.
//!
//! ```text
//! measuring ─ measure, hulls_on_board, fans_on_board
//! robot ───── measure::robot, in the emulator
//! racing ──── race
//! batch ───── a batch of the library, timed
//! rival ───── images of other engines, in the emulator
//! ```

mod batch;
mod fans_on_board;
mod hulls_on_board;
mod measuring;
mod racing;
mod rival;
mod robot;

use std::path::Path;
use std::process::ExitCode;

use meshsweep_lab::measure::paper;
use meshsweep_xtask::say;
use meshsweep_xtask::steps::Steps;

const USAGE: &str = "\
cargo xtask measure [--tree | --triboxes | --deform | --overlap | --field [--queries COUNT]
                    | --tight [--firmware] | --paper TABLE [--firmware]] [MESH...]
cargo xtask measure --margins TRIALS
          work, times, sizes and agreement (default: bracket.stl and torus.ply of fixtures/)
          --tree      only the box tree's
          --triboxes  the stored ones
          --deform    the hull hierarchy under motions
          --overlap   whether the mesh meets itself, moved
          --field     distance fields beside a plain grid of as many bytes, at so many points
          --tight     tight hulls, each proved, on a Cortex-M4F with --firmware
          --paper     a table of the papers; alone: the list of tables; 003.3 on a Cortex-M4F and
                      a Cortex-M0 with --firmware
          --margins   how much of each margin for rounding is used, in so many trials, of no mesh
cargo xtask measure --robot DIR [--every COUNT] [--cpu m7] [--json | --oracle PAIRS]
          an arm that guards itself at 1 kHz, on a Cortex-M4F and here: instructions a tick and a
          pair, and verdicts beside the true ones. DIR has the links' meshes, path.csv, ticks.csv
          --every     every so many places of the path, such a part of each run of ticks
          --cpu m7    a Cortex-M7, by code for its unit for f64
          --json      only the numbers that have targets, on the standard output
          --oracle    verdicts about so many random pairs, a tenth at their threshold; no board
cargo xtask race [--pairs] [--quick] [MESH...]
                                    this library, parry3d and obvhs on the same queries
                                    (AVX2: RUSTFLAGS=\"-C target-cpu=x86-64-v3\" cargo xtask race)
          --pairs     the distance of two models, and whether they are near each other
          --quick     fewer queries
cargo xtask race --hausdorff MESH MESH
                                    the Hausdorff distance of two meshes
cargo xtask race --batch BLOB POINTS
                                    seconds of exact closest points by one batch; POINTS has three
                                    f32 a point
cargo xtask rival [MESH] [--faces COUNT,COUNT...] [--seed NUMBER]
                                    parry3d on a Cortex-M4F (default: a rough sphere at 2500,10000)";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let mut steps = Steps::new();
    match words.as_slice() {
        ["measure", "--paper"] => say::text(paper::list().text()),
        ["measure", "--robot", rest @ ..] => match robot::Options::parse(rest) {
            Some(options) => robot::run(&mut steps, &options),
            None => return usage(),
        },
        ["measure", rest @ ..] => match measuring::Options::parse(rest) {
            Some(options) => measuring::run(&mut steps, options),
            None => return usage(),
        },
        // The number alone, for the script that reads it.
        ["race", "--batch", blob, points] => {
            return match batch::seconds(Path::new(blob), Path::new(points)) {
                Ok(seconds) => {
                    say::text(format_args!("{seconds}\n"));
                    ExitCode::SUCCESS
                }
                Err(error) => {
                    eprintln!("{error}");
                    ExitCode::FAILURE
                }
            };
        }
        ["race", rest @ ..] => {
            if racing::run(&mut steps, rest).is_none() {
                return usage();
            }
        }
        ["rival", rest @ ..] => match rival::Options::parse(rest) {
            Some(options) => rival::run(&mut steps, &options),
            None => return usage(),
        },
        _ => return usage(),
    }
    steps.finish()
}

fn usage() -> ExitCode {
    eprintln!("{USAGE}");
    ExitCode::from(2)
}

#[cfg(test)]
mod tests {
    use super::USAGE;

    #[test]
    fn the_usage_names_every_flag_that_is_parsed() {
        let sources = [
            include_str!("measuring.rs"),
            include_str!("racing.rs"),
            include_str!("rival.rs"),
            include_str!("robot.rs"),
        ];
        // Patterns: other flags are passed on to other programs.
        let is_pattern = |line: &&str| line.contains("=>") || line.contains("let [");
        let patterns = sources.iter().flat_map(|source| source.lines()).filter(is_pattern);
        let words = patterns.flat_map(|line| line.split('"'));
        let flags: Vec<&str> =
            words.filter(|word| word.starts_with("--") && word.len() > 2).collect();
        assert!(flags.len() > 15, "{flags:?}");
        for flag in flags {
            assert!(USAGE.contains(flag), "{flag} is not in the usage");
        }
    }
}
