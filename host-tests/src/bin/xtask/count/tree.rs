//! Questions to the box tree of a fixture, and whether its loops over eight lanes are still vector
//! code.

use std::hint::black_box;

use meshsweep::emit;
use meshsweep::tree::{TreeOptions, build};
use meshsweep_core::Bvh;
use meshsweep_core::query::tree::{
    Facing, PairEntry, ScratchEntry, closest_point, first_hit, is_within, overlap,
};
use meshsweep_core::query::{Budget, Work};
use meshsweep_core::tribox::Pose;
use meshsweep_host_tests::measure::Subject;
use meshsweep_host_tests::measure::table::{Cell, Table, fixed};
use meshsweep_host_tests::measure::triboxes::{poses, sphere};
use meshsweep_host_tests::measure::workload::{Points, points, segments};

use super::{QUERIES, each};
use crate::steps::Steps;
use crate::valgrind::Valgrind;
use crate::workspace;

/// Questions by their words on the command line: `tree`, the fixture, the points.
pub const QUESTIONS: [&str; 5] = [
    "tree bracket.stl far",
    "tree bracket.stl near",
    "tree bracket.stl path",
    "tree bracket.stl first_hit",
    "tree torus.ply overlap",
];

/// Questions by whose instructions vector code is told from scalar code, with the most instructions
/// that a node or a leaf may take: a quarter more than it took on plain x86-64 when this was
/// written (893, 741, 711, 692, 482, 764). Without vectors (`-C no-vectorize-loops -C
/// no-vectorize-slp`) it took 2420, 1489, 1802, 1560, 1119, 1284. "Clear" is for nodes, for it
/// opens few leaves; "first hit" has its own loops.
const LIMITS: [(&str, f64); 6] = [
    ("tree bracket.stl far", 1115.0),
    ("tree bracket.stl first_hit", 925.0),
    ("tree torus.ply far", 890.0),
    ("tree torus.ply near", 865.0),
    ("tree torus.ply clear", 600.0),
    ("tree torus.ply first_hit", 955.0),
];

/// Asks the first `queries` of a question, and sums what the answers cost; with the triangles of a
/// leaf. `None` if the question is not one to the tree.
pub fn ask(question: &str, queries: usize) -> Option<Result<(Work, f64), String>> {
    let (fixture, kind) = question.strip_prefix("tree ")?.split_once(' ')?;
    Some(asked(fixture, kind, queries))
}

fn asked(fixture: &str, kind: &str, queries: usize) -> Result<(Work, f64), String> {
    let subject = Subject::load(&workspace::root().join("fixtures").join(fixture))?;
    let (tables, _) = build(&subject.mesh, 0.0, subject.triangles_read, &TreeOptions::default());
    let bytes = emit::blob(None, Some(&tables));
    let tree = Bvh::open(&bytes).map_err(|error| error.to_string())?;
    let header = *tree.header();
    let triangles = f64::from(header.triangles) / f64::from(header.leaves);
    let entries = header.stack_entries as usize;
    let failed = |error: meshsweep_core::QueryError| error.to_string();
    let mut sum = Work::default();
    let mut add = |work: Work| {
        sum.splits += work.splits;
        sum.triangles += work.triangles;
    };
    if kind == "overlap" {
        let mut stack = [PairEntry::EMPTY; PairEntry::ENOUGH];
        let all: Vec<Pose> = poses(&sphere(&subject), QUERIES[1]).map(|(_, core)| core).collect();
        for pose in all.iter().take(queries) {
            add(black_box(overlap(&tree, &tree, pose, u32::MAX, &mut stack)).map_err(failed)?.work);
        }
        return Ok((sum, triangles));
    }
    // Placed for the greater number always, so that placing them is no part of the difference.
    if let Some(kind) = Points::ALL.into_iter().find(|points| points.name() == kind) {
        let mut stack = vec![ScratchEntry::EMPTY; entries];
        for point in points(&subject, kind, QUERIES[1]).into_iter().take(queries) {
            add(black_box(closest_point(&tree, point, &Budget::EXACT, &mut stack))
                .map_err(failed)?
                .work);
        }
    } else if kind == "clear" {
        let mut stack = vec![ScratchEntry::EMPTY; entries];
        let mut asked = Vec::new();
        for point in points(&subject, Points::Far, QUERIES[1]) {
            let near = closest_point(&tree, point, &Budget::EXACT, &mut stack).map_err(failed)?;
            asked.push((point, 0.9 * near.lower));
        }
        for (point, distance) in asked.into_iter().take(queries) {
            add(black_box(is_within(&tree, point, distance, &Budget::EXACT, &mut stack))
                .map_err(failed)?
                .work);
        }
    } else {
        let mut stack = vec![ScratchEntry::EMPTY; entries];
        for [a, b] in segments(&subject, QUERIES[1]).into_iter().take(queries) {
            add(black_box(first_hit(&tree, a, b, &Facing::Both, &mut stack)).map_err(failed)?.work);
        }
    }
    Ok((sum, triangles))
}

/// That node and leaf take few enough instructions to be vector code. Skipped, with a line that
/// says so, where nothing can be counted.
pub fn check(steps: &mut Steps) {
    if cfg!(not(target_arch = "x86_64")) {
        say!("── lanes are vectors\n   skipped: the limits are those of x86-64");
        return;
    }
    let Some(valgrind) = Valgrind::find() else { return };
    steps.run("lanes are vectors", || {
        let columns =
            ["question", "instructions a query", "nodes", "leaves", "instructions each", "limit"];
        let mut table = Table::new("lanes", "Instructions a node or leaf, this machine", &columns);
        let mut beyond = Vec::new();
        for (question, limit) in LIMITS {
            let instructions = each(&valgrind, question)?;
            let [nodes, leaves] = visits(question)?;
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

/// Nodes and leaves that a query visits, of those that are counted.
fn visits(question: &str) -> Result<[f64; 2], String> {
    let work = |queries: usize| {
        ask(question, queries).unwrap_or_else(|| Err(format!("no question `{question}`")))
    };
    let [(few, _), (many, triangles)] = [work(QUERIES[0])?, work(QUERIES[1])?];
    let each = |more: u32, less: u32| f64::from(more - less) / (QUERIES[1] - QUERIES[0]) as f64;
    Ok([each(many.splits, few.splits), each(many.triangles, few.triangles) / triangles])
}
