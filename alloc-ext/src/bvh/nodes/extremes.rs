//! Extreme points of a set, which replace the set in the frame search. Their directions are spread
//! evenly over the set's own shape.

use super::rotation::principal_axes;
use glam::DVec3;

/// Least spread for which directions are stretched, relative to the greatest. Flatter sets would
/// spend all directions on noise.
const LEAST_ASPECT: f64 = 1e-3;

/// The points themselves if there are at most `limit`, else the extreme ones in `limit / 2`
/// directions and their opposites, each once.
///
/// Directions are spread evenly over the sphere after the set has been scaled to equal variance
/// along its principal axes, so that the thickness of a flat leaf is sampled as well as its
/// outline. Order and choice are deterministic. Cost: O(points · limit).
pub(super) fn extreme_points(points: &[DVec3], limit: usize) -> Vec<DVec3> {
    if points.len() <= limit {
        return points.to_vec();
    }
    let Some((axes, variances)) = principal_axes(points.iter().copied()) else { return Vec::new() };
    let floor = variances[0].sqrt() * LEAST_ASPECT;
    let mut chosen: Vec<usize> = Vec::with_capacity(limit);
    for rank in 0..limit / 2 {
        let even = even_direction(rank, limit / 2);
        let direction: DVec3 =
            (0..3).map(|k| axes[k] * (even[k] / variances[k].sqrt().max(floor))).sum();
        let (mut low, mut high) = ((f64::INFINITY, 0), (f64::NEG_INFINITY, 0));
        for (index, point) in points.iter().enumerate() {
            let q = direction.dot(*point);
            low = if q < low.0 { (q, index) } else { low };
            high = if q > high.0 { (q, index) } else { high };
        }
        chosen.extend([low.1, high.1]);
    }
    chosen.sort_unstable();
    chosen.dedup();
    chosen.into_iter().map(|index| points[index]).collect()
}

/// `rank`-th of `count` directions spread evenly over the half-sphere `z > 0` by the golden ratio,
/// on a square spiral that needs no sine.
fn even_direction(rank: usize, count: usize) -> DVec3 {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let z = 1.0 - (rank as f64 + 0.5) / count as f64;
    let turn = (rank as f64 * GOLDEN).fract() * 4.0;
    let side = turn.floor();
    // A point on the unit square's outline, normalised: close to even in angle (within a factor of
    // two), exact in sign symmetry.
    let along = (turn - side) * 2.0 - 1.0;
    let (x, y) = match side as u32 {
        0 => (1.0, along),
        1 => (-along, 1.0),
        2 => (-1.0, -along),
        _ => (along, -1.0),
    };
    let radius = (1.0 - z * z).sqrt() / (x * x + y * y).sqrt();
    DVec3::new(x * radius, y * radius, z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::SplitMix;

    #[test]
    fn few_points_are_all_kept() {
        let points = [DVec3::ONE, DVec3::ONE, DVec3::X];
        assert_eq!(extreme_points(&points, 3), points);
        assert!(extreme_points(&[], 3).is_empty());
    }

    #[test]
    fn directions_are_unit_and_spread() {
        let directions: Vec<DVec3> = (0..24).map(|rank| even_direction(rank, 24)).collect();
        for (index, a) in directions.iter().enumerate() {
            assert!((a.length() - 1.0).abs() < 1e-12);
            for b in &directions[..index] {
                assert!(a.dot(*b).abs() < 0.995, "{a} {b}");
            }
        }
    }

    #[test]
    fn thickness_of_a_flat_patch_survives() {
        let mut noise = SplitMix::new(5);
        let points: Vec<DVec3> = (0..2000)
            .map(|_| noise.point(DVec3::ZERO, DVec3::new(1000.0, 800.0, 6.0)))
            .map(|p| DVec3::new(0.6 * p.x - 0.8 * p.z, p.y, 0.8 * p.x + 0.6 * p.z))
            .collect();
        let normal = DVec3::new(-0.8, 0.0, 0.6);
        let thickness = |set: &[DVec3]| {
            let along = set.iter().map(|p| p.dot(normal));
            along.clone().fold(f64::NEG_INFINITY, f64::max) - along.fold(f64::INFINITY, f64::min)
        };
        let few = extreme_points(&points, 48);
        assert!(few.len() <= 48);
        assert!(thickness(&few) > 0.9 * thickness(&points));
    }

    #[test]
    fn equal_points_are_reduced_to_one() {
        assert_eq!(extreme_points(&[DVec3::ONE; 100], 48), [DVec3::ONE]);
    }
}
