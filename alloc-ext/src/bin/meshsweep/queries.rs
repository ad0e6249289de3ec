//! Query files: text, raw f32 by their name, or the standard input.

use super::csv;
use super::failure::{Failure, Place};
use meshsweep_core::QueryError;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Queries of `N` finite numbers, and where each came from.
pub struct Queries<const N: usize> {
    file: PathBuf,
    /// The queries, in the order of the file.
    pub rows: Vec<[f32; N]>,
    /// Line of each; `None` for a raw file.
    lines: Option<Vec<usize>>,
}

impl Queries<3> {
    /// Points.
    pub fn points(path: &Path) -> Result<Self, Failure> {
        Self::read(path, "3: x, y, z")
    }
}

impl Queries<6> {
    /// Segments.
    pub fn segments(path: &Path) -> Result<Self, Failure> {
        Self::read(path, "6: ax, ay, az, bx, by, bz")
    }
}

impl<const N: usize> Queries<N> {
    fn read(path: &Path, wanted: &'static str) -> Result<Self, Failure> {
        let is_stdin = path.as_os_str() == "-";
        let file = if is_stdin { PathBuf::from("standard input") } else { path.to_owned() };
        let bytes = if is_stdin {
            let mut bytes = Vec::new();
            std::io::stdin().lock().read_to_end(&mut bytes).map(|_| bytes)
        } else {
            std::fs::read(path)
        };
        let bytes = bytes.map_err(|error| Failure::Read { file: file.clone(), error })?;
        let is_raw = !is_stdin && path.extension().is_some_and(|e| e.eq_ignore_ascii_case("f32"));
        if !is_raw {
            let (rows, lines) = csv::parse(&file, &bytes, wanted)?;
            return Ok(Queries { file, rows, lines: Some(lines) });
        }
        let queries = Queries { rows: raw(&file, &bytes)?, file, lines: None };
        match queries.rows.iter().position(|row| !row.iter().all(|x| x.is_finite())) {
            Some(index) => Err(queries.refused(index, QueryError::NotFinite)),
            None => Ok(queries),
        }
    }

    /// A query that was refused, by its place in the file.
    pub fn refused(&self, index: usize, error: QueryError) -> Failure {
        let line = self.lines.as_ref().and_then(|lines| lines.get(index));
        let place = match line {
            Some(&line) => Place::Line(line),
            None => Place::Record { number: index, byte: index * 4 * N },
        };
        Failure::Query { file: self.file.clone(), place, error }
    }
}

fn raw<const N: usize>(file: &Path, bytes: &[u8]) -> Result<Vec<[f32; N]>, Failure> {
    let (words, rest) = bytes.as_chunks::<4>();
    let numbers: Vec<f32> = words.iter().map(|&word| f32::from_le_bytes(word)).collect();
    let (rows, partial) = numbers.as_chunks::<N>();
    if rest.is_empty() && partial.is_empty() {
        Ok(rows.to_vec())
    } else {
        Err(Failure::RawLength { file: file.to_owned(), bytes: bytes.len(), record: 4 * N })
    }
}
