//! The command line. Values are checked here, so that a bad one is a usage error (exit status 2) before any file is touched.

use clap::{Args, Parser, Subcommand, ValueEnum};
use meshsweep_alloc::collapse::{Conditions, Priority};
use meshsweep_alloc::precision::VertexBits;
use std::path::PathBuf;

/// Closest points, first hits and outer hulls of triangle meshes, with guaranteed intervals.
///
/// Without a command: a short demonstration on a mesh that is built in.
#[derive(Debug, Parser)]
#[command(name = "meshsweep", version, after_help = EXIT_STATUS)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Option<Command>,
}

const EXIT_STATUS: &str = "Exit status: 0 done, 1 a file or its content is not usable, 2 wrong usage.";

const QUERY_FILES: &str = "Query files: decimal numbers separated by commas, semicolons or blanks, one query on a line; \
    a header line, blank lines and comments from # on are skipped. '-' reads this from the standard input. A file named \
    *.f32 holds raw little-endian f32 numbers.";

const HIT_COLUMN: &str = "The column 'hit' says yes, with the first hit; no, which is proved; or unknown, if the query ended \
    early, the blob is cut, or its vertices were moved to a grid: then the segment is proved clear before t, which px, py, pz \
    belong to. Cut blobs and such grids prove 'no' but not 'yes'. t is the hit rounded to f32.";

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Build a blob from a closed mesh (.stl, .ply, .obj)
    Build(BuildArgs),
    /// Print what a blob holds: sections, memory, levels, error bounds
    Info(InfoArgs),
    /// Closest point and distance interval of each query point, as CSV
    #[command(after_help = QUERY_FILES)]
    Closest(ClosestArgs),
    /// First hit, or all hits, of each query segment, as CSV
    #[command(after_help = format!("{HIT_COLUMN}\n\n{QUERY_FILES}"))]
    Segment(SegmentArgs),
    /// Write an outer hull of a mesh, or a level of a blob, as binary PLY
    Hull(HullArgs),
    /// Cut a blob after a level: fewer bytes, wider intervals
    Cut(CutArgs),
}

#[derive(Debug, Args)]
pub struct BuildArgs {
    /// Mesh file: .stl, .ply or .obj
    pub mesh: PathBuf,
    /// Blob to write
    #[arg(short, long, value_name = "BLOB")]
    pub output: PathBuf,
    /// Faces of the base hull
    #[arg(long, value_name = "FACES", default_value_t = 200, value_parser = clap::value_parser!(u32).range(4..))]
    pub base: u32,
    /// Bits of a stored coordinate; 16 and 24 move vertices to a grid, which the blob's surface error accounts for
    #[arg(long, value_enum, default_value_t = StoredBits::Auto)]
    pub vertex_bits: StoredBits,
    #[command(flatten)]
    pub collapse: CollapseArgs,
    /// Queries that the blob must serve; at present every blob serves all of them
    #[arg(long = "for", value_enum, value_delimiter = ',', value_name = "QUERIES")]
    pub serves: Vec<Serves>,
}

/// Order and conditions of edge collapses.
#[derive(Debug, Args)]
pub struct CollapseArgs {
    /// Order of collapses: lp, by the volume that each adds (tighter hulls); span, by a cheaper estimate of it
    #[arg(long, value_enum, default_value_t = PriorityName::Lp)]
    pub priority: PriorityName,
    /// Largest valence of a hull vertex
    #[arg(long, value_name = "EDGES", default_value_t = 12, value_parser = clap::value_parser!(u8).range(3..))]
    pub max_valence: u8,
    /// Least ratio of a star's worst compactness after a collapse to that before it
    #[arg(long, value_name = "RATIO", default_value_t = 0.8, value_parser = ratio)]
    pub compactness: f64,
    /// Largest change of a face's normal in a collapse, in degrees
    #[arg(long, value_name = "DEGREES", default_value_t = 45.0, value_parser = degrees)]
    pub max_normal_deviation: f64,
}

impl CollapseArgs {
    pub fn priority(&self) -> Priority {
        match self.priority {
            PriorityName::Lp => Priority::Program,
            PriorityName::Span => Priority::Span,
        }
    }

    pub fn conditions(&self) -> Conditions {
        let default = Conditions::default();
        // The library's cosine of 45° and this one may differ in the last bit, and the blob's bytes with them.
        let is_default = self.max_normal_deviation == 45.0;
        let cosine = self.max_normal_deviation.to_radians().cos();
        Conditions {
            max_valence: usize::from(self.max_valence),
            compactness_ratio: self.compactness,
            min_normal_cosine: if is_default { default.min_normal_cosine } else { cosine },
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
    /// The fewest that store the mesh exactly
    Auto,
    #[value(name = "16")]
    Sixteen,
    #[value(name = "24")]
    TwentyFour,
    /// Single precision
    #[value(name = "32")]
    ThirtyTwo,
}

impl StoredBits {
    pub fn format(self) -> VertexBits {
        match self {
            StoredBits::Auto => VertexBits::Auto,
            StoredBits::Sixteen => VertexBits::Grid16,
            StoredBits::TwentyFour => VertexBits::Grid24,
            StoredBits::ThirtyTwo => VertexBits::F32,
        }
    }
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Serves {
    Closest,
    Segment,
    Hull,
}

#[derive(Debug, Args)]
pub struct InfoArgs {
    /// Blob file
    pub blob: PathBuf,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}

/// Where answers go, and what limits a search on the cover tree.
#[derive(Debug, Args)]
pub struct SearchArgs {
    /// CSV file to write instead of the standard output
    #[arg(short, long, value_name = "CSV")]
    pub output: Option<PathBuf>,
    /// Stop a query after opening so many nodes
    #[arg(long, value_name = "NODES")]
    pub steps: Option<u32>,
    /// Queue entries to search with; the default is what the blob needs, and no less than 4096
    #[arg(long, value_name = "ENTRIES", value_parser = clap::value_parser!(u32).range(1..=1 << 24))]
    pub queue: Option<u32>,
    /// Print nanoseconds per query to the standard error
    #[arg(long)]
    pub time: bool,
}

#[derive(Debug, Args)]
pub struct ClosestArgs {
    /// Blob file
    pub blob: PathBuf,
    /// Query points: x, y, z
    pub points: PathBuf,
    /// Stop a query when upper ≤ lower · (1 + REL)
    #[arg(long, value_name = "REL", default_value_t = 0.0, allow_negative_numbers = true, value_parser = tolerance)]
    pub rel: f32,
    /// Stop a query when upper − lower ≤ ABS, in the mesh's unit
    #[arg(long, value_name = "ABS", default_value_t = 0.0, allow_negative_numbers = true, value_parser = tolerance)]
    pub abs: f32,
    #[command(flatten)]
    pub search: SearchArgs,
}

#[derive(Debug, Args)]
pub struct SegmentArgs {
    /// Blob file
    pub blob: PathBuf,
    /// Query segments: ax, ay, az, bx, by, bz
    pub segments: PathBuf,
    /// All hits, one on a line, with the number of the query (from 0) in front
    #[arg(long, conflicts_with = "steps")]
    pub all: bool,
    /// cover, the cover tree; or hull, the selectively refined hull, for first hits of segments that start outside (others
    /// use the tree), without --all, --steps and --queue
    #[arg(long, value_enum, default_value_t = Engine::Cover)]
    pub engine: Engine,
    #[command(flatten)]
    pub search: SearchArgs,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Engine {
    Cover,
    Hull,
}

#[derive(Debug, Args)]
pub struct HullArgs {
    /// Mesh file, with --faces; or blob file, with --level
    pub input: PathBuf,
    /// PLY file to write
    #[arg(short, long, value_name = "PLY")]
    pub output: PathBuf,
    /// Faces of the hull of a mesh [default: 200]
    #[arg(long, value_parser = clap::value_parser!(u32).range(4..))]
    pub faces: Option<u32>,
    /// Level of a blob, 0 being the coarsest
    #[arg(long, conflicts_with_all = ["faces", "priority", "max_valence", "compactness", "max_normal_deviation"])]
    pub level: Option<u32>,
    #[command(flatten)]
    pub collapse: CollapseArgs,
}

#[derive(Debug, Args)]
pub struct CutArgs {
    /// Blob file
    pub blob: PathBuf,
    /// Finest level to keep, 0 being the coarsest
    #[arg(long)]
    pub level: u32,
    /// Blob to write
    #[arg(short, long, value_name = "BLOB")]
    pub output: PathBuf,
}

fn tolerance(text: &str) -> Result<f32, String> {
    let wanted = "a number from 0 to 3.4e38 is wanted";
    text.parse().ok().filter(|x: &f32| *x >= 0.0 && x.is_finite()).ok_or_else(|| wanted.to_owned())
}

fn within(text: &str, most: f64) -> Result<f64, String> {
    let wanted = || format!("a number from 0 to {most} is wanted");
    text.parse().ok().filter(|x| (0.0..=most).contains(x)).ok_or_else(wanted)
}

fn ratio(text: &str) -> Result<f64, String> {
    within(text, 1.0)
}

fn degrees(text: &str) -> Result<f64, String> {
    within(text, 180.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        Arguments::command().debug_assert();
    }
}
