//! Answers questions about many rows of numbers, on all cores and without the interpreter's lock.

use crate::error::{MeshsweepError, of_query};
use crate::pool::{on_all_cores, on_all_cores_watched};
use crate::record::{Answer, write};
use meshsweep_core::{QueryError, ScratchEntry};
use numpy::{PyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::{PyKeyboardInterrupt, PyMemoryError};
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use rayon::current_num_threads;
use rayon::prelude::*;
use std::array;
use std::collections::TryReserveError;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Rows of a task, at most. With so many the cost of scheduling a task is negligible.
const ROWS_PER_TASK: usize = 512;

/// A block is split into at least so many tasks for each thread, if it has the rows. A thread that
/// is done early then takes tasks of the others.
const TASKS_PER_THREAD: usize = 4;

/// Records that the memory for a row's answers has at first.
const FIRST_CAPACITY: usize = 64;

/// Rows of the largest block. The answers to a block of `lists` are in memory twice.
const MAX_BLOCK_ROWS: usize = 1 << 20;

/// If a block takes less time, the next one has twice as many rows.
const GROW_BELOW: Duration = Duration::from_millis(50);

/// If a block takes less time, the next one has sixteen times as many rows.
const LEAP_BELOW: Duration = Duration::from_micros(500);

/// If a block takes more time, the next one has half as many rows.
const SHRINK_ABOVE: Duration = Duration::from_millis(400);

/// Bytes of records.
pub type Records<'py> = Bound<'py, PyArray1<u8>>;

/// The rows of a question, a contiguous array, and the bytes of a record of its answers.
#[derive(FromPyObject)]
pub struct QueryRows<'py>(PyReadonlyArray2<'py, f32>, usize);

/// What a search for all of something has found.
pub struct Found {
    /// Answers that are in the caller's memory.
    pub stored: usize,
    /// Answers that did not fit.
    pub dropped: u32,
    /// Whether it is proved that there are no other answers.
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

/// Why there are no answers.
pub enum Failed {
    /// This row is refused.
    Row(usize, QueryError),
    Memory,
    /// By Ctrl-C.
    Stopped,
}

impl Failed {
    /// # Errors
    /// The rows that are left are not wanted.
    pub fn if_stopped(stop: &AtomicBool) -> Result<(), Self> {
        if stop.load(Ordering::Relaxed) { Err(Self::Stopped) } else { Ok(()) }
    }
}

impl From<TryReserveError> for Failed {
    fn from(_: TryReserveError) -> Self {
        Self::Memory
    }
}

impl From<Failed> for PyErr {
    fn from(failed: Failed) -> Self {
        match failed {
            Failed::Row(row, error) => of_query(Some(row), error),
            Failed::Stopped => PyKeyboardInterrupt::new_err("the answers are not complete"),
            Failed::Memory => PyMemoryError::new_err("the answers take more memory than there is"),
        }
    }
}

impl<'py> IntoPyObject<'py> for Lists<'py> {
    type Target = PyTuple;
    type Output = Bound<'py, PyTuple>;
    type Error = PyErr;

    fn into_pyobject(self, py: Python<'py>) -> PyResult<Self::Output> {
        (self.begins, self.records, self.is_complete).into_pyobject(py)
    }
}

impl<'py> QueryRows<'py> {
    /// The same rows, for answers of `count` records each.
    pub fn with_each(self, count: usize) -> Self {
        Self(self.0, self.1.saturating_mul(count))
    }

    /// Bytes of a record.
    pub fn size(&self) -> usize {
        self.1
    }

    pub fn py(&self) -> Python<'py> {
        self.0.py()
    }

    /// Zeroed bytes for a record of each row.
    ///
    /// # Errors
    /// The memory is too short.
    pub fn zeroed(&self) -> PyResult<Vec<u8>> {
        let mut records = Vec::new();
        let bytes = self.0.shape()[0].checked_mul(self.1).ok_or(Failed::Memory)?;
        grow(&mut records, bytes, 0)?;
        Ok(records)
    }

    /// Rows of `N` numbers each.
    ///
    /// # Errors
    /// They have another width.
    pub fn of_width<const N: usize>(&self) -> PyResult<&[[f32; N]]> {
        match (self.0.as_slice()?.as_chunks::<N>(), self.0.shape()) {
            ((rows, []), &[_, width]) if width == N => Ok(rows),
            _ => Err(MeshsweepError::new_err(format!("rows of {N} numbers are wanted"))),
        }
    }

    /// Answers each row with a record. `one` gets scratch memory of so many entries.
    ///
    /// # Errors
    /// Of the first row that is refused; Ctrl-C; rows of another width; the memory is too short.
    pub fn each<const N: usize, A: Answer>(
        &self,
        entries: usize,
        one: impl Fn([f32; N], &mut [ScratchEntry]) -> Result<A, QueryError> + Sync,
    ) -> PyResult<Records<'py>> {
        self.of_width::<N>()?;
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
        let mut records = self.zeroed()?;
        in_blocks(self.py(), count, current_num_threads(), |Range { start, end }, stop| {
            let task_rows = task_rows(end - start);
            let rows = floats[start * width..end * width].par_chunks(task_rows * width);
            let tasks =
                rows.zip(records[start * size..end * size].par_chunks_mut(task_rows * size));
            let failed = tasks.enumerate().find_map_first(|(task, (rows, records))| {
                let mut scratch = vec![ScratchEntry::EMPTY; entries];
                let mut pairs = rows.chunks(width).zip(records.chunks_mut(size)).enumerate();
                let answered = pairs.try_for_each(|(index, (row, record))| {
                    Failed::if_stopped(stop)?;
                    let answer = one(row, &mut scratch);
                    let row = start + task * task_rows + index;
                    write(&answer.map_err(|error| Failed::Row(row, error))?, record);
                    Ok(())
                });
                answered.err()
            });
            failed.map_or(Ok(()), Err)
        })?;
        Ok(PyArray1::from_vec(self.py(), records))
    }

    /// Answers each row with any number of records. `one` gets memory for some answers and scratch
    /// memory of so many entries. If the answers do not fit, `one` is called again with memory for
    /// all of them. The memory holds `empty` or answers to earlier rows.
    ///
    /// # Errors
    /// As [`each`](Self::each).
    pub fn lists<const N: usize, A: Answer + Copy + Sync>(
        &self,
        entries: usize,
        empty: A,
        one: impl Fn([f32; N], &mut [A], &mut [ScratchEntry]) -> Result<Found, QueryError> + Sync,
    ) -> PyResult<Lists<'py>> {
        let (rows, size) = (self.of_width::<N>()?, self.1);
        let (mut begins, mut records, mut is_complete) = (vec![0], Vec::new(), Vec::new());
        in_blocks(self.py(), rows.len(), current_num_threads(), |block, stop| {
            let (begin, task_rows) = (block.start, task_rows(block.len()));
            let task = |(task, rows): (usize, &[[f32; N]])| {
                let (mut ends, mut records) = (Vec::new(), Vec::new());
                let mut scratch = vec![ScratchEntry::EMPTY; entries];
                let mut answers = vec![empty; FIRST_CAPACITY];
                for (index, row) in rows.iter().enumerate() {
                    Failed::if_stopped(stop)?;
                    let mut ask = |answers: &mut Vec<A>| {
                        let found = one(*row, answers, &mut scratch);
                        found.map_err(|error| Failed::Row(begin + task * task_rows + index, error))
                    };
                    let mut found = ask(&mut answers)?;
                    if found.dropped > 0 {
                        let more = found.stored + found.dropped as usize - answers.len();
                        grow(&mut answers, more, empty)?;
                        found = ask(&mut answers)?;
                    }
                    for answer in answers.iter().take(found.stored) {
                        let begin = records.len();
                        grow(&mut records, size, 0)?;
                        write(answer, &mut records[begin..]);
                    }
                    ends.push((records.len(), found.is_complete));
                }
                Ok((ends, records))
            };
            let tasks: Vec<_> = rows[block].par_chunks(task_rows).enumerate().map(task).collect();
            let tasks = tasks.into_iter().collect::<Result<Vec<(Vec<_>, Vec<u8>)>, Failed>>()?;
            for (ends, of_task) in tasks {
                let before = records.len();
                begins.extend(ends.iter().map(|end| ((before + end.0) / size) as u64));
                is_complete.extend(ends.iter().map(|end| end.1));
                records.try_reserve(of_task.len())?;
                records.extend(of_task);
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

/// Appends `more` copies of a value.
fn grow<T: Copy>(values: &mut Vec<T>, more: usize, value: T) -> Result<(), Failed> {
    values.try_reserve(more)?;
    values.resize(values.len() + more, value);
    Ok(())
}

/// Rows of a task, of a block with so many rows.
fn task_rows(rows: usize) -> usize {
    (rows / (TASKS_PER_THREAD * current_num_threads())).clamp(1, ROWS_PER_TASK)
}

/// Does the work of successive blocks of rows on all cores, and looks for Ctrl-C between them and
/// meanwhile: the work then sees a flag. The first block has `first` rows. The others have `first`
/// times a power of two, and at least `first`.
///
/// # Errors
/// Of a row that is refused; Ctrl-C; the memory is too short.
pub fn in_blocks(
    py: Python<'_>,
    count: usize,
    first: usize,
    mut work: impl FnMut(Range<usize>, &AtomicBool) -> Result<(), Failed> + Send,
) -> PyResult<()> {
    let (mut begin, mut size, stop) = (0, first, AtomicBool::new(false));
    while begin < count {
        let block = begin..count.min(begin + size);
        begin = block.end;
        let before = Instant::now();
        // A first block is short. It is not watched, which spares a question about few rows the way
        // to another thread.
        let is_watched = block.len() > first;
        let work = || work(block, &stop);
        py.detach(|| match is_watched {
            true => on_all_cores_watched(&stop, work),
            false => on_all_cores(work),
        })??;
        py.check_signals()?;
        match before.elapsed() {
            took if took < LEAP_BELOW && 16 * size <= MAX_BLOCK_ROWS => size *= 16,
            took if took < GROW_BELOW && 2 * size <= MAX_BLOCK_ROWS => size *= 2,
            took if took > SHRINK_ABOVE => size = (size / 2).max(first),
            _ => (),
        }
    }
    Ok(())
}
