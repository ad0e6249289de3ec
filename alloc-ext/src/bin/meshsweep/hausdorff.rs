//! `meshsweep hausdorff`: how far two meshes are from each other.

use crate::args::HausdorffArgs;
use crate::failure::Failure;
use crate::mesh_file;
use crate::output::Output;
use crate::progress::Bar;
use meshsweep::hausdorff::{Attained, Direction, Ended, Hausdorff, Precision, Refused, hausdorff};
use serde_json::{Value, json};
use std::io::{self, Write};
use std::time::Instant;

pub fn run(args: &HausdorffArgs) -> Result<(), Failure> {
    let [first, second] = [mesh_file::load(&args.first)?, mesh_file::load(&args.second)?];
    let direction = if args.one_sided { Direction::Forward } else { Direction::Both };
    let precision = Precision { relative: args.rel, absolute: args.abs, at_most: args.at_most };
    let bar = Bar::new(DIGITS, "comparing", "digits");
    let progress = |lower: f64, upper: f64| bar.show(digits(lower, upper));
    let started = Instant::now();
    let found = hausdorff(&first.mesh, &second.mesh, direction, &precision, progress).map_err(
        |Refused { is_second, error }| {
            Failure::build(if is_second { &args.second } else { &args.first }, error)
        },
    )?;
    let seconds = started.elapsed().as_secs_f64();
    drop(bar);
    Output::stdout().finish(|out| {
        if args.json {
            serde_json::to_writer_pretty(&mut *out, &as_json(&found))?;
            writeln!(out)
        } else {
            write(args, &found, seconds, out)
        }
    })?;
    match args.at_most {
        Some(most) if found.upper > most => {
            let [first, second] = [args.first.clone(), args.second.clone()];
            Err(Failure::Apart { first, second, most, lower: found.lower, upper: found.upper })
        }
        _ => Ok(()),
    }
}

/// Length of the bar.
const DIGITS: usize = 12;

/// Decimal digits in which both bounds agree.
fn digits(lower: f64, upper: f64) -> usize {
    let part = (upper - lower) / upper;
    if part.is_nan() {
        0
    } else if part > 0.0 {
        (-part.log10()).clamp(0.0, DIGITS as f64) as usize
    } else {
        DIGITS
    }
}

/// The points and triangles of the first and of the second mesh.
fn ends(at: &Attained) -> [([f64; 3], u32); 2] {
    let (from, to) = ((at.from, at.from_triangle), (at.to, at.to_triangle));
    if at.is_backward { [to, from] } else { [from, to] }
}

/// Why the search ended.
fn ended(found: &Hausdorff) -> &'static str {
    match found.ended {
        Ended::Precision => "precision",
        Ended::Rounding => "rounding",
        Ended::Pieces => "pieces",
    }
}

fn as_json(found: &Hausdorff) -> Value {
    let Hausdorff { lower, upper, attained, pieces, .. } = found;
    let [a, b] = attained.as_ref().map_or([None; 2], |at| ends(at).map(Some));
    let point = |end: Option<([f64; 3], u32)>| end.map(|(point, _)| point);
    let triangle = |end: Option<([f64; 3], u32)>| end.map(|(_, triangle)| triangle);
    json!({
        "lower": lower,
        "upper": upper,
        "a": point(a),
        "b": point(b),
        "a_triangle": triangle(a),
        "b_triangle": triangle(b),
        "pieces": pieces,
        "ended": ended(found),
    })
}

fn write(
    args: &HausdorffArgs,
    found: &Hausdorff,
    seconds: f64,
    out: &mut dyn Write,
) -> io::Result<()> {
    writeln!(out, "distance  {} to {}", found.lower, found.upper)?;
    if let Some(at) = &found.attained {
        let names = [&args.first, &args.second];
        for (([x, y, z], triangle), name) in ends(at).into_iter().zip(names) {
            writeln!(out, "  {x},{y},{z}  in triangle {triangle} of {}", name.display())?;
        }
        let farthest = names[usize::from(at.is_backward)].display();
        writeln!(out, "  the farthest point is on {farthest}")?;
    }
    match found.ended {
        Ended::Precision => {}
        Ended::Rounding => writeln!(out, "  the bounds are as close as rounding allows")?,
        Ended::Pieces => writeln!(out, "  the search was given up before the bounds were close")?,
    }
    writeln!(out, "  {} pieces of triangles, {seconds:.2} s", found.pieces)
}
