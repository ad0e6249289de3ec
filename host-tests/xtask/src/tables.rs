//! Tables of the documents, between `<!-- table: NAME -->` and `<!-- end -->`: written by
//! `cargo xtask tables`, compared by `cargo xtask test`.
//!
//! Only numbers that repeat are here: bytes and instructions. Bytes have to be equal. Instructions,
//! code sizes and stacks depend on the compiler too, and a tick of the Cortex-M33's counter is 50
//! instructions. So they may differ by 4 %.

use std::fs;
use std::mem;
use std::path::{Path, PathBuf};

use crate::blobs::Blob;
use crate::cost::Row;
use crate::count::Counts;
use crate::firmware;
use crate::images::Profile;
use crate::kind::Kind;
use crate::questions::{QUESTIONS, Question, SIZES};
use crate::stack::{self, Stack};
use crate::stack_csv;
use crate::steps::Steps;
use crate::workspace;

/// Documents with such tables.
const DOCUMENTS: [&str; 5] = [
    "README.md",
    "core/DESIGN.md",
    "core/docs/guide.md",
    "core/docs/measured.md",
    "host-tests/README.md",
];

/// Kinds of queries to a structure that a table has of each board.
fn tabled(subject: &str) -> Vec<&'static str> {
    let asks = |of: &&Question| of.subject() == subject;
    let is_asked = |kind| QUESTIONS.iter().filter(asks).any(|of| of.kinds.contains(&kind));
    let tabled = Kind::ALL.into_iter().filter(|kind| kind.is_tabled() && is_asked(*kind));
    tabled.map(Kind::name).collect()
}

/// Whether a table has the instructions of such queries on the boards: the suite asks more of them.
#[must_use]
pub fn has(kind: &str) -> bool {
    Kind::ALL.into_iter().any(|of| of.is_tabled() && of.name() == kind)
}

/// Part by which a count may differ from the written one.
const TOLERANCE: f64 = 0.04;

/// Part by which a debug build's stack may differ: 7 % were seen between two folders.
const DEBUG_TOLERANCE: f64 = 0.15;

/// Everything that tables are made of.
pub struct Facts<'a> {
    /// Instructions on this machine.
    pub counts: Option<&'a Counts<'static>>,
    /// The boards' rows; none if there are no boards.
    pub rows: &'a [Row],
}

/// A cell, and how its numbers are compared.
struct Cell {
    text: String,
    rule: Rule,
}

/// How a cell is compared with the written one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Rule {
    /// Equal.
    Exact,
    /// Each number is near the written one. An unknown number is not compared.
    Near,
    /// The same of the most that was seen, and of a bound; but fewer queries see less.
    Stack,
    /// A bound of a debug build. The compiler inlines otherwise in another folder, so it may differ
    /// by [`DEBUG_TOLERANCE`]. The limit that the guide promises is checked apart from this.
    Debug,
}

/// A number that is not known.
const UNKNOWN: &str = "–";

fn words(text: impl Into<String>) -> Cell {
    Cell { text: text.into(), rule: Rule::Exact }
}

fn bytes(count: u64) -> Cell {
    words(thousands(count))
}

fn about(counts: &[f64]) -> Cell {
    let texts: Vec<String> = counts.iter().map(|count| thousands(count.round() as u64)).collect();
    near(texts.join(" / "))
}

fn debug_cell(of: Stack) -> Cell {
    let text = of.bound.map_or_else(|| UNKNOWN.to_owned(), |bound| thousands(bound.into()));
    Cell { text, rule: Rule::Debug }
}

fn near(text: impl Into<String>) -> Cell {
    Cell { text: text.into(), rule: Rule::Near }
}

fn stack_cell(Stack { painted, bound }: Stack) -> Cell {
    let text = |bytes: Option<u32>| {
        bytes.map_or_else(|| UNKNOWN.to_owned(), |bytes| thousands(bytes.into()))
    };
    Cell { text: format!("{} / {}", text(painted), text(bound)), rule: Rule::Stack }
}

/// `1234567` as `1,234,567`.
fn thousands(count: u64) -> String {
    let digits = count.to_string();
    let first = (digits.len() - 1) % 3 + 1;
    let mut text = digits[..first].to_owned();
    for group in digits.as_bytes()[first..].chunks(3) {
        text.push(',');
        text.extend(group.iter().map(|digit| char::from(*digit)));
    }
    text
}

/// The table of a name: heading and rows. `None` where the facts for it are missing.
fn table(name: &str, facts: &Facts<'_>) -> Result<Option<Vec<Vec<Cell>>>, String> {
    let columns = |names: &[&str]| names.iter().map(|name| words(*name)).collect::<Vec<Cell>>();
    let mut lines = Vec::new();
    match name {
        "structures" => {
            let Some(counts) = facts.counts else { return Ok(None) };
            lines.push(columns(&[
                "structure",
                "bytes of the blob",
                "scratch, bytes",
                "instructions of a closest point, far / near",
                "of a first hit",
            ]));
            for (title, blob, prefix) in [
                ("box tree, `--for closest,segment`", "bracket_tree", "tree bracket.stl "),
                ("hull hierarchy, `--for hull`", "bracket", ""),
            ] {
                let expected = Blob::named(blob)?.expected()?;
                let count = |kind: &str| {
                    let question = format!("{prefix}{kind}");
                    let each = counts.get(question.as_str());
                    each.map(|each| each.instructions).ok_or(format!("no count of `{question}`"))
                };
                lines.push(vec![
                    words(title),
                    bytes(expected.bytes()?),
                    bytes(expected.needs.into()),
                    about(&[count("far")?, count("near")?]),
                    about(&[count("first_hit")?]),
                ]);
            }
        }
        "firmware_bvh" => {
            lines.push(columns(&[
                "box tree",
                "closest, far",
                "closest, near",
                "first hit",
                "closer than d",
                "signed",
                "code of closest point, bytes",
            ]));
            lines.extend(on_boards(facts.rows, 1, &tabled("tree"), firmware::CODE[1])?);
        }
        "firmware_hull" => {
            lines.push(columns(&[
                "hull hierarchy",
                "closest, far",
                "closest, near",
                "first hit",
                "outer hits",
                "code of closest point and opening, bytes",
            ]));
            lines.extend(on_boards(facts.rows, 0, &tabled("hull"), firmware::CODE[0])?);
        }
        "stack" => lines = by_board(facts.rows, &SHIPPED, stacks),
        "stack_c" => lines = by_board(facts.rows, &SHIPPED, c_stacks),
        "stack_debug" => {
            let rows = facts.rows.iter().filter(|row| firmware::DEBUGGED.contains(&row.board.cpu));
            lines = by_board(rows, &DEBUG, stacks);
            // The image asks few questions.
            let is_known = |cell: &Cell| cell.rule == Rule::Debug && cell.text != UNKNOWN;
            let mut is_heading = true;
            lines.retain(|line| mem::take(&mut is_heading) || line.iter().any(is_known));
        }
        "code" => lines = by_board(facts.rows, &SHIPPED, codes),
        _ => return Err(format!("no command writes a table `{name}`")),
    }
    Ok((lines.len() > 1).then_some(lines))
}

/// How shipped firmware is optimised, as tables name it.
const SHIPPED: [(&str, Profile); 2] = [("s", Profile::Small), ("3", Profile::Release)];

/// How debug builds are.
const DEBUG: [(&str, Profile); 2] =
    [("override", Profile::Overridden), ("none", Profile::Unoptimised)];

/// A line for each question, and a column for each board and optimisation.
fn by_board<'a>(
    rows: impl IntoIterator<Item = &'a Row>,
    levels: &[(&str, Profile)],
    cells: impl Fn(&Row, Profile) -> Vec<(&'static str, Cell)>,
) -> Vec<Vec<Cell>> {
    let mut lines: Vec<Vec<Cell>> = Vec::new();
    for row in rows {
        for (level, profile) in levels {
            let mut column = vec![words(format!("{}, {level}", row.board.cpu))];
            let mut names = vec!["question"];
            for (name, cell) in cells(row, *profile) {
                names.push(name);
                column.push(cell);
            }
            if lines.is_empty() {
                lines = names.into_iter().map(|name| vec![words(name)]).collect();
            }
            lines.iter_mut().zip(column).for_each(|(line, cell)| line.push(cell));
        }
    }
    lines
}

/// The stack of each question.
fn stacks(row: &Row, profile: Profile) -> Vec<(&'static str, Cell)> {
    let cell = |(question, of): (&Question, Stack)| {
        let is_debug = Profile::DEBUG.contains(&profile);
        (question.name, if is_debug { debug_cell(of) } else { stack_cell(of) })
    };
    QUESTIONS.iter().zip(row.stacks.of(profile)).map(cell).collect()
}

/// The stack's bound of each function of the C interface.
fn c_stacks(row: &Row, profile: Profile) -> Vec<(&'static str, Cell)> {
    let cell = |(&(name, _), bound): (&(&'static str, &str), Option<u32>)| {
        (name, bound.map_or_else(|| near(UNKNOWN), |bound| about(&[bound.into()])))
    };
    stack::C_FUNCTIONS.iter().zip(row.stacks.of_c(profile)).map(cell).collect()
}

/// The code of each question.
fn codes(row: &Row, profile: Profile) -> Vec<(&'static str, Cell)> {
    let cell = |&(image, name): &(&str, &'static str)| {
        let mut all = row.added.iter();
        let added = all.find(|added| added.question == image && added.profile == profile);
        let code = added.map(|added| (added.size.text + added.size.rodata) as f64);
        (name, code.map_or_else(|| near(UNKNOWN), |code| about(&[code])))
    };
    SIZES.iter().map(cell).collect()
}

/// A line for each board: mean instructions of questions to one of its standard blobs, and the code
/// of one question.
fn on_boards(
    rows: &[Row],
    standard: usize,
    kinds: &[&str],
    code: &str,
) -> Result<Vec<Vec<Cell>>, String> {
    let line = |row: &Row| {
        let blob = Blob::standard(row.board.flash)[standard].name;
        let measured = row.readings.iter().find(|measured| measured.blob.name == blob);
        let measured = measured.ok_or_else(|| format!("{}: no {blob}", row.board.cpu))?;
        let mut line = vec![words(row.board.cpu)];
        for kind in kinds {
            let cost = measured.reading.costs.iter().find(|cost| cost.kind == *kind);
            line.push(about(&[cost.ok_or_else(|| format!("{blob}: no {kind}"))?.mean]));
        }
        let added = row
            .added
            .iter()
            .find(|added| added.question == code && added.profile == Profile::Release);
        let size = added.ok_or_else(|| format!("{}: no size of {code}", row.board.cpu))?.size;
        line.push(about(&[(size.text + size.rodata) as f64]));
        Ok(line)
    };
    rows.iter().map(line).collect()
}

/// Writes all tables anew.
///
/// # Errors
/// A document that cannot be written, or a table that no command writes.
pub fn write(facts: &Facts<'_>) -> Result<(), String> {
    for (path, text) in documents()? {
        let mut out = String::new();
        for part in parts(&text) {
            match part {
                Part::Prose(prose) => out.push_str(prose),
                Part::Table { name, written } => match table(name, facts)? {
                    Some(lines) => out.push_str(&markdown(&lines)),
                    None => {
                        say!("   {}: no facts for table {name}", path.display());
                        out.push_str(written);
                    }
                },
            }
        }
        fs::write(&path, out).map_err(|error| format!("{}: {error}", path.display()))?;
    }
    stack_csv::write(facts.rows)
}

/// Compares all tables with the facts; a table whose facts are missing is passed over.
pub fn check(steps: &mut Steps, facts: &Facts<'_>) {
    steps.run("tables of the documents", || {
        let mut stale = Vec::new();
        for (path, text) in documents()? {
            for part in parts(&text) {
                let Part::Table { name, written } = part else { continue };
                let Some(lines) = table(name, facts)? else {
                    say!("   table {name}: nothing to compare it with");
                    continue;
                };
                if let Err(reason) = compare(written, &lines) {
                    let file = path.display();
                    stale.push(format!("{file}: table {name}: {reason}\n{}", markdown(&lines)));
                }
            }
        }
        stale.extend(stack_csv::check(facts.rows).err());
        if stale.is_empty() {
            return Ok(());
        }
        Err(format!("{}\nremedy: `cargo xtask tables`", stale.join("\n")))
    });
}

fn documents() -> Result<Vec<(PathBuf, String)>, String> {
    let read = |name: &&str| {
        let path: PathBuf = workspace::root().join(Path::new(name));
        let text = fs::read_to_string(&path);
        text.map(|text| (path, text)).map_err(|error| format!("{name}: {error}"))
    };
    DOCUMENTS.iter().map(read).collect()
}

/// A piece of a document. Markers belong to the prose.
enum Part<'a> {
    Prose(&'a str),
    Table { name: &'a str, written: &'a str },
}

fn parts(text: &str) -> Vec<Part<'_>> {
    const BEGIN: &str = "<!-- table: ";
    const CLOSE: &str = " -->\n";
    const END: &str = "<!-- end -->";
    let mut parts = Vec::new();
    let mut rest = text;
    while let Some((name, table, begun, ended)) = (|| {
        let begin = rest.find(BEGIN)? + BEGIN.len();
        let close = begin + rest[begin..].find(CLOSE)?;
        let begun = close + CLOSE.len();
        let ended = begun + rest[begun..].find(END)?;
        Some((&rest[begin..close], &rest[begun..ended], begun, ended))
    })() {
        parts.push(Part::Prose(&rest[..begun]));
        parts.push(Part::Table { name, written: table });
        rest = &rest[ended..];
    }
    parts.push(Part::Prose(rest));
    parts
}

fn markdown(lines: &[Vec<Cell>]) -> String {
    let mut out = String::new();
    for (index, line) in lines.iter().enumerate() {
        let texts: Vec<&str> = line.iter().map(|cell| cell.text.as_str()).collect();
        out.push_str(&format!("| {} |\n", texts.join(" | ")));
        if index == 0 {
            out.push_str(&format!("|{}\n", " --- |".repeat(line.len())));
        }
    }
    out
}

/// The first difference that counts.
fn compare(written: &str, lines: &[Vec<Cell>]) -> Result<(), String> {
    let rows: Vec<Vec<&str>> = written
        .lines()
        .filter(|line| !line.starts_with("| ---"))
        .map(|line| line.trim().trim_matches('|').split('|').map(str::trim).collect())
        .collect();
    if rows.len() != lines.len() {
        return Err(format!("{} lines, not {}", rows.len(), lines.len()));
    }
    for (row, line) in rows.iter().zip(lines) {
        if row.len() != line.len() {
            return Err(format!("{} columns, not {}", row.len(), line.len()));
        }
        for (there, here) in row.iter().zip(line) {
            let is_same = *there == here.text || is_near(there, &here.text, here.rule);
            if !is_same {
                return Err(format!("`{there}`, now `{}`", here.text));
            }
        }
    }
    Ok(())
}

/// Whether the numbers of two texts differ by no more than the tolerance.
fn is_near(there: &str, here: &str, rule: Rule) -> bool {
    let numbers = |text: &str| -> Vec<Option<f64>> {
        text.split('/').map(|number| number.trim().replace(',', "").parse().ok()).collect()
    };
    let (there, here) = (numbers(there), numbers(here));
    let near = |(index, (there, here)): (usize, (&Option<f64>, &Option<f64>))| match (there, here) {
        (Some(there), Some(here)) => {
            let seen_less = rule == Rule::Stack && index == 0 && here <= there;
            // A bound is the largest of several images, and `test` does not build all of them.
            let fewer_images = rule == Rule::Stack && (0.9 * there..=*there).contains(here);
            let tolerance = if rule == Rule::Debug { DEBUG_TOLERANCE } else { TOLERANCE };
            seen_less || fewer_images || (there - here).abs() <= tolerance * here
        }
        (_, None) => true,
        (None, _) => false,
    };
    rule != Rule::Exact
        && there.len() == here.len()
        && there.iter().zip(&here).enumerate().all(near)
}

#[cfg(test)]
mod tests {
    use super::{
        Part, Stack, about, bytes, compare, debug_cell, markdown, parts, stack_cell, thousands,
        words,
    };

    #[test]
    fn counts_may_drift_and_bytes_may_not() {
        let lines = |count: u64, counts: &[f64]| {
            vec![vec![words("what"), words("bytes")], vec![bytes(count), about(counts)]]
        };
        let written = markdown(&lines(27_524, &[1000.0, 2000.0]));
        assert_eq!(written, "| what | bytes |\n| --- | --- |\n| 27,524 | 1,000 / 2,000 |\n");
        assert_eq!(compare(&written, &lines(27_524, &[1015.0, 1970.0])), Ok(()));
        assert!(compare(&written, &lines(27_524, &[1050.0, 2000.0])).is_err());
        assert!(compare(&written, &lines(27_525, &[1000.0, 2000.0])).is_err());
        assert_eq!([0, 999, 1000, 1_234_567].map(thousands), ["0", "999", "1,000", "1,234,567"]);
    }

    #[test]
    fn less_stack_may_be_seen_and_no_bound_may_drift() {
        let now = |painted: Option<u32>, bound: Option<u32>| {
            let there = vec![vec![stack_cell(Stack { painted: Some(1000), bound: Some(2000) })]];
            compare(&markdown(&there), &[vec![stack_cell(Stack { painted, bound })]])
        };
        assert_eq!(now(Some(600), Some(2010)), Ok(()));
        assert_eq!(now(None, None), Ok(()));
        assert!(now(Some(1100), Some(2000)).is_err());
        assert!(now(Some(1000), Some(2200)).is_err());
        assert!(now(Some(1000), Some(1700)).is_err());
    }

    #[test]
    fn the_stack_of_a_debug_build_may_differ_between_folders() {
        let cell = |bound| vec![vec![debug_cell(Stack { painted: None, bound })]];
        let now = |bound| compare(&markdown(&cell(Some(1688))), &cell(bound));
        assert_eq!([Some(1576), Some(1800), None].map(now), [Ok(()), Ok(()), Ok(())]);
        assert!(now(Some(1400)).is_err() && now(Some(2100)).is_err());
    }

    #[test]
    fn a_document_falls_into_prose_and_tables() {
        let text = "a\n<!-- table: t -->\n| x |\n<!-- end -->\nb\n";
        let parts = parts(text);
        assert!(matches!(parts[1], Part::Table { name: "t", written: "| x |\n" }));
        let whole: String = parts
            .iter()
            .map(|part| match part {
                Part::Prose(text) | Part::Table { written: text, .. } => *text,
            })
            .collect();
        assert_eq!(whole, text);
    }
}
