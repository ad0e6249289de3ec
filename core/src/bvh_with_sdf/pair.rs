//! The pair, and what its field tells of the surface.

use crate::bvh::Bvh;
use crate::format::OpenError;
use crate::format::layout::BuildFor;
use crate::query::{Interval, QueryError};
use crate::sdf::{FieldDistance, Sdf, SdfKind};

/// A box tree and the distance field of the same mesh. Questions are those of the tree; the field
/// answers the ones that it can, and limits the search of the others.
///
/// Every answer holds as surely as the box tree's, and meets the same tolerance, up to the surface
/// error and rounding. Verdicts of the field have no witness.
/// [`tree`](Self::tree) and [`field`](Self::field) give both views for all other questions.
///
/// ```
/// use meshsweep_core::{Budget, BvhWithSdf, Scratch};
/// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/both.msw"));
/// let (part, mut scratch) = (BvhWithSdf::open(bytes)?, Scratch::<64>::new());
/// let near = part.within([20.0, 20.0, 60.0], 5.0, Budget::EXACT, &mut scratch)?;
/// assert!(near.is_clear() && near.work.total() == 0); // the field alone
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct BvhWithSdf<'a> {
    tree: Bvh<'a>,
    field: Sdf<'a>,
}

/// Any distance from a surface.
pub(super) const ANY_LENGTH: Interval = Interval::new(0.0, f32::INFINITY);

impl<'a> BvhWithSdf<'a> {
    /// Pairs a tree with a field. Both must be of the same mesh, in the same unit and place: of the
    /// same blob they are. For two blobs the caller answers: if the meshes differ, any answer may
    /// be wrong, and none panics.
    #[must_use]
    pub const fn new(tree: Bvh<'a>, field: Sdf<'a>) -> Self {
        BvhWithSdf { tree, field }
    }

    /// Opens the box tree and the field of a blob, as [`Bvh::open`] and [`Sdf::open`] do.
    ///
    /// # Errors
    /// [`OpenError`]; [`OpenError::MissingSection`] if the blob was built without one of both.
    pub fn open(bytes: &'a [u8]) -> Result<Self, OpenError> {
        Ok(BvhWithSdf { tree: Bvh::open(bytes)?, field: Sdf::open(bytes)? })
    }

    /// Opens both of an image that was verified before, as [`Bvh::open_trusted`] and
    /// [`Sdf::open_trusted`] do: a constant function.
    ///
    /// # Errors
    /// Those of [`open`](Self::open).
    pub const fn open_trusted(bytes: &'a [u8]) -> Result<Self, OpenError> {
        match (Bvh::open_trusted(bytes), Sdf::open_trusted(bytes)) {
            (Ok(tree), Ok(field)) => Ok(BvhWithSdf { tree, field }),
            (Err(error), _) | (_, Err(error)) => Err(error),
        }
    }

    /// The box tree.
    #[must_use]
    pub const fn tree(&self) -> &Bvh<'a> {
        &self.tree
    }

    /// The distance field.
    #[must_use]
    pub const fn field(&self) -> &Sdf<'a> {
        &self.field
    }

    /// The answer of the field, where it has one.
    #[inline(always)]
    pub(super) fn look_up(&self, point: [f32; 3]) -> Option<FieldDistance> {
        self.field.distance(point).ok()
    }

    /// Bounds of the distance to the surface, without its sign, from an answer of the field.
    #[inline(always)]
    pub(super) fn surface_interval(&self, found: &FieldDistance) -> Interval {
        let Interval { lower, upper } = found.distance;
        if lower > 0.0 {
            found.distance
        } else if self.field.kind() == SdfKind::Solid {
            // Inside, the distance to the surface is any.
            ANY_LENGTH
        } else if upper < 0.0 {
            Interval::new(-upper, -lower)
        } else {
            Interval::new(0.0, if upper > -lower { upper } else { -lower })
        }
    }

    /// The same of a point.
    #[inline(always)]
    pub(super) fn known(&self, point: [f32; 3]) -> Interval {
        self.look_up(point).map_or(ANY_LENGTH, |found| self.surface_interval(&found))
    }

    /// Refuses a tree without boxes for distances, though the field might answer: a question is
    /// refused for every point, or for none.
    #[inline(always)]
    pub(super) fn check_distances(&self) -> Result<(), QueryError> {
        // Made here: a constant would be copied by `memcpy`, for which alone firmware links it.
        let refused = || QueryError::NotServed { build_for: BuildFor::Closest };
        if self.tree.serves_distances() { Ok(()) } else { Err(refused()) }
    }

    /// The same of boxes for segments.
    #[inline(always)]
    pub(super) fn check_segments(&self) -> Result<(), QueryError> {
        let refused = || QueryError::NotServed { build_for: BuildFor::Segment };
        if self.tree.serves_segments() { Ok(()) } else { Err(refused()) }
    }
}
