//! `meshsweep build` with limits: the setting that meets them is chosen by measurement.

use super::curve::{self, OfCurves};
use super::measured::measured;
use super::table;
use crate::args::{At, BuildArgs};
use crate::failure::Failure;
use crate::mesh_file;
use meshsweep::builder::{Built, Recipe};
use meshsweep::load::Loaded;
use meshsweep::number::{About, AtMost};
use meshsweep::trade::{CYCLES, Choice, How, Limits, Points, Question, Row, Setting, Unmet};
use meshsweep_core::Budget;
use serde_json::{Value, json};
use std::io::{self, Write};

/// Points that are measured.
const POINTS: usize = 1000;

/// A choice, and the points that it was measured at.
pub struct Chosen {
    /// The mesh. `None` of curves.
    pub loaded: Option<Loaded>,
    limits: Limits,
    first: Row,
    second: Option<Row>,
    /// Part of the triangles that are needles.
    needles: f64,
    /// Number of points, and their kind in words.
    points: (usize, String),
    /// Whether the ends of curves are joined by an option.
    closed: bool,
}

impl Chosen {
    /// The options that build its blob.
    pub fn options(&self) -> String {
        let mut options = self.first.build();
        if self.closed {
            options += " --closed";
        }
        options
    }
}

/// Chooses the setting that meets the limits.
pub fn choose(args: &BuildArgs) -> Result<(Built, Chosen), Failure> {
    let limits = args.limits.limits();
    let at = args.limits.at.clone().unwrap_or(At::Made(Points::Near));
    let (loaded, points, trade) = if args.is_curve() {
        let OfCurves { mut trade, points, kind, is_fence, .. } =
            curve::measured(&args.mesh, &args.read, args.closed, &at, POINTS)?;
        let question = if is_fence { Question::Signed } else { Question::ClosestPoint };
        trade.rows.retain(|row| row.setting.question == question);
        (None, (points, kind), trade)
    } else {
        let question = args.measured().unwrap_or(Question::ClosestPoint);
        let (loaded, measured) = measured(&args.mesh, &args.read, question, &at, POINTS)?;
        (Some(loaded), (measured.points, measured.kind), measured.trade)
    };
    let file = mesh_file::named(&args.mesh, &args.read)?;
    let failed = |unmet: Unmet| Failure::Limits { file, what: unmet.to_string() };
    let Choice { first, second, built, .. } = limits.choose(&trade).map_err(failed)?;
    let (needles, closed) = (trade.needles, args.closed);
    Ok((built, Chosen { loaded, limits, first, second, needles, points, closed }))
}

/// Says what was chosen, why, and how to ask it.
pub fn write(out: &mut dyn Write, chosen: &Chosen) -> io::Result<()> {
    let Chosen { limits, first, second, needles, points: (points, kind), .. } = chosen;
    let question = first.setting.question;
    let decided = match question {
        Question::ClosestPoint => "",
        _ => "fewest undecided, then ",
    };
    let least = match limits.error {
        Some(_) => "fewest instructions",
        None => "smallest error",
    };
    let why = format!("{decided}{least} of those that meet all limits");
    writeln!(out, "chosen: {}: {}", first.name(), first.setting.dials())?;
    let (of, by) = match (question, first.setting.how, first.setting.recipe) {
        (Question::FirstHit, _, Recipe::Hull(_)) => ("segments", ", by outer_hits"),
        (Question::FirstHit, ..) => ("segments", ", by first_hit"),
        (Question::Signed, ..) => ("points", ", by Curve::signed_distance"),
        (_, _, Recipe::Sdf(_)) => ("points", ", by Sdf::distance"),
        (_, _, Recipe::TreeWithSdf(_)) => ("points", ", by BvhWithSdf::distance_bounds"),
        (_, How::Fresh, _) => ("points", ""),
        (_, How::Hinted, _) => ("points", ", from the hint of the last query"),
        (_, How::Coherent, Recipe::Tree(_)) => ("points", ", by a CoherentQuery::<128>"),
        (_, How::Coherent, Recipe::Curve(_)) => ("points", ", by a kept CurveSweep"),
        (_, How::Coherent, _) => ("points", ", by a kept Sweep"),
        (_, How::Precise, _) => ("points", ", by closest_point_precise"),
    };
    writeln!(out, "  why: {why}, at {points} {of} {kind}")?;
    write_costs(out, limits, first)?;
    match question {
        Question::FirstHit => writeln!(out, "  undecided: {} of these segments", first.undecided)?,
        Question::Signed => writeln!(out, "  undecided: {} of these sides", first.undecided)?,
        _ => {}
    }
    writeln!(out, "  built: {}", chosen.options())?;
    let budget = budget(&first.setting.budget);
    let kept = match (first.setting.how, first.setting.recipe) {
        (_, Recipe::Hull(_)) => ", the refined hull among it",
        (How::Coherent, _) => ", the memory kept among it",
        _ => "",
    };
    let scratch = first.scratch;
    writeln!(out, "  ask with: {budget}{by}, and {scratch} bytes of scratch{kept}")?;
    if let Recipe::Hull(_) = first.setting.recipe {
        let (splits, beside) = (Setting::SPLITS, Setting::BESIDE_SPLITS);
        writeln!(
            out,
            "  a RefinedHull::<{splits}>, reset before each segment, and {beside} entries; \
             first_hit if starts_inside is set"
        )?;
    }
    if let Some(percent) = limits.instructions(first.boards).map(|found| 100.0 * found.error) {
        writeln!(
            out,
            "  predicted: a mean query of the fit's meshes and tests within {percent:.0} %; \
             {CYCLES} cycles an instruction"
        )?;
    }
    if !first.setting.is_counted() {
        writeln!(out, "  none of its kind was counted: the prediction's error is unknown")?;
    }
    table::write_needles(out, "  ", *needles)?;
    writeln!(
        out,
        "  the error is the largest of these {of}; elsewhere an interval may be wider, and holds"
    )?;
    match second {
        Some(second) => {
            writeln!(out, "second: {}: {}", second.name(), second.setting.dials())?;
            write_costs(out, limits, second)?;
            writeln!(out, "  instead of the first: {}", gain(limits, first, second))
        }
        None => writeln!(out, "second: nothing else meets them and has less of anything"),
    }
}

/// The choice as JSON. Rows are as in `trade --json`.
pub fn as_json(Chosen { first, second, points: (points, kind), .. }: &Chosen) -> Value {
    json!({
        "points": points,
        "kind": kind,
        "first": table::of_row(first),
        "second": second.as_ref().map(table::of_row),
    })
}

fn write_costs(out: &mut dyn Write, limits: &Limits, row: &Row) -> io::Result<()> {
    let (flash, ram, error) = (row.flash, limits.ram(row.scratch, row.stack), AtMost(row.error()));
    write!(out, "  flash {flash}, RAM {ram:.0}, error {error}")?;
    let found = limits.instructions(row.boards);
    if let Some(found) = found {
        write!(
            out,
            ", {:.0} instructions of a {}, at most {:.0} of these",
            found.mean,
            limits.board().name(),
            found.at_most()
        )?;
    }
    if let (Some(cpu), Some(found)) = (limits.cpu, found) {
        let microseconds = 1e6 * found.at_most() * CYCLES / cpu.hertz;
        write!(out, ": {} us", About((10.0 * microseconds).round() / 10.0))?;
    }
    writeln!(out)
}

/// What the second setting has more or less of.
fn gain(limits: &Limits, first: &Row, second: &Row) -> String {
    let mean = |row: &Row| limits.instructions(row.boards).map_or(0.0, |found| found.mean);
    let values = [
        ("flash", first.flash as f64, second.flash as f64),
        ("scratch", first.scratch as f64, second.scratch as f64),
        ("error", first.error(), second.error()),
        ("instructions", mean(first), mean(second)),
    ];
    let told = values.iter().filter(|(_, a, b)| a != b && *a > 0.0).map(|(name, a, b)| {
        let ratio = b / a;
        if ratio < 2.0 {
            format!("{name} {:+.0} %", 100.0 * (ratio - 1.0))
        } else {
            format!("{name} × {ratio:.1}")
        }
    });
    let told: Vec<String> = told.collect();
    if told.is_empty() { "nothing changes".to_owned() } else { told.join(", ") }
}

/// The budget as a line of Rust.
fn budget(budget: &Budget) -> String {
    let Budget { relative, absolute, steps, .. } = *budget;
    let mut text = "Budget::EXACT".to_owned();
    if relative > 0.0 {
        text += &format!(".with_relative({relative:?})");
    }
    if absolute > 0.0 {
        text += &format!(".with_absolute({absolute:?})");
    }
    if steps != u32::MAX {
        text += &format!(".with_steps({steps})");
    }
    text
}
