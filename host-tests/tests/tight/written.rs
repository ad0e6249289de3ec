//! Hulls and triboxes hold the points of the file as they are written, before vertices are rounded
//! to `f32`: by integers, of the text's decimals.

use meshsweep::BuildError;
use meshsweep::builder::{Builder, For};
use meshsweep::check::{Outcome, verify_file};
use meshsweep::hull::{BuildOptions, enclosing_input, hull_of, mesh_of};
use meshsweep::load::{Loaded, Source};
use meshsweep::mesh::{Mesh, RawMesh, read_bytes};
use meshsweep::progress::Watch;
use meshsweep::tight::{Goal, Options, wrap};
use meshsweep::tribox::{Hierarchy, SplitOptions, box_tree, proxies, surface};
use meshsweep_core::{Bvh, Focus, RefinedHull};
use meshsweep_host_tests::generate::{Rng, icosphere, torus};
use meshsweep_host_tests::oracle::Around;
use std::fmt::Write;
use std::path::Path;

/// The sphere of `fixtures/evil`.
fn map_sphere() -> String {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fixtures/evil/map_sphere.obj");
    std::fs::read_to_string(file).expect("the fixture is there")
}

fn raw(text: &str) -> RawMesh {
    read_bytes(Path::new("written.obj"), text.as_bytes().to_vec()).expect("it reads")
}

fn loaded(text: &str) -> Loaded {
    Source::of(raw(text), None).and_then(|source| source.repaired()).expect("it loads")
}

fn obj(points: impl Iterator<Item = [String; 3]>, triangles: &[[u32; 3]]) -> String {
    let mut text = String::new();
    for [x, y, z] in points {
        let _ = writeln!(text, "v {x} {y} {z}");
    }
    for [a, b, c] in triangles {
        let _ = writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1);
    }
    text
}

fn encloses(text: &str, hull: &Mesh) -> Result<(), String> {
    Around::new(text, &hull.positions, &hull.triangles).encloses()
}

fn tight(text: &str, goal: Goal) -> Mesh {
    let loaded = loaded(text);
    let options = Options::new(goal).with_effort(0.02);
    wrap(loaded.input(), &options, Watch::NONE).expect("there is a hull").mesh
}

fn progressive(text: &str, faces: usize) -> Mesh {
    let loaded = loaded(text);
    hull_of(loaded.input(), faces, &BuildOptions::default(), Watch::NONE)
        .expect("there is a hull")
        .0
}

fn triboxes(text: &str, leaves: usize) -> Mesh {
    let mesh = loaded(text).mesh;
    let tree = box_tree(&mesh).expect("a tree");
    let tree = Bvh::open(&tree).expect("opens");
    let options = SplitOptions::default().with_leaves(leaves);
    let hierarchy = Hierarchy::new(&mesh, &tree, &options).expect("triboxes");
    surface(&proxies(&hierarchy, usize::MAX))
}

/// The text with every coordinate away from the middle multiplied.
fn larger(text: &str, factor: f64) -> String {
    let raw = raw(text);
    let middle = [500_123.456, 5_200_456.789, 412.3];
    let point =
        |p: &[f64; 3]| [0, 1, 2].map(|k| (middle[k] + factor * (p[k] - middle[k])).to_string());
    obj(raw.positions.iter().map(point), &raw.triangles)
}

/// A torus of outer size 13, in decimals of seven places.
fn decimal_torus() -> String {
    let (positions, triangles) = torus(10.0, 3.0, 16, 10);
    let mut rng = Rng::new(5);
    let point = |p: &[f32; 3]| {
        let turned = |k: usize| f64::from(p[k]) * 0.9 + f64::from(p[(k + 1) % 3]) * 0.3;
        [0, 1, 2].map(|k| format!("{:.7}", turned(k) + 1e-7 * rng.unit_f64()))
    };
    let points: Vec<[String; 3]> = positions.iter().map(point).collect();
    obj(points.into_iter(), &triangles)
}

#[test]
fn a_tight_hull_within_a_slack_encloses_a_mesh_in_map_coordinates() {
    let text = map_sphere();
    assert_eq!(encloses(&text, &tight(&text, Goal::Slack(1.5))), Ok(()));
}

#[test]
fn a_tight_hull_of_few_faces_encloses_a_mesh_in_map_coordinates() {
    for factor in [1.0, 4.0] {
        let text = larger(&map_sphere(), factor);
        assert_eq!(encloses(&text, &tight(&text, Goal::Faces(600))), Ok(()), "{factor}");
    }
}

#[test]
fn a_progressive_hull_encloses_a_mesh_in_map_coordinates() {
    for (factor, faces) in [(1.0, 300), (4.0, 300), (1.0, 1280)] {
        let text = larger(&map_sphere(), factor);
        assert_eq!(encloses(&text, &progressive(&text, faces)), Ok(()), "{factor} {faces}");
    }
}

#[test]
fn triboxes_hold_a_mesh_in_map_coordinates() {
    let text = map_sphere();
    for leaves in [1, 8, 64] {
        let drawn = triboxes(&text, leaves);
        let around = Around::new(&text, &drawn.positions, &drawn.triangles);
        assert_eq!(around.holds_points(), Ok(()), "{leaves}");
    }
}

#[test]
fn stored_hulls_enclose_a_mesh_in_map_coordinates_and_are_proved_of_the_file() {
    let text = map_sphere();
    let wanted = [For::Hull, For::Tight, For::Triboxes];
    let built = Builder::new().serve_all(wanted).build(raw(&text)).expect("builds");
    let blob = built.blob();
    let found = verify_file(blob.bytes(), &raw(&text));
    // Triboxes, tight hulls, and the surface error of the hierarchy.
    assert_eq!(found.len(), 3, "{found:?}");
    assert!(found.iter().all(|finding| finding.outcome == Outcome::Proved), "{found:?}");
    let hierarchy = blob.hull().expect("has hulls");
    for level in hierarchy.levels() {
        let hull = mesh_of(&hierarchy, hierarchy.faces(&level));
        let hull = enclosing_input(&hierarchy, &hull).expect("can be moved");
        assert_eq!(encloses(&text, &hull), Ok(()), "{level:?}");
    }
    let mut refined = Box::new(RefinedHull::<2000>::new());
    let focus = Focus::Ball { centre: [500_130.0, 5_200_470.0, 412.0], radius: 5.0 };
    refined.update(&hierarchy, &focus, 0.0, &mut []).expect("refines");
    let hull = enclosing_input(&hierarchy, &mesh_of(&hierarchy, refined.faces(&hierarchy)));
    assert_eq!(encloses(&text, &hull.expect("can be moved")), Ok(()));
    let tight = blob.tight_hulls().expect("has tight hulls").get(0).expect("one");
    assert_eq!(encloses(&text, &meshsweep::tight::hull_mesh(&tight)), Ok(()));
}

#[test]
fn a_hull_of_the_rounded_mesh_is_not_proved_of_the_file() {
    let text = map_sphere();
    let rounded = loaded(&text).mesh;
    let rounded = RawMesh::from_f32(&rounded.positions, &rounded.triangles);
    let built = Builder::new().serve(For::Tight).tight_faces(&[600]).build(rounded.clone());
    let built = built.expect("builds");
    let outcome = |raw: &RawMesh| verify_file(built.blob().bytes(), raw)[0].outcome;
    assert_eq!(outcome(&rounded), Outcome::Proved);
    assert_eq!(outcome(&raw(&text)), Outcome::Failed);
}

#[test]
fn hulls_of_a_torus_in_decimals_enclose_it() {
    let text = decimal_torus();
    assert_eq!(encloses(&text, &tight(&text, Goal::Faces(40))), Ok(()));
    assert_eq!(encloses(&text, &tight(&text, Goal::Slack(0.5))), Ok(()));
    assert_eq!(encloses(&text, &progressive(&text, 100)), Ok(()));
    let drawn = triboxes(&text, 16);
    assert_eq!(Around::new(&text, &drawn.positions, &drawn.triangles).holds_points(), Ok(()));
}

/// A number of random digits near `x`.
fn decimal(rng: &mut Rng, x: f64) -> String {
    let places = 3 + rng.below(17);
    match rng.below(3) {
        _ if x == 0.0 => "0.0".to_owned(),
        0 => format!("{x:.places$e}"),
        1 => format!("{x:e}"),
        _ => {
            // More digits than an f64 has.
            let text = format!("{x:e}");
            let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
            let point = if digits.contains('.') { "" } else { ".00000000000000" };
            format!("{digits}{point}{:09}e{exponent}", rng.below(1_000_000_000))
        }
    }
}

#[test]
fn hulls_of_random_meshes_in_random_decimals_enclose_them() {
    let mut rng = Rng::new(31);
    let frames: [([f64; 3], f64); 7] = [
        ([5e5, 5e6, 1e2], 10.0),
        ([5e5, 5e6, 1e2], 1000.0),
        ([0.0; 3], 1.0),
        ([0.3, -7.1, 2e3], 0.1),
        ([0.0; 3], 1e-30),
        ([0.0; 3], 1e30),
        ([1e-31, 2e-30, 0.0], 1e-30),
    ];
    for round in 0..2 {
        for (origin, size) in frames {
            let (positions, triangles) =
                if round == 1 { torus(2.0, 0.8, 12, 8) } else { icosphere(2) };
            let mut bump = 0.0;
            let points: Vec<[String; 3]> = positions
                .iter()
                .map(|p| {
                    bump = 0.9 + 0.1 * rng.unit_f64();
                    [0, 1, 2].map(|k| decimal(&mut rng, origin[k] + size * bump * f64::from(p[k])))
                })
                .collect();
            let text = obj(points.into_iter(), &triangles);
            let what = format!("round {round}, {size:e} at {origin:?}");
            assert!(loaded(&text).error() > 0.0, "{what}");
            assert_eq!(encloses(&text, &tight(&text, Goal::Faces(80))), Ok(()), "{what}");
            let loaded = loaded(&text);
            match hull_of(loaded.input(), 100, &BuildOptions::default(), Watch::NONE) {
                Ok((hull, ..)) => assert_eq!(encloses(&text, &hull), Ok(()), "{what}"),
                Err(BuildError::NotEnclosed { .. }) => {}
                Err(error) => panic!("{what}: {error}"),
            }
            let drawn = triboxes(&text, 8);
            let around = Around::new(&text, &drawn.positions, &drawn.triangles);
            assert_eq!(around.holds_points(), Ok(()), "{what}");
        }
    }
}

#[test]
fn hulls_of_loose_triangles_in_decimals_enclose_them() {
    let mut rng = Rng::new(8);
    for size in [1e-30, 1.0, 1e30] {
        let points: Vec<[String; 3]> = (0..18)
            .map(|_| {
                let p: [f64; 3] = [rng.unit_f64(), rng.unit_f64(), rng.unit_f64()];
                p.map(|x| decimal(&mut rng, size * (x - 0.5)))
            })
            .collect();
        let triangles: Vec<[u32; 3]> = (0..6).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
        let text = obj(points.into_iter(), &triangles);
        assert_eq!(encloses(&text, &tight(&text, Goal::Faces(80))), Ok(()), "{size:e}");
    }
}

#[test]
fn a_progressive_hull_that_is_not_proved_to_enclose_the_file_is_refused() {
    // Two spheres that cross each other.
    let (positions, triangles) = icosphere(2);
    let place = |x: f64| {
        move |p: &[f32; 3]| {
            [0, 1, 2].map(|k| (0.1 + f64::from(p[k]) + if k == 0 { x } else { 0.0 }).to_string())
        }
    };
    let count = positions.len() as u32;
    let both: Vec<[u32; 3]> =
        triangles.iter().copied().chain(triangles.iter().map(|t| t.map(|v| v + count))).collect();
    let text = obj(positions.iter().map(place(0.0)).chain(positions.iter().map(place(1.0))), &both);
    let loaded = loaded(&text);
    let found = hull_of(loaded.input(), 100, &BuildOptions::default(), Watch::NONE);
    assert!(matches!(found, Err(BuildError::NotEnclosed { error }) if error > 0.0), "{found:?}");
    assert_eq!(encloses(&text, &tight(&text, Goal::Faces(100))), Ok(()));
}

#[test]
fn a_mesh_of_f32_numbers_has_the_same_hulls_however_it_is_written() {
    let (positions, triangles) = torus(10.0, 3.0, 12, 8);
    let wide = |p: &[f32; 3]| p.map(|x| format!("{:.60}", f64::from(x)));
    let shortest = |p: &[f32; 3]| p.map(|x| f64::from(x).to_string());
    let texts = [
        obj(positions.iter().map(wide), &triangles),
        obj(positions.iter().map(shortest), &triangles),
    ];
    let in_memory = Mesh::new(positions, triangles);
    let wrapped = wrap(&in_memory, &Options::new(Goal::Faces(60)).with_effort(0.02), Watch::NONE);
    let wrapped = wrapped.expect("a hull").mesh;
    let collapsed =
        hull_of(&in_memory, 60, &BuildOptions::default(), Watch::NONE).expect("a hull").0;
    for text in texts {
        assert_eq!(loaded(&text).error(), 0.0);
        assert_eq!(tight(&text, Goal::Faces(60)).positions, wrapped.positions);
        assert_eq!(progressive(&text, 60).positions, collapsed.positions);
    }
}
