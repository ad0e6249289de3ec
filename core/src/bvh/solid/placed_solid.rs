//! A solid in the units of a tree, from the tree's origin.

use crate::bvh::tree::extended::extended;
use crate::bvh::tree::format::Bvh;
use crate::bvh::tree::stored_lengths::StoredLengths;
use crate::geom::{ConvexGap, Point, convex_gap, cross, dot, minus, norm_1};
use crate::num::tolerance::{
    MOVING_CORNER, OVERLAP_FARTHEST, OVERLAP_INTERVAL, OVERLAP_UNDERFLOW, U32, U64,
};
use crate::num::{down_to_f32, exp2, greater, lesser, up_to_f32};
use crate::query::{DIRECTIONS, Extended, Interval, ModelFrame, QueryError, Solid};

type Place = Point<f64>;

/// Direction of the solid's first axis among the six.
pub(super) const FIRST_AXIS: usize = 3;

/// A solid, and the ways of its corners if it moves.
pub(super) struct PlacedSolid {
    /// At the start.
    from: [Place; Solid::MOST_CORNERS],
    /// The path of each corner.
    paths: [Place; Solid::MOST_CORNERS],
    count: usize,
    pub(super) radius: f64,
    pub(super) lengths: StoredLengths,
    /// How far a corner that moves may be from its computed place.
    pub(super) rounding: f64,
    /// Rounding of a corner's speed along a direction (§19, Motion).
    pub(super) speed_rounding: f64,
    /// Six directions, and the rounding of the tree's intervals along them: the tree's axes, then
    /// the solid's, which are orthonormal up to their rounding to f32.
    pub(super) directions: ModelFrame,
    /// The solid's extent along the directions, at all times of its motion, without the radius.
    pub(super) low: [f32; DIRECTIONS],
    pub(super) high: [f32; DIRECTIONS],
    /// Along the first axis, the greatest place of a corner at the start.
    pub(super) start: f64,
    /// How fast corners move along the first axis, at most. Not negative.
    pub(super) speed: f64,
    tree: Extended,
}

impl PlacedSolid {
    /// No solid.
    pub(super) const NONE: PlacedSolid = PlacedSolid {
        from: [[0.0; 3]; Solid::MOST_CORNERS],
        paths: [[0.0; 3]; Solid::MOST_CORNERS],
        count: 0,
        radius: 0.0,
        lengths: StoredLengths { error: 0.0, unit: 1.0 },
        rounding: 0.0,
        speed_rounding: 0.0,
        directions: ModelFrame {
            rows: [[0.0; 3]; DIRECTIONS],
            shift: [0.0; DIRECTIONS],
            origin: [0.0; 3],
            grow: [0.0; DIRECTIONS],
            unit: 1.0,
        },
        low: [0.0; DIRECTIONS],
        high: [0.0; DIRECTIONS],
        start: 0.0,
        speed: 0.0,
        tree: Extended { exponent: 0, origin: [0.0; 3], extent: [0.0; 3], error: 0.0 },
    };

    /// Places a solid at rest, or one that moves from `solid` to `end`. In place, for a copy takes
    /// two kilobytes of the stack.
    #[inline(never)]
    pub(super) fn set(
        &mut self,
        tree: &Bvh<'_>,
        solid: &Solid<'_>,
        end: Option<&Solid<'_>>,
    ) -> Result<(), QueryError> {
        if !tree.serves_segments() {
            return Err(QueryError::NO_SEGMENTS);
        }
        let count = solid.corners().len();
        let moved = end.map_or(count, |end| end.corners().len());
        if moved != count || count > Solid::MOST_CORNERS {
            return Err(QueryError::Corners { found: u32::try_from(moved).unwrap_or(u32::MAX) });
        }
        let stored = extended(tree);
        let scale = exp2(stored.exponent.wrapping_neg());
        let [ox, oy, oz] = stored.origin;
        let inward = |[x, y, z]: [f32; 3]| {
            let [x, y, z] = [x, y, z].map(|x| f64::from(x) * scale);
            [x - ox, y - oy, z - oz]
        };
        self.count = count;
        self.lengths = StoredLengths::of(tree);
        self.directions.origin = stored.origin.map(|x| x as f32);
        self.tree = stored;
        let radius = end.map_or(solid.radius(), |end| greater(solid.radius(), end.radius()));
        self.radius = self.lengths.inward(radius);
        let mut farthest = 0f64;
        let ends = end.map_or(solid.corners(), Solid::corners);
        let places = self.from.iter_mut().zip(&mut self.paths);
        for ((from, path), (&at, &to)) in places.zip(solid.corners().iter().zip(ends)) {
            let to = inward(to);
            *from = inward(at);
            *path = minus(to, *from);
            let far = from.iter().chain(&to).fold(0.0, |far, x| greater(far, x.abs()));
            farthest = greater(farthest, far);
        }
        if farthest > OVERLAP_FARTHEST || self.radius > OVERLAP_FARTHEST {
            return Err(QueryError::OutOfDomain);
        }
        self.rounding = MOVING_CORNER * U64 * farthest;
        let longest = self.paths().iter().copied().map(norm_1).fold(0.0, greater);
        self.speed_rounding = longest * (8.0 * U64);
        self.set_directions(farthest);
        Ok(())
    }

    /// The corners at the start.
    pub(super) fn corners(&self) -> &[Place] {
        self.from.get(..self.count).unwrap_or(&[])
    }

    fn paths(&self) -> &[Place] {
        self.paths.get(..self.count).unwrap_or(&[])
    }

    /// The distance of the hull of the corners from a triangle, at a parameter of the motion.
    #[inline(never)]
    pub(super) fn gap_at(&self, t: f64, triangle: &[Place; 3]) -> ConvexGap {
        let mut at = self.from;
        for (at, path) in at.iter_mut().zip(self.paths()) {
            for (x, path) in at.iter_mut().zip(path) {
                *x += path * t;
            }
        }
        convex_gap(at.get(..self.count).unwrap_or(&[]), triangle)
    }

    /// The greatest component of a corner's path along a direction.
    pub(super) fn speed_along(&self, direction: Place) -> f64 {
        self.paths().iter().map(|&path| dot(direction, path)).fold(f64::NEG_INFINITY, greater)
    }

    /// Whether no corner moves.
    pub(super) fn is_still(&self) -> bool {
        self.paths().iter().all(|path| *path == [0.0; 3])
    }

    /// Chooses the solid's axes and its extent along all directions. `far`: the greatest
    /// coordinate.
    fn set_directions(&mut self, far: f64) {
        let [x, y, z] = [[1.0f32, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let [u, v, w] = self.axes();
        self.directions.rows = [x, y, z, u, v, w];
        let rounding = 32.0 * U64 * far;
        for (direction, row) in self.directions.rows.into_iter().enumerate() {
            let row = row.map(f64::from);
            let [a, b, c] = row.map(f64::abs);
            let [kx, ky, kz] = self.tree.extent;
            let most = (a * kx + b * ky) + c * kz;
            let grow = most * (OVERLAP_INTERVAL * f64::from(U32)) + OVERLAP_UNDERFLOW;
            let (mut low, mut high, mut start) =
                (f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY);
            for (from, path) in self.corners().iter().zip(self.paths()) {
                let (from, moved) = (dot(row, *from), dot(row, *path));
                low = lesser(low, lesser(from, from + moved));
                high = greater(high, greater(from, from + moved));
                start = greater(start, from);
            }
            if let Some(slot) = self.directions.grow.get_mut(direction) {
                *slot = up_to_f32(grow);
            }
            if let Some(slot) = self.low.get_mut(direction) {
                *slot = down_to_f32(low - rounding);
            }
            if let Some(slot) = self.high.get_mut(direction) {
                *slot = up_to_f32(high + rounding);
            }
            if direction == FIRST_AXIS {
                self.start = start + rounding;
                self.speed = greater(0.0, self.speed_along(row) + rounding);
            }
        }
    }

    /// Three unit vectors across each other, rounded to f32. The first one is along the motion, or
    /// along the longest edge from the first corner. The second one is along the longest of these,
    /// without its part along the first.
    fn axes(&self) -> [[f32; 3]; 3] {
        let first = self.corners().first().copied().unwrap_or_default();
        let edges = || self.corners().iter().map(|&corner| minus(corner, first));
        let paths = || self.paths().iter().copied();
        let leading = if self.is_still() { longest(edges()) } else { longest(paths()) };
        let u = unit(leading).unwrap_or([1.0, 0.0, 0.0]);
        let across = longest(edges().chain(paths()).map(|edge| without(edge, u)));
        // An axis of the grid that is not along the first one.
        let [x, y, _] = u.map(f64::abs);
        let spare = if x < 0.6 {
            [1.0, 0.0, 0.0]
        } else if y < 0.6 {
            [0.0, 1.0, 0.0]
        } else {
            [0.0, 0.0, 1.0]
        };
        let second = |edge: Place| unit(without(unit(edge)?, u));
        let v = second(across).filter(|v| dot(*v, u).abs() < 1e-9);
        let v = v.or_else(|| second(spare)).unwrap_or([0.0, 1.0, 0.0]);
        let w = cross(u, v);
        [u, v, w].map(|axis| axis.map(|x| x as f32))
    }

    /// A place in input units.
    pub(super) fn to_input(&self, [x, y, z]: Place) -> [f32; 3] {
        let [a, b, c] = self.tree.origin;
        [x + a, y + b, z + c].map(|x| ((x * self.lengths.unit) as f32).clamp(-f32::MAX, f32::MAX))
    }

    /// The distance of the input, from bounds for the hull of the corners.
    pub(super) fn distance(&self, lower: f64, upper: f64) -> Interval {
        let lower = self.lengths.lower(lower - self.radius);
        Interval::new(lower, self.lengths.upper_about(upper, self.radius))
    }
}

fn longest(vectors: impl Iterator<Item = Place>) -> Place {
    vectors.fold([0.0; 3], |most, v| if dot(v, v) > dot(most, most) { v } else { most })
}

/// A vector of length 1; `None` if it has no length that f64 can divide by.
fn unit(v: Place) -> Option<Place> {
    let largest = v.iter().fold(0.0, |largest, x| greater(largest, x.abs()));
    let scaled = v.map(|x| x / largest);
    let length = libm::sqrt(dot(scaled, scaled));
    (largest > f64::MIN_POSITIVE && length.is_finite()).then(|| scaled.map(|x| x / length))
}

/// Without its component along a unit vector.
fn without(v: Place, [a, b, c]: Place) -> Place {
    let [x, y, z] = v;
    let along = dot(v, [a, b, c]);
    [x - a * along, y - b * along, z - c * along]
}
