//! A chain of hulls of one mesh.

use super::distances::{Distances, distances_from};
use super::section::{Stored, sections};
use crate::bvh::TreeOptions;
use crate::clock::Instant;
use crate::emit::Sections;
use crate::error::BuildError;
use crate::mesh::Input;
use crate::mesh::NoVolume;
use crate::progress::{Stage, Watch};
use crate::surface::VertexBits;
use crate::tight::hull::{Hull, wrap_obstacle};
use crate::tight::options::{Goal, Options};
use crate::tight::report::Report;
use meshsweep_core::internal::format::layout::MAX_LEVELS;
use meshsweep_core::internal::num::Radius16;
use std::time::Duration;

/// Most hulls of a blob.
pub const MAX_HULLS: usize = MAX_LEVELS as usize;

/// Which hulls to make, and how.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ChainOptions {
    /// Most faces of each hull, in any order. If the list is empty, one hull is made.
    pub faces: Vec<usize>,
    /// How each hull is made. Its goal is that of the one hull, if there are no numbers of faces.
    /// Answers about the mesh do not depend on the margin.
    ///
    /// The mesh is not moved: only the hull's vertices lie on a grid. [`VertexBits::Auto`] stands
    /// for 16 bits, as in a leaf of a box tree, where the mesh leaves room for them.
    pub hull: Options,
    /// Whether to store boxes for distances, which questions about the mesh need.
    pub closest: bool,
    /// Whether to store boxes for segments and overlap with the hull.
    pub segments: bool,
}

impl Default for ChainOptions {
    fn default() -> Self {
        Self { faces: Vec::new(), hull: Options::default(), closest: true, segments: true }
    }
}

impl ChainOptions {
    setters! {
        /// Sets the [margin](Options::margin).
        with_margin: f64 => hull.margin,
        /// Sets the [effort](Options::effort).
        with_effort: f64 => hull.effort,
        /// Sets the [coordinate format](Self::hull).
        with_vertex_bits: VertexBits => hull.vertex_bits,
    }

    /// One hull for each number of faces, with all boxes, no margin and an effort of 1.
    #[must_use]
    pub fn of_faces(faces: &[usize]) -> Self {
        Self { faces: faces.to_vec(), ..Self::default() }
    }

    /// One hull for a goal, with all boxes, no margin and an effort of 1.
    #[must_use]
    pub fn of_goal(goal: Goal) -> Self {
        Self { hull: Options::new(goal), ..Self::default() }
    }

    /// Sets which boxes are stored: for [distances](Self::closest), for
    /// [segments](Self::segments).
    #[must_use]
    pub fn with_boxes(self, closest: bool, segments: bool) -> Self {
        Self { closest, segments, ..self }
    }

    /// The goals, from coarse to fine.
    fn goals(&self) -> Vec<Goal> {
        if self.faces.is_empty() {
            return vec![self.hull.goal];
        }
        let mut faces = self.faces.clone();
        faces.sort_unstable();
        faces.dedup();
        faces.into_iter().map(Goal::Faces).collect()
    }

    fn of_tree(&self) -> TreeOptions {
        TreeOptions::default()
            .with_closest(self.closest)
            .with_segments(self.segments)
            .with_f32(self.hull.vertex_bits.is_f32_in_tree())
    }

    fn of_hull(&self, goal: Goal) -> Options {
        let vertex_bits = match self.hull.vertex_bits {
            VertexBits::Auto => VertexBits::Grid16,
            bits => bits,
        };
        Options { goal, vertex_bits, ..self.hull }
    }
}

/// Measures of a hull of the chain.
#[derive(Clone, Debug)]
pub struct HullReport {
    /// The goal.
    pub asked: Goal,
    /// Measures from [`wrap()`](crate::tight::wrap).
    pub wrapped: Report,
    /// Distances both ways between hull and mesh, input units.
    pub distances: Distances,
    /// Volume beyond that of the mesh, as a fraction of the mesh's volume; or why the mesh has no
    /// volume.
    pub void: Result<f64, NoVolume>,
    /// Bytes in the blob.
    pub bytes: usize,
    /// Time.
    pub time: Duration,
}

/// Makes tight hulls of a mesh. A hull with as many faces as a finer hull is left out, and no
/// report names its goal.
///
/// The hulls enclose the surface of the input file, see [`wrap()`](crate::tight::wrap). The blob's
/// answers hold for it too: they include the distance that vertices were moved.
///
/// Cost: that of [`wrap()`](crate::tight::wrap) for each hull; some hundred distance queries for
/// each triangle of the hulls; one for sixteen triangles of the mesh, and one more for each of the
/// sixteen that may hold its farthest point.
///
/// # Errors
/// [`BuildError`].
pub fn build(
    input: Input<'_>,
    options: &ChainOptions,
    watch: Watch<'_>,
) -> Result<(Sections, Vec<HullReport>), BuildError> {
    let Input { mesh, moved, .. } = input;
    let goals = options.goals();
    let part = |index: usize| index as f64 / goals.len() as f64;
    // Fine to coarse: of equal hulls the one that was asked for with more faces is kept.
    let mut made: Vec<(Hull, HullReport)> = Vec::new();
    let mut overlaps = false;
    for (index, &goal) in goals.iter().rev().enumerate() {
        let started = Instant::now();
        let watch = watch.part(part(index), part(index + 1));
        let (hull, obstacle) = wrap_obstacle(input, &options.of_hull(goal), watch)?;
        if made
            .last()
            .is_some_and(|(finer, _)| finer.mesh.triangles.len() <= hull.mesh.triangles.len())
        {
            continue;
        }
        let certifying = watch.during(Stage::Certifying).part(0.9, 1.0);
        certifying.step(0, 1)?;
        let distances = distances_from(&hull.mesh, &obstacle, hull.report.slack, certifying);
        certifying.check()?;
        if !fits(&distances) {
            return Err(BuildError::NoRoom);
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
        // One hull proves it of the mesh, so that no hull has a void.
        made.iter_mut().for_each(|(_, report)| report.void = Err(NoVolume::Overlapping));
    }
    let stored = made
        .iter_mut()
        .map(|(hull, report)| {
            // The rounding of the mesh when it was read adds to the hull's distance from the input.
            hull.mesh.rounding = mesh.rounding;
            let void = report.void.unwrap_or(0.0);
            let stored =
                Stored::new(&hull.mesh, moved, &report.distances, void, &options.of_tree())?;
            report.bytes = stored.bytes();
            Ok(stored)
        })
        .collect::<Result<Vec<Stored>, BuildError>>()?;
    let tables = sections(input, &stored);
    Ok((tables, made.into_iter().map(|(_, report)| report).collect()))
}

/// Whether the format has numbers for all distances. The largest [`Radius16`] is a little below
/// [`f32::MAX`].
fn fits(distances: &Distances) -> bool {
    let all = distances.slacks.iter().chain([&distances.slack.upper, &distances.depth.upper]);
    all.into_iter().all(|&distance| Radius16::round_up(distance).get().is_finite())
}
