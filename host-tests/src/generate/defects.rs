//! The ways in which a mesh may be bad, each as a change of a cube of 48 triangles. They can be
//! made one after the other.

use super::{Triangles, cube};

/// Positions as in a file, and triangles.
pub type Raw = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// One way to spoil a mesh.
#[derive(Clone, Copy, Debug)]
pub struct Defect {
    /// Its name.
    pub name: &'static str,
    /// Makes it.
    pub spoil: fn(&mut Raw),
    /// The findings of `repair`, by key; each is counted at least once.
    pub found: &'static [&'static str],
    /// The variant of `MeshError` with which the mesh is refused for any structure.
    pub unreadable: Option<&'static str>,
    /// The variant with which it is refused for a hull.
    pub no_solid: Option<&'static str>,
}

/// A mesh without a defect.
#[must_use]
pub fn sound() -> Raw {
    wide(cube(2))
}

/// All of them.
#[must_use]
pub fn defects() -> Vec<Defect> {
    let mended =
        |name, spoil, found| Defect { name, spoil, found, unreadable: None, no_solid: None };
    let unreadable = |name, spoil, error| Defect {
        name,
        spoil,
        found: &[],
        unreadable: Some(error),
        no_solid: None,
    };
    let no_solid = |name, spoil, error| Defect {
        name,
        spoil,
        found: &[],
        unreadable: None,
        no_solid: Some(error),
    };
    vec![
        mended("duplicate vertices", duplicate_vertices, &["welded"]),
        mended("duplicate triangles", |(_, t)| t.push(t[1]), &["duplicate"]),
        mended("opposite triangles", opposite_triangles, &["opposite_duplicate"]),
        mended("flipped triangles", |(_, t)| t[3].swap(0, 1), &["rewound"]),
        no_solid("a hole", a_hole, "Open"),
        no_solid("a non-manifold edge", non_manifold_edge, "NonManifoldEdges"),
        mended("a non-manifold vertex", non_manifold_vertex, &["split_vertices"]),
        mended("a repeated corner", repeated_corner, &["repeated_corner"]),
        no_solid("a T-junction", t_junction, "Open"),
        mended("a zero-area triangle in a T-junction", cap, &["flipped_caps"]),
        // The middle vertex is on the line of the others.
        mended("a line", line, &["wires", "unreferenced"]),
        mended("a part that crosses another", |raw| part(raw, 1.0, [1.25, 0.5, 0.25]), &[]),
        mended("parts with a common plane", |raw| part(raw, 1.0, [0.0, 1.0, 0.5]), &[]),
        mended("a solid in a solid", |raw| part(raw, 0.25, [0.1, 0.2, 0.3]), &[]),
        mended("a cavity", cavity, &["cavities"]),
        mended("an isolated vertex", |(p, _)| p.push([7.0, 8.0, 9.0]), &["unreferenced"]),
        mended(
            "inside out",
            |(_, t)| t.iter_mut().for_each(|t| t.swap(0, 1)),
            &["turned_components"],
        ),
        mended("a thin plate", thin_plate, &[]),
        unreadable("NaN", |(p, _)| p[3][1] = f64::NAN, "NotFinite"),
        unreadable("infinity", |(p, _)| p[4][2] = f64::NEG_INFINITY, "NotFinite"),
        unreadable("a coordinate beyond f32", |(p, _)| p[2][0] = 1e39, "TooLarge"),
        unreadable("an index out of range", |(_, t)| t[4][2] = 9999, "IndexOutOfRange"),
        unreadable("no triangles", |(_, t)| t.clear(), "NoTriangles"),
    ]
}

fn wide((positions, triangles): Triangles) -> Raw {
    (positions.into_iter().map(|p| p.map(f64::from)).collect(), triangles)
}

fn push(positions: &mut Vec<[f64; 3]>, at: [f64; 3]) -> u32 {
    positions.push(at);
    positions.len() as u32 - 1
}

fn duplicate_vertices((positions, triangles): &mut Raw) {
    let at = positions[triangles[0][0] as usize];
    triangles[0][0] = push(positions, at);
}

fn opposite_triangles((_, triangles): &mut Raw) {
    let [a, b, c] = triangles[2];
    triangles.push([a, c, b]);
}

/// A closed fin on an edge: four triangles meet there.
fn non_manifold_edge((positions, triangles): &mut Raw) {
    let [a, b, _] = triangles[9];
    let [c, d] = [[3.0, 0.25, 2.0], [3.0, 2.5, 0.5]].map(|at| push(positions, at));
    triangles.extend([[a, b, c], [b, a, d], [c, b, d], [a, c, d]]);
}

fn non_manifold_vertex((positions, triangles): &mut Raw) {
    let (a, [x, y, z]) = (triangles[12][0], positions[triangles[12][0] as usize]);
    let tips = [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]];
    // Away from the cube, which is convex.
    let away = |s: f64| if s < 0.0 { -1.0 } else { 1.0 };
    let sign = [x, y, z].map(away);
    let place = |t: [f64; 3]| [x + sign[0] * t[0], y + sign[1] * t[1], z + sign[2] * t[2]];
    let [b, c, d] = tips.map(|t| push(positions, place(t)));
    let is_mirrored = sign[0] * sign[1] * sign[2] < 0.0;
    let wound = |[p, q, r]: [u32; 3]| if is_mirrored { [p, r, q] } else { [p, q, r] };
    triangles.extend([[a, c, b], [a, b, d], [b, c, d], [a, d, c]].map(wound));
}

fn repeated_corner((_, triangles): &mut Raw) {
    let [a, b, _] = triangles[15];
    triangles.push([a, b, a]);
}

/// Halves a triangle at the middle of a side; its neighbour does not know. Returns the side and
/// the middle.
fn halved((positions, triangles): &mut Raw, number: usize) -> [u32; 3] {
    let [a, b, c] = triangles[number];
    let middle =
        std::array::from_fn(|k| 0.5 * positions[a as usize][k] + 0.5 * positions[b as usize][k]);
    let m = push(positions, middle);
    triangles[number] = [a, m, c];
    triangles.push([m, b, c]);
    [a, b, m]
}

fn t_junction(raw: &mut Raw) {
    halved(raw, 18);
}

fn cap(raw: &mut Raw) {
    let [a, b, m] = halved(raw, 21);
    raw.1.push([a, b, m]);
}

fn line((positions, triangles): &mut Raw) {
    let ends = [[-3.0, 0.0, 0.5], [-4.0, 1.0, 0.5], [-5.0, 2.0, 0.5]];
    triangles.push(ends.map(|at| push(positions, at)));
}

fn part((positions, triangles): &mut Raw, size: f64, at: [f64; 3]) {
    let first = positions.len() as u32;
    let (corners, more) = wide(cube(1));
    positions.extend(corners.iter().map(|p| [0, 1, 2].map(|k| size * p[k] + at[k])));
    triangles.extend(more.iter().map(|t| t.map(|v| v + first)));
}

fn cavity(raw: &mut Raw) {
    let first = raw.1.len();
    part(raw, 0.125, [-0.5, -0.4, -0.3]);
    raw.1[first..].iter_mut().for_each(|t| t.swap(0, 1));
}

fn thin_plate(raw: &mut Raw) {
    let first = raw.0.len();
    part(raw, 1.0, [4.0, 4.0, 0.0]);
    raw.0[first..].iter_mut().for_each(|p| p[2] *= 1e-7);
}

fn a_hole((_, triangles): &mut Raw) {
    triangles.remove(5);
}
