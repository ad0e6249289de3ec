//! Tight hulls with a margin keep it: proved from the two surfaces alone, by exact distances that
//! share no code with the builder's.

use std::f64::consts::PI;

use meshsweep::builder::For;
use meshsweep::check::{Surface, check_enclosure, check_margin};
use meshsweep::mesh::{Mesh, RawMesh, repair};
use meshsweep::progress::Watch;
use meshsweep::tight::{Goal, Hull, Options, Outcome, Start, hull_mesh, wrap};
use meshsweep::{BuildError, Builder};
use meshsweep_host_tests::generate::{
    Rng, Triangles, cube, groove_block, icosphere, needle_comb, scaled, torus,
};
use meshsweep_host_tests::oracle::distance_to_mesh;

fn mesh_of((positions, triangles): &Triangles) -> Mesh {
    repair(RawMesh::from_f32(positions, triangles)).expect("a mesh").0
}

fn options(faces: usize, margin: f64) -> Options {
    Options::new(Goal::Faces(faces)).with_margin(margin).with_effort(0.02)
}

fn surface(m: &Mesh) -> Surface {
    Surface::new(&m.positions, &m.triangles)
}

fn proved(name: &str, mesh: &Mesh, options: &Options) -> Hull {
    let hull = wrap(mesh, options, Watch::NONE).unwrap_or_else(|e| panic!("{name}: {e}"));
    let proof = check_margin(&surface(mesh), &surface(&hull.mesh), options.margin)
        .unwrap_or_else(|e| panic!("{name}: {e}"));
    assert_eq!(proof.inside, mesh.positions.len(), "{name}");
    assert!(hull.report.slack.upper > options.margin, "{name}");
    hull
}

/// Longest side of a mesh's box.
fn size(mesh: &Mesh) -> f64 {
    let side = |k: usize| {
        let of = || mesh.positions.iter().map(|p| f64::from(p[k]));
        of().fold(f64::NEG_INFINITY, f64::max) - of().fold(f64::INFINITY, f64::min)
    };
    (0..3).map(side).fold(0.0, f64::max)
}

#[test]
fn solids_keep_their_margin_small_or_large() {
    let meshes = [
        ("torus", torus(1.0, 0.3, 24, 12), 1e-6),
        ("groove", groove_block(), 0.1),
        ("comb", needle_comb(), 1.0),
    ];
    for (name, of, part) in &meshes {
        let mesh = mesh_of(of);
        let report = proved(
            &format!("{name} by {part}"),
            &mesh,
            &options(100, part * size(&mesh)).with_effort(0.0),
        )
        .report;
        assert!(
            report.faces <= 100 && report.stop == Outcome::Reached,
            "{name} {part}: {report:?}"
        );
    }
}

#[test]
fn triangles_of_any_kind_keep_their_margin() {
    let mut rng = Rng::new(5);
    let mut positions = Vec::new();
    for _ in 0..6 {
        let at = rng.point_in([-1.0; 3], [1.0; 3]);
        // Slivers among them.
        let wide = if positions.len() % 2 == 0 { 0.4 } else { 1e-5 };
        for k in 0..3 {
            let d = rng.point_in([-wide; 3], [wide; 3]);
            let long = if k == 0 { 0.5 } else { 0.0 };
            positions.push([at[0] + d[0] + long, at[1] + d[1], at[2] + d[2]]);
        }
    }
    let triangles = (0..6).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    let soup = mesh_of(&(positions, triangles));
    let (positions, mut triangles) = torus(1.0, 0.3, 24, 12);
    triangles.truncate(300);
    let open = mesh_of(&(positions, triangles));
    let one = mesh_of(&(vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], vec![[0, 1, 2]]));
    for (name, mesh, margin) in
        [("soup", &soup, 0.2), ("open", &open, 0.1), ("one", &one, 0.5), ("one", &one, 1e-5)]
    {
        let report =
            proved(&format!("{name} by {margin}"), mesh, &options(100, margin).with_effort(0.0))
                .report;
        assert!(report.void.is_err() && !matches!(report.start, Start::Progressive { .. }));
    }
}

#[test]
fn scale_does_not_matter_to_a_margin() {
    for (factor, part) in [(1e-36, 0.3), (1e-30, 0.003), (1e30, 0.3), (1e36, 0.003)] {
        let mesh = mesh_of(&scaled(&torus(1.0, 0.5, 10, 6), factor));
        proved(&format!("times {factor:e}"), &mesh, &options(80, part * f64::from(factor)));
    }
}

/// Volume of all points within `d` of a convex solid of volume, area and sum of edges' lengths
/// times the angles between normals (Steiner).
fn grown([volume, area, edges]: [f64; 3], d: f64) -> f64 {
    volume + area * d + edges * d * d / 2.0 + 4.0 / 3.0 * PI * d * d * d
}

#[test]
fn a_hull_with_a_margin_is_as_tight_as_one_of_what_is_within_it() {
    let one = mesh_of(&cube(1));
    let side = size(&one);
    let steiner = [side.powi(3), 6.0 * side * side, 12.0 * side * PI / 2.0];
    for (part, most) in [(0.001, 1e-3), (0.1, 0.01), (1.0, 0.06)] {
        let margin = part * side;
        let of = options(100, margin).with_effort(0.1);
        let volume = proved(&format!("cube by {part}"), &one, &of).report.volume;
        let void = volume / grown(steiner, margin) - 1.0;
        assert!((0.0..most).contains(&void), "{part}: {void}");
    }
    // Twice the radius, and the void of a ball of few faces.
    let ball = mesh_of(&icosphere(3));
    let volume = proved("ball", &ball, &options(80, 1.0).with_effort(0.1)).report.volume;
    let void = volume / (4.0 / 3.0 * PI * 8.0) - 1.0;
    assert!((0.0..0.09).contains(&void), "{void}");
}

#[test]
fn a_slack_is_kept_with_a_margin() {
    let mesh = mesh_of(&cube(2));
    let of = |goal| Options::new(goal).with_margin(0.5).with_effort(0.0);
    let hull = proved("slack", &mesh, &of(Goal::Slack(0.9)));
    assert!(
        hull.report.slack.upper <= 0.9 && hull.report.stop == Outcome::Reached,
        "{:?}",
        hull.report
    );
}

#[test]
fn margins_that_cannot_be_had_are_errors() {
    let mesh = mesh_of(&cube(1));
    let error = |mesh: &Mesh, options: &Options| wrap(mesh, options, Watch::NONE).unwrap_err();
    for margin in [-1.0, -f64::MIN_POSITIVE, f64::NAN, f64::INFINITY] {
        let refused = error(&mesh, &options(100, margin));
        let BuildError::OutOfRange { option, .. } = refused else { panic!("{refused:?}") };
        assert_eq!(option, "--margin");
    }
    assert_eq!(error(&mesh, &options(100, 1e39)), BuildError::MarginTooLarge);
    let far = mesh_of(&scaled(&cube(1), 1e37));
    assert_eq!(error(&far, &options(100, 3.39e38)), BuildError::MarginTooLarge);
    let slack = Options::new(Goal::Slack(0.5)).with_margin(0.5);
    assert!(matches!(error(&mesh, &slack), BuildError::SlackWithinMargin { .. }));
}

/// The file's vertices are doubles that single precision rounds by up to 1/32. So hulls that keep a
/// slack from the rounded mesh alone would be farther from the file's.
#[test]
fn a_slack_is_kept_from_the_file_as_it_is_before_rounding_or_refused() {
    let far = 1e6;
    let (positions, triangles) = icosphere(2);
    // Sums with `far` are exact in double precision.
    let short = |x: f32| (x * 1_048_576.0).round() / 1_048_576.0;
    let positions: Vec<[f32; 3]> = positions.iter().map(|p| p.map(short)).collect();
    let (mut kept, mut refused) = (0, 0);
    for slack in [0.1, 0.15, 0.2, 0.25, 0.3, 0.4] {
        let moved = positions.iter().map(|p| p.map(|x| f64::from(x) + far)).collect();
        let raw = RawMesh::from_f64(moved, triangles.clone());
        let built = match Builder::new().serve(For::Tight).slack(slack).effort(0.0).build(raw) {
            Ok(built) => built,
            Err(BuildError::Unmet(_) | BuildError::SlackWithinMargin { .. }) => {
                refused += 1;
                continue;
            }
            Err(error) => panic!("{slack}: {error}"),
        };
        let hulls = built.blob().tight_hulls().expect("hulls");
        let mesh = hull_mesh(&hulls.get(0).expect("one"));
        for p in &mesh.positions {
            // Exact: both are multiples of 1/16 near `far`.
            let p = p.map(|x| (f64::from(x) - far) as f32);
            let distance = distance_to_mesh(p, &positions, &triangles);
            assert!(distance.lower <= slack, "{slack}: {distance:?}");
        }
        kept += 1;
    }
    assert!(kept > 0 && refused > 0, "{kept} {refused}");
}

#[test]
fn the_checker_refuses_a_margin_that_is_not_kept() {
    let of = |(p, t): &Triangles| Surface::new(p, t);
    let (inner, outer) = (of(&cube(2)), of(&scaled(&cube(3), 2.0)));
    assert!(check_enclosure(&inner, &outer).is_ok());
    for margin in [0.0, 0.5, 1f64.next_down()] {
        assert!(check_margin(&inner, &outer, margin).is_ok(), "{margin}");
    }
    for margin in [1.0, 1.5, 10.0] {
        assert!(
            check_margin(&inner, &outer, margin).unwrap_err().contains("not farther"),
            "{margin}"
        );
    }
    assert!(check_margin(&inner, &outer, f64::NAN).is_err());
}
