//! Triangles on the same three vertices.

use super::hash::FirstSeen;
use super::report::RepairReport;

/// Keeps the first triangle on each set of three vertices. The windings may differ.
///
/// Two opposite copies could be said to cancel: they enclose nothing. But they are surface, and
/// dropping both would turn a two-sided sheet into a hole in every answer. So one stays; where it
/// was an inner wall between two glued solids, a hull refuses the non-manifold edges that it
/// leaves, by name.
pub(super) fn drop_duplicates(
    positions: &[[f32; 3]],
    triangles: &mut Vec<[u32; 3]>,
    source: &mut Vec<u32>,
    report: &mut RepairReport,
) {
    let sorted = |t: [u32; 3]| {
        let mut s = t;
        s.sort_unstable();
        s
    };
    let mut table = FirstSeen::new(triangles.len());
    let keep: Vec<bool> = (0..triangles.len() as u32)
        .map(|t| {
            let first = table.insert(t, |t| sorted(triangles[t as usize]));
            if first == t {
                return true;
            }
            let (kept, copy) = (triangles[first as usize], triangles[t as usize]);
            let finding = if is_rotation(kept, copy) {
                &mut report.duplicate
            } else {
                &mut report.opposite_duplicate
            };
            finding.triangle(source[t as usize], positions[copy[0] as usize]);
            false
        })
        .collect();
    retain(triangles, &keep);
    retain(source, &keep);
}

/// Keeps the items whose flag is set.
pub(super) fn retain<T>(items: &mut Vec<T>, keep: &[bool]) {
    let mut flags = keep.iter();
    items.retain(|_| flags.next().copied().unwrap_or(true));
}

fn is_rotation(a: [u32; 3], b: [u32; 3]) -> bool {
    b == a || b == [a[1], a[2], a[0]] || b == [a[2], a[0], a[1]]
}
