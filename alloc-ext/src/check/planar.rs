//! Convex polygons in a plane, cut in exact arithmetic.
//!
//! A corner is the crossing of two lines, in homogeneous coordinates. Cuts bring no other lines
//! than their own, so numbers do not grow from cut to cut.

use super::dyadic::Dyadic;
use super::vector::{cross, dot};

/// A line `a·s + b·t + c`, at least 0 on its inner side.
#[derive(Clone, Debug)]
pub(crate) struct Line {
    exact: [Dyadic; 3],
    near: [f64; 3],
}

impl Line {
    pub(crate) fn new(exact: [Dyadic; 3]) -> Self {
        let near = exact.each_ref().map(Dyadic::rounded);
        Self { exact, near }
    }

    fn of_numbers(numbers: [f64; 3]) -> Self {
        Self { exact: numbers.map(Dyadic::from), near: numbers }
    }

    fn flipped(&self) -> Self {
        let zero = Dyadic::from(0.0);
        Self { exact: self.exact.each_ref().map(|x| &zero - x), near: self.near.map(|x| -x) }
    }

    /// Sign of the line's value at a corner.
    fn sign(&self, corner: &Corner) -> i8 {
        let [a, b, c] = self.near;
        let [s, t] = corner.near;
        let (value, size) = (a * s + b * t + c, (a * s).abs() + (b * t).abs() + c.abs());
        // A dozen roundings at most; a product that underflows is not trusted.
        if value.abs() > 64.0 * f64::EPSILON * size && size > 1e-250 {
            return if value > 0.0 { 1 } else { -1 };
        }
        dot(&self.exact, &corner.exact).sign()
    }

    /// Sign of the line's value at a place.
    pub(crate) fn sign_at(&self, [s, t]: &[Dyadic; 2]) -> i8 {
        dot(&self.exact, &[s.clone(), t.clone(), Dyadic::from(1.0)]).sign()
    }
}

#[derive(Clone, Debug)]
struct Corner {
    /// The last one is above 0.
    exact: [Dyadic; 3],
    near: [f64; 2],
}

impl Corner {
    fn crossing(a: &Line, b: &Line) -> Self {
        let zero = Dyadic::from(0.0);
        let mut exact = cross(&a.exact, &b.exact);
        if exact[2].sign() < 0 {
            exact = exact.each_ref().map(|x| &zero - x);
        }
        let [x, y, w] = exact.each_ref().map(Dyadic::rounded);
        Self { exact, near: [x / w, y / w] }
    }
}

/// A convex polygon with an area.
#[derive(Clone, Debug)]
pub(crate) struct Polygon {
    corners: Vec<Corner>,
    /// From each corner to the next one.
    edges: Vec<Line>,
}

impl Polygon {
    /// Of all lines' inner sides in a row.
    fn around(edges: Vec<Line>) -> Self {
        let count = edges.len();
        let corners =
            (0..count).map(|k| Corner::crossing(&edges[(k + count - 1) % count], &edges[k]));
        Self { corners: corners.collect(), edges }
    }

    /// s ≥ 0, t ≥ 0, s + t ≤ 1.
    pub(crate) fn triangle() -> Self {
        Self::around(
            [[0.0, 1.0, 0.0], [-1.0, -1.0, 1.0], [1.0, 0.0, 0.0]].map(Line::of_numbers).into(),
        )
    }

    /// |s| ≤ size, |t| ≤ size.
    pub(crate) fn square(size: f64) -> Self {
        let lines = [[0.0, 1.0, size], [-1.0, 0.0, size], [0.0, -1.0, size], [1.0, 0.0, size]];
        Self::around(lines.map(Line::of_numbers).into())
    }

    /// Corners, rounded.
    pub(crate) fn corners(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.corners.iter().map(|corner| corner.near)
    }

    /// Whether a place is inside and on no edge.
    pub(crate) fn has_inside(&self, place: &[Dyadic; 2]) -> bool {
        self.edges.iter().all(|edge| edge.sign_at(place) > 0)
    }

    /// The parts on the inner and on the outer side of a line, as far as they have an area.
    fn halves(self, line: &Line) -> [Option<Self>; 2] {
        let signs: Vec<i8> = self.corners.iter().map(|corner| line.sign(corner)).collect();
        if !signs.contains(&-1) {
            return [Some(self), None];
        }
        if !signs.contains(&1) {
            return [None, Some(self)];
        }
        [Some(self.part(&signs, 1, line)), Some(self.part(&signs, -1, &line.flipped()))]
    }

    /// The part on which the line's sign is `side`, or 0. The line goes round the part, as all its
    /// edges do.
    fn part(&self, signs: &[i8], side: i8, line: &Line) -> Self {
        let mut part = Self { corners: Vec::new(), edges: Vec::new() };
        let count = signs.len();
        for (k, &sign) in signs.iter().enumerate() {
            let next = signs[(k + 1) % count];
            if sign == side || (sign == 0 && next == side) {
                part.corners.push(self.corners[k].clone());
                part.edges.push(self.edges[k].clone());
            } else if sign == 0 && signs[(k + count - 1) % count] == side {
                part.corners.push(self.corners[k].clone());
                part.edges.push(line.clone());
            }
            if sign == -next && sign != 0 {
                part.corners.push(Corner::crossing(&self.edges[k], line));
                part.edges.push(if sign == side { line.clone() } else { self.edges[k].clone() });
            }
        }
        part
    }

    /// What is inside of all lines.
    pub(crate) fn inside(self, lines: &[Line]) -> Option<Self> {
        lines.iter().try_fold(self, |rest, line| {
            let [inner, _] = rest.halves(line);
            inner
        })
    }

    /// What is outside of the area inside of all lines, in convex parts.
    pub(crate) fn minus(self, lines: &[Line]) -> Vec<Self> {
        let (mut outside, mut rest) = (Vec::new(), self.clone());
        for line in lines {
            let [inner, outer] = rest.halves(line);
            outside.extend(outer);
            match inner {
                Some(inner) => rest = inner,
                // Nothing is taken away.
                None => return vec![self],
            }
        }
        outside
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn right_of(s: f64) -> Line {
        Line::of_numbers([1.0, 0.0, -s])
    }

    fn area(polygon: &Polygon) -> f64 {
        let corners: Vec<_> = polygon.corners().collect();
        let next = corners.iter().cycle().skip(1);
        corners.iter().zip(next).map(|(a, b)| 0.5 * (a[0] * b[1] - a[1] * b[0])).sum()
    }

    #[test]
    fn parts_have_the_area_of_the_whole() {
        let window = [right_of(0.1), right_of(0.3).flipped(), Line::of_numbers([0.0, 1.0, -0.2])];
        for whole in [Polygon::triangle(), Polygon::square(0.5)] {
            let all = area(&whole);
            let inner = area(&whole.clone().inside(&window).expect("it has an area"));
            let outer: f64 = whole.minus(&window).iter().map(area).sum();
            assert!(inner > 0.0 && outer > 0.0 && (inner + outer - all).abs() < 1e-12);
        }
    }

    #[test]
    fn two_halves_that_touch_leave_nothing() {
        let left = Polygon::triangle().minus(&[right_of(0.3)]);
        assert_eq!(left.len(), 1);
        assert!(left[0].clone().minus(&[right_of(0.3).flipped()]).is_empty());
        let gap = left[0].clone().minus(&[right_of(0.3f64.next_down()).flipped()]);
        assert_eq!(gap.len(), 1);
    }

    #[test]
    fn a_line_through_corners_cuts_there() {
        let diagonal = Line::of_numbers([1.0, -1.0, 0.0]);
        let [one, other] = Polygon::square(1.0).halves(&diagonal).map(|half| half.expect("a half"));
        assert_eq!((one.corners.len(), other.corners.len()), (3, 3));
        assert!(area(&one) == 2.0 && area(&other) == 2.0);
        let place = [0.5, 0.0].map(Dyadic::from);
        assert!(one.has_inside(&place) && !other.has_inside(&place));
    }
}
