//! Convex solids, and how far they are from a surface.

use super::answer::{Ended, Interval};
use super::error::QueryError;
use super::work::Work;

/// A convex solid: all points within `radius` of the hull of its corners.
///
/// One corner is a sphere, two are a capsule, three a triangle, eight a box of any orientation, 32
/// a tribox ([`Tribox::corners`](crate::Tribox::corners)). Corners and radius are in input units,
/// in the model's frame, and taken as exact. Corners within the hull, or equal ones, do no harm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solid<'a> {
    corners: &'a [[f32; 3]],
    radius: f32,
}

impl<'a> Solid<'a> {
    /// Most corners of a solid: those of a tribox.
    pub const MOST_CORNERS: usize = 32;

    /// The points within `radius` of the hull of `corners`.
    ///
    /// # Errors
    /// [`QueryError::Corners`] without corners or with more than
    /// [`MOST_CORNERS`](Self::MOST_CORNERS), [`QueryError::NotFinite`], and
    /// [`QueryError::Tolerance`] if the radius is negative, NaN or infinite.
    pub fn new(corners: &'a [[f32; 3]], radius: f32) -> Result<Solid<'a>, QueryError> {
        if corners.is_empty() || corners.len() > Self::MOST_CORNERS {
            return Err(QueryError::Corners { found: u32::try_from(corners.len()).unwrap_or(!0) });
        }
        if !corners.iter().flatten().all(|x| x.is_finite()) {
            return Err(QueryError::NotFinite);
        }
        if !(radius >= 0.0 && radius.is_finite()) {
            return Err(QueryError::Tolerance);
        }
        Ok(Solid { corners, radius })
    }

    /// The corners of the box from `low` to `high`, with edges along the axes, input units. x
    /// changes first, then y, then z. If a coordinate of `low` is the greater one, it is the same
    /// box.
    ///
    /// ```
    /// use meshsweep_core::Solid;
    /// let clamp = Solid::box_corners([10.0, 0.0, 0.0], [14.0, 6.0, 2.0]);
    /// assert!(Solid::new(&clamp, 0.5).is_ok());
    /// ```
    #[must_use]
    pub const fn box_corners(low: [f32; 3], high: [f32; 3]) -> [[f32; 3]; 8] {
        let ([a, b, c], [x, y, z]) = (low, high);
        [[a, b, c], [x, b, c], [a, y, c], [x, y, c], [a, b, z], [x, b, z], [a, y, z], [x, y, z]]
    }

    /// Its corners.
    #[must_use]
    pub fn corners(&self) -> &'a [[f32; 3]] {
        self.corners
    }

    /// Its radius.
    #[must_use]
    pub fn radius(&self) -> f32 {
        self.radius
    }
}

/// The distance of a convex solid and a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct SolidDistance {
    /// The least distance of a point of the solid from the input mesh, input units. Its upper end
    /// is 0 if it is proved that they meet.
    pub distance: Interval,
    /// A point of the hull of the solid's corners, and one of the surface, rounded to f32. They are
    /// at most `distance.upper` and the solid's radius apart, up to this rounding.
    pub points: [[f32; 3]; 2],
    /// The triangle of the second point, by its number in the input file.
    pub triangle: u32,
    /// The work of the search: triangles bounded as `triangles`, computed in f64 as `exact`.
    pub work: Work,
    /// Why the search ended.
    pub ended: Ended,
}
