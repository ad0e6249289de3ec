//! Files that a reader must refuse or mend, each with the outcome that it must have.

mod readers;

use super::writers::{ascii_ply, ascii_stl, binary_ply, binary_stl, obj, ply_header};
use super::{Triangles, block, coil, cube, inverted, joined, scaled, torus};

/// What must become of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// A closed manifold after repair.
    Accepted,
    /// `read` or `repair` refuses it with this variant of `MeshError`.
    Unreadable(&'static str),
    /// `repair` takes it, `require_closed_manifold` refuses it with this variant.
    NoSolid(&'static str),
}

/// A file with a flaw.
#[derive(Clone, Debug)]
pub struct Evil {
    /// File name with its extension.
    pub name: &'static str,
    /// Content.
    pub bytes: Vec<u8>,
    /// What must become of it.
    pub outcome: Outcome,
    /// What is wrong with it, in a phrase.
    pub flaw: &'static str,
}

/// All evil files, in alphabetical order.
#[must_use]
pub fn evil() -> Vec<Evil> {
    let mut all = unreadable();
    all.extend(no_solid());
    all.extend(mendable());
    all.extend(readers::files());
    all.sort_by_key(|e| e.name);
    all
}

fn unreadable() -> Vec<Evil> {
    use Outcome::Unreadable as U;
    let file = |name, bytes, outcome, flaw| Evil { name, bytes, outcome: U(outcome), flaw };
    let small = torus(2.0, 1.0, 6, 4);
    let cut = |mut bytes: Vec<u8>, at: usize| {
        bytes.truncate(at);
        bytes
    };
    let ply = binary_ply(&small);
    let in_faces = ply.len() - 100;
    let text = ascii_ply(&small);
    let in_vertices = text.len() / 3;
    let mut list = ply_header("binary_little_endian", "float", 3, 1)
        .replace("uchar int", "uint int")
        .into_bytes();
    list.extend([0; 36]);
    list.extend(4_000_000_000u32.to_le_bytes());
    list.extend([0; 12]);
    let mut nan = binary_stl(&cube(1));
    nan[84 + 50 + 12..84 + 50 + 16].copy_from_slice(&f32::NAN.to_le_bytes());
    let mut count = binary_stl(&cube(1));
    count[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    let beyond = TETRAHEDRON.replace("f 1 4 3", "f 1 9 3");
    let mut index = binary_ply(&cube(1));
    let last = index.len() - 4;
    index[last..].copy_from_slice(&(-1i32).to_le_bytes());
    let lying = ply_header("binary_little_endian", "float", 4_000_000_000, 1);
    let empty_faces = "ply\nformat binary_little_endian 1.0\nelement face 4000000000\nend_header\n";
    vec![
        file(
            "ascii_truncated.ply",
            cut(text, in_vertices),
            "Truncated",
            "ends among its vertices (ASCII)",
        ),
        file("empty.obj", Vec::new(), "Empty", "0 bytes"),
        file("empty.ply", Vec::new(), "Empty", "0 bytes"),
        file("empty.stl", Vec::new(), "Empty", "0 bytes"),
        file(
            "huge.obj",
            TETRAHEDRON.replace("0 0 1", "0 0 1e39").into(),
            "TooLarge",
            "a coordinate beyond f32",
        ),
        file("index.obj", beyond.into(), "IndexOutOfRange", "a face names vertex 9 of 4"),
        file("index.ply", index, "IndexOutOfRange", "a face names vertex -1"),
        file("lying_count.stl", count, "Truncated", "announces 4,294,967,295 triangles"),
        file(
            "lying_elements.ply",
            empty_faces.into(),
            "Malformed",
            "4,000,000,000 faces of no bytes each",
        ),
        file("lying_header.ply", lying.into(), "Truncated", "announces 4,000,000,000 vertices"),
        file("lying_list.ply", list, "Truncated", "a face announces 4,000,000,000 corners"),
        file(
            "nan.obj",
            TETRAHEDRON.replace("0 0 1", "0 nan 1").into(),
            "NotFinite",
            "a coordinate is NaN",
        ),
        file("nan.stl", nan, "NotFinite", "a coordinate is NaN"),
        file(
            "no_number.obj",
            TETRAHEDRON.replace("0 0 1", "0 O 1").into(),
            "Malformed",
            "the letter O for a zero",
        ),
        file("points.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\n".to_vec(), "NoTriangles", "points only"),
        file("text.stl", b"solid and sound\nnothing here\n".to_vec(), "Malformed", "prose"),
        file("tiny.obj", TINY.into(), "TooSmall", "size 1e-40"),
        file("truncated.ply", cut(ply, in_faces), "Truncated", "ends among its faces (binary)"),
        file("truncated.stl", cut(binary_stl(&small), 1000), "Truncated", "ends in a triangle"),
        file("unknown.xyz", b"0 0 0\n".to_vec(), "UnknownExtension", "not a mesh file by its name"),
    ]
}

fn no_solid() -> Vec<Evil> {
    use Outcome::NoSolid as N;
    let file =
        |name, bytes: Vec<u8>, outcome, flaw| Evil { name, bytes, outcome: N(outcome), flaw };
    let mut open = cube(2);
    open.1.truncate(open.1.len() - 8);
    let wall = joined(
        &cube(1),
        &(cube(1).0.iter().map(|p| [p[0] + 2.0, p[1], p[2]]).collect(), cube(1).1),
    );
    vec![
        file("flat.obj", FLAT.into(), "ZeroVolume", "a tetrahedron squashed flat"),
        file(
            "glued_cubes.stl",
            binary_stl(&wall),
            "NonManifoldEdges",
            "two cubes glued with the wall between left in",
        ),
        file(
            "glued_blocks.obj",
            obj(&glued_blocks()),
            "NonManifoldEdges",
            "three blocks in a row, each wall between two is in the file twice",
        ),
        file(
            "klein_bottle.obj",
            obj(&twisted_torus()),
            "NonOrientable",
            "a Klein bottle: closed but one-sided",
        ),
        file(
            "line.obj",
            b"v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n".to_vec(),
            "NoArea",
            "its triangle has no area",
        ),
        file("moebius.obj", obj(&moebius()), "Open", "a Möbius strip"),
        file(
            "non_manifold_edge.obj",
            SHARED_EDGE.into(),
            "NonManifoldEdges",
            "two tetrahedra share an edge",
        ),
        file("open_box.stl", binary_stl(&open), "Open", "a cube without its lid"),
        file("sheet.obj", SHEET.into(), "Open", "a square of two triangles that face down"),
        file("stuck_cap.obj", STUCK_CAP.into(), "Open", "a zero-area triangle on a hole's rim"),
        file(
            "t_junction.obj",
            T_JUNCTION.into(),
            "Open",
            "a vertex on an edge that does not know of it",
        ),
    ]
}

fn mendable() -> Vec<Evil> {
    let file = |name, bytes: Vec<u8>, flaw| Evil { name, bytes, outcome: Outcome::Accepted, flaw };
    let mut mixed = cube(2);
    mixed.1.iter_mut().step_by(3).for_each(|t| t.swap(1, 2));
    let cavity = joined(&cube(2), &inverted(&scaled(&cube(1), 0.5)));
    vec![
        file("bow_tie.obj", BOW_TIE.into(), "two tetrahedra share a vertex"),
        file("cap.obj", CAP.into(), "a zero-area triangle fills a T-junction"),
        file("cavity.stl", ascii_stl(&cavity), "nothing: a hollow cube"),
        file("coil.obj", obj(&coil(400.0, 80, 2.0)), "its end goes through its beginning"),
        file("inverted_cavity.stl", binary_stl(&inverted(&cavity)), "a hollow cube inside out"),
        file("inverted_cube.stl", binary_stl(&inverted(&cube(2))), "all triangles face inwards"),
        file(
            "map_sphere.obj",
            MAP_SPHERE.to_vec(),
            "map coordinates in doubles: f32 moves its vertices by up to 0.25",
        ),
        file(
            "mixed_winding.ply",
            binary_ply(&mixed),
            "a third of the triangles wound the wrong way",
        ),
        file("plugged_shell.obj", obj(&plugged_shell()), "a hollow box and the plug that fills it"),
        file("room.obj", obj(&room()), "nothing: a room whose walls face inwards"),
        file("negative_zero.obj", NEGATIVE_ZERO.into(), "0.0 and -0.0 for the same vertex"),
        file(
            "solid_binary.stl",
            solid_header(),
            "nothing: a binary file whose header starts with solid",
        ),
    ]
}

/// As it was reported.
const MAP_SPHERE: &[u8] = include_bytes!("../../../fixtures/evil/map_sphere.obj");

const TETRAHEDRON: &str =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
const TINY: &str =
    "v 0 0 0\nv 1e-40 0 0\nv 0 1e-40 0\nv 0 0 1e-40\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
const FLAT: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
const SHARED_EDGE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nv 0 0 -1\n\
    f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\nf 1 5 2\nf 1 2 6\nf 2 5 6\nf 1 6 5\n";
const BOW_TIE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv -1 0 0\nv 0 -1 0\nv 0 0 -1\n\
    f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\nf 1 5 6\nf 1 6 7\nf 6 5 7\nf 1 7 5\n";
const NEGATIVE_ZERO: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv -0 -0 -0\n\
    f 1 3 2\nf 5 2 4\nf 2 3 4\nf 1 4 3\n";
/// The edge 1–2 has a middle vertex, 5, on one side only.
const T_JUNCTION: &str =
    "v 0 0 0\nv 2 0 0\nv 0 1 0\nv 0 0 1\nv 1 0 0\nf 1 3 2\nf 1 5 4\nf 5 2 4\nf 2 3 4\nf 1 4 3\n";
/// As above, the slit filled by the triangle 1 2 5.
const CAP: &str = "v 0 0 0\nv 2 0 0\nv 0 1 0\nv 0 0 1\nv 1 0 0\nf 1 3 2\nf 1 2 5\nf 1 5 4\nf 5 2 4\nf 2 3 4\nf 1 4 3\n";
/// As above, but the face across the cap's long edge is missing.
const STUCK_CAP: &str =
    "v 0 0 0\nv 2 0 0\nv 0 1 0\nv 0 0 1\nv 1 0 0\nf 1 2 5\nf 1 5 4\nf 5 2 4\nf 2 3 4\nf 1 4 3\n";

/// Two triangles that face down.
const SHEET: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 3 2\nf 1 4 3\n";

/// A room from 0 to 10: a box whose walls face inwards.
#[must_use]
pub fn room() -> Triangles {
    inverted(&block([0.0; 3], [10.0; 3]))
}

/// Three closed blocks in a row along x, from 0 to 10, 11 and 21. Each has walls of its own.
#[must_use]
pub fn glued_blocks() -> Triangles {
    let along = |from: f32, to: f32| block([from, 0.0, 0.0], [to, 10.0, 10.0]);
    joined(&joined(&along(0.0, 10.0), &along(10.0, 11.0)), &along(11.0, 21.0))
}

/// A box from −10 to 10 with a cavity from −8 to 8, and the solid that fills the cavity.
#[must_use]
pub fn plugged_shell() -> Triangles {
    let plug = block([-8.0; 3], [8.0; 3]);
    joined(&joined(&block([-10.0; 3], [10.0; 3]), &inverted(&plug)), &plug)
}

fn solid_header() -> Vec<u8> {
    let mut bytes = binary_stl(&cube(1));
    bytes[..11].copy_from_slice(b"solid part\n");
    bytes
}

/// A torus glued with a reflection: going once around, the tube comes back mirrored.
fn twisted_torus() -> Triangles {
    let (n, m) = (8u32, 7u32);
    let (positions, _) = torus(2.0, 1.0, n as usize, m as usize);
    let at = |i: u32, j: u32| if i == n { (m - j % m) % m } else { i * m + j % m };
    grid(positions, n, m, at)
}

/// A strip of four rows, glued with a half turn. Positions are those of a flat band: only the
/// topology matters.
fn moebius() -> Triangles {
    let (n, rows) = (8u32, 3u32);
    let (ring, _) = torus(2.0, 1.0, n as usize, 6);
    let positions = (0..n)
        .flat_map(|i| (0..=rows).map(move |j| (i, j)))
        .map(|(i, j)| ring[(i * 6 + j) as usize]);
    let at = |i: u32, j: u32| if i == n { rows - j } else { i * (rows + 1) + j };
    grid(positions.collect(), n, rows, at)
}

fn grid(positions: Vec<[f32; 3]>, n: u32, m: u32, at: impl Fn(u32, u32) -> u32) -> Triangles {
    let mut triangles = Vec::new();
    for i in 0..n {
        for j in 0..m {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    (positions, triangles)
}
