//! `meshsweep trade --report`: one page with its data, its script and the library that draws it.
//!
//! ```text
//! rows ─────────────────── table::as_json ─┐
//! blobs ─┬─ intervals on a path ─ path ────┼─ JSON ─ page.html ─ page.js ─ plotly
//!        ├─ bodies, worst queries ─ scene ─┤
//!        └─ slices of the field ─ slices ──┘
//! ```
//! The library is the build of plotly.js for three dimensions, unchanged: `plotly-gl3d.min.js` of
//! `plotly.js-gl3d-dist-min` 4.1.1 from the npm registry, MIT, by `gzip -9n`. The browser unpacks
//! it. The page asks the network for nothing, and its content security policy forbids it.

mod drawn;
mod path;
mod scene;
mod slices;

use super::measured::Measured;
use super::quoted;
use super::table;
use crate::failure::Failure;
use crate::output::Output;
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use meshsweep::load::Loaded;
use meshsweep::mesh::Unit;
use serde_json::{Value, json};
use std::io::{self, Write};
use std::path::Path;

const PAGE: &str = include_str!("report/page.html");
const SCRIPT: &str = include_str!("report/page.js");
const PLOTLY: &[u8] = include_bytes!("report/plotly-gl3d.min.js.gz");
const LICENSE: &str = include_str!("report/plotly.LICENSE");

/// Writes the page of a measurement.
pub fn write(
    place: &Path,
    mesh: &Path,
    loaded: &Loaded,
    measured: &Measured,
) -> Result<(), Failure> {
    let failed = |error| Failure::Search { file: mesh.to_owned(), error };
    let asked = path::asked(measured);
    let data = json!({
        "name": mesh.file_name().unwrap_or(mesh.as_os_str()).to_string_lossy(),
        "command": command(),
        "program": env!("CARGO_PKG_VERSION"),
        "unit": loaded.unit.map(Unit::symbol),
        "triangles": loaded.mesh.triangles.len(),
        "trade": table::as_json(loaded, measured),
        "path": path::as_json(loaded, measured, &asked).map_err(failed)?,
        "scene": scene::as_json(loaded, measured, &asked).map_err(failed)?,
        "field": slices::as_json(measured).map_err(failed)?,
    });
    Output::file(place)?.finish(|out| fill(out, &data))
}

/// The page, each mark replaced by its content.
fn fill(out: &mut dyn Write, data: &Value) -> io::Result<()> {
    // No end of a script element may stand in a script element.
    let data = data.to_string().replace('<', "\\u003c");
    let library = BASE64_STANDARD.encode(PLOTLY);
    let mut rest = PAGE;
    for (mark, content) in
        [("@LICENSE@", LICENSE), ("@DATA@", &data), ("@LIBRARY@", &library), ("@SCRIPT@", SCRIPT)]
    {
        let (before, after) = rest.split_once(mark).ok_or(io::ErrorKind::InvalidData)?;
        out.write_all(before.as_bytes())?;
        out.write_all(content.as_bytes())?;
        rest = after;
    }
    out.write_all(rest.as_bytes())
}

/// The command that runs, as a shell reads it.
fn command() -> String {
    let words = std::env::args_os().skip(1).map(|word| quoted(&word));
    std::iter::once("meshsweep".to_owned()).chain(words).collect::<Vec<_>>().join(" ")
}

/// Numbers as the script reads them: little-endian, in base64.
fn floats(values: impl IntoIterator<Item = f32>) -> Value {
    let bytes: Vec<u8> = values.into_iter().flat_map(f32::to_le_bytes).collect();
    json!({ "f32": BASE64_STANDARD.encode(bytes) })
}

/// The same of indices.
fn indices(values: impl IntoIterator<Item = u32>) -> Value {
    let bytes: Vec<u8> = values.into_iter().flat_map(u32::to_le_bytes).collect();
    json!({ "u32": BASE64_STANDARD.encode(bytes) })
}
