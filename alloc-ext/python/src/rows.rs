//! Asks about many rows of numbers, on all cores and without the interpreter's lock.

use crate::error::{MeshsweepError, of_query};
use crate::record::Put;
use meshsweep_core::QueryError;
use numpy::{PyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use rayon::prelude::*;

/// Rows that a thread takes at once: enough to make the cost of taking them vanish.
const AT_ONCE: usize = 512;

/// Rows between two looks for Ctrl-C.
pub const BLOCK: usize = 1 << 18;

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
    let blocks = rows.chunks(BLOCK).zip(records.chunks_mut(BLOCK * size));
    for (block, (rows, records)) in blocks.enumerate() {
        let refused = py.detach(|| {
            let pieces = rows.par_chunks(AT_ONCE).zip(records.par_chunks_mut(AT_ONCE * size));
            pieces.enumerate().find_map_first(|(piece, (rows, records))| {
                let mut ask = asker();
                let mut pairs = rows.iter().zip(records.chunks_mut(size)).enumerate();
                pairs.find_map(|(index, (row, record))| {
                    let error = ask(*row, Put::new(record)).err()?;
                    Some((piece * AT_ONCE + index, error))
                })
            })
        });
        if let Some((row, error)) = refused {
            return Err(of_query(Some(block * BLOCK + row), error));
        }
        py.check_signals()?;
    }
    Ok(PyArray1::from_vec(py, records))
}

/// Answers each row with any number of records of `size` bytes. Returns where the records of each
/// row begin, with the number of all behind, and the records.
///
/// # Errors
/// Of the first row that is refused; Ctrl-C.
pub fn ask_many<'py, const N: usize, F>(
    py: Python<'py>,
    array: &Rows<'py>,
    size: usize,
    asker: impl Fn() -> F + Sync,
) -> PyResult<(Bound<'py, PyArray1<u64>>, Records<'py>)>
where
    F: FnMut([f32; N], &mut Vec<u8>) -> Result<(), QueryError>,
{
    let rows = rows::<N>(array)?;
    let (mut begins, mut records) = (vec![0], Vec::new());
    for (block, rows) in rows.chunks(BLOCK).enumerate() {
        let pieces = py.detach(|| {
            let piece = |(piece, rows): (usize, &[[f32; N]])| {
                let (mut ask, mut ends, mut records) = (asker(), Vec::new(), Vec::new());
                for (index, row) in rows.iter().enumerate() {
                    let asked = ask(*row, &mut records);
                    asked.map_err(|error| (piece * AT_ONCE + index, error))?;
                    ends.push(records.len());
                }
                Ok((ends, records))
            };
            let pieces: Vec<_> = rows.par_chunks(AT_ONCE).enumerate().map(piece).collect();
            pieces.into_iter().collect::<Result<Vec<(Vec<usize>, Vec<u8>)>, _>>()
        });
        let pieces = pieces.map_err(|(row, error)| of_query(Some(block * BLOCK + row), error))?;
        for (ends, of_piece) in pieces {
            let before = records.len();
            begins.extend(ends.into_iter().map(|end| ((before + end) / size) as u64));
            records.extend(of_piece);
        }
        py.check_signals()?;
    }
    Ok((PyArray1::from_vec(py, begins), PyArray1::from_vec(py, records)))
}
