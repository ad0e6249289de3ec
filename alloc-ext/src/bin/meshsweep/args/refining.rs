//! Arguments of the command that refines a hull.

use super::values::{degrees, direction, frame, point, positive, tolerance, two_points};
use clap::Args;
use meshsweep_core::Focus;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct RefineArgs {
    /// Blob file, built --for hull or sweep
    pub blob: PathBuf,
    /// PLY file to write
    #[arg(short, long, value_name = "PLY")]
    pub output: PathBuf,
    /// How far the mesh may be from the faces that meet the focus, in its unit [default with --eye:
    /// 0]
    #[arg(
        long,
        value_name = "DISTANCE",
        value_parser = tolerance,
        required_unless_present_any = ["eye", "sweep"]
    )]
    pub error: Option<f32>,
    /// Focus: a point, x,y,z
    #[arg(long, value_name = "POINT", value_parser = point)]
    pub near: Option<[f32; 3]>,
    /// Focus: a box, by two corners, x,y,z,x,y,z
    #[arg(long = "box", value_name = "CORNERS", value_parser = two_points, conflicts_with = "near")]
    pub corners: Option<[[f32; 3]; 2]>,
    /// Focus: a segment, ax,ay,az,bx,by,bz
    #[arg(
        long,
        value_name = "ENDS",
        value_parser = two_points,
        conflicts_with_all = ["near", "corners"]
    )]
    pub segment: Option<[[f32; 3]; 2]>,
    /// How far the focus reaches around the point or the segment, in the mesh's unit [default: 0]
    #[arg(
        long,
        value_name = "DISTANCE",
        value_parser = tolerance,
        default_value_t = 0.0,
        hide_default_value = true,
        conflicts_with_all = ["corners", "eye"]
    )]
    pub within: f32,
    /// Focus: what an eye at x,y,z sees
    #[arg(
        long,
        value_name = "POINT",
        value_parser = point,
        conflicts_with_all = ["near", "corners", "segment"],
        requires_all = ["look", "fov", "pixels"]
    )]
    pub eye: Option<[f32; 3]>,
    /// Direction in which the eye looks: x,y,z
    #[arg(long, value_name = "DIRECTION", value_parser = direction, requires = "eye")]
    pub look: Option<[f32; 3]>,
    /// The mesh that a sweep about x,y,z ends with: fine at the closest point alone
    #[arg(
        long,
        value_name = "POINT",
        value_parser = point,
        conflicts_with_all = ["error", "near", "corners", "segment", "within", "eye"]
    )]
    pub sweep: Option<[f32; 3]>,
    /// With --sweep: key frame of a blob built --for deform, from 0
    #[arg(
        long,
        value_name = "FRAME",
        value_parser = frame,
        requires = "sweep",
        conflicts_with_all = ["error", "near", "corners", "segment", "eye"]
    )]
    pub frame: Option<f32>,
    /// Angle of the cone that the eye sees, in degrees
    #[arg(long, value_name = "DEGREES", value_parser = degrees, requires = "eye")]
    pub fov: Option<f64>,
    /// Pixels across this angle
    #[arg(long, value_name = "N", value_parser = positive, requires = "eye")]
    pub pixels: Option<f64>,
}

impl RefineArgs {
    /// Where the hull is to be fine.
    pub fn focus(&self) -> Focus {
        let radius = self.within;
        match (self.near, self.corners, self.segment, self.eye) {
            (Some(centre), ..) => Focus::Ball { centre, radius },
            (_, Some([a, b]), ..) => Focus::Box { a, b },
            (_, _, Some([a, b]), _) => Focus::Segment { a, b, radius },
            (.., Some(position)) => {
                let half = self.fov.unwrap_or_default().to_radians() / 2.0;
                let pixel = 2.0 * half.tan() / self.pixels.unwrap_or(1.0);
                Focus::Eye {
                    position,
                    axis: self.look.unwrap_or_default(),
                    cosine: half.cos() as f32,
                    error_per_distance: pixel.min(f64::from(f32::MAX)) as f32,
                }
            }
            _ => Focus::Everywhere,
        }
    }
}
