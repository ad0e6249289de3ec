//! Where a model that moves first comes near another one.

use crate::bvh::format::Bvh;
use crate::geom::Pose;
use crate::num::tolerance::{ADVANCE_KEPT, U32, U64};
use crate::num::{down_to_f32, greater};
use crate::query::{Budget, Ended, PairContact, QueryError, ScratchEntry, Work};

/// Most distances of a search. Near contact each gains a part of the gap that is left.
const MOST_ADVANCES: u32 = 512;

/// Part of the motion below which an advance ends the search: half of the last bit of f32 at 1.
const LEAST_ADVANCE: f64 = 1.0 / (1u64 << 25) as f64;

impl Bvh<'_> {
    /// Where the surface of `other`, which moves from the pose `from` to the pose `to`, first comes
    /// within `keep` of the surface of this tree.
    ///
    /// Each point of `other` goes along a straight line from its place in `from` to its place in
    /// `to`, all at a steady pace: the entries of both poses are mixed. So two poses with the same
    /// rotation are a translation. Of a rotation it is the chord: split it into pieces of an angle
    /// φ, and add r·φ²/8 to `keep` of each, r the distance of the farthest point from the axis.
    ///
    /// Before `clear_until` the surfaces of the input meshes are proved to be farther than `keep`
    /// apart, at every instant. If [`is_clear`](PairContact::is_clear), they are during the whole
    /// motion. Only surfaces count: a mesh may move inside of another one.
    ///
    /// `scratch`: [`DISTANCE_ENTRIES`](Bvh::DISTANCE_ENTRIES) are always enough. The steps (pairs
    /// of nodes) of the budget are those of all distances together. Tolerances are ignored. Where
    /// less is found out, `clear_until` is earlier.
    ///
    /// Cost: a [`distance`](Bvh::distance) for each advance: three to ten where the motion passes
    /// at some distance, some dozens before contact, more where the surfaces glide along each
    /// other.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Bvh, Pose, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
    /// let (part, mut scratch) = (Bvh::open(bytes)?, Scratch::<{ Bvh::DISTANCE_ENTRIES }>::new());
    /// let at = |x: f32| Pose { translation: [x, 0.0, 300.0], ..Pose::IDENTITY };
    /// let ends = [at(-400.0), at(400.0)];
    /// let found = part.first_contact_of(&part, ends, 2.0, Budget::EXACT, &mut scratch)?;
    /// assert!(found.is_clear());
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// Source: conservative advancement after Mirtich, *Impulse-based Dynamic Simulation of Rigid
    /// Body Systems* (1996), by proved distances.
    ///
    /// # Errors
    /// Those of [`distance`](Bvh::distance), also for a `keep` that is negative, NaN or infinite.
    pub fn first_contact_of(
        &self,
        other: &Bvh<'_>,
        [from, to]: [Pose; 2],
        keep: f32,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<PairContact, QueryError> {
        // A distance is refused as an absolute tolerance is.
        budget.with_absolute(keep).check()?;
        let is_finite = |pose: &Pose| {
            pose.rotation.iter().flatten().chain(&pose.translation).all(|x| x.is_finite())
        };
        if !(is_finite(&from) && is_finite(&to)) {
            return Err(QueryError::NotFinite);
        }
        let Course { quickest, rounding } = Course::of(other, &from, &to);
        let mut contact = PairContact {
            clear_until: 0.0,
            points: [[0.0; 3]; 2],
            triangles: [0; 2],
            work: Work::default(),
            ended: Ended::Resolution,
        };
        let mut t = 0.0;
        for _ in 0..MOST_ADVANCES {
            let steps = budget.steps.saturating_sub(contact.work.splits);
            let pose = between(&from, &to, t);
            let budget = Budget::EXACT.with_steps(steps);
            let found = self.distance(other, pose, budget, scratch)?;
            contact.work = contact.work.and(found.work);
            (contact.points, contact.triangles) = (found.points, found.triangles);
            let gap = f64::from(found.distance.lower) - (f64::from(keep) + rounding);
            let is_cut = matches!(found.ended, Ended::Steps | Ended::Scratch);
            let advance = if gap > 0.0 { gap / quickest * ADVANCE_KEPT } else { 0.0 };
            let next = t + advance;
            if next > 1.0 {
                return Ok(PairContact {
                    clear_until: f32::INFINITY,
                    ended: Ended::Exact,
                    ..contact
                });
            }
            let goes_on = advance >= LEAST_ADVANCE;
            if !goes_on {
                contact.ended = if is_cut { found.ended } else { Ended::Resolution };
                break;
            }
            t = next;
        }
        contact.clear_until = down_to_f32(t);
        Ok(contact)
    }
}

/// How the points of a model move, input units.
struct Course {
    /// No point goes farther during the whole motion.
    quickest: f64,
    /// How far a point may be from its place at a pose that was rounded to f32.
    rounding: f64,
}

impl Course {
    fn of(tree: &Bvh<'_>, from: &Pose, to: &Pose) -> Course {
        let [low, high] = tree.bounds();
        let error = f64::from(tree.surface_error());
        let mut course = Course { quickest: 0.0, rounding: 0.0 };
        // How far a point goes is a convex function of the point: a corner goes farthest.
        for corner in 0..8u32 {
            let side = |axis: u32, low: f32, high: f32| {
                // The box is of stored vertices, and rounded.
                let grown = |x: f32| error + f64::from(x).abs() * f64::from(U32);
                if corner >> axis & 1 == 0 {
                    f64::from(low) - grown(low)
                } else {
                    f64::from(high) + grown(high)
                }
            };
            let (mut way_sq, mut rounding) = (0.0, 0.0);
            let starts = from.rotation.iter().zip(&from.translation);
            let ends = to.rotation.iter().zip(&to.translation);
            for ((row, shift), (end_row, end_shift)) in starts.zip(ends) {
                let mut way = difference(*shift, *end_shift);
                let mut far = most(*shift, *end_shift);
                let entries = row.iter().zip(end_row).zip(low.iter().zip(&high));
                for (axis, ((a, b), (low, high))) in (0u32..).zip(entries) {
                    let x = side(axis, *low, *high);
                    way += difference(*a, *b) * x;
                    far += most(*a, *b) * x.abs();
                }
                // Terms that cancel are rounded in proportion to their sizes.
                let way = way.abs() + far * (16.0 * U64);
                way_sq += way * way;
                rounding += far * (f64::from(U32) * (1.0 + 16.0 * U64));
            }
            let way = libm::sqrt(way_sq) * (1.0 + 16.0 * U64);
            course.quickest = greater(course.quickest, way);
            course.rounding = greater(course.rounding, rounding);
        }
        course
    }
}

fn difference(a: f32, b: f32) -> f64 {
    f64::from(b) - f64::from(a)
}

/// The greater size, and no less than what an f32 may lose by underflow.
fn most(a: f32, b: f32) -> f64 {
    greater(f64::from(a).abs(), f64::from(b).abs()) + f64::from(f32::MIN_POSITIVE)
}

/// The entries of two poses, mixed.
fn between(from: &Pose, to: &Pose, t: f64) -> Pose {
    let mix = |a: f32, b: f32| (f64::from(a) + difference(a, b) * t) as f32;
    let mut pose = *from;
    let entries = pose.rotation.iter_mut().flatten().zip(to.rotation.iter().flatten());
    entries.for_each(|(x, to)| *x = mix(*x, *to));
    pose.translation.iter_mut().zip(&to.translation).for_each(|(x, to)| *x = mix(*x, *to));
    pose
}
