//! Hull hierarchies that deform: at key frames, and by any motion of their vertices.

use meshsweep_core::{DeformableHull, MovedHull, MovedVertex};

use crate::answer::{ClosestC, HitC};
use crate::ask::questions;
use crate::error::{Error, code};
use crate::hull::HullStorage;
use crate::memory::{Begins, In, Kept, Out, Storage, View};

/// Words of `msw_deform`.
pub const DEFORM_WORDS: usize = if cfg!(target_pointer_width = "64") { 56 } else { 72 };

/// `msw_deform`.
pub type DeformStorage = Storage<DeformableHull<'static>, DEFORM_WORDS>;

impl View for DeformableHull<'static> {
    const TAG: usize = 0x6d73_7709;
}

/// Words of eight bytes of `msw_moved`.
pub const MOVED_WORDS: usize = 72;

/// `msw_moved`.
pub type MovedStorage = Kept<MovedHull<'static, 'static>, [u64; MOVED_WORDS]>;

impl Begins for MovedHull<'static, 'static> {
    const TAG: usize = 0x6d73_770a;
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_open_deform(deform: Out<DeformStorage>, bytes: In<u8>, count: usize) -> i32 {
    deform.open(|| Ok(DeformableHull::open(bytes.slice(count)?)?))
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_deform_hull(hull: Out<HullStorage>, deform: In<DeformStorage>) -> i32 {
    hull.open(|| Ok(deform.view()?.rest()))
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_deform_scratch_entries(deform: In<DeformStorage>) -> u32 {
    deform.view().map_or(0, |deform| deform.scratch_entries() as u32)
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_deform_frames(deform: In<DeformStorage>) -> u32 {
    deform.view().map_or(0, |deform| deform.frames())
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_deform_vertices(deform: In<DeformStorage>) -> u32 {
    deform.view().map_or(0, |deform| deform.input_vertices())
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_deform_records(deform: In<DeformStorage>) -> u32 {
    deform.view().map_or(0, |deform| deform.vertex_records() as u32)
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_moved_begin(
    moved: Out<MovedStorage>,
    deform: In<DeformStorage>,
    records: Out<MovedVertex>,
    record_count: usize,
) -> i32 {
    moved.begin(|| Ok(deform.view()?.moved(records.kept_slice(record_count)?)?))
}

/// The place of each vertex of the input file, of which there have to be enough.
pub(crate) fn places(
    hull: &DeformableHull<'_>,
    places: In<[f32; 3]>,
    count: usize,
) -> Result<impl Fn(u32) -> [f32; 3] + use<>, Error> {
    let places = places.slice(count)?;
    if count < hull.input_vertices() as usize {
        return Err(Error::Count);
    }
    // A number is less than the count, by the check of opening.
    Ok(move |vertex| places.get(vertex as usize).copied().unwrap_or([f32::NAN; 3]))
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_moved_update(
    mut moved: Out<MovedStorage>,
    slack: f32,
    vertices: In<[f32; 3]>,
    vertex_count: usize,
) -> i32 {
    code(|| {
        let moved = moved.begun()?;
        let place = places(moved.deformable(), vertices, vertex_count)?;
        Ok(moved.update_within(slack, place)?)
    })
}

questions! {
    msw_frame_closest_point(
        deform: In<DeformStorage>, frame: f32, point: In<[f32; 3]>
    ) -> ClosestC {
        let (hull, point) = (deform.view()?.at_frame(frame)?, point.get()?);
        |budget, scratch| hull.closest_point(point, budget, scratch)
    }
    msw_frame_first_hit(
        deform: In<DeformStorage>, frame: f32, a: In<[f32; 3]>, b: In<[f32; 3]>
    ) -> HitC {
        let (hull, a, b) = (deform.view()?.at_frame(frame)?, a.get()?, b.get()?);
        |budget, scratch| hull.first_hit(a, b, budget, scratch)
    }
    msw_moved_closest_point(moved: Out<MovedStorage>, point: In<[f32; 3]>) -> ClosestC {
        let (hull, point) = (moved.begun()?, point.get()?);
        |budget, scratch| hull.closest_point(point, budget, scratch)
    }
    msw_moved_first_hit(
        moved: Out<MovedStorage>, a: In<[f32; 3]>, b: In<[f32; 3]>
    ) -> HitC {
        let (hull, a, b) = (moved.begun()?, a.get()?, b.get()?);
        |budget, scratch| hull.first_hit(a, b, budget, scratch)
    }
}
