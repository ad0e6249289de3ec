//! A mesh as it was split: along its own axes, or turned first; on a blob's grid, or each tribox on
//! its own.

use super::choose::Measure;
use super::gain::{Gain, Total};
use super::lattice::Lattice;
use super::level::{Level, level, proxies};
use super::orient::{Turn, orientation};
use super::split::{Hierarchy, SplitOptions};
use super::surface::surface;
use crate::bvh::exact_blob_watched;
use crate::error::BuildError;
use crate::hausdorff::Farthest;
use crate::mesh::Mesh;
use crate::progress::Watch;
use crate::surface::scale_exponent;
use meshsweep_core::Bvh;
use std::borrow::Cow;

/// A part of the largest coordinate of a turned proxy. Its vertices move by no more when they are
/// turned back and rounded to f32: 2^-24 on each axis, √3 for the axes and √3 for the turn.
const BACK: f64 = 1.0 / (1 << 22) as f64;

/// Where the planes of proxies lie.
#[derive(Clone, Copy, Debug)]
pub(super) enum Grid {
    /// Each proxy on a grid of its own.
    Own,
    /// All on that of a blob whose input's vertices may be so far off, input units.
    Blob(f64),
}

/// A mesh, and how it is split.
#[derive(Clone, Copy)]
pub(super) struct Splitting<'a> {
    pub(super) mesh: &'a Mesh,
    /// Without a lattice, which the grid gives.
    pub(super) options: SplitOptions,
    pub(super) grid: Grid,
}

/// A mesh as it was split.
#[derive(Clone, Debug)]
pub struct Grown<'a> {
    /// The mesh in the frame of the triboxes.
    pub(super) mesh: Cow<'a, Mesh>,
    /// Its box tree.
    pub(super) bytes: Vec<u8>,
    /// The triboxes, in a frame of their own if they are turned.
    pub hierarchy: Hierarchy,
    /// What takes the mesh to the frame of the triboxes.
    pub turn: Option<Turn>,
    pub(super) lattice: Option<Lattice>,
    /// How far a point of the turned mesh or of what is turned back may be off.
    off: f64,
    /// Factor of lengths in the triboxes' frame that bounds them in the mesh's.
    stretch: f64,
}

impl<'a> Splitting<'a> {
    /// Splits the mesh, which may be turned first.
    fn turned(self, turn: Option<Turn>, watch: Watch<'_>) -> Result<Grown<'a>, BuildError> {
        let Self { mesh, mut options, grid } = self;
        let scale = scale_exponent(mesh);
        let (mut off, stretch) = (0.0, turn.map_or(1.0, |turn| 1.0 + 2.0 * turn.skew()));
        let mut mesh = match turn {
            None => Cow::Borrowed(mesh),
            Some(turn) => {
                let (turned, moved) = turn.mesh(mesh);
                off = moved;
                Cow::Owned(turned)
            }
        };
        match (grid, turn) {
            (Grid::Blob(error), _) => {
                let lattice = Lattice::in_frame(&mesh, scale, error * stretch + off)?;
                options.lattice = Some(Lattice { stretch, ..lattice });
            }
            (Grid::Own, None) => {}
            (Grid::Own, Some(_)) => {
                // Below the normal numbers f32 rounds by an absolute step.
                off += BACK * largest(&mesh, options.simplify) + f64::from(f32::from_bits(4));
                let turned = mesh.to_mut();
                turned.rounding = turned.rounding * stretch + off;
                let inner = |error: f64| (error / stretch * (1.0 - 1e-12) - off).max(0.0);
                options.error = options.error.map(inner);
            }
        }
        let bytes = exact_blob_watched(&mesh, watch.part(0.0, 0.125))?;
        let tree = Bvh::open(&bytes).map_err(BuildError::Reopen)?;
        let hierarchy = Hierarchy::watched(&mesh, &tree, &options, watch.part(0.125, 1.0))?;
        Ok(Grown { mesh, bytes, hierarchy, turn, lattice: options.lattice, off, stretch })
    }

    /// Splits the mesh along its own axes, and in the orientation of its tribox's least measure, if
    /// one is asked for. Takes the one that reaches the asked error with the fewer triboxes, or
    /// that has less in all. Where a turned mesh has coordinates beyond the domain, its own axes
    /// stay.
    pub(super) fn oriented(
        self,
        measure: Option<Measure>,
        watch: Watch<'_>,
    ) -> Result<(Grown<'a>, Option<Gain>), BuildError> {
        let Some(measure) = measure else { return Ok((self.turned(None, watch)?, None)) };
        let own = self.turned(None, watch.part(0.0, 0.5))?;
        let before = Total::of(&own.hierarchy);
        let gain = Gain { before, after: None, is_gain: false };
        let Some(turn) = orientation(self.mesh, measure) else { return Ok((own, Some(gain))) };
        let turned = match self.turned(Some(turn), watch.part(0.5, 1.0)) {
            Ok(turned) => turned,
            Err(BuildError::Cancelled) => return Err(BuildError::Cancelled),
            Err(_) => return Ok((own, Some(gain))),
        };
        let after = Total::of(&turned.hierarchy);
        let error = self.options.error;
        let cost = |grown: &Grown<'_>, total: Total| {
            let misses = error.is_some_and(|error| grown.largest_error() > error);
            (misses, total.cost(measure, error.is_some()))
        };
        let is_gain = cost(&turned, after) < cost(&own, before);
        let gain = Gain { before, after: Some(after), is_gain };
        Ok((if is_gain { turned } else { own }, Some(gain)))
    }
}

/// Upper bound of the coordinates of a mesh's proxies.
fn largest(mesh: &Mesh, simplify: f32) -> f64 {
    let used = mesh.all_triangles().flatten().map(|v| mesh.positions[v as usize]);
    let most = used.flatten().fold(0f64, |most, x| most.max(f64::from(x).abs()));
    // What was rounded, and grids.
    2.0 * (most + f64::from(simplify) + mesh.rounding)
}

impl<'a> Grown<'a> {
    /// Splits a mesh for display: the triboxes' planes lie on
    /// [grids](meshsweep_core::Tribox::on_grid) of their own. If a measure is given, the mesh is
    /// split a second time as [`TriboxOptions::orient`](super::TriboxOptions::orient) says, and the
    /// second result is what that gained.
    ///
    /// # Errors
    /// Those of [`Hierarchy::new`].
    pub fn new(
        mesh: &'a Mesh,
        options: &SplitOptions,
        orient: Option<Measure>,
    ) -> Result<(Grown<'a>, Option<Gain>), BuildError> {
        Splitting { mesh, options: *options, grid: Grid::Own }.oriented(orient, Watch::NONE)
    }

    /// The largest error of the finest level, as a blob stores it if it is for one, in the mesh's
    /// frame.
    #[must_use]
    pub fn largest_error(&self) -> f64 {
        let leaves = self.hierarchy.nodes.iter().filter(|node| node.split.is_none());
        let claimed = |error: f64| match &self.lattice {
            Some(lattice) => lattice.claimed(error),
            None => self.beyond(error),
        };
        leaves.map(|leaf| claimed(leaf.error)).fold(0.0, f64::max)
    }

    /// An upper bound in the mesh's frame of a length in that of the triboxes.
    fn beyond(&self, length: f64) -> f64 {
        (length + self.off) * self.stretch
    }

    /// The level with at most `count` triboxes, measured in the mesh's frame.
    ///
    /// # Errors
    /// None but of a tree that does not open.
    pub fn level(&self, count: usize) -> Result<Level, BuildError> {
        let tree = Bvh::open(&self.bytes).map_err(BuildError::Reopen)?;
        let level = level(&self.hierarchy, count, &self.mesh, &tree);
        let Farthest { lower, upper } = level.distance;
        let distance = Farthest {
            lower: (lower - self.off).max(0.0) / self.stretch,
            upper: self.beyond(upper),
        };
        Ok(Level { error: self.beyond(level.error), distance, ..level })
    }

    /// The [`surface`] of the finest level in the mesh's frame. It holds all that the triboxes
    /// hold; turned triboxes have room for the rounding of their vertices.
    #[must_use]
    pub fn surface(&self) -> Mesh {
        let mut surface = surface(&proxies(&self.hierarchy, usize::MAX));
        if let Some(turn) = &self.turn {
            for place in &mut surface.positions {
                *place = turn.back(*place).map(|x| x as f32);
            }
        }
        surface
    }
}
