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
//! | `rigid` | which matrices are rotations |
//! | `rounded_pose` | [`RoundedPose`]: poses of quaternions, products, inverses, and their rounding |
//! | `joint` | [`Joint`], [`link_poses`]: where the links of a mechanism are |
//! | `pose_inverse` | the inverse of a pose's matrix |
//! | `posed_point` | [`PosedPoint`]: a point in the frame of a moved model |
//! | `overlap` | [`AllOverlaps`], [`TrianglePair`], and what collects pairs |
//! | `pair_distance` | [`PairDistance`], [`PairContact`]: how far two surfaces are apart |
//! | `penetration` | [`Penetration`], [`Relation`]: how deep two solids are in each other |
//! | `motion` | [`Motion`]: how a model moves from pose to pose |
//! | `solid` | [`Solid`], and [`SolidDistance`]: how far it is from a surface |
//! | `relative_pose` | the pose of one model in the frame of another, and the rounding in it |
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
mod joint;
mod motion;
mod overlap;
mod pair_distance;
mod penetration;
mod pose_inverse;
mod posed_point;
mod relative_pose;
mod rigid;
mod rounded_pose;
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
pub(crate) use hits::Hits;
pub use hits::{AllHits, FirstHit, Hit, TriangleHit};
pub use joint::{Joint, JointAxis, JointKind, link_poses};
pub use motion::Motion;
pub use overlap::{AllOverlaps, TrianglePair};
pub(crate) use overlap::{AllPairs, PairVisitor};
pub use pair_distance::{PairContact, PairDistance};
pub use penetration::{Penetration, Relation};
pub(crate) use pose_inverse::{PoseInverse, transposed};
pub use posed_point::PosedPoint;
pub(crate) use relative_pose::{DIRECTIONS, Extended, ModelFrame, Placement, RelativePose};
pub(crate) use rigid::{check_rigid, is_rotation};
pub use rounded_pose::RoundedPose;
pub use scratch::{Scratch, ScratchEntry};
pub use solid::{Solid, SolidDistance};
pub(crate) use sweep_queue::{SweepQueue, Taken, before};
pub use verdict::{Side, Undecided, Verdict};
pub use work::Work;
