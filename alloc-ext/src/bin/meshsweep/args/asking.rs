//! Arguments of the commands that ask a blob.

use super::given::{self, Given, GivenPoint};
use super::reading::ThreadArgs;
use super::values::{Margin, Tool, direction, frame, margin, point, size, tolerance, tool, whole};
use clap::{Args, ValueEnum};
use meshsweep_core::{Eye, Facing};
use std::path::PathBuf;

/// The output of answers, and the limits of a search.
#[derive(Debug, Args)]
pub struct SearchArgs {
    /// CSV file to write instead of the standard output
    #[arg(short, long, value_name = "CSV")]
    pub output: Option<PathBuf>,
    /// Stop a query after opening so many nodes
    #[arg(long, value_name = "NODES", value_parser = whole::<0, { u32::MAX }>)]
    pub steps: Option<u32>,
    /// Scratch entries to search with [default: as many as the blob needs]
    #[arg(long, value_name = "ENTRIES", value_parser = whole::<1, { 1 << 24 }>)]
    pub scratch: Option<u32>,
    #[command(flatten)]
    pub threads: ThreadArgs,
    /// Print nanoseconds per query, and how queries ended, to the standard error
    #[arg(long)]
    pub time: bool,
}

/// A blob and points to ask it about.
#[derive(Debug, Args)]
pub struct PointArgs {
    /// Blob file
    pub blob: PathBuf,
    /// Query points: x,y,z each, or files of them
    #[arg(required = true, value_parser = given::queries::<3>())]
    pub points: Vec<Given<3>>,
}

#[derive(Debug, Args)]
pub struct ClosestArgs {
    #[command(flatten)]
    pub input: PointArgs,
    /// Stop a query when upper ≤ lower · (1 + REL)
    #[arg(long, value_name = "REL", default_value_t = 0.0, value_parser = tolerance)]
    pub rel: f32,
    /// Stop a query when upper − lower ≤ ABS, in the mesh's unit
    #[arg(long, value_name = "ABS", default_value_t = 0.0, value_parser = tolerance)]
    pub abs: f32,
    /// tree, the box tree; or hull, a sweep on the hull hierarchy [default: tree if the blob has
    /// one]
    #[arg(long, value_enum, hide_possible_values = true)]
    pub engine: Option<Engine>,
    /// Measure in f64 what may be the closest; for a box tree built with --vertex-bits 32
    #[arg(long, conflicts_with_all = ["rel", "abs", "engine", "tight", "frame"])]
    pub precise: bool,
    /// Ask the finest tight hull of at most FACES faces
    ///
    /// The interval is that of the distance to the mesh inside the hull. Without the option the
    /// finest hull is asked if the blob has no other structure for distances.
    #[arg(
        long,
        value_name = "FACES",
        value_parser = whole::<4, { u32::MAX }>,
        conflicts_with = "engine"
    )]
    pub tight: Option<u32>,
    /// Key frame of a blob built --for deform, from 0
    ///
    /// 1.25 is a quarter of the way from frame 1 to frame 2.
    #[arg(
        long,
        value_name = "FRAME",
        value_parser = frame,
        conflicts_with_all = ["engine", "tight"]
    )]
    pub frame: Option<f32>,
    /// Ask the blob's triboxes, which know a lower bound, and nothing else
    #[arg(
        long,
        conflicts_with_all = ["rel", "abs", "engine", "precise", "tight", "frame"]
    )]
    pub triboxes: bool,
    #[command(flatten)]
    pub search: SearchArgs,
}

#[derive(Debug, Args)]
pub struct WithinArgs {
    #[command(flatten)]
    pub input: PointArgs,
    /// The distance, in the mesh's unit
    #[arg(short, long, value_name = "D", value_parser = tolerance)]
    pub distance: f32,
    /// All triangles that are or may be within the distance, nearest first
    ///
    /// Each stands on a line of its own. The query's number, from 0, is the first column.
    #[arg(long)]
    pub all: bool,
    /// Ask the finest tight hull of at most FACES faces
    ///
    /// The answer is about the mesh inside the hull. Without the option the finest hull is asked if
    /// the blob has no other structure for distances.
    #[arg(
        long,
        value_name = "FACES",
        value_parser = whole::<4, { u32::MAX }>,
        conflicts_with = "all"
    )]
    pub tight: Option<u32>,
    /// Ask the blob's triboxes, which can tell that a point is farther than D, and nothing else
    #[arg(long, conflicts_with_all = ["all", "tight"])]
    pub triboxes: bool,
    #[command(flatten)]
    pub search: SearchArgs,
}

#[derive(Debug, Args)]
pub struct NearestArgs {
    #[command(flatten)]
    pub input: PointArgs,
    /// Triangles for each point, nearest first
    #[arg(short = 'n', long, value_name = "N", value_parser = whole::<1, { 1 << 20 }>)]
    pub count: u32,
    /// Key frame of a blob built --for deform, from 0
    #[arg(long, value_name = "FRAME", value_parser = frame)]
    pub frame: Option<f32>,
    #[command(flatten)]
    pub search: SearchArgs,
}

#[derive(Debug, Args)]
pub struct SignedArgs {
    /// Blob file
    pub blob: PathBuf,
    /// Query points: x,y,z each, of a fence x,y, or files of them
    #[arg(required = true, value_parser = given::points())]
    pub points: Vec<GivenPoint>,
    #[command(flatten)]
    pub search: SearchArgs,
}

#[derive(Debug, Args)]
pub struct WindingArgs {
    #[command(flatten)]
    pub input: PointArgs,
    /// Narrow each interval to this width [default: until the side is decided]
    #[arg(
        long,
        value_name = "WIDTH",
        default_value_t = 0.0,
        hide_default_value = true,
        value_parser = tolerance
    )]
    pub abs: f32,
    #[command(flatten)]
    pub search: SearchArgs,
}

#[derive(Debug, Args)]
pub struct FieldArgs {
    /// Blob file
    pub blob: PathBuf,
    /// File to write: .f32, .raw or .npy
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// Samples along each axis: one number for all, or NX,NY,NZ
    #[arg(long, value_name = "SIZE", default_value = "64", value_parser = size)]
    pub size: Size,
    /// Margin of the grid around the mesh's box: a length, or a percentage of the box's longest
    /// edge
    #[arg(long, value_name = "MARGIN", default_value = "10%", value_parser = margin)]
    pub margin: Margin,
    /// Negative values inside, NaN where the side is not proved
    ///
    /// The mesh must be closed, or the blob built --for winding.
    #[arg(long)]
    pub signed: bool,
    /// Write lower and upper bound instead of the middle between them
    #[arg(long)]
    pub interval: bool,
    #[command(flatten)]
    pub threads: ThreadArgs,
}

/// Samples along x, y and z.
pub type Size = [usize; 3];

#[derive(Debug, Args)]
pub struct SegmentArgs {
    /// Blob file
    pub blob: PathBuf,
    /// Query segments: ax,ay,az,bx,by,bz each, or files of them
    #[arg(required = true, value_parser = given::queries::<6>())]
    pub segments: Vec<Given<6>>,
    /// All hits, one on a line
    ///
    /// A line without a triangle says that some may be missing. The query's number, from 0, is the
    /// first column.
    #[arg(long)]
    pub all: bool,
    /// Queries are rays, which have no end: ox,oy,oz and a direction dx,dy,dz each
    #[arg(long, conflicts_with_all = ["triboxes", "frame"])]
    pub rays: bool,
    /// Only hits of fronts or of backs, on the box tree [default: both]
    ///
    /// Seen from its front a triangle's corners run counter-clockwise.
    #[arg(long, value_enum)]
    pub facing: Option<FacingName>,
    /// tree, the box tree; or hull, a sweep on the hull hierarchy [default: tree if the blob has
    /// one]
    #[arg(long, value_enum, hide_possible_values = true)]
    pub engine: Option<Engine>,
    /// Ask the blob's triboxes, which can tell that a segment is clear, or up to where, and nothing
    /// else
    #[arg(long, conflicts_with_all = ["all", "facing", "engine", "frame"])]
    pub triboxes: bool,
    /// Key frame of a blob built --for deform, from 0
    ///
    /// 1.25 is a quarter of the way from frame 1 to frame 2. Between frames no hit is proved.
    #[arg(
        long,
        value_name = "FRAME",
        value_parser = frame,
        conflicts_with_all = ["engine", "facing"]
    )]
    pub frame: Option<f32>,
    #[command(flatten)]
    pub search: SearchArgs,
}

impl SegmentArgs {
    /// The sides of triangles that count.
    pub fn facing(&self) -> Facing {
        match self.facing {
            None | Some(FacingName::Both) => Facing::Both,
            Some(FacingName::Front) => Facing::Front,
            Some(FacingName::Back) => Facing::Back,
        }
    }
}

#[derive(Debug, Args)]
pub struct ClearArgs {
    /// Blob file
    pub blob: PathBuf,
    /// Straight moves of the tool: ax,ay,az,bx,by,bz each, or files of them
    #[arg(required_unless_present = "path", value_parser = given::queries::<6>())]
    pub moves: Vec<Given<6>>,
    /// A path of the tool in place of moves: x,y,z each, or files of them
    ///
    /// The tool goes straight from each place to the next.
    #[arg(
        long,
        value_name = "PLACES",
        num_args = 1..,
        conflicts_with = "moves",
        value_parser = given::queries::<3>(),
    )]
    pub path: Vec<Given<3>>,
    /// Corners of the tool, x,y,z after x,y,z: the tool is their hull
    ///
    /// They are where they are when the tool's place is 0,0,0.
    #[arg(long, value_name = "CORNERS", default_value = "0,0,0", value_parser = tool)]
    pub tool: Tool,
    /// Radius about the tool's hull, in the mesh's unit: of the tool, and a distance to keep
    #[arg(long, value_name = "R", default_value_t = 0.0, value_parser = tolerance)]
    pub radius: f32,
    #[command(flatten)]
    pub search: SearchArgs,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum FacingName {
    Both,
    Front,
    Back,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Engine {
    Tree,
    Hull,
}

/// Two blobs, and poses of the second one.
#[derive(Debug, Args)]
pub struct MovedArgs {
    /// Blob file of the mesh that stays
    pub first: PathBuf,
    /// Blob file of the mesh that is moved
    pub second: PathBuf,
    /// Pose of the second mesh: x,y,z,qw,qx,qy,qz each, or files of them [default: where it was
    /// built]
    #[arg(long, value_name = "POSE", num_args = 1.., value_parser = given::queries::<7>())]
    pub pose: Vec<Given<7>>,
    /// The same as three rows of a matrix, each with its translation:
    /// m00,m01,m02,x,m10,m11,m12,y,m20,m21,m22,z each, or files
    #[arg(
        long,
        value_name = "MATRIX",
        num_args = 1..,
        conflicts_with = "pose",
        value_parser = given::queries::<12>()
    )]
    pub matrix: Vec<Given<12>>,
}

#[derive(Debug, Args)]
pub struct OverlapArgs {
    #[command(flatten)]
    pub input: MovedArgs,
    /// All pairs of triangles that meet, one on a line
    #[arg(long)]
    pub all: bool,
    /// tree, the box trees; or hull, both hull hierarchies, each refined where the other is
    /// [default: tree if both blobs have one]
    #[arg(long, value_enum, hide_possible_values = true)]
    pub engine: Option<Engine>,
    /// Ask the blobs' triboxes, which can tell that the meshes are apart, and nothing else
    #[arg(long, conflicts_with = "engine")]
    pub triboxes: bool,
    /// Key frame of the first blob, which was built --for deform, from 0
    ///
    /// 1.25 is a quarter of the way from frame 1 to frame 2. The second blob's hull hierarchy is
    /// asked, at rest.
    #[arg(
        long,
        value_name = "FRAME",
        value_parser = frame,
        conflicts_with_all = ["all", "engine", "triboxes"]
    )]
    pub frame: Option<f32>,
    #[command(flatten)]
    pub search: SearchArgs,
}

#[derive(Debug, Args)]
pub struct ClearanceArgs {
    #[command(flatten)]
    pub input: MovedArgs,
    /// Only whether the meshes are within this distance of each other, in the meshes' unit
    #[arg(long, value_name = "D", value_parser = tolerance, conflicts_with_all = ["rel", "abs"])]
    pub within: Option<f32>,
    /// Ask the blobs' triboxes, which can tell that the meshes are farther than D, and nothing else
    #[arg(long, requires = "within", conflicts_with_all = ["moves", "depth"])]
    pub triboxes: bool,
    /// Moves of the second mesh from each pose to the next, straight or screw
    ///
    /// straight moves each point along a line; screw moves the mesh as a rigid body. The answer
    /// says whether each move is clear for its whole length, or until when. With --within D clear
    /// is farther than D.
    #[arg(
        long,
        value_enum,
        value_name = "KIND",
        hide_possible_values = true,
        conflicts_with_all = ["rel", "abs"]
    )]
    pub moves: Option<MoveKind>,
    /// How deep closed meshes are in each other, and where they are apart
    #[arg(long, conflicts_with_all = ["within", "moves"])]
    pub depth: bool,
    /// Stop a query when upper ≤ lower · (1 + REL)
    #[arg(long, value_name = "REL", default_value_t = 0.0, value_parser = tolerance)]
    pub rel: f32,
    /// Stop a query when upper − lower ≤ ABS, in the meshes' unit
    #[arg(long, value_name = "ABS", default_value_t = 0.0, value_parser = tolerance)]
    pub abs: f32,
    #[command(flatten)]
    pub search: SearchArgs,
}

/// How a mesh moves between two poses.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MoveKind {
    Straight,
    Screw,
}

#[derive(Debug, Args)]
pub struct CullArgs {
    /// Blob file, built --for cull
    pub blob: PathBuf,
    /// Position of the eye: x,y,z
    #[arg(required_unless_present = "along", conflicts_with = "along", value_parser = point)]
    pub viewpoint: Option<[f32; 3]>,
    /// Instead of a viewpoint the direction of parallel lines of sight, from the eye into the
    /// scene: x,y,z
    #[arg(long, value_name = "DIRECTION", value_parser = direction)]
    pub along: Option<[f32; 3]>,
    /// CSV file to write instead of the standard output
    #[arg(short, long, value_name = "CSV")]
    pub output: Option<PathBuf>,
}

impl CullArgs {
    /// Where the eye is, or which way it looks.
    pub fn eye(&self) -> Eye {
        match (self.viewpoint, self.along) {
            (Some(viewpoint), _) => Eye::At(viewpoint),
            (None, along) => Eye::Along(along.unwrap_or_default()),
        }
    }
}

#[derive(Debug, Args)]
pub struct WorstArgs {
    /// Blob file
    pub blob: PathBuf,
    /// Search the pose of this second blob at which clearance costs most
    pub moved: Option<PathBuf>,
    /// Of two blobs: ask whether they are within D of each other, in the meshes' unit, in place of
    /// their distance
    #[arg(
        long,
        value_name = "D",
        value_parser = tolerance,
        requires = "moved",
        conflicts_with_all = ["rel", "abs"]
    )]
    pub within: Option<f32>,
    /// Only these questions [default: all that the blob serves]
    #[arg(
        long,
        value_name = "QUESTION",
        value_enum,
        value_delimiter = ',',
        conflicts_with = "moved"
    )]
    pub ask: Vec<WorstQuestion>,
    /// Stop a query after opening so many nodes, splits or pairs of nodes, and search the widest
    /// interval that is left too
    #[arg(long, value_name = "STEPS", value_parser = whole::<0, { u32::MAX }>)]
    pub steps: Option<u32>,
    /// Stop a query when upper ≤ lower · (1 + REL)
    #[arg(long, value_name = "REL", default_value_t = 0.0, value_parser = tolerance)]
    pub rel: f32,
    /// Stop a query when upper − lower ≤ ABS, in the mesh's unit
    #[arg(long, value_name = "ABS", default_value_t = 0.0, value_parser = tolerance)]
    pub abs: f32,
    /// Random queries to climb from, beside a few fixed ones
    #[arg(long, value_name = "N", default_value = "48", value_parser = whole::<1, 100_000>)]
    pub starts: u32,
    #[command(flatten)]
    pub threads: ThreadArgs,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}

/// Questions whose costliest query can be searched.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum WorstQuestion {
    Closest,
    Within,
    Signed,
    Winding,
    Segment,
}
