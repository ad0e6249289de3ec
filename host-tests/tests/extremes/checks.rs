//! What must hold of a box tree's answers on any mesh, by the exact oracle.

use crate::scene::Scene;
use meshsweep::bvh::closest_points;
use meshsweep_core::{
    Budget, ClosestPoint, CoherentQuery, Ended, Facing, Interval, Neighbor, QueryError,
    TriangleHit, Verdict,
};
use meshsweep_host_tests::oracle::exact::{Corners, distance_compared, first_meeting};
use std::cmp::Ordering::{Greater, Less};

/// Whether the distance to some of the input lies in an interval, by exact comparisons.
pub fn holds(triangles: &[&Corners], p: [f32; 3], Interval { lower, upper }: Interval) -> bool {
    let p = p.map(f64::from);
    triangles.iter().any(|t| distance_compared(p, t, upper.into()) != Greater)
        && triangles.iter().all(|t| distance_compared(p, t, lower.into()) != Less)
}

/// Every interval of a closest point contains the distance. Returns those that do not.
pub fn wrong_intervals(scene: &Scene, points: &[[f32; 3]]) -> Vec<String> {
    let (tree, mut stack) = (scene.tree(), scene.stack());
    let mut wrong = Vec::new();
    for &p in points {
        let truth = scene.nearest(p);
        for budget in [Budget::EXACT, Budget::EXACT.with_relative(0.1), Budget::EXACT.with_steps(2)]
        {
            let answer = tree.closest_point(p, budget, &mut stack).expect("a point");
            if !holds(&truth, p, answer.distance) {
                wrong.push(format!("{}: {p:?} {budget:?}: {answer:?}", scene.name));
            }
            let precise = tree.closest_point_precise(p, budget, &mut stack).expect("a point");
            let (ours, theirs) = (precise.distance, answer.distance);
            let is_wider =
                budget == Budget::EXACT && (ours.lower < theirs.lower || ours.upper > theirs.upper);
            if !holds(&truth, p, ours) || is_wider {
                wrong.push(format!("{}: {p:?} {budget:?}, precise: {precise:?}", scene.name));
            }
        }
    }
    wrong
}

/// Every interval is as narrow as the stored mesh and rounding allow.
pub fn intervals_are_narrow(scene: &Scene, points: &[[f32; 3]]) {
    let (tree, mut stack) = (scene.tree(), scene.stack());
    let unit = 2f64.powi(tree.scale_exponent() + tree.header().grid_exponent);
    let error = f64::from(tree.header().surface_error) * 2f64.powi(tree.scale_exponent());
    let reach = f64::from(tree.header().star_radius) * unit;
    for &p in points {
        let answer = tree.closest_point(p, Budget::EXACT, &mut stack).expect("a point");
        let (lower, upper) = (f64::from(answer.distance.lower), f64::from(answer.distance.upper));
        if answer.distance.upper == f32::INFINITY {
            let is_beyond = |t: &&Corners| {
                distance_compared(p.map(f64::from), t, 0.999_99 * f64::from(f32::MAX)) != Less
            };
            assert!(scene.nearest(p).iter().all(is_beyond), "{}: {p:?} {answer:?}", scene.name);
            continue;
        }
        // No bound above 0 is less than the least normal number.
        let least = f64::from(f32::MIN_POSITIVE);
        let allowed = 2.0 * error + 1.5 * unit + 1e-5 * (upper + reach) + least;
        assert!(
            upper - lower <= allowed.max(1e-5 * scene.length()) && answer.ended == Ended::Exact,
            "{}: {p:?} {answer:?}, {allowed:e} allowed",
            scene.name
        );
    }
}

/// No verdict of being within a distance is wrong. Counts those that say yes, no, and neither.
pub fn verdicts_are_true(scene: &Scene, points: &[[f32; 3]], seen: &mut [usize; 3]) {
    let (tree, mut stack) = (scene.tree(), scene.stack());
    for &p in points {
        let truth = scene.nearest(p);
        let about =
            tree.closest_point(p, Budget::EXACT, &mut stack).expect("a point").distance.upper;
        let about = about.min(f32::MAX / 2.0);
        for distance in [0.0, 0.5 * about, 0.999_999 * about, about, 1.000_001 * about, 2.0 * about]
        {
            let is_near = truth
                .iter()
                .any(|t| distance_compared(p.map(f64::from), t, distance.into()) != Greater);
            let within = tree.within(p, distance, Budget::EXACT, &mut stack);
            let verdict = within.expect("a distance").verdict;
            let (wrong, kind) = match verdict {
                Verdict::Yes => (!is_near, 0),
                Verdict::No => (is_near, 1),
                _ => (false, 2),
            };
            assert!(!wrong, "{}: {p:?} within {distance:e}: {verdict:?}", scene.name);
            seen[kind] += 1;
        }
    }
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

/// No triangle is missed among the nearest, and among those within a distance.
pub fn neighbors_are_complete(scene: &Scene, points: &[[f32; 3]]) {
    let (tree, mut stack) = (scene.tree(), scene.stack());
    let mut slots = vec![Neighbor::EMPTY; scene.corners.len() + 64];
    for &p in points {
        let answer = tree.nearest(p, &mut slots[..3], Budget::EXACT, &mut stack).expect("a point");
        check_neighbors(scene, p, &slots[..answer.stored], answer.rest_lower);
        let radius = (0.3 * scene.length()) as f32;
        let answer =
            tree.all_within(p, radius, &mut slots, Budget::EXACT, &mut stack).expect("a distance");
        assert_eq!(answer.dropped, 0);
        check_neighbors(scene, p, &slots[..answer.stored], radius);
    }
}

fn bits(answer: &ClosestPoint) -> [u32; 6] {
    let Interval { lower, upper } = answer.distance;
    let [x, y, z] = answer.point.map(f32::to_bits);
    [lower.to_bits(), upper.to_bits(), x, y, z, answer.triangle.unwrap_or(u32::MAX)]
}

/// Batches and queries that move have the bits of single ones.
pub fn bits_do_not_depend_on_the_way(scene: &Scene, points: &[[f32; 3]]) {
    let (tree, mut stack) = (scene.tree(), scene.stack());
    let single: Vec<_> = points
        .iter()
        .map(|&p| tree.closest_point(p, Budget::EXACT, &mut stack).expect("a point"))
        .collect();
    let batch = closest_points(&tree, points, &Budget::EXACT).expect("points");
    let mut query = CoherentQuery::<64>::new();
    for ((&p, single), batch) in points.iter().zip(&single).zip(&batch) {
        let moving = query.closest_point(&tree, p, Budget::EXACT, &mut stack).expect("a point");
        for other in [batch, &moving.closest] {
            assert_eq!(bits(single), bits(other), "{}: {p:?}", scene.name);
        }
    }
}

/// The same on a path in small steps from one place to another.
pub fn bits_are_kept_on_a_path(scene: &Scene, ends: [[f32; 3]; 2]) {
    let (tree, mut stack) = (scene.tree(), scene.stack());
    let mut query = CoherentQuery::<32>::new();
    let [from, to] = ends.map(|p| p.map(f64::from));
    for step in 0..60 {
        let t = f64::from(step) / 60.0;
        let p = std::array::from_fn(|k| (from[k] + t * (to[k] - from[k])) as f32);
        let plain = tree.closest_point(p, Budget::EXACT, &mut stack).expect("a point");
        let moving = query.closest_point(&tree, p, Budget::EXACT, &mut stack).expect("a point");
        assert_eq!(bits(&plain), bits(&moving.closest), "{}: {p:?}", scene.name);
    }
}

/// No segment is wrongly clear, and no hit wrongly certain. Counts clear segments, certain hits and
/// open ones.
pub fn hits_are_true(scene: &Scene, segments: &[[[f32; 3]; 2]], seen: &mut [usize; 3]) {
    let [clear, certain, open] = seen;
    let (tree, mut stack) = (scene.tree(), scene.stack());
    let mut hits = vec![TriangleHit::EMPTY; 4 * scene.corners.len() + 64];
    for &[a, b] in segments {
        let [from, to] = [a, b].map(|p| p.map(f64::from));
        let truth: Vec<_> =
            scene.corners.iter().filter_map(|t| first_meeting(from, to, t)).collect();
        let at = || format!("{}: {a:?} {b:?}", scene.name);
        let first = match tree.first_hit(a, b, Facing::Both, Budget::EXACT, &mut stack) {
            Err(QueryError::OutOfDomain) => {
                let is_far = |p: [f64; 3]| p.iter().any(|x| x.abs() > 1e6 * scene.length());
                assert!(is_far(from) || is_far(to), "{}", at());
                continue;
            }
            first => first.expect("a segment"),
        };
        let is_missed = truth.iter().any(|t| t.compared_with(first.t.lower.into()) == Less);
        let is_missed = is_missed || (first.is_clear() && !truth.is_empty());
        assert!(!is_missed, "{}: {first:?}", at());
        if first.ended == Ended::Exact && first.hit.is_some() {
            let is_met = truth.iter().any(|t| t.compared_with(first.t.upper.into()) != Greater);
            assert!(is_met, "{}: {first:?}", at());
            *certain += 1;
        }
        *open += usize::from(first.ended == Ended::Resolution);
        *clear += usize::from(first.is_clear());
        for facing in [Facing::Both, Facing::Front, Facing::Back] {
            let any = tree.any_hit(a, b, facing, Budget::EXACT, &mut stack).expect("a segment");
            let wrong = match any.verdict {
                Verdict::Yes => truth.is_empty(),
                Verdict::No => match facing {
                    Facing::Both => !truth.is_empty(),
                    // A wire has no sides: who asks for one must not be told that it is clear.
                    _ => scene
                        .mesh
                        .wire_corners()
                        .any(|t| first_meeting(from, to, &t.map(|p| p.map(f64::from))).is_some()),
                },
                _ => false,
            };
            assert!(!wrong, "{} {facing:?}: {any:?}", at());
        }
        let all = tree
            .all_hits(a, b, Facing::Both, &mut hits, Budget::EXACT, &mut stack)
            .expect("a segment");
        if all.ended == Ended::Exact {
            assert_eq!(all.stored == 0, truth.is_empty(), "{}: {all:?}", at());
        }
    }
}
