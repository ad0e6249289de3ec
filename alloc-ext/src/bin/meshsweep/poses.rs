//! Poses of a second mesh, as quaternions or as matrices.

use crate::args::{Given, MovedArgs, SearchArgs, files};
use crate::failure::Failure;
use crate::output;
use crate::queries::Queries;
use meshsweep::number::Short;
pub use meshsweep::pose::{of_quaternion, of_row};
use meshsweep_core::Pose;
use meshsweep_core::internal::num::tolerance::RIGID;

/// Refuses an output file that is also read.
pub fn refuse_same_file(input: &MovedArgs, search: &SearchArgs) -> Result<(), Failure> {
    let MovedArgs { first, second, pose, matrix } = input;
    let inputs = [files(&[first, second], pose), files(&[], matrix)].concat();
    output::refuse_same_file(search.output.as_deref(), &inputs)
}

/// Reads the poses: rows of matrices, each with its translation.
pub fn read(MovedArgs { pose, matrix, .. }: &MovedArgs) -> Result<Queries<12>, Failure> {
    if !matrix.is_empty() {
        let mut poses = Queries::read(matrix)?;
        if let Some((index, fault)) = first_fault(&poses.rows) {
            let failure = Failure::Matrix { place: poses.place(index), fault };
            poses.end_at(index, failure)?;
        }
        return Ok(poses);
    }
    let as_built = [Given::Query([0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0])];
    let mut poses = Queries::read(if pose.is_empty() { &as_built } else { pose })?;
    if let Some(index) = poses.rows.iter().position(|row| row[3..].iter().all(|&x| x == 0.0)) {
        let failure = Failure::NoRotation { place: poses.place(index) };
        poses.end_at(index, failure)?;
    }
    Ok(poses.map(of_quaternion))
}

/// The first matrix that has an entry beyond 2, and which entry.
fn first_fault(rows: &[[f32; 12]]) -> Option<(usize, String)> {
    rows.iter().enumerate().find_map(|(index, numbers)| {
        let at = (0..12).find(|at| at % 4 < 3 && numbers[*at].abs() > 2.0)?;
        let (row, column, entry) = (at / 4 + 1, at % 4 + 1, Short(numbers[at]));
        Some((index, format!("entry {column} of row {row} is {entry}, beyond 2")))
    })
}

/// Why a matrix begins no screw: which rows are not those of a rotation, if they are not.
pub fn no_rotation(pose: &Pose) -> Option<String> {
    let rows = pose.rotation.map(|row| row.map(f64::from));
    let dot = |a: usize, b: usize| -> f64 { (0..3).map(|k| rows[a][k] * rows[b][k]).sum() };
    // As `Motion::screw` demands, but for its rounding: the largest part of a sum that is too
    // large.
    let excess = |a: usize, b: usize| (dot(a, b) - f64::from(u8::from(a == b))).abs();
    let most = (0..3).map(|a| (0..3).map(|b| excess(a, b)).sum()).fold(0.0, f64::max);
    let limit = if most > f64::from(RIGID) { most / 3.0 } else { f64::INFINITY };
    let long = (0..3).find(|&row| excess(row, row) >= limit);
    let skew = [(0, 1), (1, 2), (0, 2)].into_iter().find(|&(a, b)| excess(a, b) >= limit);
    let [a, b, c] = rows.map(glam::DVec3::from);
    if let Some(row) = long {
        let length = dot(row, row).sqrt();
        Some(format!("row {} has length {length:.4}, and a screw needs 1", row + 1))
    } else if let Some((a, b)) = skew {
        let cosine = dot(a, b);
        let (a, b) = (a + 1, b + 1);
        Some(format!("rows {a} and {b} are not at right angles: their product is {cosine:.4}"))
    } else {
        let is_mirror = a.dot(b.cross(c)) <= 0.0;
        is_mirror.then(|| "the matrix is a mirror, and a screw needs a rotation".to_owned())
    }
}
