//! A box tree with a distance field: the field is asked first.

use meshsweep_core::{BvhWithSdf, Solid};

use crate::answer::{BoundsC, ClosestC, HitC, SignedBoundsC, WithinC};
use crate::ask::questions;
use crate::memory::{In, Out, Storage, View};
use crate::sdf::SDF_WORDS;
use crate::tree::MODEL_WORDS;

/// Words of `msw_both`.
pub const BOTH_WORDS: usize = MODEL_WORDS + SDF_WORDS;

/// `msw_both`.
pub type BothStorage = Storage<BvhWithSdf<'static>, BOTH_WORDS>;

impl View for BvhWithSdf<'static> {
    const TAG: usize = 0x6d73_770e;
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_open_both(both: Out<BothStorage>, bytes: In<u8>, count: usize) -> i32 {
    both.open(|| Ok(BvhWithSdf::open(bytes.slice(count)?)?))
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_both_scratch_entries(both: In<BothStorage>) -> u32 {
    both.view().map_or(0, |both| both.tree().scratch_entries() as u32)
}

questions! {
    msw_both_within(both: In<BothStorage>, point: In<[f32; 3]>, distance: f32) -> WithinC {
        let (both, point) = (both.view()?, point.get()?);
        |budget, scratch| both.within(point, distance, budget, scratch)
    }
    msw_both_distance(both: In<BothStorage>, point: In<[f32; 3]>) -> BoundsC {
        let (both, point) = (both.view()?, point.get()?);
        |budget, scratch| both.distance_bounds(point, budget, scratch)
    }
    msw_both_signed_distance(both: In<BothStorage>, point: In<[f32; 3]>) -> SignedBoundsC {
        let (both, point) = (both.view()?, point.get()?);
        |budget, scratch| both.signed_bounds(point, budget, scratch)
    }
    msw_both_closest_point(both: In<BothStorage>, point: In<[f32; 3]>) -> ClosestC {
        let (both, point) = (both.view()?, point.get()?);
        |budget, scratch| both.closest_point(point, budget, scratch)
    }
    msw_both_solid_first_contact(
        both: In<BothStorage>, from: In<[f32; 3]>, to: In<[f32; 3]>, corner_count: usize,
        radius: f32
    ) -> HitC {
        let (both, from, to) = {
            let (both, [from, to]) = (both.view()?, [from, to].map(|at| at.slice(corner_count)));
            (both, Solid::new(from?, radius)?, Solid::new(to?, radius)?)
        };
        |budget, scratch| both.solid_first_contact(&from, &to, budget, scratch)
    }
}
