//! Queries of the command line, of text files, of raw f32 files and of the standard input, in the
//! order given.

mod text;

use crate::args::{Given, names};
use crate::failure::{Failure, Place};
use meshsweep::number::Short;
use meshsweep_core::QueryError;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

/// The name of the standard input in messages.
const STANDARD_INPUT: &str = "standard input";

/// Queries of `N` finite numbers, and where each came from.
pub struct Queries<const N: usize> {
    /// The queries, in the order given.
    pub rows: Vec<[f32; N]>,
    /// The sources, each with the index of its first row.
    sources: Vec<(usize, Source)>,
    /// The failure of the query after the last one. The queries before it are asked all the same.
    pub broken: Option<Failure>,
}

enum Source {
    /// What was typed, as numbers.
    Argument(String),
    /// A text, with the line of each query.
    Text(PathBuf, Vec<usize>),
    /// A file of f32, and the bytes of a record.
    Raw(PathBuf, usize),
}

impl<const N: usize> Queries<N> {
    /// Reads all queries up to the first broken one.
    ///
    /// # Errors
    /// A file cannot be read, or the first query is broken.
    pub fn read(given: &[Given<N>]) -> Result<Self, Failure> {
        let is_stdin = |path: &Path| path.as_os_str() == "-";
        let from_stdin = |given: &&Given<N>| matches!(given, Given::File(path) if is_stdin(path));
        if given.iter().filter(from_stdin).count() > 1 {
            let what = "-: the standard input can be read only once".to_owned();
            return Err(Failure::Usage { what });
        }
        let mut queries = Queries { rows: Vec::new(), sources: Vec::new(), broken: None };
        for given in given {
            let first = queries.rows.len();
            let name = match given {
                Given::Query(query) => {
                    let text = query.map(|x| Short(x).to_string()).join(",");
                    queries.sources.push((first, Source::Argument(text)));
                    queries.rows.push(*query);
                    continue;
                }
                Given::File(path) if is_stdin(path) => {
                    let mut bytes = Vec::new();
                    let read = std::io::stdin().lock().read_to_end(&mut bytes).map(|_| bytes);
                    queries.text(Path::new(STANDARD_INPUT), read)?;
                    Path::new(STANDARD_INPUT)
                }
                Given::File(path) if path.extension().is_some_and(is_raw) => {
                    queries.raw(path)?;
                    path
                }
                Given::File(path) => {
                    queries.text(path, std::fs::read(path))?;
                    path
                }
            };
            if queries.broken.is_some() {
                break;
            }
            if queries.rows.len() == first {
                // A closed standard error does not withhold the answers.
                let _ = writeln!(std::io::stderr(), "no queries in {}", name.display());
            }
        }
        match queries.broken.take() {
            Some(failure) if queries.rows.is_empty() => Err(failure),
            broken => Ok(Queries { broken, ..queries }),
        }
    }

    fn text(&mut self, file: &Path, bytes: std::io::Result<Vec<u8>>) -> Result<(), Failure> {
        let file = file.to_owned();
        let bytes = bytes.map_err(|error| Failure::ReadQueries {
            file: file.clone(),
            error,
            wanted: names(N),
        })?;
        let text::Rows { rows, lines, broken } = text::parse(&file, &bytes);
        self.sources.push((self.rows.len(), Source::Text(file, lines)));
        self.rows.extend(rows);
        self.broken = broken;
        Ok(())
    }

    fn raw(&mut self, file: &Path) -> Result<(), Failure> {
        let file = file.to_owned();
        let bytes = std::fs::read(&file).map_err(|error| Failure::read(&file, &error))?;
        let (words, rest) = bytes.as_chunks::<4>();
        let numbers: Vec<f32> = words.iter().map(|&word| f32::from_le_bytes(word)).collect();
        let (rows, partial) = numbers.as_chunks::<N>();
        if !(rest.is_empty() && partial.is_empty()) {
            return Err(Failure::RawLength { file, bytes: bytes.len(), record: 4 * N });
        }
        let first = self.rows.len();
        self.sources.push((first, Source::Raw(file, 4 * N)));
        self.rows.extend(rows);
        if let Some(index) = rows.iter().position(|row| !row.iter().all(|x| x.is_finite())) {
            let (place, error) = (self.place(first + index), QueryError::NotFinite);
            self.broken = Some(Failure::Query { place, error });
            self.rows.truncate(first + index);
        }
        Ok(())
    }

    /// Ends the queries before query `index`, which cannot be asked.
    ///
    /// # Errors
    /// `failure`, if no query is left.
    pub fn end_at(&mut self, index: usize, failure: Failure) -> Result<(), Failure> {
        if index == 0 {
            return Err(failure);
        }
        self.rows.truncate(index);
        self.broken = Some(failure);
        Ok(())
    }

    /// Where a query came from.
    pub fn place(&self, index: usize) -> Place {
        let after = self.sources.partition_point(|(first, _)| *first <= index);
        match after.checked_sub(1).and_then(|at| self.sources.get(at)) {
            Some((first, Source::Text(file, lines))) => {
                let line = lines.get(index - first).copied().unwrap_or_default();
                Place::Line { file: file.clone(), line }
            }
            Some((first, Source::Raw(file, bytes))) => {
                let number = index - first;
                Place::Record { file: file.clone(), number, byte: number * bytes }
            }
            Some((_, Source::Argument(text))) => Place::Argument { text: text.clone() },
            None => Place::Argument { text: String::new() },
        }
    }
}

impl<const N: usize> Queries<N> {
    /// Other numbers for each row.
    pub fn map<const M: usize>(self, row: fn([f32; N]) -> [f32; M]) -> Queries<M> {
        let Self { rows, sources, broken } = self;
        Queries { rows: rows.into_iter().map(row).collect(), sources, broken }
    }

    /// The moves from each row to the next one, as `move_of` gives them. A move came from where its
    /// start did.
    ///
    /// # Errors
    /// There is one row alone.
    pub fn moves<const M: usize>(
        self,
        move_of: impl Fn([f32; N], [f32; N]) -> [f32; M],
    ) -> Result<Queries<M>, Failure> {
        let pairs = self.rows.iter().zip(self.rows.iter().skip(1));
        let rows: Vec<[f32; M]> = pairs.map(|(&from, &to)| move_of(from, to)).collect();
        let Self { sources, broken, .. } = self;
        if rows.is_empty() {
            let what = "a path needs two places or more".to_owned();
            return Err(broken.unwrap_or(Failure::Usage { what }));
        }
        Ok(Queries { rows, sources, broken })
    }
}

fn is_raw(extension: &std::ffi::OsStr) -> bool {
    extension.eq_ignore_ascii_case("f32")
}
