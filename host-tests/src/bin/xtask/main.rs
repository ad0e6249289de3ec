//! `cargo xtask`: what takes more than one cargo command. This file only dispatches.
//!
//! ```text
//! checks (fmt, clippy, tests, docs) ┐
//! firmware ─┬ images ─ cross ───────┼─ toolbox (Debian packages, unpacked aside)
//!           ├ qemu ─────────────────┘
//!           ├ reading (what an image printed) ─ compared with the host's own run
//!           ├ proof   (no panic left)
//!           └ elf     (sizes) ─ table
//! fixtures ── generators and builder
//! measuring ─ host_tests::measure, firmware, valgrind
//! count ───── valgrind (callgrind) on this program itself
//! racing ──── host_tests::race, valgrind
//! rival ───── images of other engines, in the emulator
//! ```

#[macro_use]
mod say;

mod blobs;
mod boards;
mod checks;
mod count;
mod cross;
mod elf;
mod firmware;
mod fixtures;
mod hulls;
mod images;
mod measuring;
mod process;
mod proof;
mod qemu;
mod racing;
mod reading;
mod rival;
mod steps;
mod table;
mod toolbox;
mod valgrind;
mod workspace;

use std::process::ExitCode;

use steps::Steps;
use valgrind::Valgrind;

const USAGE: &str = "\
cargo xtask setup                   makes sure of the cross targets, of QEMU and of valgrind
cargo xtask test                    setup, then everything that has to hold
cargo xtask firmware [--json FILE]  only the firmware: bits, panics, sizes, instructions
cargo xtask fixtures                writes fixtures/ anew
cargo xtask measure [--firmware] [--tree | --triboxes | --overlap | --tight | --bounds [--count]] [--json FILE] [--plot FILE.svg] [--picture FILE.svg] [MESH...]
                                    work, times, sizes and agreement (default: bracket.stl and torus.ply of fixtures/);
                                    --tree: only the box tree's; --triboxes: the stored ones; --overlap: the mesh
                                    against itself; --tight: tight hulls, each proved, drawn with --picture, on a Cortex-M4F with --firmware; --bounds: how tight boxes,
                                    triboxes, hulls... are and what they cost, with --count in instructions too; --plot: error against cost
cargo xtask count                   instructions a query, by callgrind, and whether eight lanes are vectors
cargo xtask race [--count] [--quick] [--hull] [--json FILE] [MESH...]
                                    this library, parry3d, obvhs and a plain loop on the same queries: times or, with
                                    --count, instructions; --hull: the hull engine on large meshes too
                                    (AVX2: RUSTFLAGS=\"-C target-cpu=x86-64-v3\" cargo xtask race)
cargo xtask rival [MESH] [--faces COUNT,COUNT...] [--seed NUMBER]
                                    parry3d on a Cortex-M4F (default: a rough sphere at 2500,10000)

environment:
  MESHSWEEP_STD=rustup|debian       where the cross targets' std comes from (default: rustup, else debian)
  MESHSWEEP_TOOLS=DIR               where Debian packages are unpacked (default: ~/.cache/meshsweep-tools)";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let mut steps = Steps::new();
    match words.as_slice() {
        ["setup"] => {
            firmware::setup(&mut steps);
            say!("── setup: valgrind");
            Valgrind::find();
        }
        ["test"] => {
            // First, because it is what fails on a new machine, and it tells the remedy.
            let tools = firmware::setup(&mut steps);
            checks::run(&mut steps);
            count::check_lanes(&mut steps);
            if let Some(tools) = tools {
                firmware::run(&mut steps, &tools, None);
            }
        }
        ["firmware", rest @ ..] => {
            let json = match rest {
                [] => None,
                ["--json", file] => Some(std::path::Path::new(*file)),
                _ => return usage(),
            };
            if let Some(tools) = firmware::setup(&mut steps) {
                firmware::run(&mut steps, &tools, json);
            }
        }
        ["fixtures"] => fixtures::write(&mut steps),
        ["measure", rest @ ..] => match measuring::Options::parse(rest) {
            Some(options) => measuring::run(&mut steps, &options),
            None => return usage(),
        },
        ["count"] => count::run(&mut steps),
        ["rival", rest @ ..] => match rival::Options::parse(rest) {
            Some(options) => rival::run(&mut steps, &options),
            None => return usage(),
        },
        ["race", rest @ ..] => match racing::Options::parse(rest) {
            Some(options) => racing::run(&mut steps, &options),
            None => return usage(),
        },
        // What `count` runs in the simulator.
        ["ask", question, queries] => {
            let Ok(queries) = queries.parse() else { return usage() };
            steps.run(question, || count::ask(question, queries));
        }
        // What `measure --bounds --count` runs in the simulator.
        ["ask-bounds", mesh] => {
            steps.run(mesh, || measuring::ask(mesh));
        }
        // What `race --count` runs in the simulator.
        ["ask-engine", engine, mesh, hull_triangles] => {
            let Ok(hull_triangles) = hull_triangles.parse() else { return usage() };
            steps.run(engine, || racing::ask(engine, mesh, hull_triangles));
        }
        _ => return usage(),
    }
    steps.finish()
}

fn usage() -> ExitCode {
    eprintln!("{USAGE}");
    ExitCode::from(2)
}
