//! The loop of Guéziec's way: the triangle with the largest bound is cut next.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use glam::{DVec3, Vec3};
use meshsweep::mesh::Mesh;

use super::bisector::{bound, cut, visit};
use super::samples::{Sample, Sampler, tree};
use super::side::Side;
use crate::measure::stopwatch::Stopwatch;

/// Added to an upper bound and taken off a lower one, as a part of the largest coordinate. It
/// covers the roundings of samples, cuts and bounds in f64, which are some 2^-50 each.
const ROUNDING: f64 = 1.0 / (1u64 << 36) as f64;

/// Most pieces: a piece and its samples take some hundred bytes.
const MOST_PIECES: usize = 4_000_000;

/// Bounds of a distance, and the work.
#[derive(Clone, Copy, Debug)]
pub struct Found {
    /// Not above the distance.
    pub lower: f64,
    /// Not below the distance.
    pub upper: f64,
    /// Pieces that were bounded, the triangles included.
    pub pieces: usize,
    /// Closest points that were asked for.
    pub asked: usize,
    /// Seconds of the box trees.
    pub tree_seconds: f64,
}

struct Piece {
    bound: f64,
    /// The mesh whose part it is.
    mesh: usize,
    /// In the mesh's samples.
    samples: [u32; 3],
}

impl Ord for Piece {
    fn cmp(&self, other: &Self) -> Ordering {
        self.bound.total_cmp(&other.bound)
    }
}
impl PartialOrd for Piece {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl PartialEq for Piece {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}
impl Eq for Piece {}

/// The Hausdorff distance of two meshes, to `precision`.
///
/// # Errors
/// The builder's refusal of a mesh.
pub fn search(meshes: [&Mesh; 2], side: Side, precision: f64) -> Result<Found, String> {
    let watch = Stopwatch::start();
    let blobs: Vec<(usize, Vec<u8>)> = (side.sources().iter())
        .map(|&from| Ok((from, tree(meshes[1 - from], meshes[from])?)))
        .collect::<Result<_, String>>()?;
    let tree_seconds = watch.seconds();
    let coordinates = meshes.iter().flat_map(|mesh| mesh.positions.as_flattened());
    let rounding = ROUNDING * f64::from(coordinates.fold(0f32, |most, x| most.max(x.abs())));
    let mut samplers = Vec::new();
    let mut samples: [Vec<Sample>; 2] = Default::default();
    for (from, blob) in &blobs {
        let mut sampler = Sampler::new(blob, meshes[1 - from])?;
        let points: Vec<DVec3> =
            meshes[*from].positions.iter().map(|&p| Vec3::from(p).as_dvec3()).collect();
        let triangles: Vec<[u32; 3]> = meshes[*from].all_triangles().collect();
        samples[*from] = visit(&points, &triangles, &mut sampler)?;
        samplers.push((*from, sampler));
    }
    let mut lower = 0.0;
    for (from, sampler) in &mut samplers {
        // A vertex of no triangle is no point of the surface.
        for v in meshes[*from].all_triangles().flatten() {
            lower = raised(lower, &samples[*from][v as usize], sampler)?;
        }
    }
    let (mut heap, mut pieces) = (BinaryHeap::new(), 0);
    for (mesh, _) in &samplers {
        for corners in meshes[*mesh].all_triangles() {
            let of = corners.map(|v| &samples[*mesh][v as usize]);
            let bound = finite(bound(of));
            pieces += 1;
            if bound > lower {
                heap.push(Piece { bound, mesh: *mesh, samples: corners });
            }
        }
    }
    let upper = loop {
        let upper = heap.peek().map_or(lower, |piece| piece.bound.max(lower));
        if upper - lower + 2.0 * rounding <= precision || pieces > MOST_PIECES {
            break upper;
        }
        let Some(piece) = heap.pop() else { break upper };
        let Some((_, sampler)) = samplers.iter_mut().find(|(from, _)| *from == piece.mesh) else {
            break upper;
        };
        let known = &mut samples[piece.mesh];
        let corners = piece.samples.map(|sample| known[sample as usize].point);
        let (points, parts) = cut(corners);
        let first = known.len() as u32;
        for point in points {
            let sample = sampler.sample(point)?;
            lower = raised(lower, &sample, sampler)?;
            known.push(sample);
        }
        for part in parts {
            let part = part.map(|k| if k < 3 { piece.samples[k] } else { first + k as u32 - 3 });
            let of = part.map(|sample| &known[sample as usize]);
            let bound = finite(bound(of)).min(piece.bound);
            pieces += 1;
            if bound > lower {
                heap.push(Piece { bound, mesh: piece.mesh, samples: part });
            }
        }
    };
    let asked = samplers.iter().map(|(_, sampler)| sampler.asked).sum();
    let (lower, upper) = ((lower - rounding).max(0.0), upper + rounding);
    Ok(Found { lower, upper, pieces, asked, tree_seconds })
}

/// The greater of a lower bound and a sample's distance.
fn raised(lower: f64, sample: &Sample, sampler: &mut Sampler<'_>) -> Result<f64, String> {
    if sample.upper <= lower { Ok(lower) } else { Ok(lower.max(sampler.exact(sample)?)) }
}

/// A bound that is not a number bounds nothing.
fn finite(bound: f64) -> f64 {
    if bound.is_nan() { f64::INFINITY } else { bound }
}
