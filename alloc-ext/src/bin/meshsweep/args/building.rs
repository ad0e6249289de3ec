//! Arguments of the commands that make, describe and cut blobs.

use super::measuring::LimitArgs;
use super::values::{degrees, distance, factor, length, percent, ratio, unit, whole};
use clap::{ArgGroup, Args, ValueEnum};
use meshsweep::collapse::{Conditions, Priority};
use meshsweep::hull::BuildOptions;
use meshsweep::mesh::Unit;
use meshsweep::surface::VertexBits;
use std::path::PathBuf;

/// Faces of a hull unless told otherwise.
pub const FACES: u32 = 200;

#[derive(Debug, Args)]
pub struct BuildArgs {
    /// Mesh file: .stl, .ply, .obj, .off, .glb, .gltf or .3mf; or points of curves: .csv
    pub mesh: PathBuf,
    /// With --for deform: the same mesh at further key frames, with the same triangles
    pub frames: Vec<PathBuf>,
    /// Blob to write
    #[arg(short, long, value_name = "BLOB")]
    pub output: PathBuf,
    /// Questions that the blob must serve; only the sections that they need are written (see below)
    /// [default: closest,segment]
    #[arg(long = "for", value_enum, value_delimiter = ',', value_name = "QUESTIONS")]
    serves: Option<Vec<Serves>>,
    /// Unit of the mesh: um, mm, cm, m, in or ft. glTF, which is in metres, and 3MF are scaled to
    /// it; of other files it is the unit of their numbers
    #[arg(long, value_name = "UNIT", value_parser = unit)]
    pub unit: Option<Unit>,
    /// Bits of a stored coordinate (see below)
    #[arg(
        long,
        value_enum,
        value_name = "BITS",
        default_value_t = StoredBits::Auto,
        hide_possible_values = true
    )]
    pub vertex_bits: StoredBits,
    /// Faces of the base hull, with --for hull or sweep [default: 200]
    #[arg(long, value_name = "FACES", value_parser = whole::<4, { u32::MAX }>)]
    pub base: Option<u32>,
    /// Most triboxes of the finest level, with --for triboxes [default: 64]
    #[arg(long, value_name = "N", value_parser = whole::<1, MAX_TRIBOXES>)]
    pub triboxes: Option<u32>,
    /// Faces of each tight hull, with --for tight [default: 200]
    #[arg(long, value_name = "FACES", value_delimiter = ',', value_parser = whole::<4, MAX_TIGHT>)]
    pub tight: Vec<u32>,
    /// Instead of numbers of faces: one tight hull, with the fewest faces found such that no point
    /// of it is farther than this from the mesh, in its unit
    #[arg(long, value_name = "DISTANCE", value_parser = distance, conflicts_with = "tight")]
    pub slack: Option<f64>,
    /// Instead of numbers of faces: one tight hull, with the fewest faces found that leave at most
    /// this void, in percent of the mesh's volume
    #[arg(
        long,
        value_name = "PERCENT",
        value_parser = percent,
        conflicts_with_all = ["tight", "slack"]
    )]
    pub void: Option<f64>,
    /// Distance that tight hulls keep from the mesh, in its unit: all points up to it are inside
    /// [default: 0]
    #[arg(long, value_name = "DISTANCE", value_parser = length)]
    pub margin: Option<f64>,
    /// How long to polish tight hulls, as a factor: 0 not at all, 4 four times as long [default:
    /// 1]
    #[arg(long, value_name = "FACTOR", value_parser = factor)]
    pub effort: Option<f64>,
    /// Questions to tight hulls: closest; segment, which only the library asks [default:
    /// closest,segment]
    #[arg(
        long,
        value_enum,
        value_delimiter = ',',
        value_name = "QUESTIONS",
        hide_possible_values = true
    )]
    pub tight_for: Vec<HullServes>,
    /// With --for curve: join the last point of each polyline with its first
    #[arg(long)]
    pub closed: bool,
    /// Write the blob as source text too, beside it: part.rs, or part.h and part.c
    #[arg(long, value_enum, value_delimiter = ',', value_name = "LANGUAGE")]
    pub emit: Vec<Language>,
    #[command(flatten)]
    pub collapse: CollapseArgs,
    #[command(flatten)]
    pub limits: LimitArgs,
}

/// Most faces of a stored tight hull.
const MAX_TIGHT: u32 = 1_000_000;

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

/// Most triboxes of a blob. More take too long.
const MAX_TRIBOXES: u32 = 4096;

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Serves {
    Closest,
    Segment,
    Hull,
    Sweep,
    Cull,
    Triboxes,
    Tight,
    Curve,
    Deform,
    Winding,
}

/// The questions that a blob must serve.
#[derive(Clone, Copy, Debug)]
pub struct Wanted {
    pub closest: bool,
    pub segment: bool,
    pub hull: bool,
    /// A hierarchy for sweeps alone. Hulls serve sweeps too.
    pub sweep: bool,
    pub cull: bool,
    pub winding: bool,
    pub triboxes: bool,
    pub tight: bool,
    pub deform: bool,
}

impl Wanted {
    /// Whether any question needs the box tree.
    pub fn tree(self) -> bool {
        self.closest || self.segment || self.cull || self.winding
    }

    /// Whether any question needs the hull hierarchy.
    pub fn hierarchy(self) -> bool {
        self.hull || self.sweep
    }
}

impl BuildArgs {
    /// The questions that the blob must serve.
    pub fn serves(&self) -> &[Serves] {
        self.serves.as_deref().unwrap_or(&[Serves::Closest, Serves::Segment])
    }

    pub fn wanted(&self) -> Wanted {
        let has = |what: Serves| self.serves().contains(&what);
        Wanted {
            closest: has(Serves::Closest),
            segment: has(Serves::Segment),
            hull: has(Serves::Hull) || has(Serves::Deform),
            sweep: has(Serves::Sweep) && !has(Serves::Hull) && !has(Serves::Deform),
            cull: has(Serves::Cull),
            winding: has(Serves::Winding),
            triboxes: has(Serves::Triboxes),
            tight: has(Serves::Tight),
            deform: has(Serves::Deform),
        }
    }

    /// Whether a curve is to be built: the file is CSV, or `--for` says so.
    pub fn is_curve(&self) -> bool {
        let is_csv = self.mesh.extension().is_some_and(|csv| csv.eq_ignore_ascii_case("csv"));
        is_csv || self.serves().contains(&Serves::Curve)
    }

    /// Whether `--for` asks of a curve what only meshes have. Its default does not count.
    pub fn asks_mesh_of_curve(&self) -> bool {
        self.is_curve() && self.serves.as_ref().is_some_and(|asked| *asked != [Serves::Curve])
    }

    /// The first given option that applies to tight hulls only.
    pub fn tight_option(&self) -> Option<&'static str> {
        [
            ("--tight", !self.tight.is_empty()),
            ("--slack", self.slack.is_some()),
            ("--void", self.void.is_some()),
            ("--margin", self.margin.is_some()),
            ("--effort", self.effort.is_some()),
            ("--tight-for", !self.tight_for.is_empty()),
        ]
        .into_iter()
        .find_map(|(option, given)| given.then_some(option))
    }

    /// The first given option that names what limits choose.
    pub fn chosen_option(&self) -> Option<&'static str> {
        let others = [
            ("--for", self.serves.is_some() || self.is_curve()),
            ("--vertex-bits", self.vertex_bits != StoredBits::Auto),
            ("key frames", !self.frames.is_empty()),
        ];
        others.into_iter().find_map(|(option, given)| given.then_some(option))
    }

    /// The first given option that applies to the hull hierarchy only.
    pub fn hull_option(&self) -> Option<&'static str> {
        if self.base.is_some() { Some("--base") } else { self.collapse.given() }
    }
}

/// Conditions of edge collapses.
#[derive(Debug, Args)]
pub struct CollapseArgs {
    /// Largest valence of a hull vertex [default: 12]
    #[arg(long, value_name = "EDGES", value_parser = whole::<3, 255>)]
    pub max_valence: Option<u32>,
    /// Least ratio of a star's worst compactness after a collapse to that before it [default: 0.8]
    #[arg(long, value_name = "RATIO", value_parser = ratio)]
    pub compactness: Option<f64>,
    /// Largest change of a face's normal in a collapse, in degrees [default: 45]
    #[arg(long, value_name = "DEGREES", value_parser = degrees)]
    pub max_normal_deviation: Option<f64>,
}

impl CollapseArgs {
    /// The first given option.
    pub fn given(&self) -> Option<&'static str> {
        let Self { max_valence, compactness, max_normal_deviation } = self;
        [
            ("--max-valence", max_valence.is_some()),
            ("--compactness", compactness.is_some()),
            ("--max-normal-deviation", max_normal_deviation.is_some()),
        ]
        .into_iter()
        .find_map(|(option, given)| given.then_some(option))
    }

    /// Options of a progressive hull of so many faces.
    pub fn options(&self, faces: u32, bits: StoredBits) -> BuildOptions {
        BuildOptions {
            base_faces: faces as usize,
            priority: Priority::Program,
            conditions: self.conditions(),
            vertex_bits: bits.format(),
        }
    }

    fn conditions(&self) -> Conditions {
        let default = Conditions::default();
        // The library's cosine of 45° may differ from this one in the last bit, and so would the
        // blob's bytes.
        let cosine = |degrees: f64| {
            if degrees == 45.0 { default.min_normal_cosine } else { degrees.to_radians().cos() }
        };
        Conditions {
            max_valence: self.max_valence.map_or(default.max_valence, |edges| edges as usize),
            compactness_ratio: self.compactness.unwrap_or(default.compactness_ratio),
            min_normal_cosine: self.max_normal_deviation.map_or(default.min_normal_cosine, cosine),
            ..default
        }
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

    /// Whether vertices move to a grid of this many bits.
    pub fn is_grid(self) -> bool {
        matches!(self, StoredBits::Sixteen | StoredBits::TwentyFour)
    }

    /// Whether the box tree's vertices are f32.
    pub fn is_f32(self) -> bool {
        matches!(self, StoredBits::TwentyFour | StoredBits::ThirtyTwo)
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
    /// The unit of `build --unit`, if it was given
    #[arg(long, value_name = "UNIT", value_parser = unit)]
    pub unit: Option<Unit>,
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
