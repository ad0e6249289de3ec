//! Why a query was refused.

use crate::format::layout::BuildFor;

/// Why a query was refused. No answer was computed. An error has twelve bytes, so that it makes no
/// answer larger.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum QueryError {
    /// A coordinate of the query is NaN or infinite.
    NotFinite,
    /// The direction of a ray is zero.
    NoDirection,
    /// A pair names a model that the scene does not have, or one model twice.
    NoModel,
    /// A [`Joint`](crate::Joint) names a parent that is not before it, or a place that is not
    /// given; or there is not one pose for each joint.
    NoJoint,
    /// A solid has no corners, or more than [`Solid::MOST_CORNERS`](crate::Solid::MOST_CORNERS). Or
    /// a solid that moves has not as many at the end as at the start.
    Corners {
        /// Corners given; of a solid that moves, those at the end.
        found: u32,
    },
    /// A tolerance, a distance or a radius is negative, NaN, infinite or too large.
    Tolerance,
    /// A point, an end of a segment or a model is too far away, or a joint turns too far. Clip
    /// segments first. The limits:
    /// - [`Hull`](crate::Hull): 2^40 times the model's size from its origin;
    /// - [`Bvh`](crate::Bvh): 2^38 grid units from the model's farthest corner; for corners of a
    ///   [`Solid`](crate::Solid) 2^30 grid units from the grid's origin, and for its radius;
    /// - origins of rays: a quarter of these two, and of a box tree the sum of the ways along the
    ///   axes;
    /// - [`Scene`](crate::Scene): two models that are farther from each other than f32 reaches;
    /// - [`Triboxes`](crate::Triboxes): [`Tribox::DOMAIN`](crate::Tribox::DOMAIN);
    /// - [`Sdf`](crate::Sdf): 2^60 of its units from the field, in whole units 2^28;
    /// - a [`Joint`](crate::Joint) that turns: 8192 radians.
    OutOfDomain,
    /// A pose cannot be computed with. One of these holds:
    /// - an entry of its matrix is beyond 2;
    /// - for [`Pose::to_model`](crate::Pose::to_model) and [`Scene`](crate::Scene), its columns are
    ///   far from orthonormal: the Frobenius norm of `RᵀR − 1` is above a quarter;
    /// - for triboxes, its translation is beyond [`Tribox::DOMAIN`](crate::Tribox::DOMAIN);
    /// - one model's grid is more than 2^40 times as coarse as the other's;
    /// - a surface error is far larger than its model.
    PoseOutOfDomain,
    /// A pose's matrix is no rotation up to three decimals, or it is a mirror. All zeros are no
    /// rotation. See [`Pose::is_affine`](crate::Pose::is_affine). Or a quaternion is all zeros, or
    /// the axis of a joint no unit vector.
    NotRigid,
    /// The key frame is not a number from 0 to the number of frames less 1.
    NoFrame {
        /// Key frames of the blob, the mesh at rest among them.
        frames: u32,
    },
    /// A moved hull has fewer vertex records than
    /// [`vertex_records`](crate::DeformableHull::vertex_records) says.
    VertexRecords {
        /// Records needed.
        needed: u32,
        /// Records given.
        found: u32,
    },
    /// A vertex was moved to a place that is not finite, or 64 times the model's size or more from
    /// its origin.
    VertexOutOfDomain {
        /// Number of the vertex in the input file.
        vertex: u32,
    },
    /// The last update of a moved hull was refused, so the hull has no pose. Update it again.
    NoPose,
    /// The scratch memory has no entries. One entry is enough for an interval.
    NoScratch,
    /// The blob was built without the sections that this question needs.
    NotServed {
        /// The value of `meshsweep build --for` that writes them.
        build_for: BuildFor,
    },
    /// The levels of the hierarchy enclose nothing: it was built with `--for sweep`. Hulls need a
    /// closed mesh and `--for hull`.
    NotEnclosing,
    /// The points of the curves differ in z, so that the curves bound no area of a plane. Leave z
    /// out of the file, or give all points the same.
    NotPlanar,
    /// A polyline is not closed, so that it bounds no area: build the curves with `--closed`.
    OpenPolyline {
        /// Its number.
        polyline: u32,
    },
    /// The view does not fit its bytes. No view that an `open` of this crate returned does that.
    Unchecked,
}

impl QueryError {
    pub(crate) const NO_DISTANCES: QueryError =
        QueryError::NotServed { build_for: BuildFor::Closest };
    pub(crate) const NO_SEGMENTS: QueryError =
        QueryError::NotServed { build_for: BuildFor::Segment };
    pub(crate) const NO_CONES: QueryError = QueryError::NotServed { build_for: BuildFor::Cull };
    pub(crate) const NO_MOMENTS: QueryError =
        QueryError::NotServed { build_for: BuildFor::Winding };
    pub(crate) const NO_HULL: QueryError = QueryError::NotServed { build_for: BuildFor::Hull };
    pub(crate) const NO_TRIBOXES: QueryError =
        QueryError::NotServed { build_for: BuildFor::Triboxes };
    pub(crate) const NO_TIGHT_HULLS: QueryError =
        QueryError::NotServed { build_for: BuildFor::Tight };
    pub(crate) const NO_DEFORM: QueryError = QueryError::NotServed { build_for: BuildFor::Deform };
    pub(crate) const NO_CURVES: QueryError = QueryError::NotServed { build_for: BuildFor::Curve };
    pub(crate) const NO_SDF: QueryError = QueryError::NotServed { build_for: BuildFor::Sdf };
}

impl core::fmt::Display for QueryError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            QueryError::NotFinite => "a coordinate of the query is NaN or infinite",
            QueryError::NoDirection => "the direction of a ray is zero",
            QueryError::NoModel => "a pair names a model that the scene lacks, or one model twice",
            QueryError::NoJoint => {
                "a joint's parent is not before it, its place is not given, or poses are missing"
            }
            QueryError::Corners { found } => {
                return write!(f, "{found} corners: 1 to 32, and as many at a motion's end");
            }
            QueryError::Tolerance => {
                "a tolerance, a distance or a radius is negative, NaN, infinite or too large"
            }
            QueryError::OutOfDomain => {
                "a point, a segment's end or a model is too far away (clip segments first), or a \
                 joint turns by more than 8192 radians"
            }
            QueryError::PoseOutOfDomain => {
                "an entry of the matrix is beyond 2, the matrix far from a rotation where one is \
                 needed, the translation too large, or one model 2^40 times as large as the other"
            }
            QueryError::NotRigid => {
                "a pose's matrix is no rotation: if it may be any, make the pose by Pose::affine"
            }
            QueryError::NoFrame { frames } => {
                let last = frames.saturating_sub(1);
                return write!(f, "no such frame: frames go from 0 to {last}");
            }
            QueryError::VertexRecords { needed, found } => {
                return write!(f, "{found} vertex records, and a moved hull needs {needed}");
            }
            QueryError::VertexOutOfDomain { vertex } => {
                return write!(
                    f,
                    "vertex {vertex} is moved to a place that is not finite or too far from the \
                     model"
                );
            }
            QueryError::NoPose => "the last update of the moved hull was refused: update it again",
            QueryError::NoScratch => "the scratch memory has no entries",
            QueryError::NotServed { build_for } => {
                return write!(
                    f,
                    "the blob was built without the sections that this question needs: build it \
                     with --for {build_for}"
                );
            }
            QueryError::NotEnclosing => {
                "the hierarchy encloses nothing, and this question needs hulls: build it with \
                 --for hull from a closed mesh"
            }
            QueryError::NotPlanar => {
                "the curve's points differ in z, so it bounds no area: give all the same z, or none"
            }
            QueryError::OpenPolyline { polyline } => {
                return write!(
                    f,
                    "polyline {polyline} is not closed, so it bounds no area: build with --closed"
                );
            }
            QueryError::Unchecked => "the model was not opened",
        })
    }
}

impl core::error::Error for QueryError {}
