//! `meshsweep within`: whether points are within a distance of the surface, or of which triangles.

use crate::args::{PointArgs, WithinArgs, files};
use crate::ask::{self, Answer, Question, verdict_name, write_end, write_neighbor, write_numbers};
use crate::failure::Failure;
use crate::output::refuse_same_file;
use crate::queries::Queries;
use crate::{blob_file, curve, served};
use meshsweep_core::{BuildFor, Bvh, Ended, Neighbor, TightHull};

/// Room for triangles at first.
const TRIANGLES: usize = 64;

pub fn run(args: &WithinArgs) -> Result<(), Failure> {
    let WithinArgs { input: PointArgs { blob: file, points }, search, .. } = args;
    refuse_same_file(search.output.as_deref(), &files(&[file], points))?;
    let blob = blob_file::open(file)?;
    if let Ok(curve) = blob.curve()
        && !args.all
        && args.tight.is_none()
    {
        return curve::within(curve, args, Queries::read(points)?);
    }
    let hull = if args.all { None } else { served::tight_hull(file, &blob, args.tight)? };
    let tree = match &hull {
        Some(hull) => *hull.bvh(),
        None => served::require_tree(file, &blob, BuildFor::Closest)?,
    };
    let points = Queries::read(points)?;
    if args.all { ask_all(args, tree, points) } else { ask_any(args, tree, hull, points) }
}

/// Asks whether the surface is within the distance. `hull` is the hull that `tree` is of, if the
/// mesh's own tree is not asked.
fn ask_any(
    WithinArgs { distance, search, .. }: &WithinArgs,
    tree: Bvh<'_>,
    hull: Option<TightHull<'_>>,
    points: Queries<3>,
) -> Result<(), Failure> {
    let question = Question::new("x,y,z,within,triangle,work", points, search);
    Question { is_by_hull: hull.is_some(), ..question }.ask(
        || {
            let mut scratch = search.scratch(tree.scratch_entries());
            move |point| {
                let found = match &hull {
                    Some(hull) => hull.within(point, *distance, search.budget(), &mut scratch)?,
                    None => tree.within(point, *distance, search.budget(), &mut scratch)?,
                };
                Ok(Answer { found, ended: ask::ended(found.verdict), work: found.work })
            }
        },
        |out, _, point, Answer { found, work, .. }| {
            write_numbers(out, point)?;
            write!(out, "{},", verdict_name(found.verdict))?;
            write_end(out, found.triangle, *work)
        },
    )
}

/// Asks which triangles are within the distance.
fn ask_all(
    WithinArgs { distance, search, .. }: &WithinArgs,
    tree: Bvh<'_>,
    points: Queries<3>,
) -> Result<(), Failure> {
    let header = "query,within,lower,upper,px,py,pz,triangle,work";
    Question::new(header, points, search).ask(
        || {
            let mut scratch = search.scratch(tree.scratch_entries());
            let mut room = vec![Neighbor::EMPTY; TRIANGLES];
            move |point| {
                let (all, triangles) = ask::all(
                    &mut room,
                    Neighbor::EMPTY,
                    |room| tree.all_within(point, *distance, room, search.budget(), &mut scratch),
                    |all| (all.stored, all.dropped),
                )?;
                Ok(Answer { found: (all.certain, triangles), ended: all.ended, work: all.work })
            }
        },
        |out, query, _, Answer { found: (certain, triangles), ended, work }| {
            for (index, near) in triangles.iter().enumerate() {
                let verdict = if index < *certain { "yes" } else { "undecided" };
                write!(out, "{query},{verdict},")?;
                write_neighbor(out, near, *work)?;
            }
            let verdict = match ended {
                Ended::Exact if triangles.is_empty() => "no",
                Ended::Exact => return Ok(()),
                // Triangles may be missing.
                _ => "undecided",
            };
            write!(out, "{query},{verdict},,,,,,")?;
            write_end(out, None, *work)
        },
    )
}
