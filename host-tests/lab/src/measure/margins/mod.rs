//! How much of each margin for rounding is used: kernels against arithmetic of 106 bits, on
//! triangles and places of all shapes.
//!
//! A *share* is the error that a kernel made in the direction that its margin pays for, over the
//! margin. Above 1 a bound would be wrong.

mod place;
mod trials;

use meshsweep_host_tests::generate::Rng;
use meshsweep_xtask::process::parallel;
use meshsweep_xtask::table::{Table, fixed, row};

use place::SHAPES;
use trials::MARGINS;

/// Trials that one thread runs before the next margin or shape has its turn.
const CHUNK: usize = 2_000;

/// Runs `count` trials of each margin.
///
/// # Errors
/// A share above 1: a bound that is wrong.
pub fn table(count: usize) -> Result<Table, String> {
    let columns = ["margin", "section", "units", "proved", "trials", "largest share", "of shape"];
    let mut table = Table::new("margins", "Margins for rounding, and how much is used", &columns);
    let mut wrong = Vec::new();
    for margin in &MARGINS {
        let chunks: Vec<usize> = (0..count.div_ceil(CHUNK)).collect();
        let found = parallel(&chunks, |&chunk| {
            let mut rng = Rng::new(chunk as u64);
            let mut most = [f64::NEG_INFINITY; SHAPES.len()];
            let mut trials = 0;
            for _ in 0..CHUNK {
                let shape = rng.below(SHAPES.len());
                if let Some(share) = (margin.share)(&mut rng, SHAPES[shape]) {
                    most[shape] = most[shape].max(share);
                    trials += 1;
                }
            }
            (most, trials)
        });
        let trials: usize = found.iter().map(|((_, trials), _)| trials).sum();
        let of_shape = |shape: usize| {
            found.iter().map(|((most, _), _)| most[shape]).fold(f64::NEG_INFINITY, f64::max)
        };
        let (shape, most) = (0..SHAPES.len()).map(|shape| (SHAPES[shape], of_shape(shape))).fold(
            (SHAPES[0], f64::NEG_INFINITY),
            |best, new| if new.1 > best.1 { new } else { best },
        );
        if most > 1.0 {
            wrong.push(margin.name);
        }
        table.push(row![
            margin.name,
            margin.section,
            fixed(margin.units, 0),
            margin.proved,
            trials,
            fixed(most, 3),
            shape.name(),
        ]);
    }
    table.note("share: largest error over margin, by 106 bits");
    table.note("a proof allows no share above proved / units");
    if wrong.is_empty() { Ok(table) } else { Err(format!("{}\nabove 1: {wrong:?}", table.text())) }
}

#[cfg(test)]
mod tests {
    use super::table;

    #[test]
    fn no_kernel_errs_by_more_than_its_margin() {
        let table = table(4_000).expect("no share above 1");
        assert!(!table.text().contains("-inf"), "every margin was tried");
    }
}
