//! Hulls that were written, for people and as JSON.

use crate::args::HullArgs;
use crate::failure::Failure;
use crate::mesh_report::{fields, write_repairs};
use crate::output::Output;
use meshsweep::counted::Counted;
use meshsweep::load::Loaded;
use meshsweep::number::{AtLeast, AtMost, Percent};
use serde_json::{Map, Value, json};
use std::io::{self, Write};
use std::path::Path;
use std::time::Duration;

/// A hull in the file.
#[derive(Default)]
pub struct Written {
    pub faces: usize,
    /// Volume beyond the mesh's, as a fraction of it, if the mesh has a volume.
    pub void: Option<f64>,
    /// No point of the hull is farther than this from the mesh.
    pub at_most: Option<f64>,
    /// One is at least as far as this.
    pub at_least: Option<f64>,
    /// Level of a blob, and the last one.
    pub level: Option<[u32; 2]>,
    pub time: Option<Duration>,
    pub notes: Vec<String>,
}

impl Written {
    /// `of` names what the hull encloses.
    fn write(&self, out: &mut dyn Write, of: &str) -> io::Result<()> {
        write!(out, "{}", Counted(self.faces, "face"))?;
        if let Some(void) = self.void {
            write!(out, ", {} % void space", Percent((100.0 * void).max(0.0)))?;
        }
        if let Some(distance) = self.at_most {
            write!(out, ", at most {} from the {of}", AtMost(distance))?;
        }
        if let Some(distance) = self.at_least {
            write!(out, " and in one place at least {}", AtLeast(distance))?;
        }
        if let Some([level, last]) = self.level {
            write!(out, ", level {level} of 0 to {last}")?;
        }
        if let Some(time) = self.time {
            write!(out, ", {:.3} s", time.as_secs_f64())?;
        }
        writeln!(out)?;
        self.notes.iter().try_for_each(|note| writeln!(out, "  {note}"))
    }

    fn as_json(&self) -> Value {
        json!({
            "faces": self.faces,
            "void_ratio": self.void,
            "hull_to_mesh": { "lower": self.at_least, "upper": self.at_most },
            "level": self.level.map(|[level, _]| level),
            "seconds": self.time.map(|time| time.as_secs_f64()),
            "notes": self.notes,
        })
    }
}

/// What the hulls are of: a mesh by its name, or a blob.
pub enum Of<'a> {
    Mesh(&'a Path, &'a Loaded),
    Blob,
}

/// Reports the hulls of a file, and notes on all of them.
pub fn report(
    args: &HullArgs,
    of: &Of<'_>,
    hulls: &[Written],
    notes: &[String],
) -> Result<(), Failure> {
    Output::stdout().finish(|out| {
        if args.json {
            serde_json::to_writer_pretty(&mut *out, &as_json(args, of, hulls, notes))?;
            return writeln!(out);
        }
        if let Of::Mesh(mesh, loaded) = of {
            write_repairs(out, mesh, loaded)?;
        }
        write!(out, "{}: ", args.output.display())?;
        match hulls {
            [hull] => hull.write(out, "mesh")?,
            _ => {
                let faces: usize = hulls.iter().map(|hull| hull.faces).sum();
                let (count, faces) = (Counted(hulls.len(), "hull"), Counted(faces, "face"));
                writeln!(out, "{count}, {faces} in all")?;
                hulls.iter().enumerate().try_for_each(|(index, hull)| {
                    write!(out, "  part {index}: ")?;
                    hull.write(out, "part")
                })?;
            }
        }
        notes.iter().try_for_each(|note| writeln!(out, "  {note}"))
    })
}

fn as_json(args: &HullArgs, of: &Of<'_>, hulls: &[Written], notes: &[String]) -> Value {
    let mut all = match of {
        Of::Mesh(mesh, loaded) => fields(mesh, loaded),
        Of::Blob => Map::from_iter([("blob".to_owned(), json!(args.input.display().to_string()))]),
    };
    let others = [
        ("output", json!(args.output.display().to_string())),
        ("hulls", hulls.iter().map(Written::as_json).collect()),
        ("notes", json!(notes)),
    ];
    all.extend(others.map(|(name, value)| (name.to_owned(), value)));
    Value::Object(all)
}
