//! Segments and overlap on the box tree against the exact oracle.

use crate::checks::hits_are_true;
use crate::scene::{Kind, Raw, Scene, inputs, pierced_cube, scenes, wires};
use meshsweep_core::{Budget, Bvh, Facing, Pose, ScratchEntry, TrianglePair, Verdict};
use meshsweep_host_tests::generate::Rng;
use meshsweep_host_tests::oracle::exact::{Corners, first_meeting, meet};

type Segment = [[f32; 3]; 2];

/// Parts of the size that segments pass points of the input by.
const OFF: [f64; 5] = [0.0, 0.0, 1e-6, 1e-3, 0.1];

/// Segments through points of the input, past them, along them, of no length.
fn segments(scene: &Scene, count: usize, seed: u64, off: &[f64]) -> Vec<Segment> {
    let rng = &mut Rng::new(seed);
    let size = scene.length();
    (0..count)
        .map(|i| {
            let (on, other) = (scene.on(rng), scene.on(rng));
            let off = off[i % off.len()] * size;
            let (aside, way) = (rng.direction(), rng.direction());
            let middle: [f64; 3] = std::array::from_fn(|k| on[k] + off * f64::from(aside[k]));
            let long = [0.5, 3.0, 1e3][i % 3] * size;
            let place =
                |t: f64| std::array::from_fn(|k| (middle[k] + t * long * f64::from(way[k])) as f32);
            let single = |p: [f64; 3]| p.map(|x| x as f32);
            match i % 7 {
                5 => [single(on), single(other)],
                6 if i % 2 == 0 => [single(on); 2],
                6 => {
                    // Along a side of a triangle, which a wire is.
                    let [a, b, _] = scene.corners[rng.below(scene.corners.len())];
                    let at = |t: f64| single(std::array::from_fn(|k| a[k] + t * (b[k] - a[k])));
                    [at(-0.5), at(2.0)]
                }
                _ => [place(-1.0), place(1.0)],
            }
        })
        .collect()
}

#[test]
fn no_segment_is_wrongly_clear_and_no_hit_is_wrongly_certain() {
    let mut seen = [0; 3];
    for scene in scenes() {
        hits_are_true(scene, &segments(scene, 140, 21, &OFF), &mut seen);
    }
    let [clear, certain, open] = seen;
    assert!(clear > 500 && certain > 300 && open > 500, "{clear} {certain} {open}");
}

#[test]
fn segments_past_a_wire_are_proved_clear() {
    for kind in [Kind::Grid, Kind::F32] {
        let scene = Scene::new("wires", &wires(40, 1), kind);
        let (tree, mut stack) = (scene.tree(), scene.stack());
        let (mut clear, mut told) = (0, 0);
        for [a, b] in segments(&scene, 500, 22, &[0.003, 0.1]) {
            let [from, to] = [a, b].map(|p| p.map(f64::from));
            if scene.corners.iter().all(|t| first_meeting(from, to, t).is_none()) {
                clear += 1;
                let answer =
                    tree.any_hit(a, b, Facing::Both, Budget::EXACT, &mut stack).expect("a segment");
                told += usize::from(answer.verdict == Verdict::No);
            }
        }
        // Some begin on a wire, or run along one.
        assert!(clear > 300 && told * 10 > clear * 7, "{kind:?}: {told} of {clear}");
    }
}

#[test]
fn no_overlap_is_wrongly_apart_and_none_wrongly_met() {
    let rng = &mut Rng::new(23);
    let probes: [(&str, Raw); 4] = [
        ("wires", wires(12, 2)),
        ("cube", pierced_cube()),
        ("plate", (vec![[0.0; 3], [0.75, 0.0, 0.25], [0.0, 1.0, 0.5]], vec![[0, 1, 2]])),
        ("point", (vec![[0.25, 0.5, -0.5]], vec![[0, 0, 0]])),
    ];
    let (mut apart, mut met, mut open) = (0, 0, 0);
    for (name, raw) in inputs().iter().filter(|(name, _)| !name.contains('×')) {
        for kind in [Kind::Grid, Kind::F32] {
            let scene = Scene::new(name, raw, kind);
            for (_, probe) in &probes {
                let probe = Scene::new("probe", probe, kind);
                for round in 0..6 {
                    let (on, of) = (scene.on(rng), probe.on(rng));
                    let off = [0.0, 1e-3, 0.3][round % 3];
                    let way = rng.direction();
                    let shift: [f32; 3] =
                        std::array::from_fn(|k| (on[k] - of[k] + off * f64::from(way[k])) as f32);
                    check_overlap(&scene, &probe, shift, [&mut apart, &mut met, &mut open]);
                }
            }
        }
    }
    assert!(apart > 100 && met > 20 && open > 100, "{apart} {met} {open}");
}

fn check_overlap(a: &Scene, b: &Scene, shift: [f32; 3], seen: [&mut usize; 3]) {
    let pose = Pose { translation: shift, ..Pose::IDENTITY };
    let mut stack = [ScratchEntry::EMPTY; Bvh::OVERLAP_ENTRIES];
    let (first, second) = (a.tree(), b.tree());
    let answer = first.overlap(&second, pose, Budget::EXACT, &mut stack).expect("a pose");
    // Sums of an f32 and of what the scenes are made of are exact in f64, or nearly: then a wrong
    // answer would show as well.
    let moved = |t: &Corners| t.map(|p| std::array::from_fn(|k| p[k] + f64::from(shift[k])));
    let others: Vec<Corners> = b.corners.iter().map(moved).collect();
    let truth = || a.corners.iter().any(|t| others.iter().any(|other| meet(t, other)));
    let at = || format!("{} and {} by {shift:?}: {answer:?}", a.name, b.name);
    let [apart, met, open] = seen;
    match answer.verdict {
        Verdict::No => {
            assert!(!truth(), "{}", at());
            *apart += 1;
        }
        Verdict::Yes => {
            assert!(truth(), "{}", at());
            *met += 1;
        }
        _ => *open += 1,
    }
    let mut pairs = vec![TrianglePair::EMPTY; 10_000];
    let all =
        first.all_overlaps(&second, pose, &mut pairs, Budget::EXACT, &mut stack).expect("a pose");
    assert_eq!(all.stored == 0, answer.verdict == Verdict::No, "{}", at());
}
