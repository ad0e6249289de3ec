//! The tight hull of a mesh, which need not be closed.

use crate::args::HullArgs;
use crate::failure::Failure;
use crate::mesh_file::load_snapped;
use crate::mesh_report::write_repairs;
use crate::output::Output;
use crate::progress::StageBars;
use meshsweep::builder::FACES;
use meshsweep::counted::Counted;
use meshsweep::mesh::{Input, Mesh, write_ply};
use meshsweep::number::{AtLeast, AtMost, Percent};
use meshsweep::progress::Callback;
use meshsweep::tight::{
    Goal, Hull, Options, Outcome, Report, Tightness, margin_note, no_void_note, rounded_note,
    split_components, wrap,
};
use std::io::{self, Write};
use std::time::Duration;

pub fn run(args: &HullArgs) -> Result<(), Failure> {
    Output::probe(&args.output)?;
    let goal = match (args.void, args.slack) {
        (Some(percent), _) => Goal::Void(percent / 100.0),
        (_, Some(slack)) => Goal::Slack(slack),
        _ => Goal::Faces(args.faces.unwrap_or(FACES) as usize),
    };
    let limit = args.seconds.map(|s| Duration::try_from_secs_f64(s).unwrap_or(Duration::MAX));
    let loaded = load_snapped(&args.input, args.vertex_bits.format(), args.unit)?;
    let options = Options::new(goal)
        .with_margin(args.margin.unwrap_or(0.0))
        .with_effort(args.effort.unwrap_or(1.0))
        .with_time_limit(limit)
        .with_vertex_bits(args.vertex_bits.format());
    let meshes =
        if args.parts { split_components(&loaded.mesh) } else { Ok(vec![loaded.mesh.clone()]) };
    let meshes = meshes.map_err(|error| Failure::build(&args.input, error))?;
    let mut hulls = Vec::new();
    for mesh in &meshes {
        let mut bars = StageBars::default();
        let part = Input { mesh, ..loaded.input() };
        let progress = Callback::new(|stage, _| bars.show(stage));
        let hull = wrap(part, &options, progress.watch());
        hulls.push(hull.map_err(|error| Failure::build(&args.input, error))?);
    }
    let asked = Tightness { slack: args.slack, void: args.void, by_faces: "--faces" };
    asked
        .require(hulls.iter().map(|hull| &hull.report))
        .map_err(|error| Failure::build(&args.input, error))?;
    Output::file(&args.output)?.finish(|out| write_ply(&joined(&hulls), out))?;
    Output::stdout().finish(|out| {
        write_repairs(out, &args.input, &loaded)?;
        match &hulls[..] {
            [hull] => {
                write!(out, "{}: ", args.output.display())?;
                describe(out, &hull.report, goal, args.margin, "mesh")
            }
            _ => {
                let faces: usize = hulls.iter().map(|hull| hull.report.faces).sum();
                let count = Counted(hulls.len(), "hull");
                writeln!(
                    out,
                    "{}: {count}, {} in all",
                    args.output.display(),
                    Counted(faces, "face")
                )?;
                for (index, hull) in hulls.iter().enumerate() {
                    write!(out, "  part {index}: ")?;
                    describe(out, &hull.report, goal, args.margin, "part")?;
                }
                Ok(())
            }
        }?;
        rounded_note(loaded.error()).map_or(Ok(()), |note| writeln!(out, "  {note}"))
    })
}

/// Describes a hull. `of` names what the hull encloses.
fn describe(
    out: &mut dyn Write,
    report: &Report,
    goal: Goal,
    margin: Option<f64>,
    of: &str,
) -> io::Result<()> {
    write!(out, "{}, ", Counted(report.faces, "face"))?;
    if let Ok(void) = &report.void {
        write!(out, "{} % void space, ", Percent(void * 100.0))?;
    }
    writeln!(
        out,
        "at most {} from the {of} and in one place at least {}, {:.3} s",
        AtMost(report.slack.upper),
        AtLeast(report.slack.lower),
        report.time.as_secs_f64()
    )?;
    let notes = margin_note(margin, of).into_iter().chain(no_void_note(&report.void));
    notes.chain(report.notes()).try_for_each(|note| writeln!(out, "  {note}"))?;
    match (report.stop, goal) {
        (Outcome::Reached, _) => Ok(()),
        (Outcome::Stuck, Goal::Faces(faces)) => writeln!(
            out,
            "  stopped before {faces} faces: no edge may collapse and leave the hull closed, \
             clear of the mesh and of itself"
        ),
        (Outcome::Stuck, _) => writeln!(out, "  stopped where no edge may collapse any more"),
        // A hull that misses the goal is not written. So the last change met it.
        (Outcome::TooLoose, _) => {
            writeln!(out, "  fewer faces were not tried: this is as tight as it gets")
        }
        (Outcome::OutOfTime, Goal::Faces(faces)) if report.faces > faces => {
            writeln!(
                out,
                "  stopped by --seconds before {faces} faces: with more time the hull has fewer"
            )
        }
        (Outcome::OutOfTime, Goal::Faces(_)) => {
            writeln!(out, "  stopped by --seconds: with more time the hull is tighter")
        }
        (Outcome::OutOfTime, _) => {
            writeln!(out, "  stopped by --seconds: with more time it may have fewer faces")
        }
    }
}

/// One file for all hulls.
fn joined(hulls: &[Hull]) -> Mesh {
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    for hull in hulls {
        let first = positions.len() as u32;
        positions.extend_from_slice(&hull.mesh.positions);
        triangles.extend(hull.mesh.triangles.iter().map(|t| t.map(|v| v + first)));
    }
    Mesh::new(positions, triangles)
}
