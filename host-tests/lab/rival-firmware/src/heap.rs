//! A heap that counts, in the board's external RAM. The linker places nothing there: static data
//! and stack stay in what such parts have on chip, and a mesh of any size fits.

use core::alloc::{GlobalAlloc, Layout};
use core::cell::UnsafeCell;
use core::ptr::{NonNull, null_mut};

/// mps2-an386: 16 MiB.
const START: usize = 0x2100_0000;
const BYTES: usize = 16 << 20;

#[global_allocator]
static HEAP: Counting =
    Counting(UnsafeCell::new(State { heap: linked_list_allocator::Heap::empty(), most: 0 }));

struct Counting(UnsafeCell<State>);

struct State {
    heap: linked_list_allocator::Heap,
    most: usize,
}

// SAFETY: one core, no interrupt handler touches it.
unsafe impl Sync for Counting {}

// SAFETY: the heap inside keeps the contract; the state is borrowed for the length of a call only.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: no other borrow lives, see `Sync`.
        let state = unsafe { &mut *self.0.get() };
        let block = state.heap.allocate_first_fit(layout);
        state.most = state.most.max(state.heap.used());
        block.map_or(null_mut(), NonNull::as_ptr)
    }

    unsafe fn dealloc(&self, block: *mut u8, layout: Layout) {
        if let Some(block) = NonNull::new(block) {
            // SAFETY: no other borrow lives, see `Sync`; block and layout are those of `alloc`, as
            // the caller promises.
            unsafe { (*self.0.get()).heap.deallocate(block, layout) }
        }
    }
}

/// Makes the heap usable.
///
/// # Safety
/// To be called once, before the first allocation.
pub unsafe fn begin() {
    // SAFETY: memory that nothing else uses; and see `Sync`.
    unsafe { (*HEAP.0.get()).heap.init(START as *mut u8, BYTES) }
}

/// Bytes in use, and the most since the last call: blocks as the allocator rounds them.
pub fn used() -> (usize, usize) {
    // SAFETY: see `Sync`.
    let state = unsafe { &mut *HEAP.0.get() };
    let used = state.heap.used();
    (used, core::mem::replace(&mut state.most, used))
}
