//! What the images without a runtime share: the panic handler that cannot be linked, and opaque
//! inputs.

use core::panic::PanicInfo;

/// Calls a function that nobody defines: an image links only if the optimiser removed every way to
/// get here.
#[cfg(not(feature = "name_panics"))]
#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    unsafe extern "C" {
        fn meshsweep_core_panics_here() -> !;
    }
    // SAFETY: never linked, so never called.
    unsafe { meshsweep_core_panics_here() }
}

/// Keeps the place of each panic in the image.
#[cfg(feature = "name_panics")]
#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    core::hint::black_box(info.location());
    loop {}
}

/// The image's entry in name, and all there is of the empty image.
#[unsafe(no_mangle)]
pub extern "C" fn ask_nothing() {}

/// What a caller hands over. Reached through a pointer from outside of the image, so the optimiser
/// knows nothing of it.
#[repr(C)]
#[allow(dead_code, reason = "each image asks its own questions")]
pub struct Input<'a> {
    /// The blob.
    pub blob: &'a [u8],
    /// A query point, or a segment's first end.
    pub a: [f32; 3],
    /// A segment's second end.
    pub b: [f32; 3],
    /// Any number.
    pub any: usize,
}

/// Functions that open a structure and ask it one question each. `|opened, input, scratch, fold|`
/// names what the question is made of.
#[allow(unused_macros, reason = "the empty image asks nothing")]
macro_rules! ask {
    ($($name:ident: $subject:ty,
        |$opened:ident, $input:ident, $scratch:ident, $fold:ident| $question:expr;)*) => {$(
        #[unsafe(no_mangle)]
        extern "C" fn $name<'t>(
            $input: &bare::Input<'t>,
            $scratch: &mut <$subject as meshsweep_suite::Subject<'t>>::Scratch,
            $fold: &mut meshsweep_suite::fold::Fold,
        ) {
            if let Ok(opened) = <$subject as meshsweep_suite::Subject<'t>>::open($input.blob) {
                let $opened = &opened;
                $question;
            }
        }
    )*};
}

/// Functions that ask one question each of a box tree that is already open, as `part.rs` has it.
#[allow(unused_macros, reason = "most images open what they ask")]
macro_rules! ask_opened {
    ($($name:ident:
        |$tree:ident, $input:ident, $scratch:ident, $fold:ident| $question:expr;)*) => {$(
        #[unsafe(no_mangle)]
        extern "C" fn $name(
            $tree: &meshsweep_suite::ask::tree::Bvh<'_>,
            $input: &bare::Input<'_>,
            $scratch: &mut meshsweep_suite::ask::tree::Scratch<'_>,
            $fold: &mut meshsweep_suite::fold::Fold,
        ) {
            $question;
        }
    )*};
}
