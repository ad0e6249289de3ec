//! `cargo xtask count`: instructions a query on this machine, counted by callgrind; on a
//! Cortex-M4F and a Cortex-M0, counted by the emulator.
//!
//! Times on a busy machine are noise; instructions are not. A program that asks runs in the
//! simulator twice, with different numbers of queries: the difference is the queries' alone.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::fit;
use crate::host;
use crate::process;
use crate::reading::Reading;
use crate::steps::Steps;
use crate::table::{Cell, Table, fixed};
use crate::tools::Tools;
use crate::valgrind::Valgrind;
use crate::workspace;

/// Questions by their words on the host program's command line.
const QUESTIONS: [&str; 20] = [
    "far",
    "near",
    "path",
    "first_hit",
    "outer_first",
    "outer_all",
    "overlap",
    "refine bracket.msw 0.06 0.0005",
    "sweep bracket.msw 0 0.05",
    "sweep bracket.msw 0.0001 0",
    "tree bracket.stl far",
    "tree bracket.stl near",
    "tree bracket.stl path",
    "tree bracket.stl first_hit",
    "tree torus.ply overlap",
    "triboxes apart",
    "triboxes by vertices",
    "triboxes candidates",
    "triboxes distance",
    "triboxes clip",
];

/// Questions that the documents' tables have.
const TABLED: [&str; 6] = [
    "tree bracket.stl far",
    "tree bracket.stl near",
    "tree bracket.stl first_hit",
    "far",
    "near",
    "first_hit",
];

/// Questions whose instructions show whether the code was vectorised, with the most instructions
/// that a node or a leaf may take: a quarter more than it took on plain x86-64 when this was
/// written (740, 698, 564, 623, 490, 766). Without vectors (`-C no-vectorize-loops -C
/// no-vectorize-slp`) it once took 2420, 1489, 1802, 1560, 1119, 1284. "Clear" is for nodes, for it
/// opens few leaves; "first hit" has its own loops.
///
/// Those for AVX2 are for the paths on which every kernel must be compiled for it: calls between
/// the two sets of instructions once took 1.8 times as long. They took 330 and 400.
const LIMITS: [(&str, f64); 8] = [
    ("tree bracket.stl avx2_far", 500.0),
    ("tree bracket.stl avx2_first_hit", 500.0),
    ("tree bracket.stl far", 925.0),
    ("tree bracket.stl first_hit", 870.0),
    ("tree torus.ply far", 705.0),
    ("tree torus.ply near", 780.0),
    ("tree torus.ply clear", 615.0),
    ("tree torus.ply first_hit", 955.0),
];

/// The limits of this processor.
fn limits() -> impl Iterator<Item = (&'static str, f64)> {
    #[cfg(target_arch = "x86_64")]
    let has_avx2 = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("bmi2");
    #[cfg(not(target_arch = "x86_64"))]
    let has_avx2 = false;
    LIMITS.into_iter().filter(move |(question, _)| has_avx2 || !question.contains("avx2"))
}

/// Queries of the two runs.
const QUERIES: [u32; 2] = [500, 2500];

/// Costs of one query, in mean.
#[derive(Clone, Copy, Debug)]
pub struct Each {
    /// Instructions.
    pub instructions: f64,
    nodes: f64,
    leaves: f64,
}

/// Counted questions by their words.
pub type Counts<'a> = BTreeMap<&'a str, Each>;

/// Queries that a board is asked.
const ON_BOARD: &str = "1000";

/// Counts questions at places on the boards of the fit, in the emulator, and prints the table. The
/// answers' bits are this machine's, or it is an error.
pub fn on_board(steps: &mut Steps, tools: &Tools, asked: &[&str]) {
    let boards = fit::boards().map(|(_, board)| board);
    let images = steps.run("the images", || {
        let images = boards.iter().map(|board| tools.image(board, "ask"));
        images.collect::<Result<Vec<_>, _>>()
    });
    let Some(images) = images else { return };
    let title = "Instructions a query on boards".to_owned();
    let columns = ["question", "processor", "mean", "least", "most", "stack", "scratch", "answers"];
    let mut table = Table::new("board_instructions", title, &columns);
    let asked =
        asked.iter().flat_map(|&question| boards.iter().zip(&images).map(move |on| (question, on)));
    for (question, (board, image)) in asked {
        let counted = steps.run(&format!("{question}: {}", board.cpu), || {
            let file = workspace::target().join("question.bin");
            let path = file.to_string_lossy();
            let printed = host::run(&["lay", question, ON_BOARD, &path])?;
            let (means, expected) = printed.split_once('\n').unwrap_or_default();
            let expected = Reading::parse(expected, None)?;
            let reading = tools.asked(board, image, (&file, board.loaded), &expected, u32::MAX)?;
            let cost = reading.costs.first().ok_or("the image told no cost")?;
            table.push(vec![
                Cell::from(question),
                Cell::from(board.cpu),
                fixed(cost.mean, 0),
                fixed(cost.min, 0),
                fixed(cost.max, 0),
                cost.stack.into(),
                reading.scratch.into(),
                Cell::from(means),
            ]);
            Ok(())
        });
        if counted.is_none() {
            return;
        }
    }
    table.note(format!(
        "{ON_BOARD} queries; stack, scratch: bytes of RAM; a tick is 40 instructions"
    ));
    table.note(
        "bvh BLOB RELATIVE, sweep BLOB STEP RELATIVE: closest points; refine BLOB RADIUS ERROR; \
         field, beyond, units BLOB: a field in it, about it, in whole units",
    );
    say!("{}", table.text());
}

/// Counts questions and prints the table: those of `asked`, or all that are listed here. A question
/// of `asked` may name any file, with its whole path.
pub fn run<'a>(steps: &mut Steps, asked: &[&'a str]) {
    let limited = limits().map(|(question, _)| question);
    let questions: &[&'a str] = if asked.is_empty() { &QUESTIONS } else { asked };
    let all: Vec<&'a str> = if asked.is_empty() {
        questions.iter().copied().chain(limited).collect()
    } else {
        questions.to_vec()
    };
    let Some(counts) = counted(steps, &all) else { return };
    let columns = ["question", "instructions"];
    let mut table = Table::new(
        "instructions",
        "Instructions a query on this machine, bracket where no file is named",
        &columns,
    );
    for &question in questions {
        let cell = counts.get(question).map_or(Cell::Empty, |each| fixed(each.instructions, 0));
        table.push(vec![Cell::from(question), cell]);
    }
    table.note(
        "far, near, path: closest point; all with the memory that the model's capacities name",
    );
    table.note("tree: to the box tree, triboxes: to 64 of them, the others to the hull hierarchy");
    table.note(
        "bvh BLOB RELATIVE, sweep BLOB STEP RELATIVE: far points; a step of 0: fresh \
         queries, else one kept sweep that moves",
    );
    table.note(
        "deform: a moved hull of any blob: its update, update within a slack, or the closest point \
         after one; kept: both, by a sweep, of frames that are sheared by 1e-4 more each",
    );
    table.note(
        "apart, candidates, overlap: of the mesh and its copy in random poses; by vertices: apart by \
         the paper's test",
    );
    say!("{}", table.text());
    if asked.is_empty() {
        check_lanes(steps, &counts);
    }
}

/// What a test counts: the questions of lanes and of tables.
pub fn for_test(steps: &mut Steps) -> Option<Counts<'static>> {
    let limited = limits().map(|(question, _)| question);
    counted(steps, &limited.chain(TABLED).collect::<Vec<_>>())
}

/// Counts questions, on all cores. `None`, with a line that says so, where nothing can be counted.
fn counted<'a>(steps: &mut Steps, questions: &[&'a str]) -> Option<Counts<'a>> {
    let valgrind = Valgrind::find()?;
    let program = steps.run("the program that is counted", host::counted)?.join("counted");
    let mut questions = questions.to_vec();
    questions.sort_unstable();
    questions.dedup();
    steps.run("count instructions", || {
        let folder = workspace::target().join("counted");
        let path = folder.to_string_lossy();
        host::run(&[&["place", &path], questions.as_slice()].concat())?;
        let file = |number: usize| folder.join(format!("{number}.bin"));
        let files: Vec<PathBuf> = (0..questions.len()).map(file).collect();
        let all = process::parallel(&files, |file| each(&valgrind, &program, file));
        let pairs = questions.iter().zip(all);
        pairs.map(|(question, (each, _))| Ok((*question, each?))).collect()
    })
}

/// That node and leaf take few enough instructions to be vector code.
pub fn check_lanes(steps: &mut Steps, counts: &Counts<'_>) {
    if cfg!(not(target_arch = "x86_64")) {
        say!("── lanes are vectors\n   skipped: the limits are those of x86-64");
        return;
    }
    steps.run("lanes are vectors", || {
        let columns =
            ["question", "instructions a query", "nodes", "leaves", "instructions each", "limit"];
        let mut table = Table::new("lanes", "Instructions a node or leaf, this machine", &columns);
        let mut beyond = Vec::new();
        for (question, limit) in limits() {
            let each =
                counts.get(question).ok_or_else(|| format!("`{question}` is not counted"))?;
            let Each { instructions, nodes, leaves } = *each;
            let cost = instructions / (nodes + leaves);
            if cost > limit {
                beyond.push(format!(
                    "{question}: {cost:.0} instructions a node or leaf, not {limit:.0}"
                ));
            }
            let cells = [
                fixed(instructions, 0),
                fixed(nodes, 2),
                fixed(leaves, 2),
                fixed(cost, 1),
                fixed(limit, 0),
            ];
            table.push([Cell::from(question)].into_iter().chain(cells).collect());
        }
        say!("{}", table.text());
        if beyond.is_empty() { Ok(()) } else { Err(beyond.join("\n")) }
    });
}

/// The difference of two runs.
fn each(valgrind: &Valgrind, program: &Path, question: &Path) -> Result<Each, String> {
    let [few, many] = QUERIES.map(|queries| simulated(valgrind, program, question, queries));
    let ([few, few_nodes, few_triangles, a_leaf], [many, nodes, triangles, _]) = (few?, many?);
    let each = |many: f64, few: f64| (many - few) / f64::from(QUERIES[1] - QUERIES[0]);
    Ok(Each {
        instructions: each(many, few),
        nodes: each(nodes, few_nodes),
        leaves: each(triangles, few_triangles) / a_leaf,
    })
}

/// Instructions of a run, nodes and triangles that its queries looked at, and triangles of a leaf.
fn simulated(
    valgrind: &Valgrind,
    program: &Path,
    question: &Path,
    queries: u32,
) -> Result<[f64; 4], String> {
    let mut command = valgrind.command();
    command.args(["--tool=callgrind", "--callgrind-out-file=/dev/null"]).arg(program);
    let output = process::output(command.arg(question).arg(queries.to_string()))?;
    let [printed, counted] =
        [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned());
    let read = || {
        let instructions = counted.lines().find_map(|line| line.split_once("Collected : "))?.1;
        let mut numbers = std::iter::once(instructions).chain(printed.split(' '));
        let mut next = || numbers.next()?.trim().parse::<f64>().ok();
        Some([next()?, next()?, next()?, next()?])
    };
    read().ok_or_else(|| format!("callgrind counted nothing\n{printed}{counted}"))
}
