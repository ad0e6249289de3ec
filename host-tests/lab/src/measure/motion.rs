//! A capsule that moves past a mesh: motions that are called clear, held to the distance of all its
//! places in 106 bits, beside parry3d's shape cast.

use meshsweep::bvh::{TreeOptions, build};
use meshsweep::progress::Watch;
use meshsweep_core::{Budget, Bvh, Ended, FirstHit, ScratchEntry, Solid};
use meshsweep_host_tests::generate::Rng;
use meshsweep_host_tests::generate::corpus::IDENTITY;
use meshsweep_host_tests::oracle::{Bounded, distance_of_meshes};
use meshsweep_host_tests::workload::Subject;
use meshsweep_xtask::table::{Cell, Table, fixed, row};
use parry3d::math::{Pose as ParryPose, Vector};
use parry3d::query::{ShapeCastOptions, cast_shapes};
use parry3d::shape::Capsule;
use rayon::prelude::*;

use super::rival::Rival;
use super::stopwatch::answers as run;

/// Motions of a mesh of a thousand triangles; of more triangles fewer, for each is looked at.
const MOTIONS: usize = 200_000;

/// Most motions.
const MOST: usize = 100_000;

/// How far a motion has to stay away, as a part of the diagonal, to count as one that should be
/// clear.
const AWAY: f64 = 1e-3;

type Point = [f32; 3];

/// A translation of a capsule.
struct Motion {
    from: [Point; 2],
    to: [Point; 2],
    radius: f32,
    /// The distance of all places of the capsule's axis from the mesh.
    truth: Bounded,
}

/// Places are multiples of a power of two, so that their sums are exact.
fn motions(subject: &Subject) -> Vec<Motion> {
    let size = subject.diagonal();
    let step = 2f32.powi((size.log2() as i32) - 14);
    let [low, high] = subject.bounds;
    let half = size as f32 * 0.5;
    let coarse = |p: Point| p.map(|x| (x / step).round() * step);
    let plus = |p: Point, d: Point| [0, 1, 2].map(|k| p[k] + d[k]);
    let triangles = subject.mesh.triangles.len();
    let count = (MOTIONS * 1000 / triangles.max(1)).clamp(1000, MOST);
    let mut rng = Rng::new(19);
    let placed: Vec<_> = (0..count)
        .map(|_| {
            let start = coarse(rng.point_in(low.map(|x| x - half), high.map(|x| x + half)));
            let along = coarse(rng.direction().map(|x| x * 0.2 * size as f32));
            let way = coarse(rng.direction().map(|x| x * half));
            let from = [start, plus(start, along)];
            (from, from.map(|p| plus(p, way)), size as f32 * [0.0, 0.01, 0.05][rng.below(3)])
        })
        .collect();
    placed
        .into_par_iter()
        .map(|(from, to, radius)| {
            let [a, b] = from;
            let [c, d] = to;
            let corners = [a, b, d, c];
            Motion { from, to, radius, truth: distance(subject, &corners, radius) }
        })
        .collect()
}

/// The distance of a parallelogram from the mesh, as far as it matters: of triangles whose boxes
/// are farther than twice [`AWAY`] beyond the radius only that.
fn distance(subject: &Subject, corners: &[Point; 4], radius: f32) -> Bounded {
    let reach = f64::from(radius) + 2.0 * AWAY * subject.diagonal();
    let extent = |corners: &[Point]| {
        let along = |pick: fn(f32, f32) -> f32| {
            [0, 1, 2].map(|k| corners.iter().map(|p| p[k]).reduce(pick).map_or(0.0, f64::from))
        };
        [along(f32::min), along(f32::max)]
    };
    let [low, high] = extent(corners);
    let positions = &subject.mesh.positions;
    let is_near = |t: &&[u32; 3]| {
        let [from, to] = extent(&t.map(|v| positions[v as usize]));
        (0..3).all(|k| from[k] - high[k] <= reach && low[k] - to[k] <= reach)
    };
    let near: Vec<[u32; 3]> = subject.mesh.triangles.iter().filter(is_near).copied().collect();
    let swept = (&corners[..], &[[0, 1, 2], [0, 2, 3]][..]);
    let found = distance_of_meshes((positions, &near), swept, &IDENTITY, [0.0; 3]);
    Bounded { lower: found.lower.min(reach), upper: found.upper }
}

/// Motions that are called clear, against the truth.
#[derive(Default)]
struct Tally {
    clear: usize,
    /// Called clear, and it meets the mesh.
    wrong: usize,
    /// Far enough away.
    away: usize,
    /// Far enough away, and not called clear.
    missed: usize,
}

impl Tally {
    fn of(motions: &[Motion], is_clear: impl Fn(usize) -> bool, diagonal: f64) -> Self {
        let mut tally = Self::default();
        for (index, Motion { radius, truth, .. }) in motions.iter().enumerate() {
            let (radius, is_clear) = (f64::from(*radius), is_clear(index));
            let is_away = truth.lower > radius + AWAY * diagonal;
            let meets = truth.upper < radius || truth.upper == 0.0;
            tally.clear += usize::from(is_clear);
            tally.wrong += usize::from(is_clear && meets);
            tally.away += usize::from(is_away);
            tally.missed += usize::from(is_away && !is_clear);
        }
        tally
    }
}

/// The table.
///
/// # Errors
/// The mesh is one that parry3d or the builder refuses, or a motion that meets it is called clear.
pub fn table(subject: &Subject) -> Result<Table, String> {
    let motions = motions(subject);
    let columns = [
        "engine",
        "motions",
        "clear",
        "clear, and it meets",
        "away by 1e-3",
        "of these not clear",
        "undecided",
        "us a motion",
        "nodes",
        "distances in f64",
    ];
    let mut table = Table::new("motion", "A capsule that moves: is the way clear?", &columns);
    for (name, single) in [("16-bit grid", false), ("f32 vertices", true)] {
        let options = TreeOptions::default().with_closest(false).with_f32(single);
        let input = meshsweep::mesh::Input {
            input_triangles: subject.triangles_read,
            ..subject.mesh.as_input()
        };
        let bytes =
            build(input, &options, Watch::NONE).map_err(|error| error.to_string())?.0.to_bytes();
        let tree = Bvh::open(&bytes).map_err(|error| error.to_string())?;
        let mut stack = vec![ScratchEntry::EMPTY; tree.scratch_entries()];
        let (answers, time) = run(&motions, |Motion { from, to, radius, .. }| {
            let ends = [from, to].map(|corners| Solid::new(corners, *radius));
            let [from, to] = ends;
            let (from, to) = (from.map_err(said)?, to.map_err(said)?);
            tree.solid_first_contact(&from, &to, Budget::EXACT, &mut stack).map_err(said)
        })?;
        let tally = Tally::of(&motions, |index| answers[index].is_clear(), subject.diagonal());
        let open = answers.iter().filter(|answer| answer.ended == Ended::Resolution).count();
        let each = |of: fn(&FirstHit) -> u32| {
            let sum: f64 = answers.iter().map(|answer| f64::from(of(answer))).sum();
            fixed(sum / answers.len() as f64, 1)
        };
        table.push(row![
            name,
            motions.len(),
            tally.clear,
            tally.wrong,
            tally.away,
            tally.missed,
            open,
            fixed(time / 1e3, 2),
            each(|answer| answer.work.opened),
            each(|answer| answer.work.exact),
        ]);
        if tally.wrong > 0 {
            return Err(format!("{} motions that meet the mesh are called clear", tally.wrong));
        }
    }
    let rival = Rival::new(subject)?;
    let vector = |[x, y, z]: Point| Vector::new(x, y, z);
    let (theirs, time) = run(&motions, |Motion { from: [a, b], to: [c, _], radius, .. }| {
        // A capsule of parry3d needs a radius.
        let least = 1e-6 * subject.diagonal() as f32;
        let capsule = Capsule::new(vector(*a), vector(*b), radius.max(least));
        let way = vector([0, 1, 2].map(|k| c[k] - a[k]));
        cast_shapes(
            &ParryPose::IDENTITY,
            way,
            &capsule,
            &ParryPose::IDENTITY,
            Vector::ZERO,
            rival.shape(),
            ShapeCastOptions::with_max_time_of_impact(1.0),
        )
        .map(|hit| hit.is_none())
        .map_err(|error| error.to_string())
    })?;
    let tally = Tally::of(&motions, |index| theirs[index], subject.diagonal());
    table.push(row![
        "parry3d",
        motions.len(),
        tally.clear,
        tally.wrong,
        tally.away,
        tally.missed,
        Cell::Empty,
        fixed(time / 1e3, 2),
        Cell::Empty,
        Cell::Empty,
    ]);
    table.note(
        "Seeded translations of a capsule, a fifth of the diagonal long, by half of the diagonal, \
         around the mesh. A third each has no radius, a hundredth of the diagonal, and a \
         twentieth. The truth is the distance of the parallelogram of all places of its axis, in \
         106 bits.",
    );
    Ok(table)
}

fn said(error: meshsweep_core::QueryError) -> String {
    error.to_string()
}
