//! Winding number by solid angles (Van Oosterom & Strackee 1983), in f64.

/// Sum of the solid angles of all triangles as seen from `p`, over 4π; lengths are divided by
/// `unit` first. `None` where the point is too near the surface for f64 to tell, or the sum is no
/// integer.
pub fn winding_number(
    p: [f32; 3],
    positions: &[[f32; 3]],
    triangles: &[[u32; 3]],
    unit: f64,
) -> Option<i32> {
    let from = |v: u32| -> [f64; 3] {
        std::array::from_fn(|k| (f64::from(positions[v as usize][k]) - f64::from(p[k])) / unit)
    };
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let sum: f64 = triangles
        .iter()
        .map(|t| {
            let [a, b, c] = t.map(from);
            let cross =
                [b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]];
            let [la, lb, lc] = [a, b, c].map(|x| dot(x, x).sqrt());
            let below = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
            2.0 * dot(a, cross).atan2(below)
        })
        .sum();
    let number = sum / (4.0 * std::f64::consts::PI);
    ((number - number.round()).abs() < 1e-3).then(|| number.round() as i32)
}

#[cfg(test)]
mod tests {
    use super::winding_number;
    use meshsweep_host_tests::generate::{icosphere, inverted};

    #[test]
    fn one_inside_and_none_outside() {
        let (positions, triangles) = icosphere(2);
        assert_eq!(winding_number([0.1, 0.2, 0.3], &positions, &triangles, 1.0), Some(1));
        assert_eq!(winding_number([1.1, 0.2, 0.3], &positions, &triangles, 1.0), Some(0));
        let (positions, triangles) = inverted(&(positions, triangles));
        assert_eq!(winding_number([0.1, 0.2, 0.3], &positions, &triangles, 1.0), Some(-1));
    }
}
