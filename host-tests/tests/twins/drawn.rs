//! Questions about drawn points: on vertices, on edges, near and far, with budgets that end early,
//! with too little scratch, and from hints.

use super::{scenes, segment};
use meshsweep_host_tests::IS_RELEASE;
use meshsweep_host_tests::generate::Rng;
use meshsweep_host_tests::scene::Scene;

/// A question, the same for each core.
struct Drawn {
    point: [f32; 3],
    segment: [[f32; 3]; 2],
    distance: f32,
    relative: f32,
    absolute: f32,
    steps: u32,
    /// Entries of scratch that are kept from the question.
    missing: usize,
}

impl Drawn {
    fn of(scene: &Scene, count: usize, seed: u64) -> Vec<Self> {
        let rng = &mut Rng::new(seed);
        let points: Vec<_> = scene.points(count, rng).collect();
        let pairs = points.iter().zip(points.iter().cycle().skip(5));
        let size = scene.size();
        pairs.map(|(&point, &other)| Self::at(point, other, size, rng)).collect()
    }

    fn at(point: [f32; 3], other: [f32; 3], size: f32, rng: &mut Rng) -> Self {
        Self {
            point,
            segment: segment(point, other, rng),
            distance: size * [0.0, 1e-6, 1e-3, 0.1, 1.0][rng.below(5)],
            relative: [0.0, 0.0, 0.0, 0.01, 0.5][rng.below(5)],
            absolute: [0.0, 0.0, 0.0, size * 1e-3][rng.below(4)],
            steps: [u32::MAX, u32::MAX, u32::MAX, 1, 3, 17][rng.below(6)],
            missing: [0, 0, 0, 1, 3][rng.below(5)],
        }
    }
}

/// The answers of one core, each as text that holds the bits of intervals, points, triangles and
/// verdicts, and the nodes that closest points opened. Kernels that take eight at once open them in
/// another order, so those are not compared.
macro_rules! answers_of {
    ($name:ident, $core:ident) => {
        fn $name(bytes: &[u8], drawn: &[Drawn]) -> (Vec<[String; 7]>, u64) {
            use $core::{Budget, Bvh, Facing, Hint, Neighbor, ScratchEntry};
            let tree = Bvh::open(bytes).expect("opens");
            let mut hint = Hint::NONE;
            let mut opened = 0;
            let mut ask = |question: &Drawn| {
                let Drawn { point, segment: [a, b], distance, .. } = *question;
                let budget = Budget::EXACT
                    .with_relative(question.relative)
                    .with_absolute(question.absolute)
                    .with_steps(question.steps);
                let entries = tree.scratch_entries_for(budget).saturating_sub(question.missing);
                let stack = &mut vec![ScratchEntry::EMPTY; entries][..];
                let mut closest = |answer: Result<$core::ClosestPoint, _>| match answer {
                    Ok(it) => {
                        opened += u64::from(it.work.opened) + u64::from(it.work.triangles);
                        format!("{:?}", (it.distance, it.point, it.triangle, it.ended))
                    }
                    Err(error) => format!("{error:?}"),
                };
                let mut near = [Neighbor::EMPTY; 3];
                [
                    closest(tree.closest_point(point, budget, stack)),
                    closest(tree.closest_point_from(point, &mut hint, budget, stack)),
                    match tree.within(point, distance, budget, stack) {
                        Ok(it) => format!("{:?}", it.verdict),
                        Err(error) => format!("{error:?}"),
                    },
                    match tree.nearest(point, &mut near, budget, stack) {
                        Ok(it) => format!("{:?}", (it.stored, it.rest_lower, it.ended, near)),
                        Err(error) => format!("{error:?}"),
                    },
                    match tree.signed_distance(point, budget, stack) {
                        Ok(it) => format!("{:?}", (it.distance, it.side, it.closest.triangle)),
                        Err(error) => format!("{error:?}"),
                    },
                    match tree.first_hit(a, b, Facing::Both, budget, stack) {
                        Ok(it) => format!("{:?}", (it.t, it.hit, it.ended)),
                        Err(error) => format!("{error:?}"),
                    },
                    match tree.any_hit(a, b, Facing::Front, budget, stack) {
                        Ok(it) => format!("{:?}", it.verdict),
                        Err(error) => format!("{error:?}"),
                    },
                ]
            };
            let answers = drawn.iter().map(&mut ask).collect();
            (answers, opened)
        }
    };
}

answers_of!(of_this_machine, meshsweep_core);
answers_of!(of_m0, meshsweep_core_m0);
answers_of!(of_m4f, meshsweep_core_m4f);

#[test]
fn drawn_questions_have_the_same_answers_on_boards() {
    let count = if IS_RELEASE { 20_000 } else { 240 };
    let mut work = [0; 3];
    for (index, scene) in scenes().iter().enumerate() {
        let drawn = Drawn::of(scene, count, 0xb0a2 + index as u64);
        for bytes in [&scene.bytes, &scene.f32_bytes] {
            let (here, of_here) = of_this_machine(bytes, &drawn);
            let (m0, of_m0) = of_m0(bytes, &drawn);
            let (m4f, of_m4f) = of_m4f(bytes, &drawn);
            assert_equal(&format!("{} on m0", scene.name), &here, &m0, &drawn);
            assert_equal(&format!("{} on m4f", scene.name), &here, &m4f, &drawn);
            for (sum, one) in work.iter_mut().zip([of_here, of_m0, of_m4f]) {
                *sum += one;
            }
        }
    }
    let [here, m0, m4f] = work;
    assert!(here != m0 && here != m4f, "one core three times: {work:?}");
}

fn assert_equal(name: &str, here: &[[String; 7]], there: &[[String; 7]], drawn: &[Drawn]) {
    for ((here, there), question) in here.iter().zip(there).zip(drawn) {
        assert_eq!(
            here,
            there,
            "{name}: {:?}, segment {:?}, budget {:?}, {} entries missing",
            question.point,
            question.segment,
            (question.relative, question.absolute, question.steps),
            question.missing,
        );
    }
}
