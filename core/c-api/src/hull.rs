//! The hull hierarchy: refined hulls.

use meshsweep_core::{Hull, HullFace};

use crate::answer::{FaceC, FacesC, RefinementC};
use crate::error::Error;
use crate::memory::{In, Out, RefinedEntry, Storage, View};
use crate::question::FocusC;

/// Words of `msw_hull`.
pub const HULL_WORDS: usize = if cfg!(target_pointer_width = "64") { 48 } else { 64 };

/// `msw_hull`.
pub type HullStorage = Storage<Hull<'static>, HULL_WORDS>;

impl View for Hull<'static> {
    const TAG: usize = 0x6d73_7703;
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_open_hull(hull: Out<HullStorage>, bytes: In<u8>, count: usize) -> i32 {
    hull.open(|| Ok(Hull::open(bytes.slice(count)?)?))
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_refine(
    hull: In<HullStorage>,
    mut refined: Out<RefinedEntry>,
    refined_count: usize,
    focus: In<FocusC>,
    error: f32,
    answer: Out<RefinementC>,
) -> i32 {
    answer.answer(|| {
        let (hull, focus) = (hull.view()?, focus.get_or(FocusC::EVERYWHERE)?.focus()?);
        let found = refined.refined(refined_count)?.update(hull, &focus, error, &mut [])?;
        Ok(RefinementC {
            is_complete: u32::from(found.error_left == 0.0),
            error_left: found.error_left,
            faces: found.faces,
            performed: found.performed,
            undone: found.undone,
        })
    })
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_refine_swept(
    hull: In<HullStorage>,
    mut refined: Out<RefinedEntry>,
    refined_count: usize,
    point: In<[f32; 3]>,
    distance: f32,
    answer: Out<RefinementC>,
) -> i32 {
    answer.answer(|| {
        let (hull, point) = (hull.view()?, point.get()?);
        let found = refined.refined(refined_count)?.sweep_to(hull, point, distance)?;
        Ok(RefinementC {
            is_complete: u32::from(found.error_left == 0.0),
            error_left: found.error_left,
            faces: found.faces,
            performed: found.splits,
            undone: 0,
        })
    })
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_refined_faces(
    hull: In<HullStorage>,
    mut refined: Out<RefinedEntry>,
    refined_count: usize,
    mut faces: Out<FaceC>,
    face_count: usize,
    answer: Out<FacesC>,
) -> i32 {
    answer.answer(|| {
        let (hull, refined) = (hull.view()?, refined.refined(refined_count)?);
        let (mut stored, mut dropped) = (0, 0);
        for HullFace { corners: [a, b, c], radius } in refined.faces(hull) {
            if stored == face_count {
                dropped += 1;
                continue;
            }
            let corner = |vertex| hull.vertex(vertex).ok_or(Error::Internal);
            let corners = [corner(a)?, corner(b)?, corner(c)?];
            // A power of two: the product is exact or rounds where it leaves f32's range.
            let error = (f64::from(radius) * hull.scale()) as f32;
            let error = if f64::from(error) < f64::from(radius) * hull.scale() {
                error.next_up()
            } else {
                error
            };
            faces.set(face_count, stored, FaceC { corners, error })?;
            stored += 1;
        }
        Ok(FacesC { stored: stored as u32, dropped })
    })
}
