//! Points within triangles that are exact in `f64`.

/// Points of the triangles that are none of their corners: in the middle of an edge or of a median.
/// A point lies exactly on its triangle. Those are left out whose coordinates `f64` cannot hold.
///
/// Few are left only if coordinates differ by a factor of 2^28 or more.
pub(crate) fn inner_points(
    triangles: impl IntoIterator<Item = [[f32; 3]; 3]>,
) -> impl Iterator<Item = [f64; 3]> {
    triangles.into_iter().flat_map(|[a, b, c]| {
        let middles = |[a, b, c]: [[f32; 3]; 3]| {
            let edge = middle(a.map(f64::from), b.map(f64::from));
            let median = edge.and_then(|edge| middle(edge, c.map(f64::from)));
            median.into_iter().chain(edge)
        };
        [[a, b, c], [b, c, a], [c, a, b]].into_iter().flat_map(middles)
    })
}

/// The middle of two points, if it is exact.
fn middle(a: [f64; 3], b: [f64; 3]) -> Option<[f64; 3]> {
    let mut middle = [0.0; 3];
    for axis in 0..3 {
        let (a, b) = (a[axis], b[axis]);
        let sum = a + b;
        let of_b = sum - a;
        // The rounding of the sum (Knuth, TAOCP 4.2.2).
        if (a - (sum - of_b)) + (b - of_b) != 0.0 {
            return None;
        }
        // Halves of `f32` numbers' sums are far from the least number.
        middle[axis] = 0.5 * sum;
    }
    Some(middle)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inner_points_are_exact_or_left_out() {
        let plain = [[0.0, 0.0, 1.0], [3.0, 0.0, 1.0], [0.0, 5.0, 2.0f32]];
        let points: Vec<_> = inner_points([plain]).collect();
        assert_eq!(points.len(), 6);
        assert_eq!(points[..2], [[0.75, 2.5, 1.5], [1.5, 0.0, 1.0]]);
        let mixed = [[1e-30, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0f32]];
        let points: Vec<_> = inner_points([mixed]).collect();
        // Two edges meet at the tiny coordinate; beside 0 it is exact.
        assert!(points.len() < 6 && points.contains(&[0.5, 0.5, 0.0]));
    }
}
