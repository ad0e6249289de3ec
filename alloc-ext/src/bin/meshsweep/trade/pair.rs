//! `meshsweep trade` of two meshes: which structures tell that the second one, moved by poses,
//! keeps a distance from the first, and what they cost.

use super::quoted;
use super::table::{of_boards, write_line};
use crate::args::{MovedArgs, TradeArgs};
use crate::failure::Failure;
use crate::output::Output;
use crate::progress::SharedBar;
use crate::{mesh_file, poses};
use meshsweep::counted::Counted;
use meshsweep::mesh::Unit;
use meshsweep::number::About;
use meshsweep::trade::{
    CYCLES, Instructions, NotBuilt, PairError, PairRow, PairTrade, measure_pair,
};
use serde_json::{Value, json};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Headings of the columns after the structure, each with its width.
const COLUMNS: [(&str, usize); 10] = [
    ("mean", 9),
    ("at most", 9),
    ("us", 9),
    ("clear", 7),
    ("alarms", 7),
    ("undecided", 9),
    ("missed", 7),
    ("flash a", 8),
    ("flash b", 8),
    ("scratch", 7),
];

/// What was measured, and of what.
struct Measured<'a> {
    args: &'a TradeArgs,
    other: &'a Path,
    /// In the meshes' unit.
    keep: f32,
    unit: Option<Unit>,
    poses: usize,
    trade: PairTrade,
}

pub fn run(
    args: &TradeArgs,
    other: &Path,
    (keep, keep_unit): (f64, Option<Unit>),
) -> Result<(), Failure> {
    let files = [args.mesh.as_path(), other];
    mesh_file::check_format(&files, &args.read)?;
    args.threads.start();
    let sources = [mesh_file::read(files[0], &args.read)?, mesh_file::read(files[1], &args.read)?];
    let repair = |which: usize| {
        sources[which].repaired().map_err(|error| Failure::build(files[which], error))
    };
    let loaded = [repair(0)?, repair(1)?];
    mesh_file::refuse_units([(files[0], loaded[0].unit), (files[1], loaded[1].unit)])?;
    // Meshes that name no unit are in that of the distance.
    let unit = loaded[0].unit.or(loaded[1].unit).or(keep_unit);
    let keep = match (unit, keep_unit) {
        (Some(unit), Some(of)) => unit.of(keep, of),
        _ => keep,
    } as f32;
    for (file, loaded) in files.iter().zip(&loaded) {
        if let (None, Some(unit)) = (loaded.unit, unit) {
            // A closed standard error does not withhold the answers.
            let _ = writeln!(io::stderr(), "{} names no unit; taken as {unit}", file.display());
        }
    }
    let mut queries = poses::read(&MovedArgs {
        first: args.mesh.clone(),
        second: other.to_owned(),
        pose: args.poses.clone(),
        matrix: Vec::new(),
    })?;
    if let Some(failure) = queries.broken.take() {
        return Err(failure);
    }
    if queries.rows.is_empty() {
        return Err(Failure::Usage { what: "--poses: no pose to ask about".to_owned() });
    }
    let all: Vec<_> = queries.rows.iter().map(|row| poses::of_row(*row)).collect();
    let bar = SharedBar::new("measuring", "structures");
    let progress = |done, of| bar.show(done, of);
    let meshes = [(&sources[0], &loaded[0]), (&sources[1], &loaded[1])];
    let trade = measure_pair(meshes, &all, keep, &progress).map_err(|error| match error {
        PairError::Refused(index, error) => Failure::Query { place: queries.place(index), error },
        PairError::NoTree(which, NotBuilt::Refused(error)) => Failure::build(files[which], error),
        PairError::NoTree(which, reason) => {
            Failure::Usage { what: format!("{}: {reason}", files[which].display()) }
        }
    })?;
    drop(bar);
    let measured = Measured { args, other, keep, unit, poses: all.len(), trade };
    let chosen = args.limits.is_given().then(|| args.limits.limits().choose_pair(&measured.trade));
    // The table tells what can be had, whether the limits are met or not.
    let (chosen, unmet) = match chosen.transpose() {
        Ok(chosen) => (chosen, None),
        Err(unmet) => (None, Some(unmet.to_string())),
    };
    Output::stdout().finish(|out| {
        if args.json {
            let mut json = measured.as_json(chosen);
            json["unmet"] = json!(unmet);
            serde_json::to_writer_pretty(&mut *out, &json)?;
            return writeln!(out);
        }
        measured.write(out)?;
        chosen.map_or(Ok(()), |chosen| measured.write_chosen(out, chosen))
    })?;
    let both = || PathBuf::from(format!("{} and {}", files[0].display(), files[1].display()));
    unmet.map_or(Ok(()), |what| Err(Failure::Limits { file: both(), what }))
}

impl Measured<'_> {
    /// Predicted instructions of a row: mean and most; and the microseconds of the most.
    fn cost(&self, row: &PairRow) -> [Option<f64>; 3] {
        let found = self.found(row);
        let most = found.map(|found| found.at_most());
        let time =
            most.zip(self.args.limits.cpu).map(|(most, cpu)| 1e6 * most * CYCLES / cpu.hertz);
        [found.map(|found| found.mean), most, time]
    }

    /// Whether a column is printed: without a clock there are no times.
    fn shows(&self, column: &str) -> bool {
        column != "us" || self.args.limits.cpu.is_some()
    }

    /// Instructions on the processor that is asked about.
    fn found(&self, row: &PairRow) -> Option<Instructions> {
        self.args.limits.limits().instructions(row.boards)
    }

    /// The structure that meets the limits, how it is built, and what it costs.
    fn write_chosen(
        &self,
        out: &mut dyn Write,
        (first, second): (&PairRow, Option<&PairRow>),
    ) -> io::Result<()> {
        let limits = self.args.limits.limits();
        let costs = |row: &PairRow| {
            let [flash, ram] =
                [row.flash.iter().sum(), limits.ram(row.scratch, row.stack) as usize];
            let most = self.found(row).map(|found| found.at_most());
            let most = most.map(|most| format!(", at most {most:.0} instructions"));
            let PairRow { false_alarms, undecided, .. } = row;
            format!(
                "flash {flash}, RAM {ram}, alarms {false_alarms}, undecided {undecided}{}",
                most.unwrap_or_default()
            )
        };
        writeln!(
            out,
            "\nchosen: {}: fewest alarms, then fewest instructions, of those within the limits",
            first.structure.name()
        )?;
        writeln!(out, "  {}", costs(first))?;
        let unit = self.args.read.unit.map(|unit| format!(" --unit {}", unit.symbol()));
        let unit = unit.unwrap_or_default();
        for (mesh, blob) in [(&*self.args.mesh, "first"), (self.other, "second")] {
            let format = self.args.read.format.filter(|_| mesh == Path::new("-"));
            let format = format.map_or_else(String::new, |format| format!(" --format {format}"));
            let (mesh, structure) = (quoted(mesh.as_os_str()), first.structure);
            writeln!(out, "  meshsweep build {mesh}{format}{unit} -o {blob}.msw {structure}")?;
        }
        match second {
            Some(second) => {
                writeln!(out, "second: {}: {}", second.structure.name(), costs(second))
            }
            None => writeln!(out, "second: nothing else meets them and has less of anything"),
        }
    }

    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let Self { args, other, keep, unit, poses, trade } = self;
        let unit = unit.map_or_else(String::new, |unit| format!(" {unit}"));
        writeln!(
            out,
            "{} and {}: {}, of which {} keep {}{unit}",
            args.mesh.display(),
            other.display(),
            Counted(*poses, "pose"),
            trade.clear,
            About(f64::from(*keep)),
        )?;
        let width = trade.rows.iter().map(|row| row.structure.name().len()).max().unwrap_or(0);
        let name = format!("{:<width$}", "structure");
        let columns: Vec<_> = COLUMNS.into_iter().filter(|&(name, _)| self.shows(name)).collect();
        let headings: Vec<&str> = columns.iter().map(|&(name, _)| name).collect();
        write_line(out, &name, &columns, &headings)?;
        for row in &trade.rows {
            let count = |x: Option<f64>| x.map_or("-".to_owned(), |x| format!("{x:.0}"));
            let [mean, most, time] = self.cost(row).map(count);
            let counts = [row.clear, row.false_alarms, row.undecided, row.missed];
            let [clear, alarms, undecided, missed] = counts.map(|count| count.to_string());
            let bytes = [row.flash[0], row.flash[1], row.scratch].map(|bytes| bytes.to_string());
            let [first, second, scratch] = bytes;
            let cells =
                [mean, most, time, clear, alarms, undecided, missed, first, second, scratch];
            let shown = COLUMNS.iter().zip(cells).filter(|((name, _), _)| self.shows(name));
            let cells: Vec<String> = shown.map(|(_, cell)| cell).collect();
            let name = format!("{:<width$}", row.structure.name());
            write_line(out, &name, &columns, &cells)?;
        }
        for (structure, reason) in &trade.missing {
            let reason = reason.to_string();
            let reason: Vec<&str> = reason.lines().map(str::trim).collect();
            writeln!(out, "not built: {}: {}", structure.name(), reason.join("; "))?;
        }
        writeln!(
            out,
            "\nmean, at most: instructions of a {}, predicted; at most is of the costliest pose, \
             times the\nfit's greatest ratio. clear: poses proved to keep the distance. alarms: \
             poses that keep it and are\nnot proved to. undecided: neither clear nor proved \
             nearer. missed: \
             poses that are clear of the hull's\nsurface and not of the mesh. flash: bytes of the \
             blobs. scratch: bytes.{}\n\
             error of a predicted mean, over the meshes that it was fitted to and tested with",
            self.args.limits.limits().board().name(),
            match self.args.limits.cpu {
                Some(_) =>
                    format!("\nus: microseconds of at most, {CYCLES} cycles an instruction."),
                None => String::new(),
            },
        )?;
        let mut said: Vec<String> = Vec::new();
        for row in &trade.rows {
            let (Some(search), Some(found)) = (row.structure.search(), self.found(row)) else {
                continue;
            };
            let [error, typical] = [found.error, found.typical].map(|error| 100.0 * error);
            let line = format!("  {}: {error:.0} % (median {typical:.0} %)", search.name());
            if !said.contains(&line) {
                writeln!(out, "{line}")?;
                said.push(line);
            }
        }
        Ok(())
    }

    fn as_json(&self, chosen: Option<(&PairRow, Option<&PairRow>)>) -> Value {
        let Self { keep, unit, poses, trade, .. } = self;
        let name = |row: &PairRow| row.structure.name();
        let chosen = chosen
            .map(|(first, second)| json!({ "first": name(first), "second": second.map(name) }));
        let of = |row: &PairRow| {
            let [mean, most, microseconds] = self.cost(row);
            json!({
                "structure": row.structure.name(),
                "build": row.structure.to_string(),
                "instructions": of_boards(row.boards, row.stack),
                "mean": mean,
                "at_most": most,
                "microseconds": microseconds,
                "clear": row.clear,
                "false_alarms": row.false_alarms,
                "undecided": row.undecided,
                "missed": row.missed,
                "flash": row.flash,
                "scratch_bytes": row.scratch,
                "stack": row.stack,
            })
        };
        let missing = trade.missing.iter().map(|(structure, reason)| {
            json!({ "structure": structure.name(), "reason": reason.to_string() })
        });
        json!({
            "poses": poses,
            "clear": trade.clear,
            "keep": keep,
            "unit": unit.map(Unit::symbol),
            "cpu": self.args.limits.limits().board().name(),
            "rows": trade.rows.iter().map(of).collect::<Vec<_>>(),
            "not_built": missing.collect::<Vec<_>>(),
            "chosen": chosen,
        })
    }
}
