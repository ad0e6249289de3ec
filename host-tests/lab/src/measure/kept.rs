//! A kept sweep about a point that moves: how often the safe motion serves, and what is refined.

use glam::Vec3;
use meshsweep_core::{Budget, Hull, ScratchEntry};
use meshsweep_host_tests::workload::{Points, Subject, points};
use meshsweep_xtask::table::{Table, fixed, row};

/// Steps of one path.
const STEPS: usize = 2_000;
/// Entries of the kept sweep's queue.
const ENTRIES: usize = 512;

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
            let failed = |error: meshsweep_core::QueryError| error.to_string();
            let mut sweep = model.sweep(path[0], &mut kept).map_err(failed)?;
            for &point in &path {
                sweep.move_to(point).map_err(failed)?;
                let near = sweep.closest_point(Budget::EXACT).map_err(failed)?;
                let new = model.closest_point(point, Budget::EXACT, &mut other).map_err(failed)?;
                if near.triangle != new.triangle {
                    return Err(format!("{point:?}: {near:?} is not {new:?}"));
                }
                constant += f64::from(u8::from(near.work.splits == 0));
                opened += f64::from(near.work.splits);
                fresh += f64::from(new.work.splits);
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
