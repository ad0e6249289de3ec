//! The functions of cells, about the centres of boxes.

use glam::DVec3;

/// Units along each axis of a lattice's cell.
pub(super) const CELL: f64 = 2048.0;

/// The function of a cell.
pub(super) enum Function {
    OfLattice(Trilinear),
    OfTree(Bent),
}

impl Function {
    /// Value and gradient at a place, which counts from the cell's least corner in units, and how
    /// far the function is from these within half sides of a box, at most.
    pub(super) fn about(&self, p: DVec3, half: DVec3) -> (f64, DVec3, f64) {
        match self {
            Self::OfLattice(function) => function.about(p, half),
            Self::OfTree(function) => function.about(p, half),
        }
    }
}

/// What a code's step and a gradient of 1 stand for.
pub(super) const PART: f64 = 1057.0 / 32_768.0;

/// A plane, bent across its gradient, about the centre of a leaf.
pub(super) struct Bent {
    /// From the leaf's least corner to its centre.
    pub(super) middle: DVec3,
    pub(super) constant: f64,
    /// As stored: 31 is about 1.
    pub(super) gradient: DVec3,
    /// As stored.
    pub(super) curvature: f64,
}

impl Bent {
    fn about(&self, p: DVec3, half: DVec3) -> (f64, DVec3, f64) {
        let x = p - self.middle;
        let bend = PART * self.curvature / (2.0 * self.middle.max_element());
        let unit = self.gradient / 32.0;
        let along = unit.dot(x);
        let value = self.constant + PART * self.gradient.dot(x) + bend * (x.dot(x) - along * along);
        let gradient = PART * self.gradient + 2.0 * bend * (x - unit * along);
        // The squares of a way from the place, less that along the gradient: either is at most
        // this.
        let rest = half.dot(half).max(unit.abs().dot(half).powi(2) - half.min_element().powi(2));
        (value, gradient, bend.abs() * rest)
    }

    /// How far the value of a query may be below and above the function, units. Squares are those
    /// of ways cut to 11 bits along the longest side of a root cell, one less for every second time
    /// that it is halved, and shifts round down.
    pub(super) fn losses(&self) -> [f64; 2] {
        let largest = self.middle.max_element();
        let halvings = (32_768.0 / largest).log2().round();
        let cut = 16.0 / (halvings / 2.0).floor().exp2();
        let ways: f64 = self.middle.to_array().iter().map(|x| 2.0 * x / cut + 1.0).sum();
        let along = 2.0 * self.gradient.abs().dot(self.middle) / (32.0 * cut) + 1.0;
        let squares = ways + along;
        let bent = PART * self.curvature.abs() * squares * cut * cut / (2.0 * largest);
        // The bend's shift, the sum's of four bits, and the last.
        [bent + PART * 16.0 + 1.0, bent]
    }
}

/// A polynomial of degree 1 in each coordinate, which count from a cell's least corner in units.
pub(super) struct Trilinear {
    constant: f64,
    of: DVec3,
    /// Of yz, xz, xy.
    of_two: DVec3,
    of_three: f64,
}

impl Trilinear {
    /// From the values at the corners, x fastest.
    pub(super) fn of([a, b, c, d, e, f, g, h]: [f64; 8]) -> Self {
        let square = CELL * CELL;
        Self {
            constant: a,
            of: DVec3::new(b - a, c - a, e - a) / CELL,
            of_two: DVec3::new(g - e - c + a, f - e - b + a, d - c - b + a) / square,
            of_three: (h - g - f + e - d + c + b - a) / (square * CELL),
        }
    }

    /// Value and gradient at a place, and how far the function is from these within half sides of a
    /// box, at most.
    fn about(&self, p: DVec3, half: DVec3) -> (f64, DVec3, f64) {
        let DVec3 { x, y, z } = p;
        let two = self.of_two;
        let products = DVec3::new(y * z, x * z, x * y);
        let value =
            self.constant + self.of.dot(p) + two.dot(products) + self.of_three * (x * y * z);
        let gradient = self.of
            + DVec3::new(two.z * y + two.y * z, two.z * x + two.x * z, two.y * x + two.x * y)
            + self.of_three * products;
        // Second derivatives at the place, and the third.
        let bent = (two + self.of_three * p).abs();
        let halves = DVec3::new(half.y * half.z, half.x * half.z, half.x * half.y);
        let rest = bent.dot(halves) + self.of_three.abs() * (half.x * half.y * half.z);
        (value, gradient, rest)
    }
}
