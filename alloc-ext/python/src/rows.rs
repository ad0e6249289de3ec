//! Asks about many rows of numbers, on all cores and without the interpreter's lock.

use crate::error::{MeshsweepError, of_query};
use crate::pool::on_all_cores;
use crate::record::Put;
use meshsweep_core::QueryError;
use numpy::{PyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use rayon::prelude::*;
use std::ops::Range;
use std::time::{Duration, Instant};

/// Rows that a thread takes at once: enough to make the cost of taking them vanish.
const AT_ONCE: usize = 512;

/// Rows before the first look for Ctrl-C.
const FIRST_BLOCK: usize = 1 << 11;

/// Rows of the largest block: of some questions the answers to a block are twice in memory.
const MOST: usize = 1 << 20;

/// A block of rows that takes less makes the next one twice as large.
const SHORT: Duration = Duration::from_millis(50);

/// A block of rows that takes more makes the next one half as large.
const LONG: Duration = Duration::from_millis(400);

/// Rows of `N` numbers each.
pub type Rows<'py> = PyReadonlyArray2<'py, f32>;

/// Bytes of records.
pub type Records<'py> = Bound<'py, PyArray1<u8>>;

/// The rows of a contiguous array.
pub fn rows<'a, const N: usize>(array: &'a Rows<'_>) -> PyResult<&'a [[f32; N]]> {
    let floats = array.as_slice()?;
    match floats.as_chunks::<N>() {
        (rows, []) => Ok(rows),
        _ => Err(MeshsweepError::new_err(format!("rows of {N} numbers are wanted"))),
    }
}

/// Answers each row with a record of `size` bytes. `asker` makes a thread's asker with its memory.
///
/// # Errors
/// Of the first row that is refused; Ctrl-C.
pub fn ask<'py, const N: usize, F>(
    py: Python<'py>,
    array: &Rows<'py>,
    size: usize,
    asker: impl Fn() -> F + Sync,
) -> PyResult<Records<'py>>
where
    F: FnMut([f32; N], Put<'_>) -> Result<(), QueryError>,
{
    let rows = rows::<N>(array)?;
    let mut records = vec![0; rows.len() * size];
    in_blocks(py, rows.len(), FIRST_BLOCK, |block| {
        let begin = block.start;
        let (rows, records) = (&rows[block.clone()], &mut records[begin * size..block.end * size]);
        let pieces = rows.par_chunks(AT_ONCE).zip(records.par_chunks_mut(AT_ONCE * size));
        let refused = pieces.enumerate().find_map_first(|(piece, (rows, records))| {
            let mut ask = asker();
            let mut pairs = rows.iter().zip(records.chunks_mut(size)).enumerate();
            pairs.find_map(|(index, (row, record))| {
                let error = ask(*row, Put::new(record)).err()?;
                Some((begin + piece * AT_ONCE + index, error))
            })
        });
        refused.map_or(Ok(()), Err)
    })?;
    Ok(PyArray1::from_vec(py, records))
}

/// Does the work of successive blocks of rows on all cores, and looks for Ctrl-C between them. The
/// first has `first` rows. The others have `first` times a power of two, and at least `first`.
///
/// # Errors
/// Of a row that is refused; Ctrl-C.
pub fn in_blocks(
    py: Python<'_>,
    count: usize,
    first: usize,
    mut work: impl FnMut(Range<usize>) -> Result<(), (usize, QueryError)> + Send,
) -> PyResult<()> {
    let (mut begin, mut most) = (0, first);
    while begin < count {
        let block = begin..count.min(begin + most);
        begin = block.end;
        let before = Instant::now();
        let done = py.detach(|| on_all_cores(|| work(block)))?;
        done.map_err(|(row, error)| of_query(Some(row), error))?;
        py.check_signals()?;
        match before.elapsed() {
            took if took < SHORT => most = (2 * most).min(MOST),
            took if took > LONG => most = (most / 2).max(first),
            _ => (),
        }
    }
    Ok(())
}

/// The answers to rows that have any number of records each.
pub struct Lists<'py> {
    /// Where the records of each row begin, and behind them the number of all.
    begins: Bound<'py, PyArray1<u64>>,
    records: Records<'py>,
    /// Of each row whether nothing is missing.
    is_complete: Bound<'py, PyArray1<bool>>,
}

impl<'py> IntoPyObject<'py> for Lists<'py> {
    type Target = PyTuple;
    type Output = Bound<'py, PyTuple>;
    type Error = PyErr;

    fn into_pyobject(self, py: Python<'py>) -> PyResult<Self::Output> {
        (self.begins, self.records, self.is_complete).into_pyobject(py)
    }
}

/// Answers each row with any number of records of `size` bytes. An asker tells whether its row's
/// are complete.
///
/// # Errors
/// Of the first row that is refused; Ctrl-C.
pub fn ask_many<'py, const N: usize, F>(
    py: Python<'py>,
    array: &Rows<'py>,
    size: usize,
    asker: impl Fn() -> F + Sync,
) -> PyResult<Lists<'py>>
where
    F: FnMut([f32; N], &mut Vec<u8>) -> Result<bool, QueryError>,
{
    let rows = rows::<N>(array)?;
    let (mut begins, mut records, mut is_complete) = (vec![0], Vec::new(), Vec::new());
    in_blocks(py, rows.len(), FIRST_BLOCK, |block| {
        let begin = block.start;
        let piece = |(piece, rows): (usize, &[[f32; N]])| {
            let (mut ask, mut ends, mut records) = (asker(), Vec::new(), Vec::new());
            for (index, row) in rows.iter().enumerate() {
                let asked = ask(*row, &mut records);
                let is_complete =
                    asked.map_err(|error| (begin + piece * AT_ONCE + index, error))?;
                ends.push((records.len(), is_complete));
            }
            Ok((ends, records))
        };
        let pieces: Vec<_> = rows[block].par_chunks(AT_ONCE).enumerate().map(piece).collect();
        let pieces = pieces.into_iter().collect::<Result<Vec<(Vec<_>, Vec<u8>)>, _>>()?;
        for (ends, of_piece) in pieces {
            let before = records.len();
            begins.extend(ends.iter().map(|end| ((before + end.0) / size) as u64));
            is_complete.extend(ends.iter().map(|end| end.1));
            records.extend(of_piece);
        }
        Ok(())
    })?;
    Ok(Lists {
        begins: PyArray1::from_vec(py, begins),
        records: PyArray1::from_vec(py, records),
        is_complete: PyArray1::from_vec(py, is_complete),
    })
}
