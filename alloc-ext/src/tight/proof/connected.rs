//! What triangles connect by the vertices that they share.

/// For each vertex the least number of those that it is connected to: one number for each part, and
/// for each vertex that no triangle has. Almost linear.
pub(crate) fn connected(vertices: usize, triangles: &[[u32; 3]]) -> Vec<u32> {
    let mut parent: Vec<u32> = (0..vertices as u32).collect();
    for &[a, b, c] in triangles {
        for v in [b, c] {
            let (p, q) = (root(&mut parent, a), root(&mut parent, v));
            parent[p.max(q) as usize] = p.min(q);
        }
    }
    // A parent has a lesser number, so it is at its own root already.
    for v in 0..vertices {
        parent[v] = parent[parent[v] as usize];
    }
    parent
}

fn root(parent: &mut [u32], mut v: u32) -> u32 {
    while parent[v as usize] != v {
        parent[v as usize] = parent[parent[v as usize] as usize];
        v = parent[v as usize];
    }
    v
}

#[cfg(test)]
mod tests {
    use super::connected;

    #[test]
    fn each_part_has_its_least_vertex() {
        let triangles = [[8, 6, 7], [1, 3, 5], [5, 9, 3], [7, 2, 8]];
        assert_eq!(connected(10, &triangles), [0, 1, 2, 1, 4, 1, 2, 2, 2, 1]);
        assert!(connected(0, &[]).is_empty());
    }
}
