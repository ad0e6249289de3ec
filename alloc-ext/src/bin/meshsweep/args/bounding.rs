//! Arguments of the commands that write hulls and triboxes of meshes.

use super::building::{CollapseArgs, StoredBits, TriboxSplitArgs};
use super::reading::{ReadArgs, ThreadArgs};
use super::values::{distance, factor, length, percent, positive, tolerance, whole};
use clap::Args;
use meshsweep::tribox::{Planes, SplitOptions};
use std::path::PathBuf;

/// Groups of the options of hulls that are made from a mesh. Each is named as its struct.
const OF_MESH: [&str; 3] = ["HullOfMeshArgs", "ReadArgs", "CollapseArgs"];

#[derive(Debug, Args)]
pub struct HullArgs {
    /// Mesh file; or - for the standard input, with --format; or blob file, with --level or --tight
    pub input: PathBuf,
    /// PLY file to write
    #[arg(short, long, value_name = "PLY")]
    pub output: PathBuf,
    #[command(flatten)]
    pub of_mesh: HullOfMeshArgs,
    /// Level of a blob, 0 being the coarsest
    #[arg(
        long,
        value_parser = whole::<0, { u32::MAX }>,
        conflicts_with_all = OF_MESH
    )]
    pub level: Option<u32>,
    /// The finest tight hull of a blob of at most so many faces
    #[arg(
        long,
        value_name = "FACES",
        value_parser = whole::<4, { u32::MAX }>,
        conflicts_with_all = OF_MESH,
        conflicts_with = "level"
    )]
    pub tight: Option<u32>,
    #[command(flatten)]
    pub read: ReadArgs,
    #[command(flatten)]
    pub collapse: CollapseArgs,
    #[command(flatten)]
    pub threads: ThreadArgs,
    /// Print one JSON object in place of the report
    #[arg(long)]
    pub json: bool,
}

/// How a hull of a mesh is made.
#[derive(Debug, Args)]
pub struct HullOfMeshArgs {
    /// Most faces of the hull of a mesh [default: 200]
    #[arg(long, value_parser = whole::<4, { u32::MAX }>)]
    pub faces: Option<u32>,
    /// Fewest faces found that leave at most this void, in percent of the mesh's volume
    #[arg(
        long,
        value_name = "PERCENT",
        value_parser = percent,
        conflicts_with_all = ["faces", "progressive"]
    )]
    pub void: Option<f64>,
    /// Fewest faces found within this distance of the mesh, in its unit
    ///
    /// No point of the hull is farther than this from the mesh.
    #[arg(
        long,
        value_name = "DISTANCE",
        value_parser = distance,
        conflicts_with_all = ["faces", "void", "progressive"]
    )]
    pub slack: Option<f64>,
    /// Distance that the hull keeps from the mesh, in its unit [default: 0]
    ///
    /// All points within the distance are inside.
    #[arg(long, value_name = "DISTANCE", value_parser = length, conflicts_with = "progressive")]
    pub margin: Option<f64>,
    /// One hull for each connected component of the mesh, all in one file
    #[arg(long, conflicts_with = "progressive")]
    pub parts: bool,
    /// How long to polish, as a factor: 0 not at all [default: 1]
    #[arg(long, value_name = "FACTOR", value_parser = factor, conflicts_with = "progressive")]
    pub effort: Option<f64>,
    /// Stop each hull after about so many seconds
    ///
    /// It has more faces than asked for if they are not gone by then.
    #[arg(long, value_name = "SECONDS", value_parser = positive, conflicts_with = "progressive")]
    pub seconds: Option<f64>,
    /// The progressive hull: looser, as the levels of a blob's hull hierarchy are
    #[arg(long)]
    pub progressive: bool,
    /// Bits of a coordinate of a mesh's hull: auto, 16, 24 or 32
    ///
    /// 16 and 24 move the mesh to a grid. 32 is single precision. auto is 32, or the fewest that
    /// hold the mesh exactly if the hull is progressive.
    #[arg(
        long,
        value_enum,
        value_name = "BITS",
        default_value_t = StoredBits::Auto,
        hide_possible_values = true
    )]
    pub vertex_bits: StoredBits,
}

impl HullArgs {
    /// The first given option that applies to a progressive hull only.
    pub fn progressive_option(&self) -> Option<&'static str> {
        self.collapse.options().given()
    }
}

#[derive(Debug, Args)]
pub struct TriboxArgs {
    /// Mesh file, as those of build; or - for the standard input, with --format
    pub mesh: PathBuf,
    /// PLY file to write: the triboxes of the finest level
    #[arg(short, long, value_name = "PLY")]
    pub output: Option<PathBuf>,
    #[command(flatten)]
    pub read: ReadArgs,
    /// Levels, of 1, 2, 4, ... triboxes [default: 7; with --tribox-error 12]
    #[arg(long, value_name = "N", value_parser = whole::<1, 12>)]
    pub levels: Option<u32>,
    #[command(flatten)]
    pub split: TriboxSplitArgs,
    /// How far planes may move outward so that small faces vanish, in the mesh's unit
    #[arg(
        long,
        value_name = "T",
        default_value_t = 0.0,
        value_parser = tolerance,
        hide_default_value = true
    )]
    pub simplify: f32,
    #[command(flatten)]
    pub threads: ThreadArgs,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}

impl TriboxArgs {
    /// Most levels.
    pub fn levels(&self) -> u32 {
        self.levels.unwrap_or(if self.split.tribox_error.is_some() { 12 } else { 7 })
    }

    /// What splits the mesh, without --extrema.
    pub fn plain(&self) -> SplitOptions {
        SplitOptions::default()
            .with_leaves(1 << (self.levels() - 1))
            .with_error(self.split.tribox_error)
            .with_simplify(self.simplify)
    }

    /// What splits the mesh.
    pub fn options(&self) -> SplitOptions {
        let plain = self.plain();
        if self.split.extrema { plain.with_planes(Planes::EXTREMA) } else { plain }
    }
}
