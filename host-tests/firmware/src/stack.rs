//! Stack depth by painting: fill what is below the stack pointer, run, look how far the paint is
//! gone.

use crate::board::stack_pointer;

const PAINT: u32 = 0xA5C3_5A3C;
/// Left alone below the stack pointer: the frames of `paint` and `lowest` themselves.
const MARGIN: usize = 64;

unsafe extern "C" {
    /// The end of the static data, from the runtime's linker script: the stack may grow down to
    /// here.
    static __ebss: u32;
}

fn bottom() -> *mut u32 {
    (&raw const __ebss).cast_mut()
}

/// Paints the free stack.
#[inline(never)]
pub fn paint() {
    let top = (stack_pointer() - MARGIN) as *mut u32;
    let mut word = bottom();
    while word < top {
        // SAFETY: between the static data and the stack pointer, where nothing lives.
        unsafe {
            word.write_volatile(PAINT);
            word = word.add(1);
        }
    }
}

/// The lowest word that was used since `paint`. Words within the margin, which are never painted,
/// count as used.
#[inline(never)]
pub fn lowest() -> usize {
    let top = (stack_pointer() - MARGIN) as *mut u32;
    let mut word = bottom();
    // SAFETY: only reads, and below the stack pointer.
    while word < top && unsafe { word.read_volatile() } == PAINT {
        // SAFETY: as above.
        word = unsafe { word.add(1) };
    }
    word as usize
}
