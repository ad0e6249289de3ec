//! The hull hierarchy between two key frames (Guéziec 2000, 5.3).
//!
//! Each triangle keeps one point for each vertex of its part of the surface: the point that is
//! nearest at rest, by its barycentric coordinates. The radius of a key is the largest distance of
//! these pairs. Between keys each pair's difference is interpolated linearly, so its length is at
//! most the interpolated radius. With a nearest point of its own in each key this would not hold:
//! a part that turns end for end passes through a point. Proof: `core/docs/rounding.md` §17.

use super::closest_point;
use super::format::{DeformableHull, Hull, Key, VertIdx};
use super::geometry::{self, Geometry};
use crate::geom::{Aabb, RealVector};
use crate::num::tolerance::{
    DEFORM_DIAMETER, KEY_RADIUS, KEY_VERTEX, LENGTH_UP, SUMMED, U32, VERTEX_UNDERFLOW,
};
use crate::num::{Real, greater, lesser, sqrt_up};
use crate::query::{Budget, ClosestPoint, QueryError, ScratchEntry};
use glam::Vec3;

/// The hull hierarchy of a mesh at a key frame or between two. Copies are cheap.
///
/// Between keys every vertex of the mesh moves on a straight line. The triangles of coarse levels
/// cover their parts of the surface, but they need not enclose it.
#[derive(Clone, Copy, Debug)]
pub struct FrameHull<'a> {
    model: DeformableHull<'a>,
    frame: f32,
    /// The keys before and after; `None` for the hull at rest.
    keys: [Option<Key<'a>>; 2],
    /// 0 ≤ this < 1.
    between: f32,
    vertex_box: Aabb,
    surface_error: f64,
    /// The part of the surface error that comes from the interpolation.
    rounding: f64,
    pace: Pace,
}

/// How far a vertex of the surface moves at most from one key to the next, local frame.
#[derive(Clone, Copy, Debug)]
struct Pace {
    /// The earlier key. `u32::MAX`: nothing is known.
    before: u32,
    motion: f64,
}

/// Keys, from one to the next, over which a motion is followed.
const FOLLOWED: u32 = 2;

impl Pace {
    const UNKNOWN: Pace = Pace { before: u32::MAX, motion: f64::INFINITY };
}

impl<'a> DeformableHull<'a> {
    /// The hull at a key frame, or between two if `frame` is not a whole number: 1.25 is a quarter
    /// of the way from frame 1 to frame 2. Frame 0 is the mesh at rest.
    ///
    /// Cost: constant. The blob is not copied.
    ///
    /// ```
    /// use meshsweep_core::{Budget, DeformableHull, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/bend.msw"));
    /// let (part, mut scratch) = (DeformableHull::open(bytes)?, Scratch::<256>::new());
    /// let bent = part.at_frame(0.5)?;
    /// let near = bent.closest_point([0.0, 0.0, 9.0], Budget::EXACT, &mut scratch)?;
    /// assert!(near.distance.lower > 0.0);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`QueryError::NoFrame`] unless 0 ≤ `frame` ≤ [`frames`](Self::frames) − 1.
    pub fn at_frame(&self, frame: f32) -> Result<FrameHull<'a>, QueryError> {
        let frames = self.frames();
        let last = frames.saturating_sub(1);
        if !(0.0..=last as f32).contains(&frame) {
            return Err(QueryError::NoFrame { frames });
        }
        // Exact: fewer than 2^16 frames, and the part after the point has no more digits.
        let before = frame as u32;
        let between = frame - before as f32;
        let after = if between > 0.0 { before.saturating_add(1) } else { before };
        let keys = [self.key_or_rest(before), self.key_or_rest(after)];
        let [Some(first), Some(second)] = keys else { return Err(QueryError::Unchecked) };
        let keys = [first, second];
        let hull = self.rest();
        let rest = f64::from(hull.header().surface_error);
        let [first, second] = keys.map(|key| match key {
            None => (hull.hull_box(), rest),
            Some(key) => (key.vertex_box, f64::from(key.error)),
        });
        let vertex_box =
            Aabb { min: first.0.min.min(second.0.min), max: first.0.max.max(second.0.max) };
        let error = first.1.max(second.1);
        let rounding = if between > 0.0 {
            let largest = vertex_box.min.abs().max(vertex_box.max.abs()).max_element();
            KEY_VERTEX * f64::from(U32) * f64::from(largest) + VERTEX_UNDERFLOW
        } else {
            0.0
        };
        let surface_error = error + rounding;
        let (model, pace) = (*self, Pace::UNKNOWN);
        Ok(FrameHull { model, frame, keys, between, vertex_box, surface_error, rounding, pace })
    }

    /// A key frame; `None` inside for the hull at rest.
    fn key_or_rest(&self, frame: u32) -> Option<Option<Key<'a>>> {
        if frame == 0 { Some(None) } else { self.key(frame).map(Some) }
    }
}

impl<'a> FrameHull<'a> {
    /// The same mesh at another frame, and how far a vertex of the surface moves at most on the
    /// way there, local frame; infinite over more intervals between keys than two.
    ///
    /// Cost: one pass over the vertices for each interval whose pace is not known. The pace of one
    /// interval is kept.
    pub(super) fn followed(&self, frame: f32) -> Result<(FrameHull<'a>, f64), QueryError> {
        let mut there = self.model.at_frame(frame)?;
        there.pace = self.pace;
        let (from, to) = (lesser(self.frame, frame), greater(self.frame, frame));
        let first = from as u32;
        if to > first.saturating_add(FOLLOWED) as f32 {
            return Ok((there, f64::INFINITY));
        }
        // Bounds of before and of now are off by the roundings of their vertices, each way.
        let mut motion = self.rounding + there.rounding;
        for key in first..first.saturating_add(FOLLOWED) {
            let start = greater(from, key as f32);
            let end = lesser(to, key.saturating_add(1) as f32);
            if start < end {
                if there.pace.before != key {
                    there.pace = self.pace_after(key).ok_or(QueryError::Unchecked)?;
                }
                motion += (f64::from(end) - f64::from(start)) * there.pace.motion;
            }
        }
        Ok((there, motion * SUMMED))
    }

    /// One pass over the vertices of the surface.
    fn pace_after(&self, before: u32) -> Option<Pace> {
        let hull = self.model.tables();
        let [from, to] =
            [self.model.key_or_rest(before)?, self.model.key_or_rest(before.checked_add(1)?)?];
        let mut most = Real(0.0);
        for vertex in (0..hull.header().vertices).map(VertIdx) {
            if hull.split_of(vertex).is_none() {
                let [from, to] = [at_key(hull, &from, vertex)?, at_key(hull, &to, vertex)?];
                let way = RealVector::from(to) - RealVector::from(from);
                most = greater(most, way.dot(way));
            }
        }
        let [motion] = sqrt_up([most.0]).map(|length| Real(length) * Real(LENGTH_UP));
        Some(Pace { before, motion: f64::from(motion.0) })
    }

    /// Closest point of the surface at this frame to `point` (input units), with an interval that
    /// contains the distance to the mesh whose vertices are interpolated from those of the input
    /// files, in real arithmetic.
    ///
    /// Between keys the interval is wider by up to 1.5 millionths of the largest coordinate.
    /// `triangle` is the number in the first input file. All else as for [`Hull::closest_point`];
    /// [`Hull::scratch_entries`] are enough.
    ///
    /// # Errors
    /// Those of [`Hull::closest_point`].
    #[inline(never)]
    pub fn closest_point(
        &self,
        point: [f32; 3],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<ClosestPoint, QueryError> {
        budget.check_with(scratch)?;
        let Budget { relative, absolute, steps } = budget;
        closest_point::closest_point(self, point, [relative, absolute], steps, scratch)
    }

    /// Coordinates of a vertex of any level at this frame, input units, rounded to f32.
    pub fn vertex(&self, vertex: VertIdx) -> Option<[f32; 3]> {
        geometry::vertex(self, vertex)
    }

    #[inline(always)]
    fn position(&self, vertex: VertIdx) -> Option<Vec3> {
        let hull = self.model.tables();
        let [before, after] = &self.keys;
        let from = at_key(hull, before, vertex)?;
        if self.between == 0.0 {
            return Some(from);
        }
        let [from, to] = [from, at_key(hull, after, vertex)?].map(RealVector::from);
        Some((from + (to - from) * Real(self.between)).into())
    }

    #[inline(always)]
    fn radius(&self, number: u32) -> Option<f32> {
        let at = |key: &Option<Key<'_>>| match key {
            None => self.model.tables().radius(number),
            Some(key) => key.radius(number),
        };
        let [before, after] = &self.keys;
        let from = at(before)?;
        if self.between == 0.0 {
            return Some(from);
        }
        let to = at(after)?;
        let larger = greater(from, to);
        // A difference of infinite radii is not a number.
        if larger == f32::INFINITY {
            return Some(larger);
        }
        let [start, end] = [from, to].map(Real);
        let between = start + (end - start) * Real(self.between);
        Some((between + Real(KEY_RADIUS * U32) * Real(larger)).0)
    }
}

/// A vertex at a key, or at rest.
#[inline(always)]
fn at_key(hull: &Hull<'_>, key: &Option<Key<'_>>, vertex: VertIdx) -> Option<Vec3> {
    match key {
        None => hull.position(vertex),
        Some(key) => key.position(vertex),
    }
}

impl<'a> Geometry<'a> for FrameHull<'a> {
    fn tables(&self) -> &Hull<'a> {
        self.model.tables()
    }

    fn triangle(
        &self,
        [a, b, c]: [VertIdx; 3],
        number: u32,
        is_surface: bool,
    ) -> Option<([Vec3; 3], f32)> {
        let corners = [self.position(a)?, self.position(b)?, self.position(c)?];
        // A triangle that closes a hole is none of the surface, and keeps its infinite radius.
        let has_no_radius = is_surface && self.tables().encloses();
        Some((corners, if has_no_radius { 0.0 } else { self.radius(number)? }))
    }

    fn place(&self, vertex: VertIdx) -> Option<Vec3> {
        self.position(vertex)
    }

    /// The swept triangle of a group is not known in other frames: it holds the whole model, if it
    /// stands for a part of it.
    fn group(&self, index: u32) -> Option<([Vec3; 3], f32)> {
        let ([a, b, c], radius) = self.tables().base_group(index)?;
        let corners = [self.position(a)?, self.position(b)?, self.position(c)?];
        Some((corners, greater(radius, DEFORM_DIAMETER)))
    }

    fn vertex_box(&self) -> Aabb {
        self.vertex_box
    }

    fn surface_error(&self) -> f64 {
        self.surface_error
    }
}
