//! Triangle numbers in the input file, packed in blocks of 64 neighbouring triangles. A block has
//! its least number and just enough bits for the differences. Files give neighbours similar
//! numbers, so this takes half the bytes of plain numbers.

use meshsweep_core::internal::bvh::tree::format::layout::{
    SOURCE_BLOCK, SOURCE_ENTRY_BYTES, SOURCE_PADDING,
};

/// The section's bytes.
pub(super) fn pack(numbers: &[u32]) -> Vec<u8> {
    let blocks = numbers.len().div_ceil(SOURCE_BLOCK);
    let mut directory = Vec::with_capacity(blocks * SOURCE_ENTRY_BYTES);
    let mut data = Vec::new();
    for block in numbers.chunks(SOURCE_BLOCK) {
        let least = block.iter().copied().min().unwrap_or(0);
        let span = block.iter().copied().max().unwrap_or(0) - least;
        let width = 32 - span.leading_zeros();
        let start = blocks * SOURCE_ENTRY_BYTES + data.len();
        directory.extend(least.to_le_bytes());
        directory.extend(((start as u32) << 5 | width).to_le_bytes());
        let (mut bits, mut held) = (0u64, 0u32);
        for &number in block {
            bits |= u64::from(number - least) << held;
            held += width;
            while held >= 8 {
                data.push(bits as u8);
                bits >>= 8;
                held -= 8;
            }
        }
        if held > 0 {
            data.push(bits as u8);
        }
    }
    directory.extend(data);
    directory.extend([0; SOURCE_PADDING]);
    directory
}
