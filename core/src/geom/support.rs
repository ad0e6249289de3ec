//! The plane that supports a triangle and faces the origin.

use crate::num::greater;
use crate::num::tolerance::WITHIN;
use glam::Vec3;

/// The plane that supports a triangle and faces the origin.
#[derive(Clone, Copy, Debug, Default)]
pub struct Support {
    /// Its distance from the origin times the length of its normal.
    pub along: f32,
    /// Squared length of its normal.
    pub length_sq: f32,
    /// The normal certainly runs from a point of the triangle to the origin. So its length is not
    /// below the distance.
    pub is_reached: bool,
}

impl Support {
    /// Of the triangle `a b c`.
    #[inline(always)]
    pub fn new(a: Vec3, b: Vec3, c: Vec3) -> Self {
        let ap = -a;
        let ab = b - a;
        let ac = c - a;
        let (r, is_reached) = residual(ap, ab, ac);
        Support {
            along: r.dot(ap) - greater(greater(0.0, r.dot(ab)), r.dot(ac)),
            length_sq: r.dot(r),
            is_reached,
        }
    }
}

/// Vector from the (approximately) closest point to the query, and whether that point certainly is
/// one of the triangle. Any finite result is safe as a direction, so no branch needs a proof.
/// `lanes` evaluates the same formulas.
#[inline(always)]
fn residual(ap: Vec3, ab: Vec3, ac: Vec3) -> (Vec3, bool) {
    let d1 = ab.dot(ap);
    let d2 = ac.dot(ap);
    if d1 <= 0.0 && d2 <= 0.0 {
        return (ap, true);
    }
    let aa = ab.dot(ab);
    let bb = ab.dot(ac);
    let d3 = d1 - aa;
    let d4 = d2 - bb;
    if d3 >= 0.0 && d4 <= d3 {
        return (ap - ab, true);
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 && aa > 0.0 {
        return (ap - ab * (d1 * (1.0 / aa)), true);
    }
    let cc = ac.dot(ac);
    let d5 = d1 - bb;
    let d6 = d2 - cc;
    if d6 >= 0.0 && d5 <= d6 {
        return (ap - ac, true);
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 && cc > 0.0 {
        return (ap - ac * (d2 * (1.0 / cc)), true);
    }
    let va = d3 * d6 - d5 * d4;
    let e4 = d4 - d3;
    let e5 = d5 - d6;
    if va <= 0.0 && e4 >= 0.0 && e5 >= 0.0 && e4 + e5 > 0.0 {
        let v = e4 * (1.0 / (e4 + e5));
        return (ap - ab * (1.0 - v) - ac * v, true);
    }
    let sum = va + vb + vc;
    if sum <= 0.0 {
        return (ap, true);
    }
    let inverse = 1.0 / sum;
    let (u, v) = (vb * inverse, vc * inverse);
    (ap - ab * u - ac * v, u >= 0.0 && v >= 0.0 && u + v <= WITHIN)
}
