//! Exact test for zero area.

use robust::{Coord, orient2d};

/// True if the three points lie on one line (or coincide), decided exactly: a triangle has zero
/// area if and only if its projections along all three axes have.
pub(crate) fn collinear(a: [f32; 3], b: [f32; 3], c: [f32; 3]) -> bool {
    [(0, 1), (1, 2), (2, 0)].iter().all(|&(i, j)| {
        let p = |v: [f32; 3]| Coord { x: v[i], y: v[j] };
        orient2d(p(a), p(b), p(c)) == 0.0
    })
}

/// Of three distinct collinear points, which lies strictly between the other two: 0, 1 or 2.
///
/// Along a line the coordinates order as the points do, on any axis on which they differ.
pub(super) fn middle(corners: [[f32; 3]; 3]) -> usize {
    let [a, b, c] = corners;
    for axis in 0..3 {
        let (x, y, z) = (a[axis], b[axis], c[axis]);
        if x != y || y != z {
            let between = |m: f32, p: f32, q: f32| (p < m && m < q) || (q < m && m < p);
            return if between(x, y, z) {
                0
            } else if between(y, x, z) {
                1
            } else {
                2
            };
        }
    }
    2
}
