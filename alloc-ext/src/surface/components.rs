//! Connected components of triangles, by the vertices that they share.

use crate::geom::{Bounds, StaticTree};
use crate::mesh::{Mesh, UnionFind};
use glam::Vec3;

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

/// How many connected components of a mesh have a box that meets the box of another one. Only these
/// components can overlap.
///
/// Cost: n log n.
#[must_use]
pub fn components_whose_boxes_meet(mesh: &Mesh) -> usize {
    let corners = |t: &u32| mesh.corners(*t as usize).into_iter().flatten();
    let of = |component: &Vec<u32>| {
        let points = component.iter().flat_map(corners).map(|p| Vec3::from(p).as_dvec3());
        points.fold(Bounds::EMPTY, Bounds::with)
    };
    let boxes: Vec<Bounds> =
        components(mesh.positions.len(), &mesh.triangles).iter().map(of).collect();
    let tree = StaticTree::new(&boxes);
    let is_alone =
        |(i, own): &(usize, &Bounds)| tree.visit_meeting(own, |j| j == *i || !own.meets(&boxes[j]));
    boxes.iter().enumerate().filter(|one| !is_alone(one)).count()
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

    #[test]
    fn components_whose_boxes_meet_are_counted() {
        let triangle_at = |x: f32| [[x, 0.0, 0.0], [x + 1.0, 0.0, 0.0], [x, 1.0, 1.0]];
        for (places, count) in [(&[0.0, 2.0][..], 0), (&[0.0, 1.0, 5.0], 2), (&[0.5, 0.0, 1.2], 3)]
        {
            let positions: Vec<_> = places.iter().flat_map(|&x| triangle_at(x)).collect();
            let triangles = (0..places.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]);
            let mesh = Mesh::new(positions, triangles.collect());
            assert_eq!(components_whose_boxes_meet(&mesh), count, "{places:?}");
        }
    }
}
