//! Whether all points of a triangle are within a distance of a surface.
//!
//! The distance from one triangle is convex. So a convex piece whose corners are near one triangle
//! of the surface is near as a whole. A piece that no single triangle proves is halved. Where the
//! surface is almost as far as it may be, halves would not end: such a piece loses the part that
//! lies above the nearest triangle, if that part is near.

use super::distance::{ABSOLUTE, ROUNDING, distance};
use glam::DVec3;

/// Triangles in a leaf.
const LEAF: usize = 4;

/// A piece is cut along the edges of the nearest triangle if the limit exceeds its distance by less
/// than this fraction of its radius. Otherwise it is halved.
const TIGHT: f64 = 0.125;

/// Least length of the cut part above that triangle, as a fraction of the piece's.
const PART: f64 = 0.125;

/// Distances from a triangle that differ by less than this fraction do not tell where to halve.
const FLAT: f64 = 1e-3;

/// Pieces of one triangle.
const PIECES: usize = 1_000_000;

/// Whether all points are near.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Verdict {
    Within,
    /// This point is farther.
    Beyond(DVec3, f64),
    /// Pieces ran out.
    Undecided,
}

/// Triangles in boxes.
pub(crate) struct Near {
    triangles: Vec<[DVec3; 3]>,
    nodes: Vec<Node>,
}

struct Node {
    low: DVec3,
    high: DVec3,
    from: usize,
    to: usize,
    /// The other child; the first follows its parent. None of a leaf.
    second: Option<usize>,
}

impl Near {
    pub(crate) fn new(mut triangles: Vec<[DVec3; 3]>) -> Self {
        let mut nodes = Vec::new();
        let count = triangles.len();
        grow(&mut triangles, 0, count, &mut nodes);
        Self { triangles, nodes }
    }

    /// The nearest triangle and its distance; none of no triangles.
    fn nearest(&self, p: DVec3) -> Option<([DVec3; 3], f64)> {
        let mut best: Option<([DVec3; 3], f64)> = None;
        let mut open = vec![0];
        while let Some(index) = open.pop() {
            let Some(node) = self.nodes.get(index) else { continue };
            let away = (p - p.clamp(node.low, node.high)).length();
            if best.is_some_and(|(_, least)| away > least * ROUNDING + ABSOLUTE) {
                continue;
            }
            if let Some(second) = node.second {
                let first = &self.nodes[index + 1];
                let side = |node: &Node| (node.low + node.high).distance_squared(p * 2.0);
                let is_first = side(first) <= side(&self.nodes[second]);
                open.extend(if is_first { [second, index + 1] } else { [index + 1, second] });
                continue;
            }
            for &triangle in &self.triangles[node.from..node.to] {
                let d = distance(p, triangle);
                if best.is_none_or(|(_, least)| d < least) {
                    best = Some((triangle, d));
                }
            }
        }
        best
    }

    /// Whether all points of a triangle are within `limit` of the surface, up to what distances in
    /// `f64` may be off.
    pub(crate) fn within(&self, triangle: [DVec3; 3], limit: f64) -> Verdict {
        let most = limit * ROUNDING + ABSOLUTE;
        let mut open = vec![triangle.to_vec()];
        let mut pieces = 0;
        while let Some(piece) = open.pop() {
            pieces += 1;
            let centre = piece.iter().sum::<DVec3>() / piece.len() as f64;
            let radius = piece.iter().fold(0f64, |most, p| most.max(p.distance(centre)));
            let Some((near, d)) = self.nearest(centre) else {
                return Verdict::Beyond(centre, f64::INFINITY);
            };
            if d > most {
                return Verdict::Beyond(centre, d);
            }
            let by = |of: [DVec3; 3]| piece.iter().all(|&p| distance(p, of) <= most);
            if d + radius <= most || by(near) {
                continue;
            }
            let mut is_proved = false;
            for &p in &piece {
                let Some((near, d)) = self.nearest(p) else { continue };
                if d > most {
                    return Verdict::Beyond(p, d);
                }
                is_proved |= by(near);
            }
            if is_proved {
                continue;
            }
            if pieces >= PIECES {
                return Verdict::Undecided;
            }
            if most - d < TIGHT * radius && is_above(centre, near) {
                let (above, beside) = cut(piece.clone(), near);
                let is_near = above.iter().all(|&p| distance(p, near) <= most);
                if is_near && reach(&above) > PART * reach(&piece) {
                    open.extend(beside);
                    continue;
                }
            }
            open.extend(halves(&piece, centre, near));
        }
        Verdict::Within
    }
}

/// The longest way from the first corner to another.
fn reach(piece: &[DVec3]) -> f64 {
    piece.iter().fold(0.0, |most, p| p.distance(piece[0]).max(most))
}

/// The planes through a triangle's edges across it: a point, and the normal inwards.
fn walls([a, b, c]: [DVec3; 3]) -> [(DVec3, DVec3); 3] {
    let normal = (b - a).cross(c - a);
    [(a, b), (b, c), (c, a)].map(|(from, to)| (from, normal.cross(to - from)))
}

/// Whether a point is above or below a triangle.
fn is_above(p: DVec3, triangle: [DVec3; 3]) -> bool {
    walls(triangle).iter().all(|(from, inward)| inward.dot(p - from) >= 0.0)
}

/// The part of a piece above or below a triangle, and the convex parts beside it.
fn cut(piece: Vec<DVec3>, triangle: [DVec3; 3]) -> (Vec<DVec3>, Vec<Vec<DVec3>>) {
    let (mut above, mut beside) = (piece, Vec::new());
    for (from, inward) in walls(triangle) {
        // Rounding leaves no sliver beside.
        let room = 0.25 * ABSOLUTE * inward.length();
        let [inner, outer] = parts(&above, |p| inward.dot(p - from) + room);
        beside.push(outer);
        above = inner;
    }
    beside.retain(|part| part.len() > 2);
    (above, beside)
}

/// Both halves of a piece, one nearer to a triangle than the other: where two triangles are equally
/// far along a line, long pieces beside the line are near one of them. If no half is nearer, along
/// the longest side of the piece's box.
fn halves(piece: &[DVec3], centre: DVec3, triangle: [DVec3; 3]) -> [Vec<DVec3>; 2] {
    let away: Vec<f64> = piece.iter().map(|&p| distance(p, triangle)).collect();
    let mean = away.iter().sum::<f64>() / away.len() as f64;
    let rise: DVec3 = piece.iter().zip(&away).map(|(&p, d)| (p - centre) * (d - mean)).sum();
    let [least, most] = [f64::min, f64::max].map(|of| away.iter().copied().fold(mean, of));
    let nearer = parts(piece, |p| rise.dot(p - centre));
    if most - least > FLAT * mean && nearer.iter().all(|half| half.len() > 2) {
        return nearer;
    }
    let first = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) = piece.iter().fold(first, |(low, high), &p| (low.min(p), high.max(p)));
    let axis = longest(high - low);
    let middle = 0.5 * (low[axis] + high[axis]);
    parts(piece, |p| p[axis] - middle)
}

/// The parts of a convex polygon with heights of at least and of at most 0.
fn parts(piece: &[DVec3], height: impl Fn(DVec3) -> f64) -> [Vec<DVec3>; 2] {
    let [mut inner, mut outer] = [Vec::new(), Vec::new()];
    if piece.iter().all(|&p| height(p) >= 0.0) {
        return [piece.to_vec(), outer];
    }
    for (k, &p) in piece.iter().enumerate() {
        let next = piece[(k + 1) % piece.len()];
        let (h, g) = (height(p), height(next));
        if h >= 0.0 {
            inner.push(p);
        }
        if h <= 0.0 {
            outer.push(p);
        }
        if (h > 0.0 && g < 0.0) || (h < 0.0 && g > 0.0) {
            let at = p + (next - p) * (h / (h - g));
            inner.push(at);
            outer.push(at);
        }
    }
    [inner, outer]
}

/// The axis of the largest coordinate.
fn longest(size: DVec3) -> usize {
    (0..3).max_by(|&i, &j| size[i].total_cmp(&size[j])).unwrap_or(0)
}

/// A node of `triangles[from..to]` and all below, halved along the longest side of its box.
fn grow(all: &mut [[DVec3; 3]], from: usize, to: usize, nodes: &mut Vec<Node>) -> usize {
    let index = nodes.len();
    let first = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) =
        all[from..to].iter().flatten().fold(first, |(low, high), &p| (low.min(p), high.max(p)));
    nodes.push(Node { low, high, from, to, second: None });
    if to - from > LEAF {
        let size = high - low;
        let axis = longest(size);
        let key = |t: &[DVec3; 3]| t[0][axis] + t[1][axis] + t[2][axis];
        let middle = (to - from) / 2;
        all[from..to].select_nth_unstable_by(middle, |a, b| key(a).total_cmp(&key(b)));
        grow(all, from, from + middle, nodes);
        nodes[index].second = Some(grow(all, from + middle, to, nodes));
    }
    index
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plate(height: f64) -> [[DVec3; 3]; 2] {
        let [a, b, c, d] =
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| DVec3::new(x, y, height));
        [[a, b, c], [a, c, d]]
    }

    #[test]
    fn a_plate_over_another_is_within_its_height_and_no_less() {
        // The first one's triangles cross the diagonal of the second.
        let turned = plate(0.25).map(|t| t.map(|p| DVec3::new(1.0 - p.x, p.y, p.z)));
        let surface = Near::new(plate(0.0).to_vec());
        for triangle in turned {
            assert_eq!(surface.within(triangle, 0.25), Verdict::Within);
            assert!(matches!(surface.within(triangle, 0.249), Verdict::Beyond(..)));
        }
        let level = turned.map(|t| t.map(|p| p.with_z(0.0)));
        assert!(level.iter().all(|&t| surface.within(t, 1e-13) == Verdict::Within));
    }

    #[test]
    fn one_far_corner_is_beyond() {
        let surface = Near::new(plate(0.0).to_vec());
        let far = [DVec3::ZERO, DVec3::X, DVec3::new(2.0, 2.0, 0.0)];
        assert_eq!(surface.within(far, 2f64.sqrt()), Verdict::Within);
        assert!(matches!(surface.within(far, 1.41), Verdict::Beyond(..)));
    }
}
