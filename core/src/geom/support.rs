//! The plane that supports a triangle and faces the origin.

use super::real_vector::RealVector;
use crate::num::tolerance::WITHIN;
use crate::num::{Real, SOFT_DOUBLE, greater};

/// The plane that supports a triangle and faces the origin.
#[derive(Clone, Copy, Debug, Default)]
pub struct Support {
    /// Its distance from the origin times the length of its normal.
    pub along: f32,
    /// Squared length of its normal.
    pub length_sq: f32,
}

const ZERO: Real = Real(0.0);

impl Support {
    /// Of the triangle `a b c`.
    #[inline(always)]
    pub fn new([a, b, c]: [RealVector; 3]) -> Self {
        let ap = -a;
        let ab = b - a;
        let ac = c - a;
        let (d1, d2) = (ab.dot(ap), ac.dot(ap));
        if SOFT_DOUBLE && d1 <= ZERO && d2 <= ZERO {
            // The direction is the way from a corner. Its products are known.
            let Real(length_sq) = ap.dot(ap);
            return Support { along: length_sq, length_sq };
        }
        let (r, _) =
            if d1 <= ZERO && d2 <= ZERO { (ap, true) } else { residual([ap, ab, ac], [d1, d2]) };
        let Real(along) = r.dot(ap) - greater(greater(ZERO, r.dot(ab)), r.dot(ac));
        let Real(length_sq) = r.dot(r);
        Support { along, length_sq }
    }
}

/// The square of an upper bound of the distance from the origin to the triangle `a b c`, up to
/// rounding. Infinite where f32 does not tell.
pub fn distance_sq([a, b, c]: [RealVector; 3]) -> f32 {
    let (ap, ab, ac) = (-a, b - a, c - a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    let is_at_a = d1 <= ZERO && d2 <= ZERO;
    let (r, is_reached) = if is_at_a { (ap, true) } else { residual([ap, ab, ac], [d1, d2]) };
    if is_reached { r.dot(r).0 } else { f32::INFINITY }
}

/// Vector from the (approximately) closest point, not `a`, to the query, and whether that point
/// certainly is one of the triangle. Any finite result is safe as a direction, so no branch needs a
/// proof. `lanes` evaluates the same formulas.
#[inline(always)]
fn residual([ap, ab, ac]: [RealVector; 3], [d1, d2]: [Real; 2]) -> (RealVector, bool) {
    let inverse = |x: Real| Real(1.0 / x.0);
    let aa = ab.dot(ab);
    let bb = ab.dot(ac);
    let d3 = d1 - aa;
    let d4 = d2 - bb;
    if d3 >= ZERO && d4 <= d3 {
        return (ap - ab, true);
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= ZERO && d1 >= ZERO && d3 <= ZERO && aa > ZERO {
        return (ap - ab * (d1 * inverse(aa)), true);
    }
    let cc = ac.dot(ac);
    let d5 = d1 - bb;
    let d6 = d2 - cc;
    if d6 >= ZERO && d5 <= d6 {
        return (ap - ac, true);
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= ZERO && d2 >= ZERO && d6 <= ZERO && cc > ZERO {
        return (ap - ac * (d2 * inverse(cc)), true);
    }
    let va = d3 * d6 - d5 * d4;
    let e4 = d4 - d3;
    let e5 = d5 - d6;
    if va <= ZERO && e4 >= ZERO && e5 >= ZERO && e4 + e5 > ZERO {
        let v = e4 * inverse(e4 + e5);
        return (ap - ab * (Real(1.0) - v) - ac * v, true);
    }
    let sum = va + vb + vc;
    if sum <= ZERO {
        return (ap, true);
    }
    let inverse = inverse(sum);
    let (u, v) = (vb * inverse, vc * inverse);
    // NaN is not reached.
    let is_reached = u.0 >= 0.0 && v.0 >= 0.0 && (u + v).0 <= WITHIN;
    (ap - ab * u - ac * v, is_reached)
}
