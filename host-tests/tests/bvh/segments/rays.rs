//! Rays against exact predicates: of each a place behind the mesh is known exactly, so a segment
//! tells what it meets.

use super::scenes::all;
use super::truth::{FACINGS, Met, of_facing, truth};
use meshsweep_core::{
    Budget, Bvh, Ended, Facing, FirstHit, QueryError, ScratchEntry, TriangleHit, Undecided, Verdict,
};
use meshsweep_host_tests::generate::Rng;
use meshsweep_host_tests::generate::rays::{EndedRay, ended_rays};
use meshsweep_host_tests::scene::Scene;

/// The parameters of what is met, as the ray's.
fn along(wanted: &[Met], by: f64) -> [f64; 2] {
    let least = |f: fn(&Met) -> f64| wanted.iter().map(f).fold(f64::INFINITY, f64::min);
    [least(|met| met.t_lower) * by, least(|met| met.t_upper) * by]
}

fn check_first(hit: &FirstHit, wanted: &[Met], ray: &EndedRay, at: &dyn Fn() -> String) {
    let [low, high] = along(wanted, ray.parameter);
    assert!(f64::from(hit.t.lower) <= high, "met earlier, {}: {hit:?}", at());
    assert!(hit.t.lower <= hit.t.upper, "{}: {hit:?}", at());
    if hit.ended == Ended::Exact && !hit.is_clear() {
        assert!(!wanted.is_empty(), "no hit, {}: {hit:?}", at());
        assert!(f64::from(hit.t.upper) >= low, "met later, {}: {hit:?}", at());
        let hit = hit.hit.unwrap_or_else(|| panic!("{}: {hit:?}", at()));
        assert!(hit.t.is_finite() && hit.point.iter().all(|x| x.is_finite()), "{}", at());
    }
}

/// Asks everything about a ray. Returns whether the first hit was proved, and whether it was clear.
/// `None`: the ray begins too far away.
fn prove(
    tree: &Bvh<'_>,
    ray: &EndedRay,
    facing: Facing,
    wanted: &[Met],
    name: &str,
) -> Option<[bool; 2]> {
    let at = || format!("{name}, f32 {}, {facing:?}, {ray:?}, {wanted:?}", tree.header().is_f32());
    let mut stack = vec![ScratchEntry::EMPTY; 4096];
    let (from, way, exact) = (ray.origin, ray.direction, Budget::EXACT);
    let hit = tree.first_hit_of_ray(from, way, facing, exact, &mut stack);
    if hit == Err(QueryError::OutOfDomain) {
        return None;
    }
    let hit = hit.expect("answers");
    check_first(&hit, wanted, ray, &at);
    let any = tree.any_hit_of_ray(from, way, facing, exact, &mut stack).expect("answers");
    let same = match (hit.is_clear(), hit.ended) {
        (true, _) => Verdict::No,
        (_, Ended::Exact) => Verdict::Yes,
        _ => Verdict::Undecided(Undecided::Resolution),
    };
    assert_eq!(any.verdict, same, "{}: {hit:?}", at());
    for (budget, entries) in [(exact, 1), (exact, 5), (exact.with_steps(2), 4096)] {
        let short = tree.first_hit_of_ray(from, way, facing, budget, &mut stack[..entries]);
        check_first(&short.expect("answers"), wanted, ray, &at);
    }
    let mut hits = vec![TriangleHit::EMPTY; 1024];
    let all = tree.all_hits_of_ray(from, way, facing, &mut hits, exact, &mut stack);
    let all = all.expect("answers");
    let hits = &hits[..all.stored];
    assert!(all.dropped == 0 && hits.is_sorted_by(|x, y| x.hit.t <= y.hit.t), "{}", at());
    let mut found: Vec<u32> = hits.iter().map(|x| x.hit.triangle.expect("numbered")).collect();
    found.sort_unstable();
    let mut expected: Vec<u32> = wanted.iter().map(|met| met.triangle).collect();
    expected.sort_unstable();
    if all.ended == Ended::Exact {
        assert_eq!(found, expected, "{}", at());
    }
    let lacks = expected.iter().any(|triangle| found.binary_search(triangle).is_err());
    assert!(!(lacks && all.is_complete), "{}: {hits:?}", at());
    assert!(hits.iter().filter(|hit| hit.is_certain).count() <= expected.len(), "{}", at());
    Some([hit.ended == Ended::Exact && !hit.is_clear(), hit.is_clear()])
}

fn reach(scene: &Scene) -> f32 {
    scene.positions.iter().flatten().fold(0.0, |most, x| most.max(x.abs()))
}

#[test]
fn rays_meet_what_segments_along_them_meet_and_nothing_else() {
    let (mut asked, mut refused, mut proved, mut clear) = (0, 0, 0, 0);
    for scene in all().iter().filter(|scene| reach(scene) > 0.0) {
        let rng = &mut Rng::new(81);
        for ray in ended_rays(&scene.positions, reach(scene), 160, rng) {
            let met = truth(scene, ray.origin, ray.end);
            for tree in &scene.trees() {
                for facing in FACINGS {
                    let wanted = of_facing(&met, facing);
                    let Some([is_hit, is_clear]) = prove(tree, &ray, facing, &wanted, &scene.name)
                    else {
                        refused += 1;
                        continue;
                    };
                    asked += 1;
                    proved += usize::from(is_hit);
                    clear += usize::from(is_clear);
                }
            }
        }
    }
    println!("{asked} asked, {refused} too far, {proved} hits proved, {clear} clear");
    assert!(refused < asked / 2, "{refused}");
    assert!(proved > asked / 12 && clear > asked / 3, "{asked} {proved} {clear}");
}

#[test]
fn a_longer_direction_by_a_power_of_two_changes_parameters_alone() {
    for scene in all().iter().filter(|scene| reach(scene) > 0.0) {
        let rng = &mut Rng::new(82);
        for ray in ended_rays(&scene.positions, reach(scene), 48, rng) {
            for (tree, powers) in scene.trees().iter().zip([60, 1]) {
                let mut stack = vec![ScratchEntry::EMPTY; 256];
                let mut ask = |ray: &EndedRay| {
                    let (from, way) = (ray.origin, ray.direction);
                    tree.first_hit_of_ray(from, way, Facing::Both, Budget::EXACT, &mut stack).ok()
                };
                // Too far away.
                let Some(hit) = ask(&ray) else { continue };
                for longer in [powers, -powers].map(|powers| ray.longer(powers)) {
                    let Some(longer) = longer else { continue };
                    let other = ask(&longer).expect("as far away");
                    let by = (longer.parameter / ray.parameter) as f32;
                    let place = |hit: &FirstHit| hit.hit.map(|hit| (hit.point, hit.triangle));
                    assert_eq!(place(&hit), place(&other), "{ray:?}");
                    assert_eq!(hit.ended, other.ended, "{ray:?}");
                    assert_eq!(hit.t.lower * by, other.t.lower, "{ray:?}");
                    assert_eq!(hit.t.upper * by, other.t.upper, "{ray:?}");
                    assert_eq!(hit.hit.map(|x| x.t * by), other.hit.map(|x| x.t), "{ray:?}");
                }
            }
        }
    }
}

/// Parameters beyond f32: the wall is 10 away, and the direction is the least number of f32.
#[test]
fn a_direction_at_the_ends_of_f32_is_answered() {
    let scene = &all()[0];
    let tree = &scene.trees()[0];
    let mut stack = vec![ScratchEntry::EMPTY; 256];
    let size = reach(scene);
    let from = [-3.0 * size, 0.01 * size, 0.02 * size];
    let mut ask = |way: [f32; 3]| {
        tree.first_hit_of_ray(from, way, Facing::Both, Budget::EXACT, &mut stack).expect("answers")
    };
    let plain = ask([1.0, 0.0, 0.0]);
    assert!(plain.hit.is_some() && !plain.is_clear());
    for x in [f32::from_bits(1), f32::MIN_POSITIVE, 1e-20, 1e20, f32::MAX] {
        let hit = ask([x, 0.0, 0.0]);
        assert_eq!(hit.hit.map(|hit| hit.triangle), plain.hit.map(|hit| hit.triangle), "{x:e}");
        let way = f64::from(hit.t.lower) * f64::from(x);
        assert!(way <= f64::from(plain.t.upper) * (1.0 + 1e-6), "{x:e} {hit:?}");
        let upper = f64::from(hit.t.upper);
        assert!(upper * f64::from(x) >= f64::from(plain.t.lower) * (1.0 - 1e-6), "{x:e} {hit:?}");
        assert!(ask([-x, 0.0, 0.0]).is_clear(), "{x:e}");
        // A component that is nothing beside the other one.
        let beside = ask([x, x * 1e-30, 0.0]);
        assert!(!beside.is_clear(), "{x:e}");
    }
}

#[test]
fn wrong_rays_are_refused() {
    let scene = &all()[0];
    let tree = &scene.trees()[0];
    let ask = |from, way, entries: usize| {
        let stack = &mut vec![ScratchEntry::EMPTY; entries];
        tree.first_hit_of_ray(from, way, Facing::Both, Budget::EXACT, stack)
    };
    let along = [1.0, 0.0, 0.0];
    assert_eq!(ask([0.0; 3], [0.0, -0.0, 0.0], 9), Err(QueryError::NoDirection));
    assert_eq!(ask([0.0; 3], [f32::NAN, 0.0, 1.0], 9), Err(QueryError::NotFinite));
    assert_eq!(ask([0.0; 3], [f32::INFINITY, 0.0, 1.0], 9), Err(QueryError::NotFinite));
    assert_eq!(ask([0.0, f32::NAN, 0.0], along, 9), Err(QueryError::NotFinite));
    assert_eq!(ask([f32::MAX, 0.0, 0.0], along, 9), Err(QueryError::OutOfDomain));
    assert_eq!(ask([0.0; 3], along, 0), Err(QueryError::NoScratch));
}
