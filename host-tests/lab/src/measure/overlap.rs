//! A mesh against itself in random motions: answers held to exact predicates, and time beside
//! parry3d's.

use meshsweep::bvh::{TreeOptions, build};
use meshsweep::collapse::Priority;
use meshsweep::progress::Watch;
use meshsweep_core::{Budget, Bvh, Hull, Pose, ScratchEntry, TrianglePair, Verdict, Work};
use meshsweep_host_tests::workload::Subject;
use meshsweep_host_tests::workload::contact::Surface;
use meshsweep_host_tests::workload::pose::{FARTHEST, Pose as Motion, poses, sphere};
use meshsweep_xtask::table::{Cell, Table, fixed, row};
use parry3d::math::Pose as ParryPose;
use parry3d::query::intersection_test;

use super::rival::{Rival, parry};
use super::stopwatch::{Stopwatch, fastest};
use super::{BASE_FACES, open};

/// Motions.
const MOTIONS: usize = 1_000;

/// A motion as each side takes it, and what is true of ours.
struct Case {
    parry: ParryPose,
    pose: Pose,
    meets: bool,
}

fn cases(subject: &Subject, surface: &Surface<'_>) -> Vec<Case> {
    let case = |(near, pose): (Motion, Pose)| Case {
        meets: surface.meets_exactly(&pose, &near),
        parry: parry(&near),
        pose,
    };
    poses(&sphere(subject), MOTIONS).map(case).collect()
}

/// Answers of an engine, and nanoseconds for one: of the pairs that are apart, of those that meet.
struct Run<T> {
    answers: Vec<T>,
    nanoseconds: [f64; 2],
}

fn run<T>(
    cases: &[Case],
    mut ask: impl FnMut(&Case) -> Result<T, String>,
) -> Result<Run<T>, String> {
    let mut answers: Vec<Option<T>> = cases.iter().map(|_| None).collect();
    let mut nanoseconds = [0.0; 2];
    for (time, meets) in nanoseconds.iter_mut().zip([false, true]) {
        let mut asked = 0;
        let watch = Stopwatch::start();
        for (case, slot) in cases.iter().zip(&mut answers).filter(|(case, _)| case.meets == meets) {
            *slot = Some(ask(case)?);
            asked += 1;
        }
        *time = watch.nanoseconds_each(asked);
    }
    Ok(Run { answers: answers.into_iter().flatten().collect(), nanoseconds })
}

fn fastest_run<T>(
    cases: &[Case],
    mut ask: impl FnMut(&Case) -> Result<T, String>,
) -> Result<Run<T>, String> {
    fastest(|| run(cases, &mut ask), |run| run.nanoseconds.iter().sum())
}

/// Wrong answers, and answers left open.
struct Verdicts {
    wrong: usize,
    open: usize,
    work: [Work; 2],
    all_pairs: [f64; 2],
    time: [f64; 2],
}

/// A structure that tells whether it meets its copy.
enum Engine<'a> {
    Tree(Bvh<'a>),
    Hull(Hull<'a>),
}

fn ours(engine: &Engine<'_>, cases: &[Case]) -> Result<Verdicts, String> {
    let mut stack = match engine {
        Engine::Tree(_) => vec![ScratchEntry::EMPTY; Bvh::OVERLAP_ENTRIES],
        Engine::Hull(hull) => vec![ScratchEntry::EMPTY; hull.overlap_entries(hull)],
    };
    let ask = |case: &Case| {
        match engine {
            Engine::Tree(tree) => tree.overlap(tree, case.pose, Budget::EXACT, &mut stack),
            Engine::Hull(hull) => hull.overlap(hull, case.pose, Budget::EXACT, &mut stack),
        }
        .map_err(|error| error.to_string())
    };
    let Run { answers, nanoseconds } = fastest_run(cases, ask)?;
    let mut verdicts = Verdicts {
        wrong: 0,
        open: 0,
        work: [Work::default(); 2],
        all_pairs: [0.0; 2],
        time: nanoseconds,
    };
    for (case, answer) in cases.iter().zip(&answers) {
        match answer.verdict {
            Verdict::Undecided(_) => verdicts.open += 1,
            verdict => verdicts.wrong += usize::from((verdict == Verdict::Yes) != case.meets),
        }
        let sum = &mut verdicts.work[usize::from(case.meets)];
        sum.bounds += answer.work.bounds;
        sum.triangles += answer.work.triangles;
        sum.exact += answer.work.exact;
        sum.opened += answer.work.opened;
    }
    let mut pairs = vec![TrianglePair::EMPTY; 1 << 20];
    let every = |case: &Case| {
        let (pose, exact) = (case.pose, Budget::EXACT);
        let found = match engine {
            Engine::Tree(tree) => tree.all_overlaps(tree, pose, &mut pairs, exact, &mut stack),
            Engine::Hull(hull) => hull.all_overlaps(hull, pose, &mut pairs, exact, &mut stack),
        };
        found.map(|found| found.stored).map_err(|error| error.to_string())
    };
    verdicts.all_pairs = run(cases, every)?.nanoseconds;
    Ok(verdicts)
}

/// The tables.
///
/// # Errors
/// The mesh is one that parry3d or the builder refuses, or an answer is wrong.
pub fn tables(subject: &Subject) -> Result<Vec<Table>, String> {
    let surface = Surface::new(subject);
    let cases = cases(subject, &surface);
    let meeting = cases.iter().filter(|case| case.meets).count();
    let rival = Rival::new(subject)?;
    let shape = rival.shape();
    let parry = fastest_run(&cases, |case| {
        intersection_test(&ParryPose::IDENTITY, shape, &case.parry, shape)
            .map(|answer| answer.intersecting)
            .map_err(|error| error.to_string())
    })?;
    let parry_wrong =
        cases.iter().zip(&parry.answers).filter(|(case, answer)| case.meets != **answer).count();
    let columns = [
        "engine",
        "wrong",
        "open",
        "us apart",
        "parry3d's",
        "us meeting",
        "parry3d's",
        "us all pairs, meeting",
    ];
    let mut times =
        Table::new("overlap", "A mesh against itself, moved: do the surfaces meet?", &columns);
    let columns = ["engine", "motions", "bounds", "opened", "triangle pairs", "in f64"];
    let mut work = Table::new("overlap_work", "What that took, in mean", &columns);
    let hull = subject.build(BASE_FACES, Priority::Program);
    let mut blobs = Vec::new();
    for (name, single) in [("16-bit grid", false), ("f32 vertices", true)] {
        let options = TreeOptions::default().with_closest(false).with_f32(single);
        let bytes = build(
            meshsweep::mesh::Input {
                input_triangles: subject.triangles_read,
                ..subject.mesh.as_input()
            },
            &options,
            Watch::NONE,
        )
        .expect("builds")
        .0
        .to_bytes();
        blobs.push((name, bytes));
    }
    let mut engines = Vec::new();
    for (name, bytes) in &blobs {
        engines.push((*name, Engine::Tree(Bvh::open(bytes).map_err(|error| error.to_string())?)));
    }
    // A mesh that is not closed has no hull hierarchy.
    if let Ok(built) = &hull {
        engines.push(("hull hierarchy", Engine::Hull(open(built)?)));
    }
    for (name, engine) in &engines {
        let verdicts = ours(engine, &cases)?;
        let [apart, meets] = verdicts.time;
        let times_faster = |ours: f64, theirs: f64| fixed(theirs / ours, 1);
        times.push(row![
            *name,
            verdicts.wrong,
            verdicts.open,
            fixed(apart / 1e3, 2),
            times_faster(apart, parry.nanoseconds[0]),
            fixed(meets / 1e3, 2),
            times_faster(meets, parry.nanoseconds[1]),
            fixed(verdicts.all_pairs[1] / 1e3, 1),
        ]);
        if verdicts.wrong > 0 {
            return Err(format!("{} wrong answers of {MOTIONS}, {name}", verdicts.wrong));
        }
        for (which, count, work_of) in
            [("apart", MOTIONS - meeting, verdicts.work[0]), ("meeting", meeting, verdicts.work[1])]
        {
            let each = |sum: u32| fixed(f64::from(sum) / count.max(1) as f64, 2);
            let Work { bounds, triangles, exact, opened, .. } = work_of;
            work.push(row![
                format!("{name}, {which}"),
                count,
                each(bounds),
                each(opened),
                each(triangles),
                each(exact)
            ]);
        }
    }
    let one = || Cell::from("1.0");
    times.push(row![
        "parry3d",
        parry_wrong,
        0usize,
        fixed(parry.nanoseconds[0] / 1e3, 2),
        one(),
        fixed(parry.nanoseconds[1] / 1e3, 2),
        one(),
        Cell::Empty,
    ]);
    times.note(format!(
        "{MOTIONS} motions, seeded: any rotation, spheres' centres up to {FARTHEST} radii apart; {meeting} pairs meet by exact predicates"
    ));
    times.note(
        "open: nearer than the grid, or rounding, can tell; parry3d's: times faster than it in this run",
    );
    Ok(vec![times, work])
}
