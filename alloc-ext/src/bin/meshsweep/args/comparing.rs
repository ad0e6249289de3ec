//! Arguments of the command that compares two meshes.

use super::reading::{ReadArgs, ThreadArgs};
use super::values::length;
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct HausdorffArgs {
    /// Mesh file; or - for the standard input, with --format
    pub first: PathBuf,
    /// Mesh file to compare it with
    pub second: PathBuf,
    #[command(flatten)]
    pub read: ReadArgs,
    /// Only how far the first mesh is from the second
    #[arg(long)]
    pub one_sided: bool,
    /// Stop when upper ≤ lower · (1 + REL)
    #[arg(long, value_name = "REL", value_parser = length, default_value = "1e-4")]
    pub rel: f64,
    /// Stop when upper − lower ≤ ABS, in the meshes' unit
    #[arg(long, value_name = "ABS", value_parser = length, default_value = "0")]
    pub abs: f64,
    /// Only decide whether the distance is at most this; exit status 3 if that is not proved
    #[arg(
        long,
        value_name = "DISTANCE",
        value_parser = length,
        conflicts_with_all = ["rel", "abs"]
    )]
    pub at_most: Option<f64>,
    /// Mean and quantiles of the distance over the area of the first mesh too, as bounds
    ///
    /// The mean's are at most a tenth of it apart, where three million pieces suffice.
    #[arg(long)]
    pub profile: bool,
    /// Write the first mesh as PLY, each vertex coloured by its distance from the second one
    ///
    /// Blue is 0, red the farthest vertex. The vertex's property 'quality' is the distance.
    #[arg(long, value_name = "PLY")]
    pub heat: Option<PathBuf>,
    #[command(flatten)]
    pub threads: ThreadArgs,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}
