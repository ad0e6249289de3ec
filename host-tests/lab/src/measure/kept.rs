//! A kept sweep about a point that moves: how often the safe motion serves, what is refined, and
//! how many entries of scratch it takes.

use glam::{DVec3, Vec3};
use meshsweep_core::{Budget, Ended, Hull, QueryError, ScratchEntry};
use meshsweep_host_tests::workload::{Points, Subject, points};
use meshsweep_xtask::table::{Table, fixed, row};

/// Steps of one path.
const STEPS: usize = 2_000;
/// Entries of the kept sweep's queue, in the table about work.
const ENTRIES: usize = 512;
/// Distances of orbits from the middle of the box, in diagonals.
const ORBITS: [f64; 6] = [0.6, 1.0, 2.0, 5.0, 10.0, 100.0];
/// Steps of an orbit, in diagonals.
const ORBIT_STEPS: [f64; 3] = [1e-4, 1e-2, 1e-1];
/// Points of an orbit.
const ORBIT_POINTS: usize = 500;

/// By workload and step: the share of constant-time answers, and triangles replaced.
pub fn table(subject: &Subject, model: &Hull<'_>) -> Result<Table, String> {
    let columns = ["points", "step / diagonal", "in constant time, %", "opened", "opened, fresh"];
    let mut table = Table::new("kept_sweep", "Kept sweep, exact", &columns);
    for kind in [Points::Far, Points::Near] {
        for step in [1e-5, 1e-4, 1e-3, 1e-2] {
            let path = path(subject, kind, step);
            let [mut constant, mut opened, mut fresh] = [0.0; 3];
            let (mut kept, mut other) =
                ([ScratchEntry::EMPTY; ENTRIES], [ScratchEntry::EMPTY; ENTRIES]);
            let failed = |error: QueryError| error.to_string();
            let mut sweep = model.sweep(path[0], &mut kept).map_err(failed)?;
            for &point in &path {
                sweep.move_to(point).map_err(failed)?;
                let near = sweep.closest_point(Budget::EXACT).map_err(failed)?;
                let new = model.closest_point(point, Budget::EXACT, &mut other).map_err(failed)?;
                if near.triangle != new.triangle {
                    return Err(format!("{point:?}: {near:?} is not {new:?}"));
                }
                constant += f64::from(u8::from(near.work.opened == 0));
                opened += f64::from(near.work.opened);
                fresh += f64::from(new.work.opened);
            }
            let each = 1.0 / path.len() as f64;
            table.push(row![
                kind.name(),
                format!("{step:e}"),
                fixed(100.0 * constant * each, 1),
                fixed(opened * each, 1),
                fixed(fresh * each, 1),
            ]);
        }
    }
    table.note(format!("a queue of {ENTRIES} entries; the answers are those of fresh queries"));
    Ok(table)
}

/// By orbit and step: the answers that lack memory with so many entries.
pub fn memory(model: &Hull<'_>) -> Result<Table, String> {
    let columns = ["diagonals away", "step / diagonal", "entries", "answers that lack memory, %"];
    let mut table = Table::new("kept_sweep_memory", "Memory of a kept sweep", &columns);
    for away in ORBITS {
        for step in ORBIT_STEPS {
            for entries in [ENTRIES, 2 * ENTRIES, 4 * ENTRIES, model.sweep_entries()] {
                let short = short_answers(model, away, step, entries);
                let short = short.map_err(|error| error.to_string())?;
                let share = 100.0 * short as f64 / ORBIT_POINTS as f64;
                table.push(row![format!("{away}"), format!("{step:e}"), entries, fixed(share, 1)]);
            }
        }
    }
    table.note("the last number of entries of each orbit is the blob's, `Hull::sweep_entries`");
    Ok(table)
}

/// How many answers on an orbit lack memory.
fn short_answers(
    model: &Hull<'_>,
    away: f64,
    step: f64,
    entries: usize,
) -> Result<usize, QueryError> {
    let [low, high] = model.bounds().map(|corner| Vec3::from(corner).as_dvec3());
    let (middle, diagonal) = (0.5 * (low + high), (high - low).length());
    let mut scratch = vec![ScratchEntry::EMPTY; entries];
    let mut sweep = model.sweep(middle.as_vec3().to_array(), &mut scratch)?;
    let mut short = 0;
    for i in 0..ORBIT_POINTS {
        let (sine, cosine) = (i as f64 * step / away).sin_cos();
        let way = DVec3::new(cosine, 0.8 * sine, 0.6 * sine);
        sweep.move_to((middle + diagonal * away * way).as_vec3().to_array())?;
        short += usize::from(sweep.closest_point(Budget::EXACT)?.ended == Ended::Scratch);
    }
    Ok(short)
}

/// Straight ways between points, in equal steps.
fn path(subject: &Subject, kind: Points, step: f64) -> Vec<[f32; 3]> {
    let step = (step * subject.diagonal()) as f32;
    let ends = points(subject, kind, STEPS);
    let ways = ends.windows(2).flat_map(|ends| {
        let [from, to] = [ends[0], ends[1]].map(Vec3::from_array);
        let count = (from.distance(to) / step).ceil().max(1.0);
        (0..count as u32).map(move |i| (from + (to - from) * (i as f32 / count)).to_array())
    });
    ways.take(STEPS).collect()
}
