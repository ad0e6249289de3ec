//! No motion that meets the mesh is called clear, and no first contact is too late.

use super::shapes::{Point, Shape};
use meshsweep_core::{Budget, Bvh, Ended, FirstHit, ScratchEntry};
use meshsweep_host_tests::generate::{
    Rng, Triangles, bracket, cube, needle_comb, rough_sphere, torus,
};
use meshsweep_host_tests::scene::Scene;

fn ask(tree: &Bvh<'_>, from: &Shape, to: &Shape) -> FirstHit {
    let mut stack = vec![ScratchEntry::EMPTY; tree.scratch_entries()];
    tree.solid_first_contact(&from.solid(), &to.solid(), Budget::EXACT, &mut stack)
        .expect("answers")
}

/// Rounded to a multiple of 2^-6, so that a few hundred parts of a motion are exact in f32.
fn coarse(p: Point) -> Point {
    p.map(|x| (x * 64.0).round() / 64.0)
}

/// Parts of a motion that the tests look at.
const PARTS: f32 = 256.0;

/// All places of a capsule on a part of a translation: a parallelogram, or a capsule.
fn swept(capsule: &Shape, way: Point, part: f32) -> Shape {
    let moved = |p: Point| [0, 1, 2].map(|k| p[k] + way[k] * part);
    let [a, b] = [capsule.corners[0], *capsule.corners.last().expect("a corner")];
    if a == b {
        return Shape::capsule(a, moved(a), capsule.radius);
    }
    let mut shape = Shape::triangle([a, b, moved(b)], capsule.radius);
    shape.corners.push(moved(a));
    shape.faces.push([0, 2, 3]);
    shape
}

#[derive(Debug, Default)]
struct Tally {
    clear: usize,
    stopped: usize,
    open: usize,
}

fn check(name: &str, mesh: Triangles, count: usize, seed: u64) -> Tally {
    let scene = Scene::both(name, mesh);
    let mut rng = Rng::new(seed);
    let mut tally = Tally::default();
    let reach = 0.5 * scene.size();
    for number in 0..count {
        let place = coarse(scene.around(1.5, &mut rng));
        let end = if number % 2 == 0 { place } else { coarse(scene.around(1.5, &mut rng)) };
        let radius = reach * [0.0, 0.02, 0.2][number % 3];
        let from = Shape::capsule(place, end, radius);
        let way = coarse(rng.point_in([-2.0 * reach; 3], [2.0 * reach; 3]));
        let mut to = from.clone();
        to.corners.iter_mut().for_each(|p| *p = [0, 1, 2].map(|k| p[k] + way[k]));
        let whole = swept(&from, way, 1.0).truth(&scene);
        let radius = f64::from(radius);
        for tree in scene.trees() {
            let found = ask(&tree, &from, &to);
            let say = format!("{name} {from:?} by {way:?}: {found:?} {whole:?}");
            let error = f64::from(tree.surface_error());
            let doubt = 2.0 * error + 1e-5 * scene.reach();
            if found.is_clear() {
                assert!(whole.upper > radius, "{say}");
                tally.clear += 1;
                continue;
            }
            assert!(whole.lower <= radius + doubt, "{say}");
            assert!(0.0 <= found.t.lower && found.t.lower <= found.t.upper, "{say}");
            let before = (found.t.lower * PARTS).floor() / PARTS;
            if before > 0.0 && before * PARTS < found.t.lower * PARTS {
                let clear = swept(&from, way, before).truth(&scene);
                assert!(clear.upper > radius, "{before} {say} {clear:?}");
            }
            let after = (found.t.upper * PARTS).ceil() / PARTS;
            if found.ended == Ended::Exact {
                let met = swept(&from, way, after.min(1.0)).truth(&scene);
                assert!(met.lower <= radius, "{after} {say} {met:?}");
                tally.stopped += 1;
            } else {
                assert_eq!(found.ended, Ended::Resolution, "{say}");
                tally.open += 1;
            }
            // Contact is near where it may be first.
            let next = (found.t.lower * PARTS).ceil() / PARTS;
            let near = swept(&from, way, next.min(1.0)).truth(&scene);
            assert!(near.lower <= radius + doubt, "{next} {say} {near:?}");
        }
    }
    tally
}

#[test]
fn no_motion_of_a_capsule_that_meets_the_mesh_is_clear_and_no_contact_is_late() {
    for (tally, least) in [
        (check("torus", torus(2.0, 0.75, 16, 8), 90, 1), 20),
        (check("rough sphere", rough_sphere(2, 0.4, 3), 90, 2), 20),
        (check("cube", cube(2), 60, 3), 15),
        (check("bracket", bracket(), 36, 4), 10),
        (check("needles", needle_comb(), 45, 5), 10),
    ] {
        assert!(tally.clear > least && tally.stopped > least, "{tally:?}");
    }
}

/// Turned by hand: each corner goes along its own line.
#[test]
fn solids_that_turn_and_stretch_are_clear_where_they_are_said_to_be() {
    let scene = Scene::both("torus", torus(2.0, 0.75, 16, 8));
    let mut rng = Rng::new(6);
    let (mut clear, mut stopped) = (0, 0);
    for kind in 0..60 {
        let at = scene.around(1.5, &mut rng);
        // Not boxes: the faces of one whose corners part are not those of the hull.
        let from = Shape::random(kind % 4, at, 1.0, &mut rng);
        let mut to = from.clone();
        to.corners.iter_mut().for_each(|p| {
            let d = rng.point_in([-2.0; 3], [2.0; 3]);
            *p = [0, 1, 2].map(|k| p[k] + d[k]);
        });
        for tree in scene.trees() {
            let found = ask(&tree, &from, &to);
            clear += usize::from(found.is_clear());
            stopped += usize::from(!found.is_clear());
            let until = found.t.lower.min(1.0);
            if until == 0.0 {
                continue;
            }
            for part in (0..16).map(|k| k as f32 / 15.0 * 0.999 * until) {
                let mut now = from.clone();
                let ends = from.corners.iter().zip(&to.corners);
                now.corners =
                    ends.map(|(a, b)| [0, 1, 2].map(|k| a[k] + (b[k] - a[k]) * part)).collect();
                let truth = now.truth(&scene);
                let slack = 1e-5 * scene.reach();
                assert!(
                    truth.upper > 0.0 && truth.upper >= f64::from(from.radius) - slack,
                    "{from:?} {to:?} at {part}: {found:?} {truth:?}"
                );
            }
        }
    }
    assert!(clear > 20 && stopped > 20, "{clear} {stopped}");
}

#[test]
fn a_solid_that_does_not_move_meets_what_it_is_near_at_once_or_never() {
    let scene = Scene::both("sphere", rough_sphere(2, 0.4, 3));
    let mut rng = Rng::new(7);
    let mut met = 0;
    for kind in 0..50 {
        let shape = Shape::random(kind, scene.around(1.2, &mut rng), 0.5, &mut rng);
        let truth = shape.truth(&scene);
        for tree in scene.trees() {
            let found = ask(&tree, &shape, &shape);
            assert!(found.is_clear() || found.t.lower == 0.0, "{shape:?} {found:?}");
            let radius = f64::from(shape.radius);
            assert!(!found.is_clear() || truth.upper > radius, "{shape:?} {found:?} {truth:?}");
            met += usize::from(!found.is_clear() && found.ended == Ended::Exact);
        }
    }
    assert!(met >= 8, "{met}");
}

/// Along a face at a distance of the radius, and a little nearer and farther.
#[test]
fn grazing_is_clear_only_beyond_the_radius() {
    let scene = Scene::both("cube", cube(4));
    let (_, [_, _, top]) = scene.bounds();
    for (height, is_clear) in [(0.2501, true), (0.2499, false)] {
        let from = Shape::capsule([-3.0, 0.1, top + height], [-3.0, 0.9, top + height], 0.25);
        let mut to = from.clone();
        to.corners.iter_mut().for_each(|p| p[0] += 6.0);
        for tree in scene.trees() {
            let found = ask(&tree, &from, &to);
            assert_eq!(found.is_clear(), is_clear, "{height}: {found:?}");
        }
    }
}
