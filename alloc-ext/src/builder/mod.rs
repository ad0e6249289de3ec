//! From a mesh and the questions that it has to serve to a blob in memory.
//!
//! ```text
//! options ─ check ─ load ─ structures ─ emit ─ Blob::open ─ Built: bytes and notes
//! ```

mod build;
mod built;
mod notes;
mod options;
pub mod ranges;
mod recipe;

use crate::collapse::CollapseOptions;
use crate::curve::Polyline;
use crate::error::BuildError;
use crate::load::{Loaded, Source};
use crate::mesh::{RawMesh, Unit};
use crate::progress::{Answer, Callback, Watch};
use crate::surface::VertexBits;
use crate::tribox::Measure;
use build::{Frame, Input};
use options::{Options, Subject};
use std::fmt;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

pub use crate::progress::Stage;
pub use crate::sdf::{BYTES as SDF_BYTES, SdfKind, SdfLayout};
pub use crate::tight::FACES;
pub use built::{Built, Note, Topic};
pub use options::{For, TRIBOXES};
pub use recipe::Recipe;

/// Builds a blob in memory, with the program's options and defaults.
///
/// The same mesh and options give the bytes that `meshsweep build` writes. A setter takes a value,
/// or an `Option` whose `None` is the default. Without [`serve`](Self::serve) a blob serves
/// distances and segments.
///
/// ```
/// use meshsweep::builder::For;
/// use meshsweep_core::{Budget, ScratchEntry};
///
/// # let part = concat!(env!("CARGO_MANIFEST_DIR"), "/src/bin/meshsweep/demo/bracket.stl");
/// let built = meshsweep::Builder::new().serve(For::Closest).build_file(part)?;
/// for note in built.report() {
///     println!("{note}"); // what was repaired: nothing is lost silently
/// }
/// let tree = built.blob().bvh()?;
/// let mut scratch = vec![ScratchEntry::EMPTY; tree.scratch_entries()];
/// let near = tree.closest_point([10.0, 4.5, 7.0], Budget::EXACT, &mut scratch)?;
/// assert!(near.distance.lower <= near.distance.upper);
/// # let file = std::env::temp_dir().join("meshsweep-builder-part.msw");
/// std::fs::write(file, built.bytes())?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
#[derive(Default)]
pub struct Builder<'a> {
    options: Options,
    frames: Vec<Frame>,
    on_progress: Option<Callback<Box<OnProgress<'a>>>>,
}

impl fmt::Debug for Builder<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { options, frames, .. } = self;
        f.debug_struct("Builder").field("options", options).field("frames", frames).finish()
    }
}

/// A callback of progress.
type OnProgress<'a> = dyn FnMut(Stage, f64) -> ControlFlow<()> + 'a;

impl fmt::Display for Builder<'_> {
    /// The options with which the program builds the same, but for key frames.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.options.fmt(f)
    }
}

impl<'a> Builder<'a> {
    setters! {
        optional
        /// Unit of the blob. A mesh that names its unit is converted. Other meshes are taken to be
        /// in this unit already.
        unit: Unit => options.unit,
        /// Faces of the base hull, for [`For::Hull`], [`For::Sweep`] and [`For::Deform`]:
        /// [`FACES`] unless told otherwise.
        base_faces: u32 => options.base,
        /// Most triboxes of the finest level: [`TRIBOXES`] unless told otherwise.
        triboxes: u32 => options.triboxes,
        /// Triboxes are split until each is within this distance of the convex hull of what it
        /// holds, in the mesh's unit. Without [`triboxes`](Self::triboxes) that may take as many
        /// as [the range](ranges::TRIBOX_COUNT) allows.
        tribox_error: f64 => options.tribox_error,
        /// Turns triboxes to where that of the whole mesh has the least of this measure, if those
        /// of the finest level then have less in all. Default: they lie along the mesh's axes.
        orient: Measure => options.orient,
        /// Instead of numbers of faces: one tight hull, with the fewest faces found such that no
        /// point of it is farther than this from the mesh, in its unit. More than the
        /// [`margin`](Self::margin).
        slack: f64 => options.slack,
        /// Instead of numbers of faces: one tight hull, with the fewest faces found that leave at
        /// most this void, in percent of the mesh's volume. Refused together with
        /// [`slack`](Self::slack). Either is refused together with
        /// [`tight_faces`](Self::tight_faces).
        void_percent: f64 => options.void_percent,
        /// Distance that tight hulls keep from the mesh, in its unit. Default: 0.
        margin: f64 => options.margin,
        /// Most bytes of a distance field: [`SDF_BYTES`] unless told otherwise; with an
        /// [error](Self::sdf_error) the most of [the range](ranges::SDF_BYTES).
        sdf_bytes: u32 => options.sdf_bytes,
        /// The largest width of an interval in a distance field, in the mesh's unit. The field is
        /// the one of the fewest bytes found that is proved to be as narrow everywhere, with what
        /// rounding to f32 adds. Refused if none of at most
        /// [`sdf_bytes`](Self::sdf_bytes) is. Default: as narrow as the bytes allow.
        sdf_error: f64 => options.sdf_error,
        /// Part of the distance by which intervals may be wider than the
        /// [error](Self::sdf_error). Default: 0. Refused without an error.
        sdf_relative: f64 => options.sdf_relative,
        /// What the distances of a field mean. Default: signed if the mesh is closed and has
        /// sides, else [`SdfKind::Surface`].
        sdf_kind: SdfKind => options.sdf_kind,
        /// How a field lies in its bytes. Default: in the layout of the smaller mean width, or of
        /// one that is nearly as small; with an error in the one of fewer bytes.
        sdf_layout: SdfLayout => options.sdf_layout,
        /// Distance about the mesh's box that a field covers, in the mesh's unit. Default: a tenth
        /// of the box's diagonal.
        sdf_margin: f64 => options.sdf_margin,
        /// How long to polish tight hulls, as a factor: 0 not at all. Default: 1.
        effort: f64 => options.effort,
    }

    /// Distances and segments of a mesh, the program's default.
    pub fn new() -> Self {
        Self::default()
    }

    /// With the options of a recipe; of a cut level, those of the hierarchy to cut, which is then
    /// built whole: [`trade::build`](crate::trade::build) cuts it.
    pub fn of(recipe: Recipe) -> Self {
        Self { options: recipe.options(), ..Self::default() }
    }

    /// Adds a question that the blob must serve. Only the sections that it needs are written.
    pub fn serve(self, question: For) -> Self {
        self.serve_all([question])
    }

    /// Adds questions that the blob must serve.
    pub fn serve_all(mut self, questions: impl IntoIterator<Item = For>) -> Self {
        self.options.asked.extend(questions);
        self
    }

    /// Bits of a stored coordinate. Default: [`VertexBits::Auto`].
    pub fn vertex_bits(mut self, bits: VertexBits) -> Self {
        self.options.vertex_bits = bits;
        self
    }

    /// Conditions on the edge collapses of a hull hierarchy.
    pub fn collapse(mut self, options: CollapseOptions) -> Self {
        self.options.collapse = options;
        self
    }

    /// Whether triboxes may be split just beyond local extrema of the mesh too. Default: at even
    /// places only.
    pub fn extrema(mut self, are_tried: bool) -> Self {
        self.options.extrema = are_tried;
        self
    }

    /// Faces of each tight hull, for [`For::Tight`]: one of [`FACES`] unless told otherwise.
    pub fn tight_faces(mut self, faces: &[u32]) -> Self {
        self.options.tight = faces.to_vec();
        self
    }

    /// Whether tight hulls serve distances, and whether segments. Default: both.
    pub fn tight_for(mut self, closest: bool, segment: bool) -> Self {
        self.options.tight_for = Some([closest, segment]);
        self
    }

    /// Whether the last point of each polyline of a CSV file is joined with its first. Refused for
    /// polylines in memory, which say it themselves.
    pub fn closed(mut self, is_closed: bool) -> Self {
        self.options.is_closed = is_closed;
        self
    }

    /// Adds a key frame for [`For::Deform`]: a mesh with the same triangles, which the first one
    /// deforms to.
    pub fn frame(mut self, mesh: RawMesh) -> Self {
        self.frames.push(Frame::Mesh(Box::new(mesh)));
        self
    }

    /// Adds a key frame in a file. It is read when the blob is built.
    pub fn frame_file(mut self, file: impl Into<PathBuf>) -> Self {
        self.frames.push(Frame::File(file.into()));
        self
    }

    /// Calls `on_progress` with the stage and the part of the work that is done, on the thread that
    /// builds. The part never falls. The last call has [`Stage::Done`] and 1.
    ///
    /// A callback that returns [`ControlFlow::Break`] ends the build with
    /// [`BuildError::Cancelled`], and is not called again. One that returns nothing only watches.
    ///
    /// The part is estimated from the numbers of faces and nodes. It is no measure of time.
    pub fn on_progress<A: Answer>(
        mut self,
        mut on_progress: impl FnMut(Stage, f64) -> A + 'a,
    ) -> Self {
        let show = move |stage, part| match on_progress(stage, part).goes_on() {
            true => ControlFlow::Continue(()),
            false => ControlFlow::Break(()),
        };
        self.on_progress = Some(Callback::new(Box::new(show)));
        self
    }

    /// Whether a blob of curves is built from this file: it is CSV, or [`For::Curve`] was asked
    /// for.
    #[must_use]
    pub fn builds_curve(&self, file: &Path) -> bool {
        self.options.is_curve(Subject::File(file))
    }

    /// Refuses options that do not go together or are out of [range](ranges), before a file is
    /// read. [`build_file`](Self::build_file) does it first.
    ///
    /// # Errors
    /// [`BuildError::Option`], [`BuildError::OutOfRange`], [`BuildError::TooManyHulls`],
    /// [`BuildError::SlackWithinMargin`].
    pub fn check(&self, file: &Path) -> Result<(), BuildError> {
        self.options.check(Subject::File(file), !self.frames.is_empty())
    }

    /// Builds the blob of a mesh file. A CSV file holds the points of curves.
    ///
    /// Cost: a second for some 300,000 triangles of a box tree on one core, seconds for tight hulls
    /// of any mesh. [`on_progress`](Self::on_progress) can end it.
    ///
    /// # Errors
    /// [`BuildError::Unreadable`]; [`BuildError::Mesh`] names the defect of a mesh and its place;
    /// those of [`check`](Self::check); the refusals of the structures that were asked for.
    pub fn build_file(self, file: impl AsRef<Path>) -> Result<Built, BuildError> {
        self.build_of(Input::File(file.as_ref()))
    }

    /// As [`build_file`](Self::build_file), for a file's content in memory. Its name tells the
    /// format by its extension.
    ///
    /// # Errors
    /// Those of [`build_file`](Self::build_file), but for reading.
    pub fn build_bytes(self, name: impl AsRef<Path>, bytes: Vec<u8>) -> Result<Built, BuildError> {
        self.build_of(Input::Bytes(name.as_ref(), bytes))
    }

    /// Builds the blob of a mesh in memory. [`RawMesh::from_f32`] makes one of vertices and
    /// triangles, which are checked and repaired as those of a file.
    ///
    /// # Errors
    /// Those of [`build_file`](Self::build_file), but for reading.
    pub fn build(self, mesh: RawMesh) -> Result<Built, BuildError> {
        self.build_of(Input::Mesh(Box::new(mesh)))
    }

    /// Builds the blob of curves in memory.
    ///
    /// # Errors
    /// [`BuildError::Curve`] names the point; those of [`check`](Self::check).
    pub fn build_curves(self, polylines: &[Polyline]) -> Result<Built, BuildError> {
        self.build_of(Input::Curves(polylines))
    }

    /// Builds the blob of a mesh that is at hand as read and repaired. The report has no mesh.
    pub(crate) fn build_repaired(
        self,
        source: &Source,
        repaired: &Loaded,
    ) -> Result<Built, BuildError> {
        build::build_repaired(source, repaired, &self.options)
    }

    fn build_of(self, input: Input<'_>) -> Result<Built, BuildError> {
        let watch = self.on_progress.as_ref().map_or(Watch::NONE, Callback::watch);
        build::build(input, &self.options, self.frames, watch)
    }
}
