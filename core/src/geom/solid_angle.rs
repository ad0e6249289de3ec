//! Solid angles of triangles, with bounds of their errors.
//!
//! Half of a triangle's solid angle is the argument of a complex number (Van Oosterom & Strackee
//! 1983). So the sum over many triangles is the argument of a product: one arctangent for all. The
//! product is turned back by a right angle whenever its argument exceeds half of one, and the right
//! angles are counted.

use super::vector::norm_1;
use crate::num::tolerance::{
    ANGLE_PRODUCT, ARCTANGENT, EDGE_DISTANCE, SOLID_ANGLE, SOLID_ANGLE_NEAREST,
    TRUSTED_DIRECTION_SQ, TWO_ARCSINES, U32,
};
use crate::num::{greater, lesser, sqrt_approx};
use glam::Vec3;

/// The largest solid angle of a triangle, 2π, rounded up.
const LARGEST_ANGLE: f32 = 6.283_185_5;

/// A corner of a triangle as seen from the origin.
#[derive(Clone, Copy, Debug)]
pub struct SeenCorner {
    way: Vec3,
    distance: f32,
}

impl SeenCorner {
    /// Each coordinate may carry one rounding to f32. None may be above 2^39.
    #[inline(always)]
    pub fn new(way: Vec3) -> SeenCorner {
        SeenCorner { way, distance: sqrt_approx(way.dot(way)) }
    }
}

/// A sum of solid angles as seen from the origin.
#[derive(Clone, Copy, Debug)]
pub struct SolidAngles {
    /// Half of the sum is the argument of this complex number, and `right_angles` right angles.
    real: f32,
    imaginary: f32,
    right_angles: i32,
    /// Sum of the bounds of the added angles. `sum` adds those of the product and of the
    /// arctangent.
    error: f32,
    terms: u32,
}

impl SolidAngles {
    /// No triangles.
    pub const NONE: SolidAngles =
        SolidAngles { real: 1.0, imaginary: 0.0, right_angles: 0, error: 0.0, terms: 0 };

    /// Adds a triangle. Its angle is positive if it shows its back, that is, if its corners run
    /// clockwise.
    ///
    /// Each corner may be as far as `moved` from its true place. Where the triangle may touch the
    /// origin nothing is added, and the error grows by the largest angle. The errors are derived in
    /// `core/docs/rounding.md` §20.
    #[inline(always)]
    pub fn add(&mut self, corners: [SeenCorner; 3], moved: f32) {
        self.terms = self.terms.saturating_add(1);
        let [x, y, z] = corners.map(|corner| corner.distance);
        let [a, b, c] = corners.map(|corner| corner.way);
        let product = x * y * z;
        let sine = a.dot(b.cross(c));
        let cosine = product + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y;
        let is_precise = lesser(lesser(x, y), z) >= SOLID_ANGLE_NEAREST;
        // Then the complex number is at least as long as the product, and its error a part of it.
        let error = if is_precise && cosine >= product {
            TWO_ARCSINES * SOLID_ANGLE * U32
        } else {
            error_of_near(sine, cosine, if is_precise { product } else { f32::INFINITY })
        };
        let error = if moved > 0.0 && error < LARGEST_ANGLE {
            error + flux_through_edges([a, b, c], [sine, cosine, product], x, moved)
        } else {
            error
        };
        if error < LARGEST_ANGLE {
            self.error += error;
            self.multiply(cosine, sine);
        } else {
            self.error += LARGEST_ANGLE;
        }
    }

    /// Multiplies by a complex number that is not 0.
    #[inline(always)]
    fn multiply(&mut self, real: f32, imaginary: f32) {
        let (x, y) = scaled(real, imaginary);
        let (x, y) = if x < 0.0 { self.turned_back(x, y) } else { (x, y) };
        let (p, q) = (self.real, self.imaginary);
        let (p, q) = scaled(p * x - q * y, p * y + q * x);
        // From at most half a right angle and at most one right angle: no more than three halves.
        let is_beyond = q.abs() > p;
        (self.real, self.imaginary) = if is_beyond { self.turned_back(p, q) } else { (p, q) };
    }

    /// Turns a complex number back by a right angle, exactly, and counts it.
    #[inline(always)]
    fn turned_back(&mut self, real: f32, imaginary: f32) -> (f32, f32) {
        if imaginary > 0.0 {
            self.right_angles = self.right_angles.saturating_add(1);
            (imaginary, -real)
        } else {
            self.right_angles = self.right_angles.saturating_sub(1);
            (-imaginary, real)
        }
    }

    /// The sum, and a bound of its error.
    pub fn sum(&self) -> (f32, f32) {
        let turned = self.right_angles as f32 * PI_UP;
        let rest = 2.0 * libm::atan2f(self.imaginary, self.real);
        let terms = self.terms as f32;
        let rounding = turned.abs() * 4.0 + rest.abs() * ARCTANGENT + terms * ANGLE_PRODUCT;
        (turned + rest, (self.error + rounding * U32) * (1.0 + 2.0 * U32 * terms))
    }

    /// Triangles added.
    pub fn terms(&self) -> u32 {
        self.terms
    }
}

/// A complex number times the power of two that puts its larger part into 1 to 2.
#[inline(always)]
fn scaled(real: f32, imaginary: f32) -> (f32, f32) {
    let size = greater(real.abs(), imaginary.abs());
    let exponent = size.to_bits() & 0x7F80_0000;
    let scale = f32::from_bits(0x7F00_0000u32.wrapping_sub(exponent));
    (real * scale, imaginary * scale)
}

/// Bound of the error of an angle of which rounding is not a small part.
#[inline(never)]
fn error_of_near(sine: f32, cosine: f32, product: f32) -> f32 {
    let size = greater(sine.abs(), cosine.abs());
    let off = SOLID_ANGLE * U32 * product;
    // Else the true fraction may be on either side of the angle's jump, or 0/0.
    let is_certain = 2.0 * off <= size && (cosine > 0.0 || sine.abs() > off);
    if is_certain { TWO_ARCSINES * off / size } else { LARGEST_ANGLE }
}

/// Bound of the change of a solid angle while the corners of its triangle move.
#[inline(never)]
fn flux_through_edges(
    [a, b, c]: [Vec3; 3],
    [sine, cosine, product]: [f32; 3],
    x: f32,
    moved: f32,
) -> f32 {
    let far = flux_through_far_edges([a, b, c], x, moved);
    let off = SOLID_ANGLE * U32 * product;
    if far < f32::INFINITY {
        far
    } else if cosine > off || is_clear_of_plane([a, b, c], sine.abs() - off, moved) {
        flux_through_edge(a, b, moved)
            + flux_through_edge(b, c, moved)
            + flux_through_edge(c, a, moved)
    } else {
        f32::INFINITY
    }
}

/// The same of a far triangle: the area that its edges sweep over the least squared distance.
/// Infinite if it may be near. `x` is the length of `a`.
fn flux_through_far_edges([a, b, c]: [Vec3; 3], x: f32, moved: f32) -> f32 {
    // A difference of corners carries the rounding of both.
    let [e, g] = [b - a, c - a].map(|edge| norm_1(edge) * (1.0 + 16.0 * U32) + x * (16.0 * U32));
    let nearest = x * (1.0 - 16.0 * U32) - greater(e, g) - moved;
    if nearest > 0.5 * x {
        moved * (2.0 * (e + g) + 6.0 * moved) / (nearest * nearest) * (1.0 + 16.0 * U32)
    } else {
        f32::INFINITY
    }
}

/// Bound of the change of the solid angle by one edge whose ends move. Infinite if the edge may be
/// nearer than eight times `moved`, of which `margin` holds one. With all edges farther than that,
/// a triangle that touches the origin has an angle of at least 7/8 of 2π, so its cosine is negative
/// (§20).
fn flux_through_edge(a: Vec3, b: Vec3, moved: f32) -> f32 {
    let ab = b - a;
    let (along, length_sq) = (-a.dot(ab), ab.dot(ab));
    let nearest = if along <= 0.0 || length_sq < TRUSTED_DIRECTION_SQ {
        a
    } else if along >= length_sq {
        b
    } else {
        a + ab * (along / length_sq)
    };
    let margin = EDGE_DISTANCE * U32 * (norm_1(a) + norm_1(b)) + moved;
    let distance = sqrt_approx(nearest.dot(nearest)) - margin;
    if distance >= 7.0 * moved {
        let view_angle = lesser(PI_UP, (norm_1(ab) + 2.0 * moved) / distance);
        moved * view_angle / distance * (1.0 + 16.0 * U32)
    } else {
        f32::INFINITY
    }
}

/// Whether a triangle's plane is certainly farther than `moved`, if `sine` is a lower bound of the
/// corners' triple product.
fn is_clear_of_plane([a, b, c]: [Vec3; 3], sine: f32, moved: f32) -> bool {
    let rounding = (norm_1(a) + norm_1(b) + norm_1(c)) * (8.0 * U32);
    let [e, g] = [b - a, c - a].map(|edge| norm_1(edge) + rounding);
    sine > moved * (e * g) * (1.0 + 16.0 * U32)
}

/// π, rounded up.
const PI_UP: f32 = 3.141_592_8;
