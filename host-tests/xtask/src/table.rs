//! Tables whose cells are printed.

use std::fmt::Write as _;

/// One cell.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// Not known, or not asked.
    Empty,
    /// Words.
    Text(String),
    /// An exact count.
    Count(u64),
    /// A number and the digits after its point.
    Fixed(f64, usize),
    /// A number of any magnitude, two digits.
    Scientific(f64),
}

impl Cell {
    /// As it is printed.
    pub fn text(&self) -> String {
        match self {
            Self::Empty => "-".to_owned(),
            Self::Text(text) => text.clone(),
            Self::Count(count) => count.to_string(),
            Self::Fixed(value, digits) => format!("{value:.digits$}"),
            Self::Scientific(0.0) => "0".to_owned(),
            Self::Scientific(value) => format!("{value:.1e}"),
        }
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl From<u32> for Cell {
    fn from(count: u32) -> Self {
        Self::Count(u64::from(count))
    }
}

impl From<u64> for Cell {
    fn from(count: u64) -> Self {
        Self::Count(count)
    }
}

impl From<usize> for Cell {
    fn from(count: usize) -> Self {
        Self::Count(count as u64)
    }
}

impl<T: Into<Cell>> From<Option<T>> for Cell {
    fn from(cell: Option<T>) -> Self {
        cell.map_or(Self::Empty, Into::into)
    }
}

/// A number with `digits` after its point.
#[must_use]
pub fn fixed(value: f64, digits: usize) -> Cell {
    Cell::Fixed(value, digits)
}

/// A number of any magnitude.
#[must_use]
pub fn scientific(value: f64) -> Cell {
    Cell::Scientific(value)
}

/// A row of cells from values that are convertible to them.
#[macro_export]
macro_rules! row {
    ($($value:expr),* $(,)?) => { vec![$($crate::table::Cell::from($value)),*] };
}
pub use crate::row;

/// A table.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Its name in JSON.
    pub key: &'static str,
    /// Its heading.
    pub title: String,
    /// Headings of the columns, each another: they are the keys of a row in JSON.
    pub columns: Vec<&'static str>,
    /// Rows, each as long as `columns`.
    pub rows: Vec<Vec<Cell>>,
    /// What a reader has to know beside the numbers.
    pub notes: Vec<String>,
}

impl Table {
    /// A table without rows.
    #[must_use]
    pub fn new(key: &'static str, title: impl Into<String>, columns: &[&'static str]) -> Self {
        Self {
            key,
            title: title.into(),
            columns: columns.to_vec(),
            rows: Vec::new(),
            notes: Vec::new(),
        }
    }

    /// Adds a row.
    pub fn push(&mut self, row: Vec<Cell>) {
        debug_assert_eq!(row.len(), self.columns.len(), "{}", self.title);
        self.rows.push(row);
    }

    /// Adds a note.
    pub fn note(&mut self, note: impl Into<String>) {
        self.notes.push(note.into());
    }

    /// The table for people: columns aligned, numbers to the right.
    #[must_use]
    pub fn text(&self) -> String {
        let texts: Vec<Vec<String>> =
            self.rows.iter().map(|row| row.iter().map(Cell::text).collect()).collect();
        let width = |column: usize| {
            let cells = texts.iter().filter_map(|row| row.get(column));
            let head = self.columns[column].chars().count();
            cells.map(|text| text.chars().count()).fold(head, usize::max)
        };
        let widths: Vec<usize> = (0..self.columns.len()).map(width).collect();
        let is_text = |column: usize| {
            self.rows.iter().any(|row| matches!(row.get(column), Some(Cell::Text(_))))
        };
        let mut out = format!("\n{}\n", self.title);
        let mut line = |cells: &mut dyn Iterator<Item = &str>| {
            let mut text = String::new();
            for (column, cell) in cells.enumerate() {
                let width = widths[column];
                let _ = if is_text(column) {
                    write!(text, "  {cell:<width$}")
                } else {
                    write!(text, "  {cell:>width$}")
                };
            }
            out.push_str(text.trim_end());
            out.push('\n');
        };
        line(&mut self.columns.iter().copied());
        for row in &texts {
            line(&mut row.iter().map(String::as_str));
        }
        for note in &self.notes {
            let _ = writeln!(out, "  ({note})");
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::{Cell, Table, fixed, scientific};

    #[test]
    fn text_is_aligned() {
        let mut table = Table::new("t", "Title", &["what", "count", "share"]);
        table.push(row!["one", 1u32, fixed(0.5, 2)]);
        table.push(row!["eleven", 11usize, Cell::Empty]);
        table.note("a note");
        assert_eq!(
            table.text(),
            "\nTitle\n  what    count  share\n  one         1   0.50\n  eleven     11      -\n  (a note)\n"
        );
        assert_eq!(scientific(0.00012).text(), "1.2e-4");
    }
}
