//! Arguments of the commands that make, describe and cut blobs.

use super::measuring::{LimitArgs, measured};
use super::reading::{ReadArgs, ThreadArgs};
use super::values::{
    degrees, distance, factor, length, percent, question, ratio, sdf_bytes, whole,
};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{ArgGroup, Args, ValueEnum};
use meshsweep::Builder;
use meshsweep::builder::ranges::{BASE_FACES, MAX_VALENCE, TIGHT_FACES, TRIBOX_COUNT};
use meshsweep::builder::{For, SdfKind, SdfLayout};
use meshsweep::collapse::{CollapseOptions, Priority};
use meshsweep::lp::Order;
use meshsweep::surface::VertexBits;
use meshsweep::trade::Question;
use meshsweep::tribox::Measure;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct BuildArgs {
    /// Mesh file: .stl, .ply, .obj, .off, .glb, .gltf, .3mf or .dae; or points of curves: .csv; or
    /// - for the standard input, with --format
    pub mesh: PathBuf,
    /// With --for deform: the same mesh at further key frames, with the same triangles
    pub frames: Vec<PathBuf>,
    /// Blob to write
    #[arg(short, long, value_name = "BLOB")]
    pub output: PathBuf,
    /// Questions that the blob must serve [default: closest,segment]
    ///
    /// Only the sections that they need are written. See below.
    #[arg(
        long = "for",
        value_parser = PossibleValuesParser::new(For::ALL.map(For::name)).map(question),
        value_delimiter = ',',
        value_name = "QUESTIONS"
    )]
    serves: Option<Vec<For>>,
    #[command(flatten)]
    pub read: ReadArgs,
    /// Bits of a stored coordinate: auto, 16, 24 or 32
    ///
    /// See below.
    #[arg(
        long,
        value_enum,
        value_name = "BITS",
        default_value_t = StoredBits::Auto,
        hide_possible_values = true
    )]
    pub vertex_bits: StoredBits,
    /// Faces of the base hull, with --for hull or sweep [default: 200]
    #[arg(long, value_name = "FACES", value_parser = whole::<{ BASE_FACES[0] }, { BASE_FACES[1] }>)]
    pub base: Option<u32>,
    /// Most triboxes of the finest level, with --for triboxes [default: 64]
    #[arg(long, value_name = "N", value_parser = whole::<{ TRIBOX_COUNT[0] }, { TRIBOX_COUNT[1] }>)]
    pub triboxes: Option<u32>,
    #[command(flatten)]
    pub split: TriboxSplitArgs,
    /// Faces of each tight hull, with --for tight [default: 200]
    #[arg(
        long,
        value_name = "FACES",
        value_delimiter = ',',
        value_parser = whole::<{ TIGHT_FACES[0] }, { TIGHT_FACES[1] }>
    )]
    pub tight: Vec<u32>,
    /// Instead of --tight: the fewest faces found within this distance of the mesh, in its unit
    ///
    /// One tight hull is made. No point of it is farther than this from the mesh.
    #[arg(long, value_name = "DISTANCE", value_parser = distance)]
    pub slack: Option<f64>,
    /// Instead of --tight: the fewest faces found that leave at most this void, in percent
    ///
    /// One tight hull is made. The void is that of the hull beside the mesh, in percent of the
    /// mesh's volume.
    #[arg(long, value_name = "PERCENT", value_parser = percent)]
    pub void: Option<f64>,
    /// Distance that tight hulls keep from the mesh, in its unit [default: 0]
    ///
    /// All points within the distance are inside.
    #[arg(long, value_name = "DISTANCE", value_parser = length)]
    pub margin: Option<f64>,
    /// How long to polish tight hulls, as a factor: 0 not at all [default: 1]
    #[arg(long, value_name = "FACTOR", value_parser = factor)]
    pub effort: Option<f64>,
    /// Questions to tight hulls [default: closest,segment]
    ///
    /// Only the library asks segment.
    #[arg(
        long,
        value_enum,
        value_delimiter = ',',
        value_name = "QUESTIONS",
        hide_possible_values = true
    )]
    pub tight_for: Vec<HullServes>,
    /// Bytes of the distance field, with --for sdf [default: 16K]
    #[arg(long, value_name = "BYTES", value_parser = sdf_bytes)]
    pub sdf: Option<u32>,
    /// Largest width of the field's intervals, in the mesh's unit
    ///
    /// The field takes the fewest bytes found, --sdf at most [default: 256K].
    #[arg(long, value_name = "DISTANCE", value_parser = distance)]
    pub sdf_error: Option<f64>,
    /// Part of the distance that is added to --sdf-error [default: 0]
    #[arg(long, value_name = "FACTOR", value_parser = factor)]
    pub sdf_rel: Option<f64>,
    /// What the field's distances mean: signed, solid or surface
    ///
    /// By default signed if the mesh is closed and has sides, else surface. See below.
    #[arg(
        long,
        value_name = "KIND",
        hide_possible_values = true,
        value_parser = PossibleValuesParser::new(SdfKind::ALL.map(SdfKind::name)).map(sdf_kind)
    )]
    pub sdf_kind: Option<SdfKind>,
    /// How the field lies in its bytes: lattice or tree
    ///
    /// By default the one whose intervals are narrower in mean, or nearly so.
    #[arg(
        long,
        value_name = "LAYOUT",
        hide_possible_values = true,
        value_parser = PossibleValuesParser::new(SdfLayout::ALL.map(SdfLayout::name)).map(sdf_layout)
    )]
    pub sdf_layout: Option<SdfLayout>,
    /// Margin of the field about the mesh, in its unit
    ///
    /// By default a tenth of the box's diagonal. Farther out answers are wider.
    #[arg(long, value_name = "DISTANCE", value_parser = length)]
    pub sdf_margin: Option<f64>,
    /// With --for curve: join the last point of each polyline with its first; zones always are
    #[arg(long)]
    pub closed: bool,
    /// Write the blob as source text too, in rust or c
    ///
    /// The files lie beside the blob: part.rs, or part.h and part.c.
    #[arg(
        long,
        value_enum,
        value_delimiter = ',',
        value_name = "LANGUAGE",
        hide_possible_values = true
    )]
    pub emit: Vec<Language>,
    #[command(flatten)]
    pub collapse: CollapseArgs,
    #[command(flatten)]
    pub limits: LimitArgs,
    #[command(flatten)]
    pub threads: ThreadArgs,
    /// Print one JSON object in place of the report
    #[arg(long)]
    pub json: bool,
}

/// A language of firmware.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Language {
    // A module with the opened structures.
    Rust,
    // A header and the bytes.
    C,
}

/// Questions to a tight hull.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum HullServes {
    // Distances of the mesh within.
    Closest,
    // Segments, and overlap of hulls.
    Segment,
}

/// All measures of a tribox.
const MEASURES: [Measure; 2] = [Measure::Volume, Measure::Area];

/// A measure by its name, which is one of all.
fn measure(name: String) -> Measure {
    MEASURES.into_iter().find(|of| of.name() == name).unwrap_or(Measure::Volume)
}

/// A kind of field by its name, which is one of all.
fn sdf_kind(name: String) -> SdfKind {
    SdfKind::ALL.into_iter().find(|of| of.name() == name).unwrap_or(SdfKind::Signed)
}

/// A layout of a field by its name, which is one of all.
fn sdf_layout(name: String) -> SdfLayout {
    SdfLayout::ALL.into_iter().find(|of| of.name() == name).unwrap_or(SdfLayout::Lattice)
}

impl BuildArgs {
    /// What builds the blob.
    pub fn builder(&self) -> Builder<'_> {
        let builder = Builder::new()
            .serve_all(self.serves.iter().flatten().copied())
            .unit(self.read.unit)
            .vertex_bits(self.vertex_bits.format())
            .base_faces(self.base)
            .collapse(self.collapse.options())
            .triboxes(self.triboxes)
            .tribox_error(self.split.tribox_error)
            .orient(self.split.orient)
            .extrema(self.split.extrema)
            .tight_faces(&self.tight)
            .slack(self.slack)
            .void_percent(self.void)
            .margin(self.margin)
            .effort(self.effort)
            .sdf_bytes(self.sdf)
            .sdf_error(self.sdf_error)
            .sdf_relative(self.sdf_rel)
            .sdf_kind(self.sdf_kind)
            .sdf_layout(self.sdf_layout)
            .sdf_margin(self.sdf_margin)
            .closed(self.closed);
        let asked = |of: HullServes| self.tight_for.contains(&of);
        let builder = match self.tight_for.as_slice() {
            [] => builder,
            _ => builder.tight_for(asked(HullServes::Closest), asked(HullServes::Segment)),
        };
        self.frames.iter().fold(builder, Builder::frame_file)
    }

    /// Whether a curve is to be built.
    pub fn is_curve(&self) -> bool {
        self.read.format == Some("csv") || self.builder().builds_curve(&self.mesh)
    }

    /// The question whose structure limits choose. `None` if several are given, or one that is not
    /// measured.
    pub fn measured(&self) -> Option<Question> {
        match self.serves.as_deref() {
            _ if self.is_curve() => None,
            None => Some(Question::ClosestPoint),
            Some(&[of]) => measured(of),
            Some(_) => None,
        }
    }

    /// The first given option that names what limits choose.
    pub fn chosen_option(&self) -> Option<&'static str> {
        let others = [
            ("--for", self.measured().is_none() && !self.is_curve()),
            ("--vertex-bits", self.vertex_bits != StoredBits::Auto),
            ("key frames", !self.frames.is_empty()),
        ];
        others.into_iter().find_map(|(option, given)| given.then_some(option))
    }
}

/// How a mesh is split into triboxes.
#[derive(Debug, Args)]
pub struct TriboxSplitArgs {
    /// Largest distance of a tribox from the hull of what it holds, in the mesh's unit
    ///
    /// Triboxes are split until each is within it. Without a limit that may take thousands of them.
    #[arg(long, value_name = "DISTANCE", value_parser = distance)]
    pub tribox_error: Option<f64>,
    /// Turn triboxes to where the whole mesh's has the least volume or area
    ///
    /// If those of the finest level then have less in all. A blob stores the rotation.
    #[arg(
        long,
        value_name = "volume|area",
        hide_possible_values = true,
        value_parser = PossibleValuesParser::new(MEASURES.map(Measure::name)).map(measure)
    )]
    pub orient: Option<Measure>,
    /// Split triboxes just beyond local extrema of the mesh too
    #[arg(long)]
    pub extrema: bool,
}

/// Conditions of edge collapses.
#[derive(Debug, Args)]
pub struct CollapseArgs {
    /// Largest valence of a hull vertex [default: 12]
    #[arg(
        long,
        value_name = "EDGES",
        value_parser = whole::<{ MAX_VALENCE[0] }, { MAX_VALENCE[1] }>
    )]
    pub max_valence: Option<u32>,
    /// Least ratio of a star's worst compactness after a collapse to that before it [default: 0.8]
    #[arg(long, value_name = "RATIO", value_parser = ratio)]
    pub compactness: Option<f64>,
    /// Largest change of a face's normal in a collapse, in degrees [default: 45]
    #[arg(long, value_name = "DEGREES", value_parser = degrees)]
    pub max_normal_deviation: Option<f64>,
    /// Which edge of an outer hull collapses next: program or span [default: program]
    ///
    /// program is the one that adds the least volume; span the one whose star spans the least,
    /// which is quicker to tell.
    #[arg(
        long,
        value_name = "PRIORITY",
        hide_possible_values = true,
        value_parser = PossibleValuesParser::new(PRIORITIES.map(Priority::name)).map(priority)
    )]
    pub priority: Option<Priority>,
    /// Order of planes in a vertex's linear program: violated, shuffled:SEED [default: violated]
    ///
    /// shuffled alone has the seed 0. violated takes the one that is violated most;
    /// shuffled is Seidel's random order.
    #[arg(long, value_name = "ORDER")]
    pub order: Option<Order>,
}

/// All priorities.
const PRIORITIES: [Priority; 2] = [Priority::Program, Priority::Span];

/// A priority by its name, which is one of all.
fn priority(name: String) -> Priority {
    PRIORITIES.into_iter().find(|of| of.name() == name).unwrap_or_default()
}

impl CollapseArgs {
    /// As the library takes them.
    pub fn options(&self) -> CollapseOptions {
        let Self { max_valence, compactness, max_normal_deviation, priority, order } = *self;
        CollapseOptions { max_valence, compactness, max_normal_deviation, priority, order }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum StoredBits {
    Auto,
    #[value(name = "16")]
    Sixteen,
    #[value(name = "24")]
    TwentyFour,
    #[value(name = "32")]
    ThirtyTwo,
}

impl StoredBits {
    /// Format of the hull's vertices.
    pub fn format(self) -> VertexBits {
        match self {
            StoredBits::Auto => VertexBits::Auto,
            StoredBits::Sixteen => VertexBits::Grid16,
            StoredBits::TwentyFour => VertexBits::Grid24,
            StoredBits::ThirtyTwo => VertexBits::F32,
        }
    }
}

#[derive(Debug, Args)]
pub struct InfoArgs {
    /// Blob file
    pub blob: PathBuf,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Args)]
pub struct VerifyArgs {
    /// Blob file
    pub blob: PathBuf,
    /// The mesh file that it was built from; or the points of its curves: .csv
    pub mesh: PathBuf,
    /// Of a blob that deforms: the same mesh at its further key frames, in their order
    pub frames: Vec<PathBuf>,
    #[command(flatten)]
    pub read: ReadArgs,
    #[command(flatten)]
    pub threads: ThreadArgs,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Args)]
#[command(group(
    ArgGroup::new("kept").args(["level", "triboxes", "tight"]).required(true).multiple(true)
))]
pub struct CutArgs {
    /// Blob file, built --for hull, sweep, triboxes or tight
    pub blob: PathBuf,
    /// Finest level of the hull hierarchy to keep, 0 being the coarsest
    #[arg(long, value_parser = whole::<0, { u32::MAX }>)]
    pub level: Option<u32>,
    /// Keep the finest level of at most so many triboxes
    #[arg(long, value_name = "N", value_parser = whole::<1, { u32::MAX }>)]
    pub triboxes: Option<u32>,
    /// Keep the tight hulls of at most so many faces
    #[arg(long, value_name = "FACES", value_parser = whole::<4, { u32::MAX }>)]
    pub tight: Option<u32>,
    /// Blob to write
    #[arg(short, long, value_name = "BLOB")]
    pub output: PathBuf,
}
