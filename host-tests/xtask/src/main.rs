//! `cargo xtask`: what takes more than one cargo command. This file only dispatches.

use std::num::NonZeroU32;
use std::panic::resume_unwind;
use std::process::ExitCode;
use std::thread;

use meshsweep_xtask::boards::{BOARDS, Board};
use meshsweep_xtask::cost::Row;
use meshsweep_xtask::count_suite::Counted;
use meshsweep_xtask::firmware::Scope;
use meshsweep_xtask::guard::Costs;
use meshsweep_xtask::steps::Steps;
use meshsweep_xtask::tables::Facts;
use meshsweep_xtask::tools::{Tools, setup};
use meshsweep_xtask::valgrind::Valgrind;
use meshsweep_xtask::{
    c_checks, checks, count, count_suite, dist, examples, firmware, fit, fuzz, host, processors,
    python, question, release, report, rival, say, tables, web,
};

const USAGE: &str = "\
cargo xtask setup                   makes sure of the cross targets, of QEMU and of valgrind
cargo xtask test                    setup, then everything that has to hold
cargo xtask test QUESTION           what a change of a question can break, such as `closest_point`
cargo xtask firmware                only the firmware: bits, panics, sizes, instructions
cargo xtask examples                only core/examples, on a Cortex-M4F, and defmt
cargo xtask c                       only the C interface: its programs here and in QEMU
cargo xtask python                  the Python package: its wheel in target/dist, types, tests
cargo xtask python race MESH...     the same beside other packages of PyPI
cargo xtask dist [TARGET...]        static libraries for C, an archive a target, in target/dist;
                                    manual: shell completions and man pages of the program
cargo xtask fuzz [MINUTES] [TARGET...]
                                    fuzzes each target for 30 minutes; keeps inputs for `cargo test`
cargo xtask processors              the committed bits on i686, AArch64, and with all vectors here
cargo xtask fixtures                writes fixtures/ anew
cargo xtask picture                 writes fixtures/part.svg anew, the picture of README.md
cargo xtask tables                  writes the documents' tables of bytes and instructions anew
cargo xtask count [QUESTION...]     instructions a query, by callgrind; are eight lanes vectors?
cargo xtask count --all [--write] [PROCESSOR...]
                                    all instructions and bytes, of the boards and of this machine
                                    (x86-64), beside host-tests/costs.txt; or writes the file anew
cargo xtask count --board QUESTION...
                                    the same on Cortex-M4F and M0, of `bvh`, `sweep`, `refine` BLOB ...
cargo xtask fit [MESH...]           fits the costs by which `meshsweep trade` predicts instructions
cargo xtask fit --kept              the same from the counts of the last run
cargo xtask report [MESH...]        tests the page of `meshsweep trade --report` in Chromium
cargo xtask web                     the page of WebAssembly: target/dist/web/index.html, in Chromium
cargo xtask release [--write]       before publishing: the oldest Rust, docs.rs, a dry run, and the
                                    public interface beside its list; or writes the lists anew
cargo xtask measure|race|rival ...  the laboratory, a crate of its own: `cargo xtask measure --help`

environment:
  MESHSWEEP_STD=rustup|debian       where the cross targets' std comes from (default: rustup, else debian)
  MESHSWEEP_TOOLS=DIR               where Debian packages are unpacked (default: ~/.cache/meshsweep-tools)";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let mut steps = Steps::new();
    match words.as_slice() {
        ["setup"] => {
            setup(&mut steps);
            say!("── setup: valgrind");
            Valgrind::find();
        }
        ["test"] => {
            // First, because a new machine fails here, and the message tells the remedy.
            let tools = setup(&mut steps);
            // Beside the rest, in folders of their own: long links and long tests leave a processor
            // without work.
            let (rows, counts, here, others) = thread::scope(|scope| {
                let beside = scope.spawn(|| {
                    let mut steps = Steps::new();
                    let build = |tools| firmware::build(&mut steps, tools, Scope::Compared);
                    let images = tools.as_ref().and_then(build);
                    let counts = count::for_test(&mut steps);
                    if let Some(counts) = &counts {
                        count::check_lanes(&mut steps, counts);
                    }
                    if let Some(tools) = &tools {
                        examples::run(&mut steps, tools);
                        c_checks::run(&mut steps, tools);
                        steps.run("the laboratory's images build", || rival::builds(tools));
                    }
                    let mut rows = Vec::new();
                    if let (Some(tools), Some(images)) = (&tools, images) {
                        rows = firmware::ask(&mut steps, tools, &images, Scope::Compared);
                    }
                    let here = count_suite::run(&mut steps);
                    checks::lints(&mut steps);
                    python::lints(&mut steps);
                    (rows, counts, here, steps)
                });
                checks::run(&mut steps);
                beside.join().unwrap_or_else(|panic| resume_unwind(panic))
            });
            steps.append(others);
            tables::check(&mut steps, &Facts { counts: counts.as_ref(), rows: &rows });
            guarded(&mut steps, tools.as_ref(), &rows, Scope::Compared, &here, Costs::check);
        }
        ["test", method] => {
            let tools = setup(&mut steps);
            question::run(&mut steps, tools.as_ref(), method);
        }
        ["firmware"] => {
            if let Some(tools) = setup(&mut steps) {
                let rows = firmware::run(&mut steps, &tools);
                guarded(&mut steps, Some(&tools), &rows, Scope::All, &[], Costs::check);
            }
        }
        ["examples"] => {
            if let Some(tools) = setup(&mut steps) {
                examples::run(&mut steps, &tools);
            }
        }
        ["c"] => {
            if let Some(tools) = setup(&mut steps) {
                c_checks::run(&mut steps, &tools);
            }
        }
        ["python"] => python::run(&mut steps),
        ["python", "race", meshes @ ..] => python::race(&mut steps, meshes),
        ["dist", targets @ ..] => dist::run(&mut steps, targets),
        ["fuzz", words @ ..] => {
            let minutes: Option<NonZeroU32> = words.first().and_then(|word| word.parse().ok());
            let targets = if minutes.is_some() { &words[1..] } else { words };
            fuzz::run(&mut steps, minutes.map_or(30, NonZeroU32::get), targets);
        }
        ["processors"] => processors::run(&mut steps),
        [word @ ("fixtures" | "picture")] => {
            steps.run(word, || host::run(&[*word]).map(|text| say!("{text}")));
        }
        ["tables"] => {
            let tools = setup(&mut steps);
            let counts = count::for_test(&mut steps);
            let run = |tools| firmware::run(&mut steps, tools);
            let rows = tools.as_ref().map(run).unwrap_or_default();
            let here = count_suite::run(&mut steps);
            let facts = Facts { counts: counts.as_ref(), rows: &rows };
            steps.run("tables of the documents", || tables::write(&facts));
            guarded(&mut steps, tools.as_ref(), &rows, Scope::All, &here, |costs, steps| {
                steps.run("costs.txt", || costs.write());
            });
        }
        ["count", "--all", words @ ..] => {
            let (does_write, processors) = match words {
                ["--write", processors @ ..] => (true, processors),
                processors => (false, processors),
            };
            let is_asked = |cpu: &str| processors.is_empty() || processors.contains(&cpu);
            let boards: Vec<Board> =
                BOARDS.into_iter().filter(|board| is_asked(board.cpu)).collect();
            let known = |cpu: &&&str| {
                **cpu == count_suite::CPU || boards.iter().any(|board| board.cpu == **cpu)
            };
            if processors.iter().filter(known).count() < processors.len() {
                return usage();
            }
            let tools = setup(&mut steps);
            let count = |tools| firmware::count(&mut steps, tools, &boards);
            let rows = tools.as_ref().map(count).unwrap_or_default();
            let is_here = is_asked(count_suite::CPU);
            let here = if is_here { count_suite::run(&mut steps) } else { Vec::new() };
            guarded(&mut steps, tools.as_ref(), &rows, Scope::Counted, &here, |costs, steps| {
                say!("{}", costs.text());
                if does_write {
                    steps.run("costs.txt", || costs.write());
                } else {
                    costs.check(steps);
                }
            });
        }
        ["count", "--board", questions @ ..] if !questions.is_empty() => {
            if let Some(tools) = setup(&mut steps) {
                count::on_board(&mut steps, &tools, questions);
            }
        }
        ["fit", "--kept"] => fit::fit_kept(&mut steps),
        ["fit", others @ ..] => {
            if let Some(tools) = setup(&mut steps) {
                fit::run(&mut steps, &tools, others);
            }
        }
        ["release"] => release::run(&mut steps, false),
        ["release", "--write"] => release::run(&mut steps, true),
        ["web"] => web::run(&mut steps),
        ["report", meshes @ ..] => report::run(&mut steps, meshes),
        ["count", questions @ ..] if !questions.iter().any(|word| word.starts_with("--")) => {
            count::run(&mut steps, questions)
        }
        ["measure" | "race" | "rival", ..] => return checks::lab(&words),
        _ => return usage(),
    }
    steps.finish()
}

/// Does something with the numbers that may not rise.
fn guarded(
    steps: &mut Steps,
    tools: Option<&Tools>,
    rows: &[Row],
    scope: Scope,
    here: &[Counted],
    then: impl FnOnce(&Costs, &mut Steps),
) {
    if let Some(costs) = steps.run("the numbers", || Costs::of(tools, rows, scope, here)) {
        then(&costs, steps);
    }
}

fn usage() -> ExitCode {
    eprintln!("{USAGE}");
    ExitCode::from(2)
}
