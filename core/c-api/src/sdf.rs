//! Distance fields.

use meshsweep_core::Sdf;

use crate::answer::{FieldC, FieldGradientC, UnitsC, VerdictC};
use crate::memory::{AnyBits, In, Out, Storage, View};

/// Words of `msw_sdf`.
pub const SDF_WORDS: usize = if cfg!(target_pointer_width = "64") { 18 } else { 28 };

/// `msw_sdf`.
pub type SdfStorage = Storage<Sdf<'static>, SDF_WORDS>;

impl View for Sdf<'static> {
    const TAG: usize = 0x6d73_770f;
}

// SAFETY: integers.
unsafe impl AnyBits for [i32; 3] {}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_open_sdf(field: Out<SdfStorage>, bytes: In<u8>, count: usize) -> i32 {
    field.open(|| Ok(Sdf::open(bytes.slice(count)?)?))
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_sdf_unit(field: In<SdfStorage>, unit: Out<f32>) -> i32 {
    unit.answer(|| Ok(field.view()?.unit()))
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_sdf_distance(
    field: In<SdfStorage>,
    point: In<[f32; 3]>,
    answer: Out<FieldC>,
) -> i32 {
    answer.answer(|| Ok(field.view()?.distance(point.get()?)?.into()))
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_sdf_distance_and_gradient(
    field: In<SdfStorage>,
    point: In<[f32; 3]>,
    answer: Out<FieldGradientC>,
) -> i32 {
    answer.answer(|| {
        let (found, gradient) = field.view()?.distance_and_gradient(point.get()?)?;
        Ok(FieldGradientC { found: found.into(), gradient })
    })
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_sdf_within(
    field: In<SdfStorage>,
    point: In<[f32; 3]>,
    distance: f32,
    answer: Out<VerdictC>,
) -> i32 {
    answer.answer(|| Ok(field.view()?.within(point.get()?, distance)?.into()))
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_sdf_units_of(
    field: In<SdfStorage>,
    point: In<[f32; 3]>,
    answer: Out<[i32; 3]>,
) -> i32 {
    answer.answer(|| Ok(field.view()?.units_of(point.get()?)?))
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_sdf_distance_in_units(
    field: In<SdfStorage>,
    place: In<[i32; 3]>,
    answer: Out<UnitsC>,
) -> i32 {
    answer.answer(|| Ok(field.view()?.distance_in_units(place.get()?)?.into()))
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_sdf_gradient_in_units(
    field: In<SdfStorage>,
    place: In<[i32; 3]>,
    answer: Out<[i32; 3]>,
) -> i32 {
    answer.answer(|| Ok(field.view()?.gradient_in_units(place.get()?)?))
}
