//! The plane that supports a triangle and faces the origin.

use crate::num::greater;
use glam::Vec3;

/// The plane that supports a triangle and faces the origin.
#[derive(Clone, Copy, Debug, Default)]
pub struct Support {
    /// Its distance from the origin times the length of its normal.
    pub along: f32,
    /// Squared length of its normal.
    pub length_sq: f32,
}

impl Support {
    /// Of the triangle `a b c`.
    #[inline(always)]
    pub fn new(a: Vec3, b: Vec3, c: Vec3) -> Self {
        let ap = -a;
        let ab = b - a;
        let ac = c - a;
        let r = residual(ap, ab, ac);
        Support {
            along: r.dot(ap) - greater(greater(0.0, r.dot(ab)), r.dot(ac)),
            length_sq: r.dot(r),
        }
    }
}

/// Vector from the (approximately) closest point to the query. Any finite result is safe, so no
/// branch needs a proof. `lanes` evaluates the same formulas.
#[inline(always)]
fn residual(ap: Vec3, ab: Vec3, ac: Vec3) -> Vec3 {
    let d1 = ab.dot(ap);
    let d2 = ac.dot(ap);
    if d1 <= 0.0 && d2 <= 0.0 {
        return ap;
    }
    let aa = ab.dot(ab);
    let bb = ab.dot(ac);
    let d3 = d1 - aa;
    let d4 = d2 - bb;
    if d3 >= 0.0 && d4 <= d3 {
        return ap - ab;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 && aa > 0.0 {
        return ap - ab * (d1 * (1.0 / aa));
    }
    let cc = ac.dot(ac);
    let d5 = d1 - bb;
    let d6 = d2 - cc;
    if d6 >= 0.0 && d5 <= d6 {
        return ap - ac;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 && cc > 0.0 {
        return ap - ac * (d2 * (1.0 / cc));
    }
    let va = d3 * d6 - d5 * d4;
    let e4 = d4 - d3;
    let e5 = d5 - d6;
    if va <= 0.0 && e4 >= 0.0 && e5 >= 0.0 && e4 + e5 > 0.0 {
        let v = e4 * (1.0 / (e4 + e5));
        return ap - ab * (1.0 - v) - ac * v;
    }
    let sum = va + vb + vc;
    if sum <= 0.0 {
        return ap;
    }
    let inverse = 1.0 / sum;
    ap - ab * (vb * inverse) - ac * (vc * inverse)
}
