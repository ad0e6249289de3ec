//! Poses of a second mesh, as quaternions or as matrices.

use crate::args::{Given, MovedArgs, SearchArgs, files};
use crate::failure::Failure;
use crate::output;
use crate::queries::Queries;
use meshsweep_core::Pose;

/// A question about poses, given as `N` numbers each.
pub trait AskPoses {
    fn ask<const N: usize>(
        self,
        poses: Queries<N>,
        pose_of: fn([f32; N]) -> Pose,
    ) -> Result<(), Failure>;
}

/// Refuses an output file that is also read.
pub fn refuse_same_file(input: &MovedArgs, search: &SearchArgs) -> Result<(), Failure> {
    let MovedArgs { first, second, pose, matrix } = input;
    let inputs = [files(&[first, second], pose), files(&[], matrix)].concat();
    output::refuse_same_file(search.output.as_deref(), &inputs)
}

/// Reads the poses and asks about them.
pub fn ask(
    MovedArgs { pose, matrix, .. }: &MovedArgs,
    question: impl AskPoses,
) -> Result<(), Failure> {
    if !matrix.is_empty() {
        return question.ask(Queries::read(matrix)?, of_matrix);
    }
    let as_built = [Given::Query([0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0])];
    let mut poses = Queries::read(if pose.is_empty() { &as_built } else { pose })?;
    if let Some(index) = poses.rows.iter().position(|row| row[3..].iter().all(|&x| x == 0.0)) {
        let failure = Failure::NoRotation { place: poses.place(index) };
        poses.end_at(index, failure)?;
    }
    question.ask(poses, of_quaternion)
}

/// The pose of a translation and a quaternion, which need not have length 1.
fn of_quaternion([x, y, z, qw, qx, qy, qz]: [f32; 7]) -> Pose {
    let q = [qw, qx, qy, qz].map(f64::from);
    let largest = q.iter().fold(0f64, |most, x| most.max(x.abs()));
    let [w, a, b, c] = q.map(|x| x / largest);
    let two = 2.0 / (w * w + a * a + b * b + c * c);
    let rotation = [
        [1.0 - two * (b * b + c * c), two * (a * b - w * c), two * (a * c + w * b)],
        [two * (a * b + w * c), 1.0 - two * (a * a + c * c), two * (b * c - w * a)],
        [two * (a * c - w * b), two * (b * c + w * a), 1.0 - two * (a * a + b * b)],
    ];
    Pose { rotation: rotation.map(|row| row.map(|x| x as f32)), translation: [x, y, z] }
}

/// The pose of a matrix's rows, each with its translation.
fn of_matrix([a, b, c, x, d, e, f, y, g, h, i, z]: [f32; 12]) -> Pose {
    Pose { rotation: [[a, b, c], [d, e, f], [g, h, i]], translation: [x, y, z] }
}
