//! The committed table: its lines, read and written.

use std::fmt::Write as _;

/// What one number is of. The order of the fields is the order of the table.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Key {
    /// The processor; `any` where the number is the same on all.
    pub cpu: String,
    /// How the code is optimised; `-` where no code is asked.
    pub level: String,
    /// The blob that is asked, or the image whose code is measured.
    pub subject: String,
    /// The kind of queries, or what is measured.
    pub question: String,
}

impl Key {
    /// A key of these words.
    #[must_use]
    pub fn new(cpu: &str, level: &str, subject: &str, question: &str) -> Self {
        let [cpu, level, subject, question] = [cpu, level, subject, question].map(str::to_owned);
        Self { cpu, level, subject, question }
    }

    /// As messages name it.
    #[must_use]
    pub fn name(&self) -> String {
        let Self { cpu, level, subject, question } = self;
        format!("{cpu} {level} {subject} {question}")
    }

    /// Whether both are of one run: the kinds of queries of one image and one blob.
    #[must_use]
    pub fn is_beside(&self, other: &Self) -> bool {
        (&self.cpu, &self.level, &self.subject) == (&other.cpu, &other.level, &other.subject)
    }
}

/// A number that may not rise.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// What it is of.
    pub key: Key,
    /// Queries whose mean it is; 0 for bytes.
    pub queries: u32,
    /// Instructions or bytes.
    pub value: f64,
    /// Half of the step that a mean cannot resolve: a board's counter ticks.
    pub resolution: f64,
}

/// The table as it is committed.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// The compiler that its code was made by.
    pub compiler: String,
    /// Its lines.
    pub entries: Vec<Entry>,
}

/// What a reader has to know, before the compiler's line.
const HEAD: &str = "\
# What a query costs: mean instructions. What code and blobs take: bytes.
# `cargo xtask tables` writes this file. `cargo xtask test` fails if a number rises by more than 1 %.
# `cargo xtask count --all` prints all numbers beside these.
";
const COMPILER: &str = "# compiler: ";

impl Table {
    /// The file's text.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = format!("{HEAD}{COMPILER}{}\n", self.compiler);
        let line = |text: &mut String,
                    [cpu, level, subject, question, queries, value]: [&str; 6]| {
            let _ = writeln!(
                text,
                "{cpu:<11} {level:<2} {subject:<20} {question:<19} {queries:>7} {value:>9}"
            );
        };
        line(&mut text, ["# processor", "", "blob or image", "question", "queries", "value"]);
        let mut entries: Vec<&Entry> = self.entries.iter().collect();
        entries.sort_by(|a, b| a.key.cmp(&b.key));
        for Entry { key: Key { cpu, level, subject, question }, queries, value, .. } in entries {
            let digits = usize::from(*queries > 0 && *value < 1000.0);
            let (queries, value) = (queries.to_string(), format!("{value:.digits$}"));
            line(&mut text, [cpu, level, subject, question, &queries, &value]);
        }
        text
    }

    /// Reads what [`text`](Self::text) wrote.
    ///
    /// # Errors
    /// A line that is none.
    pub fn parse(text: &str) -> Result<Self, String> {
        let compiler = text.lines().find_map(|line| line.strip_prefix(COMPILER));
        let compiler = compiler.ok_or("no line names the compiler")?.to_owned();
        let entries = text.lines().filter(|line| !line.starts_with('#')).map(|line| {
            let entry = || {
                let words: Vec<&str> = line.split_whitespace().collect();
                let [cpu, level, subject, question, queries, value] = *words else { return None };
                let (queries, value) = (queries.parse().ok()?, value.parse().ok()?);
                let key = Key::new(cpu, level, subject, question);
                Some(Entry { key, queries, value, resolution: 0.0 })
            };
            entry().ok_or_else(|| format!("no number: `{line}`"))
        });
        Ok(Self { compiler, entries: entries.collect::<Result<_, _>>()? })
    }
}
