//! Segment and fan, one triangle after the other: the kernel for targets without vectors, and the
//! decision about the triangles that either kernel flags.
//!
//! Watertight after Woop, Benthin & Wald (*Watertight Ray/Triangle Intersection*, 2013): the
//! segment's line becomes the third axis by a shear, and a triangle is met if the origin lies in
//! its shadow. The shadow of a vertex depends on the vertex and the segment only, and the cross
//! product of two shadows has the right sign or is 0 under any rounding. So triangles with common
//! vertices leave no gap between them.
//!
//! The cross product of a spoke is the term `(s ∧ d)·eₖ` that Galin & Akkouche (2005, 3.1) share
//! between the triangles beside it. Slips of the paper: `u` and `v` have the wrong sign in 3.1 (3.3
//! has them right), `(c ∧ b)·a` there is `(b ∧ c)·a`, in 3.2 `n` is `(o − p₀) ∧ d`, and step 2 of
//! 3.3 must let a product of 0 pass. A segment in a triangle's plane, which 3.3 drops, is decided
//! here.
//!
//! Margins for rounding and the surface error: `core/docs/rounding.md` §9.

use super::lanes::WIDTH;
use crate::num::tolerance::{
    FAN_PARAMETER, FAN_SHEAR, LEAST_DENOMINATOR, PRODUCT_UNDERFLOW, STILL, U32,
};
use crate::num::{greater, lesser};
use glam::Vec3;

/// A segment as fans see it, grid units: a line, sheared into the third axis, and a range of
/// parameters from 0.
#[derive(Clone, Copy, Debug)]
pub struct FanRay {
    /// The shadow plane's axes, then the dominant one.
    axes: [usize; 3],
    /// In the order of `axes`.
    origin: [f32; 3],
    shear: [f32; 2],
    /// Parameter of a unit along the dominant axis.
    inverse: f32,
    /// Error of an edge function, in units of the edge's 1-norm.
    doubt: f32,
    /// Error of the parameter of a vertex.
    slack: f32,
    /// Greatest parameter.
    end: f32,
    /// The ends of the segment may be moved by the surface error, each on its own way. Then the
    /// segment may turn.
    may_turn: bool,
}

/// A common point of a segment and a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// The parameter, if `stored`.
    pub t: f32,
    /// The input's triangle is not met before this parameter.
    pub lower: f32,
    /// If the input's triangle is met, it is met not after this parameter.
    pub upper: f32,
    /// The stored triangle is met, as computed.
    pub stored: bool,
    /// It is proved that the input's triangle is met.
    pub certain: bool,
    /// If the line meets the input's triangle, then within the range of parameters.
    pub within: bool,
}

/// A vertex in the shadow plane, with its parameter.
#[derive(Clone, Copy, Debug)]
pub struct Shadow {
    x: f32,
    y: f32,
    t: f32,
}

/// An edge seen from the line: twice the signed area between them, and the error of this area.
#[derive(Clone, Copy, Debug)]
struct Side {
    area: f32,
    doubt: f32,
}

impl Side {
    /// Two numbers by their bits, so that signs are joined without a branch: the first is negative
    /// if the line is clear of the edge to the one side, the second if it is to the other. Of two
    /// different numbers the difference is never 0.
    #[inline(always)]
    fn signs(self) -> [i32; 2] {
        let bits = |x: f32| x.to_bits().cast_signed();
        [bits(self.doubt - self.area), bits(self.doubt + self.area)]
    }
}

#[inline(always)]
fn pick<T: Copy>(v: [T; 3], axis: usize) -> T {
    let [x, y, z] = v;
    [x, y, z, z][axis & 3]
}

impl FanRay {
    /// The line through `origin` along `direction` with its reciprocals (components below [`STILL`]
    /// replaced), for parameters from 0 to `end`. `surface`: how far the input's surface and the
    /// line may be from the given ones. `size`: the 1-norm of the way to the farthest vertex.
    #[inline(always)]
    pub fn new(
        origin: [f32; 3],
        direction: [f32; 3],
        inverse: [f32; 3],
        end: f32,
        surface: f32,
        size: f32,
    ) -> Self {
        let [x, y, z] = direction;
        let (x, y, z) = (x.abs(), y.abs(), z.abs());
        let first = usize::from(x < y);
        let axis = if greater(x, y) >= z { first } else { 2usize };
        let (u, v) = ([1, 2, 0, 0][axis & 3], [2, 0, 1, 0][axis & 3]);
        let along = pick(inverse, axis);
        FanRay {
            axes: [u, v, axis],
            origin: [pick(origin, u), pick(origin, v), pick(origin, axis)],
            shear: [pick(direction, u) * along, pick(direction, v) * along],
            inverse: along,
            // √3, rounded up: the most that the shear stretches a length.
            doubt: 1.7321 * surface + (FAN_SHEAR * U32 * size + LEAST_DENOMINATOR),
            slack: (surface + (4.0 * U32 * size + LEAST_DENOMINATOR)) * along.abs(),
            end,
            may_turn: false,
        }
    }

    /// The same for a segment whose direction is known up to the surface error only.
    #[inline(always)]
    pub fn turning(self, may_turn: bool) -> Self {
        FanRay { may_turn, ..self }
    }

    /// Greatest parameter.
    #[inline(always)]
    pub fn end(&self) -> f32 {
        self.end
    }

    /// The axes that a kernel's coordinates come in.
    #[inline(always)]
    pub fn axes(&self) -> [usize; 3] {
        self.axes
    }

    /// The line's origin in that order.
    #[inline(always)]
    pub fn origin(&self) -> [f32; 3] {
        self.origin
    }

    /// Multiples of the third coordinate to subtract from the first two.
    #[inline(always)]
    pub fn shear(&self) -> [f32; 2] {
        self.shear
    }

    /// Error of an edge function, in units of the edge's 1-norm.
    #[inline(always)]
    pub fn doubt(&self) -> f32 {
        self.doubt
    }

    /// Three values, one for each axis, in the order of [`axes`](Self::axes).
    #[inline(always)]
    pub fn in_order<T: Copy>(&self, values: [T; 3]) -> [T; 3] {
        let [u, v, w] = self.axes;
        [pick(values, u), pick(values, v), pick(values, w)]
    }

    /// The shadow of a vertex.
    #[cfg_attr(meshsweep_wide, inline(always))]
    pub fn shadow(&self, vertex: Vec3) -> Shadow {
        self.shadow_in_order(self.in_order(vertex.to_array()))
    }

    /// The shadow of a vertex whose coordinates come in the order of [`axes`](Self::axes).
    #[inline(always)]
    pub fn shadow_in_order(&self, [x, y, z]: [f32; 3]) -> Shadow {
        let [ox, oy, oz] = self.origin;
        let (x, y, z) = (x - ox, y - oy, z - oz);
        let [sx, sy] = self.shear;
        Shadow { x: x - sx * z, y: y - sy * z, t: z * self.inverse }
    }

    /// The edge from `a` to `b`.
    #[inline(always)]
    fn side(&self, a: Shadow, b: Shadow) -> Side {
        let (x, y) = (b.x - a.x, b.y - a.y);
        Side {
            area: a.x * y - a.y * x,
            doubt: self.doubt * (x.abs() + y.abs()) + PRODUCT_UNDERFLOW,
        }
    }

    /// Which side of the triangle the segment comes from: 1 if corners in counter-clockwise order
    /// seen from the segment's start span a positive area.
    #[inline(always)]
    pub fn front(&self) -> f32 {
        if self.inverse < 0.0 { 1.0 } else { -1.0 }
    }

    /// Decides about one triangle. `wanted`: the sign of the areas that count, 0 for both. `None`:
    /// proved clear of it, or culled.
    ///
    /// A segment in the triangle's plane is never certain, nor is a triangle without area. They are
    /// met, as computed, where their shadow, a line, runs through the origin. With a wanted facing
    /// they are not met, for they have none.
    #[inline(never)]
    pub fn crossing(&self, [a, b, c]: [Shadow; 3], wanted: f32) -> Option<Crossing> {
        let near = |p: f32, q: f32, r: f32| {
            let (low, high) = (lesser(r, lesser(q, p)), greater(r, greater(q, p)));
            (low <= self.doubt) & (high >= -self.doubt)
        };
        if !(near(a.x, b.x, c.x) & near(a.y, b.y, c.y)) {
            return None;
        }
        let (first, last) = (lesser(c.t, lesser(b.t, a.t)), greater(c.t, greater(b.t, a.t)));
        let rounding = FAN_PARAMETER * U32 * greater(last.abs(), first.abs()) + self.slack;
        let (mut lower, mut upper) = (first - rounding, last + rounding);
        if upper < 0.0 || lower > self.end {
            return None;
        }
        let (p, q, r) = (self.side(b, c), self.side(c, a), self.side(a, b));
        let total = p.area + q.area + r.area;
        let doubt = p.doubt + q.doubt + r.doubt;
        let plain = total.abs() >= doubt + doubt;
        let (mut t, mut certain) = (first, false);
        if plain {
            // Neither so thin nor so steep that the plane does not give the parameter.
            let share = 1.0 / total;
            let flat = (p.area * share) * a.t + (q.area * share) * b.t + (r.area * share) * c.t;
            let spread = 0.75 * ((last - first) * (doubt / (total.abs() - doubt))) + rounding;
            lower = greater(flat - spread, lower);
            upper = lesser(flat + spread, upper);
            if upper < 0.0 || lower > self.end {
                return None;
            }
            t = lesser(last, greater(first, flat));
            let inside = |sign: f32| {
                (sign * p.area > p.doubt) & (sign * q.area > q.doubt) & (sign * r.area > r.doubt)
            };
            let sign = if total < 0.0 { -1.0 } else { 1.0 };
            if inside(sign) {
                let within = (lower >= 0.0) & (upper <= self.end);
                let is_wanted = sign * wanted >= 0.0;
                // A segment that may turn keeps the facing only if its ends cannot pass the plane.
                if !is_wanted && (within | !self.may_turn) {
                    return None;
                }
                certain = within & is_wanted;
            }
        }
        let within = (lower >= 0.0) & (upper <= self.end);
        let (wa, wb, wc) = (cross(b, c), cross(c, a), cross(a, b));
        let positive = (wa >= 0.0) & (wb >= 0.0) & (wc >= 0.0);
        let negative = (wa <= 0.0) & (wb <= 0.0) & (wc <= 0.0);
        let mut stored = (positive & (wanted >= 0.0)) | (negative & (wanted <= 0.0));
        if positive & negative {
            stored = false;
            if wanted == 0.0
                && let Some((enter, leave)) = in_plane([a, b, c])
                && leave >= 0.0
            {
                (t, stored) = (greater(0.0, enter), true);
            }
        } else if stored & !plain {
            let total = wa + wb + wc;
            // A triangle so thin that its weights are only rounding is met where it begins.
            if total.abs() > STILL {
                let share = 1.0 / total;
                let inside = (wa * share) * a.t + (wb * share) * b.t + (wc * share) * c.t;
                t = lesser(last, greater(first, inside));
            }
        }
        stored &= (t >= 0.0) & (t <= self.end);
        Some(Crossing {
            t,
            lower: greater(0.0, lower),
            upper: lesser(self.end, upper),
            stored: stored | certain,
            certain,
            within,
        })
    }

    /// How often a way from `a` to `b` runs around the line, counted where it crosses one side of
    /// the shadow plane's first axis: 1, 0 or -1. `None` if the way may meet the line.
    fn turns(&self, a: Shadow, b: Shadow) -> Option<i32> {
        let side = self.side(a, b);
        let d = self.doubt;
        let left = (a.x < -d) & (b.x < -d);
        let right = (a.x > d) & (b.x > d);
        let beside = ((a.y < -d) & (b.y < -d)) | ((a.y > d) & (b.y > d));
        if left | beside {
            return Some(0);
        }
        let rises = (a.y <= 0.0) & (b.y > 0.0);
        let falls = (a.y > 0.0) & (b.y <= 0.0);
        let clear = side.area.abs() > side.doubt;
        if !(right | clear) {
            return None;
        }
        let passes = |towards: bool| right | towards;
        Some(
            i32::from(rises & passes(side.area > 0.0)) - i32::from(falls & passes(side.area < 0.0)),
        )
    }

    /// How often the shadow of some triangles of a fan covers the line, counted with sign, for all
    /// vertices within rounding and surface error. Spokes between two of the triangles cancel out.
    /// All other edges must be clear of the line; `None` if one is not.
    ///
    /// `lanes` has the bits of triangles `first..end` of the fan with this centre.
    pub fn cover(
        &self,
        centre: Shadow,
        ring: impl Fn(usize) -> Shadow,
        lanes: u32,
        first: usize,
        end: usize,
    ) -> Option<i32> {
        let mut turns = 0;
        for i in first..end.min(WIDTH) {
            let has = |lane: usize| lanes >> lane & 1 != 0;
            if has(i) {
                let (from, to) = (ring(i), ring(i + 1));
                turns += self.turns(from, to)?;
                if i == first || !has(i - 1) {
                    turns += self.turns(centre, from)?;
                }
                if i + 1 == end || !has(i + 1) {
                    turns += self.turns(to, centre)?;
                }
            }
        }
        Some(turns)
    }
}

/// First and last parameter of a triangle at the origin, if its shadow is a line.
#[cold]
fn in_plane([a, b, c]: [Shadow; 3]) -> Option<(f32, f32)> {
    let mut range: Option<(f32, f32)> = None;
    let mut corners = [a, b, c];
    for _ in 0..3 {
        let [p, q, r] = corners;
        corners = [q, r, p];
        let between = |u: f32, v: f32| (u <= 0.0 && v >= 0.0) || (u >= 0.0 && v <= 0.0);
        if !(between(p.x, q.x) && between(p.y, q.y)) {
            continue;
        }
        let (from, to) = (p.x.abs() + p.y.abs(), q.x.abs() + q.y.abs());
        let (mut low, mut high) = (lesser(q.t, p.t), greater(q.t, p.t));
        if from + to > 0.0 {
            let t = p.t + (q.t - p.t) * (from / (from + to));
            let t = lesser(high, greater(low, t));
            (low, high) = (t, t);
        }
        range = Some(match range {
            None => (low, high),
            Some((first, last)) => (lesser(low, first), greater(high, last)),
        });
    }
    range
}

/// Twice the signed area that an edge spans with the origin: of opposite sign, bit for bit, for the
/// opposite edge.
#[inline(always)]
fn cross(a: Shadow, b: Shadow) -> f32 {
    a.x * b.y - a.y * b.x
}

/// A plane that a segment's line is a point of: the origin.
pub trait ShadowPlane {
    /// A vertex in the plane.
    type Shadow: Copy;

    /// An edge by two signs: the first is negative if the line is clear of the edge to the one
    /// side, the second if it is to the other.
    fn clear_sides(&self, from: Self::Shadow, to: Self::Shadow) -> [i32; 2];
}

impl ShadowPlane for FanRay {
    type Shadow = Shadow;

    #[inline(always)]
    fn clear_sides(&self, from: Shadow, to: Shadow) -> [i32; 2] {
        self.side(from, to).signs()
    }
}

/// Whether the segment's line may meet one triangle, as [`ray_leaf`] has it.
#[inline(always)]
pub fn may_meet<P: ShadowPlane>(plane: &P, centre: P::Shadow, ends: [P::Shadow; 2]) -> bool {
    let [from, to] = ends;
    let (a, b) = (plane.clear_sides(centre, from), plane.clear_sides(centre, to));
    let (one, other) = (a[0] | b[1], a[1] | b[0]);
    if one & other < 0 {
        return false;
    }
    let rim = plane.clear_sides(from, to);
    (one | rim[0]) & (other | rim[1]) >= 0
}

/// Triangles of a leaf that the segment's line may meet, a bit for each. The others are proved
/// clear of the line.
///
/// `centres` and `ring` are shadows of vertices, `turn` is where the second fan begins (at the
/// ring's end or later: nowhere). A spoke serves the triangles on both sides, and the outer edge is
/// computed only if the spokes leave the triangle open.
#[inline(always)]
pub fn ray_leaf<P: ShadowPlane>(
    plane: &P,
    turn: usize,
    centres: [P::Shadow; 2],
    mut ring: impl Iterator<Item = P::Shadow>,
) -> u32 {
    let [mut centre, second] = centres;
    let Some(mut from) = ring.next() else { return 0 };
    let mut a = plane.clear_sides(centre, from);
    let mut lanes = 0;
    for (i, to) in ring.take(WIDTH).enumerate() {
        if i == turn {
            centre = second;
            a = plane.clear_sides(centre, from);
        }
        let b = plane.clear_sides(centre, to);
        // The last side runs from the ring to the centre: the spoke's, with the opposite sign.
        let (one, other) = (a[0] | b[1], a[1] | b[0]);
        if one & other >= 0 {
            let rim = plane.clear_sides(from, to);
            if (one | rim[0]) & (other | rim[1]) >= 0 {
                lanes |= 1 << i;
            }
        }
        (from, a) = (to, b);
    }
    lanes
}
