//! Poses as files and people write them.

use meshsweep_core::Pose;

/// The rows of a matrix, each with its translation, from a translation and a quaternion whose real
/// part comes first. The quaternion needs no length of 1. Computed in f64, so that quarter turns
/// are exact.
#[must_use]
pub fn of_quaternion([x, y, z, qw, qx, qy, qz]: [f32; 7]) -> [f32; 12] {
    let q = [qw, qx, qy, qz].map(f64::from);
    let largest = q.iter().fold(0f64, |most, x| most.max(x.abs()));
    let [w, a, b, c] = q.map(|x| x / largest);
    let two = 2.0 / (w * w + a * a + b * b + c * c);
    let [[a, b, c], [d, e, f], [g, h, i]] = [
        [1.0 - two * (b * b + c * c), two * (a * b - w * c), two * (a * c + w * b)],
        [two * (a * b + w * c), 1.0 - two * (a * a + c * c), two * (b * c - w * a)],
        [two * (a * c - w * b), two * (b * c + w * a), 1.0 - two * (a * a + b * b)],
    ]
    .map(|row| row.map(|x| x as f32));
    [a, b, c, x, d, e, f, y, g, h, i, z]
}

/// The pose of a matrix's rows, each with its translation. A file may hold any matrix.
#[must_use]
pub fn of_row([a, b, c, x, d, e, f, y, g, h, i, z]: [f32; 12]) -> Pose {
    Pose::affine([[a, b, c], [d, e, f], [g, h, i]], [x, y, z])
}
