//! What is said to be apart is: by exact polytopes, by exact surfaces, at any scale.

use super::{blob, mesh, of};
use meshsweep_core::{Budget, Ended, NodePair, Pose, QueryError, ScratchEntry, Tribox, Triboxes};
use meshsweep_counted::triboxes::by_vertices;
use meshsweep_host_tests::generate::{
    Rng, Triangles, bracket, cube, groove_block, rough_sphere, scaled, torus,
};
use meshsweep_host_tests::oracle::distance_of_meshes;
use meshsweep_host_tests::oracle::polytope::{HalfSpace, Polytope};
use meshsweep_host_tests::workload::Subject;
use meshsweep_host_tests::workload::contact::Surface;
use meshsweep_host_tests::workload::pose::{Pose as Exact, poses, sphere};
use std::collections::HashSet;

const DIRECTIONS: [[i64; 3]; 9] = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
    [1, 1, 0],
    [1, -1, 0],
    [0, 1, 1],
    [0, 1, -1],
    [1, 0, 1],
    [-1, 0, 1],
];

/// Twice these are integers: of a rotation by a half each, one by 60° that is half as large again,
/// one that shears.
const MATRICES: [[[f32; 3]; 3]; 5] = [
    [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
    [[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]],
    [[1.0, -0.5, 1.0], [1.0, 1.0, -0.5], [-0.5, 1.0, 1.0]],
    [[-0.5, 1.0, 1.0], [-1.0, -1.0, 0.5], [1.0, -0.5, 1.0]],
    [[1.0, 0.5, 0.0], [0.0, 1.0, 0.5], [0.5, 0.0, 1.0]],
];

/// Half-spaces of a tribox in the frame of what is moved by `p ↦ M p + t`, all times 2; parameters
/// in `unit`s.
fn half_spaces(
    tribox: &Tribox,
    unit: f32,
    matrix: [[f32; 3]; 3],
    shift: [f32; 3],
) -> Vec<HalfSpace> {
    let integer = |x: f32| {
        assert_eq!(x.fract(), 0.0);
        x as i64
    };
    let mut all = Vec::new();
    for (k, d) in DIRECTIONS.iter().enumerate() {
        let back =
            [0, 1, 2].map(|j| (0..3).map(|i| d[i] * integer(2.0 * matrix[i][j])).sum::<i64>());
        let along: i64 = (0..3).map(|i| d[i] * integer(shift[i] / unit)).sum();
        let [low, high] = [tribox.low[k], tribox.high[k]].map(|x| integer(x / unit));
        all.push(HalfSpace::new(back, 2 * (high - along)));
        all.push(HalfSpace::new(back.map(|x| -x), 2 * (along - low)));
    }
    all
}

#[test]
fn leaves_that_are_left_out_have_no_common_point() {
    let mut rng = Rng::new(31);
    let (mut left_out, mut needless, mut met) = (0, 0, 0);
    for triangles in [torus(2.0, 0.75, 12, 8), groove_block(), rough_sphere(1, 0.4, 2)] {
        let bytes = of(&triangles, 6);
        let all = Triboxes::open(&bytes).expect("opens");
        let unit = 2f32.powi(all.scale_exponent() + all.header().grid_exponent);
        let root = all.node(0).expect("a root");
        let size = root.high[0] - root.low[0];
        for run in 0..30 {
            let matrix = MATRICES[run % 5];
            // A multiple of the unit, so that all is an integer.
            let far = if run % 3 == 0 { 0.7 } else { 1.5 };
            let shift = [(); 3].map(|()| (rng.range(-far, far) * size / unit).round() * unit);
            let pose = Pose::affine(matrix, shift);
            let (mut pairs, mut stack) = (
                vec![NodePair::EMPTY; 64],
                vec![ScratchEntry::EMPTY; all.separation_entries(&all)],
            );
            let answer = all
                .candidates(&all, pose, &mut pairs, Budget::EXACT, &mut stack)
                .expect("answered");
            assert_eq!((answer.dropped, answer.ended), (0, Ended::Exact));
            let found: HashSet<(u16, u16)> =
                pairs[..answer.stored].iter().map(|pair| (pair.a, pair.b)).collect();
            assert_eq!(found.len(), answer.stored, "no pair twice");
            for (i, first) in all.leaves() {
                for (j, second) in all.leaves() {
                    let mut planes = half_spaces(&first, unit, matrix, shift);
                    let own = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
                    planes.extend(half_spaces(&second, unit, own, [0.0; 3]));
                    let is_empty = Polytope::new(&planes).is_empty();
                    let is_found = found.contains(&(i as u16, j as u16));
                    assert!(is_found || is_empty, "{i} {j} {pose:?}");
                    left_out += usize::from(!is_found);
                    needless += usize::from(is_found && is_empty);
                    met += usize::from(!is_empty);
                }
            }
        }
    }
    assert!(left_out > 1500 && met > 200, "{left_out} {met}");
    // Eighteen directions, where edges would want more; and three of the matrices are no rotations.
    assert!(4 * needless < left_out, "{needless} of {left_out}");
}

fn subject(triangles: &Triangles) -> Subject {
    Subject::of("", mesh(triangles))
}

#[test]
fn surfaces_that_touch_are_never_apart() {
    for triangles in [torus(2.0, 0.75, 16, 8), bracket(), cube(2)] {
        let subject = subject(&triangles);
        let bytes = blob(&subject.mesh, 16);
        let all = Triboxes::open(&bytes).expect("opens");
        let surface = Surface::new(&subject);
        let mut stack = vec![ScratchEntry::EMPTY; all.separation_entries(&all)];
        let (mut proved, mut touching) = (0, 0);
        for (pose, core) in poses(&sphere(&subject), 60) {
            let meet = surface.meets_moved(&pose);
            let answer = all.separation(&all, core, Budget::EXACT, &mut stack).expect("answered");
            assert!(!(meet && answer.is_apart()), "{core:?}");
            proved += usize::from(answer.is_apart());
            if meet {
                continue;
            }
            // Towards the mesh, to where it just meets: the nearest pose to contact that f32 can
            // say.
            let centre = sphere(&subject).centre;
            let to = pose.apply(centre) - centre;
            let (mut clear, mut near) = (0.0, 1.0);
            let at = |t: f64| {
                let mut moved = core;
                (0..3).for_each(|k| {
                    moved.translation[k] = (f64::from(core.translation[k]) - t * to[k]) as f32
                });
                moved
            };
            if !surface.meets_moved(&Exact::exact(&at(1.0), &pose)) {
                continue;
            }
            for _ in 0..40 {
                let middle = 0.5 * (clear + near);
                if surface.meets_moved(&Exact::exact(&at(middle), &pose)) {
                    near = middle
                } else {
                    clear = middle
                }
            }
            let answer =
                all.separation(&all, at(near), Budget::EXACT, &mut stack).expect("answered");
            assert!(!answer.is_apart(), "{:?}", at(near));
            touching += 1;
        }
        assert!(proved > 10 && touching > 10, "{proved} {touching}");
    }
}

/// The largest distance that is proved, by halving, of at most `most`; `None` if they may meet.
fn proved(a: &Triboxes<'_>, b: &Triboxes<'_>, pose: Pose, most: f32) -> Option<f32> {
    let mut stack = vec![ScratchEntry::EMPTY; a.separation_entries(b)];
    let mut is_proved = |distance: f32| {
        let found = a.within_of(b, pose, distance, Budget::EXACT, &mut stack).expect("answered");
        found.is_apart()
    };
    if !is_proved(0.0) {
        return None;
    }
    let (mut low, mut high) = (0.0f32, most);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if is_proved(middle) { low = middle } else { high = middle }
    }
    Some(low)
}

#[test]
fn no_distance_is_proved_that_the_meshes_do_not_keep() {
    let mut rng = Rng::new(32);
    let (mut counted, mut shares) = (0, 0.0);
    for triangles in [torus(2.0, 0.75, 12, 8), groove_block(), rough_sphere(1, 0.4, 2), cube(1)] {
        let bytes = of(&triangles, 24);
        let all = Triboxes::open(&bytes).expect("opens");
        let root = all.node(0).expect("a root");
        let size = root.high[0] - root.low[0];
        let sphere = sphere(&subject(&triangles));
        let rigid = poses(&sphere, 20).map(|(_, core)| core);
        let affine = (0..20).map(|run| {
            let matrix = MATRICES[run % 5].map(|row| row.map(|x| x * [1.0, 1e-25][run / 5 % 2]));
            Pose::affine(matrix, [(); 3].map(|()| rng.range(-2.0, 2.0) * size))
        });
        for pose in rigid.collect::<Vec<_>>().into_iter().chain(affine) {
            let Some(distance) = proved(&all, &all, pose, 16.0 * size) else { continue };
            let mesh = (triangles.0.as_slice(), triangles.1.as_slice());
            let exact = distance_of_meshes(mesh, mesh, &pose.rotation, pose.translation);
            assert!(f64::from(distance) < exact.upper, "{distance} {exact:?} {pose:?}");
            (counted, shares) = (counted + 1, shares + f64::from(distance) / exact.upper);
        }
    }
    assert!(counted > 60 && shares > 0.75 * f64::from(counted), "{shares} of {counted}");
}

#[test]
fn a_gap_along_a_slab_is_proved_to_the_last_digits() {
    let bytes = of(&cube(1), 1);
    let all = Triboxes::open(&bytes).expect("opens");
    let root = all.node(0).expect("a root");
    let side = root.high[0] - root.low[0];
    for (axis, gap) in [(0, 1.5f32), (1, 100.0), (2, 0.125)] {
        let mut translation = [0.0; 3];
        translation[axis] = side + gap;
        let pose = Pose { translation, ..Pose::IDENTITY };
        let distance = proved(&all, &all, pose, 4.0 * gap).expect("apart");
        let lost = 1e-4 * (side + gap);
        assert!(distance < gap && distance > gap - lost, "{distance} of {gap}");
    }
}

#[test]
fn answers_do_not_depend_on_the_scale() {
    let triangles = torus(2.0, 0.75, 16, 8);
    let bytes = of(&triangles, 16);
    let plain = Triboxes::open(&bytes).expect("opens");
    let subject = subject(&triangles);
    for exponent in [-100, -60, 1, 90] {
        let factor = 2f32.powi(exponent);
        let other = of(&scaled(&triangles, factor), 16);
        let scaled = Triboxes::open(&other).expect("opens");
        let (mut pairs, mut stack) = ([NodePair::EMPTY; 256], [ScratchEntry::EMPTY; 64]);
        let (mut others, mut apart_count) = ([NodePair::EMPTY; 256], 0);
        for (_, pose) in poses(&sphere(&subject), 100) {
            let moved = Pose { translation: pose.translation.map(|x| x * factor), ..pose };
            let here = plain
                .candidates(&plain, pose, &mut pairs, Budget::EXACT, &mut stack)
                .expect("answered");
            let there = scaled
                .candidates(&scaled, moved, &mut others, Budget::EXACT, &mut stack)
                .expect("answered");
            assert_eq!((here, pairs), (there, others), "{exponent}");
            apart_count += usize::from(here.is_apart());
            let here = plain.within_of(&plain, pose, 0.75, Budget::EXACT, &mut stack);
            let there = scaled.within_of(&scaled, moved, 0.75 * factor, Budget::EXACT, &mut stack);
            assert_eq!(here, there, "{exponent}");
        }
        assert!((20..80).contains(&apart_count));
    }
}

#[test]
fn two_models_of_different_size_are_looked_at_where_they_are() {
    let (large, small) = (of(&torus(2.0, 0.75, 24, 12), 64), of(&scaled(&cube(1), 0.25), 4));
    let (large, small) =
        (Triboxes::open(&large).expect("opens"), Triboxes::open(&small).expect("opens"));
    let mut stack = vec![ScratchEntry::EMPTY; large.separation_entries(&small)];
    let hole = Pose { translation: [-0.125, -0.125, -0.125], ..Pose::IDENTITY };
    let answer = large.separation(&small, hole, Budget::EXACT, &mut stack).expect("answered");
    assert!(answer.is_apart(), "in the hole of the torus: {answer:?}");
    let answer =
        large.coarser(1).separation(&small, hole, Budget::EXACT, &mut stack).expect("answered");
    assert!(!answer.is_apart(), "one tribox has no hole");
    let inside = Pose { translation: [1.9, -0.125, -0.125], ..Pose::IDENTITY };
    let answer = large.separation(&small, inside, Budget::EXACT, &mut stack).expect("answered");
    assert!(!answer.is_apart(), "inside of the solid");
}

#[test]
fn more_is_told_apart_than_by_moved_vertices() {
    let subject = subject(&bracket());
    let bytes = blob(&subject.mesh, 32);
    let all = Triboxes::open(&bytes).expect("opens");
    let mut stack = vec![ScratchEntry::EMPTY; all.separation_entries(&all)];
    let (mut ours, mut theirs, mut less) = (0, 0, 0);
    for (_, pose) in poses(&sphere(&subject), 300) {
        let here =
            all.separation(&all, pose, Budget::EXACT, &mut stack).expect("answered").is_apart();
        let there = by_vertices(&all, &all, &pose).0;
        (ours, theirs) = (ours + usize::from(here), theirs + usize::from(there));
        less += usize::from(there && !here);
    }
    assert!(ours > theirs && less == 0, "{ours} {theirs} {less}");
}

#[test]
fn short_memory_is_said_and_proves_no_less() {
    let subject = subject(&torus(2.0, 0.75, 16, 8));
    let bytes = blob(&subject.mesh, 32);
    let all = Triboxes::open(&bytes).expect("opens");
    let mut stack = vec![ScratchEntry::EMPTY; all.separation_entries(&all)];
    let (mut short, mut full) = (0, 0);
    for (_, pose) in poses(&sphere(&subject), 60) {
        let whole = all
            .candidates(&all, pose, &mut [NodePair::EMPTY; 1024], Budget::EXACT, &mut stack)
            .expect("answered");
        assert_eq!((whole.ended, whole.dropped), (Ended::Exact, 0));
        let few = all
            .candidates(&all, pose, &mut [NodePair::EMPTY; 3], Budget::EXACT, &mut stack)
            .expect("answered");
        assert_eq!(few.stored + few.dropped as usize, whole.stored);
        assert_eq!(few.work, whole.work);
        for entries in 1..6 {
            let mut pairs = [NodePair::EMPTY; 1024];
            let answer = all
                .candidates(&all, pose, &mut pairs, Budget::EXACT, &mut stack[..entries])
                .expect("answered");
            assert!(whole.is_apart() || !answer.is_apart(), "less memory cannot prove more");
            let one =
                all.separation(&all, pose, Budget::EXACT, &mut stack[..entries]).expect("answered");
            assert_eq!(one.is_apart(), answer.is_apart());
            short += usize::from(answer.ended == Ended::Scratch);
            full += usize::from(answer.ended == Ended::Exact);
        }
    }
    assert!(short > 50 && full > 50, "{short} {full}");
}

#[test]
fn poses_that_are_none_are_refused() {
    let bytes = of(&cube(1), 4);
    let all = Triboxes::open(&bytes).expect("opens");
    let stack = &mut [ScratchEntry::EMPTY; 16];
    for (x, error) in [
        (f32::NAN, QueryError::NotFinite),
        (f32::NEG_INFINITY, QueryError::NotFinite),
        (2e36, QueryError::PoseOutOfDomain),
    ] {
        let shifted = Pose { translation: [x, 0.0, 0.0], ..Pose::IDENTITY };
        assert_eq!(all.separation(&all, shifted, Budget::EXACT, stack).unwrap_err(), error);
        let turned =
            Pose { rotation: [[1.0, 0.0, 0.0], [0.0, x, 0.0], [0.0; 3]], ..Pose::IDENTITY };
        assert_eq!(all.separation(&all, turned, Budget::EXACT, stack).unwrap_err(), error);
    }
    assert_eq!(
        all.separation(&all, Pose::IDENTITY, Budget::EXACT, &mut []).unwrap_err(),
        QueryError::NoScratch
    );
    let bad = Budget::EXACT.with_absolute(f32::NAN);
    assert_eq!(
        all.separation(&all, Pose::IDENTITY, bad, stack).unwrap_err(),
        QueryError::Tolerance
    );
    for distance in [-1.0, f32::NAN, f32::INFINITY] {
        let found = all.within_of(&all, Pose::IDENTITY, distance, Budget::EXACT, stack);
        assert_eq!(found.unwrap_err(), QueryError::Tolerance);
    }
    // As far as there are numbers, and of no volume at all.
    let far = Pose { translation: [1e36, -1e36, 1e36], ..Pose::IDENTITY };
    assert!(all.separation(&all, far, Budget::EXACT, stack).expect("answered").is_apart());
    let found = all.within_of(&all, far, f32::MAX, Budget::EXACT, stack).expect("answered");
    assert!(!found.is_apart());
    let flat = Pose::affine([[0.0; 3]; 3], [0.5; 3]);
    assert!(
        !all.separation(&all, flat, Budget::EXACT, stack).expect("answered").is_apart(),
        "a point inside of the cube"
    );
}
