//! What the host put into flash behind the image.

use meshsweep_suite::Plan;

unsafe extern "C" {
    /// The address behind the flash, from the memory layout.
    static meshsweep_flash_end: u8;
}

/// Blobs start at a multiple of it, as a linker script would align a section for one.
const ALIGN: usize = 16;

/// The blob, where the core reads it in place. The last 16 bytes of flash begin with its length; it
/// ends before them, but for the padding that aligns it.
///
/// The image does not carry it, so one image is asked about many blobs, and the compiler knows
/// nothing of their bytes.
#[must_use]
pub fn blob() -> &'static [u8] {
    let told = (&raw const meshsweep_flash_end) as usize - ALIGN;
    let length = told_word(0) as usize;
    let begin = told - length.next_multiple_of(ALIGN);
    // SAFETY: flash, which nothing writes. The host checks that the image ends before the blob.
    unsafe { core::slice::from_raw_parts(begin as *const u8, length) }
}

/// How much the host wants asked: behind the blob's length lie the blocks of tabled kinds, and
/// those of each other kind.
#[must_use]
pub fn plan() -> Plan {
    Plan { tabled_blocks: told_word(1), blocks: told_word(2), ..Plan::STANDARD }
}

/// One of the four words that end the flash.
fn told_word(index: usize) -> u32 {
    let words = (&raw const meshsweep_flash_end) as usize - ALIGN;
    // SAFETY: flash, which nothing writes; there are four words.
    unsafe { (words as *const u32).add(index).read_volatile() }
}
