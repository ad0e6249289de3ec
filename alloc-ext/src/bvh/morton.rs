//! Points along a Morton curve: neighbours in that order are near in space.

/// Cells along an axis of the box of all points, as a power of two. Finer cells cost a pass of
/// sorting and gain nothing.
const CELL_BITS: u32 = 8;

/// Indices of the points, all finite, along a Morton curve through their box.
pub(super) fn morton_order(points: &[[f32; 3]]) -> Vec<u32> {
    let (mut low, mut high) = ([f32::MAX; 3], [f32::MIN; 3]);
    for point in points {
        for k in 0..3 {
            (low[k], high[k]) = (low[k].min(point[k]), high[k].max(point[k]));
        }
    }
    // Both are halved, because their difference may leave f32's range. If the extent is 0 or tiny,
    // there is one cell.
    let cells: [f32; 3] = std::array::from_fn(|k| {
        let scale = (1u32 << CELL_BITS) as f32 / (high[k] * 0.5 - low[k] * 0.5);
        if scale < f32::MAX { scale } else { 0.0 }
    });
    let code = |point: &[f32; 3]| {
        (0..3).fold(0, |code, k| {
            // A cast saturates.
            let cell = ((point[k] * 0.5 - low[k] * 0.5) * cells[k]) as u32;
            code | spread(cell.min((1 << CELL_BITS) - 1)) << k
        })
    };
    let mut from: Vec<(u32, u32)> = points.iter().map(code).zip(0..).collect();
    let mut to = from.clone();
    // By the three bytes of the code, least significant first.
    for pass in 0..3 {
        let digit = |code: u32| usize::from((code >> (8 * pass)) as u8);
        let mut place = [0; 256];
        for &(code, _) in &from {
            place[digit(code)] += 1;
        }
        let mut before = 0;
        for count in &mut place {
            (*count, before) = (before, before + *count);
        }
        for &entry in &from {
            let next = &mut place[digit(entry.0)];
            to[*next] = entry;
            *next += 1;
        }
        std::mem::swap(&mut from, &mut to);
    }
    from.into_iter().map(|(_, index)| index).collect()
}

/// Bits of a number below 2^8, two zeros before each.
fn spread(x: u32) -> u32 {
    let x = (x | x << 8) & 0x0000_F00F;
    let x = (x | x << 4) & 0x000C_30C3;
    (x | x << 2) & 0x0024_9249
}
