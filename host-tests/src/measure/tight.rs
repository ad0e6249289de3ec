//! Tight hulls: void, distance, time and proof for some numbers of faces, beside other bounds of the same mesh.

use glam::DVec3;
use meshsweep_alloc::hull::{BuildOptions, hull_of};
use meshsweep_alloc::mesh::require_closed_manifold;
use meshsweep_alloc::wrap::{Goal, Hull, Options, Start, Stop, wrap};

use super::Subject;
use super::bounds::convex_hull::ConvexHull;
use super::bounds::dop::{Dop, Slabs};
use super::bounds::enclosing_sphere::Sphere;
use super::paper::STRATEGIES;
use super::stopwatch::Stopwatch;
use super::table::{Cell, Table, fixed, row};
use crate::check::{Surface, check_enclosure};

/// Faces of the hulls.
pub const FACES: [usize; 7] = [20, 50, 100, 200, 500, 1_000, 2_000];

/// The tables.
///
/// # Errors
/// A hull is missing, or the checker does not prove it.
pub fn tables(subject: &Subject) -> Result<Vec<Table>, String> {
    let volume = require_closed_manifold(&subject.mesh).is_ok().then(|| volume_of(subject));
    let mut tables = vec![hulls(subject, volume)?];
    tables.extend(volume.and_then(|volume| convex(subject, volume)));
    Ok(tables)
}

fn hulls(subject: &Subject, volume: Option<f64>) -> Result<Table, String> {
    let mut table = Table::new(
        "tight",
        "Tight hulls, each proved by the checker, beside progressive hulls of as many faces",
        &[
            "asked",
            "faces",
            "void %",
            "distance",
            "of diagonal",
            "seconds",
            "stars",
            "start",
            "stop",
            "void %, lp",
            "void %, span",
        ],
    );
    for faces in FACES {
        let begun = Stopwatch::start();
        let options = Options { goal: Goal::Faces(faces), ..Options::default() };
        let Hull { mesh, report } =
            wrap(&subject.mesh, &options, |_| {}).map_err(|error| error.to_string())?;
        let seconds = begun.seconds();
        let surface = |m: &meshsweep_alloc::mesh::Mesh| Surface::new(&m.positions, &m.triangles);
        check_enclosure(&surface(&subject.mesh), &surface(&mesh))
            .map_err(|error| format!("the hull of {faces} faces is not proved: {error}"))?;
        let nested = STRATEGIES.map(|(priority, _)| {
            let options = BuildOptions { priority, ..BuildOptions::default() };
            let built = volume.and_then(|_| hull_of(&subject.mesh, faces, &options, |_| {}).ok());
            built.map_or(Cell::Empty, |(hull, void, _)| {
                if hull.triangles.len() <= faces { fixed(100.0 * void, 2) } else { Cell::Empty }
            })
        });
        let [lp, span] = nested;
        let start = match report.start {
            Start::Progressive { faces } => format!("level {faces}"),
            Start::Closure { cells, .. } => format!("closure {cells}"),
            Start::Box => "box".into(),
        };
        let stop = match report.stop {
            Stop::Reached => "reached",
            Stop::Stuck => "stuck",
            Stop::TooLoose => "too loose",
            Stop::OutOfTime => "out of time",
        };
        table.push(row![
            faces,
            report.faces,
            report.void.map_or(Cell::Empty, |void| fixed(100.0 * void, 2)),
            fixed(report.slack.upper, 4),
            fixed(report.slack.upper / subject.diagonal(), 4),
            fixed(seconds, 2),
            report.stars as usize,
            start,
            stop,
            lp,
            span,
        ]);
    }
    table.note("distance: no point of the hull is farther from the mesh; input units; seconds of processor time from the mesh in memory");
    table.note("lp, span: progressive hulls by the two priorities of paper 000; empty if they do not come down to so few faces");
    Ok(table)
}

/// What bounds that are convex leave of the mesh's own volume.
fn convex(subject: &Subject, volume: f64) -> Option<Table> {
    let points: Vec<DVec3> =
        subject.mesh.positions.iter().map(|p| DVec3::from_array(p.map(f64::from))).collect();
    let hull = ConvexHull::new(&points)?;
    let sphere = Sphere::enclosing(&hull.points);
    let mut table = Table::new("tight_convex", "Void of convex bounds", &["bound", "faces", "void %"]);
    let void = |bound: f64| fixed(100.0 * (bound / volume - 1.0), 1);
    for slabs in Slabs::all() {
        let solid = Dop::of(&slabs, hull.points.iter().copied()).solid(&slabs, sphere.centre, sphere.radius);
        table.push(row![slabs.name, solid.faces.len(), void(solid.volume())]);
    }
    table.push(row!["convex hull", hull.triangles.len(), void(hull.volume())]);
    Some(table)
}

/// Around a vertex of the mesh, so that nothing cancels on a part far from the origin.
fn volume_of(subject: &Subject) -> f64 {
    let at = |v: u32| DVec3::from_array(subject.mesh.positions[v as usize].map(f64::from));
    let origin = at(0);
    let six = subject.mesh.triangles.iter().map(|t| {
        let [a, b, c] = t.map(|v| at(v) - origin);
        a.dot(b.cross(c))
    });
    six.sum::<f64>() / 6.0
}
