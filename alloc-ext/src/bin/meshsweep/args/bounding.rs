//! Arguments of the command that covers meshes with triboxes.

use super::values::{tolerance, whole};
use clap::{Args, ValueEnum};
use meshsweep::tribox::{Measure, Planes, SplitOptions};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct TriboxArgs {
    /// Mesh file: .stl, .ply or .obj
    pub mesh: PathBuf,
    /// PLY file to write: the triboxes of the finest level
    #[arg(short, long, value_name = "PLY")]
    pub output: Option<PathBuf>,
    /// Levels, of 1, 2, 4, ... triboxes
    #[arg(long, value_name = "N", default_value_t = 7, allow_negative_numbers = true, value_parser = whole::<1, 12>)]
    pub levels: u32,
    /// How far planes may move outward so that small faces vanish, in the mesh's unit
    #[arg(long, value_name = "T", default_value_t = 0.0, allow_negative_numbers = true, value_parser = tolerance, hide_default_value = true)]
    pub simplify: f32,
    /// What splits make little of: volume, or area [default: volume if the mesh is closed, else
    /// area]
    #[arg(long, value_enum, hide_possible_values = true)]
    pub measure: Option<MeasureName>,
    /// Planes that splits are chosen from: nine, some of each direction; thickest, the one that
    /// bisects the thickest slab
    #[arg(long, value_enum, default_value_t = PlanesName::Nine, hide_possible_values = true)]
    pub planes: PlanesName,
    /// Split a tribox only if that saves more than this part of its measure; negative: although
    /// the total grows [default: 0.0001]
    #[arg(long, value_name = "RATIO", value_parser = gain, allow_hyphen_values = true)]
    pub least_gain: Option<f64>,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum MeasureName {
    Area,
    Volume,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum PlanesName {
    Nine,
    Thickest,
}

/// At most 1, for no split saves all.
fn gain(text: &str) -> Result<f64, String> {
    let wanted = || "a number up to 1 is wanted, as 0.05".to_owned();
    text.parse().ok().filter(|x: &f64| *x <= 1.0).ok_or_else(wanted)
}

impl TriboxArgs {
    pub fn options(&self) -> SplitOptions {
        let default = SplitOptions::default();
        SplitOptions {
            leaves: 1 << (self.levels - 1),
            measure: self.measure.map(|measure| match measure {
                MeasureName::Area => Measure::Area,
                MeasureName::Volume => Measure::Volume,
            }),
            planes: match self.planes {
                PlanesName::Nine => default.planes,
                PlanesName::Thickest => Planes::Thickest,
            },
            least_gain: self.least_gain.unwrap_or(default.least_gain),
            simplify: self.simplify,
            ..default
        }
    }
}
