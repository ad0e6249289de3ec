//! Compaction: a surface without the vertices that no triangle has.

/// Vertices in the order in which the triangles name them first.
pub(crate) fn compact<P: Copy>(
    positions: &[P],
    triangles: impl IntoIterator<Item = [u32; 3]>,
) -> (Vec<P>, Vec<[u32; 3]>) {
    let mut number = vec![u32::MAX; positions.len()];
    let mut kept = Vec::new();
    let triangles = triangles.into_iter().map(|corners| {
        corners.map(|v| {
            let number = &mut number[v as usize];
            if *number == u32::MAX {
                *number = kept.len() as u32;
                kept.push(positions[v as usize]);
            }
            *number
        })
    });
    let triangles = triangles.collect();
    (kept, triangles)
}

/// As [`compact`], with the vertices in the order that they had.
pub(crate) fn compact_in_order<P: Copy>(
    positions: &[P],
    triangles: impl IntoIterator<Item = [u32; 3]>,
) -> (Vec<P>, Vec<[u32; 3]>) {
    let mut triangles: Vec<[u32; 3]> = triangles.into_iter().collect();
    let mut number = vec![u32::MAX; positions.len()];
    triangles.iter().flatten().for_each(|&v| number[v as usize] = 0);
    let mut kept = Vec::new();
    for (number, &position) in number.iter_mut().zip(positions) {
        if *number == 0 {
            *number = kept.len() as u32;
            kept.push(position);
        }
    }
    triangles.iter_mut().flatten().for_each(|v| *v = number[*v as usize]);
    (kept, triangles)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unused_vertices_leave_and_the_rest_keeps_its_order_or_takes_that_of_the_triangles() {
        let triangles = [[5, 1, 3], [3, 1, 4]];
        let positions = ['a', 'b', 'c', 'd', 'e', 'f'];
        let by_use = (vec!['f', 'b', 'd', 'e'], vec![[0, 1, 2], [2, 1, 3]]);
        assert_eq!(compact(&positions, triangles), by_use);
        let in_order = (vec!['b', 'd', 'e', 'f'], vec![[3, 0, 1], [1, 0, 2]]);
        assert_eq!(compact_in_order(&positions, triangles), in_order);
    }
}
