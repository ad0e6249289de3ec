//! Tight hulls.

use meshsweep_core::{TightHull, TightHulls};

use crate::answer::WithinC;
use crate::ask::questions;
use crate::error::Error;
use crate::memory::{In, Out, Storage, View};
use crate::tree::Model;

/// Words of `msw_tight`.
pub const TIGHT_WORDS: usize = if cfg!(target_pointer_width = "64") { 44 } else { 60 };

/// `msw_tight`.
pub type Tight = Storage<TightHull<'static>, TIGHT_WORDS>;

/// `MSW_FINEST`.
pub const FINEST: u32 = u32::MAX;

impl View for TightHull<'static> {
    const TAG: usize = 0x6d73_7702;
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_open_tight(hull: Out<Tight>, bytes: In<u8>, count: usize, index: u32) -> i32 {
    hull.open(|| {
        let hulls = TightHulls::open(bytes.slice(count)?)?;
        let hull = if index == FINEST { hulls.finest() } else { hulls.get(index) };
        hull.ok_or(Error::NoSuchHull)
    })
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_tight_scratch_entries(hull: In<Tight>) -> u32 {
    hull.view().map_or(0, |hull| hull.scratch_entries() as u32)
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_tight_model(model: Out<Model>, hull: In<Tight>) -> i32 {
    model.open(|| Ok(*hull.view()?.bvh()))
}

questions! {
    msw_tight_within(hull: In<Tight>, point: In<[f32; 3]>, distance: f32) -> WithinC {
        let (hull, point) = (hull.view()?, point.get()?);
        |budget, scratch| hull.within(point, distance, budget, scratch)
    }
}
