//! Curves: `build` from CSV, and `closest` and `within` of blobs that hold them.

use crate::args::{BuildArgs, ClosestArgs, WithinArgs};
use crate::ask::{self, Answer, Question, verdict_name, write_numbers};
use crate::failure::Failure;
use crate::output::Output;
use crate::queries::Queries;
use crate::{describe, source};
use meshsweep::BuildError;
use meshsweep::counted::Counted;
use meshsweep::curve::{CurveError, CurveReport, read_csv, store};
use meshsweep_core::{Blob, Budget, Curve, CurveSegment, Interval};
use std::io::{self, Write};

/// Builds a blob of curves.
pub fn build(args: &BuildArgs) -> Result<(), Failure> {
    let file = &args.mesh;
    let refused = |error: CurveError| Failure::Curve { file: file.clone(), error };
    let text = std::fs::read(file).map_err(|error| Failure::Read { file: file.clone(), error })?;
    let polylines = read_csv(&text, args.closed).map_err(refused)?;
    let (sections, report) = store(&polylines, args.vertex_bits.is_f32()).map_err(refused)?;
    let bytes = sections.to_bytes();
    // A blob that does not open must not be written.
    let blob = Blob::open(&bytes)
        .map_err(|error| Failure::Build { file: file.clone(), error: BuildError::Reopen(error) })?;
    source::write(args, &blob)?;
    Output::stdout().finish(|out| write_report(out, args, &blob, &report))
}

fn write_report(
    out: &mut dyn Write,
    args: &BuildArgs,
    blob: &Blob<'_>,
    report: &CurveReport,
) -> io::Result<()> {
    writeln!(out, "{}", args.mesh.display())?;
    if report.repeated > 0 {
        let points = Counted(report.repeated, "point");
        writeln!(out, "  {points} repeated: kept, as segments without length")?;
    }
    writeln!(out, "{}", args.output.display())?;
    source::report(args, out)?;
    describe::write_blob(out, blob)?;
    writeln!(out, "seconds: hierarchy {:.3}", report.time.as_secs_f64())
}

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
