//! The box tree in the race: the blob read where it lies, a stack that the caller owns.
#![no_std]
#![no_main]

#[path = "../carried.rs"]
mod carried;

use meshsweep_core::internal::num::sqrt_approx;
use meshsweep_core::{Budget, Bvh, ClosestPoint, CoherentQuery, Facing, ScratchEntry};
use meshsweep_rival_firmware::race::{self, Engine};

/// Entries of the stack: what trees of so many triangles ask for, and some more.
const STACK: usize = 64;

/// Nodes of the coherent query's front.
const FRONT: usize = 64;

struct BoxTree {
    tree: Bvh<'static>,
    stack: [ScratchEntry; STACK],
    coherent: CoherentQuery<'static, FRONT>,
}

impl BoxTree {
    #[inline(never)]
    fn open(blob: &'static [u8]) -> Self {
        Self {
            tree: Bvh::open(blob).expect("a blob with a tree"),
            stack: [ScratchEntry::EMPTY; STACK],
            coherent: CoherentQuery::new(),
        }
    }
}

impl Engine for BoxTree {
    type Closest = Option<ClosestPoint>;

    fn memory(&self) -> usize {
        let entries = self.tree.scratch_entries();
        assert!(entries <= STACK, "a stack that is too short");
        size_of::<Bvh<'_>>() + entries * size_of::<ScratchEntry>()
    }

    #[inline(never)]
    fn closest(&mut self, point: [f32; 3]) -> Option<ClosestPoint> {
        self.tree.closest_point(point, Budget::EXACT, &mut self.stack).ok()
    }

    #[inline(never)]
    fn follow(&mut self, point: [f32; 3]) -> Option<ClosestPoint> {
        let Self { tree, stack, coherent } = self;
        Some(coherent.closest_point(tree, point, Budget::EXACT, stack).ok()?.closest)
    }

    fn distance(point: [f32; 3], closest: &Option<ClosestPoint>) -> f32 {
        let Some(closest) = closest else { return f32::NAN };
        let [x, y, z]: [f32; 3] = core::array::from_fn(|axis| point[axis] - closest.point[axis]);
        sqrt_approx(x * x + y * y + z * z)
    }

    #[inline(never)]
    fn first_hit(&mut self, a: [f32; 3], b: [f32; 3]) -> Option<f32> {
        let found = self.tree.first_hit(a, b, Facing::Both, Budget::EXACT, &mut self.stack);
        Some(found.ok()?.hit?.t)
    }
}

#[cortex_m_rt::entry]
fn main() -> ! {
    race::run(&carried::QUESTIONS, || (0, 0), || BoxTree::open(carried::TREE))
}
