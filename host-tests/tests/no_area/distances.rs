//! Questions of points on the box tree against the exact oracle.

use super::exact::{Corners, distance_compared};
use super::scene::{Kind, Scene, pierced_cube, scenes};
use meshsweep_core::{Budget, Bvh, CoherentQuery, Ended, Eye, Hint, Neighbor, Side, Verdict};
use std::cmp::Ordering::{Greater, Less};

/// Whether the distance to some of the input lies in an interval, by exact comparisons.
fn holds(triangles: &[&Corners], p: [f32; 3], [lower, upper]: [f32; 2]) -> bool {
    let p = p.map(f64::from);
    let upper_holds = upper == f32::INFINITY
        || triangles.iter().any(|t| distance_compared(p, t, upper.into()) != Greater);
    upper_holds && triangles.iter().all(|t| distance_compared(p, t, lower.into()) != Less)
}

#[test]
fn every_interval_of_closest_points_holds_the_exact_distance() {
    let (mut asked, mut wrong) = (0, Vec::new());
    for scene in scenes() {
        let (tree, mut stack) = (scene.tree(), scene.stack());
        for p in scene.points(300, 11) {
            let truth = scene.nearest(p);
            let budgets =
                [Budget::EXACT, Budget::EXACT.with_relative(0.1), Budget::EXACT.with_steps(2)];
            for budget in budgets {
                let answer = tree.closest_point(p, budget, &mut stack).expect("a point");
                asked += 1;
                if !holds(&truth, p, [answer.distance.lower, answer.distance.upper]) {
                    wrong.push(format!("{}: {p:?} {budget:?}: {answer:?}", scene.name));
                }
            }
        }
    }
    let shown = wrong.iter().take(5).cloned().collect::<Vec<_>>().join("\n");
    assert!(wrong.is_empty(), "{} of {asked} intervals are wrong:\n{shown}", wrong.len());
}

#[test]
fn intervals_are_as_narrow_as_those_of_triangles() {
    for scene in scenes() {
        let (tree, mut stack) = (scene.tree(), scene.stack());
        let unit = 2f64.powi(tree.scale_exponent() + tree.header().grid_exponent);
        let error = f64::from(tree.header().surface_error) * 2f64.powi(tree.scale_exponent());
        let reach = f64::from(tree.header().star_radius) * unit;
        for p in scene.points(100, 12) {
            let answer = tree.closest_point(p, Budget::EXACT, &mut stack).expect("a point");
            let (lower, upper) =
                (f64::from(answer.distance.lower), f64::from(answer.distance.upper));
            let allowed = 2.0 * error + 1.5 * unit + 1e-5 * (upper + reach);
            assert!(
                upper - lower <= allowed.max(1e-5 * scene.length()) && answer.ended == Ended::Exact,
                "{}: {p:?} {answer:?}, {allowed:e} allowed",
                scene.name
            );
        }
    }
}

#[test]
fn verdicts_of_being_within_a_distance_are_true() {
    let mut seen = [0; 3];
    for scene in scenes() {
        let (tree, mut stack) = (scene.tree(), scene.stack());
        for p in scene.points(60, 13) {
            let truth = scene.nearest(p);
            let about =
                tree.closest_point(p, Budget::EXACT, &mut stack).expect("a point").distance.upper;
            for distance in
                [0.0, 0.5 * about, 0.999_999 * about, about, 1.000_001 * about, 2.0 * about]
            {
                let is_near = truth
                    .iter()
                    .any(|t| distance_compared(p.map(f64::from), t, distance.into()) != Greater);
                let within = tree.within(p, distance, Budget::EXACT, &mut stack);
                let verdict = within.expect("a distance").verdict;
                let wrong = match verdict {
                    Verdict::Yes => !is_near,
                    Verdict::No => is_near,
                    _ => false,
                };
                assert!(!wrong, "{}: {p:?} within {distance:e}: {verdict:?}", scene.name);
                seen[match verdict {
                    Verdict::Yes => 0,
                    Verdict::No => 1,
                    _ => 2,
                }] += 1;
            }
        }
    }
    assert!(seen[0] > 1000 && seen[1] > 1000, "{seen:?}");
}

/// Whether each of the neighbours is as far away as said, by its number in the input, and no other
/// triangle nearer than `beyond`.
fn check_neighbors(scene: &Scene, p: [f32; 3], found: &[Neighbor], beyond: f32) {
    let at = p.map(f64::from);
    // Of triangles that share edges or numbers only one may be kept, so each has its own interval.
    for neighbor in found {
        let corners = &scene.corners[neighbor.triangle() as usize];
        // A flipped cap's halves have the number of the whole, which is nearer.
        let is_far = distance_compared(at, corners, neighbor.distance().upper.into()) == Greater;
        assert!(!is_far, "{}: {p:?} {neighbor:?}", scene.name);
    }
    let least = found.iter().map(|n| n.distance().lower).fold(beyond, f32::min);
    for corners in scene.nearest(p) {
        let is_missed = distance_compared(at, corners, least.into()) == Less;
        assert!(!is_missed, "{}: {p:?}: {found:?} beyond {beyond:e}", scene.name);
    }
}

#[test]
fn nearest_triangles_and_all_within_a_distance_miss_nothing() {
    for scene in scenes() {
        let (tree, mut stack) = (scene.tree(), scene.stack());
        let mut slots = vec![Neighbor::EMPTY; scene.corners.len() + 64];
        for p in scene.points(60, 14) {
            let answer =
                tree.nearest(p, &mut slots[..3], Budget::EXACT, &mut stack).expect("a point");
            check_neighbors(&scene, p, &slots[..answer.stored], answer.rest_lower);
            let radius = (0.3 * scene.length()) as f32;
            let answer = tree
                .all_within(p, radius, &mut slots, Budget::EXACT, &mut stack)
                .expect("a distance");
            assert_eq!(answer.dropped, 0);
            check_neighbors(&scene, p, &slots[..answer.stored], radius);
        }
    }
}

#[test]
fn batches_and_moving_queries_give_the_bits_of_single_ones() {
    for scene in scenes() {
        let (tree, mut stack) = (scene.tree(), scene.stack());
        let points = scene.points(90, 15);
        let single: Vec<_> = points
            .iter()
            .map(|&p| tree.closest_point(p, Budget::EXACT, &mut stack).expect("a point"))
            .collect();
        let mut batch = single.clone();
        batch.iter_mut().for_each(|answer| answer.distance.upper = -1.0);
        let hint = &mut Hint::NONE.clone();
        tree.closest_points(&points, hint, &mut batch, Budget::EXACT, &mut stack).expect("points");
        let mut query = CoherentQuery::<64>::new();
        for ((&p, single), batch) in points.iter().zip(&single).zip(&batch) {
            let moving = query.closest_point(&tree, p, Budget::EXACT, &mut stack).expect("a point");
            for other in [batch, &moving.closest] {
                let bits = |a: &meshsweep_core::ClosestPoint| {
                    (
                        a.distance.lower.to_bits(),
                        a.distance.upper.to_bits(),
                        a.point.map(f32::to_bits),
                        a.triangle,
                    )
                };
                assert_eq!(bits(single), bits(other), "{}: {p:?}", scene.name);
            }
        }
        follow(&scene, &tree);
    }
}

/// A path in small steps past the input.
fn follow(scene: &Scene, tree: &Bvh<'_>) {
    let (mut stack, mut query) = (scene.stack(), CoherentQuery::<32>::new());
    let ends = scene.points(6, 16);
    let [from, to] = [ends[3], ends[5]].map(|p| p.map(f64::from));
    for step in 0..60 {
        let t = f64::from(step) / 60.0;
        let p = std::array::from_fn(|k| (from[k] + t * (to[k] - from[k])) as f32);
        let plain = tree.closest_point(p, Budget::EXACT, &mut stack).expect("a point");
        let moving = query.closest_point(tree, p, Budget::EXACT, &mut stack).expect("a point");
        assert_eq!(
            (plain.distance.lower, plain.distance.upper, plain.point, plain.triangle),
            (
                moving.closest.distance.lower,
                moving.closest.distance.upper,
                moving.closest.point,
                moving.closest.triangle
            ),
            "{}: {p:?}",
            scene.name
        );
    }
}

#[test]
fn a_side_is_never_wrong_and_none_is_decided_where_a_wire_is_nearest() {
    for kind in [Kind::Grid, Kind::F32, Kind::Snapped] {
        let scene = Scene::new("pierced cube", &pierced_cube(), kind);
        let (tree, mut stack) = (scene.tree(), scene.stack());
        assert!(tree.header().is_closed());
        let solid = scene.corners.len() - 5;
        let mut seen = [0; 3];
        for p in scene.points(2000, 17) {
            let answer = tree.signed_distance(p, Budget::EXACT, &mut stack).expect("a point");
            let at = p.map(f64::from);
            let is_inside = at.iter().all(|x| x.abs() < 1.0);
            let upper = f64::from(answer.closest.distance.upper);
            let is_wire = scene.corners[..solid]
                .iter()
                .all(|t| distance_compared(at, t, upper * 1.001 + 1e-4) == Greater);
            match answer.side {
                Side::Inside => assert!(is_inside && !is_wire, "{kind:?} {p:?} {answer:?}"),
                Side::Outside => assert!(!is_inside && !is_wire, "{kind:?} {p:?} {answer:?}"),
                _ => {}
            }
            let kind = [Side::Inside, Side::Outside].iter().position(|side| *side == answer.side);
            seen[kind.unwrap_or(2)] += 1;
            let near = scene.nearest(p);
            let interval = match answer.side {
                Side::Inside => [-answer.distance.upper, -answer.distance.lower],
                Side::Outside => [answer.distance.lower, answer.distance.upper],
                _ => [0.0, answer.distance.upper],
            };
            assert!(holds(&near, p, interval), "{kind:?} {p:?} {answer:?}");
        }
        assert!(seen.iter().all(|&n| n > 100), "{seen:?}");
    }
}

#[test]
fn culling_keeps_every_wire() {
    for scene in scenes() {
        let tree = scene.tree();
        let mut found = vec![0; tree.header().triangles as usize];
        for sight in [Eye::Along([0.3, -1.0, 0.2]), Eye::At([3.0, 2.0, -4.0])] {
            let answer = tree.front_facing(sight, &mut found).expect("a place");
            let kept = &found[..answer.stored];
            let sources = scene.mesh.wires.iter().map(|wire| wire.source);
            assert!(sources.into_iter().all(|n| kept.contains(&n)), "{}", scene.name);
        }
    }
}
