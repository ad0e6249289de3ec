//! Arguments of the command that measures settings, and limits that choose one.

use super::given::{self, Given};
use super::reading::{ReadArgs, ThreadArgs};
use super::values::{distance, question, whole};
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use meshsweep::builder::{Builder, For};
use meshsweep::mesh::Unit;
use meshsweep::trade::{Board, Cpu, Limits, Points, Question};
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub struct TradeArgs {
    /// Mesh file; points of curves: .csv; or - for the standard input, with --format
    pub mesh: PathBuf,
    /// Second mesh file, to be moved: which structures tell that it keeps a distance
    #[arg(requires_all = ["poses", "keep"], conflicts_with_all = ["at", "points", "report", "serves"])]
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
    #[command(flatten)]
    pub limits: PairLimitArgs,
    /// Question: closest, the closest point; or segment, the first hit of a segment
    #[arg(
        long = "for",
        value_parser = PossibleValuesParser::new(ASKED.map(For::name)).map(question),
        default_value = For::Closest.name(),
        value_name = "QUESTION"
    )]
    serves: For,
    /// Points that are asked: near, far, path; or a file of your own points, in its order
    ///
    /// near is near the surface; far is in a box twice the mesh's; path is a path near the surface,
    /// in steps of 0.1 % of the diagonal. With --for segment: a tenth of the diagonal long, from
    /// near points; between two sides of a box twice the mesh's; the steps of the path; or six
    /// numbers a segment. A file of such a name is named with its directory: ./near.
    #[arg(long, value_name = "near|far|path|FILE", default_value = "near", value_parser = at)]
    pub at: At,
    /// Number of points or segments, unless they are from a file
    #[arg(long, value_name = "N", default_value_t = 1000, value_parser = whole::<1, 1_000_000>)]
    pub points: u32,
    /// Of curves: join the last point of each polyline with its first; zones always are
    #[arg(long, conflicts_with = "other")]
    pub closed: bool,
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

/// Limits that choose a structure of two meshes.
#[derive(Debug, Args)]
pub struct PairLimitArgs {
    /// Of two meshes: most bytes of both blobs: 16K is 16,384
    #[arg(long, value_name = "BYTES", value_parser = bytes, help_heading = "Limits")]
    pub flash: Option<usize>,
    /// Of two meshes: most bytes of RAM: scratch, and the processor's stack
    #[arg(long, value_name = "BYTES", value_parser = bytes, help_heading = "Limits")]
    pub ram: Option<usize>,
    /// Of two meshes: queries a second: 500, 1kHz
    #[arg(
        long,
        value_name = "RATE",
        value_parser = hertz,
        requires = "cpu",
        help_heading = "Limits"
    )]
    pub rate: Option<f64>,
    /// Of two meshes: processor and its clock, as of build: m4f:168MHz [default: a Cortex-M4F,
    /// without times]
    #[arg(long, value_name = "CPU:CLOCK", value_parser = cpu, help_heading = "Limits")]
    pub cpu: Option<Cpu>,
}

impl PairLimitArgs {
    /// As the library takes them.
    pub fn limits(&self) -> Limits {
        let Self { flash, ram, rate, cpu } = *self;
        Limits { flash, ram, rate, cpu, error: None }
    }

    /// Whether there is a limit.
    pub fn is_given(&self) -> bool {
        self.flash.is_some() || self.ram.is_some() || self.rate.is_some()
    }

    /// Whether there is a limit or a processor.
    pub fn is_any(&self) -> bool {
        self.is_given() || self.cpu.is_some()
    }
}

/// Questions that are measured.
const ASKED: [For; 2] = [For::Closest, For::Segment];

/// The measured question of a word of `--for`, if there is one.
pub fn measured(of: For) -> Option<Question> {
    match of {
        For::Closest => Some(Question::ClosestPoint),
        For::Segment => Some(Question::FirstHit),
        _ => None,
    }
}

impl TradeArgs {
    /// Whether curves are measured.
    pub fn is_curve(&self) -> bool {
        self.read.format == Some("csv") || Builder::new().builds_curve(&self.mesh)
    }

    /// Whether segments are to be asked.
    pub fn asks_segments(&self) -> bool {
        self.serves == For::Segment
    }

    /// The question.
    pub fn question(&self) -> Question {
        measured(self.serves).unwrap_or(Question::ClosestPoint)
    }
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
    /// Largest error: the widest measured interval, in the mesh's unit
    ///
    /// Of a thousand points or segments, or those of the file of --at. The interval of another may
    /// be wider, and holds.
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
        // A name without a dot or a folder is a kind that is written wrongly.
        None if text.chars().all(char::is_alphanumeric) && !Path::new(text).exists() => {
            Err("near, far, path or a file is wanted, and there is no such file".to_owned())
        }
        None => Ok(At::File(PathBuf::from(text))),
    }
}

fn bytes(text: &str) -> Result<usize, String> {
    let wanted = || "a number of bytes above 0 is wanted, as 16384, 16K or 1M".to_owned();
    let text = text.trim();
    let units = [("KiB", 1 << 10), ("MiB", 1 << 20), ("K", 1 << 10), ("M", 1 << 20)];
    let units = units.into_iter().chain([("k", 1 << 10), ("m", 1 << 20), ("", 1)]);
    let (digits, factor) = units
        .filter_map(|(unit, factor)| Some((text.strip_suffix(unit)?, factor)))
        .next()
        .unwrap_or((text, 1));
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
        symbol => {
            Some(Unit::ALL.into_iter().find(|unit| unit.symbol().eq_ignore_ascii_case(symbol)))
        }
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
        assert_eq!([bytes("16KiB"), bytes("1 MiB")], [Ok(16_384), Ok(1 << 20)]);
        assert!(["16iB", "16B", "KiB", "1G"].into_iter().all(|wrong| bytes(wrong).is_err()));
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
