//! `cargo xtask count`: instructions a query on this machine, counted by callgrind.
//!
//! Times on a busy machine are noise; instructions are not. The program runs itself in the
//! simulator twice, with different numbers of queries: the difference is the queries' alone.

mod tree;
mod triboxes;

use std::env;
use std::hint::black_box;
use std::path::{Path, PathBuf};

use meshsweep_core::query::{Budget, Search, closest_point, first_hit, outer_hits};
use meshsweep_core::refine::{Face, RefinedHull};
use meshsweep_core::{Model, QueueEntry};
use meshsweep_host_tests::measure::Subject;
use meshsweep_host_tests::measure::table::{Cell, Table, fixed};
use meshsweep_host_tests::measure::workload::{Points, points, segments};

use crate::process;
use crate::steps::Steps;
use crate::valgrind::Valgrind;
use crate::workspace;

pub use tree::check as check_lanes;

/// Questions to the hull hierarchy by their word on the command line.
const QUESTIONS: [&str; 6] = ["far", "near", "path", "first_hit", "outer_first", "outer_all"];

/// Queries of the two runs.
const QUERIES: [usize; 2] = [500, 2500];

/// Counts all questions and prints the table.
pub fn run(steps: &mut Steps) {
    let Some(valgrind) = Valgrind::find() else { return };
    let columns = ["question", "instructions"];
    let mut table = Table::new(
        "instructions",
        "Instructions a query, fixtures/bracket, this machine",
        &columns,
    );
    for question in QUESTIONS.into_iter().chain(tree::QUESTIONS).chain(triboxes::QUESTIONS) {
        let counted = steps.run(&format!("count {question}"), || each(&valgrind, question));
        table
            .push(vec![Cell::from(question), counted.map_or(Cell::Empty, |count| fixed(count, 0))]);
    }
    table.note(
        "far, near, path: closest point; all with the memory that the model's capacities name",
    );
    table.note("tree: to the box tree, triboxes: to 64 of them, the others to the hull hierarchy");
    table.note(
        "apart, candidates, overlap: of the mesh and its copy in random poses; by vertices: apart by the paper's test",
    );
    say!("{}", table.text());
    check_lanes(steps);
}

/// Instructions of one query.
fn each(valgrind: &Valgrind, question: &str) -> Result<f64, String> {
    let [few, many] = QUERIES.map(|queries| instructions(valgrind, question, queries));
    Ok((many? - few?) / (QUERIES[1] - QUERIES[0]) as f64)
}

/// The run that is counted: `queries` of one question.
pub fn ask(question: &str, queries: usize) -> Result<(), String> {
    if let Some(asked) = tree::ask(question, queries) {
        return asked.map(|_| ());
    }
    if let Some(asked) = triboxes::ask(question, queries) {
        return asked;
    }
    let folder = workspace::root().join("fixtures");
    let subject = Subject::load(&folder.join("bracket.stl"))?;
    let blob = std::fs::read(folder.join("bracket.msw"))
        .map_err(|error| format!("fixtures/bracket.msw: {error}"))?;
    let model = Model::open(&blob).map_err(|error| error.to_string())?;
    let capacities = model.capacities();
    let mut queue = vec![QueueEntry::EMPTY; capacities.queue];
    let failed = |error: meshsweep_core::QueryError| error.to_string();
    // Placed for the greater number always, so that placing them is no part of the difference.
    let kind = Points::ALL.into_iter().find(|kind| kind.name() == question);
    if let Some(kind) = kind {
        for point in points(&subject, kind, QUERIES[1]).into_iter().take(queries) {
            black_box(closest_point(&model, point, &Budget::EXACT, &mut queue).map_err(failed)?);
        }
        return Ok(());
    }
    let (mut performed, mut swept) =
        (vec![0; capacities.front_words], vec![0; capacities.front_words]);
    let mut candidates = vec![Face::EMPTY; 64];
    let mut hits = [meshsweep_core::query::Hit::EMPTY; 16];
    let mut front = RefinedHull::new(&mut performed, &mut swept, &mut candidates);
    for [a, b] in segments(&subject, QUERIES[1]).into_iter().take(queries) {
        if question == "first_hit" {
            black_box(first_hit(&model, a, b, &Budget::EXACT, &mut queue).map_err(failed)?);
        } else {
            let search = if question == "outer_first" { Search::First } else { Search::Outer };
            black_box(outer_hits(&model, a, b, search, &mut front, &mut hits).map_err(failed)?);
        }
    }
    Ok(())
}

fn instructions(valgrind: &Valgrind, question: &str, queries: usize) -> Result<f64, String> {
    let own: PathBuf = env::current_exe().map_err(|error| error.to_string())?;
    let mut command = valgrind.command();
    command.args(["--tool=callgrind", "--callgrind-out-file=/dev/null"]).arg(Path::new(&own));
    let output = process::output(command.args(["ask", question, &queries.to_string()]))?;
    let text = String::from_utf8_lossy(&output.stderr);
    let refs = text.lines().find_map(|line| line.split_once("Collected : "));
    refs.and_then(|(_, count)| count.trim().parse().ok())
        .ok_or_else(|| format!("callgrind counted nothing\n{text}"))
}
