//! The interval at a place of a tree, in integers.
//!
//! *Descent.* A place has 16 bits along each axis in its root cell. Each node takes the next bit of
//! the axes that it halves, and the child is found by these bits. What is left of the place, less a
//! half, is its way from the leaf's centre.
//!
//! *Value.* With the way x from the centre in units, entries g of the gradient, curvature k and the
//! largest half side m of the cell, the function is
//! base + p·(code·step + g·x + k·(|x|² − (g·x/32)²)/2m), p = 1057/2^15, about a 31st. So g = 31 is a
//! gradient of 1. k bends the function across the gradient, as the distance from a point or an edge
//! does. 32 in place of 31 makes a division a shift, and leaves 6 % of the bend along the gradient.
//!
//! *Rounding.* All but the bend is exact up to the last shifts. For its squares, ways are cut to
//! 11 bits in a root cell, and to a bit less for every second halving. So the bend is shifted by 8
//! or 7. [`loss`](super::format::layout::tree::loss) bounds what all of them change, and the
//! builder adds it to the width.

use super::format::Sdf;
use super::format::layout::tree::{
    AXES, IS_LEAF, MOST_LEVEL, PART, ROOT_BITS, SQUARE_BITS, VALUE_SHIFT,
};
use super::value::SLOPE_BITS;
use crate::num::{each, greater};
use crate::query::QueryError;

/// Where a level of an axis stands in the sum of levels.
const LEVEL_AT: [u32; 3] = [0, 5, 10];

/// A leaf, and a place in it.
struct Leaf {
    /// Gradient, curvature, number of the width, two bits of the code.
    word: u32,
    /// The other eight bits of the code.
    last: u8,
    /// From the leaf's centre, units.
    way: [i32; 3],
    /// Halvings along the axis that was halved least.
    level: u32,
}

impl Leaf {
    /// Six bits with a sign.
    #[inline(always)]
    fn six(&self, at: u32) -> i32 {
        (self.word << (26 - at)).cast_signed() >> 26
    }

    #[inline(always)]
    fn gradient(&self) -> [i32; 3] {
        [self.six(0), self.six(6), self.six(12)]
    }

    /// How far the plane rises from the centre, about 31sts of a unit.
    #[inline(always)]
    fn rise(&self) -> i32 {
        let ([x, y, z], [a, b, c]) = (self.way, self.gradient());
        x.wrapping_mul(a).wrapping_add(y.wrapping_mul(b)).wrapping_add(z.wrapping_mul(c))
    }

    /// The function above the base, units.
    #[inline(always)]
    fn value(&self, step: i32) -> i32 {
        let code = (self.word >> 29 & 3 | u32::from(self.last) << 2).cast_signed();
        let rise = self.rise();
        let cut = SQUARE_BITS.wrapping_sub(self.level >> 1);
        let square = |x: i32| x.wrapping_mul(x);
        let [x, y, z] = each(self.way, |x| square(x >> cut));
        let along = square(rise >> cut.wrapping_add(5));
        let squares = x.wrapping_add(y).wrapping_add(z).wrapping_sub(along);
        // ROOT_BITS - level - 2·cut.
        let shift = (ROOT_BITS - 2 * SQUARE_BITS).wrapping_sub(self.level & 1);
        let bend = self.six(18).wrapping_mul(squares) >> shift;
        let sum = code.wrapping_mul(step).wrapping_add(rise).wrapping_add(bend);
        (sum >> VALUE_SHIFT).wrapping_mul(PART) >> (15 - VALUE_SHIFT)
    }

    /// The function's gradient, in 2^-15.
    #[inline(always)]
    fn slopes(&self) -> [i32; 3] {
        let (gradient @ [a, b, c], [x, y, z]) = (self.gradient(), self.way);
        let (along, curvature) = (self.rise() >> 5, self.six(18));
        let shift = (ROOT_BITS - 1).wrapping_sub(self.level) & 31;
        let across = |x: i32, g: i32| x.wrapping_sub(along.wrapping_mul(g) >> 5);
        let bend = |across: i32| across.wrapping_mul(curvature << 5) >> shift;
        let [x, y, z] = [bend(across(x, a)), bend(across(y, b)), bend(across(z, c))];
        let [a, b, c] = each(gradient, |g| g << 5);
        each([a.wrapping_add(x), b.wrapping_add(y), c.wrapping_add(z)], |slope| {
            slope.wrapping_mul(PART) >> (SLOPE_BITS - 10)
        })
    }
}

impl Sdf<'_> {
    /// The root cell of a place of a tree; `None` outside.
    #[inline(always)]
    pub(super) fn root(&self, place: [u32; 3]) -> Option<u32> {
        let [x, y, z] = each(place, |place| place >> ROOT_BITS);
        // A place has 16 bits more, and a row or layer at most 49 cells.
        let (y, z) = (y.wrapping_mul(self.row), z.wrapping_mul(self.layer));
        let is_within = x < self.row && y < self.layer && z < self.roots;
        is_within.then(|| x.wrapping_add(y).wrapping_add(z))
    }

    /// The same of a place of the field.
    #[inline(always)]
    pub(super) fn root_within(&self, place: [u32; 3]) -> u32 {
        let [x, y, z] = each(place, |place| place >> ROOT_BITS);
        x.wrapping_add(y.wrapping_mul(self.row)).wrapping_add(z.wrapping_mul(self.layer))
    }

    /// Lower and upper bound of the distance at a place of a tree, units.
    #[inline(always)]
    pub(super) fn tree_bounds(&self, root: u32, place: [u32; 3]) -> Result<[i32; 2], QueryError> {
        self.leaf(root, place).and_then(|leaf| self.of_leaf(&leaf)).ok_or(QueryError::Unchecked)
    }

    /// The bounds and the gradient, in 2^-15.
    #[inline(never)]
    pub(super) fn tree_bounds_and_slopes(
        &self,
        root: u32,
        place: [u32; 3],
    ) -> Result<([i32; 2], [i32; 3]), QueryError> {
        let leaf = self.leaf(root, place).ok_or(QueryError::Unchecked)?;
        Ok((self.of_leaf(&leaf).ok_or(QueryError::Unchecked)?, leaf.slopes()))
    }

    #[inline(always)]
    fn of_leaf(&self, leaf: &Leaf) -> Option<[i32; 2]> {
        let lower = self.base.wrapping_add(leaf.value(self.step));
        let width = u16::from_le_bytes(*self.books.get((leaf.word >> 24 & 31) as usize)?);
        let upper = lower.wrapping_add(i32::from(width));
        Some([greater(lower, self.least), greater(upper, self.least)])
    }

    /// The leaf at a place of a root cell. `None` only of bytes that were not checked.
    ///
    /// Each child stands behind its node, so the descent ends whatever the bytes are.
    #[inline(always)]
    fn leaf(&self, root: u32, [x, y, z]: [u32; 3]) -> Option<Leaf> {
        let mut at = root;
        let (mut x, mut y, mut z) = (x << ROOT_BITS, y << ROOT_BITS, z << ROOT_BITS);
        let mut levels = 0u32;
        loop {
            let entry @ &[_, _, _, kind, last] = self.entries.get(at as usize)?;
            if kind & IS_LEAF != 0 {
                let word = u32::from_le_bytes(*entry.first_chunk()?);
                let level = LEVEL_AT.map(|at| levels >> at & MOST_LEVEL);
                let [i, j, k] = level;
                return Some(Leaf {
                    word,
                    last,
                    way: [from_middle(x, i), from_middle(y, j), from_middle(z, k)],
                    level: i.min(j).min(k),
                });
            }
            // The next bit of an axis.
            let next = |bits: &mut u32| {
                let bit = *bits >> 31;
                *bits <<= 1;
                bit
            };
            // A case for each set of axes takes fewer instructions than a test for each axis.
            let (child, halved) = match kind & AXES {
                1 => (next(&mut x), [1, 0, 0]),
                2 => (next(&mut y), [0, 1, 0]),
                3 => (next(&mut y) << 1 | next(&mut x), [1, 1, 0]),
                4 => (next(&mut z), [0, 0, 1]),
                5 => (next(&mut z) << 1 | next(&mut x), [1, 0, 1]),
                6 => (next(&mut z) << 1 | next(&mut y), [0, 1, 1]),
                7 => ((next(&mut z) << 1 | next(&mut y)) << 1 | next(&mut x), [1, 1, 1]),
                _ => return None,
            };
            let [i, j, k] = halved;
            let [p, q, r] = LEVEL_AT;
            levels = levels.wrapping_add(i << p | j << q | k << r);
            let between = u32::from(u16::from_le_bytes(*entry.first_chunk()?));
            at = at.wrapping_add(between).wrapping_add(child).wrapping_add(1);
        }
    }
}

/// From the bits of a place below its cell, the highest first, to units from the cell's middle.
#[inline(always)]
fn from_middle(bits: u32, level: u32) -> i32 {
    (bits >> (32 - ROOT_BITS)).cast_signed().wrapping_sub(1 << (ROOT_BITS - 1)) >> level
}
