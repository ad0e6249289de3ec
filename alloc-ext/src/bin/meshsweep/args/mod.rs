//! The command line. Values are checked here, so that a bad one is a usage error (exit status 2)
//! before any file is touched.

mod asking;
mod bounding;
mod building;
mod comparing;
mod given;
mod help;
mod measuring;
mod reading;
mod refining;
mod robot;
mod values;

pub use asking::{
    ClearArgs, ClearanceArgs, ClosestArgs, CullArgs, Engine, FieldArgs, MoveKind, MovedArgs,
    NearestArgs, OverlapArgs, PointArgs, SearchArgs, SegmentArgs, SignedArgs, WindingArgs,
    WithinArgs, WorstArgs, WorstQuestion,
};
pub use bounding::{HullArgs, TriboxArgs};
pub use building::{BuildArgs, CutArgs, InfoArgs, Language, VerifyArgs};
pub use comparing::HausdorffArgs;
pub use given::{Given, files, names};
pub use measuring::{At, TradeArgs};
pub use reading::ReadArgs;
pub use refining::RefineArgs;
pub use robot::{Keep, RobotArgs};
pub use values::Margin;

use help::Help;

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};

/// Distances, hits, signs and outer hulls of triangle meshes, with guaranteed intervals.
///
/// Without a command: a short demonstration on a mesh that is built in.
#[derive(Debug, Parser)]
#[command(name = "meshsweep", version, after_help = help::EXIT_STATUS)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Option<Command>,
}

impl Arguments {
    /// The arguments of the program. Wrong ones end it.
    pub fn of_the_program() -> Self {
        let arguments = std::env::args_os().map(given::shielded);
        let mut matches = command().get_matches_from(arguments);
        Self::from_arg_matches_mut(&mut matches).unwrap_or_else(|error| error.exit())
    }
}

/// The command line, with its help. A negative number is a value, so that its own error names its
/// range.
pub fn command() -> clap::Command {
    Arguments::command().mut_subcommands(|command| {
        let Help { long, short, scratch } = Help::of(command.get_name());
        let command = command.allow_negative_numbers(true).after_help(short).after_long_help(long);
        match scratch {
            Some(scratch) => command.mut_arg("scratch", |arg| arg.help(scratch)),
            None => command,
        }
    })
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Build a blob from a mesh (.stl, .glb, ...) or from curves (.csv)
    Build(Box<BuildArgs>),
    /// Print the contents of a blob: sections, memory, levels, error bounds
    Info(InfoArgs),
    /// Closest point and distance interval of each query point, as CSV
    Closest(ClosestArgs),
    /// Whether each query point is within a distance of the surface, as CSV
    Within(WithinArgs),
    /// The nearest triangles of each query point, as CSV
    Nearest(NearestArgs),
    /// Side and signed distance of each query point, as CSV
    Signed(SignedArgs),
    /// How often the mesh encloses each query point, closed or not, as CSV
    Winding(WindingArgs),
    /// Distances on a regular grid around the mesh, as raw f32 or NumPy file
    Field(FieldArgs),
    /// First hit, or all hits, of each query segment, as CSV
    Segment(SegmentArgs),
    /// Whether two meshes meet, one of them moved, as CSV
    Overlap(OverlapArgs),
    /// Distance interval and nearest points of two meshes, one of them moved, as CSV
    Clearance(ClearanceArgs),
    /// Whether straight moves of a convex tool are clear of the mesh all the way, as CSV
    Clear(ClearArgs),
    /// Hausdorff distance of two meshes: how far the farthest point of each is from the other
    Hausdorff(HausdorffArgs),
    /// Triangles that may face a viewpoint, as CSV; all others certainly do not
    Cull(CullArgs),
    /// Write an outer hull of a mesh, or a level of a blob, as binary PLY
    Hull(HullArgs),
    /// Write a blob's hull, fine where it is needed and coarse elsewhere, as binary PLY
    Refine(RefineArgs),
    /// Cut a blob's hull hierarchy after a level: fewer bytes, wider intervals
    Cut(CutArgs),
    /// Cover a mesh with unions of 1, 2, 4, ... triboxes, and write the finest as binary PLY
    Tribox(TriboxArgs),
    /// Blobs, joints and pairs of a robot, from its URDF, as a Rust module for firmware
    Robot(RobotArgs),
    /// Prove the claims of a blob again, from its bytes and the mesh that it was built from
    Verify(VerifyArgs),
    /// Measure error, instructions and bytes of each structure and setting of a mesh
    Trade(TradeArgs),
    /// Search the costliest query of each question, or the widest interval within a budget
    Worst(WorstArgs),
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_command_line_is_consistent() {
        super::command().debug_assert();
    }
}
