//! A glance never contradicts [`SegmentAndBox::is_clear`].

use super::{Glance, SegmentAndBox, integer, plain};
use crate::bvh::tree::format::Bvh;
use crate::geom::norm_1;
use crate::num::noise::Noise;
use crate::query::QueryError;

/// Coordinates that meet the box's planes, nearly, or leave f32's range.
fn place(noise: &mut Noise, low: [f32; 3], high: [f32; 3]) -> [f32; 3] {
    let kind = (noise.unit() * 50.0) as i32;
    core::array::from_fn(|axis| {
        let (middle, half) = (0.5 * (low[axis] + high[axis]), 0.5 * (high[axis] - low[axis]));
        let x = noise.unit();
        match kind {
            -49..=-40 => middle + half * x.signum() * (1.0 + 1e-4 * noise.unit()),
            -39..=-35 => middle + half * x * 1e3,
            49 => 1e30 * x,
            48 => f32::NAN,
            47 => f32::INFINITY * x.signum(),
            46 => 1e-40 * x,
            _ => middle + 2.0 * half * x,
        }
    })
}

#[test]
fn a_glance_that_is_sure_decides_as_the_whole_test() {
    let bytes = include_bytes!("../../../../fixtures/groove.msw");
    let tree = Bvh::open(bytes).expect("a tree");
    let [low, high] = tree.bounds();
    let mut noise = Noise(3);
    for error in [0.0, 0.03, 0.3] {
        let tree = tree.with_error(error).expect("a finite error");
        let surface_error = tree.units().surface_error;
        let mut counts = [[0u32; 3]; 2];
        for _ in 0..200_000 {
            let ends = [place(&mut noise, low, high), place(&mut noise, low, high)];
            let both = SegmentAndBox::new(&tree, ends);
            let expected: Result<bool, QueryError> = both.is_clear(ends, surface_error);
            if let Ok(is_clear) = expected {
                let size = norm_1(both.farthest(both.a)) + norm_1(both.farthest(both.b));
                assert_eq!(both.misses(surface_error, size), is_clear, "{ends:?}");
            }
            let glances = [plain::glance(&both, surface_error), integer::glance(&tree, ends)];
            for (glance, counts) in glances.into_iter().zip(&mut counts) {
                match glance {
                    Glance::Clear => assert_eq!(expected, Ok(true), "{ends:?}"),
                    Glance::Meets => assert_eq!(expected, Ok(false), "{ends:?}"),
                    Glance::Unsure => {}
                }
                counts[glance as usize] += 1;
            }
        }
        for [clear, meets, unsure] in counts {
            assert!(clear > 10_000 && meets > 10_000 && unsure < 60_000, "{counts:?}");
        }
    }
}
