//! The functions of `meshsweep-c`, and a panic handler that none of them reaches.
#![no_std]

pub use meshsweep_c::*;

/// Calls a function that nobody defines. `cargo xtask dist` drops what no question reaches. If this
/// name is left, a question can panic.
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    unsafe extern "C" {
        fn meshsweep_core_panics_here() -> !;
    }
    // SAFETY: never linked, so never called.
    unsafe { meshsweep_core_panics_here() }
}

/// Can panic, and is dropped as no function of the header. It shows that a panic leaves the name.
#[unsafe(no_mangle)]
pub extern "C" fn can_panic(index: usize) -> u8 {
    [1, 2, 3][index]
}
