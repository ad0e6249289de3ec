//! Tight hulls of a mesh, which need not be closed.

use super::super::args::HullArgs;
use super::super::counted::Counted;
use super::super::describe::{About, AtLeast, AtMost, Given, Percent};
use super::super::failure::Failure;
use super::super::mesh_file::{Loaded, load_snapped};
use super::super::output::Output;
use super::super::progress::Bar;
use super::unmet::{Tightness, require_met};
use super::write_hull;
use meshsweep::mesh::Mesh;
use meshsweep::wrap::{Goal, Hull, Options, Outcome, Progress, Report, Stage, Start, parts, wrap};
use std::io::{self, Write};
use std::time::Duration;

pub fn run(args: &HullArgs, faces: u32) -> Result<(), Failure> {
    Output::probe(&args.output)?;
    let goal = match (args.void, args.slack) {
        (Some(percent), _) => Goal::Void(percent / 100.0),
        (_, Some(slack)) => Goal::Slack(slack),
        _ => Goal::Faces(faces as usize),
    };
    let mut options = Options {
        goal,
        margin: args.margin.unwrap_or(0.0),
        effort: args.effort.unwrap_or(1.0),
        time_limit: args.seconds.map(|s| Duration::try_from_secs_f64(s).unwrap_or(Duration::MAX)),
        vertex_bits: args.vertex_bits.format(),
    };
    let loaded = load_snapped(&args.input, options.vertex_bits)?;
    options.margin = widened(options.margin, &loaded);
    let meshes = if args.parts { parts(&loaded.mesh) } else { vec![loaded.mesh] };
    let mut hulls = Vec::new();
    for mesh in &meshes {
        let mut bars = WrapBars::default();
        let hull = wrap(mesh, &options, |progress| bars.show(progress));
        hulls.push(hull.map_err(|error| Failure::Wrap { file: args.input.clone(), error })?);
    }
    let asked = Tightness { slack: args.slack, void: args.void, by_faces: "--faces" };
    require_met(&args.input, &asked, hulls.iter().map(|hull| &hull.report))?;
    write_hull(&args.output, &joined(&hulls))?;
    Output::stdout().finish(|out| {
        if !loaded.report.is_clean() {
            writeln!(out, "{}\n  {}", args.input.display(), loaded.report)?;
        }
        if loaded.moved > 0.0 {
            writeln!(
                out,
                "vertices of the mesh moved to the grid by up to {}",
                AtMost(loaded.moved)
            )?;
        }
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
        }
    })
}

/// A margin that the file's vertices, decimal or not on the grid, have around them too.
pub fn widened(margin: f64, loaded: &Loaded) -> f64 {
    let moved = (loaded.moved + loaded.mesh.rounding) * (1.0 + 4.0 * f64::EPSILON);
    if margin > 0.0 { margin + moved } else { margin }
}

/// `margin` is the one that was typed: the hull keeps what rounding may take from it besides. `of`
/// says what the hull is of.
fn describe(
    out: &mut dyn Write,
    report: &Report,
    goal: Goal,
    margin: Option<f64>,
    of: &str,
) -> io::Result<()> {
    write!(out, "{}, ", Counted(report.faces, "face"))?;
    if let Ok(void) = report.void {
        write!(out, "{} % void space, ", Percent(void * 100.0))?;
    }
    writeln!(
        out,
        "at most {} from the {of} and in one place at least {}, {:.3} s",
        AtMost(report.slack.upper),
        AtLeast(report.slack.lower),
        report.time.as_secs_f64()
    )?;
    write_margin(out, margin, of)?;
    if let Err(why) = report.void {
        writeln!(out, "  {why}; there is no volume to measure void against")?;
    }
    write_start(out, report)?;
    match (report.stop, goal) {
        (Outcome::Reached, _) => Ok(()),
        (Outcome::Stuck, Goal::Faces(faces)) => writeln!(
            out,
            "  stopped before {faces} faces: no edge may collapse and leave the hull closed, clear of the mesh and of itself"
        ),
        (Outcome::Stuck, _) => writeln!(out, "  stopped where no edge may collapse any more"),
        // It came within the goal by what was mended last, or it is not written.
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

/// That a margin is kept, if there is one.
pub fn write_margin(out: &mut dyn Write, margin: Option<f64>, of: &str) -> io::Result<()> {
    margin.filter(|&margin| margin > 0.0).map_or(Ok(()), |margin| {
        writeln!(out, "  all points within {} of the {of} are inside", Given(margin))
    })
}

/// What a hull's void is measured against where that is not sure, what it was made from, if not
/// from the mesh's progressive hull, and what it filled.
pub fn write_start(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    if report.crosses {
        writeln!(
            out,
            "  the mesh crosses or touches itself: its volume counts what overlaps more than once, so that the void may be more than that"
        )?;
    }
    if let Start::Closure { cell, .. } = report.start {
        writeln!(
            out,
            "  the hull began as the outside of the cubes of edge {} that its triangles meet",
            About(cell)
        )?;
    }
    if report.start == Start::Box {
        writeln!(out, "  the hull began as the mesh's box")?;
    }
    if report.filled > 0 {
        writeln!(
            out,
            "  {} filled: a cavity, or a part inside another",
            Counted(report.filled, "shell")
        )?;
    }
    Ok(())
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

/// One bar for each stage.
#[derive(Default)]
pub struct WrapBars {
    stage: Option<(Stage, usize)>,
    bar: Option<Bar>,
}

impl WrapBars {
    pub fn show(&mut self, progress: Progress) {
        let stage = (progress.stage, progress.of);
        if self.stage != Some(stage) {
            let (doing, things) = match progress.stage {
                Stage::Collapsing => ("collapsing", "faces"),
                Stage::Wrapping => ("wrapping", "faces"),
                Stage::Polishing => ("polishing", "steps"),
            };
            // The old bar goes before the new one comes.
            self.bar = None;
            self.bar = Some(Bar::new(progress.of, doing, things));
            self.stage = Some(stage);
        }
        if let Some(bar) = &self.bar {
            bar.show(progress.done);
        }
    }
}
