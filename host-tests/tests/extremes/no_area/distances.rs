//! Questions of points on the box tree against the exact oracle.

use crate::checks::{
    bits_are_kept_on_a_path, bits_do_not_depend_on_the_way, holds, intervals_are_narrow,
    neighbors_are_complete, verdicts_are_true, wrong_intervals,
};
use crate::scene::{Kind, Scene, pierced_cube, scenes};
use meshsweep_core::{Budget, Eye, Interval, Side};
use meshsweep_host_tests::oracle::exact::distance_compared;
use std::cmp::Ordering::Greater;

#[test]
fn every_interval_of_closest_points_holds_the_exact_distance() {
    let wrong: Vec<_> =
        scenes().iter().flat_map(|scene| wrong_intervals(scene, &scene.points(300, 11))).collect();
    let shown = wrong.iter().take(5).cloned().collect::<Vec<_>>().join("\n");
    assert!(wrong.is_empty(), "{} intervals are wrong:\n{shown}", wrong.len());
}

#[test]
fn intervals_are_as_narrow_as_those_of_triangles() {
    for scene in scenes() {
        intervals_are_narrow(scene, &scene.points(100, 12));
    }
}

#[test]
fn verdicts_of_being_within_a_distance_are_true() {
    let mut seen = [0; 3];
    for scene in scenes() {
        verdicts_are_true(scene, &scene.points(60, 13), &mut seen);
    }
    assert!(seen[0] > 1000 && seen[1] > 1000, "{seen:?}");
}

#[test]
fn nearest_triangles_and_all_within_a_distance_miss_nothing() {
    for scene in scenes() {
        neighbors_are_complete(scene, &scene.points(60, 14));
    }
}

#[test]
fn batches_and_moving_queries_give_the_bits_of_single_ones() {
    for scene in scenes() {
        bits_do_not_depend_on_the_way(scene, &scene.points(90, 15));
        let ends = scene.points(6, 16);
        bits_are_kept_on_a_path(scene, [ends[3], ends[5]]);
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
            let [lower, upper] = match answer.side {
                Side::Inside => [-answer.distance.upper, -answer.distance.lower],
                Side::Outside => [answer.distance.lower, answer.distance.upper],
                _ => [0.0, answer.distance.upper],
            };
            let interval = Interval { lower, upper };
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
