//! The stages of a build, in order.

use super::built::Built;
use super::notes::{of_blob, of_curve};
use super::options::{For, Options, Subject};
use crate::bvh::{self, TreeOptions, TreeReport};
use crate::curve::{self, CurveOptions, Polyline, read_csv};
use crate::emit::{self, Sections};
use crate::error::BuildError;
use crate::hull::{self, BuildReport, Levels};
use crate::load::{Loaded, Source, bytes_of};
use crate::mesh::{KeyFrame, RawMesh, Unit};
use crate::progress::{Stage, Watch};
use crate::sdf::{self, SdfReport};
use crate::surface::VertexBits;
use crate::tight::{self, HullReport, Tightness};
use crate::tribox::{self, TriboxReport};
use std::path::{Path, PathBuf};

/// What a blob is built from.
pub(super) enum Input<'a> {
    File(&'a Path),
    /// The content of a file of that name.
    Bytes(&'a Path, Vec<u8>),
    Mesh(Box<RawMesh>),
    Curves(&'a [Polyline]),
}

/// A key frame.
#[derive(Debug)]
pub(super) enum Frame {
    File(PathBuf),
    Mesh(Box<RawMesh>),
}

// Weights of the parts of a build: about their times for a large mesh.
const LOADING: f64 = 1.0;
const HULL: f64 = 20.0;
const TREE: f64 = 4.0;
const TRIBOXES: f64 = 10.0;
/// Of all tight hulls together.
const TIGHT: f64 = 40.0;
const SDF: f64 = 40.0;

/// Builds the blob of a mesh that is at hand as read and repaired, without its repairs.
pub(super) fn build_repaired(
    source: &Source,
    repaired: &Loaded,
    options: &Options,
) -> Result<Built, BuildError> {
    options.check(Subject::Mesh, false)?;
    // Vertices move to a hull's grid before the repair.
    let own = options.wants_hierarchy().then(|| load(options, source, Vec::new())).transpose()?;
    let loaded = own.as_ref().map_or(repaired, |(loaded, _)| loaded);
    Work { options, watch: Watch::NONE, done: 0.0, whole: 1.0 }.structures(loaded, None)
}

/// Builds a blob.
pub(super) fn build(
    input: Input<'_>,
    options: &Options,
    frames: Vec<Frame>,
    watch: Watch<'_>,
) -> Result<Built, BuildError> {
    let subject = match input {
        Input::File(file) | Input::Bytes(file, _) => Subject::File(file),
        Input::Mesh(_) => Subject::Mesh,
        Input::Curves(_) => Subject::Curves,
    };
    options.check(subject, !frames.is_empty())?;
    let weights = [
        (true, LOADING),
        (options.wants_hierarchy(), HULL),
        (options.wants_tree(), TREE),
        (options.serves(For::Triboxes), TRIBOXES),
        (options.serves(For::Tight), TIGHT),
        (options.serves(For::Sdf), SDF),
    ];
    let whole = weights.iter().filter(|(is_wanted, _)| *is_wanted).map(|(_, of)| of).sum();
    let mut work = Work { options, watch, done: 0.0, whole };
    let built = match input {
        Input::File(file) if options.is_curve(subject) => work.curve_of(file, &bytes_of(file)?),
        Input::Bytes(file, bytes) if options.is_curve(subject) => work.curve_of(file, &bytes),
        Input::Curves(polylines) => work.curves(polylines),
        Input::File(file) => work.mesh(|unit| Source::of_file(file, unit), frames),
        Input::Bytes(file, bytes) => work.mesh(|unit| Source::of_bytes(file, bytes, unit), frames),
        Input::Mesh(mesh) => work.mesh(|unit| Source::of(*mesh, unit), frames),
    }?;
    watch.during(Stage::Done).step(1, 1)?;
    Ok(built)
}

/// The options of a build, and its progress.
struct Work<'w> {
    options: &'w Options,
    watch: Watch<'w>,
    /// Weight of the parts that are done, or are being done.
    done: f64,
    /// Weight of all parts.
    whole: f64,
}

/// Sections with their report, if they are wanted.
type Made<R> = Option<(Sections, R)>;

impl<'w> Work<'w> {
    /// Begins the next part.
    fn begin(&mut self, weight: f64, stage: Stage) -> Result<Watch<'w>, BuildError> {
        let from = self.done;
        self.done += weight;
        let part = self.watch.part(from / self.whole, self.done / self.whole).during(stage);
        part.step(0, 1)?;
        Ok(part)
    }

    fn curve_of(&mut self, file: &Path, bytes: &[u8]) -> Result<Built, BuildError> {
        let of_file = |error| BuildError::Curve { file: file.to_owned(), error };
        let polylines = read_csv(bytes, self.options.is_closed).map_err(of_file)?;
        self.curves(&polylines).map_err(|error| match error {
            BuildError::Curve { error, .. } => of_file(error),
            other => other,
        })
    }

    fn curves(&mut self, polylines: &[Polyline]) -> Result<Built, BuildError> {
        let options = CurveOptions { is_f32: self.options.is_f32() };
        let watch = self.begin(LOADING, Stage::Curve)?;
        let (sections, report) = curve::build(polylines, &options, watch)?;
        let mut built = Built::of(sections.to_bytes());
        built.curve = Some(report);
        built.opened(|_, _| of_curve(&report))
    }

    fn mesh(
        &mut self,
        read: impl FnOnce(Option<Unit>) -> Result<Source, BuildError>,
        frames: Vec<Frame>,
    ) -> Result<Built, BuildError> {
        let options = self.options;
        self.begin(LOADING, Stage::Loading)?;
        let (loaded, frames) = load(options, &read(options.unit)?, frames)?;
        let mut built = self.structures(&loaded, frames.as_deref())?;
        built.loaded = Some(loaded);
        Ok(built)
    }

    fn structures(
        &mut self,
        loaded: &Loaded,
        frames: Option<&[KeyFrame]>,
    ) -> Result<Built, BuildError> {
        let hull = self.hull(loaded, frames)?;
        let tree = self.tree(loaded)?;
        let triboxes = self.triboxes(loaded)?;
        let tight = self.tight(loaded)?;
        let sdf = self.sdf(loaded)?;
        let structures = [
            hull.as_ref().map(|(tables, _)| tables),
            tree.as_ref().map(|(tables, _)| tables),
            triboxes.as_ref().map(|(tables, _)| tables),
            tight.as_ref().map(|(tables, _)| tables),
            sdf.as_ref().map(|(tables, _)| tables),
        ];
        let bytes = emit::assemble(structures.into_iter().flatten());
        let mut built = Built::of(bytes);
        built.hull = hull.map(|(_, report)| report);
        built.tree = tree.map(|(_, report)| report);
        built.triboxes = triboxes.map(|(_, report)| report);
        built.tight = tight.map(|(_, reports)| reports).unwrap_or_default();
        built.sdf = sdf.map(|(_, report)| report);
        built.opened(|built, blob| of_blob(self.options, loaded, blob, built))
    }

    fn hull(
        &mut self,
        loaded: &Loaded,
        frames: Option<&[KeyFrame]>,
    ) -> Result<Made<BuildReport>, BuildError> {
        if !self.options.wants_hierarchy() {
            return Ok(None);
        }
        let levels = match frames {
            Some(frames) if self.options.wants_solid() => Levels::Deform(frames),
            Some(frames) => Levels::SweepDeform(frames),
            None if self.options.wants_solid() => Levels::Hulls,
            None => Levels::Sweep,
        };
        let options = self.options.of_hull().with_levels(levels);
        let of = loaded.mesh.triangles.len().saturating_sub(options.base_faces);
        let watch = self.begin(HULL, Stage::Collapsing { done: 0, of })?;
        hull::build(loaded.input(), &options, watch).map(Some)
    }

    fn tree(&mut self, loaded: &Loaded) -> Result<Made<TreeReport>, BuildError> {
        let wanted = self.options;
        if !wanted.wants_tree() {
            return Ok(None);
        }
        let options = TreeOptions::default()
            .with_closest(wanted.serves(For::Closest))
            .with_segments(wanted.serves(For::Segment))
            .with_cull(wanted.serves(For::Cull))
            .with_winding(wanted.serves(For::Winding))
            .with_f32(wanted.is_f32())
            .with_f32_allowed(wanted.vertex_bits == VertexBits::Auto);
        let watch = self.begin(TREE, Stage::BoxTree)?;
        bvh::build(loaded.input(), &options, watch).map(Some)
    }

    fn triboxes(&mut self, loaded: &Loaded) -> Result<Made<TriboxReport>, BuildError> {
        if !self.options.serves(For::Triboxes) {
            return Ok(None);
        }
        let watch = self.begin(TRIBOXES, Stage::Triboxes)?;
        tribox::build(loaded.input(), &self.options.of_triboxes(), watch).map(Some)
    }

    fn sdf(&mut self, loaded: &Loaded) -> Result<Made<SdfReport>, BuildError> {
        if !self.options.serves(For::Sdf) {
            return Ok(None);
        }
        let watch = self.begin(SDF, Stage::Sdf)?;
        sdf::build(loaded.input(), &self.options.of_sdf(), watch).map(Some)
    }

    fn tight(&mut self, loaded: &Loaded) -> Result<Made<Vec<HullReport>>, BuildError> {
        let wanted = self.options;
        if !wanted.serves(For::Tight) {
            return Ok(None);
        }
        let watch = self.begin(TIGHT, Stage::Shrinking { done: 0, of: 0 })?;
        let made = tight::build(loaded.input(), &wanted.of_tight(), watch)?;
        let Options { slack, void_percent: void, .. } = *wanted;
        let asked = Tightness { slack, void };
        asked.require(made.1.iter().map(|report| &report.wrapped))?;
        Ok(Some(made))
    }
}

/// Repairs a mesh as its structures need it.
fn load(
    options: &Options,
    source: &Source,
    frames: Vec<Frame>,
) -> Result<(Loaded, Option<Vec<KeyFrame>>), BuildError> {
    if options.serves(For::Deform) {
        let frames = frames.into_iter().map(|frame| match frame {
            Frame::File(file) => Source::of_file(&file, options.unit),
            Frame::Mesh(mesh) => Source::of(*mesh, options.unit),
        });
        let (loaded, keys) = source.deformable(frames, options.wants_solid())?;
        return Ok((loaded, Some(keys)));
    }
    let loaded = match options.wants_hierarchy() {
        true => source.on_grid(options.vertex_bits)?,
        false => source.repaired()?,
    };
    if options.wants_solid() {
        loaded.require_solid()?;
    }
    Ok((loaded, None))
}
