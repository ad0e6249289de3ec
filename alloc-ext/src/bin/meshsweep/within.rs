//! `meshsweep within`: whether points are within a distance of the surface or the curve, or of
//! which triangles or segments.

use crate::args::{PointArgs, WithinArgs, files};
use crate::ask::{
    self, Answer, Question, verdict_name, write_curve_neighbor, write_element, write_end,
    write_neighbor, write_numbers,
};
use crate::failure::Failure;
use crate::output::refuse_same_file;
use crate::queries::Queries;
use crate::{blob_file, served, triboxes};
use meshsweep::distances::Distances;
use meshsweep::number::Short;
use meshsweep_core::{BuildFor, Bvh, Curve, CurveNeighbor, Ended, Interval, Neighbor, Sdf, Work};

/// Room for triangles, or segments, at first.
const ROOM: usize = 64;

pub fn run(args: &WithinArgs) -> Result<(), Failure> {
    let WithinArgs { input: PointArgs { blob: file, points }, search, .. } = args;
    refuse_same_file(search.output.as_deref(), &files(&[file], points))?;
    let blob = blob_file::open(file)?;
    if args.triboxes {
        return triboxes::within(args, &blob);
    }
    if let (Some(field), false, None) = (served::field(&blob), args.all, args.tight) {
        return ask_field(args, &field, Queries::read(points)?);
    }
    let tree = || served::require_tree(file, &blob, BuildFor::Closest);
    if let (Ok(curve), true) = (blob.curve(), args.all) {
        return ask_all_segments(args, &curve, Queries::read(points)?);
    }
    if args.all {
        let tree = tree()?;
        return ask_all(args, tree, Queries::read(points)?);
    }
    let structure = match (blob.curve(), args.tight) {
        (Ok(curve), None) => Distances::Curve(curve),
        _ => match served::tight_hull(file, &blob, args.tight)? {
            Some(hull) => Distances::Tight(hull),
            None => match served::tree_with_field(&blob) {
                Some(both) => Distances::TreeWithField(both),
                None => Distances::Tree(tree()?),
            },
        },
    };
    ask_any(args, structure, Queries::read(points)?)
}

/// Asks whether the surface, or the curve, is within the distance.
fn ask_any(
    WithinArgs { distance, search, .. }: &WithinArgs,
    structure: Distances<'_>,
    points: Queries<3>,
) -> Result<(), Failure> {
    let is_curve = matches!(structure, Distances::Curve(_));
    let header =
        if is_curve { "x,y,z,within,polyline,segment,work" } else { "x,y,z,within,triangle,work" };
    let is_by_hull = matches!(structure, Distances::Tight(_));
    Question { is_by_hull, ..Question::new(header, points, search) }.ask_each(
        served::entries(&structure),
        |point, scratch| structure.any_within(point, *distance, search.budget(), scratch),
        |out, _, point, found| {
            write_numbers(out, point)?;
            write!(out, "{},", verdict_name(found.verdict))?;
            write_element(out, is_curve, found.element)?;
            writeln!(out, "{}", found.work.total())
        },
    )
}

/// Asks a distance field.
fn ask_field(
    WithinArgs { distance, search, .. }: &WithinArgs,
    field: &Sdf<'_>,
    points: Queries<3>,
) -> Result<(), Failure> {
    let header = "x,y,z,within,lower,upper";
    let question = Question {
        limit: Some(served::FIELD_LIMIT.to_owned()),
        ..Question::new(header, points, search)
    };
    question.ask_each(
        0,
        |point, _| {
            let found = (field.within(point, *distance)?, field.distance(point)?.distance);
            Ok(Answer { found, ended: ask::ended(found.0), work: Work::NONE })
        },
        |out, _, point, Answer { found: (verdict, Interval { lower, upper }), .. }| {
            write_numbers(out, point)?;
            write!(out, "{},", verdict_name(*verdict))?;
            writeln!(out, "{},{}", Short(*lower), Short(*upper))
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
            let mut room = vec![Neighbor::EMPTY; ROOM];
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

/// Asks which segments of a curve are within the distance.
fn ask_all_segments(
    WithinArgs { distance, search, .. }: &WithinArgs,
    curve: &Curve<'_>,
    points: Queries<3>,
) -> Result<(), Failure> {
    let header = "query,within,lower,upper,px,py,pz,polyline,segment,work";
    Question::new(header, points, search).ask(
        || {
            let mut scratch = search.scratch(curve.scratch_entries() + served::BEST_FIRST);
            let mut room = vec![CurveNeighbor::EMPTY; ROOM];
            move |point| {
                let (all, segments) = ask::all(
                    &mut room,
                    CurveNeighbor::EMPTY,
                    |room| curve.all_within(point, *distance, room, search.budget(), &mut scratch),
                    |all| (all.stored, all.dropped),
                )?;
                Ok(Answer { found: (all.certain, segments), ended: all.ended, work: all.work })
            }
        },
        |out, query, _, Answer { found: (certain, segments), ended, work }| {
            for (index, near) in segments.iter().enumerate() {
                let verdict = if index < *certain { "yes" } else { "undecided" };
                write!(out, "{query},{verdict},")?;
                write_curve_neighbor(out, near, *work)?;
            }
            let verdict = match ended {
                Ended::Exact if segments.is_empty() => "no",
                Ended::Exact => return Ok(()),
                // Segments may be missing.
                _ => "undecided",
            };
            writeln!(out, "{query},{verdict},,,,,,,,{}", work.total())
        },
    )
}
