//! `meshsweep build`: a mesh file in, a blob and a report out.

use crate::args::BuildArgs;
use crate::failure::Failure;
use crate::output::{Output, refuse_same_file};
use crate::progress::StageBars;
use crate::trade::choose::{self, Chosen};
use crate::{describe, mesh_file, mesh_report, source};
use meshsweep::Built;
use meshsweep::builder::{Note, Topic};
use meshsweep::counted::Counted;
use meshsweep_core::Blob;
use serde_json::{Map, Value, json};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

pub fn run(args: &BuildArgs) -> Result<(), Failure> {
    let builder = args.builder();
    let mesh = mesh_file::named(&args.mesh, &args.read)?;
    let failed = |error| Failure::build(&mesh, error);
    refuse_options(args).map_or(Ok(()), |what| Err(Failure::Usage { what }))?;
    builder.check(&mesh).map_err(failed)?;
    let inputs: Vec<&Path> =
        [&args.mesh].into_iter().chain(&args.frames).map(PathBuf::as_path).collect();
    mesh_file::check_format(&inputs, &args.read)?;
    refuse_same_file(Some(&args.output), &inputs)?;
    Output::probe(&args.output)?;
    source::probe(args, &inputs)?;
    args.threads.start();
    let (built, chosen) = if args.limits.given().is_some() {
        let (built, chosen) = choose::choose(args)?;
        (built, Some(chosen))
    } else {
        let mut bars = StageBars::default();
        let builder = builder.on_progress(|stage, _| bars.show(stage));
        let built = match mesh_file::stdin_bytes(&args.mesh)? {
            Some(bytes) => builder.build_bytes(&mesh, bytes),
            None => builder.build_file(&mesh),
        };
        (built.map_err(failed)?, None)
    };
    for note in built.report_on(Topic::Winding) {
        // A closed standard error is no failure.
        let _ = writeln!(io::stderr(), "{}: {note}", mesh.display());
    }
    let blob = built.blob();
    source::write(args, &mesh, &blob)?;
    let report = Report { args, mesh: &mesh, built: &built, blob: &blob, chosen: chosen.as_ref() };
    Output::stdout().finish(|out| match args.json {
        true => {
            serde_json::to_writer_pretty(&mut *out, &report.as_json())?;
            writeln!(out)
        }
        false => report.write(out),
    })
}

/// Why limits do not go together with other options, if they do not.
fn refuse_options(args: &BuildArgs) -> Option<String> {
    match args.limits.given() {
        Some(option) => {
            let other = match args.chosen_option()? {
                "--for" => "--for, or give it one of closest and segment",
                other => other,
            };
            Some(format!("{option} chooses structure and dials; leave out {other}"))
        }
        None if args.limits.cpu.is_some() || args.limits.at.is_some() => {
            Some("--cpu and --at go with --flash, --ram, --error or --rate".to_owned())
        }
        None => None,
    }
}

/// The report of the command.
struct Report<'a> {
    args: &'a BuildArgs,
    mesh: &'a Path,
    built: &'a Built,
    blob: &'a Blob<'a>,
    chosen: Option<&'a Chosen>,
}

impl Report<'_> {
    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let &Self { args, mesh, built, blob, chosen } = self;
        let indented = |out: &mut dyn Write, topic| {
            built.report_on(topic).try_for_each(|note| writeln!(out, "  {note}"))
        };
        writeln!(out, "{}", mesh.display())?;
        indented(out, Topic::Input)?;
        chosen.map_or(Ok(()), |chosen| choose::write(out, chosen))?;
        writeln!(out, "{}", args.output.display())?;
        source::report(args, out)?;
        indented(out, Topic::Hull)?;
        describe::write_blob(out, blob)?;
        indented(out, Topic::BoxTree)?;
        built.report_on(Topic::Sides).try_for_each(|note| writeln!(out, "{note}"))?;
        indented(out, Topic::Triboxes)?;
        indented(out, Topic::Tight)?;
        indented(out, Topic::Sdf)?;
        chosen.map_or_else(|| self.write_seconds(out), |_| Ok(()))
    }

    fn write_seconds(&self, out: &mut dyn Write) -> io::Result<()> {
        let programs = self.built.hull.as_ref().map(|report| Counted(report.programs, "program"));
        let said = self.seconds().into_iter().map(|(part, time)| match (part, &programs) {
            ("collapse", Some(programs)) => format!("{part} {time:.3} ({programs})"),
            _ => format!("{part} {time:.3}"),
        });
        writeln!(out, "seconds: {}", said.collect::<Vec<_>>().join(", "))
    }

    /// Seconds of the parts of the build.
    fn seconds(&self) -> Vec<(&'static str, f64)> {
        let Built { curve, loaded, hull, tree, triboxes, tight, sdf, .. } = self.built;
        let mut parts: Vec<(&str, Duration)> = Vec::new();
        parts.extend(curve.iter().map(|report| ("hierarchy", report.time)));
        parts.extend(loaded.iter().map(|loaded| ("read and repair", loaded.time)));
        parts.extend(hull.iter().flat_map(|report| {
            [
                ("collapse", report.collapse_time),
                ("sweep", report.sweep_time),
                ("certify and check", report.certify_time),
            ]
        }));
        parts.extend(tree.iter().map(|report| ("box tree", report.time)));
        parts.extend(triboxes.iter().map(|report| ("triboxes", report.time)));
        if !tight.is_empty() {
            parts.push(("tight hulls", tight.iter().map(|report| report.time).sum()));
        }
        parts.extend(sdf.iter().map(|report| ("distance field", report.time)));
        parts.into_iter().map(|(part, time)| (part, time.as_secs_f64())).collect()
    }

    fn as_json(&self) -> Value {
        let &Self { args, mesh, built, blob, chosen } = self;
        let loaded = built.loaded.as_ref().or(chosen.and_then(|chosen| chosen.loaded.as_ref()));
        let mut fields = match loaded {
            Some(loaded) => mesh_report::fields(mesh, loaded),
            None => Map::from_iter([("curves".to_owned(), json!(mesh.display().to_string()))]),
        };
        let options = match chosen {
            Some(chosen) => {
                let unit = args.read.unit.map(|unit| format!("--unit {} ", unit.symbol()));
                unit.unwrap_or_default() + &chosen.options()
            }
            None => args.builder().to_string(),
        };
        let note = |note: &Note| json!({ "topic": note.topic.name(), "text": note.text });
        let others = [
            ("options", json!(options)),
            ("notes", built.report().map(note).collect()),
            ("blob", json!(args.output.display().to_string())),
            ("sources", source::names(args)),
            ("chosen", chosen.map_or(Value::Null, choose::as_json)),
            ("contents", describe::as_json(blob)),
            ("seconds", self.seconds().into_iter().map(in_json).collect()),
        ];
        fields.extend(others.map(|(name, value)| (name.to_owned(), value)));
        Value::Object(fields)
    }
}

/// A part of the build, as a name of JSON.
fn in_json((part, seconds): (&str, f64)) -> (String, Value) {
    (part.replace(' ', "_"), json!(seconds))
}
