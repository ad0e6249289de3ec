//! Spheres and capsules, at rest and moving, by a field and a box tree: nothing that meets the
//! surface is called clear.

use super::with_tree::{Case, cases, stack};
use meshsweep_core::{Budget, BvhWithSdf, Solid, Verdict};
use meshsweep_host_tests::generate::Rng;
use meshsweep_host_tests::oracle::gap_to_triangle;

const SOLIDS: usize = 64;

/// Rounding of f64 in the oracle.
const ROOM: f64 = 1e-9;

type Ends = [[f32; 3]; 2];

/// The distance of a segment and the mesh, in f64.
fn gap(case: &Case, [a, b]: Ends) -> f64 {
    let (positions, triangles) = &case.mesh;
    let gap = |triangle: &[u32; 3]| gap_to_triangle(a, b, triangle.map(|v| positions[v as usize]));
    triangles.iter().map(gap).fold(f64::INFINITY, f64::min)
}

/// Two points of one neighbourhood.
fn ends(case: &Case, rng: &mut Rng, number: usize) -> Ends {
    let a = case.point(rng, number);
    let length = case.diagonal() * [0.0, 1e-7, 0.01, 0.2, 2.0][rng.below(5)] * rng.unit_f64();
    let way = rng.direction().map(f64::from);
    [a, [0, 1, 2].map(|k| (f64::from(a[k]) + length * way[k]) as f32)]
}

/// Shares of the gap of a segment that radius and distance are.
const SHARES: [(f64, f64); 6] =
    [(0.0, 0.5), (0.5, 0.0), (0.5, 0.49), (0.5, 0.51), (0.7, 1.0), (0.999, 0.0)];

fn with<T>(ends: &Ends, radius: f32, ask: impl FnOnce(&Solid<'_>) -> T) -> T {
    // A sphere, if both ends are one point.
    let corners = if ends[0] == ends[1] { &ends[..1] } else { &ends[..] };
    ask(&Solid::new(corners, radius).expect("a solid"))
}

fn within(both: &BvhWithSdf<'_>, ends: &Ends, radius: f32, distance: f32) -> (Verdict, bool) {
    with(ends, radius, |solid| {
        let found = both.solid_within(solid, distance, Budget::EXACT, &mut stack(both));
        let found = found.expect("answers");
        (found.verdict, found.work.opened == 0)
    })
}

#[test]
fn no_verdict_about_a_solid_is_wrong_and_the_tree_s_stand() {
    let mut alone = 0;
    for case in cases() {
        let (both, mut rng) = (case.open(), Rng::new(11));
        for number in 0..SOLIDS {
            let ends = ends(case, &mut rng, number);
            let gap = gap(case, ends);
            if gap > 100.0 * case.diagonal() {
                continue;
            }
            for (radius, distance) in SHARES {
                let [radius, distance] = [radius, distance].map(|share| (share * gap) as f32);
                let name = format!("{} {ends:?} {radius} {distance}", case.name);
                let (verdict, by_field) = within(&both, &ends, radius, distance);
                let sum = f64::from(radius) + f64::from(distance);
                match verdict {
                    Verdict::Yes => assert!(gap <= sum * (1.0 + ROOM), "{name}: {gap}"),
                    Verdict::No => assert!(gap >= sum * (1.0 - ROOM), "{name}: {gap}"),
                    _ => {}
                }
                let by_tree = with(&ends, radius, |solid| {
                    both.tree().solid_within(solid, distance, Budget::EXACT, &mut stack(&both))
                });
                let by_tree = by_tree.expect("answers").verdict;
                if !matches!(by_tree, Verdict::Undecided(_)) {
                    assert_eq!(verdict, by_tree, "{name}");
                }
                alone += u32::from(by_field);
            }
        }
    }
    assert!(alone > 1000, "only {alone} verdicts were the field's");
}

/// The capsule at a part of its motion.
fn at(from: &Ends, to: &Ends, t: f64) -> Ends {
    let place = |a: f32, b: f32| (f64::from(a) + t * (f64::from(b) - f64::from(a))) as f32;
    [0, 1].map(|end| [0, 1, 2].map(|k| place(from[end][k], to[end][k])))
}

#[test]
fn no_motion_that_meets_the_surface_is_clear_and_what_the_tree_clears_is_clear() {
    let (mut clear, mut alone) = (0, 0);
    for case in cases() {
        let (both, mut rng) = (case.open(), Rng::new(12));
        for number in 0..SOLIDS {
            let from = ends(case, &mut rng, number);
            let mut to = ends(case, &mut rng, number / 2);
            if from[0] == from[1] {
                to[1] = to[0];
            } else if to[0] == to[1] {
                continue;
            }
            if rng.below(2) == 0 {
                // A little farther.
                to = at(&from, &to, 0.05);
                if (from[0] == from[1]) != (to[0] == to[1]) {
                    continue;
                }
            }
            let least = (0..=64).map(|part| gap(case, at(&from, &to, f64::from(part) / 64.0)));
            let least = least.fold(f64::INFINITY, f64::min);
            let far = number % 8 == 7 || (number / 2) % 8 == 7;
            if least > 100.0 * case.diagonal() {
                continue;
            }
            for share in [0.0, 0.3, 0.9, 1.1] {
                let radius = (share * least) as f32;
                let [by_both, by_tree] = [true, false].map(|is_both| {
                    with(&from, radius, |from| {
                        with(&to, radius, |to| {
                            let mut stack = stack(&both);
                            let exact = Budget::EXACT;
                            if is_both {
                                both.solid_first_contact(from, to, exact, &mut stack)
                            } else {
                                both.tree().solid_first_contact(from, to, exact, &mut stack)
                            }
                        })
                    })
                });
                // The tree has a domain; the field may answer beyond it.
                let (Ok(by_both), Ok(by_tree)) = (by_both, by_tree) else {
                    assert!(far, "{} {from:?} {to:?}", case.name);
                    continue;
                };
                let name = format!("{} {from:?} {to:?} {radius}", case.name);
                if by_both.is_clear() {
                    let room = 1e-6 * least + 1e-7 * case.diagonal();
                    assert!(least + room >= f64::from(radius), "{name}: {least}");
                    clear += 1;
                    alone += u32::from(by_both.work.opened == 0);
                } else {
                    assert_eq!(by_both, by_tree, "{name}");
                }
                assert!(by_both.is_clear() || !by_tree.is_clear(), "{name}");
            }
        }
    }
    assert!(clear > 300 && alone > 100, "{clear} clear, {alone} by the field");
}

#[test]
fn a_solid_of_many_corners_is_the_tree_s() {
    let case = &cases()[1];
    let both = case.open();
    let corners = Solid::box_corners([100.0, 0.0, 0.0], [110.0, 10.0, 10.0]);
    let solid = Solid::new(&corners, 1.0).expect("a solid");
    let (mut stack, exact) = (stack(&both), Budget::EXACT);
    let found = both.solid_within(&solid, 5.0, exact, &mut stack);
    assert_eq!(found, both.tree().solid_within(&solid, 5.0, exact, &mut stack));
    let met = both.solid_first_contact(&solid, &solid, exact, &mut stack);
    assert_eq!(met, both.tree().solid_first_contact(&solid, &solid, exact, &mut stack));
}
