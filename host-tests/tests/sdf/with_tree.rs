//! A field and a box tree of one blob: no answer is wrong, and none is worse than the tree's.

use meshsweep::Builder;
use meshsweep::builder::{For, SdfKind, SdfLayout};
use meshsweep::mesh::RawMesh;
use meshsweep_core::{
    Budget, BvhWithSdf, Ended, Interval, QueryError, ScratchEntry, Side, Undecided, Verdict,
};
use meshsweep_host_tests::generate::{
    Rng, Triangles, block, bracket, icosphere, joined, plate, rough_sphere, scaled, transformed,
};
use meshsweep_host_tests::oracle::{Bounded, distance_to_mesh, winding_number};
use std::sync::LazyLock;

const POINTS: usize = 96;

const KINDS: [SdfKind; 3] = [SdfKind::Surface, SdfKind::Signed, SdfKind::Solid];

/// A mesh, its blob, and what the blob's field is of.
pub struct Case {
    pub name: String,
    pub mesh: Triangles,
    pub bytes: Vec<u8>,
}

impl Case {
    pub fn new(name: &str, mesh: Triangles, kind: SdfKind, bytes: u32) -> Case {
        let served = [For::Closest, For::Segment, For::Sdf];
        let builder = Builder::new().serve_all(served).sdf_kind(kind).sdf_bytes(bytes);
        let built = builder.build(RawMesh::from_f32(&mesh.0, &mesh.1)).expect("builds");
        Case { name: format!("{name} {kind:?}"), mesh, bytes: built.into_bytes() }
    }

    pub fn open(&self) -> BvhWithSdf<'_> {
        BvhWithSdf::open(&self.bytes).expect("opens")
    }

    pub fn truth(&self, p: [f32; 3]) -> Bounded {
        distance_to_mesh(p, &self.mesh.0, &self.mesh.1)
    }

    /// Of the mesh's box.
    pub fn diagonal(&self) -> f64 {
        let [low, high] = self.open().tree().bounds();
        let side = |k: usize| f64::from(high[k]) - f64::from(low[k]);
        (side(0).powi(2) + side(1).powi(2) + side(2).powi(2)).sqrt()
    }

    /// A point on the surface or next to it, at the edge of the field, or far outside.
    pub fn point(&self, rng: &mut Rng, number: usize) -> [f32; 3] {
        let (positions, triangles) = &self.mesh;
        let [low, high] = self.open().field().bounds().map(|corner| corner.map(f64::from));
        let diagonal = self.diagonal();
        let surface = {
            let triangle = triangles[rng.below(triangles.len())];
            let (a, b) = (rng.unit_f64(), rng.unit_f64());
            let (a, b) = if a + b > 1.0 { (1.0 - a, 1.0 - b) } else { (a, b) };
            [0, 1, 2].map(|k| {
                let [p, q, r] = triangle.map(|v| f64::from(positions[v as usize][k]));
                p + a * (q - p) + b * (r - p)
            })
        };
        let off = diagonal * [0.0, 1e-6, 1e-3, 0.02, 0.1, 0.3][number % 6];
        match number % 8 {
            6 => {
                // In a face of the field's box.
                let axis = rng.below(3);
                let mut p = [0, 1, 2].map(|k| low[k] + (high[k] - low[k]) * rng.unit_f64());
                p[axis] = if rng.below(2) == 0 { low[axis] } else { high[axis] };
                p.map(|x| x as f32)
            }
            7 => {
                let way = rng.direction().map(f64::from);
                let far = diagonal * [2.0, 50.0, 1e4, 1e7][rng.below(4)];
                [0, 1, 2].map(|k| (surface[k] + far * way[k]) as f32)
            }
            _ => surface.map(|x| (x + off * (2.0 * rng.unit_f64() - 1.0)) as f32),
        }
    }

    /// Points, each with the distances that questions are about.
    pub fn questions(&self, seed: u64, each: impl Fn([f32; 3], f32)) {
        let mut rng = Rng::new(seed);
        for number in 0..POINTS {
            let p = self.point(&mut rng, number);
            let truth = self.truth(p).upper;
            for d in
                [0.0, 0.01 * self.diagonal(), 0.05 * self.diagonal(), 0.999 * truth, 1.001 * truth]
            {
                each(p, d.min(3e38) as f32);
            }
        }
    }
}

fn moved(mesh: &Triangles, by: [f32; 3]) -> Triangles {
    transformed(mesh, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], by)
}

/// Meshes of every kind of field, at several scales. Built once: proofs take long.
pub fn cases() -> &'static [Case] {
    static CASES: LazyLock<Vec<Case>> = LazyLock::new(made);
    &CASES
}

fn made() -> Vec<Case> {
    let crossed = joined(&icosphere(2), &moved(&icosphere(2), [0.9, 0.3, 0.2]));
    let (positions, triangles) = block([0.0; 3], [3.0, 2.0, 1.0]);
    let sheet = (positions, triangles[..6].to_vec());
    let mut cases = vec![Case::new("sheet", sheet, SdfKind::Surface, 800)];
    for kind in KINDS {
        cases.push(Case::new("bracket", bracket(), kind, 2048));
        cases.push(Case::new("rough", rough_sphere(2, 0.3, 3), kind, 1024));
        cases.push(Case::new("crossed", crossed.clone(), kind, 800));
        cases.push(Case::new("plate", plate([0.3, 0.1], 0.004), kind, 800));
        cases.push(Case::new("tiny", scaled(&rough_sphere(2, 0.2, 5), 1e-30), kind, 800));
        cases.push(Case::new("huge", scaled(&rough_sphere(2, 0.2, 5), 1e30), kind, 800));
    }
    cases
}

pub fn stack(both: &BvhWithSdf<'_>) -> Vec<ScratchEntry> {
    vec![ScratchEntry::EMPTY; both.tree().scratch_entries()]
}

fn holds(interval: Interval, truth: Bounded) -> bool {
    f64::from(interval.lower) <= truth.upper && truth.lower <= f64::from(interval.upper)
}

/// Where the mesh is, as f64 tells: `None` next to the surface, and where it winds otherwise.
fn is_inside(case: &Case, p: [f32; 3], truth: Bounded) -> Option<bool> {
    if truth.upper < 1e-4 * case.diagonal() || truth.upper > 100.0 * case.diagonal() {
        return None;
    }
    let (positions, triangles) = &case.mesh;
    let winding = winding_number(p.map(f64::from), positions, triangles, case.diagonal());
    match winding {
        out if out.abs() < 1e-3 => Some(false),
        within if (within - 1.0).abs() < 1e-3 => Some(true),
        _ => None,
    }
}

fn assert_side(case: &Case, p: [f32; 3], truth: Bounded, side: Side) {
    let inside = is_inside(case, p, truth);
    match side {
        Side::Inside => assert_ne!(inside, Some(false), "{} {p:?}", case.name),
        Side::Outside => assert_ne!(inside, Some(true), "{} {p:?}", case.name),
        _ => {}
    }
}

#[test]
fn no_verdict_is_wrong_and_what_the_tree_decides_is_decided() {
    let mut alone = 0;
    for case in cases() {
        let both = case.open();
        let alone_here = std::cell::Cell::new(0);
        case.questions(1, |p, d| {
            let (mut stack, exact) = (stack(&both), Budget::EXACT);
            let answer = both.within(p, d, exact, &mut stack).expect("answers");
            let by_tree = both.tree().within(p, d, exact, &mut stack).expect("answers");
            let truth = case.truth(p);
            let name = &case.name;
            match answer.verdict {
                Verdict::Yes => assert!(truth.lower <= f64::from(d), "{name} {p:?} {d}"),
                Verdict::No => assert!(truth.upper > f64::from(d), "{name} {p:?} {d}"),
                _ => {}
            }
            if by_tree.verdict != Verdict::Undecided(Undecided::Resolution) {
                assert_eq!(answer.verdict, by_tree.verdict, "{name} {p:?} {d}");
            }
            if answer.witness.is_some() {
                assert_eq!(answer.witness, by_tree.witness);
            }
            alone_here.set(alone_here.get() + u32::from(answer.work.opened == 0));
        });
        alone += alone_here.get();
    }
    assert!(alone > 2000, "only {alone} verdicts were the field's");
}

/// Tolerances, each with how wide an interval at a lower end may be.
/// Without a margin the mesh may stand a part of a unit above the field.
#[test]
fn no_verdict_is_wrong_at_the_border_of_a_solid_field_without_a_margin() {
    let mesh = block([0.0; 3], [3.0, 2.0, 1.0]);
    let mut alone = 0;
    for layout in SdfLayout::ALL {
        let builder = Builder::new().serve_all([For::Closest, For::Sdf]).sdf_kind(SdfKind::Solid);
        let builder = builder.sdf_layout(layout).sdf_margin(0.0).sdf_bytes(400);
        let built = builder.build(RawMesh::from_f32(&mesh.0, &mesh.1)).expect("builds");
        let both = BvhWithSdf::open(built.bytes()).expect("opens");
        let [low, high] = both.field().bounds().map(|corner| corner.map(f64::from));
        let (mut rng, unit) = (Rng::new(12), f64::from(both.field().unit()));
        for number in 0..6000 {
            let mut p = [0, 1, 2].map(|k| low[k] + (high[k] - low[k]) * rng.unit_f64());
            p[number % 3] = high[number % 3] + 3.0 * unit * (2.0 * rng.unit_f64() - 1.0);
            let (p, d) = (p.map(|x| x as f32), (unit * 1e4f64.powf(rng.unit_f64())) as f32);
            let mut stack = stack(&both);
            let found = both.within(p, d, Budget::EXACT, &mut stack).expect("answers");
            let truth = distance_to_mesh(p, &mesh.0, &mesh.1);
            match found.verdict {
                Verdict::Yes => assert!(truth.lower <= f64::from(d), "{layout:?} {p:?} {d}"),
                Verdict::No => assert!(truth.upper > f64::from(d), "{layout:?} {p:?} {d}"),
                _ => {}
            }
            alone += u32::from(found.work.opened == 0);
        }
    }
    assert!(alone > 2000, "only {alone} verdicts were the field's");
}

fn tolerances(diagonal: f64) -> [(Budget, f32, f32); 5] {
    let near = (0.01 * diagonal) as f32;
    let exact = Budget::EXACT;
    [
        (exact, 0.0, 0.0),
        (exact.with_relative(0.02), 0.02, 0.0),
        (exact.with_relative(0.5), 0.5, 0.0),
        (exact.with_absolute(near), 0.0, near),
        (exact.with_relative(0.1).with_absolute(near), 0.1, near),
    ]
}

#[test]
fn distances_hold_and_are_as_narrow_as_asked_for_or_as_the_tree_tells() {
    for case in cases() {
        let (both, mut rng) = (case.open(), Rng::new(2));
        let mut stack = stack(&both);
        for number in 0..POINTS {
            let p = case.point(&mut rng, number);
            let truth = case.truth(p);
            let exact = both.tree().closest_point(p, Budget::EXACT, &mut stack).expect("answers");
            for (budget, relative, absolute) in tolerances(case.diagonal()) {
                let name = format!("{} {p:?} {budget:?}", case.name);
                let near = both.closest_point(p, budget, &mut stack).expect("answers");
                let alone = both.tree().closest_point(p, budget, &mut stack).expect("answers");
                let found = both.distance_bounds(p, budget, &mut stack).expect("answers");
                assert!(holds(near.distance, truth), "{name}: {near:?}, {truth:?}");
                assert!(holds(found.distance, truth), "{name}: {found:?}, {truth:?}");
                let gap = distance_between(near.point, p);
                assert!(gap <= 1.0001 * f64::from(near.distance.upper), "{name}: {gap} {near:?}");
                if budget == Budget::EXACT {
                    assert_eq!(
                        (near.distance, near.point),
                        (alone.distance, alone.point),
                        "{name}"
                    );
                }
                // Wider than asked by what an exact answer of the tree is wide.
                let width = |of: Interval| f64::from(of.upper) - f64::from(of.lower);
                for of in [near.distance, found.distance] {
                    let by_part = f64::from(relative) * f64::from(of.lower);
                    let asked = by_part.max(f64::from(absolute));
                    let most = 1.001 * asked + 2.0 * width(exact.distance);
                    assert!(width(of) <= most, "{name}: {of:?}, asked {asked}, {exact:?}");
                }
                assert!(found.distance.lower <= found.distance.upper, "{name}");
            }
        }
    }
}

fn distance_between(a: [f32; 3], b: [f32; 3]) -> f64 {
    let side = |k: usize| f64::from(a[k]) - f64::from(b[k]);
    let largest = [0, 1, 2].map(side).into_iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    if largest == 0.0 {
        return 0.0;
    }
    let square = |k: usize| (side(k) / largest).powi(2);
    (square(0) + square(1) + square(2)).sqrt() * largest
}

#[test]
fn no_side_is_wrong_and_signed_intervals_hold() {
    let mut told = 0;
    for case in cases() {
        let (both, mut rng) = (case.open(), Rng::new(3));
        let mut stack = stack(&both);
        for number in 0..POINTS {
            let p = case.point(&mut rng, number);
            let truth = case.truth(p);
            let by_tree =
                both.tree().signed_distance(p, Budget::EXACT, &mut stack).expect("answers");
            let signed = both.signed_distance(p, Budget::EXACT, &mut stack).expect("answers");
            let name = format!("{} {p:?}", case.name);
            assert_side(case, p, truth, signed.side);
            if !matches!(by_tree.side, Side::Undecided(_)) {
                assert_eq!(signed.side, by_tree.side, "{name}");
            }
            assert!(holds(signed.closest.distance, truth), "{name}: {signed:?}");
            assert_eq!(signed.closest.triangle, by_tree.closest.triangle, "{name}");
            for (budget, ..) in tolerances(case.diagonal()) {
                let found = both.signed_bounds(p, budget, &mut stack).expect("answers");
                assert_side(case, p, truth, found.side);
                let Interval { lower, upper } = found.distance;
                assert!(lower <= upper, "{name}: {found:?}");
                let mirrored = Interval::new(-upper, -lower);
                let (outside, inside) = (holds(found.distance, truth), holds(mirrored, truth));
                match (found.side, is_inside(case, p, truth)) {
                    (Side::Inside, _) | (_, Some(true)) => assert!(inside, "{name}: {found:?}"),
                    (Side::Outside, _) | (_, Some(false)) => assert!(outside, "{name}: {found:?}"),
                    _ => assert!(outside || inside, "{name}: {found:?}"),
                }
                told += u32::from(found.work.opened == 0);
            }
        }
    }
    assert!(told > 300, "only {told} signed intervals were the field's");
}

#[test]
fn a_field_of_16_kib_decides_most_questions_of_a_part_alone() {
    let case = Case::new("bracket", bracket(), SdfKind::Signed, 16 << 10);
    let (both, mut rng) = (case.open(), Rng::new(4));
    let mut stack = stack(&both);
    for (part, least) in [(0.01, 0.7), (0.02, 0.75), (0.05, 0.8)] {
        let (mut alone, mut all) = (0, 0);
        for _ in 0..2000 {
            // Up to a tenth of the diagonal from the surface.
            let mut p = case.point(&mut rng, 0).map(f64::from);
            let (way, off) = (rng.direction(), 0.1 * case.diagonal() * rng.unit_f64());
            p.iter_mut().zip(way).for_each(|(x, way)| *x += off * f64::from(way));
            let d = (part * case.diagonal()) as f32;
            let answer = both.within(p.map(|x| x as f32), d, Budget::EXACT, &mut stack);
            alone += u32::from(answer.expect("answers").work.opened == 0);
            all += 1;
        }
        let share = f64::from(alone) / f64::from(all);
        println!("{part}: {share}");
        assert!(share >= least, "{part}: {share}");
    }
}

#[test]
fn what_the_tree_refuses_is_refused() {
    let case = Case::new("block", block([0.0; 3], [1.0; 3]), SdfKind::Signed, 800);
    let both = case.open();
    let (exact, p) = (Budget::EXACT, [3.0, 0.0, 0.0]);
    let mut full = stack(&both);
    for (point, distance, budget, entries, error) in [
        ([f32::NAN, 0.0, 0.0], 1.0, exact, 8, QueryError::NotFinite),
        (p, -1.0, exact, 8, QueryError::Tolerance),
        (p, f32::INFINITY, exact, 8, QueryError::Tolerance),
        (p, 1.0, exact.with_relative(f32::NAN), 8, QueryError::Tolerance),
        (p, 1.0, exact, 0, QueryError::NoScratch),
    ] {
        let stack = &mut full[..entries];
        assert_eq!(both.within(point, distance, budget, stack).err(), Some(error));
        let budget = budget.with_absolute(distance);
        assert_eq!(both.closest_point(point, budget, stack).err(), Some(error));
        assert_eq!(both.distance_bounds(point, budget, stack).err(), Some(error));
        assert_eq!(both.signed_bounds(point, budget, stack).err(), Some(error));
        if error != QueryError::Tolerance {
            assert_eq!(both.signed_distance(point, budget, stack).err(), Some(error));
        }
    }
}

#[test]
fn few_steps_never_make_a_wrong_answer_and_the_field_narrows_it() {
    let mut cut = 0;
    for case in cases() {
        let (both, mut rng) = (case.open(), Rng::new(5));
        let mut stack = stack(&both);
        for number in 0..POINTS {
            let p = case.point(&mut rng, number);
            let truth = case.truth(p);
            for (steps, entries) in [(0, 8), (1, 8), (2, 3)] {
                let budget = Budget::EXACT.with_relative(0.001).with_steps(steps);
                let stack = &mut stack[..entries];
                let found = both.distance_bounds(p, budget, stack).expect("answers");
                assert!(holds(found.distance, truth), "{} {p:?}: {found:?}", case.name);
                let alone = both.tree().closest_point(p, budget, stack).expect("answers");
                let width = |of: Interval| f64::from(of.upper) - f64::from(of.lower);
                let most = 1.001 * width(alone.distance) + 0.0011 * f64::from(found.distance.upper);
                assert!(width(found.distance) <= most, "{} {p:?} {found:?} {alone:?}", case.name);
                cut += u32::from(matches!(found.ended, Ended::Steps | Ended::Scratch));
            }
        }
    }
    assert!(cut > 300, "only {cut} searches were cut");
}
