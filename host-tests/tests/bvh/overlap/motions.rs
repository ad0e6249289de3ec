//! Motions, and the exact answers about them.

use meshsweep_core::{
    Budget, Bvh, Ended, Overlap, Pose, ScratchEntry, TrianglePair, Undecided, Verdict,
};
use meshsweep_host_tests::generate::Rng;
use meshsweep_host_tests::oracle::moved::{Place, meeting_pairs};
use meshsweep_host_tests::scene::Scene;

pub type Point = [f32; 3];

fn places(scene: &Scene, at: impl Fn(Point) -> Place) -> Vec<[Place; 3]> {
    let places: Vec<Place> = scene.positions.iter().map(|&p| at(p)).collect();
    scene.triangles.iter().map(|t| t.map(|v| places[v as usize].clone())).collect()
}

/// Pairs of triangles that meet, by exact predicates.
pub fn truth(a: &Scene, b: &Scene, pose: &Pose) -> Vec<[u32; 2]> {
    let moved = |p: Point| Place::moved(p, &pose.rotation, pose.translation);
    meeting_pairs(&places(a, Place::of), &places(b, moved))
}

/// A rotation up to rounding.
pub fn rotation(rng: &mut Rng) -> [Point; 3] {
    let x = rng.direction().map(f64::from);
    let other = rng.direction().map(f64::from);
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let unit = |v: [f64; 3]| {
        let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        v.map(|x| x / length)
    };
    let z = unit(cross(x, other));
    [x, cross(z, x), z].map(|row| row.map(|x| x as f32))
}

/// A motion that brings the middle of `b` to `place`, with any rotation.
pub fn placed(b: &Scene, rotation: [Point; 3], place: Point) -> Pose {
    let (low, high) = b.bounds();
    let middle: [f64; 3] = std::array::from_fn(|k| 0.5 * (f64::from(low[k]) + f64::from(high[k])));
    let translation = std::array::from_fn(|k| {
        let turned: f64 = (0..3).map(|j| f64::from(rotation[k][j]) * middle[j]).sum();
        (f64::from(place[k]) - turned) as f32
    });
    Pose { rotation, translation }
}

/// Random motions that leave the one now inside, now across, now beside the other.
pub fn motions(a: &Scene, b: &Scene, count: usize, seed: u64) -> Vec<Pose> {
    let mut rng = Rng::new(seed);
    let ((low, high), (from, to)) = (a.bounds(), b.bounds());
    let size = |low: Point, high: Point| (0..3).map(|k| high[k] - low[k]).fold(0f32, f32::max);
    let grown = 0.7 * size(from, to);
    let (low, high) = (low.map(|x| x - grown), high.map(|x| x + grown));
    (0..count)
        .map(|_| {
            let rotation = rotation(&mut rng);
            placed(b, rotation, rng.point_in(low, high))
        })
        .collect()
}

pub fn is_open(verdict: Verdict) -> bool {
    matches!(verdict, Verdict::Undecided(_))
}

pub fn ask(a: &Bvh<'_>, b: &Bvh<'_>, pose: &Pose) -> Overlap {
    let mut stack = [ScratchEntry::EMPTY; Bvh::OVERLAP_ENTRIES];
    a.overlap(b, *pose, Budget::EXACT, &mut stack).expect("answers")
}

/// All pairs and how the search ended; nothing may be dropped.
pub fn ask_all(a: &Bvh<'_>, b: &Bvh<'_>, pose: &Pose) -> (Vec<TrianglePair>, Ended) {
    let mut stack = [ScratchEntry::EMPTY; Bvh::OVERLAP_ENTRIES];
    let mut pairs = vec![TrianglePair::EMPTY; 200_000];
    let all = a.overlaps(b, *pose, &mut pairs, Budget::EXACT, &mut stack).expect("answers");
    assert_eq!(all.dropped, 0);
    pairs.truncate(all.stored);
    (pairs, all.ended)
}

/// How often each answer was given.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Tally {
    pub apart: usize,
    pub meets: usize,
    pub open: usize,
}

/// Holds every answer about two meshes to the exact one, for each pair of their trees; counts the
/// answers of each.
pub fn holds(name: &str, a: &Scene, b: &Scene, pose: &Pose, tallies: &mut [Tally; 4]) {
    let truth = truth(a, b, pose);
    for (number, tally) in tallies.iter_mut().enumerate() {
        let (first, second) = (a.trees()[number & 1], b.trees()[number >> 1]);
        let name = format!("{name}, trees {number}, {pose:?}");
        let answer = ask(&first, &second, pose);
        match answer.verdict {
            Verdict::No => {
                tally.apart += 1;
                assert!(truth.is_empty(), "{name}: wrongly apart: {} pairs meet", truth.len());
            }
            Verdict::Yes => {
                tally.meets += 1;
                let pair = answer.triangles.expect("a pair");
                assert!(truth.contains(&pair), "{name}: {pair:?} do not meet");
            }
            verdict => {
                assert_eq!(verdict, Verdict::Undecided(Undecided::Resolution), "{name}");
                tally.open += 1;
                assert!(answer.triangles.is_some(), "{name}: which pair is open");
            }
        }
        let (pairs, ended) = ask_all(&first, &second, pose);
        let mut listed: Vec<[u32; 2]> = pairs.iter().map(|pair| pair.triangles).collect();
        listed.sort_unstable();
        let count = listed.len();
        listed.dedup();
        assert_eq!(count, listed.len(), "{name}: a pair is listed twice");
        for pair in &truth {
            assert!(listed.binary_search(pair).is_ok(), "{name}: {pair:?} is missing");
        }
        for pair in pairs.iter().filter(|pair| pair.is_certain) {
            assert!(truth.contains(&pair.triangles), "{name}: {pair:?} do not meet");
        }
        let all_certain = pairs.iter().all(|pair| pair.is_certain);
        assert_eq!(ended, if all_certain { Ended::Exact } else { Ended::Resolution }, "{name}");
        assert_eq!(answer.verdict == Verdict::No, pairs.is_empty(), "{name}");
        assert_eq!(
            answer.verdict == Verdict::Yes,
            pairs.iter().any(|pair| pair.is_certain),
            "{name}"
        );
    }
}
