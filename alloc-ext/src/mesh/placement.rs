//! Where a file puts a copy of a mesh: an affine transform, with a bound of its rounding.

/// An affine transform of points, in `f64`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Placement {
    /// `x` becomes `rows · (x, 1)`.
    rows: [[f64; 4]; 3],
    /// The same with the magnitudes of all that was added up.
    bounds: [[f64; 4]; 3],
    /// Roundings on the way to an entry of `rows`, at most.
    roundings: f64,
    is_identity: bool,
}

impl Placement {
    pub(crate) const IDENTITY: Self =
        Self { rows: IDENTITY, bounds: IDENTITY, roundings: 0.0, is_identity: true };

    /// A transform by entries that were rounded once, from decimals.
    pub(super) fn of_rows(rows: [[f64; 4]; 3]) -> Self {
        let bounds = rows.map(|row| row.map(f64::abs));
        Self { rows, bounds, roundings: 1.0, is_identity: rows == IDENTITY }
    }

    /// A translation after a rotation by a quaternion (x, y, z, w) after a scaling.
    pub(super) fn of_parts(translation: [f64; 3], [x, y, z, w]: [f64; 4], scale: [f64; 3]) -> Self {
        let [xx, yy, zz] = [x * x, y * y, z * z];
        let turn = [
            [1.0 - 2.0 * (yy + zz), 2.0 * (x * y - z * w), 2.0 * (x * z + y * w)],
            [2.0 * (x * y + z * w), 1.0 - 2.0 * (xx + zz), 2.0 * (y * z - x * w)],
            [2.0 * (x * z - y * w), 2.0 * (y * z + x * w), 1.0 - 2.0 * (xx + yy)],
        ];
        // The same with the magnitudes of all terms.
        let [xy, xz, yz] = [x * y, x * z, y * z].map(f64::abs);
        let [xw, yw, zw] = [x * w, y * w, z * w].map(f64::abs);
        let size = [
            [1.0 + 2.0 * (yy + zz), 2.0 * (xy + zw), 2.0 * (xz + yw)],
            [2.0 * (xy + zw), 1.0 + 2.0 * (xx + zz), 2.0 * (yz + xw)],
            [2.0 * (xz + yw), 2.0 * (yz + xw), 1.0 + 2.0 * (xx + yy)],
        ];
        let rows = [0, 1, 2].map(|i| {
            let [a, b, c] = [0, 1, 2].map(|j| turn[i][j] * scale[j]);
            [a, b, c, translation[i]]
        });
        let bounds = [0, 1, 2].map(|i| {
            let [a, b, c] = [0, 1, 2].map(|j| size[i][j] * scale[j].abs());
            [a, b, c, translation[i].abs()]
        });
        // Two decimals, their product, a sum, another of 1, and the scale's decimal and product.
        Self { rows, bounds, roundings: 8.0, is_identity: rows == IDENTITY }
    }

    /// A rotation about an axis through the origin; none if the axis has no length. Quarter turns
    /// about the frame's axes are exact.
    pub(super) fn of_rotation(axis: [f64; 3], degrees: f64) -> Option<Self> {
        // Exact.
        let degrees = degrees % 360.0;
        if degrees == 0.0 {
            return Some(Self::IDENTITY);
        }
        let length = axis.iter().fold(0f64, |length, &x| length.hypot(x));
        if length == 0.0 || !length.is_finite() {
            return None;
        }
        let [x, y, z] = axis.map(|x| x / length);
        let quarters = [90.0, 180.0, 270.0].map(|turn| degrees == turn || degrees == turn - 360.0);
        let angle = degrees.to_radians();
        let (sin, cos) = match quarters {
            [true, ..] => (1.0, 0.0),
            [_, true, _] => (0.0, -1.0),
            [.., true] => (-1.0, 0.0),
            _ => angle.sin_cos(),
        };
        let rest = 1.0 - cos;
        let rows = [
            [cos + rest * x * x, rest * x * y - sin * z, rest * x * z + sin * y, 0.0],
            [rest * y * x + sin * z, cos + rest * y * y, rest * y * z - sin * x, 0.0],
            [rest * z * x - sin * y, rest * z * y + sin * x, cos + rest * z * z, 0.0],
        ];
        let is_exact = quarters.contains(&true) && axis.iter().filter(|&&x| x != 0.0).count() == 1;
        // The terms of an entry are at most 2, and the angle's rounding turns as much as the angle.
        let bound = if is_exact { 1.0 } else { 2.0 + angle.abs() };
        let bounds = [[bound, bound, bound, 0.0]; 3];
        // Five of a component of the axis, twice; those of the sine and of the sums.
        let roundings = if is_exact { 0.0 } else { 24.0 };
        Some(Self { rows, bounds, roundings, is_identity: false })
    }

    /// An origin of a robot's description: turns about the fixed axes x, y and z, in radians, and
    /// then a shift.
    pub(crate) fn of_origin(shift: [f64; 3], turns: [f64; 3]) -> Self {
        let mut rows = IDENTITY;
        rows.iter_mut().zip(shift).for_each(|(row, x)| row[3] = x);
        let shifted = Self::of_rows(rows);
        let turned = [0, 1, 2].into_iter().zip(turns).map(|(axis, turn)| Self::of_turn(axis, turn));
        shifted.after(&turned.fold(Self::IDENTITY, |inner, turn| turn.after(&inner)))
    }

    /// A scaling along each axis, which comes first.
    pub(crate) fn of_scale([x, y, z]: [f64; 3]) -> Self {
        Self::of_rows([[x, 0.0, 0.0, 0.0], [0.0, y, 0.0, 0.0], [0.0, 0.0, z, 0.0]])
    }

    /// A turn about one of the frame's axes, in radians.
    fn of_turn(axis: usize, angle: f64) -> Self {
        if angle == 0.0 {
            return Self::IDENTITY;
        }
        let (sin, cos) = angle.sin_cos();
        let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
        let (mut rows, mut bounds) = (IDENTITY, IDENTITY);
        // The angle's rounding turns as much as the angle.
        for (row, column, x) in
            [(next, next, cos), (next, last, -sin), (last, next, sin), (last, last, cos)]
        {
            rows[row][column] = x;
            bounds[row][column] = 1.0 + angle.abs();
        }
        // The decimal, and the sine within two units in its last place.
        Self { rows, bounds, roundings: 5.0, is_identity: false }
    }

    /// Rotation and shift rounded to f32, and how far each is from the exact one at most.
    pub(crate) fn rounded(&self) -> ([[f32; 3]; 3], [f32; 3], [f64; 2]) {
        let nearest = self.rows.map(|row| row.map(|x| x as f32));
        let half_units = if self.is_identity { 0.0 } else { 1.5 * (self.roundings + 2.0) };
        let off = |row: usize, k: usize| {
            let exact = self.rows[row][k];
            // A 1 of the identity. A bound of 0 is a sum of nothing.
            let is_one = k < 3 && exact == 1.0 && self.bounds[row][k] == 1.0;
            let half_units = if is_one { 0.0 } else { half_units };
            let own = self.bounds[row][k] * (half_units * 0.5 * f64::EPSILON);
            (f64::from(nearest[row][k]) - exact).abs() + own
        };
        let all = |columns: std::ops::Range<usize>| {
            let entries = (0..3).flat_map(|row| columns.clone().map(move |k| (row, k)));
            entries.map(|(row, k)| off(row, k).powi(2)).sum::<f64>().sqrt() * (1.0 + 1e-12)
        };
        let errors = [all(0..3), all(3..4)];
        (nearest.map(|[x, y, z, _]| [x, y, z]), nearest.map(|[.., shift]| shift), errors)
    }

    /// No length grows by more than this factor.
    pub(super) fn stretch(&self) -> f64 {
        let squares = self.rows.iter().flat_map(|[x, y, z, _]| [x, y, z]).map(|x| x * x);
        squares.sum::<f64>().sqrt() * (1.0 + 1e-9)
    }

    /// `self` after `inner`.
    pub(crate) fn after(&self, inner: &Self) -> Self {
        if self.is_identity {
            return inner.clone();
        }
        if inner.is_identity {
            return self.clone();
        }
        Self {
            rows: product(&self.rows, &inner.rows),
            bounds: product(&self.bounds, &inner.bounds),
            // Four of the sum, one of the product.
            roundings: self.roundings + inner.roundings + 5.0,
            is_identity: false,
        }
    }

    /// Whether it turns meshes inside out.
    pub(super) fn mirrors(&self) -> bool {
        let [a, b, c] = self.rows.map(|[x, y, z, _]| [x, y, z]);
        let minor = |i: usize, j: usize| b[i] * c[j] - b[j] * c[i];
        a[0] * minor(1, 2) - a[1] * minor(0, 2) + a[2] * minor(0, 1) < 0.0
    }

    /// A point where it is put, and a bound of its distance from the exact place. The point's own
    /// coordinates may be off by half a unit in the last place.
    pub(super) fn put(&self, at: [f64; 3]) -> ([f64; 3], f64) {
        if self.is_identity {
            return (at, 0.0);
        }
        let [x, y, z] = at;
        let sum = |[a, b, c, d]: [f64; 4], [x, y, z]: [f64; 3]| a * x + b * y + c * z + d;
        let size: f64 = self.bounds.map(|row| sum(row, at.map(f64::abs))).iter().sum();
        // n roundings are an error of n half-units; half as much again covers their products and
        // the roundings of `bounds` itself. The least number stands for underflow.
        let half_units = 1.5 * (self.roundings + 6.0);
        let error = size * (half_units * 0.5 * f64::EPSILON) + f64::MIN_POSITIVE;
        (self.rows.map(|row| sum(row, [x, y, z])), error.next_up())
    }
}

const IDENTITY: [[f64; 4]; 3] = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];

/// The product of two transforms whose last row is 0, 0, 0, 1.
fn product(a: &[[f64; 4]; 3], b: &[[f64; 4]; 3]) -> [[f64; 4]; 3] {
    a.map(|row| {
        [0, 1, 2, 3].map(|j| {
            let last = if j == 3 { row[3] } else { 0.0 };
            row[0] * b[0][j] + row[1] * b[1][j] + row[2] * b[2][j] + last
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rotations_translations_and_mirrors_put_points_where_the_formula_says() {
        let half = 0.5f64.sqrt();
        // A quarter turn about z, after doubling x, before a step along x.
        let turned = Placement::of_parts([5.0, 0.0, 0.0], [0.0, 0.0, half, half], [2.0, 1.0, 1.0]);
        let (at, error) = turned.put([1.0, 0.0, 7.0]);
        let off = at.iter().zip([5.0, 2.0, 7.0]).map(|(a, b)| (a - b).abs()).sum::<f64>();
        assert!(off <= error && error < 1e-13, "{at:?} {off} {error}");
        let mirror = Placement::of_parts([0.0; 3], [0.0, 0.0, 0.0, 1.0], [-1.0, 1.0, 1.0]);
        assert!(mirror.mirrors() && !turned.mirrors() && !mirror.after(&mirror).mirrors());
        assert_eq!(mirror.after(&turned).put([1.0, 0.0, 7.0]).0[0], -at[0]);
        assert_eq!(Placement::IDENTITY.put([0.1, 0.2, 0.3]), ([0.1, 0.2, 0.3], 0.0));
    }

    #[test]
    fn rotations_about_axes_are_rodrigues_and_quarter_turns_are_exact() {
        let turned = |axis, degrees, at| Placement::of_rotation(axis, degrees).unwrap().put(at).0;
        assert_eq!(turned([1.0, 0.0, 0.0], 90.0, [1.0, 2.0, 3.0]), [1.0, -3.0, 2.0]);
        assert_eq!(turned([0.0, 0.0, 2.0], -450.0, [1.0, 2.0, 3.0]), [2.0, -1.0, 3.0]);
        assert_eq!(turned([0.0, -1.0, 0.0], 180.0, [1.0, 2.0, 3.0]), [-1.0, 2.0, -3.0]);
        // A third of a turn about the diagonal permutes the axes.
        let third = Placement::of_rotation([5.0, 5.0, 5.0], 120.0).unwrap();
        let (at, error) = third.put([1.0, 2.0, 3.0]);
        let off = at.iter().zip([3.0, 1.0, 2.0]).map(|(a, b)| (a - b).abs()).sum::<f64>();
        assert!(off <= error && error < 1e-12, "{at:?} {error:e}");
        assert!(Placement::of_rotation([0.0; 3], 1.0).is_none());
        assert_eq!(Placement::of_rotation([0.0; 3], 360.0), Some(Placement::IDENTITY));
    }

    #[test]
    fn origins_turn_about_fixed_axes_in_the_order_x_y_z_and_rounding_tells_its_size() {
        let quarter = std::f64::consts::FRAC_PI_2;
        let origin = Placement::of_origin([1.0, 2.0, 3.0], [quarter, 0.0, quarter]);
        // About x: (0, 0, 1) to (0, -1, 0); about z: to (1, 0, 0).
        let (at, error) = origin.put([0.0, 0.0, 1.0]);
        let off = at.iter().zip([2.0, 2.0, 3.0]).map(|(a, b)| (a - b).abs()).sum::<f64>();
        assert!(off <= error && error < 1e-13, "{at:?}");
        let (rows, shift, [turn, moved]) = origin.rounded();
        assert_eq!((rows[0][2], shift, moved < 1e-13), (1.0, [1.0, 2.0, 3.0], true));
        assert!(turn > 0.0 && turn < 1e-7);
        assert_eq!(Placement::IDENTITY.rounded().2, [0.0; 2]);
        let (.., [turn, moved]) = Placement::of_origin([0.1, 0.0, 0.0], [0.0; 3]).rounded();
        assert!(turn == 0.0 && moved > 1e-9 && moved < 1e-8);
    }

    #[test]
    fn the_error_of_a_chain_bounds_its_distance_from_exact_numbers() {
        // Thirds are no f64. Three steps of x / 3 + 1 / 3 from 3 come to 40 / 81 + 1 / 9 exactly.
        let third = 1.0 / 3.0;
        let mut rows = IDENTITY;
        rows[0] = [third, 0.0, 0.0, third];
        let step = Placement::of_rows(rows);
        let (at, error) = step.after(&step).after(&step).put([3.0, 0.0, 0.0]);
        // 3/27 + 1/27 + 1/9 + 1/3 = 16/27.
        let off = (at[0] * 27.0 - 16.0).abs() / 27.0;
        assert!(off <= error && error < 1e-14, "{off} {error}");
    }
}
