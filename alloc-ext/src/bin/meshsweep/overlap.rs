//! `meshsweep overlap`: poses of a second mesh in, whether it meets the first one out.

use crate::args::{Engine, Given, OverlapArgs, files};
use crate::ask::{self, Answer, Question, write_end};
use crate::failure::Failure;
use crate::output::refuse_same_file;
use crate::queries::Queries;
use crate::served::Both;
use crate::{blob_file, served};
use meshsweep_core::{Ended, Pose, TrianglePair, Verdict, Work};
use std::io::{self, Write};

// Words of the column `contact`.
const APART: &str = "apart";
const MEETS: &str = "meets";
const UNDECIDED: &str = "undecided";

/// Pairs that fit the buffer at first.
const PAIRS: usize = 256;

pub fn run(args: &OverlapArgs) -> Result<(), Failure> {
    let OverlapArgs { first, second, pose, matrix, search, .. } = args;
    let inputs = [files(&[first, second], pose), files(&[], matrix)].concat();
    refuse_same_file(search.output.as_deref(), &inputs)?;
    let blobs = [blob_file::open(first)?, blob_file::open(second)?];
    let tree_chosen = args.engine.map(|engine| engine == Engine::Tree);
    let models = served::choose_both([first, second], &blobs, tree_chosen)?;
    if !matrix.is_empty() {
        return ask_poses(args, models, Queries::read(matrix)?, of_matrix);
    }
    let as_built = [Given::Query([0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0])];
    let mut poses = Queries::read(if pose.is_empty() { &as_built } else { pose })?;
    if let Some(index) = poses.rows.iter().position(|row| row[3..].iter().all(|&x| x == 0.0)) {
        let failure = Failure::NoRotation { place: poses.place(index) };
        poses.end_at(index, failure)?;
    }
    ask_poses(args, models, poses, of_quaternion)
}

fn ask_poses<const N: usize>(
    args: &OverlapArgs,
    models: Both<'_>,
    poses: Queries<N>,
    pose_of: fn([f32; N]) -> Pose,
) -> Result<(), Failure> {
    let question = Question::new("pose,contact,first,second,work", poses, &args.search);
    if args.all {
        ask_all(args, models, question, pose_of)
    } else {
        ask_any(args, models, question, pose_of)
    }
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

/// Asks whether the meshes meet.
fn ask_any<const N: usize>(
    OverlapArgs { search, .. }: &OverlapArgs,
    models: Both<'_>,
    question: Question<'_, N>,
    pose_of: fn([f32; N]) -> Pose,
) -> Result<(), Failure> {
    question.ask(
        || {
            let mut scratch = search.scratch(models.entries());
            move |row| {
                let found = models.overlap(pose_of(row), search.budget(), &mut scratch)?;
                Ok(Answer { found, ended: ask::ended(found.verdict), work: found.work })
            }
        },
        |out, query, _, Answer { found, work, .. }| {
            let contact = match found.verdict {
                Verdict::Yes => MEETS,
                Verdict::No => APART,
                _ => UNDECIDED,
            };
            write_row(out, query, contact, found.triangles, *work)
        },
    )
}

/// Asks for all pairs of triangles that meet. Writes a row for each pair; one without triangles if
/// there is none, or if pairs may be missing.
fn ask_all<const N: usize>(
    OverlapArgs { search, .. }: &OverlapArgs,
    models: Both<'_>,
    question: Question<'_, N>,
    pose_of: fn([f32; N]) -> Pose,
) -> Result<(), Failure> {
    question.ask(
        || {
            let mut scratch = search.scratch(models.entries());
            let mut buffer = vec![TrianglePair::EMPTY; PAIRS];
            move |row| {
                let pose = pose_of(row);
                let (all, found) = ask::all(
                    &mut buffer,
                    TrianglePair::EMPTY,
                    |buffer| models.overlaps(pose, buffer, search.budget(), &mut scratch),
                    |all| (all.stored, all.dropped),
                )?;
                Ok(Answer { found, ended: all.ended, work: all.work })
            }
        },
        |out, query, _, Answer { found: pairs, ended, work }| {
            for pair in pairs {
                let contact = if pair.is_certain { MEETS } else { UNDECIDED };
                write_row(out, query, contact, Some(pair.triangles), *work)?;
            }
            match ended {
                Ended::Exact | Ended::Resolution if pairs.is_empty() => {
                    write_row(out, query, APART, None, *work)
                }
                Ended::Exact | Ended::Resolution => Ok(()),
                _ => write_row(out, query, UNDECIDED, None, *work),
            }
        },
    )
}

fn write_row(
    out: &mut dyn Write,
    query: usize,
    contact: &str,
    triangles: Option<[u32; 2]>,
    work: Work,
) -> io::Result<()> {
    let [first, second] = triangles.map_or([None; 2], |pair| pair.map(Some));
    write!(out, "{query},{contact},")?;
    first.map_or(Ok(()), |first| write!(out, "{first}"))?;
    write!(out, ",")?;
    write_end(out, second, work)
}
