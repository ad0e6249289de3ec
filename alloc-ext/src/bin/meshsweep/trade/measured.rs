//! The standard settings of a mesh, measured with a progress bar.

use crate::args::{At, Given, ReadArgs};
use crate::failure::Failure;
use crate::mesh_file;
use crate::progress::SharedBar;
use crate::queries::Queries;
use meshsweep::load::Loaded;
use meshsweep::trade::{self, Points, Question, Trade};
use std::path::Path;

/// A measurement, and what it is of.
pub struct Measured {
    pub trade: Trade,
    /// Of the mesh's box.
    pub diagonal: f64,
    pub question: Question,
    /// Number of points or segments.
    pub points: usize,
    /// Their kind, in words.
    pub kind: String,
}

/// Measures the standard settings.
pub fn measured(
    file: &Path,
    args: &ReadArgs,
    question: Question,
    at: &At,
    count: usize,
) -> Result<(Loaded, Measured), Failure> {
    let source = mesh_file::read(file, args)?;
    let loaded = source.repaired().map_err(|error| Failure::build(file, error))?;
    let mesh = &loaded.mesh;
    let (points, kind, words) = match (at, question) {
        (At::Made(kind), Question::FirstHit) => {
            (trade::segments(mesh, *kind, count), Some(*kind), said_of_segments(*kind).to_owned())
        }
        (At::File(path), Question::FirstHit) => (rows_of::<6>(path)?, None, of_file(path)),
        (At::Made(kind), _) => {
            (trade::points(mesh, *kind, count), Some(*kind), said(*kind, "mesh"))
        }
        (At::File(path), _) => (rows_of::<3>(path)?, None, of_file(path)),
    };
    if points.is_empty() {
        return Err(say_nothing(file));
    }
    let diagonal = trade::diagonal(mesh);
    let settings = match question {
        Question::FirstHit => trade::standard_of_segments(),
        _ => trade::standard(diagonal, mesh.triangles.len(), kind),
    };
    let bar = SharedBar::new("measuring", "steps");
    let progress = |done, of| bar.show(done, of);
    let trade = trade::measure(&source, &loaded, &points, &settings, &progress)
        .map_err(|error| Failure::Search { file: file.to_owned(), error })?;
    drop(bar);
    let points = points.len() / question.points();
    Ok((loaded, Measured { trade, diagonal, question, points, kind: words }))
}

/// All numbers of a file, in points.
pub fn rows_of<const N: usize>(path: &Path) -> Result<Vec<[f32; 3]>, Failure> {
    let queries = Queries::<N>::read(&[Given::File(path.to_owned())])?;
    match queries.broken {
        Some(failure) => Err(failure),
        None => Ok(queries.rows.as_flattened().as_chunks().0.to_vec()),
    }
}

/// There are no points.
pub fn say_nothing(file: &Path) -> Failure {
    Failure::Usage { what: format!("{}: there is nothing to ask at", file.display()) }
}

fn of_file(path: &Path) -> String {
    format!("of {}", path.display())
}

fn said_of_segments(points: Points) -> &'static str {
    match points {
        Points::Far => "between two sides of a box twice the mesh's",
        Points::Near => "from near the surface, a tenth of the diagonal long",
        Points::Path => "of a path near the surface",
    }
}

/// The kind of points about a mesh or a curve, in words.
pub fn said(points: Points, of: &str) -> String {
    let surface = if of == "mesh" { "surface" } else { of };
    match points {
        Points::Far => format!("far: in a box twice the {of}'s"),
        Points::Near => format!("near the {surface}"),
        Points::Path => format!("along a path near the {surface}"),
    }
}
