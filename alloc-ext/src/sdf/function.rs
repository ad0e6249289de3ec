//! The function of a cell: trilinear in a lattice, of a leaf in a tree.

use super::domain::CELL;
use glam::DVec3;

/// The trilinear function of eight corners, units, of a place in the cell, units.
#[derive(Clone, Copy, Debug)]
pub(super) struct Trilinear {
    constant: f64,
    slope: DVec3,
    /// Of yz, zx, xy.
    twist: DVec3,
    xyz: f64,
}

/// A function in a cell.
pub(super) trait Function {
    /// About the centre of a box, which counts from the cell's least corner, with these half sides.
    fn about(&self, centre: DVec3, half: DVec3) -> Linear;
}

/// A linear function about the centre of a box, and how far the cell's is from it at most.
#[derive(Clone, Copy, Debug)]
pub(super) struct Linear {
    pub value: f64,
    pub gradient: DVec3,
    pub rest: f64,
}

impl Trilinear {
    /// By the corners' values, x fastest.
    pub fn new(at: [f64; 8]) -> Self {
        let rise = |k: usize| (at[k] - at[0]) / CELL;
        let twist = |i: usize, j: usize| (at[i | j] - at[i] - at[j] + at[0]) / (CELL * CELL);
        let xyz = at[7] - at[6] - at[5] - at[3] + at[4] + at[2] + at[1] - at[0];
        Self {
            constant: at[0],
            slope: DVec3::new(rise(1), rise(2), rise(4)),
            twist: DVec3::new(twist(2, 4), twist(4, 1), twist(1, 2)),
            xyz: xyz / (CELL * CELL * CELL),
        }
    }
}

impl Function for Trilinear {
    fn about(&self, centre: DVec3, half: DVec3) -> Linear {
        let DVec3 { x, y, z } = centre;
        let pairs = DVec3::new(y * z, z * x, x * y);
        let twist = self.twist + self.xyz * centre;
        let value =
            self.constant + self.slope.dot(centre) + self.twist.dot(pairs) + self.xyz * x * y * z;
        let t = self.twist;
        let gradient = self.slope
            + DVec3::new(t.y * z + t.z * y, t.x * z + t.z * x, t.x * y + t.y * x)
            + self.xyz * pairs;
        let areas = DVec3::new(half.y * half.z, half.z * half.x, half.x * half.y);
        let rest = twist.abs().dot(areas) + self.xyz.abs() * half.x * areas.x;
        Linear { value, gradient, rest }
    }
}

impl Linear {
    /// The negative function.
    pub fn negative(&self) -> Self {
        Self { value: -self.value, gradient: -self.gradient, rest: self.rest }
    }
}
