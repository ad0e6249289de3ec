//! The price of leaves: instructions of a query, and bytes.
//!
//! A query meets a leaf with a chance that grows with the leaf's box. Instructions are those of a
//! Cortex-M4F, fitted to the emulator's counts; a processor of eight lanes pays relatively more for
//! a leaf and less for a triangle. Leaves change little if a price is half or twice as high.

use super::FanLeaf;
use super::soup::Soup;
use glam::DVec3;

/// Instructions of a query beside those of its leaves.
const QUERY: f64 = 4000.0;
/// Instructions of a leaf, with its share of the nodes above.
const LEAF: f64 = 500.0;
/// Instructions of a triangle.
const TRIANGLE: f64 = 95.0;
/// Weight of a box's summed extents beside its half surface, relative to the mesh's diagonal: what
/// queries from outside meet, who see a plane from its edge too.
const EXTENT_WEIGHT: f64 = 0.1;
/// Children of a node, in the mean.
const CHILDREN: f64 = 7.0;
/// Coordinates of a vertex.
const AXES: usize = 3;

/// Bytes that a leaf takes.
#[derive(Clone, Copy, Debug)]
pub(in crate::bvh) struct LeafBytes {
    /// Of a node.
    pub node: usize,
    /// Of a coordinate.
    pub coordinate: usize,
}

/// Instructions and bytes of leaves. Instructions are those of a mean query.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::bvh) struct Cost {
    pub instructions: f64,
    pub bytes: f64,
}

impl std::ops::Add for Cost {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            instructions: self.instructions + other.instructions,
            bytes: self.bytes + other.bytes,
        }
    }
}

impl std::iter::Sum for Cost {
    fn sum<I: Iterator<Item = Self>>(costs: I) -> Self {
        costs.fold(Self::default(), std::ops::Add::add)
    }
}

impl Cost {
    /// With the part of a query that no leaf changes.
    pub(super) fn of_query(self) -> Self {
        Self { instructions: self.instructions + QUERY, ..self }
    }

    /// One number, where a byte is worth `per_byte` instructions.
    pub(super) fn price(self, per_byte: f64) -> f64 {
        self.instructions + per_byte * self.bytes
    }
}

/// What leaves of a mesh cost.
pub(super) struct Costs {
    /// Weight of the summed extents, grid units.
    extent_weight: f64,
    /// Measure of the mesh's box.
    whole: f64,
    bytes: LeafBytes,
}

impl Costs {
    pub(super) fn new(positions: &[DVec3], bytes: LeafBytes) -> Self {
        let size = size(positions.iter().copied());
        let costs = Self { extent_weight: EXTENT_WEIGHT * size.length(), whole: 1.0, bytes };
        Self { whole: costs.measure(size), ..costs }
    }

    fn measure(&self, size: DVec3) -> f64 {
        let half_area = size.x * size.y + size.y * size.z + size.z * size.x;
        half_area + self.extent_weight * (size.x + size.y + size.z)
    }

    /// The cost of a leaf.
    pub(super) fn of(&self, soup: &Soup, leaf: &FanLeaf) -> Cost {
        let vertices = leaf.fans().flat_map(|fan| fan.ring.iter().chain([&fan.centre]));
        let measure = self.measure(size(vertices.map(|&v| soup.positions[v as usize])));
        // Of a mesh without extent each leaf is met.
        let chance = if self.whole > 0.0 { measure / self.whole } else { 1.0 };
        let coordinates = AXES * super::super::encode::tag(leaf).vertices();
        Cost {
            instructions: chance * (LEAF + TRIANGLE * leaf.triangle_count() as f64),
            bytes: self.bytes.node as f64 / CHILDREN + (self.bytes.coordinate * coordinates) as f64,
        }
    }
}

/// Size of the box of some points, of which there is one at least.
fn size(points: impl Iterator<Item = DVec3>) -> DVec3 {
    let nothing = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) = points.fold(nothing, |(low, high), p| (low.min(p), high.max(p)));
    high - low
}
