//! The refined hull: every state that the tables allow is closed and encloses the part, and an
//! update gives what its focus needs.

use super::scenes::all;
use meshsweep::check::canonical;
use meshsweep_core::internal::hull::format::SplitIdx;
use meshsweep_core::{
    Budget, Focus, Hull, OuterSearch, QueryError, RefinedHull, Refinement, SectionKind, SplitChange,
};
use meshsweep_host_tests::corrupt::{entries, seal};
use meshsweep_host_tests::generate::Rng;
use meshsweep_host_tests::oracle::distance_to_triangle;
use meshsweep_host_tests::oracle::replayed::{Inside, Replayed, is_needed};
use meshsweep_host_tests::scene::Scene;
use std::collections::BTreeSet;

/// Splits of a refined hull that holds all of each scene.
const ALL: usize = 4096;

#[test]
fn any_order_that_the_tables_allow_gives_a_closed_mesh_around_the_part() {
    for scene in all() {
        let points = Inside::new(scene.model());
        let mut state = Replayed::new(scene.model());
        let count = scene.model().split_count() as usize;
        let mut rng = Rng::new(92);
        let (mut performed, mut undone) = (0, 0);
        for step in 0..600 {
            // Waves of refinement and coarsening, from a split drawn at random on.
            let perform = step / 100 % 3 != 2;
            let from = rng.below(count);
            let legal = (from..count)
                .chain(0..from)
                .map(|s| s as u32)
                .find(|&s| if perform { state.may_perform(s) } else { state.may_undo(s) });
            let Some(split) = legal else { continue };
            state.turn(split, perform);
            *(if perform { &mut performed } else { &mut undone }) += 1;
            if step % 75 == 74 {
                state.assert_encloses(&points);
            }
        }
        assert!(performed > 3 && undone > 3, "{}: {performed} {undone}", scene.name);
    }
}

/// A focus somewhere around a scene, and an error.
fn any_focus(scene: &Scene, rng: &mut Rng) -> (Focus, f32) {
    let size = scene.size();
    let here = scene.around(1.2, rng);
    let focus = match rng.below(6) {
        0 => Focus::Everywhere,
        1 => Focus::Box { a: here, b: scene.around(1.2, rng) },
        2 => Focus::Segment {
            a: here,
            b: scene.around(1.5, rng),
            radius: size * rng.range(0.0, 0.1),
        },
        3 => Focus::Eye {
            position: here,
            axis: rng.direction(),
            cosine: rng.range(-1.0, 1.0),
            error_per_distance: rng.range(0.0, 0.1),
        },
        _ => Focus::Ball { centre: here, radius: size * rng.range(0.0, 0.3) },
    };
    let error = match rng.below(4) {
        0 => 0.0,
        _ => size * 0.5f32.powf(rng.range(4.0, 16.0)),
    };
    (focus, error)
}

/// Whatever an update says holds: its changes are legal, one after the other; its faces are those
/// of the splits; what is needed and not there is told.
fn assert_update<const SPLITS: usize>(
    (name, hull): (&str, &Hull<'_>),
    state: &mut Replayed<'_>,
    refined: &RefinedHull<'_, SPLITS>,
    (focus, error): &(Focus, f32),
    update: &Refinement,
    changes: &[SplitChange],
) {
    let say = || format!("{name}: {focus:?} {error}: {update:?}");
    assert_eq!(update.dropped, 0, "{}", say());
    assert_eq!(update.stored as u32, update.performed + update.undone, "{}", say());
    for change in &changes[..update.stored] {
        let perform = change.is_performed();
        let legal = if perform {
            state.may_perform(change.split())
        } else {
            state.may_undo(change.split())
        };
        assert!(legal, "{change:?} {}", say());
        state.turn(change.split(), perform);
    }
    let mut faces: Vec<_> =
        refined.faces(hull).map(|face| canonical(face.corners.map(|v| v.0))).collect();
    assert_eq!(faces.len(), update.faces as usize, "{}", say());
    faces.sort_unstable();
    assert_eq!(faces, state.triangles(), "{}", say());
    assert_eq!(refined.splits(), state.performed().len(), "{}", say());
    for (vertex, split) in state.existing() {
        let split = hull.split(split).expect("in range");
        let [reach, stored] = [split.star_radius, split.error];
        if is_needed(hull, focus, *error, vertex, [reach, stored]) {
            let left = f64::from(update.error_left) / hull.scale();
            assert!(left >= f64::from(stored), "{vertex:?} is needed: {}", say());
        }
    }
}

fn follow<const SPLITS: usize>(seed: u64, updates: usize) -> u32 {
    let mut was_short = 0;
    for scene in all() {
        let points = Inside::new(scene.model());
        let hull = scene.model();
        let mut state = Replayed::new(hull);
        let mut refined = Box::new(RefinedHull::<SPLITS>::new());
        let mut changes = vec![SplitChange::EMPTY; 1 << 16];
        let mut rng = Rng::new(seed);
        for i in 0..updates {
            let asked = any_focus(scene, &mut rng);
            let update = refined.update(&hull, &asked.0, asked.1, &mut changes).expect("in domain");
            assert_update((&scene.name, &hull), &mut state, &refined, &asked, &update, &changes);
            was_short += u32::from(update.error_left > 0.0);
            if i % 8 == 7 {
                state.assert_encloses(&points);
            }
        }
    }
    was_short
}

#[test]
fn an_update_gives_what_any_focus_needs_by_legal_changes() {
    assert_eq!(follow::<ALL>(93, 24), 0);
}

#[test]
fn short_memory_encloses_and_says_what_is_left() {
    assert!(follow::<0>(94, 8) > 0);
    assert!(follow::<1>(95, 8) > 0);
    assert!(follow::<2>(96, 8) > 0);
    assert!(follow::<7>(97, 16) > 0);
    assert!(follow::<40>(98, 16) > 0);
}

#[test]
fn a_kept_hull_holds_all_that_a_fresh_one_does_and_comes_back_to_it() {
    for scene in all() {
        let hull = scene.model();
        let splits_of = |refined: &RefinedHull<'_, ALL>| -> BTreeSet<[u32; 3]> {
            refined.faces(&hull).map(|face| canonical(face.corners.map(|v| v.0))).collect()
        };
        let mut rng = Rng::new(99);
        let mut kept = Box::new(RefinedHull::<ALL>::new());
        let mut state = Replayed::new(hull);
        let mut changes = vec![SplitChange::EMPTY; 1 << 16];
        let (size, mut here) = (scene.size(), scene.on_surface(&mut rng));
        for _ in 0..40 {
            let way = rng.direction();
            here = std::array::from_fn(|k| here[k] + way[k] * size * 0.02);
            let asked = (Focus::Ball { centre: here, radius: size * 0.1 }, size / 512.0);
            let update = kept.update(&hull, &asked.0, asked.1, &mut changes).expect("in domain");
            assert_update((&scene.name, &hull), &mut state, &kept, &asked, &update, &changes);
            let mut fresh = Box::new(RefinedHull::<ALL>::new());
            let mut fresh_state = Replayed::new(hull);
            let update = fresh.update(&hull, &asked.0, asked.1, &mut changes).expect("in domain");
            assert_update(
                (&scene.name, &hull),
                &mut fresh_state,
                &fresh,
                &asked,
                &update,
                &changes,
            );
            assert!(fresh_state.performed().is_subset(state.performed()), "{}", scene.name);
            // Away, where nothing is needed, and back.
            let first = splits_of(&fresh);
            let far = here.map(|x| x + size * 1e3);
            let away = Focus::Ball { centre: far, radius: 0.0 };
            fresh.update(&hull, &away, asked.1, &mut changes).expect("in domain");
            assert_eq!(fresh.splits(), 0, "{}", scene.name);
            fresh.update(&hull, &asked.0, asked.1, &mut changes).expect("in domain");
            assert_eq!(splits_of(&fresh), first, "{}", scene.name);
        }
    }
}

#[test]
fn a_face_that_meets_the_focus_is_as_near_to_its_surface_as_was_asked() {
    for scene in all().iter().filter(|scene| !scene.name.contains("1e")) {
        let hull = scene.model();
        let mut refined = Box::new(RefinedHull::<ALL>::new());
        let mut rng = Rng::new(100);
        let mut met = 0;
        for _ in 0..40 {
            let (centre, size) = (scene.on_surface(&mut rng), scene.size());
            let (radius, error) = (size * rng.range(0.0, 0.2), size / 300.0);
            let focus = Focus::Ball { centre, radius };
            refined.update(&hull, &focus, error, &mut []).expect("in domain");
            for face in refined.faces(&hull).filter(|face| face.radius.is_finite()) {
                let corners = face.corners.map(|v| hull.vertex(v).expect("in range"));
                let far = f64::from(radius) * (1.0 - 1e-4);
                if distance_to_triangle(centre, corners).upper < far {
                    met += 1;
                    let stands_off = f64::from(face.radius) * hull.scale();
                    assert!(stands_off <= f64::from(error), "{}: {focus:?} {face:?}", scene.name);
                }
            }
        }
        assert!(met > 100, "{}: {met}", scene.name);
    }
}

#[test]
fn memory_for_another_hull_starts_from_its_base() {
    let (first, second) = (&all()[0], &all()[2]);
    let (a, b) = (first.model(), second.model());
    let mut refined = Box::new(RefinedHull::<ALL>::new());
    refined.update(&a, &Focus::Everywhere, 0.0, &mut []).expect("in domain");
    assert_eq!(refined.faces(&a).count(), first.triangles.len());
    assert_eq!(refined.faces(&b).count(), b.header().base_triangles as usize);
    let far = Focus::Ball { centre: [1e6; 3], radius: 0.0 };
    let update = refined.update(&b, &far, 0.0, &mut []).expect("in domain");
    assert_eq!((update.faces, update.undone), (b.header().base_triangles, 0));
}

#[test]
fn faces_that_do_not_fit_are_counted() {
    let hull = all()[0].model();
    let mut refined = Box::new(RefinedHull::<ALL>::new());
    refined.update(&hull, &Focus::Everywhere, 0.0, &mut []).expect("in domain");
    let mut faces = [meshsweep_core::HullFace::EMPTY; 30];
    let (stored, dropped) = refined.faces_into(&hull, &mut faces);
    assert_eq!((stored, dropped as usize), (30, refined.faces(&hull).count() - 30));
    assert!(refined.faces(&hull).zip(faces).all(|(face, copy)| face == copy));
}

#[test]
fn changes_that_do_not_fit_are_counted() {
    let hull = all()[0].model();
    let mut refined = Box::new(RefinedHull::<ALL>::new());
    let mut changes = [SplitChange::EMPTY; 5];
    let update = refined.update(&hull, &Focus::Everywhere, 0.0, &mut changes).expect("in domain");
    assert_eq!((update.stored, update.stored as u32 + update.dropped), (5, update.performed));
}

#[test]
fn a_focus_that_is_no_place_is_a_typed_error_and_changes_nothing() {
    let hull = all()[0].model();
    let mut refined = Box::new(RefinedHull::<ALL>::new());
    refined.update(&hull, &Focus::Everywhere, 0.01, &mut []).expect("in domain");
    let splits = refined.splits();
    let (zero, nan) = ([0.0; 3], [0.0, f32::NAN, 0.0]);
    let eye = |position, axis, cosine, error_per_distance| Focus::Eye {
        position,
        axis,
        cosine,
        error_per_distance,
    };
    for (focus, error, refusal) in [
        (Focus::Ball { centre: nan, radius: 1.0 }, 0.1, QueryError::NotFinite),
        (Focus::Ball { centre: zero, radius: -1.0 }, 0.1, QueryError::Tolerance),
        (Focus::Ball { centre: [1e30; 3], radius: 1.0 }, 0.1, QueryError::OutOfDomain),
        (Focus::Box { a: zero, b: nan }, 0.1, QueryError::NotFinite),
        (Focus::Segment { a: zero, b: zero, radius: f32::NAN }, 0.1, QueryError::Tolerance),
        (eye(zero, nan, 0.5, 0.1), 0.1, QueryError::NotFinite),
        (eye(zero, zero, f32::NAN, 0.1), 0.1, QueryError::NotFinite),
        (eye(zero, zero, 0.5, f32::INFINITY), 0.1, QueryError::Tolerance),
        (Focus::Everywhere, -0.1, QueryError::Tolerance),
    ] {
        assert_eq!(refined.update(&hull, &focus, error, &mut []), Err(refusal), "{focus:?}");
        assert_eq!(refined.splits(), splits);
    }
}

/// The bracket's hierarchy with another star radius in every split.
fn with_star_radius(code: u8) -> Vec<u8> {
    let mut blob = include_bytes!("../../../fixtures/bracket.msw").to_vec();
    let (bytes, at) = {
        let hull = Hull::open(&blob).expect("opens");
        let header = hull.header();
        let bytes = header.vertex_index_bytes() + header.ring_index_bytes() + 3;
        let splits = header.splits as usize;
        let at = entries(&blob).into_iter().find(|e| e.kind == SectionKind::Splits as u32);
        let at = at.expect("has splits").offset as usize;
        (bytes, at..at + splits * bytes)
    };
    for record in blob[at].chunks_exact_mut(bytes) {
        record[bytes - 2] = code;
    }
    seal(&mut blob);
    blob
}

#[test]
fn an_update_ends_where_an_eye_stands_in_a_star_of_no_extent() {
    let blob = with_star_radius(0);
    let hull = Hull::open(&blob).expect("opens");
    let position = hull.vertex(hull.split(SplitIdx(0)).expect("a split").vertex).expect("a vertex");
    let eye = Focus::Eye { position, axis: [0.0; 3], cosine: -1.0, error_per_distance: 1e9 };
    fn update<const SPLITS: usize>(hull: &Hull<'_>, focuses: [&Focus; 2]) {
        let mut refined = RefinedHull::<SPLITS>::new();
        for focus in focuses.into_iter().cycle().take(6) {
            let found = refined.update(hull, focus, 0.0, &mut []).expect("a place");
            assert!(SPLITS > 0 || found.error_left > 0.0);
        }
    }
    for focuses in [[&eye, &eye], [&eye, &Focus::Everywhere]] {
        update::<0>(&hull, focuses);
        update::<1>(&hull, focuses);
        update::<5>(&hull, focuses);
        update::<64>(&hull, focuses);
    }
}

#[test]
fn a_split_of_unknown_star_radius_is_needed_by_every_focus() {
    let blob = with_star_radius(u8::MAX);
    let hull = Hull::open(&blob).expect("opens");
    let focuses = [
        Focus::Ball { centre: [1e6; 3], radius: 0.0 },
        Focus::Eye { position: [1e6; 3], axis: [1.0; 3], cosine: 0.9, error_per_distance: 1.0 },
    ];
    for focus in focuses {
        let mut refined = RefinedHull::<ALL>::new();
        let found = refined.update(&hull, &focus, 0.0, &mut []).expect("a place");
        assert!(found.performed > 800 && found.error_left == 0.0, "{found:?}");
    }
}

#[test]
fn hits_from_outside_refuse_a_budget_that_is_none() {
    let scene = &all()[0];
    let hull = scene.model();
    let mut refined = RefinedHull::<4>::new();
    for budget in [Budget::EXACT.with_relative(f32::NAN), Budget::EXACT.with_absolute(-1.0)] {
        let (a, b) = ([9.0; 3], [8.0; 3]);
        let asked =
            hull.outer_hits(a, b, OuterSearch::First, &mut refined, &mut [], budget, &mut []);
        assert_eq!(asked.err(), Some(QueryError::Tolerance));
    }
}
