//! Types that the questions about all structures share.
//!
//! | file | owns |
//! | --- | --- |
//! | `budget` | [`Budget`]: when a query may stop |
//! | `scratch` | [`Scratch`], [`ScratchEntry`]: the caller's memory |
//! | `answer` | [`Interval`], [`ClosestPoint`], [`SignedDistance`], [`Ended`]: why a search ended |
//! | `verdict` | [`Verdict`], [`Side`], [`Undecided`]: why there is no verdict |
//! | `decided` | [`Decided`]: a verdict and its witness |
//! | `hits` | [`Hit`], [`FirstHit`], [`TriangleHit`], [`AllHits`], and the caller's slice of hits |
//! | `neighbors` | [`KNearest`], [`AllWithin`]: how searches for several near elements went |
//! | `pose/` | poses: their rounding, what they do to points and lengths, motions, joints |
//! | `overlap` | [`AllOverlaps`], [`TrianglePair`], and what collects pairs |
//! | `pair_distance` | [`PairDistance`], [`PairContact`]: how far two surfaces are apart |
//! | `penetration` | [`Penetration`], [`Relation`]: how deep two solids are in each other |
//! | `solid` | [`Solid`], and [`SolidDistance`]: how far it is from a surface |
//! | `work` | [`Work`]: counters |
//! | `error` | [`QueryError`]: why a query was refused |
//! | `sweep_queue` | the priority queue of the sweeping process |
//! | `frame` | conversion between input units and the local frame, in f64 |

mod answer;
mod budget;
mod decided;
mod error;
mod frame;
mod hits;
mod neighbors;
mod overlap;
mod pair_distance;
mod penetration;
mod pose;
mod ray;
mod scratch;
mod solid;
mod sweep_queue;
mod verdict;
mod work;

pub use answer::{ClosestPoint, Ended, Interval, SignedDistance};
pub use budget::Budget;
pub use decided::Decided;
pub(crate) use decided::Witness;
pub use error::QueryError;
pub(crate) use frame::Frame;
pub use hits::{AllHits, FirstHit, Hit, TriangleHit};
pub(crate) use hits::{Hits, insert_at};
pub use neighbors::{AllWithin, KNearest};
pub use overlap::{AllOverlaps, TrianglePair};
pub(crate) use overlap::{AllPairs, PairVisitor};
pub use pair_distance::{PairContact, PairDistance};
pub use penetration::{Penetration, Relation};
pub(crate) use pose::{
    CommonPose, DIRECTIONS, Extended, ModelFrame, PoseInverse, RelativePose, UNITS_APART,
    VertexPose, WorldLengths, check_rigid, checked_skew, is_rotation, is_turn, longest, skew,
    skew_of,
};
pub use pose::{Joint, JointAxis, JointKind, Motion, PosedPoint, RoundedPose, link_poses};
pub(crate) use ray::{Behind, Ray};
pub use scratch::{Scratch, ScratchEntry};
pub use solid::{Solid, SolidDistance};
pub(crate) use sweep_queue::{SweepQueue, Taken, before, bound_of, key_of};
pub use verdict::{Side, Undecided, Verdict};
pub use work::Work;
