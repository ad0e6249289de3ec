//! The target for curves of blobs.

use super::input::Input;
use super::suite::ask_all;
use crate::generate::curves::{circle, fence, open, walk};
use meshsweep::curve::{CurveOptions, Polyline, Zone, build};
use meshsweep::progress::Watch;
use meshsweep_core::{
    Blob, Budget, Curve, CurveNeighbor, Ended, QueryError, ScratchEntry, Side, Verdict,
};
use meshsweep_suite::ask::curve;
use std::sync::OnceLock;

/// Small valid blobs of curves: one segment and many, several polylines, f32 and grid, 2-D and 3-D,
/// zones.
///
/// # Panics
/// If one of them cannot be built.
pub fn curve_seeds() -> &'static [Vec<u8>] {
    static SEEDS: OnceLock<Vec<Vec<u8>>> = OnceLock::new();
    SEEDS.get_or_init(|| {
        let blob = |polylines: &[Polyline], is_f32| {
            let built = build(polylines, &CurveOptions { is_f32 }, Watch::NONE);
            built.expect("finite").0.to_bytes()
        };
        vec![
            blob(&[open(vec![[0.0; 3], [1.0, 2.0, 3.0]])], true),
            blob(&[walk(300, 3)], false),
            blob(&[walk(9, 1), open(vec![[0.5; 3]; 3]), circle(7)], true),
            blob(&fence(), true),
            blob(&[circle(90), Polyline { zone: Zone::Exclusion, ..circle(5) }], false),
        ]
    })
}

/// Asks everything of opened curves, at ordinary places and at hostile ones.
///
/// # Panics
/// If an answer is out of range or took too long.
pub fn ask_curve(curve: &Curve<'_>) {
    for p in [[0.1, 0.2, 0.3], [5.0, -3.0, 1.0], [1e36, -1e36, 1e36], [1e-40, 0.0, -0.0]] {
        ask(curve, p, 0.5, Budget::EXACT, curve.scratch_entries());
        ask(curve, p, 1e20, Budget::EXACT.with_steps(2), 1);
    }
}

fn ask(curve: &Curve<'_>, p: [f32; 3], distance: f32, budget: Budget, entries: usize) {
    let mut scratch = vec![ScratchEntry::EMPTY; entries];
    let most = 4 * curve.header().points + 4;
    match curve.closest_point(p, budget, &mut scratch) {
        Ok(near) => {
            let interval = near.distance;
            assert!(interval.lower >= 0.0 && interval.lower <= interval.upper, "{near:?}");
            assert!(near.point.iter().all(|x| x.is_finite()) && near.safe_motion >= 0.0);
            assert!((0.0..=1.0).contains(&near.t) && near.work.total() <= most, "{near:?}");
            assert!(near.segment.polyline < curve.polyline_count(), "{near:?}");
            let starved = near.ended == Ended::Scratch;
            assert!(!starved || entries < curve.scratch_entries(), "{near:?}");
        }
        Err(error) => assert_ne!(error, QueryError::Unchecked),
    }
    let mut out = [CurveNeighbor::EMPTY; 3];
    match curve.nearest(p, &mut out, budget, &mut scratch) {
        Ok(found) => assert!(found.stored <= 3 && found.work.total() <= most, "{found:?}"),
        Err(error) => assert_ne!(error, QueryError::Unchecked),
    }
    match curve.all_within(p, distance, &mut out, budget, &mut scratch) {
        Ok(found) => {
            assert!(found.certain <= found.stored && found.stored <= 3, "{found:?}");
            assert!(found.work.total() <= most, "{found:?}");
        }
        Err(error) => assert_ne!(error, QueryError::Unchecked),
    }
    let [x, y, _] = p;
    match curve.signed_distance([x, y], budget, &mut scratch) {
        Ok(found) => {
            let (interval, near) = (found.distance, found.closest);
            assert!(curve.check_fence().is_ok() && interval.lower <= interval.upper, "{found:?}");
            assert!(near.work.total() <= 2 * most, "{found:?}");
            let decided = match found.side {
                Side::Inside => interval.upper < 0.0,
                Side::Outside => interval.lower > 0.0,
                _ => interval.lower == -interval.upper,
            };
            assert!(decided && interval.upper.abs().max(-interval.lower) == near.distance.upper);
        }
        Err(error) => assert_ne!(error, QueryError::Unchecked),
    }
    match curve.within(p, distance, budget, &mut scratch) {
        Ok(near) => {
            assert!(near.work.total() <= most, "{near:?}");
            assert_eq!(near.witness.is_some(), near.verdict == Verdict::Yes, "{near:?}");
        }
        Err(error) => assert_ne!(error, QueryError::Unchecked),
    }
}

/// Opens raw bytes, then edits of a blob, and asks about any points.
pub fn curves(data: &[u8]) {
    if let Ok(opened) = Curve::open(data) {
        ask_curve(&opened);
    }
    let mut input = Input(data);
    let bytes = input.blob(curve_seeds());
    let opened = Curve::open(&bytes);
    // The same bytes as a blob: all of them are checked, the curves among them. An edit may have
    // made a section of an unknown kind of them.
    if let Ok(blob) = Blob::open(&bytes) {
        assert_eq!(blob.curve().is_ok(), opened.is_ok(), "{opened:?}");
    }
    let Ok(curve) = opened else { return };
    ask_curve(&curve);
    let entries = 1 + usize::from(input.byte());
    let budget = Budget::EXACT
        .with_relative(input.float())
        .with_absolute(input.float())
        .with_steps(u32::from(input.byte()));
    ask(&curve, input.point(), input.float(), budget, entries);
    ask_all::<Curve<'_>>(&bytes, curve::Scratch::new(), &mut input);
}
