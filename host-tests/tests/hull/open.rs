//! Hierarchies for sweeps of meshes that no hull encloses: open, crossing themselves, inside out,
//! with edges of many triangles. Their answers are those of the mesh, their levels are no hulls.

use super::scenes::options;
use meshsweep::BuildError;
use meshsweep::check::check_blob;
use meshsweep::cut::cut;
use meshsweep::hull::{Kind, Levels, build};
use meshsweep::mesh::{Mesh, read_bytes, repair};
use meshsweep::progress::Watch;
use meshsweep_core::{
    Budget, ClosestPoint, Contradiction, Ended, Focus, Hull, Interval, OpenError, OuterSearch,
    QueryError, RefinedHull, ScratchEntry, SplitChange, TriangleHit, VertIdx,
};
use meshsweep_host_tests::corrupt::{entry, every_face_has_corners, put_u32, seal, word};
use meshsweep_host_tests::generate::corpus::soups;
use meshsweep_host_tests::generate::evil::{Outcome, evil};
use meshsweep_host_tests::generate::{
    Rng, Triangles, cube, icosphere, inverted, rough_sphere, scaled, torus,
};
use meshsweep_host_tests::oracle::{contacts, gap_to_triangle};
use meshsweep_host_tests::scene::Scene;
use std::collections::HashSet;
use std::path::Path;
use std::sync::LazyLock;

/// Offset of the header's flags, and the flag of a hierarchy for sweeps.
const FLAGS: (usize, u32) = (24, 2);

/// The triangles whose middle passes a test.
pub fn kept((positions, triangles): &Triangles, keep: impl Fn([f32; 3]) -> bool) -> Triangles {
    let middle = |t: &[u32; 3]| -> [f32; 3] {
        std::array::from_fn(|k| t.iter().map(|&v| positions[v as usize][k]).sum::<f32>() / 3.0)
    };
    let mut triangles = triangles.clone();
    triangles.retain(|t| keep(middle(t)));
    (positions.clone(), triangles)
}

/// A square of n × n squares, without those that a test leaves out.
pub fn plate(n: u32, is_hole: impl Fn(u32, u32) -> bool) -> Triangles {
    let at = |i: u32, j: u32| i * (n + 1) + j;
    let positions = (0..=n).flat_map(|i| (0..=n).map(move |j| [i as f32, j as f32, 0.0])).collect();
    let squares = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    let squares = squares.filter(|&(i, j)| !is_hole(i, j));
    let triangles = squares.flat_map(|(i, j)| {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[a, b, c], [a, c, d]]
    });
    (positions, triangles.collect())
}

/// A strip of triangles with a twist: one-sided with an odd number.
pub fn strip(count: u32) -> Triangles {
    let place = |i: u32| {
        let angle = i as f32 / count as f32 * std::f32::consts::TAU;
        let (r, z) = if i.is_multiple_of(2) { (2.0, -0.3) } else { (2.3, 0.3) };
        [r * angle.cos(), r * angle.sin(), z]
    };
    let next = |i: u32| i % count;
    let triangle = |i: u32| {
        let [a, b, c] = [i, next(i + 1), next(i + 2)];
        if i.is_multiple_of(2) { [a, b, c] } else { [b, a, c] }
    };
    ((0..count).map(place).collect(), (0..count).map(triangle).collect())
}

/// Two holes that touch at a vertex, and a wall on an edge that has two triangles already.
pub fn touching_holes_and_a_wall() -> Triangles {
    let (mut positions, mut triangles) = plate(6, |i, j| i == j && (2..4).contains(&i));
    positions.extend([[5.0, 1.0, 2.0], [5.0, 2.0, 2.0]]);
    let [low, high, a, b] = [36, 37, 49, 50];
    triangles.extend([[low, high, a], [high, b, a]]);
    (positions, triangles)
}

fn scenes() -> &'static [Scene] {
    static SCENES: LazyLock<Vec<Scene>> = LazyLock::new(|| {
        let ball = rough_sphere(3, 0.2, 7);
        let bowl = kept(&ball, |p| p[2] < 0.3);
        let sieve = kept(&torus(2.0, 0.75, 24, 12), |p| (p[0] * 7.0).sin() < 0.8);
        let meshes = vec![
            ("triangle", (vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.5]], vec![[0, 1, 2]])),
            ("strip", plate(1, |_, _| false)),
            ("one-sided strip", strip(31)),
            ("ring", strip(30)),
            ("disc with holes", plate(12, |i, j| i % 4 == 2 && j % 3 == 1)),
            ("open box", kept(&cube(4), |p| p[2] < 0.99)),
            ("tube", kept(&cube(4), |p| p[2].abs() < 0.99)),
            ("touching holes and a wall", touching_holes_and_a_wall()),
            ("bowl", bowl.clone()),
            ("bowl × 1e-30", scaled(&bowl, 1e-30)),
            ("bowl × 1e30", scaled(&bowl, 1e30)),
            ("sieve", sieve),
            ("inside out", inverted(&icosphere(2))),
            ("closed", ball),
        ];
        let soups = soups().into_iter().filter(|(_, (positions, triangles))| {
            triangles.iter().any(|t| has_area(t.map(|v| positions[v as usize])))
        });
        let all = meshes.into_iter().chain(soups);
        all.map(|(name, mesh)| Scene::sweep(name, mesh, &options(24))).collect()
    });
    &SCENES
}

fn has_area([a, b, c]: [[f32; 3]; 3]) -> bool {
    let along = |from: [f32; 3], to: [f32; 3], k: usize| f64::from(to[k]) - f64::from(from[k]);
    (0..3).any(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        along(a, b, i) * along(a, c, j) != along(a, b, j) * along(a, c, i)
    })
}

fn closest(model: &Hull<'_>, p: [f32; 3], budget: Budget, entries: usize) -> ClosestPoint {
    model.closest_point(p, budget, &mut vec![ScratchEntry::EMPTY; entries]).expect("finite")
}

fn is_exact(model: &Hull<'_>) -> bool {
    model.header().surface_error == 0.0
}

#[test]
fn the_checker_proves_every_radius_of_every_level() {
    for scene in scenes() {
        let model = scene.model();
        assert!(!model.encloses(), "{}", scene.name);
        let mut cuts = vec![scene.bytes.clone()];
        cuts.extend((0..model.header().levels).map(|l| cut(&model, l).expect("there").to_bytes()));
        for bytes in &cuts {
            check_blob(bytes).unwrap_or_else(|e| panic!("{}: {e}", scene.name));
        }
        assert_ne!(is_exact(&model), scene.has_wires, "{}", scene.name);
        let finest = model.levels().last().expect("a level");
        assert_eq!(finest.faces, model.header().surface_triangles);
        assert_eq!(model.faces(&finest).count(), finest.faces as usize);
    }
}

#[test]
fn closest_points_are_those_of_the_mesh() {
    for scene in scenes() {
        let model = scene.model();
        let capacity = model.scratch_entries();
        for p in scene.points(120, &mut Rng::new(41)) {
            let truth = scene.truth(p);
            let exact = closest(&model, p, Budget::EXACT, capacity);
            assert_eq!(exact.ended, Ended::Exact);
            let triangle = exact.triangle.expect("a whole blob");
            if is_exact(&model) {
                let named = scene.truth_of(p, triangle);
                let slack = 1e-13 * (scene.reach() + named.upper);
                assert!(named.lower <= truth.upper + slack, "{p:?}: {exact:?} {truth:?}");
            }
            for (budget, entries) in [
                (Budget::EXACT, 4096),
                (Budget::EXACT, 1),
                (Budget::EXACT.with_steps(0), 8),
                (Budget::EXACT.with_steps(7), 64),
                (Budget::EXACT.with_relative(0.1), capacity),
            ] {
                let answer = closest(&model, p, budget, entries);
                for Interval { lower, upper } in [exact.distance, answer.distance] {
                    let holds = f64::from(lower) <= truth.upper && truth.lower <= f64::from(upper);
                    assert!(holds, "{p:?}: {answer:?} does not contain {truth:?}");
                }
                if entries == 4096 {
                    assert_eq!((answer.triangle, answer.point), (exact.triangle, exact.point));
                }
            }
        }
    }
}

#[test]
fn kept_sweeps_and_cuts_contain_the_distance() {
    for scene in scenes() {
        let model = scene.model();
        let rng = &mut Rng::new(42);
        let mut scratch = vec![ScratchEntry::EMPTY; 2048];
        let mut sweep = model.sweep([0.0; 3], &mut scratch).expect("finite");
        let coarse = cut(&model, 0).expect("a level").to_bytes();
        let coarse = Hull::open(&coarse).expect("opens");
        for p in scene.points(60, rng) {
            sweep.move_to(p).expect("finite");
            let near = sweep.closest_point(Budget::EXACT).expect("finite");
            let cut = closest(&coarse, p, Budget::EXACT, coarse.scratch_entries());
            let truth = scene.truth(p);
            for Interval { lower, upper } in [near.distance, cut.distance] {
                let holds = f64::from(lower) <= truth.upper && truth.lower <= f64::from(upper);
                assert!(holds, "{p:?}: {near:?} {cut:?} {truth:?}");
            }
        }
        // Every triangle once, by rising distance.
        let mut all = model.sweep(scene.around(1.0, rng), &mut scratch).expect("finite");
        let (mut count, mut before) = (0, 0.0);
        while let Some(next) = all.next_triangle(Budget::EXACT).expect("finite") {
            assert!(next.triangle.is_some() && next.distance.lower >= before, "{next:?}");
            (count, before) = (count + 1, next.distance.lower);
        }
        assert_eq!(count, model.header().surface_triangles, "{}", scene.name);
    }
}

#[test]
fn segments_hit_the_surface_and_are_clear_through_holes() {
    let mut counts = [0; 2];
    for scene in scenes().iter().filter(|scene| !scene.has_wires) {
        let model = scene.model();
        let (rng, mut hits) = (&mut Rng::new(43), vec![TriangleHit::EMPTY; 512]);
        let mut queue = vec![ScratchEntry::EMPTY; model.scratch_entries()];
        for i in 0..120 {
            let (a, b) = match i % 4 {
                0 => (scene.around(2.0, rng), scene.on_surface(rng)),
                1 => (scene.around(2.0, rng), scene.vertex(rng)),
                2 => (scene.vertex(rng), scene.vertex(rng)),
                _ => (scene.around(2.0, rng), scene.around(2.0, rng)),
            };
            let truth = contacts(a, b, &scene.positions, &scene.triangles);
            let first = model.first_hit(a, b, Budget::EXACT, &mut queue).expect("in the domain");
            let least = truth.iter().map(|c| c.t_upper).fold(f64::INFINITY, f64::min);
            assert!(f64::from(first.t.lower) <= least, "{}: {first:?} {truth:?}", scene.name);
            counts[usize::from(first.is_clear())] += 1;
            let found = model.all_hits(a, b, &mut hits, Budget::EXACT, &mut queue);
            let found = found.expect("in the domain");
            // Touches are not proved.
            let is_whole = matches!(found.ended, Ended::Exact | Ended::Resolution);
            assert!(is_whole && found.dropped == 0, "{}: {found:?}", scene.name);
            let named =
                hits[..found.stored].iter().map(|listed| listed.hit.triangle.expect("whole"));
            let named: Vec<u32> = named.collect();
            // Of triangles on the same corners the first one stays.
            let sorted = |t: u32| {
                let mut corners = scene.corners(t).map(|p| p.map(f32::to_bits));
                corners.sort_unstable();
                corners
            };
            let is_named = |t| named.iter().any(|&n| n == t || sorted(n) == sorted(t));
            let missed = truth.iter().find(|c| !is_named(c.triangle));
            assert_eq!(missed, None, "{}: {a:?} {b:?}", scene.name);
            let lengths = a.iter().chain(&b).fold(scene.reach(), |m, x| m.max(f64::from(x.abs())));
            for triangle in named {
                let gap = gap_to_triangle(a, b, scene.corners(triangle));
                // A needle's plane loses its aspect ratio in accuracy.
                assert!(gap <= 1e-6 * lengths, "{}: {gap:e} from {triangle}", scene.name);
            }
        }
    }
    assert!(counts.iter().all(|&count| count > 300), "{counts:?}");
    let plate = Scene::sweep("plate", plate(12, |i, j| i % 4 == 2 && j % 3 == 1), &options(24));
    let model = plate.model();
    let mut queue = vec![ScratchEntry::EMPTY; model.scratch_entries()];
    for (x, is_clear) in [(2.5, true), (6.25, true), (1.5, false), (0.0, false), (-0.1, true)] {
        let (a, b) = ([x, 1.4, 3.0], [x, 1.4, -3.0]);
        let hit = model.first_hit(a, b, Budget::EXACT, &mut queue).expect("in the domain");
        assert_eq!(hit.is_clear(), is_clear, "{x}: {hit:?}");
    }
}

#[test]
fn questions_that_need_hulls_are_refused_and_refined_meshes_keep_their_holes() {
    let scene = Scene::sweep("bowl", kept(&rough_sphere(3, 0.2, 7), |p| p[2] < 0.3), &options(24));
    let model = scene.model();
    let mut refined = RefinedHull::<2048>::new();
    let (a, b) = ([9.0, 0.0, 0.0], [-9.0, 0.0, 0.0]);
    let first = OuterSearch::First;
    let refused = model.outer_hits(a, b, first, &mut refined, &mut [], Budget::EXACT, &mut []);
    assert_eq!(refused, Err(QueryError::NotEnclosing));
    for error in [1.0, 0.1, 0.01, 0.0] {
        let update = refined.update(&model, &Focus::Everywhere, error, &mut []).expect("sound");
        let faces: Vec<_> = refined.faces(&model).collect();
        assert_eq!(faces.len(), update.faces as usize);
        assert!(faces.iter().all(|face| face.radius.is_finite()));
    }
    assert_eq!(refined.faces(&model).count(), scene.triangles.len());
}

#[test]
fn any_mesh_with_an_area_builds_and_the_report_counts_its_holes() {
    let mesh = |(positions, triangles): Triangles| Mesh::new(positions, triangles);
    let sweep = |faces| options(faces).with_levels(Levels::Sweep);
    let built = |mesh: &Mesh| build(mesh.as_input(), &sweep(24), Watch::NONE);
    let kind = |shape| built(&mesh(shape)).expect("builds").1.kind;
    let tube = kept(&cube(4), |p| p[2].abs() < 0.99);
    assert_eq!(kind(tube), Kind::SweepOnly { holes: 2, copies: 0 });
    assert_eq!(kind(icosphere(1)), Kind::SweepOnly { holes: 0, copies: 0 });
    let bow_tie = (plate(2, |_, _| false).0, vec![[4, 0, 1], [4, 8, 7]]);
    assert_eq!(kind(bow_tie), Kind::SweepOnly { holes: 2, copies: 1 });
    let empty = Mesh::default();
    assert_eq!(built(&empty).map(|_| ()), Err(BuildError::Empty));
    let beyond = Mesh::new(vec![[0.0; 3]; 3], vec![[0, 1, 3]]);
    let wanted = BuildError::NoSuchVertex { triangle: 0, vertex: 3, vertices: 3 };
    assert_eq!(built(&beyond).map(|_| ()), Err(wanted));
}

#[test]
fn every_evil_file_that_can_be_read_builds_or_has_no_area() {
    let mut built = 0;
    for file in evil() {
        let name = file.name;
        if matches!(file.outcome, Outcome::Unreadable(_)) {
            continue;
        }
        let raw = read_bytes(Path::new(name), file.bytes).expect("readable");
        let (mesh, _) = repair(raw).expect("mended");
        match build(mesh.as_input(), &options(8).with_levels(Levels::Sweep), Watch::NONE) {
            Ok((sections, _)) => {
                check_blob(&sections.to_bytes()).unwrap_or_else(|e| panic!("{name}: {e}"));
                built += 1;
            }
            Err(error) => assert_eq!((error, mesh.triangles.len()), (BuildError::Empty, 0)),
        }
    }
    assert!(built > 10, "{built} built");
}

#[test]
fn damaged_bytes_are_refused_or_safe_to_ask_with_the_flag_and_without() {
    let open = Scene::sweep("strip", plate(3, |i, j| (i, j) == (1, 1)), &options(8)).bytes;
    let closed = Scene::hull("sphere", icosphere(1), &options(8)).bytes;
    let mut queue = [ScratchEntry::EMPTY; 24];
    let mut ask = |bytes: &[u8]| -> Result<(), OpenError> {
        let model = Hull::open(bytes)?;
        for p in [[0.1, 0.2, 0.3], [5.0, -3.0, 1.0], [1e14, 0.0, 0.0]] {
            let answer = model.closest_point(p, Budget::EXACT, &mut queue).expect("answers");
            assert!(answer.distance.lower <= answer.distance.upper, "{answer:?}");
        }
        let (a, b) = ([-3.0, 0.1, 0.2], [3.0, 0.15, 0.1]);
        let first = model.first_hit(a, b, Budget::EXACT, &mut queue).expect("in the domain");
        assert!(first.t.lower <= first.t.upper, "{first:?}");
        every_face_has_corners(&model);
        Ok(())
    };
    for bytes in [open, closed] {
        let mut flagged = bytes.clone();
        put_u32(&mut flagged, FLAGS.0, word(&bytes, FLAGS.0).expect("a header") ^ FLAGS.1);
        let mut refused = 0;
        for bytes in [bytes, flagged] {
            for bit in 0..8 * bytes.len() {
                let mut flipped = bytes.clone();
                flipped[bit / 8] ^= 1 << (bit % 8);
                seal(&mut flipped);
                refused += u32::from(ask(&flipped).is_err());
            }
        }
        assert!(refused > 100, "{refused} refused");
    }
}

#[test]
fn a_hierarchy_none_of_whose_triangles_stands_for_anything_is_refused() {
    let mut bytes = Scene::sweep("triangle", plate(1, |_, _| false), &options(8)).bytes;
    let radii = entry(&bytes, 5);
    let (from, count) = (radii.offset as usize, radii.bytes as usize);
    bytes[from..from + count].fill(255);
    seal(&mut bytes);
    let what = Contradiction::UncoveredSurface;
    assert_eq!(Hull::open(&bytes).err(), Some(OpenError::Counts { what }));
}

#[test]
fn changes_carried_out_one_after_the_other_give_the_faces() {
    let rotated = |mut corners: [VertIdx; 3]| {
        let least = (0..3).min_by_key(|&k| corners[k]).expect("three");
        corners.rotate_left(least);
        corners
    };
    let mut changed = 0;
    for scene in scenes() {
        let model = scene.model();
        let mut refined = RefinedHull::<4096>::new();
        let now = |refined: &RefinedHull<'_, 4096>| {
            refined.faces(&model).map(|face| rotated(face.corners)).collect::<HashSet<_>>()
        };
        let mut drawn = now(&refined);
        let mut changes = vec![SplitChange::EMPTY; 8192];
        for part in [0.25, 0.02, 0.0, 0.1] {
            let error = part * scene.size();
            let update =
                refined.update(&model, &Focus::Everywhere, error, &mut changes).expect("finite");
            assert_eq!(update.dropped, 0);
            for change in &changes[..update.stored] {
                for face in change.removed(&model) {
                    assert!(drawn.remove(&rotated(face)), "{}: {face:?} is not there", scene.name);
                }
                drawn.extend(change.added(&model).map(rotated));
                changed += 1;
            }
            assert_eq!(drawn, now(&refined), "{} at {error}", scene.name);
            assert_eq!(drawn.len(), update.faces as usize);
        }
    }
    assert!(changed > 1000, "{changed} changes");
}
