//! The geometry of hulls.

use crate::error::{MeshsweepError, missing};
use crate::model::Model;
use meshsweep::hull::{enclosing_input, mesh_of, sticks_out_note};
use meshsweep::mesh::Mesh;
use meshsweep::tight::hull_mesh;
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;

/// Vertices and triangles of a mesh.
type Arrays<'py> = (Bound<'py, PyArray2<f32>>, Bound<'py, PyArray2<u32>>);

fn arrays<'py>(py: Python<'py>, mesh: &Mesh) -> PyResult<Arrays<'py>> {
    let positions = PyArray1::from_vec(py, mesh.positions.as_flattened().to_vec());
    let triangles = PyArray1::from_vec(py, mesh.triangles.as_flattened().to_vec());
    Ok((
        positions.reshape([mesh.positions.len(), 3])?,
        triangles.reshape([mesh.triangles.len(), 3])?,
    ))
}

#[pymethods]
impl Model {
    /// Tight hulls, coarse to fine: vertices, triangles, and how far they may be from the mesh.
    fn tight_hulls<'py>(&self, py: Python<'py>) -> PyResult<Vec<(Arrays<'py>, f64)>> {
        let hulls = self.blob().tight_hulls().map_err(|_| missing("tight hulls", "tight"))?;
        let hulls = (0..hulls.count()).filter_map(|index| hulls.get(index));
        hulls
            .map(|hull| {
                let off = f64::from(hull.record().slack) + f64::from(hull.bvh().surface_error());
                Ok((arrays(py, &hull_mesh(&hull))?, off))
            })
            .collect()
    }

    /// Level `index` of the hull hierarchy, 0 the coarsest: a mesh that encloses the input.
    fn hull_level<'py>(&self, py: Python<'py>, index: u32) -> PyResult<Arrays<'py>> {
        let hull = self.blob().hull().ok().filter(|hull| hull.encloses());
        let hull = hull.ok_or_else(|| missing("hulls that enclose", "hull"))?;
        let levels = hull.header().levels;
        let level = hull.level(index).ok_or_else(|| {
            pyo3::exceptions::PyIndexError::new_err(format!("there are {levels} levels"))
        })?;
        let stored = mesh_of(&hull, hull.faces(&level));
        let enclosing = enclosing_input(&hull, &stored).ok_or_else(|| {
            let note = sticks_out_note(f64::from(hull.surface_error()));
            MeshsweepError::new_err(note.unwrap_or_default())
        });
        arrays(py, &enclosing?)
    }

    /// Number of levels of the hull hierarchy; 0 without one.
    fn hull_levels(&self) -> u32 {
        self.blob().hull().map_or(0, |hull| hull.header().levels)
    }
}
