//! The work of each answer, which is no part of a hash.

use meshsweep_core::{
    AllHits, AllOverlaps, AllWithin, ClosestPoint, CoherentClosest, CurveClosest,
    CurveSignedDistance, Decided, DistanceBounds, FirstHit, FrontFacing, KNearest, PairContact,
    PairDistance, Penetration, SceneDistance, Separation, SignedBounds, SignedDistance,
    SolidDistance, TriboxBound, TriboxCandidates, WindingNumber, Work,
};

/// An answer that tells its work.
pub(super) trait Worked {
    /// What the core did for it.
    fn work(&self) -> Work;
}

macro_rules! worked {
    ($($answer:ty: $($field:ident).+;)*) => {$(
        impl Worked for $answer {
            #[inline(always)]
            fn work(&self) -> Work {
                self.$($field).+
            }
        }
    )*};
}

worked! {
    AllHits: work;
    AllOverlaps: work;
    AllWithin: work;
    ClosestPoint: work;
    CoherentClosest: closest.work;
    CurveClosest: work;
    CurveSignedDistance: closest.work;
    DistanceBounds: work;
    FirstHit: work;
    KNearest: work;
    PairContact: work;
    PairDistance: work;
    Penetration: work;
    SceneDistance: work;
    Separation: work;
    SignedBounds: work;
    SignedDistance: closest.work;
    SolidDistance: work;
    TriboxBound: work;
    TriboxCandidates: work;
    WindingNumber: work;
}

impl<W> Worked for Decided<W> {
    #[inline(always)]
    fn work(&self) -> Work {
        self.work
    }
}

/// It looks at each leaf once, and counts nothing.
impl Worked for FrontFacing {
    #[inline(always)]
    fn work(&self) -> Work {
        Work::default()
    }
}
