//! Rays on the split tables against exact predicates: of each a place behind the mesh is known
//! exactly, so a segment tells what it meets.

use super::scenes::all;
use meshsweep_core::{Budget, Ended, QueryError, ScratchEntry, TriangleHit};
use meshsweep_host_tests::generate::Rng;
use meshsweep_host_tests::generate::rays::ended_rays;
use meshsweep_host_tests::oracle::{contacts, gap_to_triangle};
use meshsweep_host_tests::scene::Scene;

fn reach(scene: &Scene) -> f32 {
    scene.positions.iter().flatten().fold(0.0, |most, x| most.max(x.abs()))
}

#[test]
fn rays_meet_what_segments_along_them_meet_and_nothing_else() {
    let (mut asked, mut proved, mut clear) = (0, 0, 0);
    for scene in all() {
        let model = scene.model();
        let error = f64::from(model.header().surface_error) * model.scale();
        let mut queue = vec![ScratchEntry::EMPTY; 4096];
        let mut hits = vec![TriangleHit::EMPTY; 512];
        let rng = &mut Rng::new(83);
        for ray in ended_rays(&scene.positions, reach(scene), 240, rng) {
            for ray in [Some(ray), ray.longer(-40), ray.longer(20)].into_iter().flatten() {
                let met = contacts(ray.origin, ray.end, &scene.positions, &scene.triangles);
                let (from, way) = (ray.origin, ray.direction);
                let found = model.first_hit_of_ray(from, way, Budget::EXACT, &mut queue);
                let found = found.expect("answers");
                let at = || format!("{}: {ray:?} {found:?} {met:?}", scene.name);
                let least = |of: fn(&meshsweep_host_tests::oracle::Contact) -> f64| {
                    met.iter().map(of).fold(f64::INFINITY, f64::min) * ray.parameter
                };
                let (low, high) = (least(|met| met.t_lower), least(|met| met.t_upper));
                assert!(f64::from(found.t.lower) <= high, "met earlier, {}", at());
                assert!(found.t.lower <= found.t.upper, "{}", at());
                if found.ended == Ended::Exact && !found.is_clear() {
                    assert!(!met.is_empty() && f64::from(found.t.upper) >= low, "{}", at());
                    proved += 1;
                }
                asked += 1;
                clear += usize::from(found.is_clear());
                // A hit that is none is a touch.
                let lengths = ray.origin.iter().chain(&ray.end);
                let lengths = lengths.fold(scene.reach(), |most, x| most.max(f64::from(x.abs())));
                let aspect = if scene.name == "needle comb" { 65_536.0 } else { 1.0 };
                // Triple products carry the square of the way from the start to the triangle.
                let far = f64::max(1.0, lengths / scene.reach());
                let touch = 1e-12 * aspect * lengths * far + error * (1.0 + 1e-6);
                let all = model.all_hits_of_ray(from, way, &mut hits, Budget::EXACT, &mut queue);
                let all = all.expect("answers");
                let listed = &hits[..all.stored];
                assert!(listed.is_sorted_by(|x, y| x.hit.t <= y.hit.t), "{}", at());
                let named = |number: u32| listed.iter().any(|x| x.hit.triangle == Some(number));
                assert!(met.iter().all(|met| named(met.triangle)), "{}: {listed:?}", at());
                for listed in listed {
                    let corners = scene.corners(listed.hit.triangle.expect("a whole blob"));
                    let gap = gap_to_triangle(ray.origin, ray.end, corners);
                    assert!(gap <= touch && (gap == 0.0 || !listed.is_certain), "{gap:e} {}", at());
                }
                for (budget, entries) in [(Budget::EXACT, 1), (Budget::EXACT.with_steps(3), 4096)] {
                    let short = model.first_hit_of_ray(from, way, budget, &mut queue[..entries]);
                    assert!(f64::from(short.expect("answers").t.lower) <= high, "{}", at());
                }
            }
        }
    }
    println!("{asked} asked, {proved} hits proved, {clear} clear");
    assert!(proved > asked / 20 && clear > asked / 3, "{asked} {proved} {clear}");
}

#[test]
fn wrong_rays_are_refused() {
    let model = all()[0].model();
    let ask = |from, way, entries: usize| {
        model.first_hit_of_ray(from, way, Budget::EXACT, &mut vec![ScratchEntry::EMPTY; entries])
    };
    let along = [0.0, 0.0, -1.0];
    assert_eq!(ask([0.0; 3], [0.0; 3], 9), Err(QueryError::NoDirection));
    assert_eq!(ask([0.0; 3], [0.0, f32::NAN, 1.0], 9), Err(QueryError::NotFinite));
    assert_eq!(ask([0.0, f32::INFINITY, 0.0], along, 9), Err(QueryError::NotFinite));
    assert_eq!(ask([f32::MAX, 0.0, 0.0], along, 9), Err(QueryError::OutOfDomain));
    assert_eq!(ask([0.0; 3], along, 0), Err(QueryError::NoScratch));
    let mut hits = [TriangleHit::EMPTY; 2];
    let nowhere = model.all_hits_of_ray([0.0; 3], [0.0; 3], &mut hits, Budget::EXACT, &mut []);
    assert_eq!(nowhere, Err(QueryError::NoScratch));
}
