//! `meshsweep overlap`: poses of a second mesh in, whether it meets the first one out.

use crate::args::{Engine, MovedArgs, OverlapArgs};
use crate::ask::{self, Answer, Question, write_pair};
use crate::failure::Failure;
use crate::poses;
use crate::served::Both;
use crate::{blob_file, served, triboxes};
use meshsweep_core::{
    Blob, Decided, Ended, Pose, QueryError, ScratchEntry, TrianglePair, Verdict, Work,
};
use std::io::{self, Write};

// Words of the column `contact`.
const APART: &str = "apart";
const MEETS: &str = "meets";
const UNDECIDED: &str = "undecided";

const HEADER: &str = "pose,contact,first,second,work";

/// Pairs that fit the buffer at first.
const PAIRS: usize = 256;

pub fn run(args: &OverlapArgs) -> Result<(), Failure> {
    let MovedArgs { first, second, .. } = &args.input;
    poses::refuse_same_file(&args.input, &args.search)?;
    let blobs = [blob_file::open(first)?, blob_file::open(second)?];
    if args.triboxes {
        return triboxes::overlap(args, &blobs);
    }
    if let Some(frame) = args.frame {
        return at_frame(args, &blobs, frame);
    }
    let tree_chosen = args.engine.map(|engine| engine == Engine::Tree);
    let models = served::choose_both([first, second], &blobs, tree_chosen)?;
    let poses = poses::read(&args.input)?;
    let question = Question::new(HEADER, poses, &args.search);
    if args.all {
        return ask_all(args, models, question);
    }
    let budget = args.search.budget();
    ask_any(question, models.entries(), |pose, scratch| models.overlap(pose, budget, scratch))
}

/// Asks the first mesh at a key frame.
fn at_frame(args: &OverlapArgs, blobs: &[Blob<'_>; 2], frame: f32) -> Result<(), Failure> {
    let MovedArgs { first, second, .. } = &args.input;
    let [blob, other] = blobs;
    let (hull, _) = served::require_frame(first, blob, frame)?;
    let other = served::require_hull(second, other)?;
    let entries = served::require_hull(first, blob)?.overlap_entries(&other);
    let question = Question::new(HEADER, poses::read(&args.input)?, &args.search);
    let budget = args.search.budget();
    ask_any(question, entries, |pose, scratch| hull.overlap(&other, pose, budget, scratch))
}

/// Asks whether the meshes meet.
fn ask_any(
    question: Question<'_, 12>,
    entries: usize,
    ask: impl Fn(Pose, &mut [ScratchEntry]) -> Result<Decided<[u32; 2]>, QueryError> + Sync,
) -> Result<(), Failure> {
    question.ask_each(
        entries,
        |row, scratch| ask(poses::of_row(row), scratch),
        |out, query, _, found| {
            let contact = match found.verdict {
                Verdict::Yes => MEETS,
                Verdict::No => APART,
                _ => UNDECIDED,
            };
            write_row(out, query, contact, found.witness, found.work)
        },
    )
}

/// Asks for all pairs of triangles that meet. Writes a row for each pair; one without triangles if
/// there is none, or if pairs may be missing, as those of a cut blob are.
fn ask_all(
    OverlapArgs { search, .. }: &OverlapArgs,
    models: Both<'_>,
    question: Question<'_, 12>,
) -> Result<(), Failure> {
    question.ask(
        || {
            let mut scratch = search.scratch(models.entries());
            let mut buffer = vec![TrianglePair::EMPTY; PAIRS];
            move |row| {
                let pose = poses::of_row(row);
                let (all, found) = ask::all(
                    &mut buffer,
                    TrianglePair::EMPTY,
                    |buffer| models.all_overlaps(pose, buffer, search.budget(), &mut scratch),
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
                Ended::Exact if pairs.is_empty() => write_row(out, query, APART, None, *work),
                // Without a pair a cut blob is near: its triangles have no numbers to list.
                Ended::Exact | Ended::Resolution if !pairs.is_empty() => Ok(()),
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
    write!(out, "{query},{contact},")?;
    write_pair(out, triangles, work)
}
