//! How deep two solids are in each other: held to separating axes, to winding numbers in f64, and
//! to random translations.

use meshsweep_core::{Budget, Bvh, Interval, Penetration, Pose, QueryError, Relation, Scratch};
use meshsweep_core::{Ended, Undecided};
use meshsweep_host_tests::generate::corpus::IDENTITY;
use meshsweep_host_tests::generate::{
    Rng, Triangles, bracket, cube, icosphere, inverted, joined, rough_sphere, scaled, torus,
    transformed, two_parts,
};
use meshsweep_host_tests::motion::{self, motions, placed, rotation};
use meshsweep_host_tests::oracle::winding_number;
use meshsweep_host_tests::scene::Scene;

type Point = [f64; 3];

fn ask(a: &Bvh<'_>, b: &Bvh<'_>, pose: &Pose, budget: Budget) -> Penetration {
    let mut scratch = Scratch::<1024>::new();
    a.penetration(b, *pose, budget, &mut scratch).expect("answers")
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn moved(pose: &Pose, p: [f32; 3]) -> Point {
    let p = p.map(f64::from);
    std::array::from_fn(|k| {
        dot(pose.rotation[k].map(f64::from), p) + f64::from(pose.translation[k])
    })
}

/// The meshes as sets of points: `a` at rest, `b` moved.
fn points(a: &Scene, b: &Scene, pose: &Pose) -> [Vec<Point>; 2] {
    let first = a.positions.iter().map(|p| p.map(f64::from)).collect();
    [first, b.positions.iter().map(|&p| moved(pose, p)).collect()]
}

/// Penetration depth of two boxes: the least overlap along a face normal or a product of edges.
/// `None` if an axis parts them.
fn depth_of_boxes(a: &Scene, b: &Scene, pose: &Pose) -> Option<f64> {
    let [first, second] = points(a, b, pose);
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let turned = axes.map(|axis| pose.rotation.map(|row| dot(row.map(f64::from), axis)));
    let products = axes.iter().flat_map(|a| turned.iter().map(|b| cross(*a, *b)));
    let all: Vec<Point> = axes.into_iter().chain(turned).chain(products).collect();
    let mut least = f64::INFINITY;
    for axis in all {
        let length = dot(axis, axis).sqrt();
        if length < 1e-9 {
            continue;
        }
        let span = |points: &[Point]| {
            points.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| {
                let x = dot(*p, axis) / length;
                (low.min(x), high.max(x))
            })
        };
        let ((a, b), (c, d)) = (span(&first), span(&second));
        let overlap = (b - c).min(d - a);
        if overlap < 0.0 {
            return None;
        }
        least = least.min(overlap);
    }
    Some(least)
}

/// Whether two solids have points in common, by exact meetings and winding numbers of all vertices.
fn share_points(a: &Scene, b: &Scene, pose: &Pose) -> bool {
    if !motion::truth(a, b, pose).is_empty() {
        return true;
    }
    let [first, second] = points(a, b, pose);
    let there: Vec<[f32; 3]> = second.iter().map(|p| p.map(|x| x as f32)).collect();
    let inside = |p: &Point, positions: &[[f32; 3]], triangles: &[[u32; 3]]| {
        winding_number(*p, positions, triangles, 1.0) > 0.5
    };
    second.iter().any(|p| inside(p, &a.positions, &a.triangles))
        || first.iter().any(|p| inside(p, &there, &b.triangles))
}

/// The pose moved by `length` in some direction.
fn shifted(pose: &Pose, length: f64, rng: &mut Rng) -> Pose {
    let way = rng.direction();
    let mut shifted = *pose;
    for (x, way) in shifted.translation.iter_mut().zip(way) {
        *x += (f64::from(way) * length) as f32;
    }
    shifted
}

/// Holds an answer to the truth: the relation, the pose that is apart, and translations that are
/// shorter than the lower end.
fn holds(name: &str, [a, b]: [&Scene; 2], pose: &Pose, found: &Penetration, rng: &mut Rng) {
    let name = format!("{name}: {pose:?} {found:?}");
    let shares = share_points(a, b, pose);
    match found.relation {
        Relation::Apart => assert!(!shares, "{name}"),
        Relation::Undecided(_) => {}
        _ => assert!(shares, "{name}"),
    }
    let Interval { lower, upper } = found.depth;
    assert!(0.0 <= lower && lower <= upper, "{name}");
    if let Some(apart) = found.apart {
        assert!(!share_points(a, b, &apart), "{name}");
        assert_eq!(apart.rotation, pose.rotation, "{name}");
        let way = |k: usize| f64::from(apart.translation[k]) - f64::from(pose.translation[k]);
        let length = (0..3).map(|k| way(k) * way(k)).sum::<f64>().sqrt();
        assert!(length <= f64::from(upper), "{name}: {length}");
    }
    for part in [0.5, 0.9, 0.999] {
        if lower > 0.0 {
            let shifted = shifted(pose, part * f64::from(lower), rng);
            assert!(share_points(a, b, &shifted), "{name}: {shifted:?}");
        }
    }
}

fn stretched(by: [f32; 3]) -> Triangles {
    let [x, y, z] = by;
    transformed(&cube(2), [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]], [0.3, -0.2, 0.1])
}

/// Boxes have a depth in closed form.
#[test]
fn the_depth_of_boxes_is_that_of_their_separating_axes() {
    let mut rng = Rng::new(51);
    let (mut widths, mut apart) = (Vec::new(), 0);
    for sizes in [[1.0f32, 1.0, 1.0], [2.0, 0.3, 0.7]] {
        let (a, b) = (stretched(sizes), stretched([0.8, 1.5, 0.5]));
        let (a, b) = (Scene::solid("", a, 0.0, 0), Scene::solid("", b, 0.0, 0));
        for _ in 0..24 {
            let reach = 0.5 * (a.size() + b.size());
            let pose = placed(&b, rotation(&mut rng), rng.point_in([-reach; 3], [reach; 3]));
            let truth = depth_of_boxes(&a, &b, &pose);
            for (first, second) in a.trees().iter().zip(b.trees()) {
                let found = ask(first, &second, &pose, Budget::EXACT);
                let name = format!("{pose:?} {found:?} {truth:?}");
                let Interval { lower, upper } = found.depth;
                if let Some(truth) = truth {
                    assert!(f64::from(lower) <= truth + 1e-6, "{name}");
                    assert!(truth - 1e-6 <= f64::from(upper), "{name}");
                    assert!(!matches!(found.relation, Relation::Apart), "{name}");
                    widths.push(f64::from(upper - lower) / truth);
                } else {
                    assert_eq!(found.relation, Relation::Apart, "{name}");
                    assert_eq!((lower, upper), (0.0, 0.0), "{name}");
                    apart += 1;
                }
            }
        }
    }
    widths.sort_by(f64::total_cmp);
    assert!(apart > 10 && widths.len() > 20, "{apart} {}", widths.len());
    // Balls do not fill the wedge between two edges that cross: up to 1 - 1/sqrt(2) is lost.
    assert!(widths[widths.len() / 2] < 0.2, "{widths:?}");
    assert!(widths[9 * widths.len() / 10] < 0.35, "{widths:?}");
}

#[test]
fn the_depth_of_balls_is_what_their_radii_have_too_much() {
    let ball = Scene::solid("", icosphere(3), 0.0, 0);
    let mut rng = Rng::new(53);
    for distance in [0.3, 1.0, 1.7, 1.95] {
        let at = rng.direction().map(|x| x * distance);
        let pose = placed(&ball, rotation(&mut rng), at);
        for tree in ball.trees() {
            let Interval { lower, upper } = ask(&tree, &tree, &pose, Budget::EXACT).depth;
            // Faces lie up to 0.02 within the ball.
            let depth = 2.0 - distance;
            assert!(depth - 0.05 < lower && upper < depth + 1e-3, "{lower} {upper} {depth}");
        }
    }
}

/// A prism over a polygon, about z = 0: its corners counter-clockwise, and the triangles of a cap.
fn prism(corners: &[[f32; 2]], cap: &[[u32; 3]], height: f32) -> Triangles {
    let n = corners.len() as u32;
    let at = |z: f32| corners.iter().map(move |[x, y]| [*x, *y, z]);
    let positions = at(-0.5 * height).chain(at(0.5 * height)).collect();
    let caps = cap.iter().flat_map(|&[a, b, c]| [[a, c, b], [a + n, b + n, c + n]]);
    let walls =
        (0..n).map(|i| (i, (i + 1) % n)).flat_map(|(i, j)| [[i, j, j + n], [i, j + n, i + n]]);
    (positions, caps.chain(walls).collect())
}

fn cylinder(radius: f32, height: f32) -> Triangles {
    let n = 24;
    let turn = |i: u32| (i as f32 * std::f32::consts::TAU / n as f32).sin_cos();
    let corners: Vec<_> = (0..n).map(turn).map(|(y, x)| [radius * x, radius * y]).collect();
    let cap: Vec<_> = (1..n - 1).map(|i| [0, i, i + 1]).collect();
    prism(&corners, &cap, height)
}

/// A block of 8 by 10 by 12 with a slot of 4 by 10 by 8: its floor is y = 0.
fn slotted() -> Triangles {
    let outer = [[-4.0, -4.0], [4.0, -4.0], [4.0, 8.0], [2.0, 8.0]];
    let inner = [[2.0, 0.0], [-2.0, 0.0], [-2.0, 8.0], [-4.0, 8.0]];
    let cap = [[0, 1, 4], [0, 4, 5], [1, 2, 4], [2, 3, 4], [0, 5, 6], [0, 6, 7]];
    prism(&[outer, inner].concat(), &cap, 10.0)
}

/// In a hole or a slot the way out is short, and leads to a place that is not beside the solid.
#[test]
fn a_shallow_contact_in_a_hole_or_a_slot_is_known_to_a_factor() {
    let ring = Scene::solid("", torus(10.0, 3.0, 24, 12), 0.0, 0);
    let slot = Scene::solid("", slotted(), 0.0, 0);
    let pin = Scene::solid("", cylinder(2.0, 20.0), 0.0, 0);
    let ball = Scene::solid("", icosphere(2), 0.0, 0);
    let block =
        transformed(&cube(2), [[1.8, 0.0, 0.0], [0.0, 2.5, 0.0], [0.0, 0.0, 4.0]], [0.0; 3]);
    let block = Scene::solid("", block, 0.0, 0);
    let mut rng = Rng::new(67);
    // Corners of the ring, of the pin and of the ball lie on the circles that nearly touch. The
    // block's wall is 1.8 from its middle, its floor 2.5, its faces towards z are outside.
    for (name, a, b, at, depth) in [
        ("pin", &ring, &pin, [5.05, 0.0, 0.0], 0.05),
        ("pin", &ring, &pin, [5.5, 0.0, 1.0], 0.5),
        ("pin", &ring, &pin, [0.0, -5.1, 0.3], 0.1),
        ("ball", &ring, &ball, [6.1, 0.0, 0.0], 0.1),
        ("ball", &ring, &ball, [0.0, 6.02, 0.0], 0.02),
        ("wall", &slot, &block, [0.25, 4.0, 0.0], 0.05),
        ("wall", &slot, &block, [-0.21, 3.0, 1.0], 0.01),
        ("floor", &slot, &block, [0.1, 2.4, 0.5], 0.1),
        ("corner", &slot, &block, [0.3, 2.4, 0.2], 0.02f64.sqrt()),
        ("touching", &slot, &block, [0.2, 4.0, 0.5], 0.0),
    ] {
        let pose = Pose::rigid(IDENTITY, at);
        for (i, (first, second)) in a.trees().iter().zip(b.trees()).enumerate() {
            let found = ask(first, &second, &pose, Budget::EXACT);
            let Interval { lower, upper } = found.depth;
            let name = format!("{name}: {depth} {found:?}");
            assert!(f64::from(lower) <= depth + 1e-6 && depth - 1e-6 <= f64::from(upper), "{name}");
            assert!(f64::from(upper) <= 1.5 * depth + 2e-3 && found.apart.is_some(), "{name}");
            assert!(depth == 0.0 || upper <= 4.0 * lower, "{name}");
            if i == 0 {
                holds(&name, [a, b], &pose, &found, &mut rng);
            }
        }
    }
}

fn check(name: &str, a: &Scene, b: &Scene, poses: &[Pose], seed: u64) -> [usize; 4] {
    let mut rng = Rng::new(seed);
    let (mut counts, mut unproved) = ([0; 4], 0);
    for (i, pose) in poses.iter().enumerate() {
        let found = ask(&a.trees()[i & 1], &b.trees()[i >> 1 & 1], pose, Budget::EXACT);
        assert_eq!(found.ended, Ended::Exact, "{name}: {found:?}");
        holds(name, [a, b], pose, &found, &mut rng);
        let relations =
            [Relation::Apart, Relation::Overlap, Relation::FirstInside, Relation::SecondInside];
        let which = relations.iter().position(|relation| *relation == found.relation);
        counts[which.unwrap_or_else(|| panic!("{name}: {pose:?} {found:?}"))] += 1;
        if found.relation != Relation::Apart {
            assert_eq!(found.depth.lower > 0.0, found.deepest.is_some(), "{name}: {found:?}");
            unproved += usize::from(found.deepest.is_none());
        }
    }
    // The climb to a deep point begins where the surfaces meet first. Where they meet in several
    // places, and there is little in common, it may end before it is inside both.
    assert!(unproved <= 1, "{name}: {unproved} of {}", poses.len());
    counts
}

#[test]
fn solids_that_are_not_convex_are_held_to_meetings_and_winding_numbers() {
    let ring = Scene::solid("", torus(2.0, 0.75, 16, 8), 0.0, 0);
    let rough = Scene::solid("", rough_sphere(2, 0.4, 3), 0.0, 0);
    let part = Scene::solid("", scaled(&bracket(), 0.05), 0.0, 0);
    let moved = Scene::solid("", torus(2.0, 0.75, 16, 8), 1e-3, 5);
    for (name, a, b, seed) in [
        ("ring, rough", &ring, &rough, 54),
        ("bracket, rough", &part, &rough, 55),
        ("moved, rough", &moved, &rough, 56),
    ] {
        let [apart, overlap, ..] = check(name, a, b, &motions(a, b, 14, seed), seed);
        assert!(apart > 2 && overlap > 2, "{name}: {apart} {overlap}");
    }
}

/// A cavity is outside, the wall is inside, and parts count one by one.
#[test]
fn a_part_inside_is_told_from_one_in_a_cavity() {
    let turned = inverted(&scaled(&icosphere(2), 2.0));
    let shell = Scene::solid("", joined(&scaled(&cube(3), 4.0), &turned), 0.0, 0);
    let grain = Scene::solid("", scaled(&rough_sphere(1, 0.3, 1), 0.2), 0.0, 0);
    let mut rng = Rng::new(57);
    let mut at = |x: f32| placed(&grain, rotation(&mut rng), [x, x, x]);
    // The cavity's wall is at 1.15 on the diagonal.
    let cavity: Vec<Pose> = [0.0, 0.3, 0.6, 0.9].into_iter().map(&mut at).collect();
    let wall: Vec<Pose> = [1.6, 2.0, 2.8, 3.5].into_iter().map(&mut at).collect();
    assert_eq!(check("cavity", &shell, &grain, &cavity, 58), [4, 0, 0, 0]);
    assert_eq!(check("wall", &shell, &grain, &wall, 59), [0, 0, 0, 4]);
    let identity = Pose::rigid(IDENTITY, [-2.8; 3]);
    assert_eq!(check("in the moved wall", &grain, &shell, &[identity], 60), [0, 0, 1, 0]);

    // One of two parts lies inside, whichever is first in the file.
    let parts = Scene::solid("", two_parts(), 0.0, 0);
    let large = Scene::solid("", scaled(&cube(2), 3.0), 0.0, 0);
    for x in [0.5f32, -4.5] {
        let pose = Pose::rigid(IDENTITY, [x, 0.25, 0.5]);
        let found = ask(&large.bvh(), &parts.bvh(), &pose, Budget::EXACT);
        assert_eq!(found.relation, Relation::SecondInside, "{found:?}");
    }
}

/// Components that contain each other or overlap: a grain in the outer one is inside, though the
/// nearest surface shows it its front.
#[test]
fn components_that_overlap_or_contain_each_other_are_one_solid() {
    let nested = Scene::solid("", joined(&icosphere(2), &scaled(&icosphere(2), 3.0)), 0.0, 0);
    let identity = |by: f32, at: [f32; 3]| {
        transformed(&cube(1), [[by, 0.0, 0.0], [0.0, by, 0.0], [0.0, 0.0, by]], at)
    };
    let overlapping = joined(&identity(1.0, [0.0; 3]), &identity(1.0, [1.0, 0.1, 0.2]));
    let overlapping = Scene::solid("", overlapping, 0.0, 0);
    let grain = Scene::solid("", scaled(&icosphere(1), 0.06), 0.0, 0);
    let mut rng = Rng::new(63);
    let mut at = |place: [f32; 3]| placed(&grain, rotation(&mut rng), place);
    let poses = [1.2, 1.5, 1.96, 2.6].map(|x| at([x, 0.1, 0.2]));
    assert_eq!(check("nested", &nested, &grain, &poses, 64), [0, 0, 0, 4]);
    let poses = [-0.15, 0.2, 0.5, 1.2].map(|x| at([x, 0.2, 0.1]));
    assert_eq!(check("overlapping", &overlapping, &grain, &poses, 65), [0, 0, 0, 4]);
}

/// Many small bodies, some of them inside: a box of a node holds both kinds.
#[test]
fn a_body_inside_is_found_among_many_outside() {
    let mut rng = Rng::new(66);
    let balls = (0..3).fold(icosphere(1), |all, k| {
        let ball = scaled(&icosphere(1), 0.5 + 0.2 * k as f32);
        joined(&all, &transformed(&ball, IDENTITY, rng.direction().map(|x| 4.0 * x)))
    });
    let balls = Scene::solid("", balls, 0.0, 0);
    let (mut inside, mut apart) = (0, 0);
    for _ in 0..40 {
        let grain = scaled(&icosphere(0), 0.02);
        let mut cloud: Option<Triangles> = None;
        while cloud.as_ref().is_none_or(|(_, triangles)| triangles.len() < 60 * grain.1.len()) {
            let at = rng.point_in([-5.0; 3], [5.0; 3]);
            // Mostly those outside.
            if at.iter().map(|x| x * x).sum::<f32>() < 1.2 && rng.below(8) > 0 {
                continue;
            }
            let one = transformed(&grain, IDENTITY, at);
            cloud = Some(cloud.map_or(one.clone(), |all| joined(&all, &one)));
        }
        let cloud = Scene::solid("", cloud.expect("grains"), 0.0, 0);
        for (first, second) in [(&balls, &cloud), (&cloud, &balls)] {
            let found = ask(&first.bvh(), &second.bvh(), &Pose::IDENTITY, Budget::EXACT);
            let shares = share_points(first, second, &Pose::IDENTITY);
            assert_eq!(shares, found.relation != Relation::Apart, "{found:?}");
            inside += usize::from(shares);
            apart += usize::from(!shares);
        }
    }
    assert!(inside > 10 && apart > 10, "{inside} {apart}");
}

/// Triangles without area and walls without thickness hold no solid.
#[test]
fn what_holds_no_solid_has_no_depth() {
    let body = Scene::solid("", cube(1), 0.0, 0);
    let far = transformed(&cube(1), IDENTITY, [0.0, 0.0, 6.0]);
    let corner = [0.3, 0.2, 0.25];
    let wire = (vec![corner, [0.3, 0.2, 3.0], [0.3, 0.2, 1.5]], vec![[0, 1, 2]]);
    let flat = (
        vec![[0.1, 0.1, 0.125], [4.0, 0.1, 0.125], [4.0, 0.4, 0.125], [0.1, 0.4, 0.125]],
        vec![[0, 1, 2], [0, 2, 3], [1, 0, 3], [1, 3, 2]],
    );
    for more in [wire, flat] {
        let other = Scene::solid("", joined(&far, &more), 0.0, 0);
        for (a, b) in body.trees().iter().zip(other.trees()) {
            let found = ask(a, &b, &Pose::IDENTITY, Budget::EXACT);
            assert_eq!(found.depth.lower, 0.0, "{found:?}");
        }
    }
}

#[test]
fn surfaces_that_touch_and_meshes_without_sides_are_undecided() {
    let a = Scene::solid("", cube(2), 0.0, 0);
    for tree in a.trees() {
        let pose = Pose::rigid(IDENTITY, [2.0, 0.25, 0.5]);
        let found = ask(&tree, &tree, &pose, Budget::EXACT);
        let is_open = matches!(found.relation, Relation::Undecided(Undecided::Resolution));
        assert!(is_open && found.depth.lower == 0.0 && found.depth.upper < 1e-3, "{found:?}");
    }
    let (positions, mut triangles) = cube(2);
    triangles.pop();
    let open = Scene::solid("", (positions, triangles), 0.0, 0);
    for (first, second) in [(&a, &open), (&open, &a)] {
        let found = ask(&first.bvh(), &second.bvh(), &Pose::IDENTITY, Budget::EXACT);
        assert_eq!(found.relation, Relation::Undecided(Undecided::OpenMesh), "{found:?}");
        assert_eq!(found.depth, Interval::new(0.0, f32::INFINITY), "{found:?}");
    }
}

/// Few steps and short scratch widen the interval and never make it wrong; a tolerance ends early.
#[test]
fn budgets_are_kept() {
    let (a, b) = (torus(2.0, 0.75, 16, 8), rough_sphere(2, 0.4, 3));
    let (a, b) = (Scene::solid("", a, 0.0, 0), Scene::solid("", b, 0.0, 0));
    let mut rng = Rng::new(61);
    let mut short = 0;
    for pose in motions(&a, &b, 6, 62) {
        let mut last = u32::MAX;
        for steps in [u32::MAX, 4000, 400, 40, 4, 0] {
            let found = ask(&a.bvh(), &b.bvh(), &pose, Budget::EXACT.with_steps(steps));
            holds("steps", [&a, &b], &pose, &found, &mut rng);
            assert!(found.work.opened <= steps && found.work.opened <= last, "{found:?}");
            if steps < u32::MAX {
                // Without a limit it begins in f32.
                last = found.work.opened;
            }
            short += usize::from(found.ended == Ended::Steps);
        }
        for entries in [1, 3, 9] {
            let mut scratch = Scratch::<16>::new();
            let found = a.bvh().penetration(&b.bvh(), pose, Budget::EXACT, &mut scratch[..entries]);
            holds("scratch", [&a, &b], &pose, &found.expect("answers"), &mut rng);
        }
        let exact = ask(&a.bvh(), &b.bvh(), &pose, Budget::EXACT.with_steps(20_000));
        assert_eq!(exact.ended, Ended::Exact, "{exact:?}");
        let rough = ask(&a.bvh(), &b.bvh(), &pose, Budget::EXACT.with_relative(9.0));
        assert!(rough.work.opened <= exact.work.opened, "{rough:?} {exact:?}");
        let is_wider = rough.depth.upper > exact.depth.upper;
        assert!(!is_wider || rough.ended == Ended::Tolerance, "{rough:?} {exact:?}");
    }
    assert!(short > 6, "{short}");
}

#[test]
fn what_cannot_be_answered_is_refused() {
    let (whole, segments) = (Scene::solid("", cube(1), 0.0, 0), Scene::both("", cube(1)));
    let points = Scene::tree("", cube(1), false);
    let mut scratch = Scratch::<512>::new();
    let mut refused = |a: &Scene, b: &Scene, pose: Pose, budget: Budget| {
        a.bvh().penetration(&b.bvh(), pose, budget, &mut scratch).expect_err("is refused")
    };
    let (exact, nan) = (Budget::EXACT, Budget::EXACT.with_relative(f32::NAN));
    let served = |error| matches!(error, QueryError::NotServed { .. });
    assert!(served(refused(&whole, &segments, Pose::IDENTITY, exact)));
    assert!(served(refused(&segments, &whole, Pose::IDENTITY, exact)));
    assert!(served(refused(&whole, &points, Pose::IDENTITY, exact)));
    assert_eq!(refused(&whole, &whole, Pose::IDENTITY, nan), QueryError::Tolerance);
    let pose = Pose { translation: [f32::NAN, 0.0, 0.0], ..Pose::IDENTITY };
    assert_eq!(refused(&whole, &whole, pose, exact), QueryError::NotFinite);
    let sheared = [[1.0, 0.9, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let pose = Pose::affine(sheared, [0.5; 3]);
    assert_eq!(refused(&whole, &whole, pose, exact), QueryError::PoseOutOfDomain);
}
