//! Answers. Each field is as in `meshsweep.h`. After an error a function leaves zeros, which prove
//! nothing: undecided, at distance 0.

#![allow(missing_docs, reason = "meshsweep.h says it")]

use meshsweep_core::{
    AllWithin, ClosestPoint, CoherentClosest, CurveClosest, CurveNeighbor, CurveSegment,
    CurveSignedDistance, Decided, DistanceBounds, Ended, FieldDistance, FirstHit, Interval,
    KNearest, Neighbor, NodePair, PairContact, PairDistance, Separation, Side, SignedBounds,
    SignedDistance, TriboxBound, TriboxCandidates, Undecided, UnitDistance, Verdict, WindingNumber,
    Work,
};

/// `MSW_NO_TRIANGLE`.
pub const NO_TRIANGLE: u32 = u32::MAX;
/// `MSW_NO_NODE`.
pub const NO_NODE: u32 = u32::MAX;
/// `MSW_NO_MODEL`.
pub const NO_MODEL: u32 = u32::MAX;
/// `MSW_NO_SEGMENT`.
pub const NO_SEGMENT: u32 = u32::MAX;

/// Structures of the header, with their fields in its order.
macro_rules! answers {
    ($($name:ident { $($field:ident: $of:ty),* })*) => {$(
        #[repr(C)]
        #[derive(Clone, Copy, Debug, Default)]
        pub struct $name {
            $(pub $field: $of),*
        }
    )*};
}

answers! {
    IntervalC { lower: f32, upper: f32 }
    WorkC { bounds: u32, triangles: u32, exact: u32, opened: u32 }
    ClosestC { distance: IntervalC, point: [f32; 3], triangle: u32, ended: i32, work: WorkC }
    CoherentC { closest: ClosestC, safe_radius: f32 }
    SignedC { side: i32, reason: i32, distance: IntervalC, closest: ClosestC }
    WindingC { number: IntervalC, side: i32, reason: i32, ended: i32, work: WorkC }
    HitC {
        verdict: i32, ended: i32, t: IntervalC, hit_t: f32, point: [f32; 3], triangle: u32,
        work: WorkC
    }
    WithinC { verdict: i32, reason: i32, triangle: u32, work: WorkC }
    NeighborC { distance: IntervalC, point: [f32; 3], triangle: u32 }
    AllWithinC { stored: u32, certain: u32, dropped: u32, ended: i32, work: WorkC }
    NearestC { stored: u32, ended: i32, rest_lower: f32, work: WorkC }
    OverlapC { verdict: i32, reason: i32, triangles: [u32; 2], work: WorkC }
    SceneC { verdict: i32, reason: i32, models: [u32; 2], work: WorkC }
    PairDistanceC {
        distance: IntervalC, points: [[f32; 3]; 2], triangles: [u32; 2], ended: i32, work: WorkC
    }
    PairContactC {
        verdict: i32, clear_until: f32, points: [[f32; 3]; 2], triangles: [u32; 2], ended: i32,
        work: WorkC
    }
    NodePairC { a: u16, b: u16 }
    ApartC { verdict: i32, ended: i32, may_meet: NodePairC, work: WorkC }
    CandidatesC { verdict: i32, ended: i32, stored: u32, dropped: u32, work: WorkC }
    TriboxBoundC { lower: f32, node: u32, ended: i32, work: WorkC }
    CurveClosestC {
        distance: IntervalC, point: [f32; 3], polyline: u32, segment: u32, t: f32,
        safe_motion: f32, ended: i32, work: WorkC
    }
    CurveSignedC { side: i32, reason: i32, distance: IntervalC, closest: CurveClosestC }
    CurveWithinC { verdict: i32, reason: i32, polyline: u32, segment: u32, work: WorkC }
    CurveNeighborC {
        distance: IntervalC, point: [f32; 3], polyline: u32, segment: u32, t: f32
    }
    FieldC { side: i32, reason: i32, distance: IntervalC }
    FieldGradientC { found: FieldC, gradient: [f32; 3] }
    UnitsC { lower: i32, upper: i32 }
    BoundsC { distance: IntervalC, ended: i32, work: WorkC }
    SignedBoundsC { side: i32, reason: i32, distance: IntervalC, ended: i32, work: WorkC }
    VerdictC { verdict: i32, reason: i32 }
    RefinementC { is_complete: u32, error_left: f32, faces: u32, performed: u32, undone: u32 }
    FaceC { corners: [[f32; 3]; 3], error: f32 }
    FacesC { stored: u32, dropped: u32 }
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

impl From<FieldDistance> for FieldC {
    fn from(found: FieldDistance) -> Self {
        let (side, reason) = side(found.side);
        FieldC { side, reason, distance: found.distance.into() }
    }
}

impl From<DistanceBounds> for BoundsC {
    fn from(found: DistanceBounds) -> Self {
        BoundsC {
            distance: found.distance.into(),
            ended: ended(found.ended),
            work: found.work.into(),
        }
    }
}

impl From<SignedBounds> for SignedBoundsC {
    fn from(found: SignedBounds) -> Self {
        let (side, reason) = side(found.side);
        SignedBoundsC {
            side,
            reason,
            distance: found.distance.into(),
            ended: ended(found.ended),
            work: found.work.into(),
        }
    }
}

impl From<UnitDistance> for UnitsC {
    fn from(UnitDistance { lower, upper, .. }: UnitDistance) -> Self {
        UnitsC { lower, upper }
    }
}

impl From<Verdict> for VerdictC {
    fn from(found: Verdict) -> Self {
        let (verdict, reason) = verdict(found);
        VerdictC { verdict, reason }
    }
}

impl ClosestC {
    /// No triangle is left.
    pub(crate) fn none() -> Self {
        let distance = IntervalC { lower: f32::INFINITY, upper: f32::INFINITY };
        let ended = ended(Ended::Exact);
        ClosestC { distance, triangle: NO_TRIANGLE, ended, ..ClosestC::default() }
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

impl From<AllWithin> for AllWithinC {
    fn from(found: AllWithin) -> Self {
        AllWithinC {
            stored: found.stored as u32,
            certain: found.certain as u32,
            dropped: found.dropped,
            ended: ended(found.ended),
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

impl From<CurveClosest> for CurveClosestC {
    fn from(found: CurveClosest) -> Self {
        let CurveSegment { polyline, segment } = found.segment;
        CurveClosestC {
            distance: found.distance.into(),
            point: found.point,
            polyline,
            segment,
            t: found.t,
            safe_motion: found.safe_motion,
            ended: ended(found.ended),
            work: found.work.into(),
        }
    }
}

impl From<CurveSignedDistance> for CurveSignedC {
    fn from(found: CurveSignedDistance) -> Self {
        let (side, reason) = side(found.side);
        let (distance, closest) = (found.distance.into(), found.closest.into());
        CurveSignedC { side, reason, distance, closest }
    }
}

impl From<Decided<CurveSegment>> for CurveWithinC {
    fn from(found: Decided<CurveSegment>) -> Self {
        let (verdict, reason) = verdict(found.verdict);
        let none = CurveSegment { polyline: NO_SEGMENT, segment: NO_SEGMENT };
        let CurveSegment { polyline, segment } = found.witness.unwrap_or(none);
        CurveWithinC { verdict, reason, polyline, segment, work: found.work.into() }
    }
}

impl From<CurveNeighbor> for CurveNeighborC {
    fn from(near: CurveNeighbor) -> Self {
        let CurveSegment { polyline, segment } = near.segment();
        let (distance, point, t) = (near.distance().into(), near.point(), near.t());
        CurveNeighborC { distance, point, polyline, segment, t }
    }
}

impl From<TriboxBound> for TriboxBoundC {
    fn from(found: TriboxBound) -> Self {
        let (lower, node) = (found.lower, found.node.unwrap_or(NO_NODE));
        TriboxBoundC { lower, node, ended: ended(found.ended), work: found.work.into() }
    }
}
