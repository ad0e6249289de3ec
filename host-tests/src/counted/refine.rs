//! A refined hull that follows a point.

use std::hint::black_box;
use std::path::Path;

use glam::Vec3;
use meshsweep_core::{Change, Focus, Hull, RefinedHull, VertIdx};

/// Splits of the refined hull: 8 KiB.
const SPLITS: usize = 500;

/// Updates for a point that runs from vertex to vertex of the base hull, by a thousandth of the
/// box's diagonal each. `question`: a blob, and the focus's radius and the error as parts of the
/// diagonal. The answer has the means of faces and changed splits.
///
/// # Errors
/// A blob that is missing or refused, or numbers that are none.
pub fn ask(fixtures: &Path, question: &str, updates: usize) -> Result<String, String> {
    let words: Vec<&str> = question.split(' ').collect();
    let &[blob, radius, error] = words.as_slice() else {
        return Err(format!("`{question}` is not: refine BLOB RADIUS ERROR"));
    };
    let part = |word: &str| word.parse::<f32>().map_err(|_| format!("`{word}` is not a number"));
    let bytes = std::fs::read(fixtures.join(blob)).map_err(|error| format!("{blob}: {error}"))?;
    let hull = Hull::open(&bytes).map_err(|error| error.to_string())?;
    let [least, greatest] = hull.bounds().map(Vec3::from_array);
    let diagonal = least.distance(greatest);
    let (radius, error) = (part(radius)? * diagonal, part(error)? * diagonal);
    let mut refined = Box::new(RefinedHull::<SPLITS>::new());
    let mut changes = [Change::EMPTY; 64];
    let (mut faces, mut changed, mut short) = (0u64, 0u64, 0u64);
    let mut asked = 0;
    let corner = |v: u32| hull.vertex(VertIdx(v)).map(Vec3::from_array);
    let mut here = corner(0).ok_or("no vertex")?;
    for target in (0..hull.header().base_vertices).rev().cycle() {
        let way = corner(target).ok_or("no vertex")? - here;
        let steps = (way.length() / (1e-3 * diagonal)).ceil().max(1.0);
        for _ in 0..steps as u32 {
            if asked == updates {
                let mean = |sum: u64| sum as f64 / asked.max(1) as f64;
                let memory = size_of::<RefinedHull<'_, SPLITS>>();
                return Ok(format!(
                    "0 0 1 {:.0} faces, {:.1} splits changed, {:.2} of the updates short, \
                        {memory} bytes",
                    mean(faces),
                    mean(changed),
                    mean(short)
                ));
            }
            asked += 1;
            let focus = Focus::Ball { centre: here.to_array(), radius };
            let update = refined.update(&hull, &focus, error, &mut changes);
            let update = black_box(update.map_err(|error| error.to_string())?);
            faces += u64::from(update.faces);
            changed += u64::from(update.performed + update.undone);
            short += u64::from(update.error_left > 0.0);
            here += way / steps;
        }
    }
    Err("no vertex".to_owned())
}
