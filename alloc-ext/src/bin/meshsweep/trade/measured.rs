//! The standard settings of a mesh, measured with a progress bar.

use crate::args::{At, Given, ReadArgs};
use crate::failure::Failure;
use crate::mesh_file;
use crate::progress::Bar;
use crate::queries::Queries;
use meshsweep::load::Loaded;
use meshsweep::trade::{self, Points, Trade};
use std::path::Path;
use std::sync::Mutex;

/// A measurement, and what it is of.
pub struct Measured {
    pub trade: Trade,
    /// Of the mesh's box.
    pub diagonal: f64,
    /// Number of points.
    pub points: usize,
    /// Their kind, in words.
    pub kind: String,
}

/// Measures the standard settings.
pub fn measured(
    file: &Path,
    args: &ReadArgs,
    at: &At,
    count: usize,
) -> Result<(Loaded, Measured), Failure> {
    let source = mesh_file::read(file, args)?;
    let loaded = source.repaired().map_err(|error| Failure::build(file, error))?;
    let mesh = &loaded.mesh;
    let (points, kind, words) = match at {
        At::Made(kind) => (trade::points(mesh, *kind, count), Some(*kind), said(*kind).to_owned()),
        At::File(path) => {
            let queries = Queries::<3>::read(&[Given::File(path.clone())])?;
            if let Some(failure) = queries.broken {
                return Err(failure);
            }
            (queries.rows, None, format!("of {}", path.display()))
        }
    };
    if points.is_empty() {
        let what = format!("{}: there are no points to ask at", file.display());
        return Err(Failure::Usage { what });
    }
    let diagonal = trade::diagonal(mesh);
    let settings = trade::standard(diagonal, mesh.triangles.len(), kind);
    // Its length is known at the first step.
    let bar = Mutex::new(None);
    let progress = |done, of| {
        if let Ok(mut bar) = bar.lock() {
            bar.get_or_insert_with(|| Bar::new(of, "measuring", "steps")).show(done);
        }
    };
    let trade = trade::measure(&source, &loaded, &points, &settings, &progress)
        .map_err(|error| Failure::Search { file: file.to_owned(), error })?;
    drop(bar);
    Ok((loaded, Measured { trade, diagonal, points: points.len(), kind: words }))
}

fn said(points: Points) -> &'static str {
    match points {
        Points::Far => "far: in a box twice the mesh's",
        Points::Near => "near the surface",
        Points::Path => "along a path near the surface",
    }
}
