//! `meshsweep build` with limits: the setting that meets them is chosen by measurement.

use super::measured::{Measured, measured};
use super::table::MANY_NEEDLES;
use crate::args::{At, BuildArgs, Cpu, LimitArgs};
use crate::failure::Failure;
use crate::output::Output;
use crate::{describe, source};
use meshsweep::builder::Recipe;
use meshsweep::number::{About, AtMost};
use meshsweep::trade::{Board, How, Instructions, Points, Row};
use meshsweep_core::{Blob, Budget};
use std::io::{self, Write};

/// Points that are measured.
const POINTS: usize = 1000;

/// Cycles of an instruction that a rate is planned with. Most take one, loads two, a jump that is
/// taken two to four, a division fourteen, and flash may add waits: twice leaves room.
const CYCLES: f64 = 2.0;

/// Builds the blob of the setting that meets the limits.
pub fn build(args: &BuildArgs) -> Result<(), Failure> {
    let limits = &args.limits;
    let at = limits.at.clone().unwrap_or(At::Made(Points::Near));
    let (loaded, measured) = measured(&args.mesh, args.unit, &at, POINTS)?;
    if limits.rate.is_some() && measured.trade.needles >= MANY_NEEDLES {
        let what = format!(
            "{:.0} % of the triangles are needles, whose instructions are not predicted; leave \
             --rate out, and count them",
            100.0 * measured.trade.needles
        );
        return Err(Failure::Limits { file: args.mesh.clone(), what });
    }
    let rows: Vec<&Row> =
        measured.trade.rows.iter().filter(|row| row.guaranteed.is_some()).collect();
    let Some((chosen, second)) = best_two(limits, &rows) else {
        let what = refusal(limits, &rows);
        return Err(Failure::Limits { file: args.mesh.clone(), what });
    };
    let bytes = measured.trade.blob(chosen.setting.recipe).unwrap_or_default();
    let blob = Blob::open(bytes).map_err(|error| Failure::open(&args.output, error))?;
    source::write(args, &blob)?;
    Output::stdout().finish(|out| {
        writeln!(out, "{}", args.mesh.display())?;
        writeln!(out, "  {}", loaded.report)?;
        loaded.unit_note().map_or(Ok(()), |note| writeln!(out, "  {note}"))?;
        write_choice(out, limits, &measured, chosen, second)?;
        writeln!(out, "{}", args.output.display())?;
        source::report(args, out)?;
        describe::write_blob(out, &blob)
    })
}

/// Values of a row that are limited, each with its limit: flash, RAM, error, cycles of a query.
fn limited(limits: &LimitArgs, row: &Row) -> [(&'static str, f64, Option<f64>); 4] {
    let board = board(limits);
    let on_board = instructions(row, board);
    let stack = on_board.map_or(0.0, |found| f64::from(found.stack));
    // A cost that was not fitted meets no rate.
    let cycles = on_board.map_or(f64::INFINITY, |found| dearest(found) * CYCLES);
    let cycles_there = limits.rate.zip(limits.cpu).map(|(rate, cpu)| cpu.hertz / rate);
    [
        ("--flash", row.flash as f64, limits.flash.map(|bytes| bytes as f64)),
        ("--ram", row.scratch as f64 + stack, limits.ram.map(|bytes| bytes as f64)),
        ("--error", error(row), limits.error),
        ("--rate", cycles, cycles_there),
    ]
}

/// Instructions of the dearest query, with what the fit missed at most.
fn dearest(found: Instructions) -> f64 {
    found.worst * found.dearest
}

fn board(limits: &LimitArgs) -> Board {
    limits.cpu.map_or(Board::CortexM4F, |cpu: Cpu| cpu.board)
}

fn instructions(row: &Row, board: Board) -> Option<Instructions> {
    Board::ALL.iter().zip(row.boards).find(|(of, _)| **of == board)?.1
}

fn error(row: &Row) -> f64 {
    row.guaranteed.map_or(f64::INFINITY, |spread| spread.worst)
}

/// How many times its limit the value is that exceeds it most; at most 1 if all limits are met.
fn excess(limits: &LimitArgs, row: &Row) -> f64 {
    let all = limited(limits, row);
    all.iter().filter_map(|(_, value, limit)| Some(value / (*limit)?)).fold(0.0, f64::max)
}

/// The order in which settings are preferred: with a limit of the error the fewest instructions,
/// else the smallest error.
fn order(limits: &LimitArgs, row: &Row) -> [f64; 3] {
    let mean = instructions(row, board(limits)).map_or(f64::INFINITY, |found| found.mean);
    if limits.error.is_some() {
        [mean, error(row), row.flash as f64]
    } else {
        [error(row), mean, row.flash as f64]
    }
}

/// The best setting that meets all limits, and the one that is best without it.
fn best_two<'r>(limits: &LimitArgs, rows: &[&'r Row]) -> Option<(&'r Row, Option<&'r Row>)> {
    let mut meeting: Vec<&Row> =
        rows.iter().copied().filter(|row| excess(limits, row) <= 1.0).collect();
    meeting.sort_by(|a, b| {
        let pairs = order(limits, a).into_iter().zip(order(limits, b));
        pairs
            .map(|(a, b)| a.total_cmp(&b))
            .find(|order| order.is_ne())
            .unwrap_or(std::cmp::Ordering::Equal)
    });
    Some((*meeting.first()?, meeting.get(1).copied()))
}

/// Which setting comes nearest to the limits, and what it needs.
fn refusal(limits: &LimitArgs, rows: &[&Row]) -> String {
    let nearest = rows.iter().min_by(|a, b| excess(limits, a).total_cmp(&excess(limits, b)));
    let Some(nearest) = nearest else { return "no structure gives intervals".to_owned() };
    let beyond = limited(limits, nearest).into_iter().filter_map(|(option, value, limit)| {
        let limit = limit.filter(|&limit| value > limit)?;
        Some(match (option, limits.cpu) {
            ("--rate", Some(cpu)) if cpu.hertz >= value => {
                format!("--rate {}Hz", (cpu.hertz / value).floor())
            }
            ("--rate", _) => format!("{value:.0} cycles"),
            ("--error", _) => format!("--error {}", AtMost(value)),
            _ => format!("{option} {value:.0} instead of {limit:.0}"),
        })
    });
    let beyond: Vec<String> = beyond.collect();
    format!(
        "no setting meets these limits; the nearest is {}, which needs {}",
        nearest.setting,
        beyond.join(" and ")
    )
}

fn write_choice(
    out: &mut dyn Write,
    limits: &LimitArgs,
    measured: &Measured,
    chosen: &Row,
    second: Option<&Row>,
) -> io::Result<()> {
    let why = match limits.error {
        Some(_) => "fewest instructions of those that meet all limits",
        None => "smallest error of those that meet all limits",
    };
    writeln!(out, "chosen: {}", chosen.setting)?;
    writeln!(out, "  why: {why}, at {} points {}", measured.points, measured.kind)?;
    write_costs(out, limits, chosen)?;
    writeln!(out, "  built: {}", chosen.setting.recipe)?;
    let by = match (chosen.setting.how, chosen.setting.recipe) {
        (How::Fresh, _) => "",
        (How::Hinted, _) => ", from the hint of the last query",
        (How::Coherent, Recipe::Tree(_)) => ", by a CoherentQuery::<128>",
        (How::Coherent, _) => ", by a kept Sweep",
        (How::Precise, _) => ", by closest_point_precise",
    };
    let budget = budget(&chosen.setting.budget);
    let kept = if chosen.setting.how == How::Coherent { ", the memory kept among it" } else { "" };
    let scratch = chosen.scratch;
    writeln!(out, "  ask with: {budget}{by}, and {scratch} bytes of scratch{kept}")?;
    if let Some(percent) = instructions(chosen, board(limits)).map(|found| 100.0 * found.error) {
        writeln!(
            out,
            "  predicted: a mean query of the fit's meshes and tests within {percent:.0} %; \
             {CYCLES} cycles an instruction"
        )?;
    }
    writeln!(
        out,
        "  the error is the largest of these points; elsewhere an interval may be wider, and holds"
    )?;
    match second {
        Some(second) => {
            writeln!(out, "second: {}", second.setting)?;
            write_costs(out, limits, second)?;
            writeln!(out, "  instead of the first: {}", gain(limits, chosen, second))
        }
        None => writeln!(out, "second: nothing else meets them"),
    }
}

fn write_costs(out: &mut dyn Write, limits: &LimitArgs, row: &Row) -> io::Result<()> {
    let board = board(limits);
    let [(_, flash, _), (_, ram, _), (_, error, _), _] = limited(limits, row);
    write!(out, "  flash {flash:.0}, RAM {ram:.0}, error {}", AtMost(error))?;
    if let Some(found) = instructions(row, board) {
        write!(
            out,
            ", {:.0} instructions of a {}, at worst {:.0}",
            found.mean,
            board.name(),
            dearest(found)
        )?;
    }
    if let (Some(cpu), Some(found)) = (limits.cpu, instructions(row, board)) {
        let microseconds = 1e6 * dearest(found) * CYCLES / cpu.hertz;
        write!(out, ": {} us", About((10.0 * microseconds).round() / 10.0))?;
    }
    writeln!(out)
}

/// What the second setting has more or less of.
fn gain(limits: &LimitArgs, first: &Row, second: &Row) -> String {
    let board = board(limits);
    let mean = |row: &Row| instructions(row, board).map_or(0.0, |found| found.mean);
    let values = [
        ("flash", first.flash as f64, second.flash as f64),
        ("scratch", first.scratch as f64, second.scratch as f64),
        ("error", error(first), error(second)),
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
