//! The function and the bytes of a leaf.

use crate::sdf::function::{Function, Linear};
use glam::DVec3;
use meshsweep_core::internal::sdf::format::layout::tree::{
    ENTRY_BYTES, IS_LEAF, MOST_CODE, PART, PART_OF, ROOT_BITS, loss,
};

/// One step of a gradient's component, and 1 of a code's step in units: about a 31st.
pub(super) const GRADIENT_STEP: f64 = PART as f64 / PART_OF as f64;

/// A plane through 0 at the box's centre, and a curvature across it: the stored numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Shape {
    pub gradient: [i32; 3],
    pub curvature: i32,
}

impl Shape {
    /// The gradient, as a vector of units a unit.
    fn slope(self) -> DVec3 {
        DVec3::from(self.gradient.map(f64::from)) * GRADIENT_STEP
    }

    /// Of |x|² − (g·x/32)².
    fn bend(self, half: DVec3) -> f64 {
        GRADIENT_STEP * f64::from(self.curvature) / (2.0 * half.max_element())
    }

    /// Coefficients of x, y, z, xx, yy, zz, yz, zx, xy in a box with these half sides.
    pub fn terms(self, half: DVec3) -> [f64; 9] {
        let [a, b, c] = self.slope().to_array();
        let (bend, [x, y, z]) = (self.bend(half), self.gradient.map(|g| f64::from(g) / 32.0));
        let square = |g: f64| bend * (1.0 - g * g);
        let two = |g: f64, h: f64| -2.0 * bend * g * h;
        [a, b, c, square(x), square(y), square(z), two(y, z), two(z, x), two(x, y)]
    }
}

/// A leaf.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leaf {
    /// Half sides of its box, units.
    pub half: DVec3,
    pub shape: Shape,
    /// The function at the centre, units.
    pub offset: f64,
}

impl Function for Leaf {
    fn about(&self, centre: DVec3, half: DVec3) -> Linear {
        let p = centre - self.half;
        let (slope, bend) = (self.shape.slope(), self.shape.bend(self.half));
        let g = DVec3::from(self.shape.gradient.map(f64::from)) / 32.0;
        let along = g.dot(p);
        let value = self.offset + slope.dot(p) + bend * (p.length_squared() - along * along);
        let gradient = slope + 2.0 * bend * (p - along * g);
        // The rest is bend · (|y|² − (g·y)²), between 0 and bend · |y|² if g is no longer than 1: half
        // of that is the middle.
        let most = bend * half.length_squared();
        if g.length_squared() <= 1.0 {
            Linear { value: value + 0.5 * most, gradient, rest: 0.5 * most.abs() }
        } else {
            Linear { value, gradient, rest: most.abs() * g.length_squared().max(1.0) }
        }
    }
}

/// How much a query's value may be below and above the function, units.
pub(super) fn losses(shape: Shape, half: DVec3) -> [f64; 2] {
    let largest = 2.0 * half.max_element();
    let level = (f64::from(1u32 << ROOT_BITS) / largest).log2().round() as u32;
    loss(shape.curvature, level).map(|loss| f64::from(loss) / 1024.0)
}

/// The entry of a leaf; `None` of a code out of range.
pub(super) fn entry(shape: Shape, code: i64, width: usize) -> Option<[u8; ENTRY_BYTES]> {
    let code = u32::try_from(code).ok().filter(|&code| code <= MOST_CODE)?;
    let six = |x: i32, at: u32| (x.cast_unsigned() & 63) << at;
    let [a, b, c] = shape.gradient;
    let numbers = six(a, 0) | six(b, 6) | six(c, 12) | six(shape.curvature, 18);
    let word = numbers | (width as u32) << 24 | (code & 3) << 29 | u32::from(IS_LEAF) << 24;
    let [a, b, c, d] = word.to_le_bytes();
    Some([a, b, c, d, (code >> 2) as u8])
}
