//! Some triangles of a mesh, with numbers of their own.

use super::FanLeaf;
use super::cells::cells;
use glam::DVec3;

/// Triangles and vertices, numbered from 0 in the order of the mesh.
pub(super) struct Soup {
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) positions: Vec<DVec3>,
    /// The triangles' numbers in the mesh, in ascending order.
    numbers: Vec<u32>,
    /// The vertices' numbers in the mesh, in ascending order.
    vertices: Vec<u32>,
}

impl Soup {
    /// The triangles of these numbers, which ascend.
    pub(super) fn of(numbers: Vec<u32>, triangles: &[[u32; 3]], positions: &[DVec3]) -> Self {
        let in_mesh: Vec<[u32; 3]> = numbers.iter().map(|&t| triangles[t as usize]).collect();
        let mut vertices = in_mesh.as_flattened().to_vec();
        vertices.sort_unstable();
        vertices.dedup();
        let number = |v: u32| vertices.partition_point(|&other| other < v) as u32;
        let triangles = in_mesh.iter().map(|triangle| triangle.map(number)).collect();
        let positions = vertices.iter().map(|&v| positions[v as usize]).collect();
        Self { triangles, positions, numbers, vertices }
    }

    /// Its two halves, as the surface area heuristic divides it. One triangle is not divided.
    pub(super) fn halves(&self) -> Vec<Self> {
        let most = self.triangles.len().saturating_sub(1).max(1);
        let halves = cells(&self.triangles, &self.positions, most).into_iter();
        let half = |of: Vec<u32>| {
            let mut half = Self::of(of, &self.triangles, &self.positions);
            half.numbers.iter_mut().for_each(|t| *t = self.numbers[*t as usize]);
            half.vertices.iter_mut().for_each(|v| *v = self.vertices[*v as usize]);
            half
        };
        halves.map(half).collect()
    }

    /// A leaf with the numbers of the mesh.
    pub(super) fn in_mesh(&self, mut leaf: FanLeaf) -> FanLeaf {
        for fan in std::iter::once(&mut leaf.first).chain(&mut leaf.second) {
            fan.centre = self.vertices[fan.centre as usize];
            fan.ring.iter_mut().for_each(|v| *v = self.vertices[*v as usize]);
            fan.triangles.iter_mut().for_each(|t| *t = self.numbers[*t as usize]);
        }
        leaf
    }
}
