//! Winding number by solid angles (Van Oosterom & Strackee 1983), in f64.

use meshsweep::check::vector::{cross, dot};

/// Sum of the solid angles of all triangles as seen from `p`, over 4π: an integer for a closed
/// surface, but for rounding. Lengths are divided by `unit` first. Next to the surface f64 cannot
/// tell.
#[must_use]
pub fn winding_number(
    p: [f64; 3],
    positions: &[[f32; 3]],
    triangles: &[[u32; 3]],
    unit: f64,
) -> f64 {
    let from = |v: u32| [0, 1, 2].map(|k| (f64::from(positions[v as usize][k]) - p[k]) / unit);
    let half_angle = |t: &[u32; 3]| {
        let [a, b, c] = t.map(from);
        let [la, lb, lc] = [a, b, c].map(|x| dot(&x, &x).sqrt());
        let below = la * lb * lc + dot(&a, &b) * lc + dot(&b, &c) * la + dot(&c, &a) * lb;
        dot(&a, &cross(&b, &c)).atan2(below)
    };
    triangles.iter().map(half_angle).sum::<f64>() / (2.0 * std::f64::consts::PI)
}

#[cfg(test)]
mod tests {
    use super::winding_number;
    use crate::generate::{icosphere, inverted};

    #[test]
    fn one_inside_and_none_outside() {
        let sphere = icosphere(2);
        for ((positions, triangles), p, number) in [
            (sphere.clone(), [0.1, 0.2, 0.3], 1.0),
            (sphere.clone(), [1.1, 0.2, 0.3], 0.0),
            (inverted(&sphere), [0.1, 0.2, 0.3], -1.0),
        ] {
            assert!((winding_number(p, &positions, &triangles, 1.0) - number).abs() < 1e-12);
        }
    }
}
