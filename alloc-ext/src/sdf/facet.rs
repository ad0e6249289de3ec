//! A triangle in the field's frame: its closest point, and what bounds the distance to it.

use glam::DVec3;

/// Distance by which a coordinate in the field's frame may be off, units: see [`super::domain`].
const OFF: f64 = 1.0 / (1u64 << 32) as f64;

/// A triangle, or what a triangle without an area leaves: a segment or a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facet {
    pub at: [DVec3; 3],
    /// Unit normal; 0 if the area is too small to tell.
    pub normal: DVec3,
    /// Bound of the distance of the normal from that of the exact triangle. Infinite if
    /// the area is too small to tell.
    pub doubt: f64,
    /// Whether the winding number is 0 in front of it and 1 behind it.
    pub tells_side: bool,
}

impl Facet {
    pub fn new(at: [DVec3; 3], tells_side: bool) -> Self {
        let [a, b, c] = at;
        let (ab, ac) = (b - a, c - a);
        let cross = ab.cross(ac);
        let area = cross.length();
        let longest = ab.length().max(ac.length());
        // An edge is off by less than 3.5 OFF, so the product of two is by 7 OFF · longest. A unit
        // vector is off by twice the part that its length is. Rounding is as much, of ε · longest.
        // What is above 14 pays for the product of two errors.
        let doubt = 16.0 * longest * (OFF + longest * f64::EPSILON) / area;
        let is_sound = area > 0.0 && doubt < 0.5;
        let normal = if is_sound { cross / area } else { DVec3::ZERO };
        Self { at, normal, doubt: if is_sound { doubt } else { f64::INFINITY }, tells_side }
    }

    /// The closest point (Ericson 2005, 5.1.5). It lies on the triangle but for rounding, even
    /// where the triangle is too thin to tell which of its points is closest.
    #[inline]
    pub fn closest(&self, p: DVec3) -> DVec3 {
        let [a, b, c] = self.at;
        let (ab, ac, ap) = (b - a, c - a, p - a);
        let (d1, d2) = (ab.dot(ap), ac.dot(ap));
        if d1 <= 0.0 && d2 <= 0.0 {
            return a;
        }
        let bp = p - b;
        let (d3, d4) = (ab.dot(bp), ac.dot(bp));
        if d3 >= 0.0 && d4 <= d3 {
            return b;
        }
        let vc = d1 * d4 - d3 * d2;
        if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
            return a + ab * part(d1, d1 - d3);
        }
        let cp = p - c;
        let (d5, d6) = (ab.dot(cp), ac.dot(cp));
        if d6 >= 0.0 && d5 <= d6 {
            return c;
        }
        let vb = d5 * d2 - d1 * d6;
        if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
            return a + ac * part(d2, d2 - d6);
        }
        let va = d3 * d6 - d5 * d4;
        let (along, against) = (d4 - d3, d5 - d6);
        if va <= 0.0 && along >= 0.0 && against >= 0.0 {
            return b + (c - b) * part(along, along + against);
        }
        let sum = va + vb + vc;
        let v = part(vb, sum);
        a + ab * v + ac * part(vc, sum).min(1.0 - v)
    }

    /// Largest height of a corner over a point along a direction. No point of the triangle is
    /// higher.
    #[inline]
    pub fn support(&self, from: DVec3, direction: DVec3) -> f64 {
        let [a, b, c] = self.at;
        let [a, b, c] = [direction.dot(a - from), direction.dot(b - from), direction.dot(c - from)];
        a.max(b).max(c)
    }

    /// Heights of the triangle's points within `radius` of its point `at`, over a point along a
    /// unit direction: least and greatest.
    pub fn heights(&self, from: DVec3, direction: DVec3, at: DVec3, radius: f64) -> [f64; 2] {
        let corners = self.at.map(|at| direction.dot(at - from));
        let least = corners[0].min(corners[1]).min(corners[2]);
        let most = corners[0].max(corners[1]).max(corners[2]);
        let slope = direction.cross(self.normal).length() + self.doubt;
        let (middle, rise) = (direction.dot(at - from), slope * radius);
        // Without an area the corners alone tell.
        if rise.is_finite() {
            [least.max(middle - rise), most.min(middle + rise)]
        } else {
            [least, most]
        }
    }
}

/// A part of a whole, from 0 to 1; 0 of nothing.
#[inline]
fn part(of: f64, whole: f64) -> f64 {
    if whole > 0.0 { (of / whole).clamp(0.0, 1.0) } else { 0.0 }
}
