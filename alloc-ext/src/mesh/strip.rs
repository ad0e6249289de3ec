//! Triangle strips.

/// Adds the triangles of a strip, all in the winding of its first. Those with a repeated corner
/// only join strips: they are left out. Returns their number.
pub(super) fn strip(corners: &[u32], triangles: &mut Vec<[u32; 3]>) -> usize {
    let mut stitches = 0;
    for (i, window) in corners.windows(3).enumerate() {
        let &[a, b, c] = window else { continue };
        if a == b || b == c || c == a {
            stitches += 1;
        } else {
            triangles.push(if i % 2 == 0 { [a, b, c] } else { [a, c, b] });
        }
    }
    stitches
}
