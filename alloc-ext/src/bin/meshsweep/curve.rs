//! Curves: `build` from CSV, and `closest` and `within` of blobs that hold them.

use crate::args::{BuildArgs, ClosestArgs, SearchArgs, WithinArgs};
use crate::ask::{self, Question, verdict_name, write_numbers};
use crate::describe;
use crate::failure::Failure;
use crate::output::Output;
use crate::queries::Queries;
use meshsweep::BuildError;
use meshsweep::counted::Counted;
use meshsweep::curve::{CurveError, CurveReport, read_csv, store};
use meshsweep_core::{
    Blob, Budget, Curve, CurveClosest, CurveSegment, CurveWithin, Ended, QueryError, ScratchEntry,
    Work,
};
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
    Output::file(&args.output)?.finish(|out| out.write_all(&bytes))?;
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
    describe::write_blob(out, blob)?;
    writeln!(out, "seconds: hierarchy {:.3}", report.time.as_secs_f64())
}

/// Asks for closest points.
pub fn closest(
    curve: Curve<'_>,
    args: &ClosestArgs,
    queries: Queries<3>,
    budget: Budget,
) -> Result<(), Failure> {
    ask::run(&Closest { curve, budget, search: &args.search }, queries, &args.search)
}

/// Asks whether the curve is within a distance.
pub fn within(curve: Curve<'_>, args: &WithinArgs, queries: Queries<3>) -> Result<(), Failure> {
    let (search, distance) = (&args.search, args.distance);
    ask::run(&Within { curve, distance, search }, queries, search)
}

struct Closest<'a> {
    curve: Curve<'a>,
    budget: Budget,
    search: &'a SearchArgs,
}

impl Question<3> for Closest<'_> {
    type Answer = CurveClosest;
    type Memory = Vec<ScratchEntry>;

    fn header(&self) -> &'static str {
        "x,y,z,lower,upper,px,py,pz,polyline,segment,safe_motion,work"
    }

    fn memory(&self) -> Self::Memory {
        self.search.scratch(best_first(&self.curve))
    }

    fn ask(&self, point: [f32; 3], scratch: &mut Self::Memory) -> Result<CurveClosest, QueryError> {
        self.curve.closest_point(point, self.budget, scratch)
    }

    fn outcome(answer: &CurveClosest) -> (Ended, Work) {
        (answer.ended, answer.work)
    }

    fn write(
        &self,
        out: &mut dyn Write,
        _: usize,
        point: &[f32; 3],
        answer: &CurveClosest,
    ) -> io::Result<()> {
        write_numbers(out, point)?;
        write_numbers(out, &[answer.distance.lower, answer.distance.upper])?;
        write_numbers(out, &answer.point)?;
        write_segment(out, Some(answer.segment))?;
        write_numbers(out, &[answer.safe_motion])?;
        writeln!(out, "{}", answer.work.total())
    }
}

struct Within<'a> {
    curve: Curve<'a>,
    distance: f32,
    search: &'a SearchArgs,
}

impl Question<3> for Within<'_> {
    type Answer = CurveWithin;
    type Memory = Vec<ScratchEntry>;

    fn header(&self) -> &'static str {
        "x,y,z,within,polyline,segment,work"
    }

    fn memory(&self) -> Self::Memory {
        self.search.scratch(best_first(&self.curve))
    }

    fn ask(&self, point: [f32; 3], scratch: &mut Self::Memory) -> Result<CurveWithin, QueryError> {
        self.curve.within(point, self.distance, self.search.budget(), scratch)
    }

    fn outcome(answer: &CurveWithin) -> (Ended, Work) {
        (ask::ended(answer.verdict), answer.work)
    }

    fn write(
        &self,
        out: &mut dyn Write,
        _: usize,
        point: &[f32; 3],
        answer: &CurveWithin,
    ) -> io::Result<()> {
        write_numbers(out, point)?;
        write!(out, "{},", verdict_name(answer.verdict))?;
        write_segment(out, answer.segment)?;
        writeln!(out, "{}", answer.work.total())
    }
}

/// Scratch entries with which searches go best first.
fn best_first(curve: &Curve<'_>) -> usize {
    curve.scratch_entries() + 256
}

fn write_segment(out: &mut dyn Write, segment: Option<CurveSegment>) -> io::Result<()> {
    match segment {
        Some(CurveSegment { polyline, segment }) => write!(out, "{polyline},{segment},"),
        None => write!(out, ",,"),
    }
}
