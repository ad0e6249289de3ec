//! parry3d in the race.
#![no_std]
#![no_main]

#[path = "../carried.rs"]
mod carried;
#[path = "../heap.rs"]
mod heap;
#[path = "../parry.rs"]
mod parry;

use meshsweep_rival_firmware::race::{self, Engine};
use parry::Parry;
use parry3d::math::Vector;

struct Asked(Parry);

impl Engine for Asked {
    type Closest = [f32; 3];

    fn closest(&mut self, point: [f32; 3]) -> [f32; 3] {
        self.0.closest(point)
    }

    fn distance(point: [f32; 3], closest: &[f32; 3]) -> f32 {
        Vector::from_array(point).distance(Vector::from_array(*closest))
    }

    fn first_hit(&mut self, a: [f32; 3], b: [f32; 3]) -> Option<f32> {
        self.0.first_hit(a, b)
    }
}

#[cortex_m_rt::entry]
fn main() -> ! {
    // SAFETY: once, and nothing was allocated yet.
    unsafe { heap::begin() };
    race::run(&carried::QUESTIONS, heap::used, || {
        let built = Parry::new(carried::VERTICES.numbers(), carried::TRIANGLES.integers());
        Asked(built.expect("a mesh that parry3d takes"))
    })
}
