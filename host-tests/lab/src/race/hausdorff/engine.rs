//! The engines, and what each answers.

use meshsweep::hausdorff::{Direction, Precision, hausdorff};
use meshsweep::mesh::Mesh;
use meshsweep_host_tests::workload::Subject;

use super::cgal::Cgal;
use super::side::Side;
use super::{samples, search};
use crate::measure::stopwatch::Stopwatch;

/// Precision, as a part of the diagonal of the box about both meshes.
pub const PRECISION: f64 = 1e-6;

/// One answer, and the work of it.
#[derive(Clone, Copy, Debug)]
pub struct Answer {
    /// Least distance.
    pub lower: f64,
    /// Greatest.
    pub upper: f64,
    /// Processor time.
    pub seconds: f64,
    /// The part of it that builds trees.
    pub tree_seconds: Option<f64>,
    /// Pieces of triangles.
    pub pieces: Option<usize>,
    /// Closest points.
    pub asked: Option<usize>,
}

impl Answer {
    /// Whether both may be true.
    pub fn overlaps(&self, other: &Self) -> bool {
        self.lower <= other.upper && other.lower <= self.upper
    }
}

/// An engine.
pub enum Engine {
    /// The library's search.
    Ours,
    /// Guéziec's.
    Bisectors,
    /// CGAL's.
    Cgal(Cgal),
}

impl Engine {
    /// In tables.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Ours => "branch and bound (ours)",
            Self::Bisectors => "spiral and bisectors",
            Self::Cgal(_) => "CGAL, bounded error",
        }
    }

    /// The distance, and what it took.
    ///
    /// # Errors
    /// The engine's refusal.
    pub fn ask(
        &mut self,
        meshes: &[Subject; 2],
        side: Side,
        precision: f64,
    ) -> Result<Answer, String> {
        let pair = [&meshes[0].mesh, &meshes[1].mesh];
        let found = match self {
            Self::Ours => return ours(pair, side, precision),
            Self::Cgal(cgal) => {
                let (value, seconds) = cgal.distance(side, precision)?;
                let (lower, upper) = (value - precision, value + precision);
                let (tree_seconds, pieces, asked) = (None, None, None);
                return Ok(Answer { lower, upper, seconds, tree_seconds, pieces, asked });
            }
            Self::Bisectors => timed(|| search::search(pair, side, precision)),
        };
        let (search::Found { lower, upper, pieces, asked, tree_seconds }, seconds) = found?;
        let tree_seconds = Some(tree_seconds);
        let (pieces, asked) = (Some(pieces), Some(asked));
        Ok(Answer { lower, upper, seconds, tree_seconds, pieces, asked })
    }
}

fn timed<T>(run: impl FnOnce() -> Result<T, String>) -> Result<(T, f64), String> {
    let watch = Stopwatch::start();
    let answer = run()?;
    Ok((answer, watch.seconds()))
}

/// The library's answer.
///
/// # Errors
/// The library's refusal.
pub fn ours([first, second]: [&Mesh; 2], side: Side, precision: f64) -> Result<Answer, String> {
    let precision = Precision { relative: 0.0, absolute: precision, at_most: None };
    let (from, to, direction) = match side {
        Side::Forward => (first, second, Direction::Forward),
        Side::Backward => (second, first, Direction::Forward),
        Side::Both => (first, second, Direction::Both),
    };
    let (found, seconds) = timed(|| {
        hausdorff(from, to, direction, &precision, &mut |_, _| ())
            .map_err(|refused| refused.error.to_string())
    })?;
    // The search builds its trees itself: the same ones are built again.
    let (_, tree_seconds) = timed(|| {
        side.sources().iter().try_for_each(|&from| {
            samples::tree([first, second][1 - from], [first, second][from]).map(drop)
        })
    })?;
    let vertices: usize =
        side.sources().iter().map(|&from| [first, second][from].positions.len()).sum();
    Ok(Answer {
        lower: found.lower,
        upper: found.upper,
        seconds,
        tree_seconds: Some(tree_seconds),
        pieces: Some(found.pieces),
        asked: Some(vertices + found.pieces),
    })
}
