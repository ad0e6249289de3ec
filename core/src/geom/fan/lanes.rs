//! Lanes of the wide kernels.

/// Most triangles of a leaf, most children of a node, and lanes of the wide kernels.
pub const WIDTH: usize = 8;

/// For each count, all ones in the lanes below it. A table of bits: the compiler would turn a
/// comparison of lanes into branches.
pub const LANES_BELOW: [[u32; WIDTH]; WIDTH + 1] = {
    let mut table = [[0; WIDTH]; WIDTH + 1];
    let mut count = 0;
    while count <= WIDTH {
        let mut lane = 0;
        while lane < count {
            table[count][lane] = u32::MAX;
            lane += 1;
        }
        count += 1;
    }
    table
};
