//! What makes the winding numbers of a mesh doubtful.

use crate::mesh_file::Loaded;
use meshsweep::mesh::Mesh;
use std::fmt::Arguments;
use std::io::{self, Write};
use std::path::Path;

/// Says it on the standard error.
pub fn warn(file: &Path, Loaded { mesh, report, .. }: &Loaded) {
    let say = |what: Arguments<'_>| {
        // A closed standard error is no failure.
        let _ = writeln!(io::stderr(), "{}: {what}", file.display());
    };
    let (parts, triangles) = (report.component_count, mesh.triangles.len());
    if triangles > 1 && 2 * parts > triangles {
        say(format_args!(
            "{parts} connected parts of {triangles} triangles: which way each faces is taken from \
             the file, and winding numbers rely on it; weld the vertices first"
        ));
    }
    if faces_inwards(mesh) {
        say(format_args!(
            "the mesh faces inwards: its winding numbers are negative inside, so every point is \
             outside; reverse its triangles"
        ));
    }
}

/// Whether the volume between the triangles and the middle of all vertices is clearly negative.
fn faces_inwards(mesh: &Mesh) -> bool {
    let count = mesh.positions.len().max(1) as f64;
    let middle =
        [0, 1, 2].map(|k| mesh.positions.iter().map(|p| f64::from(p[k])).sum::<f64>() / count);
    let triple = |triangle: usize| {
        let Some(corners) = mesh.corners(triangle) else { return 0.0 };
        let [a, b, c] = corners.map(|p| [0, 1, 2].map(|k| f64::from(p[k]) - middle[k]));
        a[0] * (b[1] * c[2] - b[2] * c[1])
            + a[1] * (b[2] * c[0] - b[0] * c[2])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
    };
    let terms = || (0..mesh.triangles.len()).map(triple);
    terms().sum::<f64>() < -0.01 * terms().map(f64::abs).sum::<f64>()
}
