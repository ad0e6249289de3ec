//! Pieces of triangles: their size, and how they are cut.

use glam::DVec3;

/// Part of a coordinate by which the parts of a piece may miss it after [`DEEPEST`] cuts. The point
/// of a cut is rounded: each cut adds less than 2.2 · 2^-51.
pub(super) const MIDPOINTS: f64 = 1.0 / (1u64 << 36) as f64;

/// Most cuts behind a piece. A deeper one keeps its bound.
pub(super) const DEEPEST: u32 = 14_000;

/// The centre of a triangle, and the distance of its farthest corner from there.
pub(super) fn ball(corners: &[DVec3; 3]) -> (DVec3, f64) {
    let [a, b, c] = *corners;
    let centre = (a + b + c) / 3.0;
    (centre, corners.iter().map(|p| (*p - centre).length()).fold(0.0, f64::max))
}

/// The parts of a piece on both sides of an edge of `along`, seen along its normal: of the edge
/// that the piece reaches over farthest. `None` if it reaches over none.
pub(super) fn cut(corners: [DVec3; 3], along: [DVec3; 3]) -> Option<[[DVec3; 3]; 3]> {
    let [p, q, r] = along;
    let normal = (q - p).cross(r - p);
    let over = |(from, to): (DVec3, DVec3)| {
        let out = (to - from).cross(normal).normalize_or_zero();
        let heights = corners.map(|v| out.dot(v - from));
        let high = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let low = heights.iter().copied().fold(f64::INFINITY, f64::min);
        (high.min(-low), heights)
    };
    let edges = [(p, q), (q, r), (r, p)].map(over);
    let (most, heights) = edges.into_iter().max_by(|a, b| a.0.total_cmp(&b.0))?;
    let size = (corners[1] - corners[0]).abs().max((corners[2] - corners[0]).abs()).max_element();
    if most.is_nan() || most <= SHAVING * size {
        return None;
    }
    // The corner that is alone on its side.
    let alone =
        (0..3).find(|&k| (0..3).all(|i| i == k || (heights[i] > 0.0) != (heights[k] > 0.0)))?;
    let [a, b, c] = [0, 1, 2].map(|k| corners[(alone + k) % 3]);
    let [ha, hb, hc] = [0, 1, 2].map(|k| heights[(alone + k) % 3]);
    let x = a + (b - a) * (ha / (ha - hb)).clamp(0.0, 1.0);
    let y = a + (c - a) * (ha / (ha - hc)).clamp(0.0, 1.0);
    Some([[a, x, y], [x, b, c], [x, c, y]])
}

/// Part of a piece's size that is too little to cut off.
const SHAVING: f64 = 1e-6;

/// Two halves, cut across the longest edge.
pub(super) fn bisect([a, b, c]: [DVec3; 3]) -> [[DVec3; 3]; 2] {
    let (ab, bc, ca) =
        ((b - a).length_squared(), (c - b).length_squared(), (a - c).length_squared());
    let [p, q, r] = if ab >= bc && ab >= ca {
        [a, b, c]
    } else if bc >= ca {
        [b, c, a]
    } else {
        [c, a, b]
    };
    let middle = (p + q) * 0.5;
    [[p, middle, r], [middle, q, r]]
}
