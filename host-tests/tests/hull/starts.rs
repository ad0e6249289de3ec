//! Segments that start outside the hull, between hull and surface, and inside the solid: on the
//! whole blob and after each cut.

use super::scenes::options;
use meshsweep::cut::cut;
use meshsweep_core::{
    Budget, Ended, Hit, Hull, OuterSearch, RefinedHull, ScratchEntry, TriangleHit,
};
use meshsweep_host_tests::generate::{Rng, groove_block, rough_sphere, torus};
use meshsweep_host_tests::oracle::{Contact, contacts, winding_number};
use meshsweep_host_tests::scene::Scene;

/// Splits of the refined hull: more than any of the scenes has.
const ALL: usize = 2048;

fn scenes() -> [Scene; 3] {
    [
        Scene::hull("groove block", groove_block(), &options(12)),
        Scene::hull("torus", torus(2.0, 0.75, 24, 12), &options(24)),
        Scene::hull("rough sphere", rough_sphere(3, 0.3, 7), &options(40)),
    ]
}

/// Outside of the base hull (0), between it and the surface (1), inside the solid (2).
fn place(scene: &Scene, base: &[[u32; 3]], hull: &[[f32; 3]], p: [f32; 3]) -> usize {
    let unit = scene.reach();
    let is_in = |positions: &[[f32; 3]], triangles: &[[u32; 3]]| {
        winding_number(p.map(f64::from), positions, triangles, unit) > 0.5
    };
    if is_in(&scene.positions, &scene.triangles) { 2 } else { usize::from(is_in(hull, base)) }
}

fn first(contacts: &[Contact]) -> f64 {
    contacts.iter().map(|contact| contact.t_upper).fold(f64::INFINITY, f64::min)
}

#[test]
fn a_segment_may_start_outside_between_hull_and_surface_or_inside_on_cut_blobs_too() {
    let mut starts = [0usize; 3];
    let (mut cut_hits, mut cut_clear) = (0, 0);
    for scene in scenes() {
        let whole = scene.model();
        let levels = whole.levels().count() as u32;
        let hull: Vec<[f32; 3]> = (0..whole.header().vertices)
            .map(|v| whole.vertex(meshsweep_core::VertIdx(v)).expect("in range"))
            .collect();
        let level = whole.level(0).expect("the base");
        let base: Vec<[u32; 3]> =
            whole.faces(&level).map(|face| face.corners.map(|v| v.0)).collect();
        let blobs: Vec<Vec<u8>> =
            (0..levels).map(|level| cut(&whole, level).expect("cuts").to_bytes()).collect();
        let mut rng = Rng::new(61);
        for _ in 0..250 {
            let (a, b) = (scene.around(1.0, &mut rng), scene.around(1.3, &mut rng));
            starts[place(&scene, &base, &hull, a)] += 1;
            let truth = contacts(a, b, &scene.positions, &scene.triangles);
            for bytes in &blobs {
                let model = Hull::open(bytes).expect("opens");
                let mut scratch = vec![ScratchEntry::EMPTY; model.scratch_entries()];
                let answer = model.first_hit(a, b, Budget::EXACT, &mut scratch).expect("answers");
                let mut hits = [TriangleHit::EMPTY; 64];
                let all =
                    model.all_hits(a, b, &mut hits, Budget::EXACT, &mut scratch).expect("answers");
                let say = format!("{}: {a:?} {b:?}: {answer:?}", scene.name);
                assert!(f64::from(answer.t.lower) <= first(&truth), "{say}");
                assert_eq!(answer.is_clear(), all.stored == 0, "{say}");
                assert!(all.stored > 0 || truth.is_empty(), "{say}");
                if model.is_cut() {
                    cut_hits += usize::from(!truth.is_empty());
                    cut_clear += usize::from(answer.is_clear());
                    let ended = if answer.is_clear() { Ended::Exact } else { Ended::Resolution };
                    assert_eq!((answer.ended, all.ended), (ended, ended), "{say}");
                    // Each true hit has a place on the hull at or before it.
                    let known =
                        hits[..all.stored].first().map_or(f32::INFINITY, |listed| listed.hit.t);
                    assert!(f64::from(known) <= first(&truth) + 1e-5, "{say}");
                } else {
                    assert_eq!(answer.hit.is_some(), !truth.is_empty(), "{say}");
                    assert_eq!(all.stored, truth.len(), "{say}");
                }
            }
        }
    }
    assert!(starts.iter().all(|&count| count > 40), "{starts:?}");
    assert!(cut_hits > 300 && cut_clear > 30, "{cut_hits} {cut_clear}");
}

#[test]
fn a_hull_that_is_kept_for_many_segments_answers_as_a_fresh_one() {
    let (mut outside, mut kept_splits, mut fresh_splits) = (0, 0u64, 0u64);
    for scene in scenes() {
        let model = scene.model();
        assert!(model.split_count() as usize <= ALL);
        let mut scratch = [ScratchEntry::EMPTY; 1024];
        for kept_for in [2, 10, 100] {
            let mut kept = Box::new(RefinedHull::<ALL>::new());
            let mut fresh = Box::new(RefinedHull::<ALL>::new());
            let mut rng = Rng::new(62);
            for i in 0..100 {
                if i % kept_for == 0 {
                    kept.reset();
                }
                fresh.reset();
                let (a, b) = (scene.around(3.0, &mut rng), scene.around(1.0, &mut rng));
                for search in [OuterSearch::First, OuterSearch::Outer] {
                    let [one, other] = [&mut kept, &mut fresh].map(|refined| {
                        let mut hits = [Hit::EMPTY; 64];
                        let answer = model
                            .outer_hits(
                                a,
                                b,
                                search,
                                refined,
                                &mut hits,
                                Budget::EXACT,
                                &mut scratch,
                            )
                            .expect("answers");
                        (answer, hits)
                    });
                    assert_eq!(one.0.ended, Ended::Exact);
                    assert_eq!(one.0.starts_inside, other.0.starts_inside);
                    outside += usize::from(!one.0.starts_inside);
                    // A finer hull shows later hits too; the first is the same.
                    assert_eq!((one.0.t, one.1[0]), (other.0.t, other.1[0]), "{}", scene.name);
                    kept_splits += u64::from(one.0.work.opened);
                    fresh_splits += u64::from(other.0.work.opened);
                }
            }
        }
    }
    assert!(outside > 600, "{outside}");
    assert!(2 * kept_splits < fresh_splits, "{kept_splits} {fresh_splits}");
}
