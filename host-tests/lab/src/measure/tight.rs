//! Tight hulls: void, distance, time and proof for some numbers of faces, beside triboxes of the
//! same mesh.

mod beside;

use meshsweep::check::{Surface, check_enclosure};
use meshsweep::hull::{BuildOptions, hull_of};
use meshsweep::mesh::{Mesh, require_closed_manifold};
use meshsweep::progress::Watch;
use meshsweep::tight::{Goal, Hull, Options, Outcome, Start, wrap};
use meshsweep::tribox::volume;
use meshsweep_host_tests::workload::Subject;
use meshsweep_xtask::table::{Cell, Table, fixed, row};

use super::paper::figures::STRATEGIES;
use super::stopwatch::Stopwatch;

/// Faces of the hulls.
pub const FACES: [usize; 7] = [20, 50, 100, 200, 500, 1_000, 2_000];

/// A hull that was measured.
#[derive(Clone, Debug)]
pub struct Measured {
    /// Faces that were asked for.
    pub asked: usize,
    /// The hull.
    pub hull: Mesh,
}

/// The tables.
///
/// # Errors
/// A hull is missing, or the checker does not prove it.
pub fn tables(subject: &Subject) -> Result<Vec<Table>, String> {
    let volume = require_closed_manifold(&subject.mesh).is_ok().then(|| volume(&subject.mesh));
    let mut measured = Vec::new();
    let table = hulls(subject, volume, &mut measured)?;
    let mut tables = vec![table];
    if let Some(volume) = volume.filter(|&volume| volume > 0.0) {
        tables.push(beside::table(subject, volume, &measured)?);
    }
    Ok(tables)
}

fn hulls(
    subject: &Subject,
    volume: Option<f64>,
    measured: &mut Vec<Measured>,
) -> Result<Table, String> {
    let mut table = Table::new(
        "tight",
        "Tight hulls, each proved by the checker, beside progressive hulls of as many faces",
        &[
            "asked",
            "faces",
            "void %",
            "distance",
            "at least",
            "of diagonal",
            "seconds",
            "stars",
            "programs",
            "start",
            "stop",
            "void %, lp",
            "void %, span",
        ],
    );
    for faces in FACES {
        let begun = Stopwatch::start();
        let options = Options::new(Goal::Faces(faces));
        let Hull { mesh, report } =
            wrap(&subject.mesh, &options, Watch::NONE).map_err(|error| error.to_string())?;
        let seconds = begun.seconds();
        let surface = |m: &Mesh| Surface::new(&m.positions, &m.triangles);
        check_enclosure(&surface(&subject.mesh), &surface(&mesh))
            .map_err(|error| format!("the hull of {faces} faces is not proved: {error}"))?;
        let nested = STRATEGIES.map(|(priority, _)| {
            let options = BuildOptions { priority, ..BuildOptions::default() };
            let built =
                volume.and_then(|_| hull_of(&subject.mesh, faces, &options, Watch::NONE).ok());
            built.map_or(Cell::Empty, |(hull, void, _)| {
                if hull.triangles.len() <= faces { fixed(100.0 * void, 2) } else { Cell::Empty }
            })
        });
        let [lp, span] = nested;
        let start = match report.start {
            Start::Progressive { faces } => format!("level {faces}"),
            Start::VoxelClosure { voxels, .. } => format!("closure {voxels}"),
            Start::Box => "box".into(),
        };
        let stop = match report.stop {
            Outcome::Reached => "reached",
            Outcome::Stuck => "stuck",
            Outcome::TooLoose => "too loose",
            Outcome::OutOfTime => "out of time",
        };
        table.push(row![
            faces,
            report.faces,
            report.void.map_or(Cell::Empty, |void| fixed(100.0 * void, 2)),
            fixed(report.slack.upper, 4),
            fixed(report.slack.lower, 4),
            fixed(report.slack.upper / subject.diagonal(), 4),
            fixed(seconds, 2),
            report.stars,
            report.programs,
            start,
            stop,
            lp,
            span,
        ]);
        measured.push(Measured { asked: faces, hull: mesh });
    }
    table.note("distance: no point of the hull is farther from the mesh, and one is at least so far; input units; seconds of processor time from the mesh in memory");
    table.note("lp, span: progressive hulls by the two priorities of paper 000; empty if they do not come down to so few faces");
    Ok(table)
}
