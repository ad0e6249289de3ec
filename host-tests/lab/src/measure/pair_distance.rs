//! The distance of a mesh and its moved copy: answers held to 106 bits, and time beside parry3d's.

use glam::DVec3;
use meshsweep::bvh::{TreeOptions, build};
use meshsweep_core::{Budget, Bvh, Ended, PairDistance, Pose, ScratchEntry};
use meshsweep_host_tests::oracle::Bounded;
use meshsweep_host_tests::workload::Subject;
use meshsweep_host_tests::workload::contact::Surface;
use meshsweep_host_tests::workload::pose::{Pose as Motion, poses, sphere};
use meshsweep_xtask::table::{Cell, Table, fixed, row};
use parry3d::math::Pose as ParryPose;

use super::bounds::pose::parry;
use super::rival::Rival;
use super::stopwatch::answers as run;

/// Motions of each kind.
const MOTIONS: usize = 100;

/// Random motions that are looked at, at most.
const TRIED: usize = 4_000;

/// The gap that is left of motions near contact, as a part of the distance of the random motion.
const LEFT: f64 = 0.01;

/// A motion as each side takes it, and the true distance.
struct Case {
    parry: ParryPose,
    pose: Pose,
    truth: Bounded,
}

fn tree(subject: &Subject, single: bool) -> Vec<u8> {
    let options = TreeOptions::default().with_closest(false).with_f32(single);
    let input = meshsweep::mesh::Input {
        input_triangles: subject.triangles_read,
        ..subject.mesh.as_input()
    };
    build(input, &options).expect("builds").0.to_bytes()
}

fn ask(tree: &Bvh<'_>, pose: Pose, budget: Budget) -> Result<PairDistance, String> {
    let mut stack = [ScratchEntry::EMPTY; Bvh::DISTANCE_ENTRIES];
    tree.distance(tree, pose, budget, &mut stack).map_err(|error| error.to_string())
}

/// Random motions that are apart, and the same after most of the way to contact: a motion by less
/// than the distance meets nothing.
fn cases(subject: &Subject, tree: &Bvh<'_>) -> Result<[Vec<Case>; 2], String> {
    let surface = Surface::new(subject);
    let case = |near: Motion, pose: Pose| {
        let found = ask(tree, pose, Budget::EXACT)?;
        let limit = f64::from(found.distance.upper) * 1.001;
        let truth = surface.distance_up_to(&pose, &near, limit);
        Ok::<Case, String>(Case { parry: parry(&near), pose, truth })
    };
    let mut groups = [Vec::new(), Vec::new()];
    for (near, pose) in poses(&sphere(subject), TRIED) {
        let found = ask(tree, pose, Budget::EXACT)?;
        if found.distance.lower <= 0.0 || groups[0].len() >= MOTIONS {
            continue;
        }
        let [from, to] = found.points.map(|p| DVec3::from_array(p.map(f64::from)));
        let closer = Motion { shift: near.shift - (to - from) * (1.0 - LEFT), ..near };
        let core = closer.rounded();
        groups[0].push(case(near, pose)?);
        groups[1].push(case(Motion::exact(&core, &closer), core)?);
    }
    Ok(groups)
}

/// The table.
///
/// # Errors
/// The mesh is one that parry3d or the builder refuses, or an interval does not contain the truth.
pub fn table(subject: &Subject) -> Result<Table, String> {
    let blobs = [("16-bit grid", tree(subject, false)), ("f32 vertices", tree(subject, true))];
    let exact = Bvh::open(&blobs[1].1).map_err(|error| error.to_string())?;
    let groups = cases(subject, &exact)?;
    let rival = Rival::new(subject)?;
    let shape = rival.shape();
    let columns = [
        "engine, motions",
        "wrong",
        "us a distance",
        "parry3d's",
        "us within half of it",
        "us within twice of it",
        "pairs of boxes",
        "pairs in f64",
        "widest interval / size",
    ];
    let mut table =
        Table::new("pair_distance", "A mesh and itself, moved: how far apart?", &columns);
    for (kind, cases) in ["apart", "near contact"].into_iter().zip(&groups) {
        if cases.is_empty() {
            continue;
        }
        let (theirs, parry_time) = run(cases, |case| {
            parry3d::query::distance(&ParryPose::IDENTITY, shape, &case.parry, shape)
                .map(|found| found.distance)
                .map_err(|error| error.to_string())
        })?;
        for (name, bytes) in &blobs {
            let tree = Bvh::open(bytes).map_err(|error| error.to_string())?;
            let mut stack = [ScratchEntry::EMPTY; Bvh::DISTANCE_ENTRIES];
            let (answers, time) = run(cases, |case| {
                tree.distance(&tree, case.pose, Budget::EXACT, &mut stack)
                    .map_err(|error| error.to_string())
            })?;
            let mut within = |part: f64| {
                run(cases, |case| {
                    let distance = (part * case.truth.upper) as f32;
                    tree.within_of(&tree, case.pose, distance, Budget::EXACT, &mut stack)
                        .map_err(|error| error.to_string())
                })
                .map(|(_, time)| time)
            };
            let (half, twice) = (within(0.5)?, within(2.0)?);
            let is_wrong = |(case, answer): &(&Case, &PairDistance)| {
                let (lower, upper) = (answer.distance.lower, answer.distance.upper);
                f64::from(lower) > case.truth.upper
                    || f64::from(upper) < case.truth.lower
                    || answer.ended != Ended::Exact
            };
            let wrong = cases.iter().zip(&answers).filter(is_wrong).count();
            let each = |of: fn(&PairDistance) -> u32| {
                let sum: f64 = answers.iter().map(|answer| f64::from(of(answer))).sum();
                fixed(sum / answers.len() as f64, 1)
            };
            let width = answers.iter().map(|answer| answer.distance.upper - answer.distance.lower);
            let widest = f64::from(width.fold(0.0, f32::max)) / subject.diagonal();
            table.push(row![
                format!("{name}, {kind}"),
                wrong,
                fixed(time / 1e3, 2),
                fixed(parry_time / time, 1),
                fixed(half / 1e3, 2),
                fixed(twice / 1e3, 2),
                each(|answer| answer.work.nodes),
                each(|answer| answer.work.exact),
                format!("{widest:.1e}"),
            ]);
            if wrong > 0 {
                return Err(format!("{wrong} wrong distances, {name}, {kind}"));
            }
        }
        let off = |(case, theirs): &(&Case, &f32)| {
            (f64::from(**theirs) - case.truth.lower).abs() > 1e-5 * subject.diagonal()
        };
        table.push(row![
            format!("parry3d, {kind}"),
            cases.iter().zip(&theirs).filter(off).count(),
            fixed(parry_time / 1e3, 2),
            fixed(1.0, 1),
            Cell::Empty,
            Cell::Empty,
            Cell::Empty,
            Cell::Empty,
            Cell::Empty,
        ]);
    }
    let [apart, _] = &groups;
    table.note(format!(
        "{} seeded motions that are apart, by the distance in 106 bits; near contact: the same \
         after 99 hundredths of the way",
        apart.len()
    ));
    table.note(
        "wrong: the interval does not contain the distance; of parry3d: off by more than 1e-5 of \
         the mesh's size. parry3d's: times faster than it in this run",
    );
    Ok(table)
}
