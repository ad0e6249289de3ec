//! The geometry of hulls.

use crate::error::{MeshsweepError, missing, of_query, refused};
use crate::model::Model;
use meshsweep::cut::{Keep, cut_blob};
use meshsweep::hull::{enclosing_input, mesh_of, sticks_out_note};
use meshsweep::mesh::Mesh;
use meshsweep::tight::hull_mesh;
use meshsweep_core::{Focus, Hull, RefinedHull};
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::{PyIndexError, PyRuntimeError};
use pyo3::prelude::*;
use std::thread;

/// Vertices and triangles of a mesh.
type Arrays<'py> = (Bound<'py, PyArray2<f32>>, Bound<'py, PyArray2<u32>>);

/// Splits that a refined hull may have: a mesh of two million triangles.
const SPLITS: usize = 1 << 20;

/// Bytes of the stack for a refined hull: eight times its array of 16 bytes a split. Builds without
/// optimisation copy the array.
const STACK: usize = 8 * 16 * SPLITS;

fn arrays<'py>(py: Python<'py>, mesh: &Mesh) -> PyResult<Arrays<'py>> {
    let positions = PyArray1::from_vec(py, mesh.positions.as_flattened().to_vec());
    let triangles = PyArray1::from_vec(py, mesh.triangles.as_flattened().to_vec());
    Ok((
        positions.reshape([mesh.positions.len(), 3])?,
        triangles.reshape([mesh.triangles.len(), 3])?,
    ))
}

/// A hull of a hierarchy, as it encloses the input.
fn enclosing(hull: &Hull<'_>, stored: &Mesh) -> PyResult<Mesh> {
    enclosing_input(hull, stored).ok_or_else(|| {
        let note = sticks_out_note(f64::from(hull.surface_error()));
        MeshsweepError::new_err(note.unwrap_or_default())
    })
}

/// The sum of two lengths, rounded up where double precision does not hold it.
fn sum_up(a: f32, b: f32) -> f64 {
    let (a, b) = (f64::from(a), f64::from(b));
    let sum = a + b;
    // The difference from the larger one is exact.
    if sum - a.max(b) == a.min(b) { sum } else { sum.next_up() }
}

impl Model {
    fn enclosing_hull(&self) -> PyResult<Hull<'_>> {
        let hull = self.blob().hull().ok().filter(|hull| hull.encloses());
        hull.ok_or_else(|| missing("hulls that enclose", "hull"))
    }
}

#[pymethods]
impl Model {
    /// Tight hulls, coarse to fine: vertices, triangles, and a bound of their distance from the
    /// mesh, which includes the surface error.
    fn tight_hulls<'py>(&self, py: Python<'py>) -> PyResult<Vec<(Arrays<'py>, f64)>> {
        let hulls = self.blob().tight_hulls().map_err(|_| missing("tight hulls", "tight"))?;
        let hulls = (0..hulls.count()).filter_map(|index| hulls.get(index));
        hulls
            .map(|hull| {
                let off = sum_up(hull.record().slack, hull.bvh().surface_error());
                Ok((arrays(py, &hull_mesh(&hull))?, off))
            })
            .collect()
    }

    /// Level `index` of the hull hierarchy, 0 the coarsest: a mesh that encloses the input.
    fn hull_level<'py>(&self, py: Python<'py>, index: u32) -> PyResult<Arrays<'py>> {
        let hull = self.enclosing_hull()?;
        let levels = hull.header().levels;
        let level = hull
            .level(index)
            .ok_or_else(|| PyIndexError::new_err(format!("there are {levels} levels")))?;
        arrays(py, &enclosing(&hull, &mesh_of(&hull, hull.faces(&level)))?)
    }

    /// Number of levels of the hull hierarchy.
    fn hull_levels(&self) -> PyResult<u32> {
        self.enclosing_hull().map(|hull| hull.header().levels)
    }

    /// The hull that is fine around a ball, in a box, around a segment, or everywhere; and the
    /// largest error that the memory was too short for.
    fn refine<'py>(
        &self,
        py: Python<'py>,
        error: f32,
        focus: (&str, Vec<[f32; 3]>, f32),
    ) -> PyResult<(Arrays<'py>, f32)> {
        let hull = self.enclosing_hull()?;
        let (kind, corners, radius) = focus;
        let focus = match (kind, &corners[..]) {
            ("near", &[centre]) => Focus::Ball { centre, radius },
            ("box", &[a, b]) => Focus::Box { a, b },
            ("segment", &[a, b]) => Focus::Segment { a, b, radius },
            _ => Focus::Everywhere,
        };
        let refine = || {
            let mut refined = RefinedHull::<SPLITS>::new();
            let done = refined.update(&hull, &focus, error, &mut []);
            let done = done.map_err(|error| of_query(None, error))?;
            let mesh = enclosing(&hull, &mesh_of(&hull, refined.faces(&hull)))?;
            Ok((mesh, done.error_left))
        };
        // The caller's stack may be short.
        let refined = py.detach(|| {
            thread::scope(|scope| {
                let thread = thread::Builder::new().stack_size(STACK).spawn_scoped(scope, refine);
                thread.map(thread::ScopedJoinHandle::join)
            })
        });
        let ended = |why: String| PyRuntimeError::new_err(why);
        let refined: PyResult<(Mesh, f32)> = refined
            .map_err(|error| ended(error.to_string()))?
            .map_err(|_| ended("the work ended early".to_owned()))?;
        let (mesh, error_left) = refined?;
        Ok((arrays(py, &mesh)?, error_left))
    }

    /// A coarser model.
    fn cut(
        &self,
        py: Python<'_>,
        level: Option<u32>,
        triboxes: Option<u32>,
        tight: Option<u32>,
    ) -> PyResult<Self> {
        let mut keep = Keep::default();
        (keep.level, keep.triboxes, keep.tight) = (level, triboxes, tight);
        let cut = py.detach(|| cut_blob(self.blob(), &keep));
        Self::of(cut.map_err(|error| refused(&error))?, Vec::new())
    }
}
