//! No distance lies outside of the proved interval.

use meshsweep::builder::{For, SdfKind, SdfLayout};
use meshsweep::mesh::RawMesh;
use meshsweep::{BuildError, Builder};
use meshsweep_host_tests::generate::evil::glued_blocks;
use meshsweep_host_tests::generate::{
    Rng, Triangles, block, bracket, icosphere, joined, plate, rough_sphere, scaled, transformed,
};
use meshsweep_host_tests::oracle::field::Field;
use meshsweep_host_tests::oracle::{distance_to_mesh, winding_number};

/// Points of each field: half anywhere in it, half next to the surface.
const POINTS: usize = 600;

const KINDS: [SdfKind; 3] = [SdfKind::Surface, SdfKind::Signed, SdfKind::Solid];

fn built(
    (positions, triangles): &Triangles,
    kind: SdfKind,
    layout: SdfLayout,
    bytes: u32,
) -> Option<Vec<u8>> {
    let builder = Builder::new().serve(For::Sdf).sdf_kind(kind).sdf_layout(layout).sdf_bytes(bytes);
    match builder.build(RawMesh::from_f32(positions, triangles)) {
        // The widths of a few large leaves about a thin wall may have no room. By default such a
        // field is a lattice.
        Err(BuildError::FieldTooWide { .. }) if layout == SdfLayout::Tree => None,
        built => Some(built.expect("builds").into_bytes()),
    }
}

/// A point of the field: anywhere, or near a place of a triangle.
fn point(
    field: &Field,
    (positions, triangles): &Triangles,
    rng: &mut Rng,
    number: usize,
) -> [f32; 3] {
    let [low, high] = field.bounds();
    if number.is_multiple_of(2) {
        return [0, 1, 2].map(|k| (low[k] + (high[k] - low[k]) * rng.unit_f64()) as f32);
    }
    let triangle = triangles[rng.below(triangles.len())];
    let (a, b) = (rng.unit_f64(), rng.unit_f64());
    let (a, b) = if a + b > 1.0 { (1.0 - a, 1.0 - b) } else { (a, b) };
    let cell = if field.is_tree() { 8192.0 } else { 2048.0 } / field.per_unit;
    let off = cell * [0.0, 0.01, 0.3][rng.below(3)];
    [0, 1, 2].map(|k| {
        let [p, q, r] = triangle.map(|v| f64::from(positions[v as usize][k]));
        (p + a * (q - p) + b * (r - p) + off * (2.0 * rng.unit_f64() - 1.0)) as f32
    })
}

/// Asserts that the interval of each drawn point holds the distance of its kind. The points that
/// were in the field.
fn assert_holds(name: &str, mesh: &Triangles, field: &Field, seed: u64) -> usize {
    let (positions, triangles) = mesh;
    let mut rng = Rng::new(seed);
    let mut count = 0;
    for number in 0..POINTS {
        let p = point(field, mesh, &mut rng, number);
        let Some([low, high]) = field.interval(p) else { continue };
        count += 1;
        let distance = distance_to_mesh(p, positions, triangles);
        let [least, most] = [distance.lower, distance.upper].map(|d| d * field.per_unit);
        let winding = winding_number(p.map(f64::from), positions, triangles, 1.0 / field.per_unit);
        // As far as f64 tells. Places of two sides must hold both.
        let is = |number: f64| (winding - number).abs() < 1e-3;
        let (is_out, is_in) = (is(0.0), is(1.0) || is(-1.0));
        // Rounding of the point's place in this test.
        let room = 1e-6;
        let assert_most = |most: f64| assert!(most <= high + room, "{name} {p:?}: {most} > {high}");
        let assert_least =
            |least: f64| assert!(low - room <= least, "{name} {p:?}: {low} > {least}");
        match field.kind {
            0 => {
                assert_most(least);
                assert_least(most);
            }
            1 => {
                if is_out || !is_in {
                    assert_most(least);
                    assert_least(if is_out { most } else { -least });
                }
                if is_in {
                    assert_most(-most);
                    assert_least(-least);
                }
            }
            _ => {
                if is_out || !is_in {
                    assert_most(least);
                }
                assert_least(if is_out { most } else { 0.0 });
            }
        }
    }
    count
}

fn check(name: &str, mesh: &Triangles, kinds: &[SdfKind], bytes: u32) {
    for (number, &kind) in kinds.iter().enumerate() {
        for layout in SdfLayout::ALL {
            let Some(bytes) = built(mesh, kind, layout, bytes) else { continue };
            let field = Field::of(&bytes);
            assert_eq!(field.kind, kind as u8);
            assert_eq!(field.is_tree(), layout == SdfLayout::Tree);
            let name = format!("{name} {kind:?} {layout:?}");
            let count = assert_holds(&name, mesh, &field, number as u64);
            assert!(count > POINTS / 2, "{name}: {count} points in the field");
        }
    }
}

fn moved(mesh: &Triangles, by: [f32; 3]) -> Triangles {
    transformed(mesh, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], by)
}

#[test]
fn no_distance_of_a_bracket_lies_outside() {
    check("bracket", &bracket(), &KINDS, 1024);
}

#[test]
fn no_distance_of_round_meshes_lies_outside() {
    check("sphere", &icosphere(3), &KINDS, 1024);
    check("rough sphere", &rough_sphere(3, 0.2, 7), &KINDS, 1024);
}

#[test]
fn no_distance_of_thin_plates_lies_outside() {
    check("plate", &plate([0.3, 0.1], 0.004), &KINDS, 700);
    check("flat plate", &plate([0.0, 0.0], 1e-6), &KINDS, 500);
}

#[test]
fn no_distance_of_touching_solids_lies_outside() {
    // Walls that are the same triangles are merged, and tell no sides.
    check("glued blocks", &glued_blocks(), &[SdfKind::Surface], 800);
    let on_face = joined(&block([0.0; 3], [1.0; 3]), &block([1.0, 0.2, 0.3], [2.0, 0.7, 0.8]));
    check("blocks at a face", &on_face, &KINDS, 500);
    let on_edge = joined(&block([0.0; 3], [1.0; 3]), &block([1.0, 1.0, 0.0], [2.0, 2.0, 1.0]));
    check("blocks at an edge", &on_edge, &KINDS, 500);
}

#[test]
fn no_distance_of_an_open_sheet_lies_outside() {
    let (positions, triangles) = block([0.0; 3], [3.0, 2.0, 1.0]);
    let sheet = (positions, triangles[..6].to_vec());
    check("sheet", &sheet, &[SdfKind::Surface], 800);
}

#[test]
fn no_distance_of_a_mesh_that_crosses_itself_lies_outside() {
    let crossed = joined(&icosphere(2), &moved(&icosphere(2), [0.9, 0.3, 0.2]));
    check("crossed spheres", &crossed, &KINDS, 800);
    let blocks = joined(&block([0.0; 3], [2.0; 3]), &block([1.0; 3], [3.0, 2.5, 2.5]));
    check("crossed blocks", &blocks, &KINDS, 800);
}

#[test]
fn no_distance_of_a_triangle_lies_outside() {
    let triangle = (vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.2], [0.3, 0.8, 0.1]], vec![[0, 1, 2]]);
    check("triangle", &triangle, &[SdfKind::Surface], 800);
    let needle = (vec![[0.0, 0.0, 0.0], [1.0, 1e-7, 0.2], [0.5, 0.0, 0.1]], vec![[0, 1, 2]]);
    check("needle", &needle, &[SdfKind::Surface], 800);
}

#[test]
fn no_distance_lies_outside_at_any_scale_or_far_from_the_origin() {
    let part = rough_sphere(2, 0.3, 3);
    for scale in [1e-30, 1e30] {
        check(&format!("scale {scale}"), &scaled(&part, scale), &KINDS, 1024);
    }
    check("far", &moved(&part, [4e6, -3e5, 1e3]), &KINDS[1..2], 1024);
    check("far block", &moved(&block([0.0; 3], [3.0, 2.0, 1.0]), [1e7; 3]), &KINDS[1..2], 1024);
}
