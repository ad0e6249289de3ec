//! The box tree in the race.
#![no_std]
#![no_main]

#[path = "../carried.rs"]
mod carried;
#[path = "../tree.rs"]
mod tree;

use meshsweep_core::ClosestPoint;
use meshsweep_core::internal::num::sqrt_approx;
use meshsweep_rival_firmware::race::{self, Engine};
use tree::BoxTree;

struct Asked(BoxTree);

impl Engine for Asked {
    type Closest = Option<ClosestPoint>;

    fn memory(&self) -> usize {
        self.0.memory().expect("a stack that is long enough")
    }

    fn closest(&mut self, point: [f32; 3]) -> Option<ClosestPoint> {
        self.0.closest(point)
    }

    fn follow(&mut self, point: [f32; 3]) -> Option<ClosestPoint> {
        self.0.follow(point)
    }

    fn distance(point: [f32; 3], closest: &Option<ClosestPoint>) -> f32 {
        let Some(closest) = closest else { return f32::NAN };
        let [x, y, z]: [f32; 3] = core::array::from_fn(|axis| point[axis] - closest.point[axis]);
        sqrt_approx(x * x + y * y + z * z)
    }

    fn first_hit(&mut self, a: [f32; 3], b: [f32; 3]) -> Option<f32> {
        Some(self.0.first_hit(a, b)?.hit?.t)
    }
}

#[cortex_m_rt::entry]
fn main() -> ! {
    race::run(
        &carried::QUESTIONS,
        || (0, 0),
        || Asked(BoxTree::open(carried::TREE).expect("a blob with a tree")),
    )
}
