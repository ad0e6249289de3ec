//! No number rises unnoticed: instructions of all questions on all boards and on this machine, code
//! and blobs in bytes, beside a committed table.
//!
//! ```text
//! cost (boards) ──────────┐
//! count_suite (this machine) ─ measured ─ compare ─ table (host-tests/costs.txt)
//! fixtures (bytes) ───────┘
//! ```
//! The readings are those that `cargo xtask test` makes anyway. It asks some boards fewer queries
//! than `cargo xtask firmware`. So each line tells of how many queries it is the mean, and longer
//! readings are cut to their first queries.

mod compare;
mod table;

use std::fs;
use std::path::PathBuf;

use crate::boards::BOARDS;
use crate::cost::{Added, Measured, Row};
use crate::count_suite::{self, Counted};
use crate::cross;
use crate::firmware::Scope;
use crate::images::Profile;
use crate::steps::Steps;
use crate::table::{fixed, row};
use crate::tables;
use crate::tools::Tools;
use crate::workspace;

use compare::compare;
use table::{Entry, Key, Table};

/// What is the same on all processors.
const ANY: &str = "any";

/// The numbers of one run.
pub struct Costs {
    /// The compiler of this machine, and that of the images if it is another.
    compiler: String,
    entries: Vec<Entry>,
    /// Processors of which all was measured.
    whole: Vec<&'static str>,
    /// The kinds of queries that were measured, if not all.
    kinds: Option<Vec<String>>,
}

impl Costs {
    /// The numbers of the boards, and of this machine if it was counted.
    ///
    /// # Errors
    /// A fixture that cannot be read.
    pub fn of(
        tools: Option<&Tools>,
        rows: &[Row],
        scope: Scope,
        here: &[Counted],
    ) -> Result<Self, String> {
        let mut compiler = cross::own_version()?;
        let of_images =
            tools.map_or_else(|| Ok(compiler.clone()), |tools| tools.cross().version())?;
        if of_images != compiler {
            compiler += &format!(", images by {of_images}");
        }
        let mut entries = Vec::new();
        for row in rows {
            for measured in &row.readings {
                instructions(row, measured, &mut entries);
            }
            for Added { question, profile, size } in &row.added {
                let image = format!("size_{question}");
                let bytes = |kind: &str, count: u64| Entry {
                    key: Key::new(row.board.cpu, level(*profile), &image, kind),
                    queries: 0,
                    value: count as f64,
                    resolution: 0.0,
                };
                entries.push(bytes("bytes_of_code", size.text + size.rodata));
            }
        }
        for Counted { blob, kind, queries, mean } in here {
            entries.push(Entry {
                key: Key::new(count_suite::CPU, level(Profile::Release), blob.name, kind),
                queries: *queries,
                value: *mean,
                resolution: 0.0,
            });
        }
        let mut whole = Vec::new();
        if !rows.is_empty() {
            blobs(rows, &mut entries)?;
        }
        if rows.len() == BOARDS.len() {
            whole.push(ANY);
        }
        if scope != Scope::Compared {
            whole.extend(rows.iter().map(|row| row.board.cpu));
        }
        if !here.is_empty() {
            whole.push(count_suite::CPU);
        }
        Ok(Self { compiler, entries, whole, kinds: None })
    }

    /// Those of some kinds of queries. What else was not measured is not missed.
    #[must_use]
    pub fn of_kinds(mut self, kinds: &[&str]) -> Self {
        self.entries.retain(|entry| kinds.contains(&entry.key.question.as_str()));
        self.whole.clear();
        self.kinds = Some(kinds.iter().map(|&kind| kind.to_owned()).collect());
        self
    }

    /// Compares them with the committed table.
    pub fn check(&self, steps: &mut Steps) {
        steps.run("no number has risen", || {
            let mut table = Table::parse(&read()?)?;
            let Self { compiler, entries, whole, kinds } = self;
            if let Some(kinds) = kinds {
                table.entries.retain(|entry| kinds.contains(&entry.key.question));
            }
            if table.compiler != *compiler {
                say!("   {compiler}, and the table is by {}: 4 % are let pass", table.compiler);
            }
            let findings = compare(&table, entries, compiler, whole);
            say!("   {} numbers compared", entries.len());
            if findings.unmeasured > 0 {
                say!("   {} more are measured by `cargo xtask count --all`", findings.unmeasured);
            }
            for line in &findings.fallen {
                say!("   fallen: {line}");
            }
            if findings.wrong.is_empty() {
                return Ok(());
            }
            Err(format!(
                "{}\nremedy: less work, or `cargo xtask tables` and a reason in the commit",
                findings.wrong.join("\n")
            ))
        });
    }

    /// Writes the table anew. Lines of processors that were not measured stay.
    ///
    /// # Errors
    /// A file that cannot be read or written.
    pub fn write(&self) -> Result<(), String> {
        let Self { compiler, entries, whole, .. } = self;
        let mut entries = entries.clone();
        let kept = |entry: &Entry| {
            let is_measured = self.entries.iter().any(|measured| measured.key == entry.key);
            !is_measured && !whole.contains(&entry.key.cpu.as_str())
        };
        if let Ok(text) = read() {
            entries.extend(Table::parse(&text)?.entries.into_iter().filter(kept));
        }
        let table = Table { compiler: compiler.clone(), entries };
        fs::write(file(), table.text()).map_err(|error| format!("{}: {error}", file().display()))
    }

    /// All numbers beside those of the table, if there is one.
    #[must_use]
    pub fn text(&self) -> String {
        let committed = read().and_then(|text| Table::parse(&text)).map(|table| table.entries);
        let committed = committed.unwrap_or_default();
        let columns =
            ["processor", "level", "of", "question", "queries", "value", "committed", "change, %"];
        let title = "Instructions a query in mean, and bytes";
        let mut printed = crate::table::Table::new("costs", title, &columns);
        for Entry { key, queries, value, .. } in &self.entries {
            let before = committed.iter().find(|entry| entry.key == *key);
            let before = before.map(|before| before.value);
            let Key { cpu, level, subject, question } = key.clone();
            printed.push(row![
                cpu,
                level,
                subject,
                question,
                *queries,
                fixed(*value, 1),
                before.map(|before| fixed(before, 1)),
                before.map(|before| fixed(100.0 * (value / before - 1.0), 1)),
            ]);
        }
        printed.text()
    }
}

/// The means of one image about one blob: of as many queries as `cargo xtask test` asks.
fn instructions(row: &Row, measured: &Measured, entries: &mut Vec<Entry>) {
    let Measured { blob, profile, reading } = measured;
    let blocks = Scope::Compared.blocks(&row.board, *blob);
    for cost in &reading.costs {
        let blocks = if tables::has(&cost.kind) { blocks.tabled } else { blocks.others };
        let Some((queries, value)) = reading.mean_of_first(cost, blocks) else { continue };
        entries.push(Entry {
            key: Key::new(row.board.cpu, level(*profile), blob.name, &cost.kind),
            queries,
            value,
            // A query's ticks are off by less than one, at random.
            resolution: row.board.instructions_per_tick / f64::from(queries).sqrt(),
        });
    }
}

/// The bytes of the committed blobs and of those that the boards were asked about.
fn blobs(rows: &[Row], entries: &mut Vec<Entry>) -> Result<(), String> {
    let mut all: Vec<(String, u64)> = Vec::new();
    for measured in rows.iter().flat_map(|row| &row.readings) {
        all.push((measured.blob.name.to_owned(), measured.reading.bytes()?));
    }
    let folder = workspace::root().join("fixtures");
    let failed = |error: std::io::Error| format!("{}: {error}", folder.display());
    for entry in fs::read_dir(&folder).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        let name = entry.file_name().to_string_lossy().into_owned();
        if name.ends_with(".msw") {
            all.push((format!("fixtures/{name}"), entry.metadata().map_err(failed)?.len()));
        }
    }
    all.sort();
    all.dedup();
    entries.extend(all.into_iter().map(|(name, bytes)| Entry {
        key: Key::new(ANY, "-", &name, "bytes"),
        queries: 0,
        value: bytes as f64,
        resolution: 0.0,
    }));
    Ok(())
}

/// The optimisation, as the tables name it.
const fn level(profile: Profile) -> &'static str {
    match profile {
        Profile::Release => "3",
        Profile::Small => "s",
        Profile::Overridden | Profile::Unoptimised => "debug",
    }
}

fn file() -> PathBuf {
    workspace::root().join("host-tests/costs.txt")
}

fn read() -> Result<String, String> {
    fs::read_to_string(file()).map_err(|error| format!("{}: {error}", file().display()))
}
