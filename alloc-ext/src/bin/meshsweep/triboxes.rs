//! Questions to stored triboxes. They prove that meshes are apart or farther than a distance, or
//! that a segment is clear so far, and never the opposite. Columns name triboxes by the numbers of
//! their nodes.

use crate::args::{ClearanceArgs, ClosestArgs, OverlapArgs, SegmentArgs, WithinArgs};
use crate::ask::{self, Answer, Question, write_end, write_numbers, write_pair};
use crate::failure::Failure;
use crate::poses;
use crate::queries::Queries;
use crate::served::require_triboxes;
use meshsweep_core::{Blob, NodePair, Triboxes};
use std::path::Path;

/// Pairs that fit the buffer at first.
const PAIRS: usize = 256;

/// The triboxes of two blobs.
fn both<'a>(files: [&Path; 2], blobs: &[Blob<'a>; 2]) -> Result<[Triboxes<'a>; 2], Failure> {
    let ([file, other], [first, second]) = (files, blobs);
    Ok([require_triboxes(file, first)?, require_triboxes(other, second)?])
}

fn nodes(pair: NodePair) -> [u32; 2] {
    [u32::from(pair.a), u32::from(pair.b)]
}

/// Whether the meshes are farther than a distance. Else the row names the triboxes that may be
/// nearer.
pub fn clearance(
    ClearanceArgs { input, search, .. }: &ClearanceArgs,
    blobs: &[Blob<'_>; 2],
    distance: f32,
) -> Result<(), Failure> {
    let [first, second] = both([&input.first, &input.second], blobs)?;
    Question::new("pose,within,first,second,work", poses::read(input)?, search).ask_each(
        first.separation_entries(&second),
        |row, scratch| {
            first.within_of(&second, poses::of_row(row), distance, search.budget(), scratch)
        },
        |out, query, _, found| {
            let verdict = if found.is_apart() { "no" } else { "undecided" };
            write!(out, "{query},{verdict},")?;
            write_pair(out, found.may_meet.map(nodes), found.work)
        },
    )
}

/// Whether the meshes are apart. Else a row for the first pair of triboxes that may meet, or for
/// all.
pub fn overlap(
    OverlapArgs { input, search, all, .. }: &OverlapArgs,
    blobs: &[Blob<'_>; 2],
) -> Result<(), Failure> {
    let [first, second] = both([&input.first, &input.second], blobs)?;
    let (entries, budget) = (first.separation_entries(&second), search.budget());
    let asker = || {
        let mut scratch = search.scratch(entries);
        let mut buffer = vec![NodePair::EMPTY; if *all { PAIRS } else { 0 }];
        move |row| {
            let pose = poses::of_row(row);
            if !all {
                let one = first.separation(&second, pose, budget, &mut scratch)?;
                let found: Vec<_> = one.may_meet.into_iter().collect();
                return Ok(Answer { found, ended: one.ended, work: one.work });
            }
            let (all, found) = ask::all(
                &mut buffer,
                NodePair::EMPTY,
                |pairs| first.candidates(&second, pose, pairs, budget, &mut scratch),
                |all| (all.stored, all.dropped),
            )?;
            Ok(Answer { found, ended: all.ended, work: all.work })
        }
    };
    let question = Question::new("pose,contact,first,second,work", poses::read(input)?, search);
    question.ask(asker, |out, query, _, Answer { found, work, .. }| {
        if found.is_empty() {
            write!(out, "{query},apart,")?;
            return write_pair(out, None, *work);
        }
        found.iter().try_for_each(|&pair| {
            write!(out, "{query},undecided,")?;
            write_pair(out, Some(nodes(pair)), *work)
        })
    })
}

/// Lower bounds of distances.
pub fn closest(
    ClosestArgs { input, search, .. }: &ClosestArgs,
    blob: &Blob<'_>,
) -> Result<(), Failure> {
    let triboxes = require_triboxes(&input.blob, blob)?;
    Question::new("x,y,z,lower,tribox,work", Queries::read(&input.points)?, search).ask_each(
        triboxes.scratch_entries(),
        |point, scratch| triboxes.distance(point, search.budget(), scratch),
        |out, _, point, found| {
            write_numbers(out, point)?;
            write_numbers(out, &[found.lower])?;
            write_end(out, found.node, found.work)
        },
    )
}

/// Whether points are farther than a distance. Else the row names the nearest tribox.
pub fn within(
    WithinArgs { input, distance, search, .. }: &WithinArgs,
    blob: &Blob<'_>,
) -> Result<(), Failure> {
    let triboxes = require_triboxes(&input.blob, blob)?;
    Question::new("x,y,z,within,tribox,work", Queries::read(&input.points)?, search).ask_each(
        triboxes.scratch_entries(),
        |point, scratch| triboxes.distance(point, search.budget(), scratch),
        |out, _, point, found| {
            let is_farther = found.lower > *distance;
            write_numbers(out, point)?;
            write!(out, "{},", if is_farther { "no" } else { "undecided" })?;
            write_end(out, found.node.filter(|_| !is_farther), found.work)
        },
    )
}

/// Whether segments are clear. Else the row names the tribox that one enters first, and where.
pub fn segment(
    SegmentArgs { blob: file, segments, search, .. }: &SegmentArgs,
    blob: &Blob<'_>,
) -> Result<(), Failure> {
    let triboxes = require_triboxes(file, blob)?;
    Question::new("hit,t,tribox,work", Queries::read(segments)?, search).ask_each(
        triboxes.scratch_entries(),
        |[ax, ay, az, bx, by, bz], scratch| {
            triboxes.clip([ax, ay, az], [bx, by, bz], search.budget(), scratch)
        },
        |out, _, _, found| {
            match found.node {
                None => write!(out, "no,,")?,
                Some(_) => {
                    write!(out, "undecided,")?;
                    write_numbers(out, &[found.lower])?;
                }
            }
            write_end(out, found.node, found.work)
        },
    )
}
