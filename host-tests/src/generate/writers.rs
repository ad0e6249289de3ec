//! Mesh files as bytes.

use std::fmt::Write;

use super::Triangles;

/// Binary STL: a header without meaning, zero normals, which readers are to compute from the
/// winding.
#[must_use]
pub fn binary_stl((positions, triangles): &Triangles) -> Vec<u8> {
    let mut bytes = vec![0; 80];
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        bytes.extend([0; 12]);
        for x in triangle.iter().flat_map(|&v| positions[v as usize]) {
            bytes.extend(x.to_le_bytes());
        }
        bytes.extend([0; 2]);
    }
    bytes
}

/// ASCII STL. Coordinates are written so that they read back as exactly the same f32.
#[must_use]
pub fn ascii_stl((positions, triangles): &Triangles) -> Vec<u8> {
    let mut text = String::from("solid part\n");
    for triangle in triangles {
        text.push_str("facet normal 0 0 0\nouter loop\n");
        for &v in triangle {
            text.push_str("vertex");
            push_point(&mut text, positions[v as usize]);
        }
        text.push_str("endloop\nendfacet\n");
    }
    text.push_str("endsolid part\n");
    text.into_bytes()
}

/// OBJ with `v` and `f` lines. Coordinates as in [`ascii_stl`].
#[must_use]
pub fn obj((positions, triangles): &Triangles) -> Vec<u8> {
    let mut text = String::new();
    for &p in positions {
        text.push('v');
        push_point(&mut text, p);
    }
    for [a, b, c] in triangles.iter().map(|t| t.map(|v| v + 1)) {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "f {a} {b} {c}");
    }
    text.into_bytes()
}

/// Binary little-endian PLY: f32 coordinates, lists of i32 with a length of one byte.
#[must_use]
pub fn binary_ply((positions, triangles): &Triangles) -> Vec<u8> {
    let mut bytes =
        ply_header("binary_little_endian", "float", positions.len(), triangles.len()).into_bytes();
    for x in positions.iter().flatten() {
        bytes.extend(x.to_le_bytes());
    }
    for triangle in triangles {
        bytes.push(3);
        triangle.iter().for_each(|v| bytes.extend(v.to_le_bytes()));
    }
    bytes
}

/// ASCII PLY with coordinates declared `double`, as in [`ascii_stl`].
#[must_use]
pub fn ascii_ply((positions, triangles): &Triangles) -> Vec<u8> {
    let mut text = ply_header("ascii", "double", positions.len(), triangles.len());
    for &p in positions {
        push_point(&mut text, p);
    }
    for [a, b, c] in triangles {
        let _ = writeln!(text, "3 {a} {b} {c}");
    }
    text.into_bytes()
}

/// OFF. Coordinates as in [`ascii_stl`].
#[must_use]
pub fn off((positions, triangles): &Triangles) -> Vec<u8> {
    let mut text = format!("OFF\n{} {} 0\n", positions.len(), triangles.len());
    positions.iter().for_each(|&p| push_point(&mut text, p));
    for [a, b, c] in triangles {
        let _ = writeln!(text, "3 {a} {b} {c}");
    }
    text.into_bytes()
}

/// Binary little-endian PLY with one list of strips, each of one triangle.
#[must_use]
pub fn strip_ply((positions, triangles): &Triangles) -> Vec<u8> {
    let header = ply_header("binary_little_endian", "float", positions.len(), 1);
    let header =
        header.replace("element face", "element tristrips").replace("uchar int", "int int");
    let mut bytes = header.into_bytes();
    bytes.extend(positions.iter().flatten().flat_map(|x| x.to_le_bytes()));
    bytes.extend((4 * triangles.len() as u32).to_le_bytes());
    for [a, b, c] in triangles {
        [*a, *b, *c, u32::MAX].iter().for_each(|v| bytes.extend(v.to_le_bytes()));
    }
    bytes
}

/// A PLY header for `vertices` points of type `scalar` and `faces` lists of `int`.
#[must_use]
pub fn ply_header(format: &str, scalar: &str, vertices: usize, faces: usize) -> String {
    format!(
        "ply\nformat {format} 1.0\nelement vertex {vertices}\nproperty {scalar} x\nproperty {scalar} y\n\
         property {scalar} z\nelement face {faces}\nproperty list uchar int vertex_indices\nend_header\n"
    )
}

/// The shortest decimals that name the same f64: read as f64 they are the f32 exactly, which an
/// f32's own shortest decimals are not.
fn push_point(text: &mut String, p: [f32; 3]) {
    let [x, y, z] = p.map(f64::from);
    let _ = writeln!(text, " {x} {y} {z}");
}
