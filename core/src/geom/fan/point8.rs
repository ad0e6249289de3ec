//! Point and leaf, as many triangles at once as a register has lanes.
//!
//! Every branch of the scalar kernel is taken and selected, in the order that gives the same
//! result. Products and sums are written in the same order. So the bits are the same, and a test
//! checks it.
//!
//! The kernel is written once, over a register and its operations by name. An instruction beyond
//! those that the crate is compiled for cannot be an operator: a method of a trait is compiled for
//! no more than its crate.

use super::lanes::Lanes;

/// Triangles of a leaf as seen from a point, one in each lane. `[axis]`.
#[derive(Clone, Copy, Debug)]
pub struct Edges<L = Lanes> {
    /// From the triangle's own centre to ring vertex `i`.
    pub e: [L; 3],
    /// From the centre to ring vertex `i + 1`.
    pub g: [L; 3],
    /// The point less the centre.
    pub s: [L; 3],
}

impl Edges {
    /// Triangles that are points where the query is.
    pub const NONE: Edges = Edges { e: [Lanes::ZERO; 3], g: [Lanes::ZERO; 3], s: [Lanes::ZERO; 3] };
}

/// [`Nearness`](super::Nearness) of each lane.
#[derive(Clone, Copy, Debug)]
pub struct LaneNearness<L = Lanes> {
    /// Squared lengths of the residuals.
    pub distance_sq: L,
    /// Supporting planes' bounds.
    pub lower_bound_sq: L,
    /// Coordinates along the first spokes.
    pub v: L,
    /// Coordinates along the second spokes.
    pub w: L,
}

impl LaneNearness {
    /// No triangle.
    pub const NONE: LaneNearness = LaneNearness {
        distance_sq: UNUSED,
        lower_bound_sq: UNUSED,
        v: Lanes::ZERO,
        w: Lanes::ZERO,
    };
}

/// Squared distance where there is no triangle: 2^127.
pub(super) const UNUSED_SQ: f32 = f32::from_bits(0x7F00_0000);

/// The same in all lanes.
const UNUSED: Lanes = Lanes::splat(UNUSED_SQ);

/// Defines `point_lanes` for registers `$lanes`, whose operations are in scope. `$seen` is its
/// visibility.
macro_rules! define_point_lanes {
    ($(#[$attribute:meta])* $lanes:ty, $seen:vis) => {
        /// The triangles of lanes whose bits in `used` are ones. Other lanes give 2^127. `None` if
        /// all triangles lie beyond the squared limit, by the supporting planes across the ways to
        /// their centres.
        $(#[$attribute])*
        $seen fn point_lanes(
            edges: &Edges<$lanes>,
            used: $lanes,
            limit: Option<f32>,
        ) -> Option<LaneNearness<$lanes>> {
            let &Edges { e, g, s } = edges;
            let (zero, one) = (splat(0.0), splat(1.0));
            let d1 = dot(e, s);
            let d2 = dot(g, s);
            if let Some(limit) = limit {
                let centre_sq = dot(s, s);
                let least = sub(centre_sq, max(d2, max(d1, zero)));
                let is_near =
                    or(le(least, zero), le(mul(least, least), mul(centre_sq, splat(limit))));
                if !any(and(is_near, used)) {
                    return None;
                }
            }
            let aa = dot(e, e);
            let bb = dot(e, g);
            let cc = dot(g, g);
            let (d3, d4, d5, d6) = (sub(d1, aa), sub(d2, bb), sub(d1, bb), sub(d2, cc));
            let vc = sub(mul(d1, d4), mul(d3, d2));
            let vb = sub(mul(d5, d2), mul(d1, d6));
            let va = sub(mul(d3, d6), mul(d5, d4));
            let (along_e, along_g) = (sub(d4, d3), sub(d5, d6));
            let (pa, pb, pc) = (max(va, zero), max(vb, zero), max(vc, zero));
            let rim = and(and(le(va, zero), ge(along_e, zero)), ge(along_g, zero));
            let second = and(and(le(vb, zero), ge(d2, zero)), le(d6, zero));
            let first = and(and(le(vc, zero), ge(d1, zero)), le(d3, zero));
            let end = and(ge(d6, zero), le(d5, d6));
            let start = and(ge(d3, zero), le(d4, d3));
            let centre = and(le(d1, zero), le(d2, zero));
            let v = select(first, d1, and_not(second, select(rim, along_g, pb)));
            let w = and_not(first, select(second, d2, select(rim, along_e, pc)));
            let inner = select(rim, add(along_e, along_g), add(add(pa, pb), pc));
            let den = select(first, aa, select(second, cc, inner));
            let den = max(den, splat(LEAST_DENOMINATOR));
            // Corners: 0 and 1 in place of the weights, 1 in place of the denominator.
            let ring = or(end, start);
            let corner = or(ring, centre);
            let inverse = div(one, or(and_not(ring, den), and(ring, one)));
            let v = mul(or(and_not(corner, v), and_not(centre, and(start, one))), inverse);
            let w =
                mul(or(and_not(corner, w), and_not(or(start, centre), and(end, one))), inverse);
            let [ex, ey, ez] = e;
            let [gx, gy, gz] = g;
            let [sx, sy, sz] = s;
            let rx = sub(sub(sx, mul(v, ex)), mul(w, gx));
            let ry = sub(sub(sy, mul(v, ey)), mul(w, gy));
            let rz = sub(sub(sz, mul(v, ez)), mul(w, gz));
            let r = [rx, ry, rz];
            let r2 = dot(r, r);
            let ra = dot(r, e);
            let rb = dot(r, g);
            let support = max(rb, max(ra, zero));
            let slack = sub(support, add(mul(v, ra), mul(w, rb)));
            let certified = sub(r2, add(slack, slack));
            let unused = splat(UNUSED_SQ);
            Some(LaneNearness {
                distance_sq: select(used, r2, unused),
                lower_bound_sq: select(used, certified, unused),
                v,
                w,
            })
        }

        $(#[$attribute])*
        fn dot([ax, ay, az]: [$lanes; 3], [bx, by, bz]: [$lanes; 3]) -> $lanes {
            add(add(mul(ax, bx), mul(ay, by)), mul(az, bz))
        }
    };
}
pub(super) use define_point_lanes;
