//! From `f64` to `f32` positions, with a bound of the distance moved.

use super::{MeshError, RawMesh};

/// Rounds every place of a mesh's vertices to the nearest `f32` and turns −0.0 into 0.0, so that
/// equal positions have equal bits. Returns the positions and
/// [`Mesh::rounding`](super::Mesh::rounding).
///
/// # Errors
/// A coordinate beyond the largest `f32`; a mesh none of whose coordinates reaches the smallest
/// normal `f32`, because its shape would be lost to underflow. (All coordinates zero is a mesh
/// without area, refused later as such.)
pub(super) fn round(raw: &RawMesh, places: &[[f64; 3]]) -> Result<(Vec<[f32; 3]>, f64), MeshError> {
    let mut largest = 0.0f64;
    let mut moved = 0.0f64;
    let mut positions = Vec::with_capacity(places.len());
    for (vertex, at) in places.iter().enumerate() {
        // Adding 0.0 turns −0.0 into 0.0 and changes nothing else.
        let rounded = at.map(|x| x as f32 + 0.0);
        if !rounded.iter().all(|x| x.is_finite()) {
            return Err(MeshError::TooLarge { file: raw.file.clone(), vertex, at: *at });
        }
        largest = at.iter().fold(largest, |m, x| m.max(x.abs()));
        moved = moved.max(distance_up(*at, rounded.map(f64::from)));
        positions.push(rounded);
    }
    if largest > 0.0 && largest < f64::from(f32::MIN_POSITIVE) {
        return Err(MeshError::TooSmall { file: raw.file.clone(), largest });
    }
    if raw.decimal && moved > 0.0 {
        // The decimal itself was rounded to f64 first: half a unit in the last place on each of
        // three axes.
        moved = ((moved + 2.0 * f64::EPSILON * largest) * (1.0 + 4.0 * f64::EPSILON)).next_up();
    }
    if raw.error > 0.0 {
        moved = (moved + raw.error).next_up();
    }
    Ok((positions, moved))
}

/// The distance of `a` and `b`, rounded up; exactly 0 if they are equal.
///
/// `a − b` is exact on each axis, since `b` is `a` rounded to fewer bits. Dividing by the largest
/// keeps the squares from underflow; what follows is six roundings, each of relative size 2⁻⁵³ at
/// most, which 8ε covers.
fn distance_up(a: [f64; 3], b: [f64; 3]) -> f64 {
    let d = [a[0] - b[0], a[1] - b[1], a[2] - b[2]].map(f64::abs);
    let most = d[0].max(d[1]).max(d[2]);
    if most == 0.0 {
        return 0.0;
    }
    let sum: f64 = d.iter().map(|x| (x / most) * (x / most)).sum();
    (most * sum.sqrt() * (1.0 + 8.0 * f64::EPSILON)).next_up()
}
