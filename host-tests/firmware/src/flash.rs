//! What the host put into flash behind the image.

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
    // SAFETY: flash, which nothing writes. The host checks that the image ends before the blob.
    unsafe {
        let length = (told as *const u32).read_volatile() as usize;
        let begin = told - length.next_multiple_of(ALIGN);
        core::slice::from_raw_parts(begin as *const u8, length)
    }
}
