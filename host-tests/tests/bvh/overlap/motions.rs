//! Answers about motions, held to the exact ones.

use meshsweep_core::{Budget, Bvh, Decided, Ended, Pose, ScratchEntry, TrianglePair, Verdict};
pub use meshsweep_host_tests::motion::{Tally, motions, placed, rotation, truth};
use meshsweep_host_tests::scene::Scene;

pub fn is_open(verdict: Verdict) -> bool {
    matches!(verdict, Verdict::Undecided(_))
}

pub fn ask(a: &Bvh<'_>, b: &Bvh<'_>, pose: &Pose) -> Decided<[u32; 2]> {
    let mut stack = [ScratchEntry::EMPTY; Bvh::OVERLAP_ENTRIES];
    a.overlap(b, *pose, Budget::EXACT, &mut stack).expect("answers")
}

/// All pairs and how the search ended; nothing may be dropped.
pub fn ask_all(a: &Bvh<'_>, b: &Bvh<'_>, pose: &Pose) -> (Vec<TrianglePair>, Ended) {
    let mut stack = [ScratchEntry::EMPTY; Bvh::OVERLAP_ENTRIES];
    let mut pairs = vec![TrianglePair::EMPTY; 200_000];
    let all = a.all_overlaps(b, *pose, &mut pairs, Budget::EXACT, &mut stack).expect("answers");
    assert_eq!(all.dropped, 0);
    pairs.truncate(all.stored);
    (pairs, all.ended)
}

/// Holds every answer about two meshes to the exact one, for each pair of their trees; counts the
/// answers of each.
pub fn holds(name: &str, a: &Scene, b: &Scene, pose: &Pose, tallies: &mut [Tally; 4]) {
    let truth = truth(a, b, pose);
    for (number, tally) in tallies.iter_mut().enumerate() {
        let (first, second) = (a.trees()[number & 1], b.trees()[number >> 1]);
        let name = format!("{name}, trees {number}, {pose:?}");
        let answer = ask(&first, &second, pose);
        tally.hold(&answer, &truth, &name);
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
