//! Signed volume of a closed surface, with a bound of its rounding error.

use glam::DVec3;

/// A signed volume and a bound of its rounding error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct SignedVolume {
    pub value: f64,
    pub bound: f64,
}

impl SignedVolume {
    /// The volume that triangles enclose, counter-clockwise seen from outside: in `f64`, relative
    /// to the first corner, so that nothing cancels far from the origin.
    ///
    /// Each of the six products of a determinant carries three differences, two products and three
    /// additions. The sum over triangles is compensated (Neumaier 1974): it carries 2u of itself,
    /// and n·u² for n triangles, which is less than one u. All is relative to the sum of absolute
    /// products. 11 u of that sum bound the error, and 16 ε cover the bound's own rounding too.
    /// Coordinates that are f32 do not over- or underflow.
    pub(crate) fn of(triangles: impl IntoIterator<Item = [DVec3; 3]>) -> Self {
        let mut origin = None;
        let (mut six, mut rest, mut absolute) = (0f64, 0.0, 0.0);
        for triangle in triangles {
            let origin = *origin.get_or_insert(triangle[0]);
            let [a, b, c] = triangle.map(|p| p - origin);
            let product = a.dot(b.cross(c));
            let sum = six + product;
            let (large, small) =
                if six.abs() < product.abs() { (product, six) } else { (six, product) };
            rest += (large - sum) + small;
            six = sum;
            let [a, b, c] = [a, b, c].map(|p| p.abs().to_array());
            for (i, j, k) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
                absolute += a[i] * b[j] * c[k] + a[i] * b[k] * c[j];
            }
        }
        Self { value: (six + rest) / 6.0, bound: 16.0 * f64::EPSILON * absolute / 6.0 }
    }

    /// Certainly below 0.
    pub(crate) fn is_negative(self) -> bool {
        self.value < -self.bound
    }

    /// Rounding cannot tell it from 0.
    pub(crate) fn is_zero(self) -> bool {
        self.value.abs() <= self.bound
    }
}
