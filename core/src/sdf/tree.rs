//! The interval at a place of a tree, in integers.
//!
//! *Descent.* A place has 16 bits along each axis in its root cell. Each node takes the next bit of
//! the axes that it halves, and the child is found by these bits. What is left of the place, less a
//! half, is its way from the leaf's centre.
//!
//! *Value.* With the way x from the centre in units, entries g of the gradient, curvature k and the
//! largest half side m of the cell, the function is
//! base + p·(code·step + g·x + k·(|x|² − (g·x/32)²)/2m), p = 1057/2^15, about a 31st. So g = 31 is a
//! gradient of 1, and k bends the function across the gradient alone, as the distance from a point
//! or an edge does.
//!
//! *Rounding.* All but the squares is exact up to the last shifts, which lose less than two units.
//! Ways of more than 2^11 units are cut to that for the squares: what this changes is bounded by
//! [`loss`](super::format::layout::tree::loss), and the builder adds it to the width.

use super::format::Sdf;
use super::format::layout::tree::{
    ENTRY_BYTES, IS_LEAF, MOST_STEPS, PART, ROOT_BITS, SQUARE_BITS, VALUE_SHIFT,
};
use super::value::SLOPE_BITS;
use crate::num::{each, greater};
use crate::query::QueryError;

/// Where a level of an axis stands in the sum of levels.
const LEVEL_AT: [u32; 3] = [0, 8, 16];

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
        let cut = SQUARE_BITS.saturating_sub(self.level);
        let square = |x: i32| x.wrapping_mul(x);
        let [x, y, z] = each(self.way, |x| square(x >> (cut & 31)));
        let along = square(rise >> (cut.wrapping_add(5) & 31));
        let squares = x.wrapping_add(y).wrapping_add(z).wrapping_sub(along);
        let shift = ROOT_BITS.wrapping_sub(self.level).wrapping_sub(cut << 1);
        let bend = self.six(18).wrapping_mul(squares) >> (shift & 31);
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
    /// Lower and upper bound of the distance at a place of a tree, units.
    #[inline(never)]
    pub(super) fn tree_value(&self, place: [u32; 3]) -> Result<[i32; 2], QueryError> {
        self.leaf(place).and_then(|leaf| self.of_leaf(&leaf)).ok_or(QueryError::Unchecked)
    }

    /// The bounds and the gradient, in 2^-15.
    #[inline(never)]
    pub(super) fn tree_value_and_slopes(
        &self,
        place: [u32; 3],
    ) -> Result<([i32; 2], [i32; 3]), QueryError> {
        let leaf = self.leaf(place).ok_or(QueryError::Unchecked)?;
        Ok((self.of_leaf(&leaf).ok_or(QueryError::Unchecked)?, leaf.slopes()))
    }

    #[inline(always)]
    fn of_leaf(&self, leaf: &Leaf) -> Option<[i32; 2]> {
        let lower = self.base.wrapping_add(leaf.value(self.step));
        let width = u16::from_le_bytes(*self.books.get((leaf.word >> 24 & 31) as usize)?);
        let upper = lower.wrapping_add(i32::from(width));
        Some([greater(lower, self.least), greater(upper, self.least)])
    }

    /// The leaf at a place of the field. `None` only of bytes that were not checked.
    #[inline(always)]
    fn leaf(&self, [x, y, z]: [u32; 3]) -> Option<Leaf> {
        let root = |place: u32| place >> ROOT_BITS;
        let mut at = root(x)
            .wrapping_add(root(y).wrapping_mul(self.row))
            .wrapping_add(root(z).wrapping_mul(self.layer));
        let (mut x, mut y, mut z) = (x << ROOT_BITS, y << ROOT_BITS, z << ROOT_BITS);
        let mut levels = 0u32;
        for _ in 0..MOST_STEPS {
            let [a, b, c, kind, last]: [u8; ENTRY_BYTES] = *self.entries.get(at as usize)?;
            if kind & IS_LEAF != 0 {
                let level = LEVEL_AT.map(|at| levels >> at & 0xff);
                let [i, j, k] = level;
                return Some(Leaf {
                    word: u32::from_le_bytes([a, b, c, kind]),
                    last,
                    way: [from_middle(x, i), from_middle(y, j), from_middle(z, k)],
                    level: i.min(j).min(k),
                });
            }
            let mut child = 0;
            if kind & 4 != 0 {
                (child, z) = (z >> 31, z << 1);
                levels = levels.wrapping_add(1 << LEVEL_AT[2]);
            }
            if kind & 2 != 0 {
                (child, y) = (child << 1 | y >> 31, y << 1);
                levels = levels.wrapping_add(1 << LEVEL_AT[1]);
            }
            if kind & 1 != 0 {
                (child, x) = (child << 1 | x >> 31, x << 1);
                levels = levels.wrapping_add(1 << LEVEL_AT[0]);
            }
            at = u32::from(u16::from_le_bytes([a, b])).wrapping_add(child);
        }
        None
    }
}

/// From the bits of a place below its cell, the highest first, to units from the cell's middle.
#[inline(always)]
fn from_middle(bits: u32, level: u32) -> i32 {
    ((bits ^ 1 << 31).cast_signed() >> ROOT_BITS) >> (level & 31)
}
