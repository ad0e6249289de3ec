//! Asks about many rows of numbers, on all cores and without the interpreter's lock.

use crate::error::{MeshsweepError, of_query};
use crate::pool::on_all_cores;
use crate::record::{Answer, Put};
use meshsweep_core::{QueryError, ScratchEntry};
use numpy::{PyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use rayon::prelude::*;
use std::array;
use std::ops::Range;
use std::time::{Duration, Instant};

/// Rows that a thread takes at once: enough to make the cost of taking them vanish.
const AT_ONCE: usize = 512;

/// Room for answers to a row at first.
const ROOM: usize = 64;

/// Rows before the first look for Ctrl-C.
const FIRST_BLOCK: usize = 1 << 11;

/// Rows of the largest block: of some questions the answers to a block are twice in memory.
const MOST: usize = 1 << 20;

/// A block of rows that takes less makes the next one twice as large.
const SHORT: Duration = Duration::from_millis(50);

/// A block of rows that takes more makes the next one half as large.
const LONG: Duration = Duration::from_millis(400);

/// Bytes of records.
pub type Records<'py> = Bound<'py, PyArray1<u8>>;

/// The rows of a contiguous array that a question is asked of, and the bytes of a record of its
/// answers.
#[derive(FromPyObject)]
pub struct Asked<'py>(PyReadonlyArray2<'py, f32>, usize);

/// What a search for all of something has found.
pub struct Found {
    /// Of the caller's memory so much is in use.
    pub stored: usize,
    /// This did not fit.
    pub dropped: u32,
    /// Whether it is proved that nothing else is to be found.
    pub is_complete: bool,
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

impl<'py> Asked<'py> {
    /// Of answers with `count` records each.
    pub fn with_each(self, count: usize) -> Self {
        Self(self.0, self.1 * count)
    }

    /// Bytes of a record.
    pub fn size(&self) -> usize {
        self.1
    }

    pub fn py(&self) -> Python<'py> {
        self.0.py()
    }

    /// Rows of `N` numbers each.
    ///
    /// # Errors
    /// They have another width.
    pub fn rows<const N: usize>(&self) -> PyResult<&[[f32; N]]> {
        match (self.0.as_slice()?.as_chunks::<N>(), self.0.shape()) {
            ((rows, []), &[_, width]) if width == N => Ok(rows),
            _ => Err(MeshsweepError::new_err(format!("rows of {N} numbers are wanted"))),
        }
    }

    /// Answers each row with a record. `one` gets scratch memory of so many entries.
    ///
    /// # Errors
    /// Of the first row that is refused; Ctrl-C; rows of another width.
    pub fn each<const N: usize, A: Answer>(
        &self,
        entries: usize,
        one: impl Fn([f32; N], &mut [ScratchEntry]) -> Result<A, QueryError> + Sync,
    ) -> PyResult<Records<'py>> {
        self.rows::<N>()?;
        self.each_wide(entries, |row, scratch| one(array::from_fn(|k| row[k]), scratch))
    }

    /// The same of rows of any width above 0.
    ///
    /// # Errors
    /// As [`each`](Self::each).
    pub fn each_wide<A: Answer>(
        &self,
        entries: usize,
        one: impl Fn(&[f32], &mut [ScratchEntry]) -> Result<A, QueryError> + Sync,
    ) -> PyResult<Records<'py>> {
        let (floats, size) = (self.0.as_slice()?, self.1);
        let (count, width) = (self.0.shape()[0], self.0.shape()[1]);
        let mut records = vec![0; count * size];
        in_blocks(self.py(), count, FIRST_BLOCK, |Range { start, end }| {
            let rows = floats[start * width..end * width].par_chunks(AT_ONCE * width);
            let pieces = rows.zip(records[start * size..end * size].par_chunks_mut(AT_ONCE * size));
            let refused = pieces.enumerate().find_map_first(|(piece, (rows, records))| {
                let mut scratch = vec![ScratchEntry::EMPTY; entries];
                let mut pairs = rows.chunks(width).zip(records.chunks_mut(size)).enumerate();
                pairs.find_map(|(index, (row, record))| match one(row, &mut scratch) {
                    Ok(answer) => {
                        answer.put(&mut Put::new(record));
                        None
                    }
                    Err(error) => Some((start + piece * AT_ONCE + index, error)),
                })
            });
            refused.map_or(Ok(()), Err)
        })?;
        Ok(PyArray1::from_vec(self.py(), records))
    }

    /// Answers each row with any number of records. `one` gets memory for some answers, all of
    /// them `empty`, and scratch memory of so many entries. If not all answers fit, it gets more.
    ///
    /// # Errors
    /// As [`each`](Self::each).
    pub fn lists<const N: usize, A: Answer + Copy + Sync>(
        &self,
        entries: usize,
        empty: A,
        one: impl Fn([f32; N], &mut [A], &mut [ScratchEntry]) -> Result<Found, QueryError> + Sync,
    ) -> PyResult<Lists<'py>> {
        let (rows, size) = (self.rows::<N>()?, self.1);
        let (mut begins, mut records, mut is_complete) = (vec![0], Vec::new(), Vec::new());
        in_blocks(self.py(), rows.len(), FIRST_BLOCK, |block| {
            let begin = block.start;
            let piece = |(piece, rows): (usize, &[[f32; N]])| {
                let (mut ends, mut records) = (Vec::new(), Vec::new());
                let mut scratch = vec![ScratchEntry::EMPTY; entries];
                let mut room = vec![empty; ROOM];
                for (index, row) in rows.iter().enumerate() {
                    let mut ask = |room: &mut Vec<A>| {
                        let found = one(*row, room, &mut scratch);
                        found.map_err(|error| (begin + piece * AT_ONCE + index, error))
                    };
                    let mut found = ask(&mut room)?;
                    if found.dropped > 0 {
                        room.resize(found.stored + found.dropped as usize, empty);
                        found = ask(&mut room)?;
                    }
                    for answer in room.iter().take(found.stored) {
                        let begin = records.len();
                        records.resize(begin + size, 0);
                        answer.put(&mut Put::new(&mut records[begin..]));
                    }
                    ends.push((records.len(), found.is_complete));
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
            begins: PyArray1::from_vec(self.py(), begins),
            records: PyArray1::from_vec(self.py(), records),
            is_complete: PyArray1::from_vec(self.py(), is_complete),
        })
    }
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
