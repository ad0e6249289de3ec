//! Arguments of the command that measures settings, and limits that choose one.

use super::given::{self, Given};
use super::reading::{ReadArgs, ThreadArgs};
use super::values::{distance, whole};
use clap::Args;
use meshsweep::mesh::Unit;
use meshsweep::trade::{Board, Cpu, Limits, Points};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct TradeArgs {
    /// Mesh file; or - for the standard input, with --format
    pub mesh: PathBuf,
    /// Second mesh file, to be moved: which structures tell that it keeps a distance
    #[arg(requires_all = ["poses", "keep"], conflicts_with_all = ["at", "points", "report"])]
    pub other: Option<PathBuf>,
    /// Poses of the second mesh: x,y,z,qw,qx,qy,qz each, or files of them
    #[arg(
        long,
        value_name = "POSE",
        num_args = 1..,
        requires = "other",
        value_parser = given::queries::<7>()
    )]
    pub poses: Vec<Given<7>>,
    /// Distance that the second mesh is to keep: 2.5 in the meshes' unit, or 20mm
    #[arg(long, value_name = "DISTANCE", requires = "other", value_parser = length_in_unit)]
    pub keep: Option<(f64, Option<Unit>)>,
    /// Processor and its clock, as of build: m4f:168MHz [default: a Cortex-M4F, without times]
    #[arg(long, value_name = "CPU:CLOCK", requires = "other", value_parser = cpu)]
    pub cpu: Option<Cpu>,
    /// Points that are asked: near, far, path; or a file of your own points, in its order
    ///
    /// near is near the surface; far is in a box twice the mesh's; path is a path near the surface,
    /// in steps of 0.1 % of the diagonal. A file of such a name is named with its directory:
    /// ./near.
    #[arg(long, value_name = "near|far|path|FILE", default_value = "near", value_parser = at)]
    pub at: At,
    /// Number of points, unless they are from a file
    #[arg(long, value_name = "N", default_value_t = 1000, value_parser = whole::<1, 1_000_000>)]
    pub points: u32,
    #[command(flatten)]
    pub read: ReadArgs,
    /// Write a page with pictures too: one HTML file, which needs no network
    #[arg(long, value_name = "PAGE.html")]
    pub report: Option<PathBuf>,
    #[command(flatten)]
    pub threads: ThreadArgs,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}

/// Limits that choose structure and dials.
#[derive(Debug, Args)]
pub struct LimitArgs {
    /// Most bytes of the blob: 16K is 16,384
    #[arg(long, value_name = "BYTES", value_parser = bytes, help_heading = "Limits")]
    pub flash: Option<usize>,
    /// Most bytes of RAM: scratch, what is kept between queries, and the processor's stack
    #[arg(long, value_name = "BYTES", value_parser = bytes, help_heading = "Limits")]
    pub ram: Option<usize>,
    /// Largest guaranteed error: the width of an interval, in the mesh's unit
    #[arg(long, value_name = "LENGTH", value_parser = distance, help_heading = "Limits")]
    pub error: Option<f64>,
    /// Queries a second: 500, 1kHz
    #[arg(
        long,
        value_name = "RATE",
        value_parser = hertz,
        requires = "cpu",
        help_heading = "Limits"
    )]
    pub rate: Option<f64>,
    /// Processor and its clock: m4f:168MHz, m0:48MHz; m7:400MHz counts the code of an m4f
    #[arg(long, value_name = "CPU:CLOCK", value_parser = cpu, help_heading = "Limits")]
    pub cpu: Option<Cpu>,
    /// Points that limits are measured at: near, far, path or a file, as of trade [default: near]
    #[arg(long, value_name = "POINTS", value_parser = at, help_heading = "Limits")]
    pub at: Option<At>,
}

impl LimitArgs {
    /// As the library takes them.
    pub fn limits(&self) -> Limits {
        let Self { flash, ram, error, rate, cpu, .. } = *self;
        Limits { flash, ram, error, rate, cpu }
    }

    /// The first limit that is given.
    pub fn given(&self) -> Option<&'static str> {
        [
            ("--flash", self.flash.is_some()),
            ("--ram", self.ram.is_some()),
            ("--error", self.error.is_some()),
            ("--rate", self.rate.is_some()),
        ]
        .into_iter()
        .find_map(|(option, given)| given.then_some(option))
    }
}

/// Points to ask.
#[derive(Clone, Debug, PartialEq)]
pub enum At {
    Made(Points),
    File(PathBuf),
}

fn at(text: &str) -> Result<At, String> {
    let made = Points::ALL.into_iter().find(|points| points.name() == text);
    match made {
        Some(points) => Ok(At::Made(points)),
        None if text.is_empty() => Err("near, far, path or a file is wanted".to_owned()),
        None => Ok(At::File(PathBuf::from(text))),
    }
}

fn bytes(text: &str) -> Result<usize, String> {
    let wanted = || "a number of bytes above 0 is wanted, as 16384, 16K or 1M".to_owned();
    let (digits, factor) = match text.trim().strip_suffix(['K', 'k', 'M', 'm']) {
        Some(digits) if text.trim().ends_with(['K', 'k']) => (digits, 1 << 10),
        Some(digits) => (digits, 1 << 20),
        None => (text.trim(), 1),
    };
    let number = digits.trim().parse::<f64>().ok().filter(|x| *x > 0.0 && *x < 1e12);
    number.map(|x| (x * f64::from(factor)) as usize).filter(|&x| x > 0).ok_or_else(wanted)
}

fn hertz(text: &str) -> Result<f64, String> {
    let wanted = || "a frequency above 0 is wanted, as 500, 1kHz or 168MHz".to_owned();
    let number = text.trim();
    let number = number.strip_suffix("Hz").or(number.strip_suffix("hz")).unwrap_or(number);
    let (digits, factor) = match number.strip_suffix(['k', 'K', 'M', 'G']) {
        Some(digits) if number.ends_with('M') => (digits, 1e6),
        Some(digits) if number.ends_with('G') => (digits, 1e9),
        Some(digits) => (digits, 1e3),
        None => (number, 1.0),
    };
    let number = digits.trim().parse::<f64>().ok().map(|x| x * factor);
    number.filter(|x| *x > 0.0 && x.is_finite()).ok_or_else(wanted)
}

/// A length above 0, and its unit if it is told.
fn length_in_unit(text: &str) -> Result<(f64, Option<Unit>), String> {
    let wanted = || "a distance above 0 is wanted, as 2.5 or 20mm".to_owned();
    let text = text.trim();
    let digits = text.trim_end_matches(|c: char| c.is_alphabetic());
    let unit = match &text[digits.len()..] {
        "" => None,
        symbol => Some(Unit::ALL.into_iter().find(|unit| unit.symbol() == symbol)),
    };
    let length = digits.trim().parse::<f64>().ok().filter(|x| *x > 0.0 && x.is_finite());
    match (length, unit) {
        (Some(length), None) => Ok((length, None)),
        (Some(length), Some(Some(unit))) => Ok((length, Some(unit))),
        _ => Err(wanted()),
    }
}

fn cpu(text: &str) -> Result<Cpu, String> {
    let wanted =
        || "a processor and its clock are wanted, as m4f:168MHz, m7:400MHz or m0:48MHz".to_owned();
    let (name, clock) = text.split_once(':').ok_or_else(wanted)?;
    let board = match name {
        // A Cortex-M7 runs the same instructions, in no more cycles each.
        "m4f" | "m7" => Board::CortexM4F,
        "m0" => Board::CortexM0,
        _ => return Err(wanted()),
    };
    Ok(Cpu { board, hertz: hertz(clock).map_err(|_| wanted())? })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_frequencies_and_processors_are_read_as_people_write_them() {
        assert_eq!([bytes("16K"), bytes("1M"), bytes("100")], [Ok(16_384), Ok(1 << 20), Ok(100)]);
        assert_eq!([hertz("1kHz"), hertz("168MHz"), hertz("50")], [Ok(1e3), Ok(1.68e8), Ok(50.0)]);
        assert_eq!(cpu("m0:48MHz"), Ok(Cpu { board: Board::CortexM0, hertz: 4.8e7 }));
        assert_eq!(at("path"), Ok(At::Made(Points::Path)));
        for wrong in ["", "K", "-1", "0", "1.5X", "nan"] {
            assert!(bytes(wrong).is_err() && hertz(wrong).is_err() && cpu(wrong).is_err());
        }
        assert_eq!(cpu("m7:400MHz"), Ok(Cpu { board: Board::CortexM4F, hertz: 4e8 }));
        assert!(cpu("m3:1MHz").is_err() && cpu("m4f").is_err() && cpu("m4f:0").is_err());
    }
}
