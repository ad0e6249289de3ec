//! The error figure of Crosnier & Rossignac 1999, formula (10): the distance by which a tribox
//! reaches beyond the convex hull of its part of the mesh.

use super::cell::Cell;
use super::span::Frame;
use glam::DVec3;
use meshsweep_core::Tribox;

/// Relative error of the result, upward.
const SLACK: f64 = 0.01;

/// Most steps towards the closest point of a hull. The result after them is an upper bound as well.
const STEPS: usize = 200;

/// Greatest distance of a vertex of `proxy` from the convex hull of the cell's part: an upper
/// bound, at most 1 % too great where the descent converged.
///
/// Gilbert's descent runs for each vertex that may be farther than those before.
///
/// Cost: a few passes over the cell's corners.
pub(super) fn excess(proxy: &Tribox, cell: &Cell) -> f64 {
    let corners = cell.polygons.corners.iter().map(|corner| corner.at);
    let mut points: Vec<[f64; 3]> = corners.chain(cell.inner.iter().copied()).collect();
    // Six triangles share a vertex.
    points.sort_unstable_by(|a, b| {
        a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])).then(a[2].total_cmp(&b[2]))
    });
    points.dedup();
    let points: Vec<DVec3> = points.into_iter().map(DVec3::from).collect();
    let Some(&first) = points.first() else { return 0.0 };
    let centre = points.iter().sum::<DVec3>() / points.len() as f64;
    let farthest = |along: DVec3| {
        let most = points.iter().fold((f64::NEG_INFINITY, first), |most, &p| {
            let here = along.dot(p);
            if here > most.0 { (here, p) } else { most }
        });
        most.1
    };
    let mut most = 0f64;
    for vertex in Frame::of(proxy).vertices {
        let vertex = DVec3::from(vertex);
        let mut near = farthest(vertex - centre);
        let mut upper = (vertex - near).length();
        for _ in 0..STEPS {
            let away = vertex - near;
            upper = upper.min(away.length());
            if upper <= most {
                break;
            }
            let support = farthest(away);
            let lower = away.dot(vertex - support) / away.length();
            if upper - lower <= SLACK * upper {
                break;
            }
            let way = support - near;
            let t = away.dot(way) / way.length_squared();
            if t <= 0.0 || t.is_nan() {
                break;
            }
            near += way * t.min(1.0);
        }
        most = most.max(upper);
    }
    most
}
