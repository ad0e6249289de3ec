//! The lines that the suite prints, on a board or on the host.

use crate::boards::Board;

/// Hash of one block.
#[derive(Clone, Debug)]
pub struct Block {
    /// The question's name.
    pub kind: String,
    /// Number of the block in its kind.
    pub index: u32,
    /// Of all answers' bits.
    pub hash: String,
    /// Instructions of all queries of its kind up to its end; 0 if the reading is the host's.
    pub instructions: f64,
}

impl Block {
    /// Whether both are the same block of one kind.
    fn is_at(&self, other: &Self) -> bool {
        self.kind == other.kind && self.index == other.index
    }

    /// Whether they are of the same answers.
    fn is(&self, other: &Self) -> bool {
        self.is_at(other) && self.hash == other.hash
    }
}

/// Cost of one kind of query.
#[derive(Clone, Debug, Default)]
pub struct Cost {
    /// The question's name.
    pub kind: String,
    /// Queries that were asked.
    pub queries: u32,
    /// Instructions of the cheapest query.
    pub min: f64,
    /// Of the mean one.
    pub mean: f64,
    /// Of the costliest one.
    pub max: f64,
    /// Bytes below the function of the suite that calls the core.
    pub stack: u32,
}

/// All that a run told.
#[derive(Clone, Debug, Default)]
pub struct Reading {
    /// Length and hash of the blob.
    pub blob: String,
    /// Hashes in the order of asking.
    pub blocks: Vec<Block>,
    /// Costs in the order of asking.
    pub costs: Vec<Cost>,
    /// Bytes of stack that opening took.
    pub opening: u32,
    /// Bytes of memory that the image hands to queries.
    pub scratch: u32,
    /// Bytes of scratch that no query outgrows, as the blob says.
    pub needs: u32,
    /// Instructions of each query, where the image tells them.
    pub each: Vec<f64>,
}

impl Reading {
    /// Reads what an image printed on a board, or what the host printed.
    ///
    /// # Errors
    /// The image stopped early, or its counter runs at another rate than the board's.
    pub fn parse(printed: &str, board: Option<&Board>) -> Result<Self, String> {
        let mut reading = Self::default();
        let mut done = false;
        for line in printed.lines() {
            let words: Vec<&str> = line.split(' ').collect();
            match words.as_slice() {
                ["blob", bytes, hash] => reading.blob = format!("{bytes} {hash}"),
                ["opening", bytes] => reading.opening = number(bytes)?,
                ["scratch", bytes] => reading.scratch = number(bytes)?,
                ["needs", bytes] => reading.needs = number(bytes)?,
                ["calibration", instructions, ticks] => {
                    let board = board.ok_or("the host has no counter")?;
                    check_rate(number(instructions)?, number(ticks)?, board)?;
                }
                ["block", kind, index, hash, ticks @ ..] => {
                    let rate = board.map_or(0.0, |board| board.instructions_per_tick);
                    let ticks: f64 = ticks.first().map_or(Ok(0.0), |ticks| number(ticks))?;
                    reading.blocks.push(Block {
                        kind: (*kind).to_owned(),
                        index: number(index)?,
                        hash: (*hash).to_owned(),
                        instructions: ticks * rate,
                    });
                }
                ["ticks", kind, queries, min, sum, max] => {
                    let rate = board.map_or(0.0, |board| board.instructions_per_tick);
                    let instructions = |ticks: &str| Ok::<_, String>(number::<f64>(ticks)? * rate);
                    let count: u32 = number(queries)?;
                    reading.costs.push(Cost {
                        kind: (*kind).to_owned(),
                        queries: count,
                        min: instructions(min)?,
                        mean: instructions(sum)? / f64::from(count.max(1)),
                        max: instructions(max)?,
                        stack: 0,
                    });
                }
                ["each", ticks] => {
                    let rate = board.map_or(0.0, |board| board.instructions_per_tick);
                    reading.each.push(number::<f64>(ticks)? * rate);
                }
                ["stack", kind, bytes] => {
                    let cost = reading.costs.iter_mut().find(|cost| cost.kind == *kind);
                    cost.ok_or_else(|| format!("`{line}` before its ticks"))?.stack =
                        number(bytes)?;
                }
                ["refused", error] => {
                    return Err(format!("the core refuses the blob: error {error}"));
                }
                ["done"] => done = true,
                _ => return Err(format!("the image printed `{line}`")),
            }
        }
        if done {
            Ok(reading)
        } else {
            Err(format!("the image stopped before it was done:\n{printed}"))
        }
    }

    /// Bytes of the blob.
    ///
    /// # Errors
    /// The reading has no line of it.
    pub fn bytes(&self) -> Result<u64, String> {
        number(self.blob.split(' ').next().unwrap_or_default())
    }

    /// Queries of the first `blocks` blocks of a kind, or of all if they are fewer, and the
    /// instructions of their mean.
    #[must_use]
    pub fn mean_of_first(&self, cost: &Cost, blocks: u32) -> Option<(u32, f64)> {
        let all = || self.blocks.iter().filter(|block| block.kind == cost.kind);
        let last = all().take_while(|block| block.index < blocks).last()?;
        let queries = cost.queries / u32::try_from(all().count()).ok()? * (last.index + 1);
        Some((queries, last.instructions / f64::from(queries)))
    }

    /// Compares the bits of all answers with those of a run that asked as many blocks of each kind
    /// or more.
    ///
    /// # Errors
    /// Other bits, or fewer than `least` blocks of a kind of which the other run has as many.
    pub fn compare(&self, reference: &Self, least: u32) -> Result<(), String> {
        if self.blob != reference.blob {
            return Err(format!(
                "the image carries blob {}, the host read {}",
                self.blob, reference.blob
            ));
        }
        let is_asked = |there: &&Block| {
            there.index < least || self.blocks.iter().any(|here| here.is_at(there))
        };
        let asked: Vec<&Block> = reference.blocks.iter().filter(is_asked).collect();
        if self.blocks.len() != asked.len() {
            return Err(format!("{} blocks, not {}", self.blocks.len(), asked.len()));
        }
        let pairs = self.blocks.iter().zip(asked).filter(|(here, there)| !here.is(there));
        let differences: Vec<_> = pairs
            .map(|(here, there)| {
                format!("{} {}: {}, on the host {}", here.kind, here.index, here.hash, there.hash)
            })
            .collect();
        match differences.first() {
            None => Ok(()),
            Some(first) => Err(format!(
                "{} of {} blocks differ from the host's; the first is {first}",
                differences.len(),
                self.blocks.len()
            )),
        }
    }
}

fn number<T: std::str::FromStr>(word: &str) -> Result<T, String> {
    word.parse().map_err(|_| format!("the image printed `{word}` where a number belongs"))
}

/// A board whose counter runs at another rate than assumed would have all its costs wrong.
fn check_rate(instructions: f64, ticks: f64, board: &Board) -> Result<(), String> {
    let measured = instructions / ticks;
    let off = (measured / board.instructions_per_tick - 1.0).abs();
    if off < 1.0e-3 {
        Ok(())
    } else {
        Err(format!("{measured:.3} instructions a tick, {} expected", board.instructions_per_tick))
    }
}

#[cfg(test)]
mod tests {
    use super::{Block, Reading};
    use crate::boards::BOARDS;

    const PRINTED: &str = "blob 3 0000000000000001\ncalibration 2000000 50000\nopening 80\n\
        scratch 256\nblock arith 0 000000000000000a 4\nticks arith 2 1 4 3\nstack arith 64\ndone\n";

    #[test]
    fn a_reading_holds_what_was_printed() {
        let reading = Reading::parse(PRINTED, Some(&BOARDS[0])).expect("readable");
        assert_eq!(reading.blocks.len(), 1);
        let cost = &reading.costs[0];
        assert_eq!((cost.min, cost.mean, cost.max, cost.stack), (40.0, 80.0, 120.0, 64));
    }

    #[test]
    fn the_mean_of_fewer_blocks_is_that_of_a_run_that_asks_no_more() {
        let whole = PRINTED
            .replace(" 4\nticks arith 2 1 4 3", " 4\nblock arith 1 0b 10\nticks arith 4 1 10 3");
        let [few, many] = [PRINTED, &whole]
            .map(|printed| Reading::parse(printed, Some(&BOARDS[0])).expect("readable"));
        let first = |reading: &Reading| reading.mean_of_first(&reading.costs[0], 1);
        assert_eq!(first(&few), Some((2, 80.0)));
        assert_eq!(first(&many), first(&few));
        assert_eq!(many.mean_of_first(&many.costs[0], 16), Some((4, 100.0)));
    }

    #[test]
    fn a_wrong_rate_and_an_early_end_are_errors() {
        assert!(Reading::parse(PRINTED, Some(&BOARDS[1])).is_err());
        assert!(Reading::parse(PRINTED.trim_end_matches("done\n"), Some(&BOARDS[0])).is_err());
        assert!(Reading::parse(&format!("panicked\n{PRINTED}"), Some(&BOARDS[0])).is_err());
    }

    #[test]
    fn one_changed_bit_is_located() {
        let reference = Reading::parse(PRINTED, Some(&BOARDS[0])).expect("readable");
        let mut other = reference.clone();
        assert_eq!(other.compare(&reference, 1), Ok(()));
        other.blocks[0] = Block { hash: "000000000000000b".to_owned(), ..other.blocks[0].clone() };
        assert!(other.compare(&reference, 1).is_err_and(|reason| reason.contains("arith 0")));
    }

    #[test]
    fn fewer_blocks_than_the_host_s_are_compared_if_they_are_as_many_as_asked() {
        let here = Reading::parse(PRINTED, Some(&BOARDS[0])).expect("readable");
        let mut host = here.clone();
        let second =
            |hash: &str| Block { index: 1, hash: hash.to_owned(), ..host.blocks[0].clone() };
        host.blocks.push(second("000000000000000b"));
        assert_eq!(here.compare(&host, 1), Ok(()));
        assert!(here.compare(&host, 2).is_err_and(|reason| reason.contains("not 2")));
        // A block that the host did not ask.
        assert!(host.compare(&here, 1).is_err());
    }
}
