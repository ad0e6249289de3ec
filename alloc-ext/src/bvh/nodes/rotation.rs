//! Rotations for the frame search: principal axes and quaternions of 8-bit integers.
//!
//! Only `+ − × ÷ √`, so the same input gives the same frame everywhere.

use super::boxes::IDENTITY;
use glam::{DMat3, DQuat, DVec3, Vec3};
use meshsweep_core::internal::bvh::tree::format::layout::{ROW_BITS, lengthens_nothing};

/// Greatest component of a stored quaternion, in magnitude.
const QUATERNION_MAX: f64 = 127.0;

/// Nearest stored quaternion `(w, x, y, z)` by rounding, with the largest component `±127`; the
/// first component that is not zero is positive.
pub(super) fn round_quaternion(q: DQuat) -> [i8; 4] {
    let components = [q.w, q.x, q.y, q.z];
    let largest = components.iter().fold(0f64, |largest, c| largest.max(c.abs()));
    let rounded = components.map(|c| (c / largest * QUATERNION_MAX).round());
    let sign =
        if rounded.iter().find(|&&c| c != 0.0).is_some_and(|&c| c < 0.0) { -1.0 } else { 1.0 };
    rounded.map(|c| (sign * c) as i8)
}

/// Rotation of a stored quaternion.
pub(super) fn unit_quaternion([w, x, y, z]: [i8; 4]) -> DQuat {
    DQuat::from_xyzw(f64::from(x), f64::from(y), f64::from(z), f64::from(w)).normalize()
}

/// The rotation of a stored quaternion as a node stores it: integers in units of 2^-[`ROW_BITS`],
/// shrunk until they make no vector longer.
///
/// By Gershgorin's theorem no eigenvalue of `M·Mᵀ` is above the greatest sum of the magnitudes of a
/// row.
pub(super) fn stored_rotation(quaternion: [i8; 4]) -> [[i16; 3]; 3] {
    if quaternion[1..] == [0; 3] {
        return IDENTITY;
    }
    let rotation = DMat3::from_quat(unit_quaternion(quaternion));
    let one = 1i32 << ROW_BITS;
    (1..=one)
        .map(|less| {
            let scale = f64::from(one - less);
            [0, 1, 2].map(|k| rotation.row(k).to_array().map(|x| (x * scale).round() as i16))
        })
        .find(lengthens_nothing)
        .expect("the zero matrix lengthens nothing")
}

/// The axes of a frame, as rows of the rotation matrix.
pub(super) fn frame_axes(q: DQuat) -> [Vec3; 3] {
    let rotation = DMat3::from_quat(q);
    [0, 1, 2].map(|k| rotation.row(k).as_vec3())
}

/// Frame whose axes are the principal axes of the points, of greatest spread first; `None` for
/// fewer than two different points.
pub(super) fn principal_frame(points: impl Iterator<Item = DVec3> + Clone) -> Option<DQuat> {
    let (axes, variances) = principal_axes(points)?;
    (variances[0] > 0.0).then(|| {
        let third = axes[0].cross(axes[1]);
        DQuat::from_mat3(&DMat3::from_cols(axes[0], axes[1], third).transpose()).normalize()
    })
}

/// Orthonormal principal axes and the variances along them, greatest first; `None` without points.
pub(super) fn principal_axes(
    points: impl Iterator<Item = DVec3> + Clone,
) -> Option<([DVec3; 3], [f64; 3])> {
    let (count, sum) =
        points.clone().fold((0.0, DVec3::ZERO), |(count, sum), p| (count + 1.0, sum + p));
    if count == 0.0 {
        return None;
    }
    let mean = sum / count;
    let mut covariance = [[0.0; 3]; 3];
    for point in points {
        let d = (point - mean).to_array();
        for (row, &a) in covariance.iter_mut().zip(&d) {
            for (entry, &b) in row.iter_mut().zip(&d) {
                *entry += a * b / count;
            }
        }
    }
    let (vectors, values) = symmetric_eigenvectors(covariance);
    let mut by_spread = [0, 1, 2];
    by_spread.sort_by(|&a, &b| values[b].total_cmp(&values[a]));
    Some((by_spread.map(|k| vectors[k]), by_spread.map(|k| values[k].max(0.0))))
}

/// Eigenvectors and eigenvalues of a symmetric matrix by cyclic Jacobi rotations (Golub and Van
/// Loan, "Matrix computations", section 8.5).
fn symmetric_eigenvectors(mut a: [[f64; 3]; 3]) -> ([DVec3; 3], [f64; 3]) {
    /// Convergence is quadratic: six sweeps reach f64's precision for any 3×3 matrix.
    const SWEEPS: usize = 8;
    let mut v = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0f64]];
    for _ in 0..SWEEPS {
        for (i, j) in [(0, 1), (0, 2), (1, 2)] {
            if a[i][j] == 0.0 {
                continue;
            }
            let theta = (a[j][j] - a[i][i]) / (2.0 * a[i][j]);
            let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
            let c = 1.0 / (t * t + 1.0).sqrt();
            let s = t * c;
            for row in &mut a {
                (row[i], row[j]) = (c * row[i] - s * row[j], s * row[i] + c * row[j]);
            }
            for k in 0..3 {
                (a[i][k], a[j][k]) = (c * a[i][k] - s * a[j][k], s * a[i][k] + c * a[j][k]);
                (v[k][i], v[k][j]) = (c * v[k][i] - s * v[k][j], s * v[k][i] + c * v[k][j]);
            }
        }
    }
    (
        [0, 1, 2].map(|k| DVec3::new(v[0][k], v[1][k], v[2][k]).normalize()),
        [a[0][0], a[1][1], a[2][2]],
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stored_quaternions_have_a_component_of_127() {
        for q in [
            DQuat::IDENTITY,
            DQuat::from_xyzw(0.1, -0.7, 0.2, -0.05),
            DQuat::from_xyzw(-0.5, 0.5, 0.5, -0.5),
        ] {
            let stored = round_quaternion(q.normalize());
            assert_eq!(stored.iter().map(|c| c.unsigned_abs()).max(), Some(127));
            assert!(stored.iter().find(|&&c| c != 0).is_some_and(|&c| c > 0));
            assert!(unit_quaternion(stored).dot(q.normalize()).abs() > 0.9999);
        }
    }

    #[test]
    fn principal_axes_follow_the_spread() {
        let q = DQuat::from_xyzw(0.3, -0.2, 0.5, 0.7).normalize();
        let points: Vec<DVec3> = (0..64)
            .map(|i| {
                q * DVec3::new(
                    f64::from(i % 4) * 100.0,
                    f64::from(i / 4 % 4) * 10.0,
                    f64::from(i / 16),
                )
            })
            .collect();
        let (axes, variances) = principal_axes(points.iter().copied()).unwrap();
        for (axis, expected) in axes.iter().zip([DVec3::X, DVec3::Y, DVec3::Z]) {
            assert!(axis.dot(q * expected).abs() > 1.0 - 1e-9);
        }
        assert!(variances[0] > variances[1] && variances[1] > variances[2]);
        let frame = frame_axes(principal_frame(points.iter().copied()).unwrap());
        assert!(frame[0].as_dvec3().dot(axes[0]) > 1.0 - 1e-6);
    }

    #[test]
    fn equal_points_have_no_principal_frame() {
        assert!(principal_frame([DVec3::ONE; 5].into_iter()).is_none());
        assert!(principal_frame([].into_iter()).is_none());
    }
}
