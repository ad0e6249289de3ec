//! From a mesh to the hulls of a chain.

use super::distances::{Distances, distances};
use super::section::{Stored, sections};
use crate::emit::Sections;
use crate::mesh::Input;
use crate::surface::VertexBits;
use crate::tight::hull::{Hull, wrap};
use crate::tight::options::{self, Goal, Options, WrapError};
use crate::tight::proof::NoVolume;
use meshsweep_core::internal::format::layout::MAX_LEVELS;
use meshsweep_core::internal::num::Radius16;
use std::time::{Duration, Instant};

/// Most hulls of a blob.
pub const MAX_HULLS: usize = MAX_LEVELS as usize;

/// Which hulls to make, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct ChainOptions {
    /// Most faces of each hull, in any order.
    pub faces: Vec<usize>,
    /// What one hull has to reach, instead of numbers of faces.
    pub goal: Option<Goal>,
    /// Distance that every hull keeps from the mesh; see [`Options::margin`]. Answers about the
    /// mesh hold as they do without: of the margin they know nothing.
    pub margin: f64,
    /// How long to polish; see [`Options::effort`].
    pub effort: f64,
    /// Bits of a hull vertex. The mesh is not moved: only the hull's vertices lie on a grid.
    /// [`VertexBits::Auto`] takes 16 bits, which is what a leaf of a box tree stores, where
    /// the mesh leaves room for them.
    pub vertex_bits: VertexBits,
    /// Boxes for distances, which the hull's tree needs for questions about the mesh.
    pub closest: bool,
    /// Boxes for segments and overlap with the hull.
    pub segments: bool,
}

impl Default for ChainOptions {
    fn default() -> Self {
        Self {
            faces: vec![200],
            goal: None,
            margin: 0.0,
            effort: 1.0,
            vertex_bits: VertexBits::Auto,
            closest: true,
            segments: true,
        }
    }
}

/// Where the work stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// A hull, counted from 0 in the order in which they are made, is being wrapped.
    Wrapping {
        /// Number of the hull.
        hull: usize,
        /// Hulls to be made.
        of: usize,
        /// What is being done to it.
        progress: options::Progress,
    },
    /// Distances between a hull and the mesh are being certified.
    Certifying,
}

/// A hull of the chain, and what it took.
#[derive(Clone, Debug)]
pub struct HullReport {
    /// What was asked for.
    pub asked: Goal,
    /// What `wrap` says of the hull.
    pub wrapped: options::Report,
    /// Both ways between hull and mesh, input units.
    pub distances: Distances,
    /// Volume beyond that of the mesh as a part of it, or why the mesh has none to measure that
    /// against.
    pub void: Result<f64, NoVolume>,
    /// Bytes in the blob.
    pub bytes: usize,
    /// Time.
    pub time: Duration,
}

/// Wraps a mesh in tight hulls. Hulls that came out with as many faces as a finer one are left out:
/// what was asked for and no report names is one of these.
///
/// The hulls enclose the mesh where it is now, and the blob's answers hold for where it was in the
/// input. On a mesh, or hull, of more than [`MAX_TRIANGLES`](crate::bvh::MAX_TRIANGLES) it panics.
///
/// Cost: that of [`wrap()`] for each hull; some hundred distance queries for each triangle of the
/// hulls, one for each triangle of the mesh.
///
/// # Errors
/// [`WrapError`].
pub fn chain(
    input: Input<'_>,
    options: &ChainOptions,
    mut on_progress: impl FnMut(Stage),
) -> Result<(Sections, Vec<HullReport>), WrapError> {
    let Input { mesh, moved, .. } = input;
    let mut faces = options.faces.clone();
    faces.sort_unstable();
    faces.dedup();
    // A mesh that is to have no hull has the one that is made unless told otherwise.
    let faces: Vec<usize> = if faces.is_empty() { ChainOptions::default().faces } else { faces };
    let goals: Vec<Goal> = options
        .goal
        .map_or_else(|| faces.into_iter().map(Goal::Faces).collect(), |goal| vec![goal]);
    let of = goals.len();
    let wrap_options = |goal: Goal| Options {
        goal,
        margin: options.margin,
        effort: options.effort,
        vertex_bits: match options.vertex_bits {
            VertexBits::Auto => VertexBits::Grid16,
            bits => bits,
        },
        ..Options::default()
    };
    // Fine to coarse: of equal hulls the one that was asked for with more faces is kept.
    let mut made: Vec<(Hull, HullReport)> = Vec::new();
    let mut overlaps = false;
    for (index, &goal) in goals.iter().rev().enumerate() {
        let started = Instant::now();
        let mut show = |progress| on_progress(Stage::Wrapping { hull: index, of, progress });
        let hull = wrap(mesh, &wrap_options(goal), &mut show)?;
        if made
            .last()
            .is_some_and(|(finer, _)| finer.mesh.triangles.len() <= hull.mesh.triangles.len())
        {
            continue;
        }
        on_progress(Stage::Certifying);
        let mut distances = distances(&hull.mesh, mesh);
        if let Goal::Slack(_) = goal {
            // Proved face by face, which bounds of the farthest point are not as fine as.
            let most = hull.report.slack.upper;
            let slacks = distances.slacks.iter_mut().chain([&mut distances.slack.upper]);
            slacks.for_each(|slack| *slack = slack.min(most));
        }
        if !fits(&distances) {
            return Err(WrapError::NoRoom);
        }
        let void = hull.report.void;
        overlaps |= void == Err(NoVolume::Overlapping);
        let report = HullReport {
            asked: goal,
            wrapped: hull.report,
            distances,
            void,
            bytes: 0,
            time: started.elapsed(),
        };
        made.push((hull, report));
    }
    made.reverse();
    if overlaps {
        // What one hull proves of the mesh holds for all.
        made.iter_mut().for_each(|(_, report)| report.void = Err(NoVolume::Overlapping));
    }
    let stored: Vec<Stored> = made
        .iter_mut()
        .map(|(hull, report)| {
            // What `mesh` lost when it was read is a part of how far the hull may be from the
            // input.
            hull.mesh.rounding = mesh.rounding;
            let stored = Stored::new(&hull.mesh, moved, report, options);
            report.bytes = stored.bytes();
            stored
        })
        .collect();
    let tables = sections(input, &stored);
    Ok((tables, made.into_iter().map(|(_, report)| report).collect()))
}

/// Whether all distances are numbers of the format. Two bytes end a little before single precision
/// does.
fn fits(distances: &Distances) -> bool {
    let all = distances.slacks.iter().chain([&distances.slack.upper, &distances.depth.upper]);
    all.into_iter().all(|&distance| Radius16::round_up(distance).get().is_finite())
}
