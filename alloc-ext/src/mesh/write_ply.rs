//! A mesh as binary PLY.

use std::io::{self, Write};

use super::Mesh;

/// Writes positions and triangles as little-endian PLY: `x`, `y`, `z` as `float`, `vertex_indices`
/// as lists of three `int`. [`read`](super::read) gives back the same bits in the same order.
/// Nothing else of the mesh is kept.
///
/// # Errors
/// Those of `out`; and `InvalidInput` for a vertex number beyond `i32`, before anything is written.
pub fn write_ply(mesh: &Mesh, out: &mut (impl Write + ?Sized)) -> io::Result<()> {
    write(mesh, &[], out)
}

/// As [`write_ply`], with a number and a colour for each vertex: `quality` as `float`, `red`,
/// `green` and `blue` as `uchar`. Missing ones are 0.
///
/// # Errors
/// Those of [`write_ply`].
pub fn write_coloured_ply(
    mesh: &Mesh,
    qualities: &[(f32, [u8; 3])],
    out: &mut (impl Write + ?Sized),
) -> io::Result<()> {
    if qualities.is_empty() {
        write(mesh, &[(0.0, [0; 3])], out)
    } else {
        write(mesh, qualities, out)
    }
}

fn write(
    mesh: &Mesh,
    qualities: &[(f32, [u8; 3])],
    out: &mut (impl Write + ?Sized),
) -> io::Result<()> {
    if mesh.triangles.iter().flatten().any(|&corner| i32::try_from(corner).is_err()) {
        return Err(io::ErrorKind::InvalidInput.into());
    }
    out.write_all(b"ply\nformat binary_little_endian 1.0\n")?;
    writeln!(out, "element vertex {}", mesh.positions.len())?;
    out.write_all(b"property float x\nproperty float y\nproperty float z\n")?;
    if !qualities.is_empty() {
        out.write_all(b"property float quality\n")?;
        out.write_all(b"property uchar red\nproperty uchar green\nproperty uchar blue\n")?;
    }
    writeln!(out, "element face {}", mesh.triangles.len())?;
    out.write_all(b"property list uchar int vertex_indices\nend_header\n")?;
    for (number, position) in mesh.positions.iter().enumerate() {
        for coordinate in position {
            out.write_all(&coordinate.to_le_bytes())?;
        }
        if !qualities.is_empty() {
            let (quality, colour) = qualities.get(number).copied().unwrap_or_default();
            out.write_all(&quality.to_le_bytes())?;
            out.write_all(&colour)?;
        }
    }
    for corners in &mesh.triangles {
        out.write_all(&[3])?;
        for corner in corners {
            out.write_all(&corner.to_le_bytes())?;
        }
    }
    out.flush()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::read_bytes;
    use std::path::Path;

    #[test]
    fn what_is_written_reads_back_the_same() {
        let positions =
            vec![[0.1, -2.5e-7, 3.0], [1.0, 0.0, 0.0], [0.0, 1.0e20, 0.0], [0.0, 0.0, -1.0]];
        let mesh = Mesh::new(positions, vec![[0, 1, 2], [3, 1, 0]]);
        let mut bytes = Vec::new();
        write_ply(&mesh, &mut bytes).unwrap();
        let raw = read_bytes(Path::new("a.ply"), bytes).unwrap();
        assert_eq!(raw.triangles, mesh.triangles);
        assert_eq!(
            raw.positions,
            mesh.positions.iter().map(|p| p.map(f64::from)).collect::<Vec<_>>()
        );
    }

    #[test]
    fn a_vertex_number_beyond_the_format_is_refused() {
        let mesh = Mesh::new(vec![[0.0; 3]], vec![[0, 0, u32::MAX]]);
        let mut bytes = Vec::new();
        assert_eq!(write_ply(&mesh, &mut bytes).unwrap_err().kind(), io::ErrorKind::InvalidInput);
        assert!(bytes.is_empty());
    }
}
