//! Limits of a device, and the measured setting that meets them.

use super::cost::Board;
use super::measure::{Instructions, Row, Trade};
use super::pairs::{PairRow, PairTrade};
use crate::builder::Built;
use crate::number::AtMost;
use std::cmp::Ordering;
use std::fmt;

/// Cycles of an instruction that a rate is planned with. Most take one, loads two, a jump that is
/// taken two to four, a division fourteen, and flash may add waits: twice leaves room.
pub const CYCLES: f64 = 2.0;

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
/// let trade = trade::measure(&source, &part, &points, &settings, &|_, _| {})?;
/// let limits = Limits { flash: Some(16 << 10), ..Limits::default() };
/// let choice = limits.choose(&trade)?;
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
    /// Largest error: the width of the widest measured interval, in the mesh's unit.
    pub error: Option<f64>,
    /// Queries a second. It limits nothing without a [processor](Self::cpu).
    pub rate: Option<f64>,
    /// The processor. `None`: instructions are those of a Cortex-M4F, and there is no rate.
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
    /// No setting was measured: there were no points, or no structure was built.
    NothingMeasured,
    /// No structure gives intervals.
    NoIntervals,
    /// Two models keep the distance at no pose.
    NeverClear,
    /// The setting that comes nearest to the limits, and where it exceeds them.
    Beyond {
        /// The setting as measured.
        nearest: Box<Row>,
        /// The limits.
        limits: Limits,
    },
    /// The same of structures of two models.
    BeyondOfPair {
        /// The structure as measured.
        nearest: Box<PairRow>,
        /// The limits.
        limits: Limits,
    },
}

impl fmt::Display for Unmet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NothingMeasured => {
                f.write_str("nothing was measured: there are no points, or no structure was built")
            }
            Self::NoIntervals => f.write_str("no structure gives intervals"),
            Self::NeverClear => {
                f.write_str("no pose keeps the distance, so no structure can be told from another")
            }
            Self::Beyond { nearest, limits } => {
                let (name, dials) = (nearest.name(), nearest.setting.dials());
                write!(
                    f,
                    "no setting meets these limits; the nearest is {name}: {dials}, which needs "
                )?;
                f.write_str(&limits.needs(&nearest.costs()).join(" and "))
            }
            Self::BeyondOfPair { nearest, limits } => {
                let name = nearest.structure.name();
                write!(f, "no structure meets these limits; the nearest is {name}, which needs ")?;
                f.write_str(&limits.needs(&nearest.costs()).join(" and "))
            }
        }
    }
}

impl std::error::Error for Unmet {}

/// What limits are compared with.
struct Costs {
    flash: usize,
    scratch: usize,
    /// `None`: no error is asked of it.
    error: Option<f64>,
    boards: [Option<Instructions>; 2],
    stack: [u32; 2],
}

impl Row {
    fn costs(&self) -> Costs {
        let &Self { flash, scratch, boards, stack, .. } = self;
        Costs { flash, scratch, error: Some(self.error()), boards, stack }
    }
}

impl PairRow {
    fn costs(&self) -> Costs {
        let &Self { flash, scratch, boards, stack, .. } = self;
        Costs { flash: flash.iter().sum(), scratch, error: None, boards, stack }
    }
}

/// The limit, if the value is not within it. Nothing is within a limit that is no number.
fn exceeded(value: f64, limit: Option<f64>) -> Option<f64> {
    limit.filter(|limit| value.partial_cmp(limit).is_none_or(Ordering::is_gt))
}

impl Limits {
    /// The board whose instructions count.
    #[must_use]
    pub fn board(&self) -> Board {
        self.cpu.map_or(Board::CortexM4F, |cpu| cpu.board)
    }

    /// Those of the [board](Self::board).
    #[must_use]
    pub fn instructions(&self, boards: [Option<Instructions>; 2]) -> Option<Instructions> {
        self.of_board(boards)?
    }

    /// Bytes of RAM that a query takes: its scratch, and the board's stack.
    #[must_use]
    pub fn ram(&self, scratch: usize, stack: [u32; 2]) -> f64 {
        scratch as f64 + self.of_board(stack).map_or(0.0, f64::from)
    }

    fn of_board<T>(&self, all: [T; 2]) -> Option<T> {
        Board::ALL.iter().zip(all).find(|(of, _)| **of == self.board()).map(|(_, found)| found)
    }

    /// Chooses a setting that meets all limits, of those with the fewest undecided sides and
    /// segments: with a limit of the error the one of the fewest mean instructions, else the one of
    /// the smallest error. The second one is the best of the others that has less of something. The
    /// rate is compared with the costliest query. [`measure()`](super::measure()) gives the
    /// settings.
    ///
    /// # Errors
    /// [`Unmet`].
    pub fn choose(&self, trade: &Trade) -> Result<Choice, Unmet> {
        if trade.rows.is_empty() {
            return Err(Unmet::NothingMeasured);
        }
        let rows = || trade.rows.iter().filter(|row| row.guaranteed.is_some());
        let mut meeting: Vec<&Row> = rows().filter(|row| self.is_met(&row.costs())).collect();
        meeting.sort_by(|a, b| self.compare(a, b));
        let built = meeting
            .first()
            .and_then(|row| trade.blobs.iter().find(|(recipe, _)| *recipe == row.setting.recipe));
        let (Some(&first), Some((_, built))) = (meeting.first(), built) else {
            return Err(self.unmet(rows()));
        };
        // One that is worse in all is no choice.
        let values =
            |row: &Row| [row.error(), self.mean(row.boards), row.flash as f64, row.scratch as f64];
        let is_choice = |row: &&&Row| values(row).iter().zip(values(first)).any(|(a, b)| *a < b);
        let second = meeting.iter().skip(1).find(is_choice).map(|&row| row.clone());
        Ok(Choice { first: first.clone(), second, built: built.clone() })
    }

    /// Chooses a structure of two models that meets all limits but that of the error, which pairs
    /// have not. It has the fewest [false alarms](PairRow::false_alarms); of equal ones the fewest
    /// mean instructions, then the least flash. Structures that [missed](PairRow::missed) a pose
    /// are left out. The second one is the best of the others that meet the limits. Flash is both
    /// blobs'. [`measure_pair`](super::measure_pair()) gives the structures.
    ///
    /// # Errors
    /// [`Unmet`].
    pub fn choose_pair<'t>(
        &self,
        trade: &'t PairTrade,
    ) -> Result<(&'t PairRow, Option<&'t PairRow>), Unmet> {
        if trade.clear == 0 {
            return Err(Unmet::NeverClear);
        }
        let rows = || trade.rows.iter().filter(|row| row.missed == 0);
        let mut meeting: Vec<&PairRow> = rows().filter(|row| self.is_met(&row.costs())).collect();
        let mean = |row: &PairRow| self.mean(row.boards);
        meeting.sort_by(|a, b| {
            let cost = mean(a).total_cmp(&mean(b)).then(a.flash.iter().cmp(&b.flash));
            a.false_alarms.cmp(&b.false_alarms).then(cost)
        });
        if let Some(&first) = meeting.first() {
            // One that is worse in all is no choice.
            let values = |row: &PairRow| {
                [mean(row), row.flash.iter().sum::<usize>() as f64, row.scratch as f64]
            };
            let is_choice =
                |row: &&&PairRow| values(row).iter().zip(values(first)).any(|(a, b)| *a < b);
            return Ok((first, meeting.iter().skip(1).find(is_choice).copied()));
        }
        let excess = |row: &&PairRow| self.excess(&row.costs());
        let nearest = rows().min_by(|a, b| excess(a).total_cmp(&excess(b)));
        let nearest = Box::new(nearest.ok_or(Unmet::NothingMeasured)?.clone());
        Err(Unmet::BeyondOfPair { nearest, limits: *self })
    }

    /// Cycles that a query may take at the rate.
    fn cycles(&self) -> Option<f64> {
        self.rate.zip(self.cpu).map(|(rate, cpu)| cpu.hertz / rate)
    }

    /// Mean instructions; infinite if no cost was fitted.
    fn mean(&self, boards: [Option<Instructions>; 2]) -> f64 {
        self.instructions(boards).map_or(f64::INFINITY, |found| found.mean)
    }

    /// Values that are limited, each with its limit: flash, RAM, error, cycles of a query.
    fn limited(&self, costs: &Costs) -> [(f64, Option<f64>); 4] {
        let &Costs { flash, scratch, error, boards, stack } = costs;
        // A cost that was not fitted meets no rate.
        let cycles =
            self.instructions(boards).map_or(f64::INFINITY, |found| found.at_most() * CYCLES);
        [
            (flash as f64, self.flash.map(|bytes| bytes as f64)),
            (self.ram(scratch, stack), self.ram.map(|bytes| bytes as f64)),
            (error.unwrap_or(0.0), self.error.filter(|_| error.is_some())),
            (cycles, self.cycles()),
        ]
    }

    /// Whether all values are within their limits.
    fn is_met(&self, costs: &Costs) -> bool {
        self.limited(costs).iter().all(|&(value, limit)| exceeded(value, limit).is_none())
    }

    /// How many times their limits the values are that exceed them, in all.
    fn excess(&self, costs: &Costs) -> f64 {
        let ratio = |limit, value| if limit > 0.0 { value / limit } else { f64::INFINITY };
        let all = self.limited(costs).into_iter();
        all.filter_map(|(value, limit)| Some(ratio(exceeded(value, limit)?, value))).sum()
    }

    /// The order in which settings are preferred.
    fn compare(&self, a: &Row, b: &Row) -> Ordering {
        let key = |row: &Row| {
            let (undecided, mean) = (row.undecided as f64, self.mean(row.boards));
            match self.error {
                Some(_) => [undecided, mean, row.error(), row.flash as f64],
                None => [undecided, row.error(), mean, row.flash as f64],
            }
        };
        let pairs = key(a).into_iter().zip(key(b));
        pairs.map(|(a, b)| a.total_cmp(&b)).find(|order| order.is_ne()).unwrap_or(Ordering::Equal)
    }

    /// Which setting comes nearest.
    fn unmet<'r>(&self, rows: impl Iterator<Item = &'r Row>) -> Unmet {
        let excess = |row: &Row| self.excess(&row.costs());
        let nearest = rows.min_by(|a, b| excess(a).total_cmp(&excess(b)));
        let Some(nearest) = nearest else { return Unmet::NoIntervals };
        Unmet::Beyond { nearest: Box::new(nearest.clone()), limits: *self }
    }

    /// What is needed beyond the limits, as options.
    fn needs(&self, costs: &Costs) -> Vec<String> {
        let options = ["--flash", "--ram", "--error", "--rate"].into_iter();
        let options = options.zip(self.limited(costs));
        let beyond = options.filter_map(|(option, (value, limit))| {
            let limit = exceeded(value, limit)?;
            Some(match (option, self.cpu) {
                ("--rate", _) if value.is_infinite() => "a cost that was not counted".to_owned(),
                ("--rate", Some(cpu)) if cpu.hertz >= value => {
                    let rates = [cpu.hertz / value, cpu.hertz / limit].map(f64::floor);
                    format!("--rate {}Hz instead of {}Hz", rates[0], rates[1])
                }
                ("--rate", _) => format!("{value:.0} cycles instead of {limit:.0}"),
                ("--error", _) => {
                    format!("--error {} instead of {}", AtMost(value), AtMost(limit))
                }
                _ => format!("{option} {value:.0} instead of {limit:.0}"),
            })
        });
        beyond.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Points, Setting, measure, points};
    use super::*;
    use crate::builder::Recipe;
    use crate::load::Source;
    use crate::surface::VertexBits;
    use std::path::Path;

    /// A part at so many points: a box tree of two precisions, and one that stops early.
    fn measured(count: usize) -> Trade {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/bracket.stl");
        let source = Source::of_file(&file, None).expect("it is read");
        let part = source.repaired().expect("it is a mesh");
        let points = points(&part.mesh, Points::Near, count);
        let [coarse, fine] =
            [VertexBits::Grid16, VertexBits::F32].map(|bits| Setting::new(Recipe::Tree(bits)));
        let settings = [coarse, coarse.with_budget(coarse.budget.with_steps(4)), fine];
        measure(&source, &part, &points, &settings, &|_, _| {}).expect("points are finite")
    }

    const CPU: Cpu = Cpu { board: Board::CortexM4F, hertz: 1e9 };

    #[test]
    fn the_choice_meets_all_limits_and_no_other_that_does_is_better() {
        let trade = measured(20);
        for row in &trade.rows {
            let (flash, error) = (Some(row.flash), Some(row.error()));
            let wanted = Limits { flash, error, ..Limits::default() };
            let choice = wanted.choose(&trade).expect("the row meets its own values");
            assert!(choice.first.flash <= row.flash && choice.first.error() <= row.error());
            assert_eq!(choice.built.bytes().len(), choice.first.flash);
            let mean = |row: &Row| row.boards[0].expect("it is fitted").mean;
            assert!(mean(&choice.first) <= mean(row));
        }
    }

    #[test]
    fn a_limit_that_nothing_can_meet_is_met_by_nothing() {
        let trade = measured(20);
        for wrong in [-1.0, f64::NAN, f64::NEG_INFINITY] {
            let error = Limits { error: Some(wrong), ..Limits::default() };
            let rate = Limits { rate: Some(wrong), cpu: Some(CPU), ..Limits::default() };
            for limits in [error, rate] {
                let unmet = limits.choose(&trade).expect_err("it cannot be met");
                assert!(matches!(unmet, Unmet::Beyond { .. }), "{limits:?}: {unmet:?}");
            }
        }
        let none = Limits { flash: Some(0), ram: Some(0), ..Limits::default() };
        let unmet = none.choose(&trade).expect_err("no blob is empty").to_string();
        assert!(unmet.contains("--flash") && unmet.contains("--ram"), "{unmet}");
    }

    #[test]
    fn without_points_nothing_is_measured() {
        let unmet = Limits::default().choose(&measured(0)).err();
        assert_eq!(unmet, Some(Unmet::NothingMeasured));
    }
}
