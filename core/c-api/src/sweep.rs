//! Sweeps that are kept between calls: of a hull at rest, at key frames, or moved freely. Each has
//! functions of its own, so that a program links no more than the meshes that it has.

use meshsweep_core::{FrameHull, Hull, MovedHull, MovedVertex, ScratchEntry, Sweep};

use crate::answer::ClosestC;
use crate::deform::{DeformStorage, places};
use crate::error::code;
use crate::hull::HullStorage;
use crate::memory::{Begins, In, Kept, Out};
use crate::question::BudgetC;

/// Words of eight bytes of `msw_sweep`.
pub const SWEEP_WORDS: usize = 128;
/// Words of eight bytes of `msw_frame_sweep`.
pub const FRAME_SWEEP_WORDS: usize = 168;
/// Words of eight bytes of `msw_moved_sweep`.
pub const MOVED_SWEEP_WORDS: usize = 144;

/// `msw_sweep`.
pub type SweepStorage = Kept<Sweep<'static, Hull<'static>>, [u64; SWEEP_WORDS]>;
/// `msw_frame_sweep`.
pub type FrameSweepStorage = Kept<Sweep<'static, FrameHull<'static>>, [u64; FRAME_SWEEP_WORDS]>;
/// `msw_moved_sweep`.
pub type MovedSweepStorage =
    Kept<Sweep<'static, MovedHull<'static, 'static>>, [u64; MOVED_SWEEP_WORDS]>;

impl Begins for Sweep<'static, Hull<'static>> {
    const TAG: usize = 0x6d73_770b;
}

impl Begins for Sweep<'static, FrameHull<'static>> {
    const TAG: usize = 0x6d73_770c;
}

impl Begins for Sweep<'static, MovedHull<'static, 'static>> {
    const TAG: usize = 0x6d73_770d;
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_hull_sweep_entries(hull: In<HullStorage>) -> u32 {
    hull.view().map_or(0, |hull| hull.sweep_entries() as u32)
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_sweep_begin(
    sweep: Out<SweepStorage>,
    hull: In<HullStorage>,
    point: In<[f32; 3]>,
    scratch: Out<ScratchEntry>,
    scratch_count: usize,
) -> i32 {
    sweep.begin(|| Ok(hull.view()?.sweep(point.get()?, scratch.kept_slice(scratch_count)?)?))
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_frame_sweep_begin(
    sweep: Out<FrameSweepStorage>,
    deform: In<DeformStorage>,
    frame: f32,
    point: In<[f32; 3]>,
    scratch: Out<ScratchEntry>,
    scratch_count: usize,
) -> i32 {
    sweep.begin(|| {
        let hull = deform.view()?.at_frame(frame)?;
        Ok(hull.sweep(point.get()?, scratch.kept_slice(scratch_count)?)?)
    })
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_moved_sweep_begin(
    sweep: Out<MovedSweepStorage>,
    deform: In<DeformStorage>,
    records: Out<MovedVertex>,
    record_count: usize,
    point: In<[f32; 3]>,
    scratch: Out<ScratchEntry>,
    scratch_count: usize,
) -> i32 {
    sweep.begin(|| {
        let hull = deform.view()?.moved(records.kept_slice(record_count)?)?;
        Ok(hull.sweep(point.get()?, scratch.kept_slice(scratch_count)?)?)
    })
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_frame_sweep_to(mut sweep: Out<FrameSweepStorage>, frame: f32) -> i32 {
    code(|| Ok(sweep.begun()?.move_to_frame(frame)?))
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_moved_sweep_update(
    mut sweep: Out<MovedSweepStorage>,
    slack: f32,
    vertices: In<[f32; 3]>,
    vertex_count: usize,
) -> i32 {
    code(|| {
        let sweep = sweep.begun()?;
        let place = places(sweep.hull().deformable(), vertices, vertex_count)?;
        Ok(sweep.update_within(slack, place)?)
    })
}

/// What all sweeps answer, one kind a row.
macro_rules! sweeps {
    ($($storage:ident: $move_to:ident, $closest_point:ident, $next:ident;)*) => {$(
        /// See `meshsweep.h`.
        #[unsafe(no_mangle)]
        pub extern "C" fn $move_to(mut sweep: Out<$storage>, point: In<[f32; 3]>) -> i32 {
            code(|| Ok(sweep.begun()?.move_to(point.get()?)?))
        }

        /// See `meshsweep.h`.
        #[unsafe(no_mangle)]
        pub extern "C" fn $closest_point(
            mut sweep: Out<$storage>,
            budget: In<BudgetC>,
            answer: Out<ClosestC>,
        ) -> i32 {
            answer.answer(|| {
                let (sweep, budget) = (sweep.begun()?, budget.get_or(BudgetC::EXACT)?.budget());
                Ok(sweep.closest_point(budget)?.into())
            })
        }

        /// See `meshsweep.h`.
        #[unsafe(no_mangle)]
        pub extern "C" fn $next(
            mut sweep: Out<$storage>,
            budget: In<BudgetC>,
            answer: Out<ClosestC>,
        ) -> i32 {
            answer.answer(|| {
                let (sweep, budget) = (sweep.begun()?, budget.get_or(BudgetC::EXACT)?.budget());
                Ok(sweep.next_triangle(budget)?.map_or_else(ClosestC::none, ClosestC::from))
            })
        }
    )*};
}

sweeps! {
    SweepStorage: msw_sweep_move_to, msw_sweep_closest_point, msw_sweep_next;
    FrameSweepStorage:
        msw_frame_sweep_move_to, msw_frame_sweep_closest_point, msw_frame_sweep_next;
    MovedSweepStorage:
        msw_moved_sweep_move_to, msw_moved_sweep_closest_point, msw_moved_sweep_next;
}
