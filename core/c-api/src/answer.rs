//! Answers. Each field is as in `meshsweep.h`. After an error a function leaves zeros, which prove
//! nothing: undecided, at distance 0.

#![allow(missing_docs, reason = "meshsweep.h says it")]

use meshsweep_core::{
    ClosestPoint, CoherentClosest, Decided, Ended, FirstHit, Interval, KNearest, Neighbor,
    NodePair, PairContact, PairDistance, Separation, Side, SignedDistance, TriboxBound,
    TriboxCandidates, Undecided, Verdict, WindingNumber, Work,
};

/// `MSW_NO_TRIANGLE`.
pub const NO_TRIANGLE: u32 = u32::MAX;
/// `MSW_NO_NODE`.
pub const NO_NODE: u32 = u32::MAX;
/// `MSW_NO_MODEL`.
pub const NO_MODEL: u32 = u32::MAX;

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct IntervalC {
    pub lower: f32,
    pub upper: f32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct WorkC {
    pub bounds: u32,
    pub triangles: u32,
    pub exact: u32,
    pub opened: u32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct ClosestC {
    pub distance: IntervalC,
    pub point: [f32; 3],
    pub triangle: u32,
    pub ended: i32,
    pub work: WorkC,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct CoherentC {
    pub closest: ClosestC,
    pub safe_radius: f32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct SignedC {
    pub side: i32,
    pub reason: i32,
    pub distance: IntervalC,
    pub closest: ClosestC,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct WindingC {
    pub number: IntervalC,
    pub side: i32,
    pub reason: i32,
    pub ended: i32,
    pub work: WorkC,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct HitC {
    pub verdict: i32,
    pub ended: i32,
    pub t: IntervalC,
    pub hit_t: f32,
    pub point: [f32; 3],
    pub triangle: u32,
    pub work: WorkC,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct WithinC {
    pub verdict: i32,
    pub reason: i32,
    pub triangle: u32,
    pub work: WorkC,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct NeighborC {
    pub distance: IntervalC,
    pub point: [f32; 3],
    pub triangle: u32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct NearestC {
    pub stored: u32,
    pub ended: i32,
    pub rest_lower: f32,
    pub work: WorkC,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct OverlapC {
    pub verdict: i32,
    pub reason: i32,
    pub triangles: [u32; 2],
    pub work: WorkC,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct SceneC {
    pub verdict: i32,
    pub reason: i32,
    pub models: [u32; 2],
    pub work: WorkC,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct PairDistanceC {
    pub distance: IntervalC,
    pub points: [[f32; 3]; 2],
    pub triangles: [u32; 2],
    pub ended: i32,
    pub work: WorkC,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct PairContactC {
    pub verdict: i32,
    pub clear_until: f32,
    pub points: [[f32; 3]; 2],
    pub triangles: [u32; 2],
    pub ended: i32,
    pub work: WorkC,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct NodePairC {
    pub a: u16,
    pub b: u16,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct ApartC {
    pub verdict: i32,
    pub ended: i32,
    pub may_meet: NodePairC,
    pub work: WorkC,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct CandidatesC {
    pub verdict: i32,
    pub ended: i32,
    pub stored: u32,
    pub dropped: u32,
    pub work: WorkC,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct TriboxBoundC {
    pub lower: f32,
    pub node: u32,
    pub ended: i32,
    pub work: WorkC,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct RefinementC {
    pub is_complete: u32,
    pub error_left: f32,
    pub faces: u32,
    pub performed: u32,
    pub undone: u32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct FaceC {
    pub corners: [[f32; 3]; 3],
    pub error: f32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct FacesC {
    pub stored: u32,
    pub dropped: u32,
}

impl From<Interval> for IntervalC {
    fn from(Interval { lower, upper }: Interval) -> Self {
        IntervalC { lower, upper }
    }
}

impl From<Work> for WorkC {
    fn from(Work { bounds, triangles, exact, opened, .. }: Work) -> Self {
        WorkC { bounds, triangles, exact, opened }
    }
}

/// `MSW_ENDED_…`.
pub fn ended(ended: Ended) -> i32 {
    match ended {
        Ended::Exact => 1,
        Ended::Tolerance => 2,
        Ended::Steps => 3,
        Ended::Scratch => 4,
        _ => 5,
    }
}

/// `MSW_REASON_…`.
pub fn reason(reason: Undecided) -> i32 {
    match reason {
        Undecided::Steps => 2,
        Undecided::Scratch => 3,
        Undecided::OpenMesh => 5,
        Undecided::OnSurface => 6,
        Undecided::Feature => 7,
        _ => 4,
    }
}

/// `MSW_REASON_DECIDED`.
const DECIDED: i32 = 1;

/// `MSW_UNDECIDED`, `MSW_YES` or `MSW_NO`, and the reason.
pub fn verdict(verdict: Verdict) -> (i32, i32) {
    match verdict {
        Verdict::Yes => (1, DECIDED),
        Verdict::No => (2, DECIDED),
        Verdict::Undecided(why) => (0, reason(why)),
        _ => (0, 0),
    }
}

/// `MSW_SIDE_…`, and the reason.
pub fn side(side: Side) -> (i32, i32) {
    match side {
        Side::Inside => (1, DECIDED),
        Side::Outside => (2, DECIDED),
        Side::Undecided(why) => (0, reason(why)),
        _ => (0, 0),
    }
}

impl From<ClosestPoint> for ClosestC {
    fn from(found: ClosestPoint) -> Self {
        ClosestC {
            distance: found.distance.into(),
            point: found.point,
            triangle: found.triangle.unwrap_or(NO_TRIANGLE),
            ended: ended(found.ended),
            work: found.work.into(),
        }
    }
}

impl From<CoherentClosest> for CoherentC {
    fn from(found: CoherentClosest) -> Self {
        CoherentC { closest: found.closest.into(), safe_radius: found.safe_radius }
    }
}

impl From<SignedDistance> for SignedC {
    fn from(found: SignedDistance) -> Self {
        let (side, reason) = side(found.side);
        let (distance, closest) = (found.distance.into(), found.closest.into());
        SignedC { side, reason, distance, closest }
    }
}

impl From<WindingNumber> for WindingC {
    fn from(found: WindingNumber) -> Self {
        let (side, reason) = side(found.side);
        let (number, ended) = (found.number.into(), ended(found.ended));
        WindingC { number, side, reason, ended, work: found.work.into() }
    }
}

impl From<FirstHit> for HitC {
    fn from(found: FirstHit) -> Self {
        // The verdict of meshsweep.h, which C would have to work out from infinities.
        let verdict = match (found.is_clear(), found.hit, found.ended) {
            (true, ..) => 2,
            (false, Some(_), Ended::Exact) => 1,
            _ => 0,
        };
        let hit = found.hit.unwrap_or(meshsweep_core::Hit::EMPTY);
        HitC {
            verdict,
            ended: ended(found.ended),
            t: found.t.into(),
            hit_t: hit.t,
            point: hit.point,
            triangle: hit.triangle.unwrap_or(NO_TRIANGLE),
            work: found.work.into(),
        }
    }
}

impl From<Decided<u32>> for WithinC {
    fn from(found: Decided<u32>) -> Self {
        let (verdict, reason) = verdict(found.verdict);
        let triangle = found.witness.unwrap_or(NO_TRIANGLE);
        WithinC { verdict, reason, triangle, work: found.work.into() }
    }
}

impl From<Neighbor> for NeighborC {
    fn from(near: Neighbor) -> Self {
        NeighborC {
            distance: near.distance().into(),
            point: near.point(),
            triangle: near.triangle(),
        }
    }
}

impl From<KNearest> for NearestC {
    fn from(found: KNearest) -> Self {
        NearestC {
            stored: found.stored as u32,
            ended: ended(found.ended),
            rest_lower: found.rest_lower,
            work: found.work.into(),
        }
    }
}

impl From<Decided<[u32; 2]>> for OverlapC {
    fn from(found: Decided<[u32; 2]>) -> Self {
        let (verdict, reason) = verdict(found.verdict);
        let triangles = found.witness.unwrap_or([NO_TRIANGLE; 2]);
        OverlapC { verdict, reason, triangles, work: found.work.into() }
    }
}

impl From<Decided<[usize; 2]>> for SceneC {
    fn from(found: Decided<[usize; 2]>) -> Self {
        let (verdict, reason) = verdict(found.verdict);
        let models = found.witness.map_or([NO_MODEL; 2], |pair| pair.map(|index| index as u32));
        SceneC { verdict, reason, models, work: found.work.into() }
    }
}

impl From<PairDistance> for PairDistanceC {
    fn from(found: PairDistance) -> Self {
        let PairDistance { points, triangles, .. } = found;
        let (distance, ended) = (found.distance.into(), ended(found.ended));
        PairDistanceC { distance, points, triangles, ended, work: found.work.into() }
    }
}

/// `MSW_NO` if it is proved that there is no contact, else `MSW_UNDECIDED`.
const fn clear(is_clear: bool) -> i32 {
    if is_clear { 2 } else { 0 }
}

impl From<PairContact> for PairContactC {
    fn from(found: PairContact) -> Self {
        let PairContact { clear_until, points, triangles, .. } = found;
        let (verdict, ended) = (clear(found.is_clear()), ended(found.ended));
        PairContactC { verdict, clear_until, points, triangles, ended, work: found.work.into() }
    }
}

impl From<NodePair> for NodePairC {
    fn from(NodePair { a, b, .. }: NodePair) -> Self {
        NodePairC { a, b }
    }
}

impl From<Separation> for ApartC {
    fn from(found: Separation) -> Self {
        let may_meet = found.may_meet.map_or(NodePairC::default(), NodePairC::from);
        let (verdict, ended) = (clear(found.is_apart()), ended(found.ended));
        ApartC { verdict, ended, may_meet, work: found.work.into() }
    }
}

impl From<TriboxCandidates> for CandidatesC {
    fn from(found: TriboxCandidates) -> Self {
        let (stored, dropped) = (found.stored as u32, found.dropped);
        let (verdict, ended) = (clear(found.is_apart()), ended(found.ended));
        CandidatesC { verdict, ended, stored, dropped, work: found.work.into() }
    }
}

impl From<TriboxBound> for TriboxBoundC {
    fn from(found: TriboxBound) -> Self {
        let (lower, node) = (found.lower, found.node.unwrap_or(NO_NODE));
        TriboxBoundC { lower, node, ended: ended(found.ended), work: found.work.into() }
    }
}
