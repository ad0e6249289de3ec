//! Bounds of the Hausdorff distance from a simplified mesh, and the distances of its samples (paper
//! 004, Figure 10).

use glam::{DVec3, Vec3};
use meshsweep::bvh::exact_blob;
use meshsweep::hausdorff::{farthest, nearest_in};
use meshsweep::hull::{BuildOptions, hull_of};
use meshsweep::progress::Watch;
use meshsweep_core::Bvh;
use meshsweep_host_tests::workload::Subject;
use meshsweep_xtask::table::{Cell, Table, fixed, row};

/// The paper's simplified mesh has 4,450 of 29,200 triangles.
const KEPT: f64 = 4_450.0 / 29_200.0;

/// The search stops at these multiples of its final upper bound. 0: only its own limit, a twentieth
/// of the distance, stops it.
const ENOUGH: [f64; 6] = [4.0, 2.0, 1.5, 1.2, 1.1, 0.0];

/// Parts of the samples that are farther than the distance of a row.
const FARTHER: [f64; 10] = [0.9, 0.75, 0.5, 0.25, 0.1, 0.05, 0.02, 0.01, 0.001, 0.0001];

/// The bounds by the samples that they take, and the samples by their distances.
///
/// # Errors
/// The mesh is refused.
pub fn tables(subject: &Subject) -> Result<Vec<Table>, String> {
    let failed = |error: meshsweep::BuildError| error.to_string();
    let faces = (KEPT * subject.mesh.triangles.len() as f64) as usize;
    let options = BuildOptions::default();
    let (simple, ..) = hull_of(&subject.mesh, faces, &options, Watch::NONE).map_err(failed)?;
    let at = |v: u32| Vec3::from_array(simple.positions[v as usize]).as_dvec3();
    let corners = || simple.triangles.iter().map(|triangle| triangle.map(at));
    let bytes = exact_blob(&subject.mesh).map_err(failed)?;
    let tree = Bvh::open(&bytes).map_err(|error| error.to_string())?;
    let mut nearest = nearest_in(&tree, &subject.mesh);
    let share = |distance: f64| 100.0 * distance / subject.diagonal();

    let columns =
        ["samples", "lower, %", "upper, %", "width, %", "paper samples", "paper width, %"];
    let title = format!(
        "Distance from {} triangles to {}, beside paper 004, Figure 10",
        simple.triangles.len(),
        subject.mesh.triangles.len()
    );
    let mut bounds = Table::new("hausdorff", title, &columns);
    let mut search = |enough: f64| {
        let mut samples = 0u32;
        let found = farthest(corners(), enough, |p| {
            samples += 1;
            nearest(p)
        });
        (found, samples)
    };
    let (last, _) = search(0.0);
    for enough in ENOUGH {
        let (found, samples) = search(enough * last.upper);
        let is_last = enough == 0.0;
        bounds.push(row![
            samples,
            fixed(share(found.lower), 4),
            fixed(share(found.upper), 4),
            fixed(share(found.upper - found.lower), 4),
            if is_last { Cell::from(211_000u32) } else { Cell::Empty },
            if is_last { fixed(0.04, 2) } else { Cell::Empty },
        ]);
    }
    bounds.note(
        "%: of the diagonal; samples: points whose distance was asked; the search stops at an \
         upper bound that is enough, at last within a twentieth of a distance that was found",
    );
    bounds.note(
        "the paper's meshes have 29,200 and 4,450 triangles; here the second is an outer hull",
    );

    let mut distances: Vec<f64> = corners()
        .flat_map(|[a, b, c]| [a, b, c, (a + b + c) / 3.0])
        .filter_map(|p: DVec3| Some(share(nearest(p)?.upper)))
        .collect();
    distances.sort_by(f64::total_cmp);
    let mut series = Table::new(
        "hausdorff_samples",
        "Distances of samples, the colours of paper 004, Figure 10-C",
        &["mesh", "distance, %", "samples that are farther, %"],
    );
    for farther in FARTHER {
        let rank = ((1.0 - farther) * distances.len() as f64) as usize;
        let distance = distances.get(rank).copied().unwrap_or(0.0);
        series.push(row![subject.name.clone(), fixed(distance, 4), fixed(100.0 * farther, 2)]);
    }
    series.note(format!("{} samples: corners and middles of the simplified mesh", distances.len()));
    Ok(vec![bounds, series])
}
