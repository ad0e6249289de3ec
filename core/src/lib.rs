//! Geometric questions about triangle meshes, answered from a binary blob where it lies: no heap,
//! no recursion, no panic.
//!
//! A host tool (`meshsweep`) turns a mesh into a blob. [`Blob::open`] checks every byte of the blob
//! once and gives views of its structures. Each view answers questions. A distance is an interval
//! that contains the true distance to the input mesh, in real arithmetic.
//!
//! ```
//! use meshsweep_core::{Blob, Budget, Scratch};
//!
//! // By `meshsweep build groove.obj -o groove.msw`.
//! let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
//! let part = Blob::open(bytes)?.bvh()?;
//! let mut scratch = Scratch::<64>::new(); // `part.scratch_entries()` says how many are enough
//! let near = part.closest_point([3.0, 0.0, 4.0], Budget::EXACT, &mut scratch)?;
//! assert!(near.distance.lower <= near.distance.upper);
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```
//!
//! # Which structure answers
//! | question | method |
//! | --- | --- |
//! | closest point, distance interval | [`Bvh::closest_point`], [`Bvh::closest_point_from`] |
//! | the same in f64, of a tree with vertices of 32 bits | [`Bvh::closest_point_precise`] |
//! | closest point of a query that moves little | [`CoherentQuery::closest_point`] |
//! | is the mesh within a distance; the nearest triangles | [`Bvh::within`], [`Bvh::all_within`], [`Bvh::nearest`] |
//! | any of these about a model that moves | [`Pose::to_model`] |
//! | inside or outside of a closed mesh | [`Bvh::signed_distance`] |
//! | inside or outside of a mesh with holes, flaps or parts that overlap | [`Bvh::winding_number`], [`Bvh::signed_distance_by_winding`] |
//! | segments | [`Bvh::first_hit`], [`Bvh::any_hit`], [`Bvh::all_hits`] |
//! | rays, which have no end | [`Bvh::first_hit_of_ray`], [`Bvh::any_hit_of_ray`], [`Bvh::all_hits_of_ray`]; [`Hull::first_hit_of_ray`], [`Hull::all_hits_of_ray`] |
//! | do two meshes meet | [`Bvh::overlap`], [`Bvh::all_overlaps`] |
//! | how far are two meshes from each other; is one within a distance of the other | [`Bvh::distance_to`], [`Bvh::within_of`] |
//! | the same of models that move little from one question to the next | [`CoherentPair::distance`], [`CoherentPair::within`] |
//! | is one solid inside another; how deep; which translation separates them | [`Bvh::penetration`] |
//! | which two of a few dozen models are nearest; are any two within a distance | [`Scene::nearest_pair`], [`Scene::within`] |
//! | does any pair of models that move little keep its own distance no longer | [`CoherentScene::within`] |
//! | poses of quaternions, products and inverses, with how far rounding moves a model | [`Pose::of_quaternion`], [`RoundedPose`] |
//! | where are the links of a robot, from the places of its joints, with the rounding | [`link_poses`] |
//! | how far is a sphere, a capsule or a box; is it within a distance | [`Bvh::solid_distance`], [`Bvh::solid_within`] |
//! | is the move of a tool, or of another mesh, clear for its whole length | [`Bvh::solid_first_contact`], [`Bvh::first_contact_of`] |
//! | triangles that may face an eye | [`Bvh::front_facing`] |
//! | how far is a mesh, by a tight hull of few faces; is it within a distance | [`TightHull::closest_point`], [`TightHull::within`] |
//! | are two models apart, or farther than a distance; bounds without triangles | [`Triboxes::separation`], [`Triboxes::within_of`], [`Triboxes::distance`], [`Triboxes::clip`] |
//! | bounds of the distance by one look-up, in a lattice some 200 instructions of a Cortex-M4F, in a tree some more; the side and a direction | [`Sdf::distance`], [`Sdf::distance_and_gradient`], [`Sdf::within`] |
//! | the same by the field first, and by the box tree where the field cannot decide | [`BvhWithSdf::within`], [`BvhWithSdf::distance_bounds`], [`BvhWithSdf::signed_bounds`] |
//! | the same in whole units, without floating point | [`Sdf::distance_in_units`], [`Sdf::gradient_in_units`] |
//! | fences and tool paths | [`Curve::closest_point`], [`Curve::within`], [`Curve::nearest`], [`Curve::all_within`] |
//! | the same of a point that moves little, or in several calls | [`Curve::sweep`] |
//! | inside or outside of a fence of inclusion and exclusion zones, and how far from its line | [`Curve::signed_distance`] |
//! | the faces of a nested hull | [`Hull::faces`] |
//! | the hull that a scene needs: fine near a point, in a box, toward an eye | [`RefinedHull::update`] |
//! | the mesh that a sweep about a point ends with | [`RefinedHull::sweep_to`] |
//! | hits from outside on that hull | [`Hull::outer_hits`] |
//! | does a triangle, or a moved mesh, meet the surface; each refined only where they meet | [`Hull::meets_triangle`], [`Hull::overlap`], [`Hull::all_overlaps`] |
//! | closest point, hits, and the next triangles on the split tables | [`Hull::closest_point`], [`Hull::first_hit`], [`Hull::sweep`] |
//! | closest point and hits of a mesh that deforms | [`FrameHull::closest_point`], [`FrameHull::first_hit`], [`MovedHull::closest_point`], [`MovedHull::first_hit`] |
//! | closest point and next triangles while point and mesh move little | [`FrameHull::sweep`], [`MovedHull::sweep`] |
//! | does a rigid mesh meet a mesh that deforms | [`FrameHull::overlap`], [`MovedHull::overlap`] |
//!
//! # Features
//! - `defmt`, off by default: answers, errors, verdicts and budgets implement `defmt::Format`, so
//!   that firmware can log them. Nothing else changes.
//!
//! Examples for a board are in the repository: in Rust in `core/examples`, in C in
//! `core/c-api/examples`.
//!
//! # Layers
//! A folder may use only folders to its left in this line:
//! `num` ← `geom` ← `format` ← `query` ← {`bvh`, `hull`, `tribox`, `curve`, `sdf`} ← `tight` ←
//! `bvh_with_sdf` ← `blob`.
//!
//! | folder | owns |
//! | --- | --- |
//! | `num` | scalars with known rounding, stored radii, every tolerance with its derivation |
//! | `geom` | closed-form kernels: point–triangle, segment–triangle, triangle pair, box, fan, swept triangle, point–segment, triangle distance, convex gap, solid angle, pose; they know no bytes |
//! | `format` | bytes that all structures share: header, section table, CRC, reading numbers |
//! | `query` | types that all questions share: [`Budget`], [`Scratch`], intervals, work counters, errors |
//! | `bvh` | the box tree over fans, one file per question |
//! | `hull` | split tables: levels, the refined hull, outer hits, the sweep, overlap, hulls that deform |
//! | `tribox` | bounds of eighteen planes, and their hierarchy |
//! | `curve` | polygonal curves in 2-D and 3-D |
//! | `sdf` | the distance field: one look-up |
//! | `tight` | tight hulls, each stored as a box tree |
//! | `bvh_with_sdf` | a box tree and a distance field of one mesh: the field is asked first |
//! | `blob` | [`Blob`]: opens, lets each structure check its own sections, hands out views |
//!
//! Each structure has its bytes in a folder `format` (the box tree in `tree/format`): `layout`
//! (sizes and offsets), `view`, `check`.
//!
//! # The same bits everywhere
//! The same blob and query give the same bits on a workstation and on a Cortex-M0. The code uses
//! `+ − × ÷ √` and comparisons, in one written order, never fused. The square root is `libm`'s,
//! which is correctly rounded on every target, or `sqrt_approx`, products and sums of our own.
//! Screws, winding numbers and signs at vertices also take a sine or an arctangent from `libm`,
//! where the code of both is the same for every target. [`link_poses`] has series of its own.

#![no_std]
#![forbid(unsafe_code)]

mod blob;
mod bvh;
mod bvh_with_sdf;
mod curve;
mod format;
mod geom;
mod hull;
mod num;
mod query;
mod sdf;
mod tight;
mod tribox;

pub use blob::Blob;
pub use bvh::{
    Bvh, CoherentClosest, CoherentPair, CoherentQuery, CoherentScene, Eye, Facing, FrontFacing,
    Hint, KeptPair, Neighbor, PlacedModel, ProcessorQuestions, Scene, SceneDistance, WindingNumber,
};
pub use bvh_with_sdf::{BvhWithSdf, DistanceBounds, SignedBounds};
pub use curve::{
    Curve, CurveClosest, CurveNeighbor, CurveSegment, CurveSignedDistance, CurveSweep, Zone,
};
pub use format::layout::{BuildFor, SectionKind};
pub use format::{Contradiction, HeaderField, OpenError, Section};
pub use geom::Pose;
pub use hull::format::VertIdx;
pub use hull::{
    DeformableHull, Focus, FrameHull, Hull, HullFace, HullLevel, MovedHull, MovedVertex, OuterHits,
    OuterSearch, RefinedHull, Refinement, SplitChange, Sweep, SweptMesh,
};
pub use query::{
    AllHits, AllOverlaps, AllWithin, Budget, ClosestPoint, Decided, Ended, FirstHit, Hit, Interval,
    Joint, JointAxis, JointKind, KNearest, Motion, PairContact, PairDistance, Penetration,
    PosedPoint, QueryError, Relation, RoundedPose, Scratch, ScratchEntry, Side, SignedDistance,
    Solid, SolidDistance, TriangleHit, TrianglePair, Undecided, Verdict, Work, link_poses,
};
pub use sdf::{FieldDistance, Sdf, SdfKind, SdfLayout, UnitDistance};
pub use tight::{TightHull, TightHulls, TightRecord};
pub use tribox::{
    Boundary, NodePair, Separation, Tribox, TriboxBound, TriboxCandidates, TriboxError,
    TriboxLevel, Triboxes,
};

/// The folders, for the builder, the checker and the tests. Not part of the public interface: it
/// may change in any release.
#[doc(hidden)]
#[allow(missing_docs, reason = "each folder documents itself")]
pub mod internal {
    pub mod num {
        pub use crate::num::*;
    }
    pub mod geom {
        pub use crate::geom::*;
    }
    pub mod format {
        pub use crate::format::*;
    }
    pub mod bvh {
        pub use crate::bvh::*;
    }
    pub mod hull {
        pub use crate::hull::*;
    }
    pub mod tribox {
        pub use crate::tribox::*;
    }
    pub mod curve {
        pub use crate::curve::*;
    }
    pub mod sdf {
        pub use crate::sdf::*;
    }
    pub mod tight {
        pub use crate::tight::*;
    }
}
