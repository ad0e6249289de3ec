//! A segment and the triangles of a leaf.
//!
//! The fan kernels flag the triangles of a leaf that the line may meet. Only flagged triangles are
//! tested one by one. Each test gives the interval of parameters in which the *input's* triangle
//! can be met.
//!
//! | word | meaning |
//! | --- | --- |
//! | flagged | the line may meet the triangle, by the quick test of the whole leaf |
//! | crossing | the segment may meet the input's triangle, by the test of the triangle alone |
//! | certain | the segment meets the input's triangle: proved |
//! | stored | the segment meets the stored triangle, as computed |
//! | shadow | a vertex projected along the segment onto a plane; the line is the plane's origin |
//! | covered | the shadows of undecided triangles of one fan together contain the origin: proved |

use super::query::SegmentQuery;
use crate::bvh::tree::descent::{LeafVisit, LeafVisitor};
use crate::bvh::tree::format::FanLeaf;
use crate::bvh::tree::triangle_at::TriangleAt;
#[cfg(not(meshsweep_wide))]
use crate::geom::fan::may_meet;
#[cfg(not(any(meshsweep_wide, meshsweep_soft_float)))]
use crate::geom::fan::ray_leaf;
#[cfg(meshsweep_wide)]
use crate::geom::fan::ray_leaf8;
use crate::geom::fan::{Crossing, WIDTH};
use crate::geom::fan::{FanRay, Shadow};

/// Which sides of triangles a segment meets. The front is where corners run counter-clockwise in
/// the input file. What the builder turns to tell inside from outside is not turned here.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Facing {
    /// Both.
    #[default]
    Both,
    /// Fronts only: back faces are culled.
    Front,
    /// Backs only.
    Back,
}

/// Takes the triangles that a segment may meet, in any order.
pub(crate) trait CrossingCollector {
    /// A triangle that is met later than the parameter with these bits cannot change the answer.
    fn limit(&self) -> u32;
    /// A triangle of the wanted facing that the segment crosses. `None` says that the tree is
    /// unchecked.
    fn meet(&mut self, crossing: &Crossing, triangle: TriangleAt) -> Option<()>;
    /// The input's surface is met, not later than this.
    fn certain(&mut self, upper: f32);
    /// The input's surface is met, not later than `upper`, by one of a leaf's undecided triangles,
    /// a bit of `lanes` for each; `first` is the leaf's first. Next to an inner edge of a fan each
    /// is undecided, yet the segment certainly meets one of them.
    fn covered(&mut self, lanes: u32, upper: f32, first: TriangleAt) -> Option<()>;
    /// Whether the question is answered.
    fn is_answered(&self) -> bool;
    /// Whether an undecided triangle matters next to a certain one in the same leaf.
    const TELLS_EACH: bool;
}

/// Triangles of a leaf that the line may meet, a bit for each.
pub(crate) trait FlaggedOfLeaf: Fn(&FanLeaf<'_>, &SegmentQuery) -> Option<u32> {}

impl<F: Fn(&FanLeaf<'_>, &SegmentQuery) -> Option<u32>> FlaggedOfLeaf for F {}

/// [`flagged`] for the instructions that the crate is compiled for.
#[inline(always)]
pub(crate) fn compiled_flagged() -> impl FlaggedOfLeaf {
    inlined(
        #[inline(always)]
        |leaf: &FanLeaf<'_>, query: &SegmentQuery| flagged(leaf, query),
    )
}

/// A place for the attribute of a closure.
#[inline(always)]
fn inlined<F: FlaggedOfLeaf>(flagged: F) -> F {
    flagged
}

/// The visitor of all segment questions.
pub(crate) struct SegmentVisitor<'a, C, F> {
    pub(crate) query: &'a SegmentQuery,
    pub(crate) facing: Facing,
    pub(crate) flagged: F,
    pub(crate) collector: C,
}

impl<C: CrossingCollector, F: FlaggedOfLeaf> LeafVisitor for SegmentVisitor<'_, C, F> {
    #[inline(always)]
    fn limit(&self) -> u32 {
        self.collector.limit()
    }

    #[inline(always)]
    fn leaf(&mut self, visit: &LeafVisit<'_>) -> Option<bool> {
        let lanes = (self.flagged)(&visit.leaf, self.query)?;
        if lanes == 0 {
            return Some(true);
        }
        self.test_one_by_one(visit, lanes)?;
        Some(!self.collector.is_answered())
    }
}

/// Triangles of a leaf that the line may meet.
#[cfg(meshsweep_wide)]
#[inline(always)]
fn flagged(leaf: &FanLeaf<'_>, query: &SegmentQuery) -> Option<u32> {
    let (ray, shape) = (&query.ray, leaf.shape());
    if leaf.is_f32() {
        return ray_leaf8(ray, &leaf.f32_ring8(ray.axes())?, shape.turn(), shape.triangles());
    }
    leaf.grid_flagged(ray)
}

/// The same in registers of 256 bits, whatever the crate is compiled for.
#[cfg(meshsweep_avx2)]
#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt")]
#[inline]
pub(crate) fn flagged_avx2(leaf: &FanLeaf<'_>, query: &SegmentQuery) -> Option<u32> {
    if leaf.is_f32() {
        return f32_flagged(leaf, query);
    }
    leaf.flagged_avx2(&query.ray)
}

/// By the registers that the crate is compiled for, in a call: what they need would be mixed with
/// registers of 256 bits.
#[cfg(meshsweep_avx2)]
#[inline(never)]
fn f32_flagged(leaf: &FanLeaf<'_>, query: &SegmentQuery) -> Option<u32> {
    flagged(leaf, query)
}

/// Triangles of a leaf that the line may meet.
#[cfg(not(meshsweep_wide))]
#[inline(always)]
fn flagged(leaf: &FanLeaf<'_>, query: &SegmentQuery) -> Option<u32> {
    let (ray, shape) = (&query.ray, leaf.shape());
    if leaf.is_f32() {
        return Some(flagged_f32(leaf, ray));
    }
    let ring = leaf.full_ring_in_order(ray.axes())?;
    let (centres, vertices) = (ring.centres_in_order(shape, ray.axes()), ring.vertices(shape));
    #[cfg(meshsweep_soft_float)]
    let flagged = match query.line.near(centres, vertices, shape) {
        0 => 0,
        near => flagged_near(leaf, ray, near),
    };
    #[cfg(not(meshsweep_soft_float))]
    let flagged = {
        let [ox, oy, oz] = ray.in_order(leaf.origin);
        let shadow = |[x, y, z]: [i32; 3]| {
            let sum = |x: i32, origin: i32| x.wrapping_add(origin) as f32;
            ray.shadow_in_order([sum(x, ox), sum(y, oy), sum(z, oz)])
        };
        // Not by `map`: the compiler does not inline that at `opt-level = "s"`.
        let [first, second] = centres;
        ray_leaf(ray, shape.turn(), [shadow(first), shadow(second)], vertices.map(shadow))
    };
    Some(flagged)
}

/// The flagged ones of a few triangles.
#[cfg(meshsweep_soft_float)]
#[inline(never)]
fn flagged_near(leaf: &FanLeaf<'_>, ray: &FanRay, near: u32) -> u32 {
    let (mut left, mut flagged) = (near, 0);
    while left != 0 {
        let lane = left.trailing_zeros() as usize;
        left &= left - 1;
        let centre = ray.shadow(leaf.centre(usize::from(lane >= leaf.shape().turn())));
        let ends = [lane, lane + 1].map(|i| ring_shadow(leaf, ray, i));
        flagged |= flagged_alone(ray, centre, ends) << lane;
    }
    flagged
}

/// The shadow of ring vertex `i`.
#[cfg_attr(meshsweep_small, inline(never))]
#[cfg_attr(not(meshsweep_small), inline(always))]
fn ring_shadow(leaf: &FanLeaf<'_>, ray: &FanRay, i: usize) -> Shadow {
    ray.shadow(leaf.ring(i))
}

/// Whether one triangle of a fan is flagged.
#[cfg(not(meshsweep_wide))]
#[inline(never)]
fn flagged_alone(ray: &FanRay, centre: Shadow, ends: [Shadow; 2]) -> u32 {
    u32::from(may_meet(ray, centre, ends))
}

#[cfg(not(meshsweep_wide))]
#[inline(never)]
fn flagged_f32(leaf: &FanLeaf<'_>, ray: &FanRay) -> u32 {
    let shape = leaf.shape();
    let shadow = |centre: usize| ray.shadow(leaf.centre(centre));
    let centres = [shadow(0), shadow(shape.centres() - 1)];
    let (mut flagged, mut from) = (0, ring_shadow(leaf, ray, 0));
    for lane in 0..shape.triangles() {
        let to = ring_shadow(leaf, ray, lane + 1);
        let centre = centres[usize::from(lane >= shape.turn())];
        flagged |= flagged_alone(ray, centre, [from, to]) << lane;
        from = to;
    }
    flagged
}

impl<C: CrossingCollector, F> SegmentVisitor<'_, C, F> {
    /// Tests the flagged triangles of a leaf.
    #[inline(never)]
    fn test_one_by_one(&mut self, visit: &LeafVisit<'_>, flagged: u32) -> Option<()> {
        let (leaf, bound) = (&visit.leaf, f32::from_bits(visit.key));
        let shape = leaf.shape();
        let ray = &self.query.ray;
        let sign = match self.facing {
            Facing::Both => 0.0,
            Facing::Front => ray.front(),
            Facing::Back => -ray.front(),
        };
        let wanted = |second: bool| if second && shape.second_reversed() { -sign } else { sign };
        let mut is_certain = false;
        // For each fan its undecided triangles, and their greatest parameter.
        let (mut undecided, mut upper) = ([0u32; 2], [0f32; 2]);
        // Whether the segment reaches all of them, if the line does.
        let mut within = [true; 2];
        let mut left = flagged;
        while left != 0 {
            let lane = left.trailing_zeros();
            left &= left - 1;
            let second = lane as usize >= shape.turn();
            let fan = usize::from(second);
            let ring = |i: usize| ring_shadow(leaf, ray, i);
            let corners =
                [ray.shadow(leaf.centre(fan)), ring(lane as usize), ring(lane as usize + 1)];
            let found = ray.crossing(corners, wanted(second));
            let Some(mut crossing) = found else { continue };
            // The whole leaf lies in its box, so no parameter below the box's bound is possible.
            // Without this the answer would depend on the order of visits.
            if crossing.lower < bound {
                crossing.lower = bound;
            }
            if crossing.t < bound {
                crossing.t = bound;
            }
            // This happens only if a box does not hold its triangles, which `open` does not check.
            // Then the interval must not end before it begins.
            if crossing.upper < bound {
                crossing.upper = bound;
            }
            self.collector.meet(&crossing, visit.triangle(lane as usize))?;
            if crossing.certain {
                is_certain = true;
                self.collector.certain(crossing.upper);
            } else {
                undecided[fan & 1] |= 1 << lane;
                within[fan & 1] &= crossing.within;
                if crossing.upper > upper[fan & 1] {
                    upper[fan & 1] = crossing.upper;
                }
            }
        }
        if is_certain && !C::TELLS_EACH {
            return Some(());
        }
        for fan in 0..2 {
            if undecided[fan] != 0 && within[fan] {
                let (from, to) = if fan == 0 { (0, shape.turn()) } else { (shape.turn(), WIDTH) };
                let to = if to < shape.triangles() { to } else { shape.triangles() };
                let centre = ray.shadow(leaf.centre(fan));
                let turns =
                    ray.cover(centre, |i| ring_shadow(leaf, ray, i), undecided[fan], from, to);
                let is_covered =
                    turns.is_some_and(|turns| turns != 0 && turns as f32 * wanted(fan == 1) >= 0.0);
                if is_covered {
                    let (lanes, upper) = (undecided[fan], upper[fan]);
                    self.collector.covered(lanes, upper, visit.triangle(0))?;
                }
            }
        }
        Some(())
    }
}
