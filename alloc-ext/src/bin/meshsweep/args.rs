//! The command line. Values are checked here, so that a bad one is a usage error (exit status 2) before any file is touched.

mod asking;
mod building;
mod values;

pub use asking::{
    ClosestArgs, ClosestEngine, CullArgs, FieldArgs, NearestArgs, PointArgs, SearchArgs, SegmentArgs,
    SegmentEngine, SignedArgs, WithinArgs,
};
pub use building::{BuildArgs, CutArgs, HullArgs, InfoArgs, StoredBits};
pub use values::Margin;

use clap::{Parser, Subcommand};

/// Distances, hits, signs and outer hulls of triangle meshes, with guaranteed intervals.
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

const BUILD: &str = "What --for takes:\n  \
    closest   closest, within, nearest, field; signed too if the mesh is closed\n  \
    segment   segment\n  \
    cull      cull\n  \
    hull      hull --level, cut, and closest and segment with --engine cover or hull\n\
    The first three share a box tree, which any mesh will do for, open or not, and which is built in seconds. \
    hull is the progressive hull with its split tables; it needs a closed manifold mesh and takes far longer.\n\n\
    What --vertex-bits means:\n  \
    auto   hull: the fewest bits that store the mesh exactly; box tree: 16\n  \
    16     vertices move to a grid of 16 bits an axis\n  \
    24     hull: a grid of 24 bits an axis; box tree: 32\n  \
    32     single precision; box tree: twice the bytes of its vertices\n\
    Whatever moves is in every answer's interval; the report says how far.";

const HIT_COLUMN: &str = "The column 'hit' says yes, with the first hit; no, which is proved; or unknown, if the query ended \
    early, the blob is cut, or rounding and the surface error of the blob leave it open: then the segment is proved clear before \
    t, which px, py, pz belong to. With --all an unknown hit is a place where the stored surface is met and the mesh's may be. t is \
    the hit rounded to f32.";

const WITHIN_COLUMN: &str = "The column 'within' says yes or no, which is proved; or unknown, if the distance differs from D by \
    less than rounding and the surface error of the blob, or the query ended early. 'triangle' is one that is near enough.";

const NEAREST_ROWS: &str = "Queries count from 0, ranks from 1.";

const SIDE_COLUMN: &str = "The column 'side' says outside or inside, which is proved; or undefined, if the mesh is not closed, or the \
    point too near the surface. lower and upper are the bounds of the signed distance, negative inside; if the side is \
    undefined, they are -upper and upper of the distance.";

const FIELD_FILE: &str = "FILE is raw little-endian f32 if it is named *.f32 or *.raw, and NumPy's format if it is named *.npy: shape \
    (NZ, NY, NX), so that x runs fastest. Sample (k, j, i) is at origin + (i, j, k) * step, rounded to f32; origin and step are \
    printed. A value is the middle of the interval that contains the distance. With --interval there are two values a sample, lower \
    and upper, as a last axis of length 2. With --signed, distances inside are negative; where the side is not proved the interval \
    reaches from -upper to upper, and the value is 0.";

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Build a blob from a mesh (.stl, .ply, .obj)
    #[command(after_help = BUILD)]
    Build(BuildArgs),
    /// Print what a blob holds: sections, memory, levels, error bounds
    Info(InfoArgs),
    /// Closest point and distance interval of each query point, as CSV
    #[command(after_help = QUERY_FILES)]
    Closest(ClosestArgs),
    /// Whether each query point is within a distance of the surface, as CSV
    #[command(after_help = format!("{WITHIN_COLUMN}\n\n{QUERY_FILES}"))]
    Within(WithinArgs),
    /// The nearest triangles of each query point, as CSV
    #[command(after_help = format!("{NEAREST_ROWS}\n\n{QUERY_FILES}"))]
    Nearest(NearestArgs),
    /// Side and distance of each query point, as CSV
    #[command(after_help = format!("{SIDE_COLUMN}\n\n{QUERY_FILES}"))]
    Signed(SignedArgs),
    /// Distances on a regular grid around the mesh, as raw f32 or NumPy file
    #[command(after_help = FIELD_FILE)]
    Field(FieldArgs),
    /// First hit, or all hits, of each query segment, as CSV
    #[command(after_help = format!("{HIT_COLUMN}\n\n{QUERY_FILES}"))]
    Segment(SegmentArgs),
    /// Triangles that may face an eye point
    Cull(CullArgs),
    /// Write an outer hull of a mesh, or a level of a blob, as binary PLY
    Hull(HullArgs),
    /// Cut a blob's hull hierarchy after a level: fewer bytes, wider intervals
    Cut(CutArgs),
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
