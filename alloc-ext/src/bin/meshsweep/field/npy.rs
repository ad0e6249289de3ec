//! The header of a NumPy file, version 1.0 (NEP 1: "A Simple File Format for NumPy Arrays").

/// Bytes that the data of a file begin at a multiple of.
const ALIGNMENT: usize = 64;

/// The header of an array of little-endian f32 in C order.
pub fn header(shape: &[usize]) -> Vec<u8> {
    // A tuple of one element has a comma too.
    let shape: String = shape.iter().map(|n| format!("{n}, ")).collect();
    let mut text =
        format!("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}), }}", shape.trim_end());
    let before = 10;
    let whole = (before + text.len() + 1).next_multiple_of(ALIGNMENT);
    text.extend(std::iter::repeat_n(' ', whole - before - text.len() - 1));
    text.push('\n');
    let mut out = b"\x93NUMPY\x01\x00".to_vec();
    out.extend((text.len() as u16).to_le_bytes());
    out.extend(text.as_bytes());
    out
}

#[cfg(test)]
mod tests {
    use super::header;

    #[test]
    fn the_header_is_whole_and_aligned() {
        for shape in [&[3, 4, 5][..], &[65_536, 65_536, 65_536, 2], &[7]] {
            let bytes = header(shape);
            assert_eq!(bytes.len() % 64, 0);
            assert_eq!(usize::from(u16::from_le_bytes([bytes[8], bytes[9]])), bytes.len() - 10);
            assert!(bytes.starts_with(b"\x93NUMPY\x01\x00") && bytes.ends_with(b"\n"));
        }
        let text = String::from_utf8_lossy(&header(&[3, 4, 5])[10..]).trim_end().to_owned();
        assert_eq!(text, "{'descr': '<f4', 'fortran_order': False, 'shape': (3, 4, 5,), }");
    }
}
