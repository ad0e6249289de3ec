//! Tables of a race.

use meshsweep_host_tests::workload::Subject;
use meshsweep_xtask::table::{Cell, Table, fixed, row, scientific};

use super::entrants::REFERENCE;
use super::timing::{BuiltEngine, Measurement};
use super::workload::{Scale, Workload};

/// The mesh, and what each engine's index takes.
pub fn engines(subject: &Subject, built: &[BuiltEngine<'_>], missing: Vec<String>) -> Table {
    let triangles = subject.mesh.triangles.len();
    let title = format!("== {}: {triangles} triangles, {} ==", subject.name, machine());
    let mut table = Table::new("engines", title, &["engine", "build s", "bytes/triangle", "what"]);
    for BuiltEngine { entrant, engine, build_seconds } in built {
        let bytes = engine.bytes() as f64 / triangles as f64;
        table.push(row![entrant.name, fixed(*build_seconds, 3), fixed(bytes, 1), entrant.remark]);
    }
    missing.into_iter().for_each(|line| table.note(line));
    table
}

/// Times and agreement.
pub fn measurements(measurements: &[Measurement], scale: Scale) -> Table {
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
        "hits",
        "undecided",
    ];
    let mut table = Table::new("laps", "Nanoseconds a query, one thread", &columns);
    for run in measurements {
        let agreement = run.agreement;
        let is_any = run.workload == Workload::AnyHit;
        let hits = |count: usize| (is_any || run.workload == Workload::Segments).then_some(count);
        let error = |error: f64| if is_any { Cell::Empty } else { scientific(error) };
        table.push(row![
            run.workload.name(),
            run.engine,
            run.queries,
            fixed(run.nanoseconds, 0),
            fixed(run.speed, 3),
            agreement.checked,
            error(agreement.error),
            hits(agreement.wrong_hits),
            if run.engine == REFERENCE { Cell::Empty } else { error(agreement.apart) },
            if run.engine == REFERENCE { Cell::Empty } else { hits(agreement.other_hits).into() },
            hits(agreement.hits),
            is_any.then_some(agreement.undecided),
        ]);
    }
    let side = scale.side;
    table.note(
        "x parry3d: how many times as fast; error, wrong hits: against every triangle in f64, \
         relative for distances",
    );
    table.note(
        "off parry3d: largest difference from its answers, distances in diagonals of the mesh; \
         other hits: hit here and miss there",
    );
    table.note("undecided: neither hit nor miss is proved, and neither is compared");
    table.note(
        "far, segments, any hit: box twice the mesh's; near: Gaussian of 1 % of the diagonal; \
         path: 1 % off the surface, orbit: around and through",
    );
    table.note(format!(
        "path, orbit: steps of 0.03 % of the diagonal; field: {side}^3 nodes row by row"
    ));
    table
}

/// What the compiler was allowed to use.
fn machine() -> &'static str {
    if cfg!(all(target_arch = "x86_64", target_feature = "avx2", target_feature = "fma")) {
        "x86-64-v3 (AVX2, FMA)"
    } else if cfg!(target_arch = "x86_64") {
        "plain x86-64 (SSE2)"
    } else {
        std::env::consts::ARCH
    }
}
