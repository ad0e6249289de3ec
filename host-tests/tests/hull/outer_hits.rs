//! Hits on the refined hull: the first is the surface's first, however short the working memory,
//! and no answer is a wrong "clear".

use super::scenes::{exact, options};
use meshsweep_core::{
    Budget, Ended, Hit, Hull, OuterHits, OuterSearch, QueryError, RefinedHull, ScratchEntry,
};
use meshsweep_host_tests::generate::{Rng, cube, groove_block, rough_sphere, torus};
use meshsweep_host_tests::oracle::contacts;
use meshsweep_host_tests::scene::Scene;
use std::sync::{LazyLock, mpsc};
use std::time::Duration;

type Segment = ([f32; 3], [f32; 3]);

/// Entries of the candidates' list.
type Candidates = usize;

/// Splits of a refined hull that holds all of each scene.
const ALL: usize = 4096;

fn ask<const SPLITS: usize>(
    model: &Hull<'_>,
    segment: Segment,
    search: OuterSearch,
    candidates: Candidates,
) -> (OuterHits, Vec<Hit>) {
    ask_again(model, segment, search, candidates, &mut Box::new(RefinedHull::<SPLITS>::new()))
}

/// From the hull that earlier segments left.
fn ask_again<'t, const SPLITS: usize>(
    model: &Hull<'t>,
    (a, b): Segment,
    search: OuterSearch,
    candidates: Candidates,
    refined: &mut RefinedHull<'t, SPLITS>,
) -> (OuterHits, Vec<Hit>) {
    // What the memory held before does not matter.
    let mut scratch = vec![ScratchEntry::EMPTY; candidates];
    let mut hits = vec![Hit::EMPTY; 256];
    let answer = model
        .outer_hits(a, b, search, refined, &mut hits, Budget::EXACT, &mut scratch)
        .expect("a segment in the domain");
    hits.truncate(answer.stored);
    (answer, hits)
}

/// A segment from outside the hull's box to somewhere around the mesh.
fn from_outside(scene: &Scene, rng: &mut Rng) -> Segment {
    let (low, high) = scene.bounds();
    let mut start = scene.around(2.0, rng);
    let axis = rng.below(3);
    let side = 3.0 * (high[axis] - low[axis]).max(0.2 * scene.size());
    start[axis] = if rng.below(2) == 0 { low[axis] - side } else { high[axis] + side };
    let t = rng.below(scene.triangles.len()) as u32;
    let end = match rng.below(4) {
        0 => scene.around(1.5, rng),
        1 => scene.on_triangle(t, rng),
        2 => scene.corners(t)[0],
        _ => {
            let on = scene.on_triangle(t, rng);
            std::array::from_fn(|k| on[k] + (on[k] - start[k]))
        }
    };
    (start, end)
}

#[test]
fn first_outer_hit_is_the_first_hit() {
    for scene in exact() {
        let model = scene.model();
        assert!(model.split_count() as usize <= ALL);
        let mut kept = Box::new(RefinedHull::<ALL>::new());
        let mut queue = vec![ScratchEntry::EMPTY; 1024];
        let mut rng = Rng::new(31);
        let mut asked = 0;
        for _ in 0..200 {
            let segment = from_outside(scene, &mut rng);
            let (outer, hits) = ask::<ALL>(&model, segment, OuterSearch::First, 1024);
            if outer.starts_inside {
                continue;
            }
            asked += 1;
            let (again, _) = ask_again(&model, segment, OuterSearch::First, 1024, &mut kept);
            assert_eq!((again.t, again.ended), (outer.t, outer.ended), "{}: kept", scene.name);
            if asked % 16 == 0 {
                kept.reset();
            }
            let first = model
                .first_hit(segment.0, segment.1, Budget::EXACT, &mut queue)
                .expect("in the domain");
            // A touch of either is not proved.
            let is_whole = matches!(outer.ended, Ended::Exact | Ended::Resolution);
            assert!(is_whole, "{}: {segment:?} {outer:?}", scene.name);
            // Of several triangles that share a point either may be named first.
            let named = first.hit.map(|hit| (hit.t, hit.triangle));
            let found =
                hits.iter().take_while(|hit| hit.t == hits[0].t).map(|hit| (hit.t, hit.triangle));
            let agree = found.clone().any(|pair| Some(pair) == named)
                || (named.is_none() && hits.is_empty());
            assert!(agree, "{}: {segment:?}: {outer:?} {hits:?} {first:?}", scene.name);
            assert_eq!(
                outer.t.lower == f32::INFINITY,
                first.is_clear(),
                "{}: {segment:?}",
                scene.name
            );
        }
        assert!(asked > 100, "{}: {asked} started outside", scene.name);
    }
}

#[test]
fn outer_search_names_only_true_hits_and_the_first_of_all() {
    for scene in exact() {
        let model = scene.model();
        let mut kept = Box::new(RefinedHull::<ALL>::new());
        let mut rng = Rng::new(32);
        for _ in 0..100 {
            let segment = from_outside(scene, &mut rng);
            let (outer, hits) = ask_again(&model, segment, OuterSearch::Outer, 1024, &mut kept);
            if outer.starts_inside {
                continue;
            }
            let truth = contacts(segment.0, segment.1, &scene.positions, &scene.triangles);
            assert!(hits.is_sorted_by(|x, y| x.t <= y.t));
            if let Some(first) = truth.first() {
                assert!(
                    f64::from(outer.t.lower) <= first.t_upper,
                    "{}: {segment:?}: {outer:?} {first:?}",
                    scene.name
                );
                assert!(
                    f64::from(hits[0].t) <= first.t_upper + 1e-6,
                    "{}: {segment:?}: {outer:?}",
                    scene.name
                );
            }
            for hit in &hits {
                let triangle = hit.triangle.expect("a whole blob");
                let corners = scene.corners(triangle);
                let gap =
                    meshsweep_host_tests::oracle::gap_to_triangle(segment.0, segment.1, corners);
                let size = f64::from(scene.size())
                    * if scene.name == "needle comb" { 65_536.0 } else { 1.0 };
                assert!(
                    gap <= 1e-12 * (size + scene.reach()) * 8.0,
                    "{}: {segment:?}: {hit:?}",
                    scene.name
                );
            }
        }
    }
}

/// Runs in a thread, so that a search that does not end fails the test and not the machine.
fn in_time(what: &str, run: impl FnOnce() + Send + 'static) {
    let (done, wait) = mpsc::channel();
    let thread = std::thread::spawn(move || {
        run();
        let _ = done.send(());
    });
    match wait.recv_timeout(Duration::from_secs(60)) {
        Ok(()) => {}
        Err(mpsc::RecvTimeoutError::Timeout) => panic!("{what}: the search does not end"),
        Err(mpsc::RecvTimeoutError::Disconnected) => {
            let panic = thread.join().expect_err("it ended without a word");
            std::panic::resume_unwind(panic);
        }
    }
}

/// Questions that are asked with little memory.
static SMALL: LazyLock<[Scene; 3]> = LazyLock::new(|| {
    [
        Scene::hull("torus", torus(2.0, 0.75, 24, 12), &options(40)),
        Scene::hull("groove block", groove_block(), &options(30)),
        Scene::hull("rough sphere", rough_sphere(2, 0.2, 7), &options(40)),
    ]
});

fn small_memory<const SPLITS: usize>(what: &'static str, lists: &'static [Candidates]) {
    in_time(what, move || {
        for scene in &*SMALL {
            let model = scene.model();
            let mut rng = Rng::new(33);
            let mut kept = Box::new(RefinedHull::<SPLITS>::new());
            for _ in 0..60 {
                let segment = from_outside(scene, &mut rng);
                let truth = contacts(segment.0, segment.1, &scene.positions, &scene.triangles);
                let (whole, _) = ask::<ALL>(&model, segment, OuterSearch::First, 1024);
                for &list in lists {
                    for search in [OuterSearch::First, OuterSearch::Outer] {
                        let fresh = ask::<SPLITS>(&model, segment, search, list);
                        let again = ask_again(&model, segment, search, list, &mut kept);
                        for (outer, hits) in [fresh, again] {
                            let say = || {
                                format!("{}: {segment:?} {list}: {outer:?} {truth:?}", scene.name)
                            };
                            if let Some(first) = truth.first() {
                                assert!(
                                    f64::from(outer.t.lower) <= first.t_upper,
                                    "a wrong clear: {}",
                                    say()
                                );
                            }
                            if outer.ended == Ended::Exact
                                && search == OuterSearch::First
                                && !outer.starts_inside
                            {
                                assert_eq!(outer.t.lower, whole.t.lower, "{}", say());
                                assert_eq!(hits.is_empty(), truth.is_empty(), "{}", say());
                            }
                        }
                    }
                }
            }
        }
    });
}

#[test]
fn short_candidate_list_ends_and_changes_no_answer() {
    small_memory::<ALL>("a few candidates", &[1, 2, 3, 17]);
}

#[test]
fn no_candidate_list_ends_and_is_never_a_wrong_clear() {
    small_memory::<ALL>("no candidates", &[0]);
}

#[test]
fn few_splits_are_never_a_wrong_clear() {
    small_memory::<0>("no splits", &[1024]);
    small_memory::<1>("one split", &[1024]);
    small_memory::<32>("a few splits", &[1024]);
}

#[test]
fn few_splits_with_a_short_candidate_list_end() {
    small_memory::<0>("no splits, few candidates", &[0, 1]);
    small_memory::<5>("five splits, few candidates", &[1, 3]);
    small_memory::<64>("some splits, few candidates", &[2]);
}

#[test]
fn a_start_inside_the_hulls_box_is_said_and_nothing_is_promised() {
    let scene = Scene::hull("groove block", groove_block(), &options(12));
    let (outer, hits) =
        ask::<64>(&scene.model(), ([15.0, 20.0, 8.0], [15.0, 20.0, 14.0]), OuterSearch::First, 64);
    assert!(outer.starts_inside && outer.t.lower == 0.0 && hits.is_empty());
}

#[test]
fn a_moved_surface_gets_no_wrong_clear() {
    let vertex_bits = meshsweep::surface::VertexBits::Grid16;
    let options = meshsweep::hull::BuildOptions { vertex_bits, ..options(40) };
    let scene = Scene::hull("rough sphere", rough_sphere(2, 0.2, 7), &options);
    let model = scene.model();
    assert!(model.header().surface_error > 0.0);
    let mut rng = Rng::new(34);
    for _ in 0..300 {
        let segment = from_outside(&scene, &mut rng);
        let (outer, _) = ask::<64>(&model, segment, OuterSearch::First, 64);
        let truth = contacts(segment.0, segment.1, &scene.positions, &scene.triangles);
        if let Some(first) = truth.first() {
            assert!(f64::from(outer.t.lower) <= first.t_upper, "{segment:?}: {outer:?} {first:?}");
        }
    }
}

#[test]
fn nan_infinity_and_far_ends_are_typed_errors() {
    let scene = Scene::hull("cube", cube(2), &options(12));
    let model = scene.model();
    for (p, error) in [
        ([f32::NAN, 0.0, 0.0], QueryError::NotFinite),
        ([0.0, f32::NEG_INFINITY, 0.0], QueryError::NotFinite),
        ([0.0, 0.0, 1e30], QueryError::OutOfDomain),
    ] {
        for (a, b) in [(p, [9.0; 3]), ([9.0; 3], p)] {
            let (mut refined, first) = (RefinedHull::<4>::new(), OuterSearch::First);
            let answer =
                model.outer_hits(a, b, first, &mut refined, &mut [], Budget::EXACT, &mut []);
            assert_eq!(answer, Err(error));
        }
    }
}
