//! A chain of hulls of one mesh.

use super::distances::{Distances, distances_from};
use super::section::{Stored, sections};
use crate::bvh::TreeOptions;
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
use std::time::{Duration, Instant};

/// Most hulls of a blob.
pub const MAX_HULLS: usize = MAX_LEVELS as usize;

/// Which hulls to make, and how.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ChainOptions {
    /// Most faces of each hull, in any order. If there are none, one hull of 200 faces is made.
    pub faces: Vec<usize>,
    /// The goal of the one hull to make, instead of numbers of faces.
    pub goal: Option<Goal>,
    /// Distance that every hull keeps from the input's surface; see [`Options::margin`]. Answers
    /// about the mesh do not depend on the margin.
    pub margin: f64,
    /// How long to polish; see [`Options::effort`].
    pub effort: f64,
    /// Bits of a hull vertex. The mesh is not moved: only the hull's vertices lie on a grid.
    /// [`VertexBits::Auto`] stands for 16 bits, as in a leaf of a box tree, where the mesh leaves
    /// room for them.
    pub vertex_bits: VertexBits,
    /// Whether to store boxes for distances, which questions about the mesh need.
    pub closest: bool,
    /// Whether to store boxes for segments and overlap with the hull.
    pub segments: bool,
}

impl Default for ChainOptions {
    fn default() -> Self {
        Self {
            faces: Vec::new(),
            goal: None,
            margin: 0.0,
            effort: 1.0,
            vertex_bits: VertexBits::Auto,
            closest: true,
            segments: true,
        }
    }
}

/// Faces of the hull if none are asked for.
const FACES: usize = 200;

impl ChainOptions {
    /// One hull for each number of faces, with all boxes, no margin and an effort of 1.
    #[must_use]
    pub fn of_faces(faces: &[usize]) -> Self {
        Self { faces: faces.to_vec(), ..Self::default() }
    }

    /// One hull for a goal, with all boxes, no margin and an effort of 1.
    #[must_use]
    pub fn of_goal(goal: Goal) -> Self {
        Self { goal: Some(goal), ..Self::default() }
    }

    /// Sets the [margin](Self::margin).
    #[must_use]
    pub fn with_margin(self, margin: f64) -> Self {
        Self { margin, ..self }
    }

    /// Sets the [effort](Self::effort).
    #[must_use]
    pub fn with_effort(self, effort: f64) -> Self {
        Self { effort, ..self }
    }

    /// Sets the [bits of a vertex](Self::vertex_bits).
    #[must_use]
    pub fn with_vertex_bits(self, vertex_bits: VertexBits) -> Self {
        Self { vertex_bits, ..self }
    }

    /// Sets which boxes are stored: for [distances](Self::closest), for
    /// [segments](Self::segments).
    #[must_use]
    pub fn with_boxes(self, closest: bool, segments: bool) -> Self {
        Self { closest, segments, ..self }
    }

    /// The goals, from coarse to fine.
    fn goals(&self) -> Vec<Goal> {
        if let Some(goal) = self.goal {
            return vec![goal];
        }
        let mut faces = self.faces.clone();
        faces.sort_unstable();
        faces.dedup();
        if faces.is_empty() {
            faces.push(FACES);
        }
        faces.into_iter().map(Goal::Faces).collect()
    }

    fn of_tree(&self) -> TreeOptions {
        TreeOptions::default()
            .with_closest(self.closest)
            .with_segments(self.segments)
            .with_f32(matches!(self.vertex_bits, VertexBits::Grid24 | VertexBits::F32))
    }

    fn of_hull(&self, goal: Goal) -> Options {
        let bits = match self.vertex_bits {
            VertexBits::Auto => VertexBits::Grid16,
            bits => bits,
        };
        Options::new(goal).with_margin(self.margin).with_effort(self.effort).with_vertex_bits(bits)
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
/// The hulls enclose the surface of the input file, see [`wrap()`](crate::tight::wrap). The blob's answers hold for it
/// too: they include the distance that vertices were moved.
///
/// Cost: that of [`wrap()`](crate::tight::wrap) for each hull; some hundred distance queries for each triangle of the
/// hulls, and one for each triangle of the mesh.
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

/// Whether the format has numbers for all distances. Two bytes end a little before single
/// precision.
fn fits(distances: &Distances) -> bool {
    let all = distances.slacks.iter().chain([&distances.slack.upper, &distances.depth.upper]);
    all.into_iter().all(|&distance| Radius16::round_up(distance).get().is_finite())
}
