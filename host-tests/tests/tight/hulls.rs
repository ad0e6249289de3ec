//! Tight hulls enclose what they were made of: proved from the two surfaces alone, by a checker
//! that shares no code with the builder.

use std::f64::consts::TAU;
use std::path::Path;
use std::time::Duration;

use meshsweep::BuildError;
use meshsweep::check::{Surface, check_enclosure, check_margin};
use meshsweep::hull::{BuildOptions, hull_of};
use meshsweep::mesh::{Mesh, NoVolume, RawMesh, Wire, read_bytes, repair};
use meshsweep::progress::Watch;
use meshsweep::tight::{Goal, Hull, Options, Outcome, Start, split_components, wrap};
use meshsweep_host_tests::generate::evil::evil;
use meshsweep_host_tests::generate::{
    Rng, Triangles, bracket, cube, groove_block, icosphere, inverted, joined, needle_comb,
    rough_sphere, scaled, torus, transformed, two_parts,
};
use meshsweep_host_tests::oracle::rough_distance_sq;

fn mesh_of((positions, triangles): &Triangles) -> Mesh {
    repair(RawMesh::from_f32(positions, triangles)).expect("a mesh").0
}

/// Little polish: what is shown here does not depend on how tight a hull is.
fn options(faces: usize) -> Options {
    Options::new(Goal::Faces(faces)).with_effort(0.02)
}

/// So few that all ways to begin compete, which takes seconds where it is not what a test is about.
const FEW: usize = 20;

fn proved(name: &str, mesh: &Mesh, options: &Options) -> Hull {
    let hull = wrap(mesh, options, Watch::NONE).unwrap_or_else(|e| panic!("{name}: {e}"));
    prove(name, mesh, &hull);
    hull
}

fn prove(name: &str, mesh: &Mesh, hull: &Hull) {
    let surface = |m: &Mesh| {
        let all: Vec<[u32; 3]> = m.all_triangles().collect();
        Surface::new(&m.positions, &all)
    };
    let proof = check_enclosure(&surface(mesh), &surface(&hull.mesh))
        .unwrap_or_else(|e| panic!("{name}: {e}"));
    assert_eq!(proof.inside, mesh.positions.len(), "{name}");
    assert_eq!(proof.faces, hull.report.faces, "{name}");
    let slack = hull.report.slack;
    assert!(
        0.0 <= slack.lower && slack.lower <= slack.upper && slack.upper.is_finite(),
        "{name}: {slack:?}"
    );
}

/// Turned, so that no face lies in a plane of coordinates.
fn turned(of: &Triangles) -> Triangles {
    let (s, c) = (0.6f32, 0.8f32);
    transformed(of, [[c, -s, 0.0], [s * c, c * c, -s], [s * s, s * c, c]], [0.3, -0.7, 0.1])
}

/// A sphere in a cavity of a larger one.
fn nested() -> Triangles {
    let shell = joined(&scaled(&icosphere(2), 4.0), &inverted(&scaled(&icosphere(2), 3.0)));
    joined(&shell, &icosphere(1))
}

/// A bowl with a narrow mouth: a sphere with a dent that is wider than its opening.
fn pocket() -> Triangles {
    let (n, rings) = (24usize, 30usize);
    let mut positions = vec![[0.0f32, 0.0, -2.0]];
    for ring in 1..rings {
        let t = ring as f64 / rings as f64;
        // Down the outside, over the lip, and into a chamber.
        let (radius, height) = if t < 0.5 {
            let a = TAU * 0.25 * (4.0 * t - 1.0);
            (2.0 * a.cos().max(0.15), 2.0 * a.sin())
        } else {
            let a = TAU * 0.25 * (4.0 * t - 1.0);
            (1.4 * (-a.cos()).max(0.1), 0.1 + 1.4 * a.sin())
        };
        for k in 0..n {
            let phi = TAU * k as f64 / n as f64;
            positions.push([
                (radius * phi.cos()) as f32,
                (radius * phi.sin()) as f32,
                height as f32,
            ]);
        }
    }
    positions.push([0.0, 0.0, -1.3]);
    let at = |ring: usize, k: usize| (1 + (ring - 1) * n + k % n) as u32;
    let last = positions.len() as u32 - 1;
    let mut triangles = Vec::new();
    for k in 0..n {
        triangles.push([0, at(1, k + 1), at(1, k)]);
        triangles.push([at(rings - 1, k), at(rings - 1, k + 1), last]);
        for ring in 1..rings - 1 {
            triangles.push([at(ring, k), at(ring, k + 1), at(ring + 1, k + 1)]);
            triangles.push([at(ring, k), at(ring + 1, k + 1), at(ring + 1, k)]);
        }
    }
    (positions, triangles)
}

/// A plate a thousand times as wide as thick.
fn plate() -> Triangles {
    transformed(&cube(8), [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.001]], [0.0; 3])
}

#[test]
fn hulls_of_closed_meshes_are_proved() {
    let meshes = [
        ("sphere", icosphere(3)),
        ("rough sphere", rough_sphere(3, 0.3, 7)),
        ("torus", torus(1.0, 0.3, 40, 20)),
        ("thin torus", torus(1.0, 0.01, 45, 8)),
        ("bracket", bracket()),
        ("cube", cube(4)),
        ("turned cube", turned(&cube(4))),
        ("groove", groove_block()),
        ("comb", needle_comb()),
        ("two parts", two_parts()),
        ("nested", nested()),
        ("pocket", pocket()),
        ("turned plate", turned(&plate())),
    ];
    for (name, of) in &meshes {
        let faces = if matches!(*name, "bracket" | "two parts") { FEW } else { 150 };
        let report = proved(name, &mesh_of(of), &options(faces)).report;
        assert!(report.faces <= faces && report.stop == Outcome::Reached, "{name}: {report:?}");
        assert!(report.void.unwrap() > 0.0, "{name}: {report:?}");
    }
}

#[test]
fn hulls_are_no_looser_than_progressive_hulls_of_as_many_faces() {
    // Blocks, of which a few dozen faces are the solid itself, and round ones.
    let blocks = [("groove", groove_block()), ("bracket", bracket()), ("cube", cube(4))];
    let round = [("torus", torus(1.0, 0.3, 40, 20)), ("rough sphere", rough_sphere(3, 0.3, 7))];
    let mut solids = 0;
    for (name, of) in blocks.iter().chain(&round) {
        let mesh = mesh_of(of);
        for faces in [12, 100, 300] {
            // With so few, all ways to begin compete, which takes longest.
            if faces == 12 && *name != "cube" {
                continue;
            }
            let (nested, void, _) =
                hull_of(&mesh, faces, &BuildOptions::default(), Watch::NONE).expect("a solid");
            if nested.triangles.len() > faces {
                continue;
            }
            let tight = proved(name, &mesh, &options(faces)).report;
            // The steps of single precision that it keeps off the mesh.
            let most = void.max(0.0) + 1e-5;
            let found = tight.void.expect("a solid");
            assert!(found <= most, "{name}, {faces} faces: {found:e}, progressive {void:e}");
            solids += usize::from(void <= 1e-12);
        }
    }
    assert!(solids >= 3, "{solids} hulls that are the solid itself");
}

#[test]
fn scale_and_place_do_not_matter() {
    for (factor, faces) in [(1e-36, FEW), (1e-30, 70), (1e30, 70), (1e36, 70)] {
        // Of few triangles where all ways to begin compete.
        let subdivisions = if faces == FEW { 1 } else { 2 };
        let mesh = mesh_of(&scaled(&rough_sphere(subdivisions, 0.3, 3), factor));
        proved(&format!("times {factor:e}"), &mesh, &options(faces));
    }
    for shift in [1e3, 1e6] {
        let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let mesh =
            mesh_of(&transformed(&torus(1.0, 0.4, 20, 10), identity, [shift, -shift, shift]));
        proved(&format!("moved by {shift:e}"), &mesh, &options(70));
    }
}

#[test]
fn triangles_of_any_kind_have_a_hull() {
    let few = options(FEW);
    let mut rng = Rng::new(0);
    let mut positions = Vec::new();
    for _ in 0..8 {
        let at = rng.point_in([-1.0; 3], [1.0; 3]);
        for _ in 0..3 {
            let d = rng.point_in([-0.4; 3], [0.4; 3]);
            positions.push([at[0] + d[0], at[1] + d[1], at[2] + d[2]]);
        }
    }
    let triangles = (0..8).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    let mesh = mesh_of(&(positions, triangles));
    let hull = proved("soup", &mesh, &options(100).with_effort(0.0));
    assert!(matches!(hull.report.start, Start::VoxelClosure { .. }), "{:?}", hull.report);
    assert!(matches!(hull.report.void, Err(NoVolume::Open { edges: 24, .. })));
    let (positions, mut triangles) = torus(1.0, 0.3, 40, 20);
    triangles.truncate(1000);
    let options = options(100).with_effort(0.0);
    proved("open torus", &mesh_of(&(positions, triangles)), &options);
    let one = (vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], vec![[0, 1, 2]]);
    proved("one triangle", &mesh_of(&one), &few);
    let crossing = joined(&icosphere(3), &turned(&cube(5)));
    proved("crossing parts", &mesh_of(&crossing), &options);
}

#[test]
fn wires_are_enclosed_with_the_mesh() {
    let mut mesh = mesh_of(&cube(2));
    // A segment in the surface, one across it, one that stands out, a point beside, and one inside.
    let wires = [
        [[-1.0, 0.0, 1.0], [1.0, 0.0, 1.0]],
        [[0.0, 0.0, 0.0], [0.0, 0.0, 1.5]],
        [[1.0, 1.0, 1.0], [2.0, 2.0, 1.0]],
        [[-2.0, 0.1, 0.2]; 2],
        [[0.1, 0.2, 0.3]; 2],
    ];
    for (source, ends) in (48..).zip(wires) {
        let first = mesh.positions.len() as u32;
        mesh.positions.extend(ends);
        mesh.wires.push(Wire { ends: [first, first + 1], source });
    }
    let triangles: Vec<[u32; 3]> = mesh.all_triangles().collect();
    let all = Surface::new(&mesh.positions, &triangles);
    for margin in [0.0, 0.1] {
        let options = options(100).with_margin(margin);
        let hull = wrap(&mesh, &options, Watch::NONE).unwrap();
        check_margin(&all, &Surface::new(&hull.mesh.positions, &hull.mesh.triangles), margin)
            .unwrap();
        assert!(hull.report.void.is_ok(), "the mesh is still a solid");
    }
    let counts: Vec<_> = split_components(&mesh)
        .unwrap()
        .iter()
        .map(|part| [part.triangles.len(), part.wires.len()])
        .collect();
    assert_eq!(counts, [[48, 2], [0, 1], [0, 1], [0, 1]], "three are at no vertex of the cube");
}

#[test]
fn a_short_time_has_a_hull_and_says_so() {
    let mesh = mesh_of(&rough_sphere(5, 0.3, 2));
    for micros in [0, 20_000] {
        let limit = Some(Duration::from_micros(micros));
        let hull = proved("hurried", &mesh, &options(200).with_time_limit(limit).with_effort(1e6));
        assert_eq!(hull.report.stop, Outcome::OutOfTime);
    }
}

#[test]
fn evil_meshes_have_a_hull_or_a_reason() {
    let mut known: Vec<Mesh> = Vec::new();
    for case in evil() {
        let Ok((mesh, _)) = read_bytes(Path::new(case.name), case.bytes).and_then(repair) else {
            continue;
        };
        // Of what is only written in another way the hull is known.
        if known.iter().any(|m| m.positions == mesh.positions && m.triangles == mesh.triangles) {
            continue;
        }
        match wrap(&mesh, &options(100).with_effort(0.0), Watch::NONE) {
            Ok(hull) => prove(case.name, &mesh, &hull),
            Err(error) => assert_eq!(error, BuildError::NoRoom, "{}", case.name),
        }
        known.push(mesh);
    }
}

#[test]
fn the_same_mesh_gives_the_same_hull() {
    let mesh = mesh_of(&rough_sphere(3, 0.3, 11));
    let once = wrap(&mesh, &options(80), Watch::NONE).unwrap();
    let again = wrap(&mesh, &options(80), Watch::NONE).unwrap();
    assert_eq!(once.mesh, again.mesh);
    assert_eq!(once.report.stars, again.report.stars);
}

#[test]
fn effort_makes_hulls_tighter() {
    let mesh = mesh_of(&rough_sphere(3, 0.3, 5));
    let void =
        |effort| proved("rough", &mesh, &options(80).with_effort(effort)).report.void.unwrap();
    let [none, some] = [0.0, 0.2].map(void);
    assert!(some < 0.97 * none, "{some} {none}");
}

#[test]
fn a_void_or_a_slack_that_is_asked_for_is_kept_with_few_faces() {
    let mesh = mesh_of(&rough_sphere(1, 0.3, 9));
    let mut last = usize::MAX;
    // Between the two the search takes a minute.
    for most in [0.05, 0.8] {
        let hull = proved("void", &mesh, &Options::new(Goal::Void(most)).with_effort(0.0));
        assert!(
            hull.report.void.unwrap() <= most && hull.report.stop == Outcome::Reached,
            "{:?}",
            hull.report
        );
        assert!(hull.report.faces < last);
        last = hull.report.faces;
    }
    last = usize::MAX;
    for most in [0.03, 0.4] {
        let hull = proved("slack", &mesh, &Options::new(Goal::Slack(most)).with_effort(0.0));
        assert!(
            hull.report.slack.upper <= most && hull.report.stop == Outcome::Reached,
            "{:?}",
            hull.report
        );
        assert!(hull.report.faces < last);
        last = hull.report.faces;
    }
    let (positions, triangles) = torus(1.0, 0.3, 20, 10);
    let open = mesh_of(&(positions, triangles[..50].to_vec()));
    let refused = wrap(&open, &Options::new(Goal::Void(0.1)).with_effort(0.02), Watch::NONE);
    assert!(matches!(refused.unwrap_err(), BuildError::NoVolume(NoVolume::Open { .. })));
}

#[test]
fn a_mesh_without_triangles_has_no_tight_hull() {
    let refused = wrap(&Mesh::default(), &Options::default(), Watch::NONE).unwrap_err();
    assert_eq!(refused, BuildError::Empty);
}

#[test]
fn the_checker_refuses_what_is_not_proved() {
    let of = |(p, t): &Triangles| Surface::new(p, t);
    let ball = of(&icosphere(2));
    let refused = |hull: &Triangles| check_enclosure(&ball, &of(hull)).unwrap_err();
    assert!(check_enclosure(&ball, &of(&scaled(&icosphere(1), 2.0))).is_ok());
    assert!(refused(&icosphere(2)).contains("meets"), "touching");
    assert!(refused(&scaled(&icosphere(1), 1.01)).contains("meets"), "crossing");
    assert!(refused(&scaled(&icosphere(2), 0.5)).contains("winds 0 times"));
    assert!(refused(&inverted(&scaled(&icosphere(1), 2.0))).contains("winds -1 times"));
    let twice = joined(&scaled(&icosphere(1), 2.0), &scaled(&icosphere(1), 4.0));
    assert!(refused(&twice).contains("winds 2 times"));
    let crossing = joined(&scaled(&icosphere(1), 2.0), &turned(&scaled(&icosphere(1), 2.0)));
    assert!(refused(&crossing).contains("of the hull meet"));
    let (positions, mut triangles) = scaled(&icosphere(1), 2.0);
    triangles.pop();
    assert!(refused(&(positions, triangles)).contains("open"));
}

/// A box with a square pit, and a ball in it that touches nothing.
fn ball_in_a_pit(radius: f32, height: f32) -> Triangles {
    let square = |half: f32, z: f32| {
        [[-half, -half, z], [half, -half, z], [half, half, z], [-half, half, z]]
    };
    let positions =
        [square(2.0, -2.0), square(2.0, 2.0), square(0.6, 2.0), square(0.6, -1.6)].concat();
    let mut triangles = Vec::new();
    let mut quad = |[a, b, c, d]: [u32; 4]| triangles.extend([[a, b, c], [a, c, d]]);
    quad([0, 3, 2, 1]);
    for k in 0..4 {
        let next = (k + 1) % 4;
        (0..12)
            .step_by(4)
            .for_each(|ring| quad([ring + k, ring + next, ring + 4 + next, ring + 4 + k]));
    }
    quad([12, 13, 14, 15]);
    let ball = scaled(&icosphere(1), radius);
    let straight = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    joined(&(positions, triangles), &transformed(&ball, straight, [0.05, 0.02, height]))
}

#[test]
fn a_hull_that_comes_to_enclose_a_part_of_itself_drops_that_part() {
    let report =
        proved("a ball in a pit", &mesh_of(&ball_in_a_pit(0.1, -1.0)), &options(24)).report;
    assert!(report.filled > 0, "{report:?}");
}

#[test]
fn no_vertex_is_farther_from_the_mesh_than_the_mesh_is_large() {
    let hull = proved("a small ball over a pit", &mesh_of(&ball_in_a_pit(0.05, 0.5)), &options(32));
    // The longest side is 4, and a vertex may be beyond three of them at once.
    assert!(hull.report.slack.upper < 4.0 * 3f64.sqrt() * 1.1, "{:?}", hull.report.slack);
}

/// The largest of the distances to a mesh from points spread over a hull's faces, by brute force.
fn farthest_of(hull: &Mesh, mesh: &Mesh) -> f64 {
    let corners = |mesh: &Mesh| -> Vec<[[f32; 3]; 3]> {
        mesh.triangles.iter().map(|t| t.map(|v| mesh.positions[v as usize])).collect()
    };
    let mesh = corners(mesh);
    let mut farthest_sq = 0f64;
    for face in corners(hull) {
        for (i, j) in (0..=STEPS).flat_map(|i| (0..=STEPS - i).map(move |j| (i, j))) {
            let weights = [i, j, STEPS - i - j].map(|w| w as f32 / STEPS as f32);
            let p = [0, 1, 2].map(|axis| (0..3).map(|k| weights[k] * face[k][axis]).sum::<f32>());
            let nearest_sq =
                mesh.iter().map(|t| rough_distance_sq(p, *t)).fold(f64::INFINITY, f64::min);
            farthest_sq = farthest_sq.max(nearest_sq);
        }
    }
    // The points are rounded to single precision, next to a face.
    farthest_sq.sqrt() * (1.0 - 1e-5)
}

/// Points along an edge.
const STEPS: u32 = 6;

#[test]
fn within_a_slack_no_point_of_a_hull_is_farther_and_faces_are_fewer_than_by_number() {
    let cases = [
        ("turned bracket", turned(&bracket()), 120),
        ("rough sphere", rough_sphere(3, 0.2, 4), 150),
    ];
    for (name, triangles, faces) in cases {
        let mesh = mesh_of(&triangles);
        let by_number = proved(name, &mesh, &options(faces));
        let most = by_number.report.slack.upper;
        let by_slack = proved(name, &mesh, &Options::new(Goal::Slack(most)).with_effort(0.02));
        assert_eq!(by_slack.report.stop, Outcome::Reached, "{name}");
        assert!(by_slack.report.slack.upper <= most, "{name}");
        let found = farthest_of(&by_slack.mesh, &mesh);
        assert!(found <= most, "{name}: {found} {most}");
        // A hull that wastes no slack is near it somewhere.
        assert!(found >= 0.5 * most, "{name}: {found} {most}");
        let few = by_slack.report.faces;
        assert!(
            few * 20 <= by_number.report.faces * 19,
            "{name}: {few} of {}",
            by_number.report.faces
        );
    }
}

#[test]
fn a_slack_beyond_a_margin_leaves_no_spikes() {
    let mesh = mesh_of(&turned(&cube(1)));
    let options = Options::new(Goal::Slack(0.3)).with_margin(0.2).with_effort(0.0);
    let hull = proved("a box with a margin", &mesh, &options);
    assert_eq!(hull.report.stop, Outcome::Reached);
    let found = farthest_of(&hull.mesh, &mesh);
    // Mitred corners would be 0.35 away: they have to be cut off, and with few faces.
    assert!((0.2..=0.3).contains(&found), "{found}");
    assert!(hull.report.faces <= 80, "{}", hull.report.faces);
}

#[test]
fn a_slack_that_no_hull_can_keep_is_said_to_be_unmet() {
    let mesh = mesh_of(&turned(&cube(1)));
    let hull = proved("tiny slack", &mesh, &Options::new(Goal::Slack(1e-12)).with_effort(0.0));
    assert_eq!(hull.report.stop, Outcome::TooLoose);
    assert!(hull.report.slack.upper > 1e-12);
}

#[test]
fn no_slack_is_said_to_be_kept_before_it_is_proved() {
    for triangles in [turned(&torus(1.0, 0.3, 20, 10)), turned(&cube(2))] {
        for time in [0, 1, 20_000, 200_000] {
            let mesh = mesh_of(&triangles);
            let time_limit = Some(Duration::from_micros(time));
            let options =
                Options::new(Goal::Slack(1e-3)).with_time_limit(time_limit).with_effort(0.0);
            let hull = proved("late", &mesh, &options);
            let report = hull.report;
            let is_kept = farthest_of(&hull.mesh, &mesh) <= 1e-3;
            assert!(is_kept || report.slack.upper > 1e-3, "{time} {report:?}");
            assert!(time > 1 || report.stop == Outcome::OutOfTime, "{time} {report:?}");
        }
    }
    let refused = wrap(&mesh_of(&cube(1)), &Options::new(Goal::Slack(f64::NAN)), Watch::NONE);
    assert!(matches!(refused.unwrap_err(), BuildError::OutOfRange { option: "--slack", .. }));
}
