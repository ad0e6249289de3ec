//! A mesh and its copy that moves in small steps, or that is inside of it: time beside that of
//! plain questions, and how wide the intervals of depths are.

use meshsweep::bvh::{TreeOptions, build};
use meshsweep::progress::Watch;
use meshsweep_core::{
    Budget, Bvh, CoherentPair, Interval, PairDistance, Penetration, Pose, Relation, ScratchEntry,
};
use meshsweep_host_tests::generate::Rng;
use meshsweep_host_tests::workload::Subject;
use meshsweep_host_tests::workload::pose::{poses, sphere};
use meshsweep_xtask::table::{Table, fixed, row};

use super::stopwatch::fastest;
use super::stopwatch::{Stopwatch, answers as run};

/// Paths, and poses of each.
const PATHS: usize = 20;
const STEPS: usize = 50;

/// Steps of a path, as a part of the mesh's size.
const LENGTHS: [f32; 3] = [1e-4, 1e-3, 1e-2];

/// Way that is left of that to the nearest place.
const LEFT: f32 = 0.05;

/// Memory of a pair.
const GROUPS: usize = 1024;

/// Motions whose depths are asked for.
const MOTIONS: usize = 100;

fn tree(subject: &Subject) -> Vec<u8> {
    let input = meshsweep::mesh::Input {
        input_triangles: subject.triangles_read,
        ..subject.mesh.as_input()
    };
    build(input, &TreeOptions::default().with_winding(true), Watch::NONE)
        .expect("builds")
        .0
        .to_bytes()
}

fn failed(error: impl ToString) -> String {
    error.to_string()
}

/// Paths of one length of step: random places that are apart, or the same near contact.
fn paths(
    subject: &Subject,
    tree: &Bvh<'_>,
    length: f32,
    near: bool,
) -> Result<Vec<Vec<Pose>>, String> {
    let mut stack = [ScratchEntry::EMPTY; Bvh::DISTANCE_ENTRIES];
    let mut rng = Rng::new(71);
    let mut all = Vec::new();
    for (_, mut pose) in poses(&sphere(subject), 50 * PATHS) {
        let found = tree.distance_to(tree, pose, Budget::EXACT, &mut stack).map_err(failed)?;
        if all.len() == PATHS || found.distance.lower <= 0.0 {
            continue;
        }
        if near {
            let [from, to] = found.points;
            let moved = pose.translation.iter_mut().zip(from.iter().zip(to));
            moved.for_each(|(x, (from, to))| *x -= (1.0 - LEFT) * (to - from));
        }
        let (way, turn) = (rng.direction(), 0.7 * length * (2.0 * rng.unit_f32() - 1.0));
        let step = |k: usize| {
            let (far, angle) = (length * subject.diagonal() as f32 * k as f32, turn * k as f32);
            let (sine, cosine) = angle.sin_cos();
            let [x, y, z] = pose.rotation;
            let turned = |a: f32, b: f32, i: usize| a * x[i] + b * y[i];
            let rotation = [
                [0, 1, 2].map(|i| turned(cosine, -sine, i)),
                [0, 1, 2].map(|i| turned(sine, cosine, i)),
                z,
            ];
            let translation = [0, 1, 2].map(|i| pose.translation[i] + far * 0.7 * way[i]);
            Pose::rigid(rotation, translation)
        };
        all.push((0..STEPS).map(step).collect());
    }
    Ok(all)
}

/// The answers of one run over all paths, without the first of each path, and nanoseconds for one.
fn follow<T>(
    paths: &[Vec<Pose>],
    mut begin: impl FnMut(),
    mut ask: impl FnMut(Pose, usize) -> Result<T, String>,
) -> Result<(Vec<T>, f64), String> {
    let (mut found, mut time) = (Vec::new(), 0.0);
    for (path, poses) in paths.iter().enumerate() {
        begin();
        let first = path * STEPS;
        let _ = ask(poses[0], first)?;
        let watch = Stopwatch::start();
        for (i, pose) in poses.iter().enumerate().skip(1) {
            found.push(ask(*pose, first + i)?);
        }
        time += watch.nanoseconds_each(1);
    }
    let count = found.len().max(1) as f64;
    Ok((found, time / count))
}

/// Distances along paths.
///
/// # Errors
/// Two intervals of one pose have nothing in common.
fn along_paths(subject: &Subject, tree: &Bvh<'_>) -> Result<Table, String> {
    let columns = [
        "steps / size",
        "places",
        "us a distance",
        "coherent: times as fast",
        "pairs of nodes",
        "coherent",
        "us within half of it",
        "coherent: times as fast",
        "groups, at most",
    ];
    let mut table = Table::new("pair_path", "A mesh and itself, in small steps", &columns);
    for length in LENGTHS {
        for near in [false, true] {
            let paths = paths(subject, tree, length, near)?;
            let mut stack = [ScratchEntry::EMPTY; Bvh::DISTANCE_ENTRIES];
            let mut plain = |pose: Pose, _: usize| {
                tree.distance_to(tree, pose, Budget::EXACT, &mut stack).map_err(failed)
            };
            let (fresh, fresh_time) = fastest(|| follow(&paths, || (), &mut plain), |run| run.1)?;
            let half: Vec<f32> = {
                let all = paths.iter().flatten().map(|pose| plain(*pose, 0));
                let all = all.collect::<Result<Vec<PairDistance>, String>>()?;
                all.iter().map(|found| 0.5 * found.distance.lower).collect()
            };
            let pair = core::cell::RefCell::new(CoherentPair::<GROUPS>::new());
            let mut most = 0;
            let (kept, kept_time) = fastest(
                || {
                    let ask = |pose, _| {
                        let mut pair = pair.borrow_mut();
                        let found = pair.distance(tree, tree, pose, Budget::EXACT, &mut stack);
                        most = most.max(pair.groups());
                        found.map_err(failed)
                    };
                    follow(&paths, || pair.borrow_mut().reset(), ask)
                },
                |run| run.1,
            )?;
            let (_, within) = fastest(
                || {
                    let ask = |pose, i: usize| {
                        tree.within_of(tree, pose, half[i], Budget::EXACT, &mut stack)
                            .map_err(failed)
                    };
                    follow(&paths, || (), ask)
                },
                |run| run.1,
            )?;
            let (_, kept_within) = fastest(
                || {
                    let ask = |pose, i: usize| {
                        let mut pair = pair.borrow_mut();
                        pair.within(tree, tree, pose, half[i], Budget::EXACT, &mut stack)
                            .map_err(failed)
                    };
                    follow(&paths, || pair.borrow_mut().reset(), ask)
                },
                |run| run.1,
            )?;
            let parted = |(a, b): &(&PairDistance, &PairDistance)| {
                a.distance.lower > b.distance.upper || b.distance.lower > a.distance.upper
            };
            if let Some((a, b)) = fresh.iter().zip(&kept).find(parted) {
                return Err(format!("{:?} and {:?}", a.distance, b.distance));
            }
            let mean = |all: &[PairDistance]| {
                let sum: f64 = all.iter().map(|found| f64::from(found.work.opened)).sum();
                fixed(sum / all.len().max(1) as f64, 0)
            };
            table.push(row![
                format!("{length:.0e}"),
                if near { "near contact" } else { "apart" },
                fixed(fresh_time / 1e3, 1),
                fixed(fresh_time / kept_time, 1),
                mean(&fresh),
                mean(&kept),
                fixed(within / 1e3, 2),
                fixed(within / kept_within, 1),
                most,
            ]);
        }
    }
    table.note(format!(
        "{PATHS} paths of {STEPS} poses that turn and shift, without the first pose of each. Near \
         contact: after {:.0} hundredths of the way to the nearest place. {GROUPS} groups: {} \
         bytes",
        100.0 * (1.0 - LEFT),
        size_of::<CoherentPair<'_, GROUPS>>(),
    ));
    Ok(table)
}

/// Depths of random motions.
fn depths(subject: &Subject, tree: &Bvh<'_>) -> Result<Table, String> {
    let cases: Vec<Pose> = poses(&sphere(subject), MOTIONS).map(|(_, pose)| pose).collect();
    let mut stack = vec![ScratchEntry::EMPTY; tree.scratch_entries().max(Bvh::DISTANCE_ENTRIES)];
    let (found, _) = run(&cases, |pose| {
        let watch = Stopwatch::start();
        let found = tree.penetration(tree, *pose, Budget::EXACT, &mut stack).map_err(failed)?;
        Ok((found, watch.nanoseconds_each(1)))
    })?;
    let columns =
        ["solids", "motions", "ms, mean", "depth / size, median", "upper / lower, median", "worst"];
    let mut table = Table::new("penetration", "How deep is a mesh in itself, moved?", &columns);
    for (name, is_apart) in [("apart", true), ("one in the other, or overlapping", false)] {
        let chosen: Vec<&(Penetration, f64)> = found
            .iter()
            .filter(|(found, _)| (found.relation == Relation::Apart) == is_apart)
            .collect();
        let mean = chosen.iter().map(|(_, time)| time).sum::<f64>() / chosen.len().max(1) as f64;
        let mut depths: Vec<f64> =
            chosen.iter().map(|(found, _)| f64::from(found.depth.upper)).collect();
        let ratio = |&&(Penetration { depth: Interval { lower, upper }, .. }, _): &&(_, f64)| {
            f64::from(upper) / f64::from(lower)
        };
        let mut ratios: Vec<f64> = chosen.iter().map(ratio).collect();
        depths.sort_by(f64::total_cmp);
        ratios.sort_by(f64::total_cmp);
        let middle = |all: &[f64]| all.get(all.len() / 2).copied().unwrap_or_default();
        let part = fixed(middle(&depths) / subject.diagonal(), 3);
        let (median, worst) = (middle(&ratios), ratios.last().copied().unwrap_or_default());
        let ratio = |x: f64| if is_apart { "-".to_owned() } else { format!("{x:.2}") };
        table.push(row![
            name,
            chosen.len(),
            fixed(mean / 1e6, 2),
            part,
            ratio(median),
            ratio(worst),
        ]);
    }
    let undecided =
        |(found, _): &&(Penetration, f64)| matches!(found.relation, Relation::Undecided(_));
    table.note(format!("{} undecided", found.iter().filter(undecided).count()));
    Ok(table)
}

/// Both tables; depths of closed meshes alone.
///
/// # Errors
/// An answer is wrong.
pub fn tables(subject: &Subject) -> Result<Vec<Table>, String> {
    let bytes = tree(subject);
    let tree = Bvh::open(&bytes).map_err(failed)?;
    let mut tables = vec![along_paths(subject, &tree)?];
    if tree.is_closed() {
        tables.push(depths(subject, &tree)?);
    }
    Ok(tables)
}
