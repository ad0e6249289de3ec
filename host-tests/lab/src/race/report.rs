//! Tables of a race, and of several.

use meshsweep_host_tests::workload::Subject;
use meshsweep_xtask::table::{Cell, Table, fixed, row, scientific};

use super::engine::{ENTRANTS, REFERENCE};
use super::timing::{Lane, Lap};
use super::{Race, Scale, Workload, is_closed, machine};

/// The mesh, and what each engine's index takes.
pub fn engines(subject: &Subject, lanes: &[Lane<'_>]) -> Table {
    let triangles = subject.mesh.triangles.len();
    let state = if is_closed(subject) { "closed" } else { "open" };
    let title = format!("== {}: {triangles} triangles, {state}, {} ==", subject.name, machine());
    let mut table = Table::new("engines", title, &["engine", "build s", "bytes/triangle", "what"]);
    for entrant in &ENTRANTS {
        let lane = lanes.iter().find(|lane| lane.entrant.name == entrant.name);
        let cells = lane.map(|lane| {
            [fixed(lane.build_seconds, 3), fixed(lane.engine.bytes() as f64 / triangles as f64, 1)]
        });
        let missing = if lane.is_some() { "" } else { " (not on this mesh)" };
        let [seconds, bytes] = cells.unwrap_or([Cell::Empty, Cell::Empty]);
        table.push(row![entrant.name, seconds, bytes, format!("{}{missing}", entrant.remark)]);
    }
    table
}

/// Times and agreement.
pub fn laps(laps: &[Lap], scale: Scale) -> Table {
    let columns = [
        "workload",
        "engine",
        "queries",
        "ns",
        "x parry3d",
        "checked",
        "error",
        "wrong hits",
        "off parry3d",
        "other hits",
    ];
    let mut table = Table::new("laps", "Nanoseconds a query, one thread", &columns);
    for lap in laps {
        let agreement = lap.agreement;
        let hits = |count: usize| (lap.workload == Workload::Segments).then_some(count);
        table.push(row![
            lap.workload.name(),
            lap.engine,
            lap.queries,
            fixed(lap.nanoseconds, 0),
            fixed(lap.speed, 3),
            agreement.checked,
            scientific(agreement.error),
            hits(agreement.wrong_hits),
            if lap.engine == REFERENCE { Cell::Empty } else { scientific(agreement.apart) },
            if lap.engine == REFERENCE { Cell::Empty } else { hits(agreement.other_hits).into() },
        ]);
    }
    let side = scale.side;
    table.note("x parry3d: how many times as fast; error, wrong hits: against every triangle in f64, relative for distances");
    table.note("off parry3d: largest difference from its answers, distances in diagonals of the mesh; other hits: hit here and miss there");
    table.note("far, segments: box twice the mesh's; near: Gaussian of 1 % of the diagonal; path: 1 % off the surface, orbit: around and through");
    table.note(format!(
        "path, orbit: steps of 0.03 % of the diagonal; field: {side}^3 nodes row by row"
    ));
    table
}

/// Geometric means over all meshes, and how the cost grows with them.
#[must_use]
pub fn summary(races: &[Race]) -> Table {
    let columns =
        ["workload", "engine", "meshes", "x parry3d", "least", "greatest", "x obvhs", "growth"];
    let mut table = Table::new("summary", format!("== all meshes, {} ==", machine()), &columns);
    for workload in Workload::ALL {
        for entrant in &ENTRANTS {
            let of = |engine: &str, race: &Race| {
                race.laps
                    .iter()
                    .find(|lap| lap.workload == workload && lap.engine == engine)
                    .cloned()
            };
            let laps: Vec<(usize, Lap)> = races
                .iter()
                .filter_map(|race| of(entrant.name, race).map(|lap| (race.triangles, lap)))
                .collect();
            if laps.is_empty() {
                continue;
            }
            let speeds: Vec<f64> = laps.iter().map(|(_, lap)| lap.speed).collect();
            let over_obvhs: Vec<f64> = races
                .iter()
                .filter_map(|race| {
                    Some(of("obvhs", race)?.nanoseconds / of(entrant.name, race)?.nanoseconds)
                })
                .collect();
            table.push(row![
                workload.name(),
                entrant.name,
                laps.len(),
                fixed(geometric_mean(&speeds), 3),
                fixed(speeds.iter().copied().fold(f64::INFINITY, f64::min), 3),
                fixed(speeds.iter().copied().fold(0.0, f64::max), 3),
                if over_obvhs.is_empty() {
                    Cell::Empty
                } else {
                    fixed(geometric_mean(&over_obvhs), 3)
                },
                growth(&laps).map_or(Cell::Empty, |growth| fixed(growth, 2)),
            ]);
        }
    }
    table.note(
        "x parry3d, x obvhs: how many times as fast, geometric means over the meshes that the engine ran on",
    );
    table
        .note("growth: time on the mesh with the most triangles over time on that with the fewest");
    table
}

fn growth(laps: &[(usize, Lap)]) -> Option<f64> {
    let (few, small) = laps.iter().min_by_key(|(triangles, _)| *triangles)?;
    let (many, large) = laps.iter().max_by_key(|(triangles, _)| *triangles)?;
    (few < many).then(|| large.nanoseconds / small.nanoseconds)
}

fn geometric_mean(values: &[f64]) -> f64 {
    (values.iter().map(|value| value.ln()).sum::<f64>() / values.len() as f64).exp()
}
