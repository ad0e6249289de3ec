//! `meshsweep signed`: on which side points are, and how far from the surface or the fence.

use crate::args::{SignedArgs, files};
use crate::ask::{Answer, Question, write_element, write_end, write_numbers};
use crate::failure::Failure;
use crate::output::refuse_same_file;
use crate::queries::Queries;
use crate::side::{has_sideless, name, reason};
use crate::{blob_file, served};
use meshsweep::distances::{Element, has_sides, signed_distance, signed_distance_by_field};
use meshsweep::number::Short;
use meshsweep_core::{
    BuildFor, Curve, CurveSignedDistance, Ended, Interval, Sdf, Side, SignedDistance, Undecided,
    Work,
};
use std::io::{self, Write};

pub fn run(args: &SignedArgs) -> Result<(), Failure> {
    let SignedArgs { blob: file, points, search } = args;
    let in_plane: Vec<_> = points.iter().map(|point| point.in_plane()).collect();
    refuse_same_file(search.output.as_deref(), &files(&[file], &in_plane))?;
    let blob = blob_file::open(file)?;
    if let Ok(curve) = blob.curve() {
        let refuse = |error| Failure::NoFence { file: file.to_owned(), error };
        curve.check_fence().map_err(refuse)?;
        return ask_fence(args, &curve, Queries::read(&in_plane)?);
    }
    let field = served::field(&blob);
    let points: Result<Vec<_>, _> = points.iter().map(|point| point.in_space()).collect();
    let points = points.map_err(|what| Failure::Usage { what })?;
    if let Some(field) = field {
        return ask_field(args, &field, Queries::read(&points)?);
    }
    let tree = served::require_tree(file, &blob, BuildFor::Closest)?;
    let both = served::tree_with_field(&blob);
    let header = "x,y,z,side,reason,lower,upper,px,py,pz,triangle,work";
    Question::new(header, Queries::read(&points)?, search).ask_each(
        tree.scratch_entries(),
        |point, scratch| match &both {
            Some(both) => signed_distance_by_field(both, point, search.budget(), scratch),
            None => signed_distance(&tree, point, search.budget(), scratch),
        },
        |out, _, point, &SignedDistance { distance, side, closest, .. }| {
            let Interval { lower, upper } = distance;
            let [px, py, pz] = closest.point;
            write_numbers(out, point)?;
            write!(out, "{},{},", name(side), reason(side))?;
            write_numbers(out, &[lower, upper, px, py, pz])?;
            write_end(out, closest.triangle, closest.work)
        },
    )?;
    if !has_sides(&tree) || (has_sideless(&tree) && !tree.serves_winding()) {
        // A closed standard error does not withhold the answers.
        let why = match (tree.is_closed(), tree.has_sides()) {
            (false, _) => "the mesh is not closed, so every side is undecided",
            (_, false) => "no triangle tells a side, so every side is undecided",
            _ => "some triangles tell no side: where the nearest is one of them, it is undecided",
        };
        let _ = writeln!(
            io::stderr(),
            "{}: {why}; distances hold; --for closest,winding decides sides",
            file.display()
        );
    }
    Ok(())
}

/// Asks a distance field.
fn ask_field(
    SignedArgs { search, .. }: &SignedArgs,
    field: &Sdf<'_>,
    points: Queries<3>,
) -> Result<(), Failure> {
    let header = "x,y,z,side,reason,lower,upper,gx,gy,gz";
    let question = Question {
        limit: Some(served::FIELD_LIMIT.to_owned()),
        ..Question::new(header, points, search)
    };
    question.ask_each(
        0,
        |point, _| {
            let found = field.distance_and_gradient(point)?;
            Ok(Answer { found, ended: Ended::Exact, work: Work::NONE })
        },
        |out, _, point, Answer { found: (found, [gx, gy, gz]), .. }| {
            let Interval { lower, upper } = found.distance;
            write_numbers(out, point)?;
            write!(out, "{},{},", name(found.side), reason(found.side))?;
            write_numbers(out, &[lower, upper, *gx, *gy])?;
            writeln!(out, "{}", Short(*gz))
        },
    )
}

/// Asks whether a fence allows points.
fn ask_fence(
    SignedArgs { search, .. }: &SignedArgs,
    fence: &Curve<'_>,
    points: Queries<2>,
) -> Result<(), Failure> {
    let header = "x,y,side,reason,lower,upper,px,py,polyline,segment,safe_motion,work";
    Question::new(header, points, search).ask_each(
        fence.scratch_entries() + served::BEST_FIRST,
        |point, scratch| fence.signed_distance(point, search.budget(), scratch),
        |out, _, point, &CurveSignedDistance { distance, side, closest, .. }| {
            let Interval { lower, upper } = distance;
            let [px, py, _] = closest.point;
            let reason = match side {
                Side::Undecided(Undecided::OnSurface) => "at the line",
                other => reason(other),
            };
            write_numbers(out, point)?;
            write!(out, "{},{reason},", name(side))?;
            write_numbers(out, &[lower, upper, px, py])?;
            write_element(out, true, Some(Element::Segment(closest.segment)))?;
            write_numbers(out, &[closest.safe_motion])?;
            writeln!(out, "{}", closest.work.total())
        },
    )
}
