//! Where two faces that meet are only beside each other, in exact arithmetic.

use super::meeting::{shadow, turn};
use super::surface::Corners;
use crate::check::dyadic::Dyadic;
use crate::check::exact::side;
use crate::check::vector::{cross, dot, minus};
use std::cmp::Ordering;

/// What two faces with area share, if it is not more than this.
pub(super) enum Touch {
    /// A point at most.
    Point,
    /// Parts of edges of both: for each face whether its edges, by their first corners, are among
    /// them.
    Edges([[bool; 3]; 2]),
}

/// A number of the form a / b, b > 0.
struct Fraction(Dyadic, Dyadic);

impl Fraction {
    fn compare(&self, other: &Self) -> Ordering {
        let difference = &(&self.0 * &other.1) - &(&other.0 * &self.1);
        difference.sign().cmp(&0)
    }
}

/// How two faces with area touch; `None` if they share more.
pub(super) fn touch(s: &Corners, t: &Corners) -> Option<Touch> {
    let heights = |of: &Corners, about: &Corners| of.map(|p| side(*about, p).0);
    let (of_s, of_t) = (heights(s, t), heights(t, s));
    if of_s == [0; 3] {
        return flat(s, t).or_else(|| match flat(t, s)? {
            Touch::Edges([of_t, of_s]) => Some(Touch::Edges([of_s, of_t])),
            Touch::Point => Some(Touch::Point),
        });
    }
    let (on_s, on_t) = (level_edges(of_s), level_edges(of_t));
    if on_s.contains(&true) && on_t.contains(&true) {
        return Some(Touch::Edges([on_s, on_t]));
    }
    shares_a_point_at_most(s, t).then_some(Touch::Point)
}

/// Edges both ends of which have height 0.
fn level_edges(heights: [i8; 3]) -> [bool; 3] {
    [0, 1, 2].map(|k| heights[k] == 0 && heights[(k + 1) % 3] == 0)
}

/// Faces of one plane, with an edge of `s` between them.
fn flat(s: &Corners, t: &Corners) -> Option<Touch> {
    let axes = shadow(s)?;
    let up = turn(axes, s[0], s[1], s[2]);
    (0..3).find_map(|k| {
        let heights = t.map(|p| turn(axes, s[k], s[(k + 1) % 3], p) * up);
        let on_s = [0, 1, 2].map(|edge| edge == k);
        (heights.iter().all(|&height| height <= 0))
            .then(|| Touch::Edges([on_s, level_edges(heights)]))
    })
}

/// Whether the places on the line of two planes where the faces reach overlap in a point at most.
fn shares_a_point_at_most(s: &Corners, t: &Corners) -> bool {
    let exact = |of: &Corners| of.map(|p| p.map(Dyadic::from));
    let (s, t) = (exact(s), exact(t));
    let normal = |[a, b, c]: &[[Dyadic; 3]; 3]| cross(&minus(b, a), &minus(c, a));
    let along = cross(&normal(&s), &normal(&t));
    let (Some([from_s, to_s]), Some([from_t, to_t])) =
        (reach(&s, &t, &normal(&t), &along), reach(&t, &s, &normal(&s), &along))
    else {
        return true;
    };
    let from = if from_s.compare(&from_t) == Ordering::Less { from_t } else { from_s };
    let to = if to_s.compare(&to_t) == Ordering::Less { to_s } else { to_t };
    from.compare(&to) != Ordering::Less
}

/// From where to where along a line a face meets the plane of another, which has a normal.
fn reach(
    face: &[[Dyadic; 3]; 3],
    other: &[[Dyadic; 3]; 3],
    normal: &[Dyadic; 3],
    along: &[Dyadic; 3],
) -> Option<[Fraction; 2]> {
    let heights = [0, 1, 2].map(|k| dot(normal, &minus(&face[k], &other[0])));
    let places = [0, 1, 2].map(|k| dot(along, &face[k]));
    let mut ends: Vec<Fraction> = Vec::new();
    for (i, j) in [(0, 1), (1, 2), (2, 0)] {
        if heights[i].sign() == 0 {
            ends.push(Fraction(places[i].clone(), Dyadic::from(1.0)));
        }
        if heights[i].sign() * heights[j].sign() < 0 {
            let (above, below) = if heights[i].sign() > 0 { (i, j) } else { (j, i) };
            let height = &heights[above] - &heights[below];
            let place = &(&places[below] * &heights[above]) - &(&places[above] * &heights[below]);
            ends.push(Fraction(place, height));
        }
    }
    ends.sort_by(Fraction::compare);
    let last = ends.pop()?;
    let first = ends.into_iter().next();
    let same = Fraction(last.0.clone(), last.1.clone());
    Some([first.unwrap_or(same), last])
}
