//! A structure of a blob that answers distances from points.

use meshsweep_core::{
    Budget, Bvh, BvhWithSdf, ClosestPoint, Curve, CurveSegment, Ended, Hint, Hull, Interval,
    QueryError, ScratchEntry, Side, SignedDistance, TightHull, Undecided, Verdict, Work,
};

/// A structure that answers distances from points.
#[derive(Clone, Copy, Debug)]
pub enum Distances<'a> {
    /// A box tree with boxes for distances.
    Tree(Bvh<'a>),
    /// The same with a distance field, which is asked first.
    TreeWithField(BvhWithSdf<'a>),
    /// A hull hierarchy.
    Hull(Hull<'a>),
    /// A tight hull with boxes for distances.
    Tight(TightHull<'a>),
    /// Curves.
    Curve(Curve<'a>),
}

/// What a point is on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Element {
    /// The triangle with this number in the input file.
    Triangle(u32),
    /// A segment of a curve.
    Segment(CurveSegment),
}

/// A closest point, as [`ClosestPoint`] says.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Closest {
    /// The distance to the input, input units.
    pub distance: Interval,
    /// A point of the surface or the curve, rounded to f32.
    pub point: [f32; 3],
    /// What holds the point. `None` if the structure does not know it.
    pub element: Option<Element>,
    /// Of curves: of every point that is less than this away, the element is the closest one.
    pub safe_motion: Option<f32>,
    /// The work of the search.
    pub work: Work,
    /// Why the search ended.
    pub ended: Ended,
}

impl From<ClosestPoint> for Closest {
    fn from(found: ClosestPoint) -> Self {
        let ClosestPoint { distance, point, triangle, work, ended, .. } = found;
        let element = triangle.map(Element::Triangle);
        Self { distance, point, element, safe_motion: None, work, ended }
    }
}

/// Whether something is within a distance.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct AnyWithin {
    /// `Yes`: a point of the input is not farther. `No`: all of it is farther.
    pub verdict: Verdict,
    /// With `Yes` an element that is not farther, if the structure knows it.
    pub element: Option<Element>,
    /// The work of the search.
    pub work: Work,
}

impl Distances<'_> {
    /// The structure in words.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Tree(_) => "box tree",
            Self::TreeWithField(_) => "box tree with a distance field",
            Self::Hull(_) => "hull hierarchy",
            Self::Tight(_) => "finest tight hull",
            Self::Curve(_) => "curve",
        }
    }

    /// Least and greatest corner of a box that holds the input, input units.
    #[must_use]
    pub fn bounds(&self) -> [[f32; 3]; 2] {
        match self {
            Self::Tree(tree) => tree.bounds(),
            Self::TreeWithField(both) => both.tree().bounds(),
            Self::Hull(hull) => hull.bounds(),
            Self::Tight(hull) => hull.bvh().bounds(),
            Self::Curve(curve) => curve.bounds(),
        }
    }

    /// With so many entries no question ends for lack of memory.
    #[must_use]
    pub fn scratch_entries(&self) -> usize {
        match self {
            Self::Tree(tree) => tree.scratch_entries(),
            Self::TreeWithField(both) => both.tree().scratch_entries(),
            Self::Hull(hull) => hull.scratch_entries(),
            Self::Tight(hull) => hull.scratch_entries(),
            Self::Curve(curve) => curve.scratch_entries(),
        }
    }

    /// The closest point. A box tree is searched without a hint, so that the work depends on the
    /// point alone.
    ///
    /// # Errors
    /// Those of the structure.
    pub fn closest_point(
        &self,
        point: [f32; 3],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<Closest, QueryError> {
        let found = match self {
            Self::Tree(tree) => {
                tree.closest_point_in_order(point, &mut Hint::NONE.clone(), budget, scratch)?
            }
            Self::TreeWithField(both) => both.closest_point(point, budget, scratch)?,
            Self::Hull(hull) => hull.closest_point(point, budget, scratch)?,
            Self::Tight(hull) => hull.closest_point(point, budget, scratch)?,
            Self::Curve(curve) => {
                let found = curve.closest_point(point, budget, scratch)?;
                return Ok(Closest {
                    distance: found.distance,
                    point: found.point,
                    element: Some(Element::Segment(found.segment)),
                    safe_motion: Some(found.safe_motion),
                    work: found.work,
                    ended: found.ended,
                });
            }
        };
        Ok(found.into())
    }

    /// Whether anything is within a distance. A hull hierarchy tells it from the closest point.
    ///
    /// # Errors
    /// Those of the structure.
    pub fn any_within(
        &self,
        point: [f32; 3],
        distance: f32,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<AnyWithin, QueryError> {
        let found = match self {
            Self::Tree(tree) => tree.within(point, distance, budget, scratch)?,
            Self::TreeWithField(both) => both.within(point, distance, budget, scratch)?,
            Self::Tight(hull) => hull.within(point, distance, budget, scratch)?,
            Self::Curve(curve) => {
                let found = curve.within(point, distance, budget, scratch)?;
                let element = found.witness.map(Element::Segment);
                return Ok(AnyWithin { verdict: found.verdict, element, work: found.work });
            }
            Self::Hull(hull) => {
                if !(distance.is_finite() && distance >= 0.0) {
                    return Err(QueryError::Tolerance);
                }
                let near = hull.closest_point(point, budget, scratch)?;
                return Ok(within_by(&near, distance));
            }
        };
        let element = found.witness.map(Element::Triangle);
        Ok(AnyWithin { verdict: found.verdict, element, work: found.work })
    }
}

/// Whether the interval of a closest point tells that it is within a distance.
fn within_by(near: &ClosestPoint, distance: f32) -> AnyWithin {
    let Interval { lower, upper } = near.distance;
    let verdict = if lower > distance {
        Verdict::No
    } else if upper <= distance {
        Verdict::Yes
    } else {
        Verdict::Undecided(match near.ended {
            Ended::Steps => Undecided::Steps,
            Ended::Scratch => Undecided::Scratch,
            _ => Undecided::Resolution,
        })
    };
    let triangle = near.triangle.filter(|_| verdict == Verdict::Yes);
    AnyWithin { verdict, element: triangle.map(Element::Triangle), work: near.work }
}

/// Whether sides are defined: by the nearest triangle of a closed mesh, or by winding numbers.
#[must_use]
pub fn has_sides(tree: &Bvh<'_>) -> bool {
    tree.has_sides() || tree.serves_winding()
}

/// Signed distance. The side is that of the nearest triangle, if it tells one, else that of the
/// winding number, if the blob has moments.
///
/// # Errors
/// Those of [`Bvh::signed_distance`] and [`Bvh::signed_distance_by_winding`].
pub fn signed_distance(
    tree: &Bvh<'_>,
    point: [f32; 3],
    budget: Budget,
    scratch: &mut [ScratchEntry],
) -> Result<SignedDistance, QueryError> {
    if !tree.serves_winding() {
        return tree.signed_distance(point, budget, scratch);
    }
    if tree.has_sides() {
        let found = tree.signed_distance(point, budget, scratch)?;
        if !matches!(found.side, Side::Undecided(_)) {
            return Ok(found);
        }
    }
    tree.signed_distance_by_winding(point, budget, scratch)
}

/// The same of a box tree with a distance field. The side is that of the field, if it tells one.
///
/// # Errors
/// Those of [`signed_distance`].
pub fn signed_distance_by_field(
    both: &BvhWithSdf<'_>,
    point: [f32; 3],
    budget: Budget,
    scratch: &mut [ScratchEntry],
) -> Result<SignedDistance, QueryError> {
    let found = both.signed_distance(point, budget, scratch)?;
    match found.side {
        Side::Undecided(_) if both.tree().serves_winding() => {
            both.tree().signed_distance_by_winding(point, budget, scratch)
        }
        _ => Ok(found),
    }
}
