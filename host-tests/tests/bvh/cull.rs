//! No triangle that faces the eye is ever culled: against every triangle, in f64, but for triangles
//! within 1e-15 of edge-on.

use meshsweep::bvh::{TreeOptions, build};
use meshsweep::mesh::Mesh;
use meshsweep::progress::Watch;
use meshsweep_core::{BuildFor, Bvh, Eye, QueryError};
use meshsweep_host_tests::generate::{
    Rng, Triangles, bracket, cube, icosphere, inverted, joined, needle_comb, rough_sphere, scaled,
    torus, transformed,
};

fn blob((positions, triangles): &Triangles, options: &TreeOptions) -> Vec<u8> {
    let mesh = Mesh::new(positions.clone(), triangles.clone());
    build(mesh.as_input(), options, Watch::NONE).expect("builds").0.to_bytes()
}

fn culling(single: bool) -> TreeOptions {
    TreeOptions::default().with_cull(true).with_f32(single)
}

/// Corners of all triangles as stored, input units, by number in the input file. Products of two
/// are exact in f64.
fn stored(tree: &Bvh<'_>) -> Vec<(u32, [[f64; 3]; 3])> {
    let unit = (f64::from(tree.scale_exponent() + tree.header().grid_exponent)).exp2();
    let mut triangles = Vec::new();
    for node in 0..tree.header().nodes {
        let links = tree.links(node).unwrap();
        for lane in links.inner..links.count {
            let patch = tree.leaf(node, lane).unwrap();
            for place in 0..patch.shape().triangles() {
                let number = tree.source(links.triangle(lane) + place as u32).unwrap();
                let corners =
                    patch.corners(place).map(|c| c.to_array().map(|x| f64::from(x) * unit));
                triangles.push((number, corners));
            }
        }
    }
    triangles
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    core::array::from_fn(|k| a[k] - b[k])
}

fn cross([a, b, c]: [f64; 3], [d, e, f]: [f64; 3]) -> [f64; 3] {
    [b * f - c * e, c * d - a * f, a * e - b * d]
}

/// Whether a triangle may face the eye: the triple product in f64, positive by more than it can be
/// off.
fn faces([a, b, c]: [[f64; 3]; 3], sight: &Eye) -> bool {
    let (e, g) = (minus(b, a), minus(c, a));
    let way = match sight {
        Eye::At(eye) => minus(eye.map(f64::from), a),
        Eye::Along(along) => along.map(|x| -f64::from(x)),
        other => panic!("{other:?}"),
    };
    let n = cross(e, g);
    let size = |v: [f64; 3]| v.iter().map(|x| x.abs()).sum::<f64>();
    (0..3).map(|k| n[k] * way[k]).sum::<f64>() > 1.0e-15 * size(e) * size(g) * size(way)
}

fn meshes() -> Vec<(&'static str, Triangles)> {
    let (positions, mut triangles) = rough_sphere(3, 0.3, 9);
    triangles.extend_from_within(..40);
    triangles.extend([[0, 0, 1], [2, 2, 2], [3, 4, 3], [0, 1, 9], [1, 0, 11]]);
    vec![
        ("torus", torus(2.0, 0.75, 40, 24)),
        ("icosphere", icosphere(4)),
        ("soup", (positions, triangles)),
        ("both sides", joined(&torus(2.0, 0.75, 20, 12), &inverted(&torus(2.0, 0.75, 20, 12)))),
        ("needles", needle_comb()),
        ("bracket", bracket()),
        ("cube", cube(8)),
        (
            "flat",
            transformed(&cube(4), [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.0]], [0.0; 3]),
        ),
        (
            "far from its origin",
            transformed(
                &bracket(),
                [[0.1, 0.0, 0.0], [0.0, 0.1, 0.0], [0.0, 0.0, 0.1]],
                [900.0, -7.0, 0.5],
            ),
        ),
        ("small", scaled(&torus(2.0, 0.75, 12, 8), 1.0e-12)),
    ]
}

/// Eyes all around, near, far, at vertices and in the planes of triangles; and directions.
fn sights(mesh: &Triangles, rng: &mut Rng) -> Vec<Eye> {
    let size = mesh.0.iter().flatten().fold(0.0, |most: f32, x| most.max(x.abs()));
    let mut sights = Vec::new();
    for _ in 0..30 {
        let way = rng.direction();
        for far in [0.3, 1.0, 3.0, 1.0e3, 1.0e12] {
            sights.push(Eye::At(way.map(|x| x * far * size)));
        }
        sights.push(Eye::Along(way));
        sights.push(Eye::Along(way.map(|x| x * 1.0e25)));
        let [a, b, c] = mesh.1[rng.below(mesh.1.len())].map(|v| mesh.0[v as usize]);
        sights.push(Eye::At(a));
        let (v, w) = (rng.range(-3.0, 3.0), rng.range(-3.0, 3.0));
        sights
            .push(Eye::At(core::array::from_fn(|k| a[k] + v * (b[k] - a[k]) + w * (c[k] - a[k]))));
    }
    for axis in 0..3 {
        for sign in [-1.0, 1.0] {
            let mut way = [0.0; 3];
            way[axis] = sign;
            sights.extend([Eye::Along(way), Eye::At(way.map(|x| x * 5.0 * size))]);
        }
    }
    sights
}

#[test]
fn no_triangle_that_faces_the_eye_is_culled() {
    for (name, mesh) in meshes() {
        for single in [false, true] {
            let bytes = blob(&mesh, &culling(single));
            let tree = Bvh::open(&bytes).unwrap();
            let triangles = stored(&tree);
            let mut out = vec![0; triangles.len()];
            for sight in sights(&mesh, &mut Rng::new(11)) {
                let found = tree.front_facing(sight, &mut out).unwrap();
                let kept = &out[..found.stored];
                assert_eq!(
                    (found.dropped, found.stored + found.culled as usize),
                    (0, triangles.len())
                );
                let mut left = vec![true; mesh.1.len()];
                kept.iter().for_each(|&number| left[number as usize] = false);
                for (number, corners) in &triangles {
                    assert!(
                        !left[*number as usize] || !faces(*corners, &sight),
                        "{name}, {sight:?}: triangle {number} faces the eye"
                    );
                }
            }
        }
    }
}

#[test]
fn most_of_a_smooth_back_is_culled() {
    let mesh = icosphere(5);
    let bytes = blob(&mesh, &culling(false));
    let tree = Bvh::open(&bytes).unwrap();
    let mut out = vec![0; mesh.1.len()];
    for sight in [Eye::At([0.0, 0.3, 50.0]), Eye::Along([0.5, -0.2, 1.0])] {
        let found = tree.front_facing(sight, &mut out).unwrap();
        let backs = stored(&tree).iter().filter(|(_, corners)| !faces(*corners, &sight)).count();
        assert!(f64::from(found.culled) > 0.8 * backs as f64, "{found:?} of {backs}");
    }
}

#[test]
fn a_flat_face_is_culled_exactly() {
    let mesh = cube(8);
    let bytes = blob(&mesh, &culling(false));
    let tree = Bvh::open(&bytes).unwrap();
    let found =
        tree.front_facing(Eye::Along([0.2, 0.3, -1.0]), &mut vec![0; mesh.1.len()]).unwrap();
    // Leaves over an edge see both faces.
    assert!(
        found.culled as usize > mesh.1.len() / 3 && found.culled as usize <= mesh.1.len() / 2,
        "{found:?}"
    );
}

#[test]
fn what_does_not_fit_is_counted() {
    let mesh = torus(2.0, 0.75, 40, 24);
    let bytes = blob(&mesh, &culling(false));
    let tree = Bvh::open(&bytes).unwrap();
    let sight = Eye::At([5.0, 4.0, 3.0]);
    let mut all = vec![0; mesh.1.len()];
    let whole = tree.front_facing(sight, &mut all).unwrap();
    for room in [0, 1, 17, whole.stored] {
        let mut some = vec![u32::MAX; room];
        let found = tree.front_facing(sight, &mut some).unwrap();
        assert_eq!(some, all[..room]);
        let (mut expected, dropped) = (whole, (whole.stored - room) as u32);
        (expected.stored, expected.dropped) = (room, dropped);
        assert_eq!(found, expected);
    }
}

#[test]
fn refusals_are_typed_and_a_direction_of_no_length_leaves_nothing_out() {
    let mesh = torus(2.0, 0.75, 12, 8);
    let plain = blob(&mesh, &TreeOptions::default());
    let with = blob(&mesh, &culling(false));
    let eye = Eye::At([5.0, 4.0, 3.0]);
    let refusal = Bvh::open(&plain).unwrap().front_facing(eye, &mut []).unwrap_err();
    assert_eq!(refusal, QueryError::NotServed { build_for: BuildFor::Cull });
    let tree = Bvh::open(&with).unwrap();
    for nan in [Eye::At([f32::NAN, 0.0, 0.0]), Eye::Along([0.0, f32::INFINITY, 0.0])] {
        assert_eq!(tree.front_facing(nan, &mut []), Err(QueryError::NotFinite));
    }
    assert_eq!(tree.front_facing(Eye::Along([0.0; 3]), &mut []).unwrap().culled, 0);
}

#[test]
fn cones_take_four_bytes_a_leaf() {
    let mesh = torus(2.0, 0.75, 40, 24);
    let (plain, with) = (blob(&mesh, &TreeOptions::default()), blob(&mesh, &culling(false)));
    let leaves = Bvh::open(&with).unwrap().header().leaves as usize;
    // And an entry of the section table.
    assert_eq!(with.len(), plain.len() + 4 * leaves + 16);
}
