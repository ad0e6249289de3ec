//! `meshsweep tribox`: a mesh as unions of 1, 2, 4, … triboxes, the error of each, and the finest
//! one as binary PLY.

use crate::args::TriboxArgs;
use crate::failure::Failure;
use crate::mesh_file;
use crate::mesh_report::{fields, write_rounding};
use crate::output::{Output, refuse_other_extension, refuse_same_file};
use meshsweep::BuildError;
use meshsweep::counted::Counted;
use meshsweep::load::Loaded;
use meshsweep::mesh::write_ply;
use meshsweep::number::{About, AtLeast, AtMost, Percent, Short};
use meshsweep::tribox::{Gain, Grown, Level, Total, Turn, volume};
use serde_json::{Value, json};
use std::io::{self, Write};
use std::path::Path;
use std::time::{Duration, Instant};

pub fn run(args: &TriboxArgs) -> Result<(), Failure> {
    mesh_file::check_format(&[&args.mesh], &args.read)?;
    let mesh = mesh_file::named(&args.mesh, &args.read)?;
    args.threads.start();
    if let Some(output) = &args.output {
        refuse_other_extension(output, "ply", "triboxes are written as PLY")?;
        refuse_same_file(Some(output), &[&args.mesh])?;
        Output::probe(output)?;
    }
    let loaded = mesh_file::load(&args.mesh, &args.read)?;
    let started = Instant::now();
    let (grown, gains) = split(args, &loaded).map_err(|error| Failure::build(&mesh, error))?;
    let split_time = started.elapsed();
    let started = Instant::now();
    let levels = levels(args, &grown).map_err(|error| Failure::build(&mesh, error))?;
    let report = Report {
        args,
        mesh: &mesh,
        loaded: &loaded,
        solid: grown.hierarchy.is_solid.then(|| volume(&loaded.mesh)),
        grown: &grown,
        gains: &gains,
        levels: &levels,
        split_time,
        measure_time: started.elapsed(),
    };
    if let Some(output) = &args.output {
        let mesh = grown.surface();
        Output::file(output)?.finish(|out| write_ply(&mesh, out))?;
    }
    Output::stdout().finish(|out| {
        if args.json {
            serde_json::to_writer_pretty(&mut *out, &report.as_json())?;
            writeln!(out)
        } else {
            report.write(out)
        }
    })
}

/// The mesh as it is split, and what each option gained, by the option as it was typed.
fn split<'a>(
    args: &TriboxArgs,
    loaded: &'a Loaded,
) -> Result<(Grown<'a>, Vec<(String, Gain)>), BuildError> {
    let (grown, oriented) = Grown::new(&loaded.mesh, &args.options(), args.split.orient)?;
    let mut gains = Vec::new();
    if args.split.extrema {
        let (plain, _) = Grown::new(&loaded.mesh, &args.plain(), None)?;
        let is_by_error = args.split.tribox_error.is_some();
        let gain = Gain::of_planes(&plain.hierarchy, &grown.hierarchy, oriented, is_by_error);
        gains.push(("--extrema".to_owned(), gain));
    }
    if let (Some(measure), Some(gain)) = (args.split.orient, oriented) {
        gains.push((format!("--orient {}", measure.name()), gain));
    }
    Ok((grown, gains))
}

/// Levels of 1, 2, 4, … triboxes, until there are no more.
fn levels(args: &TriboxArgs, grown: &Grown<'_>) -> Result<Vec<Level>, BuildError> {
    let mut levels: Vec<Level> = Vec::new();
    for number in 0..args.levels() {
        let level = grown.level(1 << number)?;
        if levels.last().is_some_and(|last| last.triboxes == level.triboxes) {
            break;
        }
        levels.push(level);
    }
    Ok(levels)
}

struct Report<'a> {
    args: &'a TriboxArgs,
    mesh: &'a Path,
    loaded: &'a Loaded,
    /// Volume of the mesh, if it bounds a solid.
    solid: Option<f64>,
    grown: &'a Grown<'a>,
    /// What each option gained.
    gains: &'a [(String, Gain)],
    levels: &'a [Level],
    split_time: Duration,
    measure_time: Duration,
}

impl Report<'_> {
    fn faces_of_mesh(&self) -> usize {
        self.loaded.mesh.triangles.len()
    }

    /// Triangles of the mesh for each face; of a mesh without area, neither has any.
    fn compression(&self, level: &Level) -> Option<f64> {
        (level.faces > 0).then(|| self.faces_of_mesh() as f64 / level.faces as f64)
    }

    /// Void as a fraction of the solid.
    fn void(&self, level: &Level) -> Option<f64> {
        self.solid.filter(|&volume| volume > 0.0).map(|volume| level.void(volume))
    }

    fn measure(&self) -> &'static str {
        self.grown.hierarchy.measure.name()
    }

    fn is_exhausted(&self) -> bool {
        self.levels.last().is_some_and(|level| level.triboxes < 1 << (self.args.levels() - 1))
    }

    /// What --tribox-error reached.
    fn reached(&self) -> Option<String> {
        let wanted = self.args.split.tribox_error?;
        let reached = self.grown.largest_error();
        Some(if reached <= wanted {
            format!("each tribox is within {wanted} of the convex hull of what it holds")
        } else {
            format!(
                "a tribox is up to {} from the convex hull of what it holds, more than {wanted}: \
                 more --levels may come nearer, up to the rounding of planes",
                AtMost(reached)
            )
        })
    }

    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let Report { args, mesh, loaded, .. } = self;
        write!(out, "{}: {}, ", mesh.display(), Counted(self.faces_of_mesh(), "triangle"))?;
        match self.solid {
            Some(volume) => writeln!(out, "closed, volume {}", About(volume))?,
            None => writeln!(out, "not closed: triboxes hold its surface, not an inside")?,
        }
        if loaded.report.is_clean() {
            write_rounding(out, mesh, &loaded.report)?;
        } else {
            writeln!(out, "  {}", loaded.report)?;
        }
        loaded.unit_note().map_or(Ok(()), |note| writeln!(out, "  {note}"))?;
        writeln!(
            out,
            "triboxes   faces compression      volume    void %  hull error  largest distance to \
             the mesh"
        )?;
        for level in self.levels {
            let dash = || "-".to_owned();
            let compression =
                self.compression(level).map_or_else(dash, |ratio| format!("{ratio:.2}"));
            let void = self.void(level).map_or_else(dash, |void| Percent(void * 100.0).to_string());
            writeln!(
                out,
                "{:>8} {:>7} {:>11} {:>11} {:>9} {:>11}  {} to {}",
                level.triboxes,
                level.faces,
                compression,
                About(level.volume),
                void,
                AtMost(level.error),
                AtLeast(level.distance.lower),
                AtMost(level.distance.upper)
            )?;
        }
        if let Some(Turn { rows }) = self.grown.turn {
            let rows = rows.map(|row| row.map(|x| Short(x).to_string()).join(" "));
            writeln!(out, "turned by the rotation {}", rows.join(" / "))?;
        }
        for (option, gain) in self.gains {
            writeln!(out, "{}", gain.said(option, self.solid))?;
        }
        if let Some(reached) = self.reached() {
            writeln!(out, "{reached}")?;
        } else if self.is_exhausted() {
            writeln!(out, "no further split saves enough {}", self.measure())?;
        }
        if let Some(output) = &args.output {
            writeln!(out, "{}: the last level", output.display())?;
        }
        writeln!(
            out,
            "seconds: read and repair {:.3}, split {:.3}, measure {:.3}",
            loaded.time.as_secs_f64(),
            self.split_time.as_secs_f64(),
            self.measure_time.as_secs_f64()
        )
    }

    fn as_json(&self) -> Value {
        let level = |level: &Level| {
            json!({
                "triboxes": level.triboxes,
                "faces": level.faces,
                "compression": self.compression(level),
                "volume": level.volume,
                "void_ratio": self.void(level),
                "hull_error": level.error,
                "distance": { "lower": level.distance.lower, "upper": level.distance.upper },
            })
        };
        let total = |total: &Total| {
            json!({
                "triboxes": total.triboxes,
                "faces": total.faces,
                "area": total.extent.area,
                "volume": total.extent.volume,
                "void_ratio": self.solid.filter(|&solid| solid > 0.0).map(|solid| total.void(solid)),
            })
        };
        let gain = |(option, gain): &(String, Gain)| {
            json!({
                "option": option,
                "is_gain": gain.is_gain,
                "before": total(&gain.before),
                "after": gain.after.as_ref().map(total),
            })
        };
        let mut fields = fields(self.mesh, self.loaded);
        let output = self.args.output.as_ref().map(|output| output.display().to_string());
        let others = [
            ("output", json!(output)),
            ("is_closed", json!(self.grown.hierarchy.is_solid)),
            ("volume", json!(self.solid)),
            ("measure", json!(self.measure())),
            ("levels", self.levels.iter().map(level).collect()),
            ("orientation", json!(self.grown.turn.map(|turn| turn.rows))),
            ("gains", self.gains.iter().map(gain).collect()),
            ("is_exhausted", json!(self.is_exhausted())),
        ];
        fields.extend(others.map(|(name, value)| (name.to_owned(), value)));
        Value::Object(fields)
    }
}
