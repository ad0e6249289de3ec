//! Whether a curve is within a distance: proved answers are right.

use super::scenes::{scenes, scratch};
use meshsweep_core::{Budget, QueryError, Undecided, Verdict};

#[test]
fn verdicts_are_right_with_any_budget_and_scratch_and_decided_where_they_can_be() {
    for scene in scenes() {
        let curve = scene.curve();
        let enough = curve.scratch_entries();
        for (k, p) in (0..).zip(scene.points(40, 11)) {
            let truth = scene.truth(p);
            let error = f64::from(curve.surface_error()) + 1e-6 * truth.upper;
            let far = 3.0 * truth.upper as f32 + scene.size();
            let near = truth.upper as f32;
            for distance in
                [0.0, 0.5 * near, near.next_down().max(0.0), near, near.next_up(), 1.1 * near, far]
            {
                for (budget, entries) in [
                    (Budget::EXACT, enough),
                    (Budget::EXACT, 200),
                    (Budget::EXACT, 1),
                    (Budget::EXACT.with_steps(k), enough),
                ] {
                    let mut memory = scratch(entries);
                    let answer = curve.within(p, distance, budget, &mut memory).expect("finite");
                    let told = || format!("{} {p:?} {distance} {truth:?} {answer:?}", scene.name);
                    let asked = f64::from(distance);
                    match answer.verdict {
                        Verdict::Yes => {
                            assert!(truth.lower <= asked, "{}", told());
                            let segment = answer.witness.expect("it is named");
                            assert!(scene.distance(p, segment).lower <= asked, "{}", told());
                        }
                        Verdict::No => assert!(truth.upper > asked, "{}", told()),
                        Verdict::Undecided(Undecided::Resolution) => {
                            assert!(
                                (truth.upper - asked).abs() <= 2.0 * error + 1e-40,
                                "{}",
                                told()
                            );
                        }
                        Verdict::Undecided(Undecided::Steps) => {
                            assert_eq!(answer.work.opened, budget.steps, "{}", told());
                        }
                        other => {
                            assert_eq!(other, Verdict::Undecided(Undecided::Scratch), "{}", told());
                            assert!(entries < enough, "{}", told());
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn wrong_questions_are_refused() {
    let scene = &scenes()[0];
    let ask = |p, distance, entries| {
        scene.curve().within(p, distance, Budget::EXACT, &mut scratch(entries)).err()
    };
    assert_eq!(ask([f32::NAN, 0.0, 0.0], 1.0, 9), Some(QueryError::NotFinite));
    for distance in [-1.0, f32::NAN, f32::INFINITY] {
        assert_eq!(ask([0.0; 3], distance, 9), Some(QueryError::Tolerance));
    }
    assert_eq!(ask([0.0; 3], 1.0, 0), Some(QueryError::NoScratch));
}
