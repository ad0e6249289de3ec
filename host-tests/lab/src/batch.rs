//! `cargo xtask race --batch BLOB POINTS`: the time of closest points by one batch, for a race of
//! the Python package with the Rust that it calls.

use std::fs;
use std::path::Path;
use std::time::Instant;

use meshsweep::bvh::closest_points;
use meshsweep_core::{Budget, Bvh};

/// Runs, of which the fastest counts.
const RUNS: usize = 3;

/// Seconds of the fastest of three runs, exact, on all threads of rayon. `points` has three f32 a
/// point, the lowest byte first.
///
/// # Errors
/// A file that cannot be read; a blob without boxes for closest points; a file of points that has
/// none, or a part of one; a point that is refused.
pub fn seconds(blob: &Path, points: &Path) -> Result<f64, String> {
    let read = |path: &Path| fs::read(path).map_err(|error| format!("{}: {error}", path.display()));
    let (bytes, points) = (read(blob)?, read(points)?);
    let (all, rest) = points.as_chunks::<12>();
    if all.is_empty() || !rest.is_empty() {
        return Err(format!("{} bytes of points: a multiple of 12 is wanted", points.len()));
    }
    let coordinate = |bytes: &[u8; 4]| f32::from_le_bytes(*bytes);
    let coordinates: Vec<f32> = all.as_flattened().as_chunks().0.iter().map(coordinate).collect();
    let tree = Bvh::open(&bytes).map_err(|error| error.to_string())?;
    let mut fastest = f64::INFINITY;
    for _ in 0..RUNS {
        let begun = Instant::now();
        let answers = closest_points(&tree, coordinates.as_chunks().0, &Budget::EXACT);
        fastest = fastest.min(begun.elapsed().as_secs_f64());
        answers.map_err(|refused| refused.to_string())?;
    }
    Ok(fastest)
}
