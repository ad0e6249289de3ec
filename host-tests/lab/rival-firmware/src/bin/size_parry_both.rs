//! The size of an image that builds parry3d's mesh and asks for closest points and first hits.
#![no_std]
#![no_main]

#[path = "../bare.rs"]
mod bare;
#[path = "../heap.rs"]
mod heap;
#[path = "../parry.rs"]
mod parry;

use bare::Input;
use parry::Parry;

#[unsafe(no_mangle)]
extern "C" fn ask_begin(input: &Input<'_>, mesh: &mut Option<Parry>) {
    // SAFETY: as if this were the image's first call.
    unsafe { heap::begin() };
    *mesh = Parry::new(input.vertices.iter().copied(), input.triangles.iter().copied());
}

#[unsafe(no_mangle)]
extern "C" fn ask_closest(input: &Input<'_>, mesh: &Parry, closest: &mut [f32; 3]) {
    *closest = mesh.closest(input.a);
}

#[unsafe(no_mangle)]
extern "C" fn ask_first_hit(input: &Input<'_>, mesh: &Parry, parameter: &mut Option<f32>) {
    *parameter = mesh.first_hit(input.a, input.b);
}
