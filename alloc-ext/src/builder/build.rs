//! The stages of a build, in order.

use super::built::Built;
use super::notes::{Note, of_blob, of_curve, of_mesh};
use super::options::{self, For, Options, Subject};
use super::stage::{OnProgress, Progress, Stage, of_tight};
use crate::bvh::{self, TreeOptions, TreeReport};
use crate::collapse;
use crate::curve::{self, Polyline, read_csv};
use crate::emit::{self, Sections};
use crate::error::{BuildError, CurveError};
use crate::hull;
use crate::load::{Loaded, Source, bytes_of};
use crate::mesh::{KeyFrame, RawMesh, Unit};
use crate::progress::Callback;
use crate::surface::VertexBits;
use crate::tight::{self, HullReport, Tightness};
use crate::tribox::{self, TriboxReport};
use std::ops::ControlFlow::{Break, Continue};
use std::path::{Path, PathBuf};

/// What a blob is built from.
pub(super) enum Input<'a> {
    File(&'a Path),
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

/// The part of a hull hierarchy's build in which edges collapse.
const COLLAPSING: f64 = 0.7;

/// Builds a blob.
pub(super) fn build(
    input: Input<'_>,
    options: &Options,
    frames: Vec<Frame>,
    on_progress: Option<&mut OnProgress<'_>>,
) -> Result<Built, BuildError> {
    let subject = match input {
        Input::File(file) => Subject::File(file),
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
    ];
    let weight = weights.iter().filter(|(is_wanted, _)| *is_wanted).map(|(_, of)| of).sum();
    let mut work = Work { options, progress: Progress::new(on_progress, weight) };
    let built = match input {
        Input::File(file) if options.is_curve(subject) => work.curve_of(file),
        Input::Curves(polylines) => work.curves(Path::new("(memory)"), polylines),
        Input::File(file) => work.mesh(|unit| Source::of_file(file, unit), frames),
        Input::Mesh(mesh) => work.mesh(|unit| Source::of(*mesh, unit), frames),
    }?;
    if work.progress.show(Stage::Done, 1.0) { Ok(built) } else { Err(BuildError::Cancelled) }
}

/// The options of a build, and its progress.
struct Work<'w, 'a> {
    options: &'w Options,
    progress: Progress<'w, 'a>,
}

/// Sections with their report, if they are wanted.
type Made<R> = Option<(Sections, R)>;

impl Work<'_, '_> {
    fn curve_of(&mut self, file: &Path) -> Result<Built, BuildError> {
        let refused = |error: CurveError| BuildError::Curve { file: file.to_owned(), error };
        let polylines = read_csv(&bytes_of(file)?, self.options.is_closed).map_err(refused)?;
        self.curves(file, &polylines)
    }

    fn curves(&mut self, file: &Path, polylines: &[Polyline]) -> Result<Built, BuildError> {
        self.progress.begin(LOADING);
        let callback = Callback::new(|part| self.progress.show(Stage::Curve, part));
        callback.watch().step(0, 1)?;
        let made = curve::store_watched(polylines, self.options.is_f32(), callback.watch());
        callback.watch().check()?;
        let (sections, report) =
            made.map_err(|error| BuildError::Curve { file: file.to_owned(), error })?;
        let mut built = Built::of(sections.to_bytes())?;
        built.notes.extend(of_curve(&report));
        built.curve = Some(report);
        Ok(built)
    }

    fn mesh(
        &mut self,
        read: impl FnOnce(Option<Unit>) -> Result<Source, BuildError>,
        frames: Vec<Frame>,
    ) -> Result<Built, BuildError> {
        let options = self.options;
        self.begin(LOADING, Stage::Loading)?;
        let (loaded, frames) = load(options, read(options.unit)?, frames)?;
        let hull = options.wants_hierarchy().then(|| self.hull(&loaded, frames.as_deref()));
        let hull = hull.transpose()?;
        let tree = self.tree(&loaded)?;
        let triboxes = self.triboxes(&loaded)?;
        let tight = self.tight(&loaded)?;
        let hierarchy = hull.as_ref().map(|hull| hull.tables.sections());
        let structures = [
            hierarchy.as_ref(),
            hull.as_ref().and_then(|hull| hull.deform.as_ref()),
            tree.as_ref().map(|(tables, _)| tables),
            triboxes.as_ref().map(|(tables, _)| tables),
            tight.as_ref().map(|(tables, _)| tables),
        ];
        let mut built = Built::of(emit::assemble(structures.into_iter().flatten()))?;
        built.hull = hull.map(|hull| hull.report);
        built.tree = tree.map(|(_, report)| report);
        built.triboxes = triboxes.map(|(_, report)| report);
        built.tight = tight.map(|(_, reports)| reports).unwrap_or_default();
        let mut notes: Vec<Note> = of_mesh(&loaded, built.hull.as_ref());
        let (hull, tree) = (built.hull.as_ref(), built.tree.as_ref());
        notes.extend(of_blob(options, &loaded, &built.blob(), hull, tree, &built.tight));
        built.notes = notes;
        built.loaded = Some(loaded);
        Ok(built)
    }

    /// Begins the next part.
    fn begin(&mut self, weight: f64, stage: Stage) -> Result<(), BuildError> {
        self.progress.begin(weight);
        if self.progress.show(stage, 0.0) { Ok(()) } else { Err(BuildError::Cancelled) }
    }

    fn hull(
        &mut self,
        loaded: &Loaded,
        frames: Option<&[KeyFrame]>,
    ) -> Result<hull::Built, BuildError> {
        let options = self.options.of_hull();
        let faces = loaded.mesh.triangles.len();
        let of = faces.saturating_sub(options.base_faces);
        self.begin(HULL, Stage::Hull { done: 0, of })?;
        let show = |progress: collapse::Progress| {
            let done = faces.saturating_sub(progress.faces);
            let part = COLLAPSING * done as f64 / of.max(1) as f64;
            let goes_on = self.progress.show(Stage::Hull { done, of }, part.min(COLLAPSING));
            if goes_on { Continue(()) } else { Break(()) }
        };
        match frames {
            Some(frames) => hull::build_deform(loaded.input(), frames, &options, show),
            None if self.options.wants_solid() => hull::build(loaded.input(), &options, show),
            None => hull::build_for_sweep(loaded.input(), &options, show),
        }
    }

    fn tree(&mut self, loaded: &Loaded) -> Result<Made<TreeReport>, BuildError> {
        let wanted = self.options;
        if !wanted.wants_tree() {
            return Ok(None);
        }
        self.begin(TREE, Stage::BoxTree)?;
        let options = TreeOptions::default()
            .with_closest(wanted.serves(For::Closest))
            .with_segments(wanted.serves(For::Segment))
            .with_cull(wanted.serves(For::Cull))
            .with_winding(wanted.serves(For::Winding))
            .with_f32(wanted.is_f32())
            .with_f32_allowed(wanted.vertex_bits == VertexBits::Auto);
        let callback = Callback::new(|part| self.progress.show(Stage::BoxTree, part));
        bvh::build_watched(loaded.input(), &options, callback.watch()).map(Some)
    }

    fn triboxes(&mut self, loaded: &Loaded) -> Result<Made<TriboxReport>, BuildError> {
        if !self.options.serves(For::Triboxes) {
            return Ok(None);
        }
        self.begin(TRIBOXES, Stage::Triboxes)?;
        let count = self.options.triboxes.unwrap_or(options::TRIBOXES);
        let callback = Callback::new(|part| self.progress.show(Stage::Triboxes, part));
        tribox::store_watched(loaded.input(), count, callback.watch()).map(Some)
    }

    fn tight(&mut self, loaded: &Loaded) -> Result<Made<Vec<HullReport>>, BuildError> {
        let wanted = self.options;
        if !wanted.serves(For::Tight) {
            return Ok(None);
        }
        self.begin(TIGHT, Stage::Tight(tight::Stage::Certifying))?;
        let options = wanted.of_tight();
        let made = tight::chain(loaded.input(), &options, |stage| {
            let goes_on = self.progress.show(Stage::Tight(stage), of_tight(stage));
            if goes_on { Continue(()) } else { Break(()) }
        })?;
        let Options { slack, void_percent: void, .. } = *wanted;
        let asked = Tightness { slack, void, by_faces: "--tight" };
        asked.require(made.1.iter().map(|report| &report.wrapped))?;
        Ok(Some(made))
    }
}

/// Repairs a mesh as its structures need it.
fn load(
    options: &Options,
    source: Source,
    frames: Vec<Frame>,
) -> Result<(Loaded, Option<Vec<KeyFrame>>), BuildError> {
    if options.serves(For::Deform) {
        let frames = frames.into_iter().map(|frame| match frame {
            Frame::File(file) => Source::of_file(&file, options.unit),
            Frame::Mesh(mesh) => Source::of(*mesh, options.unit),
        });
        let (loaded, keys) = source.deformable(frames)?;
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
