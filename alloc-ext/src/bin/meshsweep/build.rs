//! `meshsweep build`: a mesh file in, a blob and a report out.

use crate::args::BuildArgs;
use crate::failure::Failure;
use crate::output::{Output, refuse_same_file};
use crate::progress::StageBars;
use crate::trade::choose::{self, Chosen};
use crate::{describe, source};
use meshsweep::Built;
use meshsweep::builder::Topic;
use meshsweep::counted::Counted;
use meshsweep_core::Blob;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

pub fn run(args: &BuildArgs) -> Result<(), Failure> {
    let builder = args.builder();
    let failed = |error| Failure::build(&args.mesh, error);
    refuse_options(args).map_or(Ok(()), |what| Err(Failure::Usage { what }))?;
    builder.check(&args.mesh).map_err(failed)?;
    let inputs: Vec<&Path> =
        [&args.mesh].into_iter().chain(&args.frames).map(PathBuf::as_path).collect();
    refuse_same_file(Some(&args.output), &inputs)?;
    Output::probe(&args.output)?;
    source::probe(args, &inputs)?;
    let (built, chosen) = if args.limits.given().is_some() {
        let (built, chosen) = choose::choose(args)?;
        (built, Some(chosen))
    } else {
        let mut bars = StageBars::default();
        let built = builder.on_progress(|stage, _| bars.show(stage)).build_file(&args.mesh);
        (built.map_err(failed)?, None)
    };
    for note in built.report_on(Topic::Winding) {
        // A closed standard error is no failure.
        let _ = writeln!(io::stderr(), "{}: {note}", args.mesh.display());
    }
    let blob = built.blob();
    source::write(args, &blob)?;
    Output::stdout().finish(|out| write_report(out, args, &built, &blob, chosen.as_ref()))
}

/// Why limits do not go together with other options, if they do not.
fn refuse_options(args: &BuildArgs) -> Option<String> {
    match args.limits.given() {
        Some(option) => {
            let other = args.chosen_option()?;
            Some(format!("{option} chooses structure and dials; leave out {other}"))
        }
        None if args.limits.cpu.is_some() || args.limits.at.is_some() => {
            Some("--cpu and --at go with --flash, --ram, --error or --rate".to_owned())
        }
        None => None,
    }
}

/// The report of the command.
fn write_report(
    out: &mut dyn Write,
    args: &BuildArgs,
    built: &Built,
    blob: &Blob<'_>,
    chosen: Option<&Chosen>,
) -> io::Result<()> {
    let indented = |out: &mut dyn Write, topic| {
        built.report_on(topic).try_for_each(|note| writeln!(out, "  {note}"))
    };
    writeln!(out, "{}", args.mesh.display())?;
    indented(out, Topic::Input)?;
    chosen.map_or(Ok(()), |chosen| choose::write(out, chosen))?;
    writeln!(out, "{}", args.output.display())?;
    source::report(args, out)?;
    indented(out, Topic::Hull)?;
    describe::write_blob(out, blob)?;
    indented(out, Topic::BoxTree)?;
    built.report_on(Topic::Sides).try_for_each(|note| writeln!(out, "{note}"))?;
    indented(out, Topic::Tight)?;
    chosen.map_or_else(|| write_seconds(out, built), |_| Ok(()))
}

fn write_seconds(out: &mut dyn Write, built: &Built) -> io::Result<()> {
    if let Some(curve) = &built.curve {
        return writeln!(out, "seconds: hierarchy {:.3}", curve.time.as_secs_f64());
    }
    let seconds = |time: Duration| time.as_secs_f64();
    let loading = built.loaded.as_ref().map_or(Duration::ZERO, |loaded| loaded.time);
    write!(out, "seconds: read and repair {:.3}", seconds(loading))?;
    if let Some(report) = &built.hull {
        write!(
            out,
            ", collapse {:.3} ({}), sweep {:.3}, certify and check {:.3}",
            seconds(report.collapse_time),
            Counted(report.programs, "program"),
            seconds(report.sweep_time),
            seconds(report.certify_time)
        )?;
    }
    if let Some(report) = &built.tree {
        write!(out, ", box tree {:.3}", seconds(report.time))?;
    }
    if let Some(report) = &built.triboxes {
        write!(out, ", triboxes {:.3}", seconds(report.time))?;
    }
    if !built.tight.is_empty() {
        let time: Duration = built.tight.iter().map(|report| report.time).sum();
        write!(out, ", tight hulls {:.3}", seconds(time))?;
    }
    writeln!(out)
}
