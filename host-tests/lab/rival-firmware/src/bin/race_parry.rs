//! parry3d in the race: its mesh built from vertices and triangles at start, all options at their
//! defaults.
//!
//! Without std its square roots are libm's, in software: more than a third of a closest point's
//! instructions.
#![no_std]
#![no_main]

#[path = "../carried.rs"]
mod carried;
#[path = "../heap.rs"]
mod heap;

use meshsweep_rival_firmware::race::{self, Engine};
use parry3d::math::Vector;
use parry3d::query::{PointQuery, Ray, RayCast};
use parry3d::shape::TriMesh;

struct Parry(TriMesh);

impl Engine for Parry {
    type Closest = [f32; 3];

    #[inline(never)]
    fn closest(&mut self, point: [f32; 3]) -> [f32; 3] {
        self.0.project_local_point(Vector::from_array(point), false).point.to_array()
    }

    fn distance(point: [f32; 3], closest: &[f32; 3]) -> f32 {
        Vector::from_array(point).distance(Vector::from_array(*closest))
    }

    #[inline(never)]
    fn first_hit(&mut self, a: [f32; 3], b: [f32; 3]) -> Option<f32> {
        let (a, b) = (Vector::from_array(a), Vector::from_array(b));
        self.0.cast_local_ray(&Ray::new(a, b - a), 1.0, false)
    }
}

#[cortex_m_rt::entry]
fn main() -> ! {
    // SAFETY: once, and nothing was allocated yet.
    unsafe { heap::begin() };
    race::run(&carried::QUESTIONS, heap::used, || {
        let vertices = carried::VERTICES.numbers().map(Vector::from_array).collect();
        let built = TriMesh::new(vertices, carried::TRIANGLES.integers().collect());
        Parry(built.expect("a mesh that parry3d takes"))
    })
}
