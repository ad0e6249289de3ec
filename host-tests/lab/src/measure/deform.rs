//! Hulls that deform: what an update of a free motion costs, and what the motion costs a query.

use meshsweep::hull::{BuildOptions, Levels, build};
use meshsweep::mesh::{KeyFrame, Mesh};
use meshsweep::progress::Watch;
use meshsweep_core::{
    Budget, ClosestPoint, DeformableHull, MovedVertex, QueryError, ScratchEntry, SectionKind, Work,
};
use meshsweep_host_tests::oracle::rough_distance_sq;
use meshsweep_host_tests::workload::{Points, Subject, points};
use meshsweep_xtask::table::{Table, fixed, row};

use super::BASE_FACES;
use super::stopwatch::{Stopwatch, fastest};

/// Points of each pose.
const COUNT: usize = 4_000;
/// Points of each pose that are compared with every triangle in f64.
const BRUTE: usize = 50;
/// Updates of a run.
const UPDATES: usize = 20;
/// Twists from one end of the mesh to the other, in degrees.
const TWISTS: [f64; 8] = [0.0, 1.0, 5.0, 15.0, 45.0, 90.0, 180.0, 360.0];

/// The tables.
///
/// # Errors
/// The mesh is no solid, or an answer is wrong.
pub fn tables(subject: &Subject) -> Result<Vec<Table>, String> {
    let rest = &subject.mesh.positions;
    let frame = |twist| KeyFrame { positions: twisted(rest, twist), rounding: 0.0 };
    let levels = Levels::Deform(&[frame(180.0)]);
    let options = BuildOptions { levels, base_faces: BASE_FACES, ..BuildOptions::default() };
    let built = build(subject.mesh.as_input(), &options, Watch::NONE);
    let built = built.map_err(|error| error.to_string())?.0.to_bytes();
    let hull = DeformableHull::open(&built).map_err(|error| error.to_string())?;
    let mut memory = vec![MovedVertex::EMPTY; hull.vertex_records()];
    let refused = |error: QueryError| error.to_string();
    let mut moved = hull.moved(&mut memory).map_err(refused)?;

    let columns = [
        "twist",
        "update ms",
        "far: ns",
        "nodes",
        "exact",
        "opened",
        "near: ns",
        "nodes",
        "exact",
        "opened",
    ];
    let title = "Free motion: closest point, exact, under a twist of so many degrees";
    let mut costs = Table::new("moved_hull", title, &columns);
    let mut update_ms = f64::INFINITY;
    let mut scratch = vec![ScratchEntry::EMPTY; hull.rest().scratch_entries() + 4096];
    for twist in TWISTS {
        let positions = twisted(rest, twist);
        let update = || {
            let begun = Stopwatch::start();
            for _ in 0..UPDATES {
                moved.update(|vertex| positions[vertex as usize]).map_err(refused)?;
            }
            Ok(begun.nanoseconds_each(UPDATES) / 1e6)
        };
        let ms = fastest(update, |&ms: &f64| ms)?;
        update_ms = update_ms.min(ms);
        let mesh = Mesh::new(positions, subject.mesh.triangles.clone());
        let pose = Subject::of(subject.name.clone(), mesh);
        let mut cells = row![fixed(twist, 0), fixed(ms, 2)];
        for kind in [Points::Far, Points::Near] {
            cells.extend(ask(&pose, kind, |point| {
                moved.closest_point(point, Budget::EXACT, &mut scratch).map_err(refused)
            })?);
        }
        costs.push(cells);
    }
    costs.note(
        "0 degrees: the mesh at rest, by the moved hull; far and near as in the other tables",
    );
    costs.note(format!("{BRUTE} points of each row agree with brute force in f64"));

    let title =
        "Between the mesh at rest and a key frame twisted by 180 degrees, and at rest alone";
    let columns =
        ["frame", "far: ns", "nodes", "exact", "opened", "near: ns", "nodes", "exact", "opened"];
    let mut frames = Table::new("frame_hull", title, &columns);
    let key = twisted(rest, 180.0);
    for part in [0.0f32, 0.25, 0.5, 0.75, 1.0] {
        let at = hull.at_frame(part).map_err(refused)?;
        let between = |(a, b): (&[f32; 3], &[f32; 3])| -> [f32; 3] {
            std::array::from_fn(|k| {
                (f64::from(a[k]) + (f64::from(b[k]) - f64::from(a[k])) * f64::from(part)) as f32
            })
        };
        let positions = rest.iter().zip(&key).map(between).collect();
        let mesh = Mesh::new(positions, subject.mesh.triangles.clone());
        let pose = Subject::of(subject.name.clone(), mesh);
        let mut cells = row![fixed(f64::from(part), 2)];
        for kind in [Points::Far, Points::Near] {
            cells.extend(ask(&pose, kind, |point| {
                at.closest_point(point, Budget::EXACT, &mut scratch).map_err(refused)
            })?);
        }
        frames.push(cells);
    }
    let pose = Subject::of(subject.name.clone(), subject.mesh.clone());
    let mut cells = row!["rest"];
    for kind in [Points::Far, Points::Near] {
        cells.extend(ask(&pose, kind, |point| {
            hull.rest().closest_point(point, Budget::EXACT, &mut scratch).map_err(refused)
        })?);
    }
    frames.push(cells);

    let triangles = subject.mesh.triangles.len();
    let blob = meshsweep_core::Blob::open(&built).map_err(|error| error.to_string())?;
    let bytes = |kind| {
        let of_kind = blob.sections().filter(|section| section.kind == kind);
        of_kind.map(|section| f64::from(section.bytes)).sum::<f64>() / triangles as f64
    };
    let columns = [
        "vertex records",
        "bytes of RAM a triangle",
        "vertex numbers, bytes a triangle",
        "a key frame, bytes a triangle",
        "update ms",
    ];
    let mut sizes = Table::new("deformation", "Memory of a hull that deforms", &columns);
    sizes.push(row![
        hull.vertex_records(),
        fixed((16 * hull.vertex_records()) as f64 / triangles as f64, 2),
        fixed(bytes(SectionKind::VertexNumbers), 2),
        fixed(bytes(SectionKind::KeyFrames), 2),
        fixed(update_ms, 2),
    ]);
    Ok(vec![sizes, costs, frames])
}

/// The mesh, its longest axis twisted by `degrees` from end to end.
fn twisted(positions: &[[f32; 3]], degrees: f64) -> Vec<[f32; 3]> {
    let end = |pick: fn(f32, f32) -> f32, k: usize| {
        positions.iter().map(|p| p[k]).reduce(pick).map_or(0.0, f64::from)
    };
    let low: [f64; 3] = std::array::from_fn(|k| end(f32::min, k));
    let high: [f64; 3] = std::array::from_fn(|k| end(f32::max, k));
    let extent = |k: usize| high[k] - low[k];
    let along = (0..3).max_by(|&i, &j| extent(i).total_cmp(&extent(j))).unwrap_or(0);
    let [i, j] = [(along + 1) % 3, (along + 2) % 3];
    let middle = |k: usize| 0.5 * (low[k] + high[k]);
    let turned = |p: &[f32; 3]| {
        let angle = (f64::from(p[along]) - low[along]) / extent(along) * degrees.to_radians();
        let (sin, cos) = angle.sin_cos();
        let (x, y) = (f64::from(p[i]) - middle(i), f64::from(p[j]) - middle(j));
        let mut q = *p;
        if degrees != 0.0 {
            q[i] = (middle(i) + cos * x - sin * y) as f32;
            q[j] = (middle(j) + sin * x + cos * y) as f32;
        }
        q
    };
    positions.iter().map(turned).collect()
}

/// Time and work of a point, four cells.
fn ask(
    pose: &Subject,
    kind: Points,
    mut closest: impl FnMut([f32; 3]) -> Result<ClosestPoint, String>,
) -> Result<Vec<meshsweep_xtask::table::Cell>, String> {
    let asked = points(pose, kind, COUNT);
    let mut run = || {
        let begun = Stopwatch::start();
        let answers = asked.iter().map(|&point| closest(point)).collect::<Result<Vec<_>, _>>()?;
        Ok((answers, begun.nanoseconds_each(asked.len())))
    };
    let (answers, nanoseconds) = fastest(&mut run, |(_, nanoseconds)| *nanoseconds)?;
    for (point, answer) in asked.iter().zip(&answers).take(BRUTE) {
        let corners = |t: &[u32; 3]| t.map(|v| pose.mesh.positions[v as usize]);
        let squares = pose.mesh.triangles.iter().map(|t| rough_distance_sq(*point, corners(t)));
        let truth = squares.fold(f64::INFINITY, f64::min).sqrt();
        let slack = 1e-6 * pose.diagonal();
        let (lower, upper) = (f64::from(answer.distance.lower), f64::from(answer.distance.upper));
        if lower > truth + slack || upper < truth - slack {
            return Err(format!("{point:?}: {answer:?} is not {truth:e}"));
        }
    }
    let mean = |counter: fn(&Work) -> u32| {
        let sum: f64 = answers.iter().map(|answer| f64::from(counter(&answer.work))).sum();
        fixed(sum / answers.len() as f64, 1)
    };
    Ok(vec![
        fixed(nanoseconds, 0),
        mean(|work| work.bounds),
        mean(|work| work.exact),
        mean(|work| work.opened),
    ])
}
