//! Arguments of the commands that make, describe and cut blobs.

use super::values::{degrees, distance, factor, length, percent, positive, ratio, whole};
use crate::describe::Given;
use clap::{ArgGroup, Args, ValueEnum};
use meshsweep::collapse::{Conditions, Priority};
use meshsweep::precision::VertexBits;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct BuildArgs {
    /// Mesh file: .stl, .ply or .obj
    pub mesh: PathBuf,
    /// Blob to write
    #[arg(short, long, value_name = "BLOB")]
    pub output: PathBuf,
    /// What the blob will be asked; only what that needs is written (see below)
    #[arg(
        long = "for",
        value_enum,
        value_delimiter = ',',
        value_name = "QUESTIONS",
        default_value = "closest,segment"
    )]
    pub serves: Vec<Serves>,
    /// Bits of a stored coordinate (see below)
    #[arg(long, value_enum, value_name = "BITS", default_value_t = StoredBits::Auto, hide_possible_values = true)]
    pub vertex_bits: StoredBits,
    /// Faces of the base hull, with --for hull [default: 200]
    #[arg(long, value_name = "FACES", allow_negative_numbers = true, value_parser = whole::<4, { u32::MAX }>)]
    pub base: Option<u32>,
    /// Most triboxes of the finest level, with --for triboxes [default: 64]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = whole::<1, MAX_TRIBOXES>)]
    pub triboxes: Option<u32>,
    /// Faces of each tight hull, with --for tight [default: 200]
    #[arg(long, value_name = "FACES", value_delimiter = ',', allow_negative_numbers = true, value_parser = whole::<4, MAX_TIGHT>)]
    pub tight: Vec<u32>,
    /// Instead of numbers of faces one tight hull, with the fewest faces found of which no point
    /// is farther than this from the mesh, in its unit
    #[arg(long, value_name = "DISTANCE", allow_negative_numbers = true, value_parser = distance, conflicts_with = "tight")]
    pub slack: Option<f64>,
    /// Instead of numbers of faces one tight hull, with the fewest faces found that leave at most
    /// this void space, in percent of the mesh's volume
    #[arg(long, value_name = "PERCENT", allow_negative_numbers = true, value_parser = percent, conflicts_with_all = ["tight", "slack"])]
    pub void: Option<f64>,
    /// Distance that tight hulls keep from the mesh, in its unit: all points that are no farther
    /// are inside [default: 0]
    #[arg(long, value_name = "DISTANCE", allow_negative_numbers = true, value_parser = length)]
    pub margin: Option<f64>,
    /// How long to polish tight hulls, as a factor: 0 not at all, 4 four times as long [default:
    /// 1]
    #[arg(long, value_name = "FACTOR", allow_negative_numbers = true, value_parser = factor)]
    pub effort: Option<f64>,
    /// Questions to tight hulls: closest; segment, which no command asks, only the library
    /// [default: closest,segment]
    #[arg(
        long,
        value_enum,
        value_delimiter = ',',
        value_name = "QUESTIONS",
        hide_possible_values = true
    )]
    pub tight_for: Vec<HullServes>,
    #[command(flatten)]
    pub collapse: CollapseArgs,
}

/// Most faces of a tight hull that is stored.
const MAX_TIGHT: u32 = 1_000_000;

/// Questions to a tight hull.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum HullServes {
    // Distances of the mesh within.
    Closest,
    // Segments, and overlap of hulls.
    Segment,
}

/// Most triboxes that are worth the time.
const MAX_TRIBOXES: u32 = 4096;

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Serves {
    Closest,
    Segment,
    Hull,
    Cull,
    Triboxes,
    Tight,
}

/// What a blob has to serve.
#[derive(Clone, Copy, Debug)]
pub struct Wanted {
    pub closest: bool,
    pub segment: bool,
    pub hull: bool,
    pub cull: bool,
    pub triboxes: bool,
    pub tight: bool,
}

impl Wanted {
    /// Whether any question needs the box tree.
    pub fn tree(self) -> bool {
        self.closest || self.segment || self.cull
    }
}

impl BuildArgs {
    pub fn wanted(&self) -> Wanted {
        let has = |what: Serves| self.serves.contains(&what);
        Wanted {
            closest: has(Serves::Closest),
            segment: has(Serves::Segment),
            hull: has(Serves::Hull),
            cull: has(Serves::Cull),
            triboxes: has(Serves::Triboxes),
            tight: has(Serves::Tight),
        }
    }

    /// The first option given that only tight hulls heed.
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

    /// The first option given that only a hull heeds.
    pub fn hull_option(&self) -> Option<&'static str> {
        if self.base.is_some() { Some("--base") } else { self.collapse.given() }
    }
}

/// Order and conditions of edge collapses.
#[derive(Debug, Args)]
pub struct CollapseArgs {
    /// Order of the hull's collapses: lp, by the volume that each adds (tighter); span, by a
    /// cheaper estimate of it [default: lp]
    #[arg(long, value_enum, hide_possible_values = true)]
    pub priority: Option<PriorityName>,
    /// Largest valence of a hull vertex [default: 12]
    #[arg(long, value_name = "EDGES", allow_negative_numbers = true, value_parser = whole::<3, 255>)]
    pub max_valence: Option<u32>,
    /// Least ratio of a star's worst compactness after a collapse to that before it [default: 0.8]
    #[arg(long, value_name = "RATIO", allow_negative_numbers = true, value_parser = ratio)]
    pub compactness: Option<f64>,
    /// Largest change of a face's normal in a collapse, in degrees [default: 45]
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, value_parser = degrees)]
    pub max_normal_deviation: Option<f64>,
}

impl CollapseArgs {
    /// The first of these options that is given.
    fn given(&self) -> Option<&'static str> {
        let Self { priority, max_valence, compactness, max_normal_deviation } = self;
        [
            ("--priority", priority.is_some()),
            ("--max-valence", max_valence.is_some()),
            ("--compactness", compactness.is_some()),
            ("--max-normal-deviation", max_normal_deviation.is_some()),
        ]
        .into_iter()
        .find_map(|(option, given)| given.then_some(option))
    }

    pub fn priority(&self) -> Priority {
        match self.priority {
            None | Some(PriorityName::Lp) => Priority::Program,
            Some(PriorityName::Span) => Priority::Span,
        }
    }

    pub fn conditions(&self) -> Conditions {
        let default = Conditions::default();
        // The library's cosine of 45° and this one may differ in the last bit, and the blob's bytes
        // with them.
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

#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum PriorityName {
    Lp,
    Span,
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

    /// Whether the box tree's vertices are f32.
    pub fn is_single(self) -> bool {
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
pub struct HullArgs {
    /// Mesh file; or blob file, with --level or --tight
    pub input: PathBuf,
    /// PLY file to write
    #[arg(short, long, value_name = "PLY")]
    pub output: PathBuf,
    /// Most faces of the hull of a mesh [default: 200]
    #[arg(long, allow_negative_numbers = true, value_parser = whole::<4, { u32::MAX }>)]
    pub faces: Option<u32>,
    /// Fewest faces found that leave at most this void space, in percent of the mesh's volume
    #[arg(long, value_name = "PERCENT", allow_negative_numbers = true, value_parser = percent, conflicts_with_all = ["faces", "progressive"])]
    pub void: Option<f64>,
    /// Fewest faces found of which no point is farther than this from the mesh, in its unit
    #[arg(long, value_name = "DISTANCE", allow_negative_numbers = true, value_parser = distance, conflicts_with_all = ["faces", "void", "progressive"])]
    pub slack: Option<f64>,
    /// Distance that the hull keeps from the mesh, in its unit: all points that are no farther are
    /// inside [default: 0]
    #[arg(long, value_name = "DISTANCE", allow_negative_numbers = true, value_parser = length, conflicts_with = "progressive")]
    pub margin: Option<f64>,
    /// One hull for each part of the mesh, all in one file
    #[arg(long, conflicts_with = "progressive")]
    pub parts: bool,
    /// How long to polish, as a factor: 0 not at all, 4 four times as long [default: 1]
    #[arg(long, value_name = "FACTOR", allow_negative_numbers = true, value_parser = factor, conflicts_with = "progressive")]
    pub effort: Option<f64>,
    /// Stop each hull after about so many seconds: with more faces than asked for, if they are not
    /// gone by then
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true, value_parser = positive, conflicts_with = "progressive")]
    pub seconds: Option<f64>,
    /// The progressive hull: looser, but levels of a blob's hull hierarchy enclose each other so
    #[arg(long)]
    pub progressive: bool,
    /// Level of a blob, 0 being the coarsest
    #[arg(
        long,
        allow_negative_numbers = true,
        value_parser = whole::<0, { u32::MAX }>,
        conflicts_with_all = [
            "faces", "void", "slack", "margin", "parts", "effort", "seconds", "progressive", "vertex_bits", "priority", "max_valence", "compactness",
            "max_normal_deviation"
        ]
    )]
    pub level: Option<u32>,
    /// The finest tight hull of a blob of at most so many faces
    #[arg(
        long,
        value_name = "FACES",
        allow_negative_numbers = true,
        value_parser = whole::<4, { u32::MAX }>,
        conflicts_with_all = [
            "level", "faces", "void", "slack", "margin", "parts", "effort", "seconds", "progressive", "vertex_bits", "priority", "max_valence",
            "compactness", "max_normal_deviation"
        ]
    )]
    pub tight: Option<u32>,
    /// Bits of a coordinate of the hull of a mesh: auto, single precision, or with --progressive
    /// the fewest that hold the mesh exactly; 16 or 24, on a grid, to which the mesh moves;
    /// 32, single precision
    #[arg(long, value_enum, value_name = "BITS", default_value_t = StoredBits::Auto, hide_possible_values = true)]
    pub vertex_bits: StoredBits,
    #[command(flatten)]
    pub collapse: CollapseArgs,
}

impl HullArgs {
    /// The first option given that only a progressive hull heeds.
    pub fn progressive_option(&self) -> Option<&'static str> {
        self.collapse.given()
    }
}

/// Why no hull has both a slack and a margin, if none has.
pub fn slack_within_margin(slack: Option<f64>, margin: Option<f64>) -> Option<String> {
    let (slack, margin) = (slack?, margin?);
    let is_within = slack <= margin;
    is_within.then(|| {
        let (slack, margin) = (Given(slack), Given(margin));
        format!(
            "--slack {slack} is no more than --margin {margin}: the hull is farther from the mesh than the margin; ask \
             for a larger --slack"
        )
    })
}

#[derive(Debug, Args)]
#[command(group(ArgGroup::new("kept").args(["level", "triboxes", "tight"]).required(true).multiple(true)))]
pub struct CutArgs {
    /// Blob file, built --for hull, triboxes or tight
    pub blob: PathBuf,
    /// Finest level of the hull hierarchy to keep, 0 being the coarsest
    #[arg(long, allow_negative_numbers = true, value_parser = whole::<0, { u32::MAX }>)]
    pub level: Option<u32>,
    /// Keep the finest level of at most so many triboxes
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = whole::<1, { u32::MAX }>)]
    pub triboxes: Option<u32>,
    /// Keep the tight hulls of at most so many faces
    #[arg(long, value_name = "FACES", allow_negative_numbers = true, value_parser = whole::<4, { u32::MAX }>)]
    pub tight: Option<u32>,
    /// Blob to write
    #[arg(short, long, value_name = "BLOB")]
    pub output: PathBuf,
}
