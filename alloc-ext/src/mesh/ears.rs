//! How a polygon becomes triangles: the fan about its first corner where that is right, else ears.
//!
//! A polygon of n corners always gives n − 2 triangles, so numbers of triangles do not depend on
//! the way. Libraries for ears drop corners on straight edges, which opens a slit to the neighbour
//! there, and they round. Here orientations are exact (`robust`), and the result is checked: no
//! triangle is turned over, and no two overlap in the plane of two axes that shows most of the
//! polygon. With n − 2 triangles and the polygon as their boundary, they then are the polygon.
//!
//! Source: G. H. Meisters, *Polygons have ears* (1975).

use glam::DVec3;
use robust::{Coord, orient2d};

/// How a polygon is split.
#[derive(Debug, PartialEq)]
pub(super) enum Split {
    /// The fan about the first corner is the polygon.
    Fan,
    /// These triangles are the polygon; corners count from 0.
    Ears(Vec<[usize; 3]>),
    /// The polygon crosses itself, perhaps because it is warped.
    Unsound,
    /// It is not convex, and has too many corners.
    TooLarge,
}

/// Most corners of a polygon that is not convex. The search takes time with the square of them:
/// about a second for this number.
pub(super) const MOST_CORNERS: usize = 10_000;

/// Most corners that are tested as ears, for each corner of the polygon. A polygon that does not
/// touch itself needs three. The others are for bridges to holes.
const TESTS_PER_CORNER: usize = 8;

/// Splits a polygon of four or more corners.
pub(super) fn split(corners: &[[f64; 3]]) -> Split {
    let outline = Outline::new(corners);
    if outline.is_convex() {
        return Split::Fan;
    }
    if corners.len() > MOST_CORNERS {
        return Split::TooLarge;
    }
    if outline.is_made_of((1..corners.len() - 1).map(|k| [0, k, k + 1])) {
        return Split::Fan;
    }
    let is_right = |ears: &Vec<[usize; 3]>| outline.is_made_of(ears.iter().copied());
    let plain = Clipping::new(&outline).run().filter(is_right);
    // An antenna outside of the polygon makes an ear of the corner at its foot.
    let ears = plain.or_else(|| Clipping::new(&outline).without_antennas().run().filter(is_right));
    ears.map_or(Split::Unsound, Split::Ears)
}

/// A polygon seen along an axis, counter-clockwise.
struct Outline(Vec<Coord<f64>>);

impl Outline {
    fn new(corners: &[[f64; 3]]) -> Self {
        let from_first = |p: [f64; 3]| DVec3::from(p) - DVec3::from(corners[0]);
        let fan = corners.windows(2).map(|pair| from_first(pair[0]).cross(from_first(pair[1])));
        let area: DVec3 = fan.sum();
        let axis = area.abs().max_position();
        let [mut x, mut y] = [(axis + 1) % 3, (axis + 2) % 3];
        if area[axis] < 0.0 {
            std::mem::swap(&mut x, &mut y);
        }
        Self(corners.iter().map(|p| Coord { x: p[x], y: p[y] }).collect())
    }

    fn turn(&self, [a, b, c]: [usize; 3]) -> f64 {
        orient2d(self.0[a], self.0[b], self.0[c])
    }

    /// No corner turns right, and the outline goes around once.
    fn is_convex(&self) -> bool {
        let mut distinct = self.0.clone();
        distinct.dedup();
        if distinct.len() > 1 && distinct.first() == distinct.last() {
            distinct.pop();
        }
        let count = distinct.len();
        let at = |k: usize| distinct[k % count];
        // A second turn around would change the direction along x four times.
        let mut directions =
            (0..count).map(|k| at(k + 1).x - at(k).x).filter(|&d| d != 0.0).map(|d| d > 0.0);
        let first = directions.next();
        let mut last = first;
        let mut changes = 0;
        for direction in directions.chain(first) {
            changes += usize::from(last != Some(direction));
            last = Some(direction);
        }
        changes <= 2 && (0..count).all(|k| orient2d(at(k), at(k + 1), at(k + 2)) >= 0.0)
    }

    /// No triangle is turned over, and no two overlap.
    fn is_made_of(&self, triangles: impl Iterator<Item = [usize; 3]> + Clone) -> bool {
        if !triangles.clone().all(|triangle| self.turn(triangle) >= 0.0) {
            return false;
        }
        let range = |values: [f64; 3]| {
            let [a, b, c] = values;
            [a.min(b).min(c), a.max(b).max(c)]
        };
        let boxed = |triangle: [usize; 3]| {
            let corners = triangle.map(|k| self.0[k]);
            (triangle, range(corners.map(|p| p.x)), range(corners.map(|p| p.y)))
        };
        let has_area = |triangle: &[usize; 3]| self.turn(*triangle) > 0.0;
        let mut by_x: Vec<_> = triangles.filter(has_area).map(boxed).collect();
        by_x.sort_by(|(_, a, _), (_, b, _)| a[0].total_cmp(&b[0]));
        let mut active: Vec<usize> = Vec::new();
        for (k, &(triangle, x, y)) in by_x.iter().enumerate() {
            active.retain(|&other| by_x[other].1[1] > x[0]);
            let meets = |&other: &usize| {
                let (other, _, other_y) = by_x[other];
                other_y[1] > y[0] && other_y[0] < y[1] && self.overlap(triangle, other)
            };
            if active.iter().any(meets) {
                return false;
            }
            active.push(k);
        }
        true
    }

    /// Whether the insides of two triangles meet: then no side of either has the other beyond it.
    fn overlap(&self, first: [usize; 3], second: [usize; 3]) -> bool {
        let is_beyond = |[a, b, c]: [usize; 3], other: [usize; 3]| {
            let sides = [[a, b], [b, c], [c, a]];
            sides.iter().any(|&[a, b]| other.iter().all(|&p| self.turn([a, b, p]) <= 0.0))
        };
        !is_beyond(first, second) && !is_beyond(second, first)
    }
}

/// An outline from which ears are cut.
struct Clipping<'a> {
    outline: &'a Outline,
    next: Vec<usize>,
    previous: Vec<usize>,
    /// Whether the corner is an ear, where that is known.
    is_ear: Vec<Option<bool>>,
    tests_left: usize,
    /// A corner that is not cut off.
    first: usize,
    ears: Vec<[usize; 3]>,
}

impl<'a> Clipping<'a> {
    fn new(outline: &'a Outline) -> Self {
        let count = outline.0.len();
        Self {
            outline,
            next: (0..count).map(|k| (k + 1) % count).collect(),
            previous: (0..count).map(|k| (k + count - 1) % count).collect(),
            is_ear: vec![None; count],
            tests_left: TESTS_PER_CORNER * count,
            first: 0,
            ears: Vec::with_capacity(count - 2),
        }
    }

    /// Cuts off corners at which the outline turns back on itself: triangles without area.
    fn without_antennas(mut self) -> Self {
        let (mut corner, mut passed) = (0, 0);
        while passed < self.outline.0.len() && !self.is_done() {
            if self.turns_back(corner) {
                let before = self.previous[corner];
                self.cut(corner);
                // The rest of the antenna ends there.
                (corner, passed) = (before, 0);
            } else {
                corner = self.next[corner];
                passed += 1;
            }
        }
        self.first = corner;
        self
    }

    /// Whether the side after a corner lies on that before it, or is none.
    fn turns_back(&self, corner: usize) -> bool {
        let around = self.around(corner);
        let [a, b, c] = around.map(|k| self.outline.0[k]);
        // Exact signs: differences of the axes are of opposite signs, or zero.
        let is_back =
            |from: f64, at: f64, to: f64| (from <= at && to <= at) || (from >= at && to >= at);
        self.outline.turn(around) == 0.0 && is_back(a.x, b.x, c.x) && is_back(a.y, b.y, c.y)
    }

    /// As many triangles as the outline has corners, less two; none if an ear is not found.
    fn run(mut self) -> Option<Vec<[usize; 3]>> {
        let count = self.outline.0.len();
        for corner in 0..count {
            // A corner that is given twice is no corner.
            if self.next[self.previous[corner]] != corner {
                continue;
            }
            if self.outline.0[corner] == self.outline.0[self.next[corner]] && !self.is_done() {
                self.cut(corner);
            }
        }
        let mut corner = self.next[self.previous[self.first]];
        // An answer about an ear may have changed since it was found.
        let mut is_stale = false;
        let mut passed = 0;
        while !self.is_done() {
            if self.test(corner)? {
                corner = self.cut(corner);
                (passed, is_stale) = (0, true);
            } else if passed <= count {
                corner = self.next[corner];
                passed += 1;
            } else if is_stale {
                self.is_ear.fill(None);
                (passed, is_stale) = (0, false);
            } else {
                // The rest has a corner on a straight edge, or a spike. Else it crosses itself.
                corner = self.flat_corner(corner)?;
                corner = self.cut(corner);
                (passed, is_stale) = (0, true);
            }
        }
        Some(self.ears)
    }

    fn is_done(&self) -> bool {
        self.ears.len() + 2 == self.outline.0.len()
    }

    fn around(&self, corner: usize) -> [usize; 3] {
        [self.previous[corner], corner, self.next[corner]]
    }

    /// Cuts a corner off, and returns the one after the next: then no corner gets all ears.
    fn cut(&mut self, corner: usize) -> usize {
        let ear @ [a, _, c] = self.around(corner);
        self.ears.push(ear);
        self.next[a] = c;
        self.previous[c] = a;
        self.is_ear[a] = None;
        self.is_ear[c] = None;
        self.next[c]
    }

    /// Whether the corner is an ear; none if too many were tested.
    fn test(&mut self, corner: usize) -> Option<bool> {
        if let Some(known) = self.is_ear[corner] {
            return Some(known);
        }
        self.tests_left = self.tests_left.checked_sub(1)?;
        let found = self.find(corner);
        self.is_ear[corner] = Some(found);
        Some(found)
    }

    /// The corner turns left, and its triangle has no other corner in it or on it.
    fn find(&self, corner: usize) -> bool {
        let Outline(points) = self.outline;
        let ear @ [a, b, c] = self.around(corner);
        if self.outline.turn(ear) <= 0.0 {
            return false;
        }
        let [p, q, r] = ear.map(|k| points[k]);
        let (low_x, high_x) = (p.x.min(q.x).min(r.x), p.x.max(q.x).max(r.x));
        let (low_y, high_y) = (p.y.min(q.y).min(r.y), p.y.max(q.y).max(r.y));
        let mut other = self.next[c];
        while other != a {
            let at = points[other];
            let is_near = low_x <= at.x && at.x <= high_x && low_y <= at.y && at.y <= high_y;
            // A bridge to a hole has its corners twice.
            if is_near
                && ![p, q, r].contains(&at)
                && [[a, b], [b, c], [c, a]]
                    .iter()
                    .all(|&[a, b]| self.outline.turn([a, b, other]) >= 0.0)
            {
                return false;
            }
            other = self.next[other];
        }
        true
    }

    fn flat_corner(&self, from: usize) -> Option<usize> {
        let mut corner = from;
        loop {
            if self.outline.turn(self.around(corner)) == 0.0 {
                return Some(corner);
            }
            corner = self.next[corner];
            if corner == from {
                return None;
            }
        }
    }
}
