//! A mesh as binary PLY.

use std::io::{self, Write};

use ply_rs_bw::ply::{
    Addable, ElementDef, Encoding, Header, PropertyAccess, PropertyDef, PropertyType, ScalarType,
};
use ply_rs_bw::writer::Writer;

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
    let mut faces = Vec::with_capacity(mesh.triangles.len());
    for corners in &mesh.triangles {
        let [a, b, c] = corners.map(i32::try_from);
        let beyond = |_| io::Error::from(io::ErrorKind::InvalidInput);
        faces.push(Face([a.map_err(beyond)?, b.map_err(beyond)?, c.map_err(beyond)?]));
    }
    // The crate's writer wants a sized one.
    let mut out = out;
    let float = PropertyType::Scalar(ScalarType::Float);
    let mut vertex = element("vertex", mesh.positions.len(), &["x", "y", "z"], &float);
    if !qualities.is_empty() {
        let byte = PropertyType::Scalar(ScalarType::UChar);
        add(&mut vertex, &["quality"], &float);
        add(&mut vertex, &["red", "green", "blue"], &byte);
    }
    let list = PropertyType::List(ScalarType::UChar, ScalarType::Int);
    let face = element("face", faces.len(), &["vertex_indices"], &list);
    let mut header = Header::new();
    header.encoding = Encoding::BinaryLittleEndian;
    header.elements.add(vertex.clone());
    header.elements.add(face.clone());
    let vertices = Writer::<Vertex>::new();
    vertices.write_header(&mut out, &header)?;
    for (number, &position) in mesh.positions.iter().enumerate() {
        let (quality, colour) = qualities.get(number).copied().unwrap_or_default();
        let record = Vertex { position, quality, colour };
        vertices.write_little_endian_element(&mut out, &record, &vertex)?;
    }
    let triangles = Writer::<Face>::new();
    for corners in &faces {
        triangles.write_little_endian_element(&mut out, corners, &face)?;
    }
    out.flush()
}

fn element(name: &str, count: usize, properties: &[&str], kind: &PropertyType) -> ElementDef {
    let mut element = ElementDef::new(name.to_owned());
    element.count = count;
    add(&mut element, properties, kind);
    element
}

fn add(element: &mut ElementDef, properties: &[&str], kind: &PropertyType) {
    for property in properties {
        element.properties.add(PropertyDef::new((*property).to_owned(), kind.clone()));
    }
}

struct Vertex {
    position: [f32; 3],
    quality: f32,
    colour: [u8; 3],
}

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self { position: [0.0; 3], quality: 0.0, colour: [0; 3] }
    }

    fn get_float(&self, key: &str) -> Option<f32> {
        if key == "quality" {
            return Some(self.quality);
        }
        let axis = ["x", "y", "z"].iter().position(|name| *name == key)?;
        self.position.get(axis).copied()
    }

    fn get_uchar(&self, key: &str) -> Option<u8> {
        let part = ["red", "green", "blue"].iter().position(|name| *name == key)?;
        self.colour.get(part).copied()
    }
}

struct Face([i32; 3]);

impl PropertyAccess for Face {
    fn new() -> Self {
        Self([0; 3])
    }

    fn get_list_int(&self, _: &str) -> Option<&[i32]> {
        Some(&self.0)
    }
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
