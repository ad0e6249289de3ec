//! What a racing image printed, and whether its answers are right.

use meshsweep_lab::measure::rival::Rival;
use meshsweep_xtask::boards::Board;

use super::questions::Course;

/// All that an image told.
#[derive(Clone, Debug, Default)]
pub struct Answers {
    pub built: Built,
    pub sets: Vec<Set>,
}

/// What building took, and what it left.
#[derive(Clone, Debug, Default)]
pub struct Built {
    pub instructions: f64,
    /// Bytes.
    pub stack: u32,
    /// Bytes after it, and the most while it ran.
    pub heap: u32,
    pub most: u32,
    /// Bytes that the engine keeps outside of heap and stack.
    pub memory: u32,
}

/// One set of questions.
#[derive(Clone, Debug)]
pub struct Set {
    pub name: String,
    pub queries: u32,
    /// Instructions.
    pub mean: f64,
    pub max: f64,
    /// Bytes.
    pub stack: u32,
    /// Bytes beyond what building left.
    pub heap: u32,
    pub told: Told,
}

/// How many questions had an answer, and the sum of the answers: distances, or parameters of hits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Told {
    pub found: u32,
    pub sum: f64,
}

impl Answers {
    /// Reads what an image printed.
    pub fn parse(printed: &str, board: &Board) -> Result<Self, String> {
        let mut answers = Self::default();
        let mut reading = 0.0;
        let mut done = false;
        let instructions =
            |ticks: &str| Ok::<_, String>(number::<f64>(ticks)? * board.instructions_per_tick);
        for line in printed.lines() {
            let words: Vec<&str> = line.split(' ').collect();
            match words.as_slice() {
                ["calibration", counted, ticks] => {
                    let off = number::<f64>(counted)? / instructions(ticks)? - 1.0;
                    if off.abs() > 1.0e-3 {
                        return Err(format!(
                            "`{line}`: not {} instructions a tick",
                            board.instructions_per_tick
                        ));
                    }
                }
                ["reading", rounds, ticks] => {
                    reading = instructions(ticks)? / number::<f64>(rounds)?
                }
                ["build", ticks, stack, heap, most, memory] => {
                    answers.built = Built {
                        instructions: instructions(ticks)?,
                        stack: number(stack)?,
                        heap: number(heap)?,
                        most: number(most)?,
                        memory: number(memory)?,
                    };
                }
                ["asked", name, queries, ticks, max, stack, heap, found, sum] => {
                    let bits = u64::from_str_radix(sum, 16)
                        .map_err(|_| format!("the image printed `{line}`"))?;
                    let count: u32 = number(queries)?;
                    answers.sets.push(Set {
                        name: (*name).to_owned(),
                        queries: count,
                        mean: instructions(ticks)? / f64::from(count.max(1)) - reading,
                        max: instructions(max)? - reading,
                        stack: number(stack)?,
                        heap: number(heap)?,
                        told: Told { found: number(found)?, sum: f64::from_bits(bits) },
                    });
                }
                ["done"] => done = true,
                _ => return Err(format!("the image printed `{line}`")),
            }
        }
        if done {
            Ok(answers)
        } else {
            Err(format!("the image stopped before it was done:\n{printed}"))
        }
    }
}

/// What parry3d tells here.
pub fn of_host(course: &Course) -> Result<Vec<(&'static str, Told)>, String> {
    let rival = Rival::new(&course.subject)?;
    let distance = |&point: &[f32; 3]| {
        f64::from(
            glam::Vec3::from_array(point).distance(glam::Vec3::from_array(rival.closest(point))),
        )
    };
    let mut told: Vec<_> = course
        .points
        .iter()
        .map(|(name, points)| {
            (*name, Told { found: points.len() as u32, sum: points.iter().map(distance).sum() })
        })
        .collect();
    let hits: Vec<f64> =
        course.segments.iter().filter_map(|&ends| rival.first_hit(ends)).map(f64::from).collect();
    told.push(("segment", Told { found: hits.len() as u32, sum: hits.iter().sum() }));
    Ok(told)
}

/// An engine that answers something else would have its instructions counted for nothing. Rounding
/// differs between processors and between engines, whose vertices may moreover have moved by a unit
/// of a `grid`; and a segment that grazes an edge may pass on one of them, so a hundredth of the
/// answers may be missing.
pub fn agree(
    answers: &Answers,
    expected: &[(&'static str, Told)],
    grid: f64,
) -> Result<(), String> {
    for (name, wanted) in expected {
        let set = answers.sets.iter().find(|set| set.name == *name);
        let told = set.ok_or_else(|| format!("the image asked no `{name}`"))?.told;
        let missing = told.found.abs_diff(wanted.found);
        let relative = if missing == 0 { 1.0e-4 } else { 1.0e-2 };
        let off = (told.sum - wanted.sum).abs();
        let allowed = relative * wanted.sum.abs() + grid * f64::from(wanted.found);
        if missing > wanted.found / 100 || off > allowed {
            return Err(format!("{name}: the image found {told:?}, the host {wanted:?}"));
        }
    }
    Ok(())
}

fn number<T: std::str::FromStr>(word: &str) -> Result<T, String> {
    word.parse().map_err(|_| format!("the image printed `{word}` where a number belongs"))
}

#[cfg(test)]
mod tests {
    use super::{Answers, Told, agree};
    use meshsweep_xtask::boards::BOARDS;

    const PRINTED: &str = "calibration 2000000 50000\nreading 4 1\nbuild 10 64 1000 1500 160\n\
        asked far 2 100 60 128 0 2 3ff0000000000000\ndone\n";

    #[test]
    fn answers_hold_what_was_printed() {
        let answers = Answers::parse(PRINTED, &BOARDS[0]).expect("readable");
        assert_eq!(
            (answers.built.instructions, answers.built.heap, answers.built.most),
            (400.0, 1000, 1500)
        );
        let far = &answers.sets[0];
        assert_eq!((far.mean, far.max, far.told), (1990.0, 2390.0, Told { found: 2, sum: 1.0 }));
    }

    #[test]
    fn a_wrong_rate_and_an_early_end_are_errors() {
        assert!(Answers::parse(PRINTED, &BOARDS[1]).is_err());
        assert!(Answers::parse(PRINTED.trim_end_matches("done\n"), &BOARDS[0]).is_err());
    }

    #[test]
    fn other_answers_and_missing_ones_are_noticed() {
        let answers = Answers::parse(PRINTED, &BOARDS[0]).expect("readable");
        assert_eq!(agree(&answers, &[("far", Told { found: 2, sum: 1.0 + 1.0e-6 })], 0.0), Ok(()));
        assert!(agree(&answers, &[("far", Told { found: 2, sum: 1.01 })], 0.0).is_err());
        assert!(agree(&answers, &[("far", Told { found: 3, sum: 1.0 })], 0.0).is_err());
        assert!(agree(&answers, &[("near", Told { found: 2, sum: 1.0 })], 0.0).is_err());
    }
}
