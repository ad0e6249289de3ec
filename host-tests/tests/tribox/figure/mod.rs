//! The boundary counts what it does; loops close; triboxes keep their words on small integers,
//! where everything is exact.

mod boundary;
mod bounds;
mod counted;
mod measures;
mod points;

use meshsweep_core::internal::tribox::DIRECTIONS;

fn along(slab: usize, [x, y, z]: [f32; 3]) -> f32 {
    let [a, b, c] = DIRECTIONS[slab].map(f32::from);
    a * x + b * y + c * z
}
