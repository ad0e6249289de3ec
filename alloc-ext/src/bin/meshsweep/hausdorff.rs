//! `meshsweep hausdorff`: how far two meshes are from each other.

use crate::args::HausdorffArgs;
use crate::failure::Failure;
use crate::mesh_file;
use crate::mesh_report::write_rounding;
use crate::output::Output;
use crate::progress::Bar;
use meshsweep::hausdorff::{
    Attained, Direction, Ended, Hausdorff, Precision, Profile, Refused, hausdorff, profile,
};
use meshsweep::mesh::{Mesh, Unit, write_coloured_ply};
use serde_json::{Value, json};
use std::io::{self, Write};
use std::path::PathBuf;
use std::time::Instant;

pub fn run(args: &HausdorffArgs) -> Result<(), Failure> {
    let is_ply =
        |file: &PathBuf| file.extension().is_some_and(|ply| ply.eq_ignore_ascii_case("ply"));
    if let Some(file) = args.heat.as_ref().filter(|file| !is_ply(file)) {
        let what = format!("{}: --heat writes PLY; name a file that ends in .ply", file.display());
        return Err(Failure::Usage { what });
    }
    mesh_file::check_format(&[&args.first, &args.second], &args.read)?;
    args.threads.start();
    let load = |file| mesh_file::load(file, &args.read);
    let [first, second] = [load(&args.first)?, load(&args.second)?];
    mesh_file::refuse_units([(&args.first, first.unit), (&args.second, second.unit)])?;
    for (file, loaded) in [(&args.first, &first), (&args.second, &second)] {
        for said in loaded.report.doubts() {
            // A closed standard error does not withhold the answers.
            let _ = writeln!(io::stderr(), "{}: {said}", file.display());
        }
    }
    let unit = first.unit.or(second.unit);
    let rounding = [first.report.rounding, second.report.rounding];
    for (file, of) in [(&args.first, first.unit), (&args.second, second.unit)] {
        if let (None, Some(unit)) = (of, unit) {
            let _ = writeln!(io::stderr(), "{} names no unit; taken as {unit}", file.display());
        }
    }
    let direction = if args.one_sided { Direction::Forward } else { Direction::Both };
    let precision = Precision { relative: args.rel, absolute: args.abs, at_most: args.at_most };
    let bar = Bar::new(DIGITS, "comparing", "digits");
    let mut progress = |lower: f64, upper: f64| bar.show(digits(lower, upper));
    let started = Instant::now();
    let found = hausdorff(&first.mesh, &second.mesh, direction, &precision, &mut progress)
        .map_err(|Refused { is_second, error }| {
            Failure::build(if is_second { &args.second } else { &args.first }, error)
        })?;
    let seconds = started.elapsed().as_secs_f64();
    drop(bar);
    let profile = if args.profile || args.heat.is_some() {
        Some(spread(args, &first.mesh, &second.mesh)?)
    } else {
        None
    };
    if let (Some(file), Some(profile)) = (&args.heat, &profile) {
        let (colours, red) = colours(&profile.vertices);
        Output::file(file)?.finish(|out| write_coloured_ply(&first.mesh, &colours, out))?;
        // A closed standard error does not withhold the answers.
        let _ = writeln!(io::stderr(), "{}: red is a distance of {red:.6e}", file.display());
    }
    let profile = profile.filter(|_| args.profile);
    Output::stdout().finish(|out| {
        if args.json {
            serde_json::to_writer_pretty(
                &mut *out,
                &as_json(&found, unit, rounding, profile.as_ref(), args.at_most),
            )?;
            return writeln!(out);
        }
        write(args, &found, seconds, out)?;
        for (file, loaded) in [(&args.first, &first), (&args.second, &second)] {
            write_rounding(out, file, &loaded.report)?;
        }
        unit.map_or(Ok(()), |unit| writeln!(out, "  unit: {unit}"))?;
        profile.as_ref().map_or(Ok(()), |profile| write_profile(profile, out))
    })?;
    match args.at_most {
        Some(most) if found.upper > most => {
            let [first, second] = [args.first.clone(), args.second.clone()];
            Err(Failure::Apart { first, second, most, lower: found.lower, upper: found.upper })
        }
        _ => Ok(()),
    }
}

/// Parts of the area whose distances are told.
const PARTS: [f64; 4] = [0.5, 0.9, 0.95, 0.99];

/// Width of the mean's bounds, relative.
const MEAN_WIDTH: f64 = 0.1;

fn spread(args: &HausdorffArgs, first: &Mesh, second: &Mesh) -> Result<Profile, Failure> {
    let bar = Bar::new(DIGITS, "measuring", "digits");
    let mut progress = |lower: f64, upper: f64| bar.show(digits(lower, upper));
    // Colours need no mean.
    let (parts, width) =
        if args.profile { (&PARTS[..], MEAN_WIDTH) } else { (&[][..], f64::INFINITY) };
    profile(first, second, parts, width, &mut progress).map_err(|Refused { is_second, error }| {
        Failure::build(if is_second { &args.second } else { &args.first }, error)
    })
}

/// The middle of each distance and its colour: blue, cyan, green, yellow, red. And what red is.
fn colours(distances: &[[f64; 2]]) -> (Vec<(f32, [u8; 3])>, f64) {
    // Distances that may be 0 are rounding.
    let middle = |[lower, upper]: &[f64; 2]| if *lower > 0.0 { 0.5 * (lower + upper) } else { 0.0 };
    let most = distances.iter().map(middle).fold(0.0, f64::max);
    let colour = |distance: f64| {
        let part = if most > 0.0 { 4.0 * distance / most } else { 0.0 };
        // Each channel rises for a fourth of the way, or falls.
        let byte = |x: f64| (255.0 * x.clamp(0.0, 1.0)).round() as u8;
        [byte(part - 2.0), byte(part.min(4.0 - part)), byte(2.0 - part)]
    };
    let both = |pair| (middle(pair) as f32, colour(middle(pair)));
    (distances.iter().map(both).collect(), most)
}

fn write_profile(profile: &Profile, out: &mut dyn Write) -> io::Result<()> {
    let [lower, upper] = profile.mean;
    writeln!(out, "over the area of the first mesh")?;
    writeln!(out, "  mean      {lower:.6e} to {upper:.6e}")?;
    for (part, [lower, upper]) in PARTS.iter().zip(&profile.quantiles) {
        writeln!(out, "  {:>3} %     {lower:.6e} to {upper:.6e}", 100.0 * part)?;
    }
    if !profile.is_close {
        writeln!(out, "  the bounds are wider than a tenth: three million pieces did not suffice")?;
    }
    Ok(())
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

fn as_json(
    found: &Hausdorff,
    unit: Option<Unit>,
    rounding: [f64; 2],
    profile: Option<&Profile>,
    at_most: Option<f64>,
) -> Value {
    let Hausdorff { lower, upper, attained, pieces, .. } = found;
    let [a, b] = attained.as_ref().map_or([None; 2], |at| ends(at).map(Some));
    let point = |end: Option<([f64; 3], u32)>| end.map(|(point, _)| point);
    let triangle = |end: Option<([f64; 3], u32)>| end.map(|(_, triangle)| triangle);
    let mut value = json!({
        "lower": lower,
        "upper": upper,
        "unit": unit.map(Unit::symbol),
        "rounding": rounding,
        "a": point(a),
        "b": point(b),
        "a_triangle": triangle(a),
        "b_triangle": triangle(b),
        "pieces": pieces,
        "ended": ended(found),
    });
    if let (Some(profile), Some(fields)) = (profile, value.as_object_mut()) {
        let quantile =
            |(part, bounds): (&f64, &[f64; 2])| json!({ "part": part, "bounds": bounds });
        fields.insert("mean".to_owned(), json!(profile.mean));
        let quantiles = PARTS.iter().zip(&profile.quantiles).map(quantile).collect();
        fields.insert("quantiles".to_owned(), quantiles);
    }
    if let (Some(most), Some(fields)) = (at_most, value.as_object_mut()) {
        let holds = match (*upper <= most, *lower > most) {
            (true, _) => Some(true),
            (_, true) => Some(false),
            _ => None,
        };
        fields.insert("at_most".to_owned(), json!(most));
        fields.insert("holds".to_owned(), json!(holds));
    }
    value
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
