//! Where a scene needs a hull, and how close to the surface: the need of a split.

use crate::hull::format::Hull;
use crate::num::tolerance::{FOCUS_DISTANCE, FOCUS_SLACK, U32};
use crate::num::{sum_up, up_to_f32};
use crate::query::{Frame, QueryError};
use glam::Vec3;

/// Where [`RefinedHull::update`](crate::RefinedHull::update) refines. Lengths and coordinates are
/// in input units.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Focus {
    /// On the whole hull.
    Everywhere,
    /// Within a distance of a point.
    Ball {
        /// The point.
        centre: [f32; 3],
        /// The distance. Not negative.
        radius: f32,
    },
    /// In the box of two corners.
    Box {
        /// One corner.
        a: [f32; 3],
        /// The opposite corner.
        b: [f32; 3],
    },
    /// Within a distance of a segment.
    Segment {
        /// One end.
        a: [f32; 3],
        /// The other end.
        b: [f32; 3],
        /// The distance. Not negative.
        radius: f32,
    },
    /// In the cone of an eye, to an error that grows with the distance from it.
    Eye {
        /// Where the eye is.
        position: [f32; 3],
        /// The middle of the view. Any length but 0, with which the eye sees all around.
        axis: [f32; 3],
        /// Cosine of half the cone's opening angle. −1 and less is all around.
        cosine: f32,
        /// The error that is allowed at distance 1. For an image this is the pixels allowed times
        /// the width of a pixel at distance 1. Not negative.
        error_per_distance: f32,
    },
}

/// A focus in a hull's frame, with the wanted error.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FocusQuery {
    shape: Shape,
    /// No split of a lesser error is needed, local frame.
    error: f32,
}

#[derive(Clone, Copy, Debug)]
enum Shape {
    Everywhere,
    /// A segment in direction `path` from `start`, swept by `radius`. A point has `inverse_sq` 0.
    Swept {
        start: Vec3,
        path: Vec3,
        inverse_sq: f32,
        radius: f32,
    },
    Box {
        min: Vec3,
        max: Vec3,
    },
    Eye {
        position: Vec3,
        axis: Vec3,
        cosine: f32,
        sine: f32,
        error_per_distance: f32,
    },
}

impl FocusQuery {
    /// # Errors
    /// [`QueryError::NotFinite`], [`QueryError::OutOfDomain`], [`QueryError::Tolerance`].
    pub(crate) fn new(hull: &Hull<'_>, focus: &Focus, error: f32) -> Result<Self, QueryError> {
        let frame = Frame::of(hull.header());
        let local = |p: [f32; 3]| Ok::<Vec3, QueryError>(frame.local_end(p)?.as_vec3());
        let length = |x: f32| {
            let sound = x.is_finite() && x >= 0.0;
            sound.then(|| up_to_f32(frame.length(x))).ok_or(QueryError::Tolerance)
        };
        let shape = match *focus {
            Focus::Everywhere => Shape::Everywhere,
            Focus::Ball { centre, radius } => Shape::Swept {
                start: local(centre)?,
                path: Vec3::ZERO,
                inverse_sq: 0.0,
                radius: length(radius)?,
            },
            Focus::Box { a, b } => {
                let (a, b) = (local(a)?, local(b)?);
                Shape::Box { min: a.min(b), max: a.max(b) }
            }
            Focus::Segment { a, b, radius } => {
                let (start, end) = (local(a)?, local(b)?);
                let path = end - start;
                let length_sq = path.dot(path);
                // The point of the segment that is nearest to a vertex is off by some roundings of
                // the coordinates.
                let bounds = hull.hull_box();
                let sizes = start.abs() + end.abs() + bounds.min.abs().max(bounds.max.abs());
                let doubt = FOCUS_DISTANCE * U32 * (sizes.x + sizes.y + sizes.z);
                let inverse_sq = if length_sq > f32::MIN_POSITIVE { 1.0 / length_sq } else { 0.0 };
                Shape::Swept { start, path, inverse_sq, radius: sum_up(length(radius)?, doubt) }
            }
            Focus::Eye { position, axis, cosine, error_per_distance } => {
                if !cosine.is_finite() || !axis.iter().all(|x| x.is_finite()) {
                    return Err(QueryError::NotFinite);
                }
                if !(error_per_distance.is_finite() && error_per_distance >= 0.0) {
                    return Err(QueryError::Tolerance);
                }
                let axis = Vec3::from_array(axis);
                // Of any length: first the largest coordinate is made 1.
                let axis = axis / axis.abs().max_element();
                let axis = axis / libm::sqrtf(axis.dot(axis));
                let cosine = if axis.is_finite() { cosine.clamp(-1.0, 1.0) } else { -1.0 };
                Shape::Eye {
                    position: local(position)?,
                    axis: if axis.is_finite() { axis } else { Vec3::X },
                    cosine,
                    // `1 − c²` would cancel where the cone is narrow.
                    sine: libm::sqrtf((1.0 - cosine) * (1.0 + cosine)),
                    error_per_distance,
                }
            }
        };
        Ok(FocusQuery { shape, error: length(error)? })
    }

    /// Whether an error may need a split anywhere in the focus.
    #[inline(always)]
    pub(crate) fn is_above(&self, error: f32) -> bool {
        error > self.error
    }

    /// How much a split is needed, by its vertex, star radius and error: 0 if it is not. Else the
    /// error, or for an eye the error over the distance, at least over the star radius. Finite. A
    /// split whose star radius is not known, because the stored one is infinite, is needed
    /// everywhere.
    ///
    /// Rounding may call a split needed that is not, by a few units of f32, but not the reverse.
    #[inline]
    pub(crate) fn need(&self, vertex: Vec3, star_radius: f32, error: f32) -> f32 {
        if !self.is_above(error) {
            return 0.0;
        }
        if !star_radius.is_finite() {
            return error;
        }
        match self.shape {
            Shape::Everywhere => error,
            Shape::Swept { start, path, inverse_sq, radius } => {
                let mut from = vertex - start;
                if inverse_sq > 0.0 {
                    from -= path * (from.dot(path) * inverse_sq).clamp(0.0, 1.0);
                }
                let limit = radius + star_radius;
                if from.dot(from) <= limit * limit * FOCUS_SLACK { error } else { 0.0 }
            }
            Shape::Box { min, max } => {
                let gap = (min - vertex).max(vertex - max).max(Vec3::ZERO);
                if gap.dot(gap) <= star_radius * star_radius * FOCUS_SLACK { error } else { 0.0 }
            }
            Shape::Eye { position, axis, cosine, sine, error_per_distance } => {
                let from = vertex - position;
                let centre_distance = libm::sqrtf(from.dot(from));
                let along = from.dot(axis);
                let aside = from - axis * along;
                let across = libm::sqrtf(aside.dot(aside));
                let star_radius = star_radius + FOCUS_DISTANCE * U32 * centre_distance;
                // In the plane of axis and vertex: how far the vertex is outside of the cone's
                // side, and how far along the side the nearest point is.
                let beside = across * cosine - along * sine;
                let forward = along * cosine + across * sine;
                let is_seen = centre_distance <= star_radius
                    || beside <= 0.0
                    || (forward >= -star_radius && beside <= star_radius);
                let distance = (centre_distance - star_radius).max(0.0);
                if is_seen && error > error_per_distance * distance {
                    // The eye may stand in a star of no extent.
                    (error / distance.max(star_radius)).min(f32::MAX)
                } else {
                    0.0
                }
            }
        }
    }
}
