//! `meshsweep overlap`: poses of a second mesh in, whether it meets the first one out.

use crate::args::{Given, OverlapArgs, SearchArgs, files};
use crate::ask::{self, Question, write_end};
use crate::failure::Failure;
use crate::output::refuse_same_file;
use crate::queries::Queries;
use crate::{blob_file, served};
use meshsweep_core::{
    BuildFor, Bvh, Ended, Overlap, Overlaps, Pose, QueryError, ScratchEntry, TrianglePair, Verdict,
    Work,
};
use std::io::{self, Write};

// Words of the column `contact`.
const APART: &str = "apart";
const MEETS: &str = "meets";
const OPEN: &str = "open";

const HEADER: &str = "pose,contact,first,second,work";

/// Room for pairs at first.
const PAIRS: usize = 256;

pub fn run(args: &OverlapArgs) -> Result<(), Failure> {
    let OverlapArgs { first, second, pose, matrix, search, .. } = args;
    let inputs = [files(&[first, second], pose), files(&[], matrix)].concat();
    refuse_same_file(search.output.as_deref(), &inputs)?;
    let (first_bytes, second_bytes) = (blob_file::read(first)?, blob_file::read(second)?);
    let blobs = [blob_file::open(first, &first_bytes)?, blob_file::open(second, &second_bytes)?];
    let trees = [
        served::require_tree(first, &blobs[0], BuildFor::Segment)?,
        served::require_tree(second, &blobs[1], BuildFor::Segment)?,
    ];
    if !matrix.is_empty() {
        return ask_poses(args, trees, Queries::read(matrix)?, of_matrix);
    }
    let as_built = [Given::Query([0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0])];
    let mut poses = Queries::read(if pose.is_empty() { &as_built } else { pose })?;
    if let Some(index) = poses.rows.iter().position(|row| row[3..].iter().all(|&x| x == 0.0)) {
        let failure = Failure::NoRotation { place: poses.place(index) };
        poses.end_at(index, failure)?;
    }
    ask_poses(args, trees, poses, of_quaternion)
}

fn ask_poses<const N: usize>(
    args: &OverlapArgs,
    trees: [Bvh<'_>; 2],
    poses: Queries<N>,
    pose_of: fn([f32; N]) -> Pose,
) -> Result<(), Failure> {
    let pair = Pair { trees, pose_of, search: &args.search };
    if args.all {
        ask::run(&All(pair), poses, &args.search)
    } else {
        ask::run(&Any(pair), poses, &args.search)
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

/// Two meshes, and how poses of the second one are read.
struct Pair<'a, const N: usize> {
    trees: [Bvh<'a>; 2],
    pose_of: fn([f32; N]) -> Pose,
    search: &'a SearchArgs,
}

impl<const N: usize> Pair<'_, N> {
    fn scratch(&self) -> Vec<ScratchEntry> {
        self.search.scratch(Bvh::OVERLAP_ENTRIES)
    }
}

/// Whether the meshes meet.
struct Any<'a, const N: usize>(Pair<'a, N>);

impl<const N: usize> Question<N> for Any<'_, N> {
    type Answer = Overlap;
    type Memory = Vec<ScratchEntry>;

    fn header(&self) -> &'static str {
        HEADER
    }

    fn memory(&self) -> Self::Memory {
        self.0.scratch()
    }

    fn ask(&self, row: [f32; N], scratch: &mut Self::Memory) -> Result<Overlap, QueryError> {
        let Pair { trees: [first, second], pose_of, search } = &self.0;
        first.overlap(second, pose_of(row), search.budget(), scratch)
    }

    fn outcome(found: &Overlap) -> (Ended, Work) {
        (ask::ended(found.verdict), found.work)
    }

    fn write(
        &self,
        out: &mut dyn Write,
        query: usize,
        _: &[f32; N],
        found: &Overlap,
    ) -> io::Result<()> {
        let contact = match found.verdict {
            Verdict::Yes => MEETS,
            Verdict::No => APART,
            _ => OPEN,
        };
        write_row(out, query, contact, found.triangles, found.work)
    }
}

/// All pairs of triangles that meet.
struct All<'a, const N: usize>(Pair<'a, N>);

impl<const N: usize> Question<N> for All<'_, N> {
    type Answer = (Overlaps, Vec<TrianglePair>);
    type Memory = (Vec<TrianglePair>, Vec<ScratchEntry>);

    fn header(&self) -> &'static str {
        HEADER
    }

    fn memory(&self) -> Self::Memory {
        (vec![TrianglePair::EMPTY; PAIRS], self.0.scratch())
    }

    fn ask(
        &self,
        row: [f32; N],
        (room, scratch): &mut Self::Memory,
    ) -> Result<Self::Answer, QueryError> {
        let Pair { trees: [first, second], pose_of, search } = &self.0;
        ask::all(
            room,
            TrianglePair::EMPTY,
            |room| first.overlaps(second, pose_of(row), room, search.budget(), scratch),
            |found| (found.stored, found.dropped),
        )
    }

    fn outcome((found, _): &Self::Answer) -> (Ended, Work) {
        (found.ended, found.work)
    }

    /// A row for each pair; one without triangles if there is none, or if pairs may be missing.
    fn write(
        &self,
        out: &mut dyn Write,
        query: usize,
        _: &[f32; N],
        (found, pairs): &Self::Answer,
    ) -> io::Result<()> {
        for pair in pairs {
            let contact = if pair.is_certain { MEETS } else { OPEN };
            write_row(out, query, contact, Some(pair.triangles), found.work)?;
        }
        match found.ended {
            Ended::Exact | Ended::Resolution if pairs.is_empty() => {
                write_row(out, query, APART, None, found.work)
            }
            Ended::Exact | Ended::Resolution => Ok(()),
            _ => write_row(out, query, OPEN, None, found.work),
        }
    }
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
