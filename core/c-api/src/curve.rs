//! Curves: fences and tool paths.

use meshsweep_core::{AllWithin, Curve, CurveNeighbor, KNearest, ScratchEntry};

use crate::answer::{
    AllWithinC, CurveClosestC, CurveNeighborC, CurveSignedC, CurveWithinC, NearestC,
};
use crate::ask::{ask, questions};
use crate::error::Error;
use crate::memory::{In, Out, Storage, View};
use crate::question::BudgetC;

/// Words of `msw_curve`.
pub const CURVE_WORDS: usize = if cfg!(target_pointer_width = "64") { 24 } else { 40 };

/// Curves with the alignment of C's words: they hold f64.
#[derive(Clone, Copy)]
#[repr(C, packed(4))]
pub struct CurveView(Curve<'static>);

impl CurveView {
    fn curve(&self) -> Curve<'static> {
        self.0
    }
}

impl core::fmt::Debug for CurveView {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        self.curve().fmt(f)
    }
}

/// `msw_curve`.
pub type CurveStorage = Storage<CurveView, CURVE_WORDS>;

impl View for CurveView {
    const TAG: usize = 0x6d73_7708;
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_open_curve(curve: Out<CurveStorage>, bytes: In<u8>, count: usize) -> i32 {
    curve.open(|| Ok(CurveView(Curve::open(bytes.slice(count)?)?)))
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_curve_scratch_entries(curve: In<CurveStorage>) -> u32 {
    curve.view().map_or(0, |view| view.curve().scratch_entries() as u32)
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_curve_check_fence(curve: In<CurveStorage>) -> i32 {
    let checked = curve.view().and_then(|view| view.curve().check_fence().map_err(Error::from));
    checked.map_or_else(Error::code, |()| 0)
}

questions! {
    msw_curve_closest_point(curve: In<CurveStorage>, point: In<[f32; 3]>) -> CurveClosestC {
        let (curve, point) = (curve.view()?.curve(), point.get()?);
        |budget, scratch| curve.closest_point(point, budget, scratch)
    }
    msw_curve_within(curve: In<CurveStorage>, point: In<[f32; 3]>, distance: f32) -> CurveWithinC {
        let (curve, point) = (curve.view()?.curve(), point.get()?);
        |budget, scratch| curve.within(point, distance, budget, scratch)
    }
    msw_curve_signed_distance(curve: In<CurveStorage>, point: In<[f32; 2]>) -> CurveSignedC {
        let (curve, point) = (curve.view()?.curve(), point.get()?);
        |budget, scratch| curve.signed_distance(point, budget, scratch)
    }
}

/// Asks a question that lists segments. The search keeps its segments where the answers will be.
fn listed<T>(
    mut neighbors: Out<CurveNeighborC>,
    neighbor_count: usize,
    stored: impl FnOnce(&T) -> usize,
    question: impl FnOnce(&mut [CurveNeighbor]) -> Result<T, Error>,
) -> Result<T, Error> {
    let mut held = neighbors.held::<CurveNeighbor>();
    let found = question(held.slice(neighbor_count)?)?;
    for index in 0..stored(&found) {
        let near = held.slice(neighbor_count)?.get(index).copied();
        neighbors.set(neighbor_count, index, near.ok_or(Error::Internal)?.into())?;
    }
    Ok(found)
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_curve_nearest(
    curve: In<CurveStorage>,
    point: In<[f32; 3]>,
    neighbors: Out<CurveNeighborC>,
    neighbor_count: usize,
    budget: In<BudgetC>,
    scratch: Out<ScratchEntry>,
    scratch_count: usize,
    answer: Out<NearestC>,
) -> i32 {
    answer.answer(|| {
        let (curve, point) = (curve.view()?.curve(), point.get()?);
        let found = ask(budget, scratch, scratch_count, |budget, scratch| {
            listed(
                neighbors,
                neighbor_count,
                |found: &KNearest| found.stored,
                |out| Ok(curve.nearest(point, out, budget, scratch)?),
            )
        })?;
        Ok(found.into())
    })
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_curve_all_within(
    curve: In<CurveStorage>,
    point: In<[f32; 3]>,
    distance: f32,
    neighbors: Out<CurveNeighborC>,
    neighbor_count: usize,
    budget: In<BudgetC>,
    scratch: Out<ScratchEntry>,
    scratch_count: usize,
    answer: Out<AllWithinC>,
) -> i32 {
    answer.answer(|| {
        let (curve, point) = (curve.view()?.curve(), point.get()?);
        let found = ask(budget, scratch, scratch_count, |budget, scratch| {
            listed(
                neighbors,
                neighbor_count,
                |found: &AllWithin| found.stored,
                |out| Ok(curve.all_within(point, distance, out, budget, scratch)?),
            )
        })?;
        Ok(found.into())
    })
}
