//! Answers against every triangle in f64: of the surface that the blob stores, and of the input.

use glam::{DVec3, Vec3};
use meshsweep_core::Bvh;
use meshsweep_host_tests::workload::Subject;
use meshsweep_host_tests::workload::{Points, points};
use meshsweep_xtask::table::{Table, row, scientific};

use super::{Built, answers};
use crate::measure::brute::Brute;

/// Pairs of a point and a triangle that are looked at in f64 for each row: some seconds.
const PAIRS: usize = 100_000_000;
/// Points of each row at most.
const COUNT: usize = 3334;

/// Errors of distances and witnesses, and widths.
///
/// # Errors
/// A query is refused, or an interval does not contain the distance.
pub fn table(subject: &Subject, grid: &Built, single: &Built) -> Result<Table, String> {
    let columns = [
        "vertices as",
        "points",
        "asked",
        "outside",
        "distance, largest",
        "99.9 %",
        "witness, largest",
        "of diagonal",
        "interval, largest",
        "mean",
        "quantisation",
    ];
    let mut table =
        Table::new("tree_accuracy", "Box tree, closest point against f64 brute force", &columns);
    let input = Brute::new(subject);
    let count = (PAIRS / subject.mesh.triangles.len()).clamp(100, COUNT);
    let diagonal = subject.diagonal();
    for (name, built) in [("16-bit grid", grid), ("f32", single)] {
        let tree = built.open()?;
        let stored = Brute::of(stored(&tree)?);
        let unit = 2f64.powi(tree.scale_exponent());
        let quantisation = 2.0 * f64::from(tree.header().surface_error) * unit;
        for kind in [Points::Far, Points::Near] {
            let asked = points(subject, kind, count);
            let answers = answers(&tree, &asked)?;
            let mut outside = 0;
            let (mut middle, mut witness, mut apart) = (Vec::new(), 0f64, 0f64);
            let (mut widest, mut width) = (0f64, 0f64);
            for (&point, answer) in asked.iter().zip(&answers) {
                let (here, there) = (stored.distance(point), input.distance(point));
                let (lower, upper) =
                    (f64::from(answer.distance.lower), f64::from(answer.distance.upper));
                outside += usize::from(!contains(lower, upper, there, point));
                if lower > 0.0 {
                    middle.push((0.5 * (lower + upper) / here - 1.0).abs());
                }
                let at = [answer.point, point].map(|p| Vec3::from_array(p).as_dvec3());
                let off = (at[0].distance(at[1]) - here).abs();
                (witness, apart) = (witness.max(off / here), apart.max(off / diagonal));
                let beyond = (upper - lower - quantisation).max(0.0) / diagonal;
                (widest, width) = (widest.max(beyond), width + beyond);
            }
            middle.sort_by(f64::total_cmp);
            let last = middle.last().copied().unwrap_or(0.0);
            let most = middle.get((middle.len() * 999).div_ceil(1000).saturating_sub(1)).copied();
            table.push(row![
                name,
                kind.name(),
                count,
                outside,
                scientific(last),
                scientific(most.unwrap_or(last)),
                scientific(witness),
                scientific(apart),
                scientific(widest),
                scientific(width / count as f64),
                scientific(quantisation / diagonal),
            ]);
            if outside > 0 {
                return Err(format!(
                    "{name}, {}: {outside} intervals without the distance",
                    kind.name()
                ));
            }
        }
    }
    table.note("outside: intervals that do not contain the distance to the input mesh, must be 0");
    table.note("distance: relative error of the interval's middle, where its lower end is above 0, against the stored surface; 99.9 %: of the answers");
    table.note(
        "witness: of the distance to the answer's point, rounded to f32, relative and in diagonals",
    );
    table.note(
        "interval: upper - lower less quantisation, in diagonals; quantisation: twice the surface error",
    );
    Ok(table)
}

/// A distance in f64 may be off by some roundings of the coordinates.
fn contains(lower: f64, upper: f64, truth: f64, point: [f32; 3]) -> bool {
    let slack = 1.0e-14 * (truth + point.iter().map(|x| f64::from(x.abs())).sum::<f64>());
    lower <= truth + slack && truth <= upper + slack
}

/// Triangles of the surface that the blob stores, input units, exact.
fn stored(tree: &Bvh<'_>) -> Result<Vec<[DVec3; 3]>, String> {
    let header = tree.header();
    let unit = 2f64.powi(header.grid_exponent + tree.scale_exponent());
    let mut triangles = Vec::with_capacity(header.triangles as usize);
    for node in 0..header.nodes {
        let links = tree.links(node).ok_or("no links")?;
        for lane in links.inner..links.count {
            let patch = tree.leaf(node, lane).ok_or("no leaf")?;
            let corners = |triangle| patch.corners(triangle).map(|corner| corner.as_dvec3() * unit);
            triangles.extend((0..patch.shape().triangles()).map(corners));
        }
    }
    Ok(triangles)
}
