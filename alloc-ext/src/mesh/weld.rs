//! Welding: vertices at exactly the same position become one.

use super::hash::FirstSeen;
use super::report::Finding;

/// For each vertex the first one at its position. `positions` must be free of −0.0 (see
/// [`round`](super::round)).
pub(super) fn weld(positions: &[[f32; 3]], welded: &mut Finding) -> Vec<u32> {
    let mut table = FirstSeen::new(positions.len());
    let key = |v: u32| positions[v as usize].map(f32::to_bits);
    (0..positions.len() as u32)
        .map(|v| {
            let first = table.insert(v, key);
            if first != v {
                welded.vertex(v, positions[v as usize]);
            }
            first
        })
        .collect()
}
