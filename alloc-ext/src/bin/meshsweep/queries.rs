//! Queries of the command line, of text files, of raw f32 files and of the standard input, in the
//! order given.

use super::args::Given;
use super::csv::{self, Rows, Short};
use super::failure::{Failure, Place};
use meshsweep_core::QueryError;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

/// What messages call the standard input.
const STANDARD_INPUT: &str = "standard input";

/// Queries of `N` finite numbers, and where each came from.
pub struct Queries<const N: usize> {
    /// The queries, in the order given.
    pub rows: Vec<[f32; N]>,
    /// Where they came from, each with its first row.
    origins: Vec<(usize, Origin)>,
    /// What is wrong with the query after the last one. Those before it are asked all the same.
    pub broken: Option<Failure>,
}

enum Origin {
    Argument,
    /// Line of each query.
    Text {
        file: PathBuf,
        lines: Vec<usize>,
    },
    Raw {
        file: PathBuf,
    },
}

impl Queries<3> {
    /// Points.
    pub fn points(given: &[Given<3>]) -> Result<Self, Failure> {
        Self::read(given, "3: x, y, z")
    }
}

impl Queries<6> {
    /// Segments.
    pub fn segments(given: &[Given<6>]) -> Result<Self, Failure> {
        Self::read(given, "6: ax, ay, az, bx, by, bz")
    }
}

impl Queries<7> {
    /// Motions by quaternion.
    pub fn poses(given: &[Given<7>]) -> Result<Self, Failure> {
        Self::read(given, "7: x, y, z, qw, qx, qy, qz")
    }
}

impl Queries<12> {
    /// Motions by matrix.
    pub fn matrices(given: &[Given<12>]) -> Result<Self, Failure> {
        Self::read(given, "12: three rows of a matrix and translation")
    }
}

impl<const N: usize> Queries<N> {
    fn read(given: &[Given<N>], wanted: &'static str) -> Result<Self, Failure> {
        let is_stdin = |path: &Path| path.as_os_str() == "-";
        if given.iter().filter_map(Given::file).filter(|path| is_stdin(path)).count() > 1 {
            return Err(Failure::Usage {
                what: "-: the standard input can be read only once".to_owned(),
            });
        }
        let mut queries = Queries { rows: Vec::new(), origins: Vec::new(), broken: None };
        for given in given {
            if queries.broken.is_some() {
                break;
            }
            let before = queries.rows.len();
            match given {
                Given::Query(query) => {
                    queries.origins.push((queries.rows.len(), Origin::Argument));
                    queries.rows.push(*query);
                }
                Given::File(path) if is_stdin(path) => {
                    let mut bytes = Vec::new();
                    let read = std::io::stdin().lock().read_to_end(&mut bytes).map(|_| bytes);
                    queries.text(Path::new(STANDARD_INPUT), read, wanted)?;
                }
                Given::File(path)
                    if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("f32")) =>
                {
                    queries.raw(path)?;
                }
                Given::File(path) => queries.text(path, std::fs::read(path), wanted)?,
            }
            if let Given::File(path) = given
                && queries.rows.len() == before
                && queries.broken.is_none()
            {
                let name = if is_stdin(path) { Path::new(STANDARD_INPUT) } else { path };
                // A standard error that is closed is no reason to withhold the answers.
                let _ = writeln!(std::io::stderr(), "no queries in {}", name.display());
            }
        }
        match queries.broken.take() {
            Some(failure) if queries.rows.is_empty() => Err(failure),
            broken => Ok(Queries { broken, ..queries }),
        }
    }

    fn text(
        &mut self,
        file: &Path,
        bytes: std::io::Result<Vec<u8>>,
        wanted: &'static str,
    ) -> Result<(), Failure> {
        let bytes =
            bytes.map_err(|error| Failure::ReadQueries { file: file.to_owned(), error, wanted })?;
        let Rows { rows, lines, broken } = csv::parse(file, &bytes, wanted);
        self.origins.push((self.rows.len(), Origin::Text { file: file.to_owned(), lines }));
        self.rows.extend(rows);
        self.broken = broken;
        Ok(())
    }

    fn raw(&mut self, file: &Path) -> Result<(), Failure> {
        let bytes =
            std::fs::read(file).map_err(|error| Failure::Read { file: file.to_owned(), error })?;
        let (words, rest) = bytes.as_chunks::<4>();
        let numbers: Vec<f32> = words.iter().map(|&word| f32::from_le_bytes(word)).collect();
        let (rows, partial) = numbers.as_chunks::<N>();
        if !(rest.is_empty() && partial.is_empty()) {
            return Err(Failure::RawLength {
                file: file.to_owned(),
                bytes: bytes.len(),
                record: 4 * N,
            });
        }
        let first = self.rows.len();
        self.origins.push((first, Origin::Raw { file: file.to_owned() }));
        self.rows.extend(rows);
        if let Some(index) = rows.iter().position(|row| !row.iter().all(|x| x.is_finite())) {
            self.broken = Some(self.refused(first + index, QueryError::NotFinite));
            self.rows.truncate(first + index);
        }
        Ok(())
    }

    /// Ends the queries before number `index`, which cannot be asked.
    ///
    /// # Errors
    /// What is wrong with it, if no query is left.
    pub fn end_at(&mut self, index: usize, failure: Failure) -> Result<(), Failure> {
        if index == 0 {
            return Err(failure);
        }
        self.rows.truncate(index);
        self.broken = Some(failure);
        Ok(())
    }

    /// Why the answers end before their time: a query was refused, or the next one could not be
    /// read.
    pub fn stopped(&mut self, refused: Option<(usize, QueryError)>) -> Option<Failure> {
        let broken = self.broken.take();
        refused.map(|(index, error)| self.refused(index, error)).or(broken)
    }

    /// A query that was refused, by its place.
    pub fn refused(&self, index: usize, error: QueryError) -> Failure {
        Failure::Query { place: self.place(index), error }
    }

    /// Where a query came from.
    pub fn place(&self, index: usize) -> Place {
        let after = self.origins.partition_point(|(first, _)| *first <= index);
        match after.checked_sub(1).and_then(|at| self.origins.get(at)) {
            Some((first, Origin::Text { file, lines })) => {
                let line = lines.get(index - first).copied().unwrap_or_default();
                Place::Line { file: file.clone(), line }
            }
            Some((first, Origin::Raw { file })) => {
                let number = index - first;
                Place::Record { file: file.clone(), number, byte: number * 4 * N }
            }
            Some((_, Origin::Argument)) | None => {
                Place::Argument { text: self.rows[index].map(|x| Short(x).to_string()).join(",") }
            }
        }
    }
}
