//! Limits of a device, and the measured setting that meets them.

use super::cost::Board;
use super::measure::{Instructions, Row, Trade};
use crate::builder::Built;
use crate::number::AtMost;
use std::cmp::Ordering;
use std::fmt;

/// Cycles of an instruction that a rate is planned with. Most take one, loads two, a jump that is
/// taken two to four, a division fourteen, and flash may add waits: twice leaves room.
pub const CYCLES: f64 = 2.0;

/// Part of the triangles that are needles from which on predicted instructions are doubtful.
pub const MANY_NEEDLES: f64 = 0.1;

/// A processor and its clock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cpu {
    /// Where instructions are counted.
    pub board: Board,
    /// Cycles a second.
    pub hertz: f64,
}

/// What a device allows. `None` limits nothing.
///
/// ```no_run
/// use meshsweep::load::Source;
/// use meshsweep::trade::{self, Limits, Points};
///
/// let source = Source::of_file("part.stl".as_ref(), None)?;
/// let part = source.repaired()?;
/// let near = Points::Near;
/// let points = trade::points(&part.mesh, near, 1000);
/// let triangles = part.mesh.triangles.len();
/// let settings = trade::standard(trade::diagonal(&part.mesh), triangles, Some(near));
/// let trade = trade::measure(&source, &part, &points, &settings, |_, _| {})?;
/// let limits = Limits { flash: Some(16 << 10), ..Limits::default() };
/// let choice = limits.choose(trade)?;
/// println!("{}", choice.first.setting);
/// std::fs::write("part.msw", choice.built.bytes())?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Limits {
    /// Bytes of the blob.
    pub flash: Option<usize>,
    /// Bytes of scratch, of memory that is kept between queries, and of the processor's stack.
    pub ram: Option<usize>,
    /// Largest guaranteed error: the width of an interval, in the mesh's unit.
    pub error: Option<f64>,
    /// Queries a second. Counts only with a processor.
    pub rate: Option<f64>,
    /// The processor; a Cortex-M4F unless told otherwise.
    pub cpu: Option<Cpu>,
}

/// The setting that meets limits best, and its blob.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Choice {
    /// As measured.
    pub first: Row,
    /// The best setting without it, if another one meets the limits.
    pub second: Option<Row>,
    /// The blob of the first, as it was measured.
    pub built: Built,
}

/// Why no setting was chosen.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Unmet {
    /// A rate is limited, and instructions are not predicted for this many needles.
    Needles {
        /// Part of the triangles.
        part: f64,
    },
    /// No structure gives intervals.
    NoIntervals,
    /// The setting that comes nearest to the limits, and where it exceeds them.
    Beyond {
        /// The setting as measured.
        nearest: Box<Row>,
        /// The limits.
        limits: Limits,
    },
}

impl fmt::Display for Unmet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Needles { part } => write!(
                f,
                "{:.0} % of the triangles are needles, whose instructions are not predicted; \
                 leave --rate out, and count them",
                100.0 * part
            ),
            Self::NoIntervals => f.write_str("no structure gives intervals"),
            Self::Beyond { nearest, limits } => {
                let setting = nearest.setting;
                write!(f, "no setting meets these limits; the nearest is {setting}, which needs ")?;
                f.write_str(&limits.needs(nearest).join(" and "))
            }
        }
    }
}

impl std::error::Error for Unmet {}

impl Limits {
    /// The board whose instructions count.
    #[must_use]
    pub fn board(&self) -> Board {
        self.cpu.map_or(Board::CortexM4F, |cpu| cpu.board)
    }

    /// Instructions of a setting on the [board](Self::board).
    #[must_use]
    pub fn instructions(&self, row: &Row) -> Option<Instructions> {
        Board::ALL.iter().zip(row.boards).find(|(of, _)| **of == self.board())?.1
    }

    /// Bytes of RAM that a setting takes: its scratch, and the board's stack.
    #[must_use]
    pub fn ram(&self, row: &Row) -> f64 {
        row.scratch as f64 + self.instructions(row).map_or(0.0, |found| f64::from(found.stack))
    }

    /// Chooses the setting that meets all limits: with a limit of the error the one of the fewest
    /// instructions, else the one of the smallest error. [`measure()`](super::measure()) gives the
    /// settings.
    ///
    /// # Errors
    /// [`Unmet`].
    pub fn choose(&self, mut trade: Trade) -> Result<Choice, Unmet> {
        if self.rate.is_some() && trade.needles >= MANY_NEEDLES {
            return Err(Unmet::Needles { part: trade.needles });
        }
        trade.rows.retain(|row| row.guaranteed.is_some());
        let is_met = |row: &&Row| self.excess(row) <= 1.0;
        let mut meeting: Vec<&Row> = trade.rows.iter().filter(is_met).collect();
        meeting.sort_by(|a, b| self.compare(a, b));
        let built = meeting.first().and_then(|row| {
            trade.blobs.iter().position(|(recipe, _)| *recipe == row.setting.recipe)
        });
        let (Some(&first), Some(built)) = (meeting.first(), built) else {
            return Err(self.unmet(&trade.rows));
        };
        let (first, second) = (first.clone(), meeting.get(1).map(|&row| row.clone()));
        Ok(Choice { first, second, built: trade.blobs.swap_remove(built).1 })
    }

    /// Values that are limited, each with its limit: flash, RAM, error, cycles of a query.
    fn limited(&self, row: &Row) -> [(f64, Option<f64>); 4] {
        // A cost that was not fitted meets no rate.
        let cycles = self.instructions(row).map_or(f64::INFINITY, |found| found.most() * CYCLES);
        [
            (row.flash as f64, self.flash.map(|bytes| bytes as f64)),
            (self.ram(row), self.ram.map(|bytes| bytes as f64)),
            (row.error(), self.error),
            (cycles, self.rate.zip(self.cpu).map(|(rate, cpu)| cpu.hertz / rate)),
        ]
    }

    /// How many times its limit the value is that exceeds it most; at most 1 if all limits are met.
    fn excess(&self, row: &Row) -> f64 {
        let all = self.limited(row);
        all.iter().filter_map(|(value, limit)| Some(value / (*limit)?)).fold(0.0, f64::max)
    }

    /// The order in which settings are preferred.
    fn compare(&self, a: &Row, b: &Row) -> Ordering {
        let key = |row: &Row| {
            let mean = self.instructions(row).map_or(f64::INFINITY, |found| found.mean);
            match self.error {
                Some(_) => [mean, row.error(), row.flash as f64],
                None => [row.error(), mean, row.flash as f64],
            }
        };
        let pairs = key(a).into_iter().zip(key(b));
        pairs.map(|(a, b)| a.total_cmp(&b)).find(|order| order.is_ne()).unwrap_or(Ordering::Equal)
    }

    /// Which setting comes nearest.
    fn unmet(&self, rows: &[Row]) -> Unmet {
        let nearest = rows.iter().min_by(|a, b| self.excess(a).total_cmp(&self.excess(b)));
        let Some(nearest) = nearest else { return Unmet::NoIntervals };
        Unmet::Beyond { nearest: Box::new(nearest.clone()), limits: *self }
    }

    /// What a setting needs beyond the limits, as options.
    fn needs(&self, row: &Row) -> Vec<String> {
        let options = ["--flash", "--ram", "--error", "--rate"].into_iter().zip(self.limited(row));
        let beyond = options.filter_map(|(option, (value, limit))| {
            let limit = limit.filter(|&limit| value > limit)?;
            Some(match (option, self.cpu) {
                ("--rate", Some(cpu)) if cpu.hertz >= value => {
                    format!("--rate {}Hz", (cpu.hertz / value).floor())
                }
                ("--rate", _) => format!("{value:.0} cycles"),
                ("--error", _) => format!("--error {}", AtMost(value)),
                _ => format!("{option} {value:.0} instead of {limit:.0}"),
            })
        });
        beyond.collect()
    }
}
