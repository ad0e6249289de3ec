//! Point and fan, one triangle after the other, for targets without vectors.
//!
//! The terms of a spoke serve the two triangles beside it (Galin & Akkouche 2005, 4.1). Two slips
//! of the paper: in 4.3, where `s = p − p₀`, a triangle is skipped if both products are *negative*,
//! and `r_a` is `a²`. Regions after Ericson, *Real-Time Collision Detection* (2005), 5.1.5, in the
//! order in which the wide kernel overrides them.

use super::lanes::WIDTH;
use crate::num::tolerance::LEAST_DENOMINATOR;
use crate::num::{Real, SOFT_FLOAT, difference, dot, greater, reals, sqrt_approx};
use glam::Vec3;

/// The distance of a point and a triangle, as computed (`core/docs/rounding.md` §8).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearness {
    /// Squared length of the residual `s − v·e − w·g`.
    pub distance_sq: f32,
    /// Bound of a supporting plane: the squared distance is not below this, up to rounding.
    pub lower_bound_sq: f32,
    /// The closest point is `centre + v·e + w·g`.
    pub v: f32,
    /// See [`v`](Self::v).
    pub w: f32,
}

/// Terms of a spoke for the triangles on both of its sides.
#[derive(Clone, Copy, Debug)]
pub struct SpokeTerms {
    /// From the centre to the ring vertex.
    pub edge: Vec3,
    /// `s · edge`.
    pub(crate) along: f32,
}

/// The least number above 0.
pub const ABOVE_ZERO: f32 = f32::from_bits(1);

/// A fan seen from a point.
#[derive(Clone, Copy, Debug)]
pub struct PointFan {
    /// From the centre to the point.
    pub(crate) s: Vec3,
    /// `s · s`.
    pub centre_sq: f32,
}

impl PointFan {
    /// `s` is the point less the centre.
    #[inline(always)]
    pub fn new(s: Vec3) -> Self {
        PointFan { s, centre_sq: dot(s, s) }
    }

    /// Terms of the spoke `edge` (ring vertex less centre).
    #[inline(always)]
    pub fn spoke(&self, edge: Vec3) -> SpokeTerms {
        SpokeTerms { edge, along: dot(edge, self.s) }
    }

    /// A triangle lies beyond a squared limit if [`along`](SpokeTerms::along) of both its spokes is
    /// below this, by the supporting plane across the way to its centre. If the centre itself does
    /// not, it is [`ABOVE_ZERO`]: below that the centre is the closest point. The limit must allow
    /// for rounding already.
    ///
    /// No root: |s|·L ≤ (|s|²/k + L²·k)/2 for any k. k is 1, or 4 next to the surface. Proof:
    /// `core/docs/rounding.md` §8, "What a fan leaves out".
    #[inline(always)]
    pub fn culled_below(&self, limit: f32) -> f32 {
        let (far, near) =
            (0.5 * (self.centre_sq - limit), 0.875 * self.centre_sq - (limit + limit));
        let along = greater(far, near);
        if along > 0.0 { along } else { ABOVE_ZERO }
    }

    /// The squared distance if the centre is the closest point of the triangle between two spokes,
    /// as [`Self::triangle`] computes it.
    #[inline(always)]
    pub fn at_centre(&self, a: &SpokeTerms, b: &SpokeTerms) -> Option<f32> {
        if self.is_at_centre(a, b) { Some(self.centre_sq) } else { None }
    }

    #[inline(always)]
    fn is_at_centre(&self, a: &SpokeTerms, b: &SpokeTerms) -> bool {
        Real(a.along).is_at_most_zero() && Real(b.along).is_at_most_zero()
    }

    /// A triangle whose closest point is the centre, as [`Self::triangle`] computes it.
    #[inline(always)]
    pub fn centre(&self) -> Nearness {
        let distance_sq = self.centre_sq;
        Nearness { distance_sq, lower_bound_sq: distance_sq, v: 0.0, w: 0.0 }
    }

    /// The triangle between two spokes. On degenerate triangles it finds a point of the remaining
    /// segment or point, and the lower bound is lower where that point may not be the closest.
    #[inline(always)]
    pub fn triangle(&self, a: &SpokeTerms, b: &SpokeTerms) -> Nearness {
        if self.is_at_centre(a, b) { self.centre() } else { self.off_centre(a, b).0 }
    }

    /// The same of a triangle whose closest point is not the centre, and the residual: the way from
    /// the closest point to the query.
    #[inline(always)]
    pub fn off_centre(&self, a: &SpokeTerms, b: &SpokeTerms) -> (Nearness, Vec3) {
        let s = self.s;
        triangle_of_numbers(
            (s.x, s.y),
            s.z,
            (a.edge.x, a.edge.y),
            (a.edge.z, a.along),
            (b.edge.x, b.edge.y),
            (b.edge.z, b.along),
        )
    }
}

/// [`PointFan::off_centre`]. Where code is to be small all share it: numbers in pairs are
/// passed in registers, records are not.
#[cfg_attr(meshsweep_small, inline(never))]
#[cfg_attr(not(meshsweep_small), inline(always))]
fn triangle_of_numbers(
    (sx, sy): (f32, f32),
    sz: f32,
    (ex, ey): (f32, f32),
    (ez, d1): (f32, f32),
    (gx, gy): (f32, f32),
    (gz, d2): (f32, f32),
) -> (Nearness, Vec3) {
    let (s, first, second) = (Vec3::new(sx, sy, sz), Vec3::new(ex, ey, ez), Vec3::new(gx, gy, gz));
    let (d1, d2, zero) = (Real(d1), Real(d2), Real::ZERO);
    // Not kept with the spokes: a fan leaves out more spokes than two triangles share.
    let (aa, cc) = (Real(dot(first, first)), Real(dot(second, second)));
    let bb = Real(dot(first, second));
    let (d3, d4, d5, d6) = (d1 - aa, d2 - bb, d1 - bb, d2 - cc);
    let (v, w, r);
    if d3.is_at_least_zero() && d4 <= d3 {
        // Without the products by 1 and 0: the same numbers, up to the sign of a zero.
        (v, w, r) = (Real(1.0), zero, difference(s, first));
    } else if d6.is_at_least_zero() && d5 <= d6 {
        (v, w, r) = (zero, Real(1.0), difference(s, second));
    } else {
        let (nv, nw);
        // Without an FPU a comparison may spare the products: then they are not at most 0.
        let knows_first = !SOFT_FLOAT || d1.is_at_least_zero() && d3.is_at_most_zero();
        let knows_second = !SOFT_FLOAT || d2.is_at_least_zero() && d6.is_at_most_zero();
        let (first_area, second_area) = (|| d1 * d4 - d3 * d2, || d5 * d2 - d1 * d6);
        let vc = if knows_first { first_area() } else { Real(1.0) };
        let vb = if knows_second { second_area() } else { Real(1.0) };
        let least;
        if vc.is_at_most_zero() && d1.is_at_least_zero() && d3.is_at_most_zero() {
            (nv, nw, least) = (d1, zero, aa);
        } else if vb.is_at_most_zero() && d2.is_at_least_zero() && d6.is_at_most_zero() {
            (nv, nw, least) = (zero, d2, cc);
        } else {
            let va = d3 * d6 - d5 * d4;
            let (e, g) = (d4 - d3, d5 - d6);
            if va.is_at_most_zero() && e.is_at_least_zero() && g.is_at_least_zero() {
                (nv, nw, least) = (g, e, e + g);
            } else {
                // A coordinate that rounding made negative counts as 0: the point must lie on
                // the triangle.
                let vc = if knows_first { vc } else { first_area() };
                let vb = if knows_second { vb } else { second_area() };
                let (pa, pb, pc) = (greater(zero, va), greater(zero, vb), greater(zero, vc));
                (nv, nw, least) = (pb, pc, pa + pb + pc);
            }
        }
        // A part of a triangle that f32 cannot tell from a point. The dividend is smaller
        // still.
        let inverse = Real(1.0 / greater(Real(LEAST_DENOMINATOR), least).0);
        (v, w) = (nv * inverse, nw * inverse);
        r = residual(s, first, second, v.0, w.0);
    }
    let distance_sq = dot(r, r);
    let (ra, rb) = (Real(dot(r, first)), Real(dot(r, second)));
    let support = greater(greater(zero, ra), rb);
    let slack = support - (v * ra + w * rb);
    let lower_bound_sq = (Real(distance_sq) - (slack + slack)).0;
    (Nearness { distance_sq, lower_bound_sq, v: v.0, w: w.0 }, r)
}

/// [`PointFan::triangle`] as a call, for questions with few triangles: no second copy of the
/// kernel. Where code is to be small the kernel is a call already.
#[cfg_attr(meshsweep_small, inline(always))]
#[cfg_attr(not(meshsweep_small), inline(never))]
pub fn lone_triangle(fan: &PointFan, a: &SpokeTerms, b: &SpokeTerms) -> Nearness {
    fan.triangle(a, b)
}

/// A sliver again, whose lower bound falls far short of its distance. There the kernel's weights
/// are differences of nearly equal numbers. The projection into the plane starts from the residual,
/// so that its rounding is the rounding of a short way. The edges, each by itself, are always
/// well-conditioned. The result is the nearest of these points. `lower_bound_sq` stays.
#[inline(never)]
pub fn refined(&[s, e, g]: &[Vec3; 3], near: &Nearness) -> Nearness {
    // A place without an area to project into is none.
    let mut places = [(-1.0, 0.0); 4];
    let [in_plane, on_first, on_second, on_rim] = &mut places;
    let normal = cross(e, g);
    let area_sq = dot(normal, normal);
    if area_sq > LEAST_DENOMINATOR {
        let r = residual(s, e, g, near.v, near.w);
        let v = near.v + dot(cross(r, g), normal) / area_sq;
        let w = near.w + dot(cross(e, r), normal) / area_sq;
        if v + w <= 1.0 {
            *in_plane = (v, w);
        }
    }
    on_first.0 = share(s, e);
    *on_second = (0.0, share(s, g));
    let w = share(difference(s, e), difference(g, e));
    *on_rim = (1.0 - w, w);
    let mut best = *near;
    // By reference: at `opt-level = "s"` an iterator of values is a copy.
    for &(v, w) in &places {
        let r = residual(s, e, g, v, w);
        let distance_sq = dot(r, r);
        if v >= 0.0 && w >= 0.0 && distance_sq < best.distance_sq {
            (best.distance_sq, best.v, best.w) = (distance_sq, v, w);
        }
    }
    best
}

/// The place along an edge that is nearest to a point, which is `from` its begin.
#[cfg_attr(meshsweep_small, inline(never))]
#[cfg_attr(not(meshsweep_small), inline(always))]
fn share(from: Vec3, edge: Vec3) -> f32 {
    let along = greater(0.0, dot(from, edge));
    let share = along / greater(LEAST_DENOMINATOR, dot(edge, edge));
    if share < 1.0 { share } else { 1.0 }
}

#[inline(always)]
fn residual(s: Vec3, e: Vec3, g: Vec3, v: f32, w: f32) -> Vec3 {
    let (v, w) = (Real(v), Real(w));
    let ([sx, sy, sz], [ex, ey, ez], [gx, gy, gz]) = (reals(s), reals(e), reals(g));
    let (x, y, z) = (sx - v * ex - w * gx, sy - v * ey - w * gy, sz - v * ez - w * gz);
    Vec3::new(x.0, y.0, z.0)
}

#[inline(always)]
fn cross(a: Vec3, b: Vec3) -> Vec3 {
    let ([ax, ay, az], [bx, by, bz]) = (reals(a), reals(b));
    let (x, y, z) = (ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx);
    Vec3::new(x.0, y.0, z.0)
}

/// A triangle's normal. If both spokes have whole coordinates it is exact but for one rounding: the
/// terms of a needle nearly cancel.
fn normal(e: Vec3, g: Vec3) -> Vec3 {
    // Spokes on a grid are below 2^17. Above 2^30 a sum of two products might not fit.
    let most = (1 << 30) as f32;
    if !(is_integer(e, most) && is_integer(g, most)) {
        return cross(e, g);
    }
    Vec3::new(
        integer_difference((e.y, g.z), (e.z, g.y)),
        integer_difference((e.z, g.x), (e.x, g.z)),
        integer_difference((e.x, g.y), (e.y, g.x)),
    )
}

/// Whether all coordinates are whole numbers below `most`.
#[cfg_attr(meshsweep_small, inline(never))]
pub(crate) fn is_integer(v: Vec3, most: f32) -> bool {
    let parts: &[f32; 3] = v.as_ref();
    parts.iter().all(|&x| x as i32 as f32 == x && x.abs() < most)
}

/// The difference of two products of whole numbers, rounded once.
#[cfg_attr(meshsweep_small, inline(never))]
#[cfg_attr(not(meshsweep_small), inline(always))]
fn integer_difference((a, b): (f32, f32), (c, d): (f32, f32)) -> f32 {
    let product = |a: f32, b: f32| i64::from(a as i32) * i64::from(b as i32);
    let mut difference = product(a, b) - product(c, d);
    if !cfg!(meshsweep_small) {
        return difference as f32;
    }
    // Less code than the library's. What is cut leaves a one, so that the rest is rounded as the
    // whole: it keeps 29 bits.
    let mut unit = 1.0;
    while difference != i64::from(difference as i32) {
        let rest = i64::from(difference & 3 != 0);
        difference = difference >> 2 | rest;
        unit *= 4.0;
    }
    difference as i32 as f32 * unit
}

/// All triangles of a leaf, in order. `s` gives the point less the first or the second centre,
/// `spoke(i)` ring vertex `i` less the centre of triangle `i` (or of the triangle before, for the
/// last), `turn` is where the second fan begins (`count` or more: nowhere).
#[inline(always)]
pub fn point_leaf(
    count: usize,
    turn: usize,
    s: [Vec3; 2],
    spoke: impl Fn(usize, usize) -> Vec3,
    mut each: impl FnMut(usize, Nearness),
) {
    let [first, second] = s;
    let mut fan = PointFan::new(first);
    let mut centre = 0;
    let mut a = fan.spoke(spoke(0, 0));
    for i in 0..count.min(WIDTH) {
        if i == turn {
            fan = PointFan::new(second);
            centre = 1;
            a = fan.spoke(spoke(i, 1));
        }
        let b = fan.spoke(spoke(i + 1, centre));
        each(i, lone_triangle(&fan, &a, &b));
        a = b;
    }
}

/// A lower bound of the distance of a triangle, tight on slivers and next to the surface: the best
/// of its plane and of supporting planes along the residual and along the residual made orthogonal
/// to each edge. `s` is the point less the centre, `e` and `g` are the spokes.
///
/// It holds for any triangle up to the rounding that `FAN_DISTANCE` covers. `near` is what
/// [`refined`] finds. Cost: six roots.
#[inline]
pub fn lower_bound(seen: &[Vec3; 3], near: &Nearness) -> f32 {
    lower_bound_up_to(seen, near, f32::INFINITY)
}

/// [`lower_bound`], or less of it: a bound whose square is at least `enough_sq`. The residual's
/// plane comes first, which mostly is enough: one root.
#[inline]
pub fn lower_bound_up_to(seen: &[Vec3; 3], near: &Nearness, enough_sq: f32) -> f32 {
    let &[s, e, g] = seen;
    let r = residual(s, e, g, near.v, near.w);
    let mut best = 0.0;
    for plane in 0..6 {
        let edge = match plane {
            0 => Vec3::ZERO,
            3 => e,
            4 => g,
            _ => g - e,
        };
        let direction = match plane {
            1 => {
                let normal = normal(e, g);
                if dot(normal, s) < 0.0 { -normal } else { normal }
            }
            // Along `s` too: a triangle that `reach` leaves out must be as far here.
            2 => s,
            // The residual, or less its part along an edge.
            _ => {
                let length_sq = dot(edge, edge);
                let share =
                    if length_sq > LEAST_DENOMINATOR { dot(r, edge) / length_sq } else { 0.0 };
                r - edge * share
            }
        };
        best = greater(best, supported(direction, seen));
        if best * best >= enough_sq {
            break;
        }
    }
    best
}

/// Distance of the supporting plane across `direction`; 0 if `direction` has no length.
#[inline(never)]
fn supported(direction: Vec3, &[s, e, g]: &[Vec3; 3]) -> f32 {
    let largest = greater(greater(direction.x.abs(), direction.y.abs()), direction.z.abs());
    if largest > LEAST_DENOMINATOR {
        // Of length about 1, so that no square leaves f32's range.
        let d = direction * (1.0 / largest);
        (dot(d, s) - greater(greater(0.0, dot(d, e)), dot(d, g))) / sqrt_approx(dot(d, d))
    } else {
        0.0
    }
}
