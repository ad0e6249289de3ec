//! Connected components of triangles, by the vertices that they share.

use crate::mesh::UnionFind;

/// For each vertex the least vertex of its connected component. A vertex without triangles is alone
/// in its component.
///
/// Cost: almost linear.
pub(crate) fn least_connected(vertex_count: usize, triangles: &[[u32; 3]]) -> Vec<u32> {
    let mut sets = UnionFind::new(vertex_count);
    for &[a, b, c] in triangles {
        sets.join(a, b);
        sets.join(a, c);
    }
    (0..vertex_count as u32).map(|v| sets.find(v)).collect()
}

/// The triangles' numbers of each connected component, ascending. Components stand in the order of
/// their first triangles.
pub(crate) fn components(vertex_count: usize, triangles: &[[u32; 3]]) -> Vec<Vec<u32>> {
    let least = least_connected(vertex_count, triangles);
    let mut component_of = vec![usize::MAX; vertex_count];
    let mut components: Vec<Vec<u32>> = Vec::new();
    for (triangle, &[a, ..]) in (0u32..).zip(triangles) {
        let component = &mut component_of[least[a as usize] as usize];
        if *component == usize::MAX {
            *component = components.len();
            components.push(Vec::new());
        }
        components[*component].push(triangle);
    }
    components
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRIANGLES: [[u32; 3]; 4] = [[8, 6, 7], [1, 3, 5], [5, 9, 3], [7, 2, 8]];

    #[test]
    fn each_component_has_its_least_vertex() {
        assert_eq!(least_connected(10, &TRIANGLES), [0, 1, 2, 1, 4, 1, 2, 2, 2, 1]);
        assert!(least_connected(0, &[]).is_empty());
    }

    #[test]
    fn components_stand_in_the_order_of_their_first_triangles() {
        assert_eq!(components(10, &TRIANGLES), [[0, 3], [1, 2]]);
    }
}
