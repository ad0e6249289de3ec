//! `closest` and `within` of blobs that hold curves.

use crate::args::{ClosestArgs, WithinArgs};
use crate::ask::{self, Answer, Question, verdict_name, write_numbers};
use crate::failure::Failure;
use crate::queries::Queries;
use meshsweep_core::{Budget, Curve, CurveSegment, Interval};
use std::io::{self, Write};

/// Asks for closest points.
pub fn closest(
    curve: Curve<'_>,
    ClosestArgs { search, .. }: &ClosestArgs,
    points: Queries<3>,
    budget: Budget,
) -> Result<(), Failure> {
    let header = "x,y,z,lower,upper,px,py,pz,polyline,segment,safe_motion,work";
    Question::new(header, points, search).ask(
        || {
            let mut scratch = search.scratch(best_first(&curve));
            move |point| {
                let found = curve.closest_point(point, budget, &mut scratch)?;
                Ok(Answer { found, ended: found.ended, work: found.work })
            }
        },
        |out, _, point, Answer { found, work, .. }| {
            let Interval { lower, upper } = found.distance;
            let [x, y, z] = found.point;
            write_numbers(out, point)?;
            write_numbers(out, &[lower, upper, x, y, z])?;
            write_segment(out, Some(found.segment))?;
            write_numbers(out, &[found.safe_motion])?;
            writeln!(out, "{}", work.total())
        },
    )
}

/// Asks whether the curve is within the distance.
pub fn within(
    curve: Curve<'_>,
    WithinArgs { distance, search, .. }: &WithinArgs,
    points: Queries<3>,
) -> Result<(), Failure> {
    Question::new("x,y,z,within,polyline,segment,work", points, search).ask(
        || {
            let mut scratch = search.scratch(best_first(&curve));
            move |point| {
                let found = curve.within(point, *distance, search.budget(), &mut scratch)?;
                Ok(Answer { found, ended: ask::ended(found.verdict), work: found.work })
            }
        },
        |out, _, point, Answer { found, work, .. }| {
            write_numbers(out, point)?;
            write!(out, "{},", verdict_name(found.verdict))?;
            write_segment(out, found.segment)?;
            writeln!(out, "{}", work.total())
        },
    )
}

/// Scratch entries with which searches go best first.
fn best_first(curve: &Curve<'_>) -> usize {
    curve.scratch_entries() + 256
}

fn write_segment(out: &mut dyn Write, segment: Option<CurveSegment>) -> io::Result<()> {
    match segment {
        Some(at) => write!(out, "{},{},", at.polyline, at.segment),
        None => write!(out, ",,"),
    }
}
