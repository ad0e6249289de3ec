//! Finds the nearest triangles among the pairs of leaves that f32 left. Pairs that are far apart
//! along an integer direction are not measured; the others are measured in f64.
//! `core/docs/rounding.md` §26, *The nearest triangles*.

use super::int_pair_direction::IntPairDirection;
use super::leaf_gaps::{LeafGaps, SettledPairs};
use super::question::PairQuestion;
use crate::bvh::pair::pair_keys::PAIRS;
use crate::bvh::tree::format::FanLeaf;
use crate::bvh::tree::gap::TriangleGap;
use crate::bvh::tree::triangle_at::TriangleAt;
use crate::geom::fan::WIDTH;
use crate::num::tolerance::{INT_GAP, INT_PART};
use crate::num::{greater, lesser};
use crate::query::Work;

/// The search among the candidates of f32, with the direction and limit so far.
pub(crate) struct NearestAlong<'a> {
    leaves: LeafGaps<'a>,
    /// The direction between the points measured last.
    between: IntPairDirection<'a>,
    /// A pair of triangles that is at least this far apart is not measured. Common units.
    lower: f64,
    /// Pairs were skipped, and the question was not yet told.
    has_beyond: bool,
}

impl<'a> NearestAlong<'a> {
    /// After the first measured pair. `None` if its triangles touch.
    pub(crate) fn new(leaves: LeafGaps<'a>, question: &PairQuestion<'_>) -> Option<Self> {
        let between = IntPairDirection::new(leaves.pose, leaves.offset)?;
        let mut along = NearestAlong { leaves, between, lower: 0.0, has_beyond: false };
        along.lower = along.lower_of(question);
        along.between.set_far(along.far());
        Some(along)
    }

    /// The limit less what `INT_GAP` and `INT_PART` give up.
    fn lower_of(&self, question: &PairQuestion<'_>) -> f64 {
        let pose = self.leaves.pose;
        let ([unit, _], limit) = (pose.units, question.limit());
        let coarser = greater(f64::from(unit), pose.longest);
        limit - lesser(coarser * INT_GAP, limit * INT_PART)
    }

    /// The computed gap that proves `lower`.
    fn far(&self) -> f64 {
        let rounding = self.leaves.pose.vertex_error_f64;
        self.lower + (rounding + rounding)
    }

    /// Tells the question of the pairs that were not measured.
    pub(crate) fn report_beyond(
        &mut self,
        places: [TriangleAt; 2],
        question: &mut PairQuestion<'_>,
    ) {
        if self.has_beyond {
            // An infinite upper end is never the best, so the points are not used.
            let (points, upper) = ([[0.0; 3]; 2], f64::INFINITY);
            let lower = self.lower;
            question.take(&TriangleGap { place: places, lower, upper, meets: false, points });
            self.has_beyond = false;
        }
    }

    /// Measures the pairs of triangles of two leaves that may be nearer than the limit, but not
    /// `measured`. Returns whether the question goes on.
    pub(crate) fn visit(
        &mut self,
        leaves: [&FanLeaf<'_>; 2],
        [places, measured]: [[TriangleAt; 2]; 2],
        question: &mut PairQuestion<'_>,
        work: &mut Work,
    ) -> Option<bool> {
        let triangles = leaves.map(|leaf| leaf.shape().triangles());
        let pairs = triangles[0].saturating_mul(triangles[1]);
        work.triangles = work.triangles.saturating_add(pairs as u32);
        // Pairs that do not exist count as settled.
        let mut settled = !pairs_of(triangles);
        if measured.map(|at| at.with_lane(0)) == places.map(|at| at.with_lane(0)) {
            settled |= 1u64 << ((measured[0].lane() * WIDTH + measured[1].lane()) & (PAIRS - 1));
        }
        loop {
            let beyond = self.between.pairs_beyond(leaves, places)?;
            self.has_beyond |= beyond & !settled != 0;
            settled |= beyond;
            if settled == u64::MAX {
                return Some(true);
            }
            self.report_beyond(places, question);
            let some = Some(SettledPairs { pairs: settled, far: self.far() });
            let visit = self.leaves.visit(leaves, places, some, question, false, work)?;
            if visit.has_beyond {
                self.has_beyond = true;
                self.report_beyond(places, question);
            }
            if !visit.goes_on || visit.pairs == 0 {
                return Some(visit.goes_on);
            }
            settled |= visit.pairs;
            self.lower = self.lower_of(question);
            if let Some(new) = IntPairDirection::new(self.leaves.pose, self.leaves.offset) {
                self.between = new;
            }
            self.between.set_far(self.far());
        }
    }
}

/// The bits of all pairs of so many triangles.
fn pairs_of([rows, columns]: [usize; 2]) -> u64 {
    let row = (1u64 << (columns & 15)) - 1;
    (0..WIDTH).take(rows).fold(0, |bits, i| bits | (row & 0xFF) << (i * WIDTH))
}
