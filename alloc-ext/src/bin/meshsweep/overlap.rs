//! `meshsweep overlap`: poses of a second mesh in, whether it meets the first one out.

use super::args::OverlapArgs;
use super::blob_file;
use super::failure::Failure;
use super::output::{Output, refuse_same_file};
use super::queries::Queries;
use super::served::{self, Need};
use super::threads;
use meshsweep_core::Bvh;
use meshsweep_core::query::tree::{Contact, PairEntry, TrianglePair, all_overlaps, overlap};
use meshsweep_core::query::{Ended, QueryError, Work};
use meshsweep_core::tribox::Pose;
use std::io::{self, Write};

/// Pairs that fit at first; a pose with more is asked again with as much room as it needs.
const PAIRS: usize = 256;

pub fn run(args: &OverlapArgs) -> Result<(), Failure> {
    if let Some(output) = args.search.output.as_deref() {
        refuse_same_file(output, &args.files())?;
    }
    let [first, second] = [&args.first, &args.second];
    let (first_bytes, second_bytes) = (blob_file::read(first)?, blob_file::read(second)?);
    let models = [blob_file::open(first, &first_bytes)?, blob_file::open(second, &second_bytes)?];
    let trees = [
        served::require_tree(first, &models[0], Need::Segments)?,
        served::require_tree(second, &models[1], Need::Segments)?,
    ];
    if args.matrix.is_empty() {
        let mut poses = Queries::poses(&args.pose)?;
        if args.pose.is_empty() {
            poses =
                Queries::poses(&[super::args::Given::Query([0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0])])?;
        }
        if let Some(index) = poses.rows.iter().position(|row| row[3..].iter().all(|&x| x == 0.0)) {
            let failure = Failure::NoRotation { place: poses.place(index) };
            poses.end_at(index, failure)?;
        }
        answer(args, &trees, poses, turned)
    } else {
        answer(args, &trees, Queries::matrices(&args.matrix)?, rows)
    }
}

/// Translation, then quaternion.
fn turned(&[x, y, z, qw, qx, qy, qz]: &[f32; 7]) -> Pose {
    let q = [qw, qx, qy, qz].map(f64::from);
    // Scaled first: squares of large numbers of f32 stay in f64's range, but why rely on it.
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

/// Rows of a matrix, each with its translation.
fn rows(&[a, b, c, x, d, e, f, y, g, h, i, z]: &[f32; 12]) -> Pose {
    Pose { rotation: [[a, b, c], [d, e, f], [g, h, i]], translation: [x, y, z] }
}

/// One line.
struct Row {
    pose: usize,
    contact: Contact,
    triangles: Option<[u32; 2]>,
    work: Work,
}

fn answer<const N: usize>(
    args: &OverlapArgs,
    [first, second]: &[Bvh<'_>; 2],
    mut poses: Queries<N>,
    pose_of: fn(&[f32; N]) -> Pose,
) -> Result<(), Failure> {
    let output = Output::file_or_stdout(args.search.output.as_deref())?;
    let steps = args.search.steps.unwrap_or(u32::MAX);
    let entries = args.search.queue.map_or(PairEntry::ENOUGH, |entries| entries as usize);
    let asked = threads::ask(&poses, args.search.threads, || {
        let mut stack = vec![PairEntry::EMPTY; entries];
        let mut pairs = vec![TrianglePair::EMPTY; if args.all { PAIRS } else { 0 }];
        move |index, row, rows: &mut Vec<Row>| {
            let pose = pose_of(&row);
            if args.all {
                every(first, second, &pose, steps, &mut pairs, &mut stack, index, rows)
            } else {
                let found = overlap(first, second, &pose, steps, &mut stack)?;
                let (contact, triangles, work) = (found.contact, found.triangles, found.work);
                rows.push(Row { pose: index, contact, triangles, work });
                Ok((found.ended, found.work))
            }
        }
    });
    let stopped = poses.stopped(asked.refused);
    output.finish_until(stopped, |out| {
        writeln!(out, "pose,contact,first,second,work")?;
        asked.answers.iter().try_for_each(|row| write_row(out, row))
    })?;
    args.search.note(&asked, false);
    Ok(())
}

/// All pairs of a pose, a row each; one without triangles if there is none, or if some may be
/// missing.
#[allow(clippy::too_many_arguments, reason = "what a thread works with, and where its rows go")]
fn every(
    first: &Bvh<'_>,
    second: &Bvh<'_>,
    pose: &Pose,
    steps: u32,
    pairs: &mut Vec<TrianglePair>,
    stack: &mut [PairEntry],
    index: usize,
    rows: &mut Vec<Row>,
) -> Result<(Ended, Work), QueryError> {
    let mut found = all_overlaps(first, second, pose, steps, pairs, stack)?;
    if found.dropped > 0 {
        pairs.resize(found.stored + found.dropped as usize, TrianglePair::EMPTY);
        found = all_overlaps(first, second, pose, steps, pairs, stack)?;
    }
    let row = |contact, triangles| Row { pose: index, contact, triangles, work: found.work };
    rows.extend(pairs.iter().take(found.stored).map(|pair| {
        row(if pair.is_certain { Contact::Meets } else { Contact::Open }, Some(pair.triangles))
    }));
    match found.ended {
        Ended::Exact | Ended::Level if found.stored == 0 => rows.push(row(Contact::Apart, None)),
        Ended::Exact | Ended::Level => {}
        _ => rows.push(row(Contact::Open, None)),
    }
    Ok((found.ended, found.work))
}

fn write_row(out: &mut dyn Write, row: &Row) -> io::Result<()> {
    let contact = match row.contact {
        Contact::Apart => "apart",
        Contact::Meets => "meets",
        Contact::Open => "open",
    };
    write!(out, "{},{contact},", row.pose)?;
    match row.triangles {
        Some([first, second]) => write!(out, "{first},{second}")?,
        None => write!(out, ",")?,
    }
    writeln!(out, ",{}", row.work.total())
}
