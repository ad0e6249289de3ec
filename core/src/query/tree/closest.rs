//! Closest point on the box tree.

use super::probe::{Probe, bounds};
use super::walk::{Descent, Seek, TreeEntry, Visit, descend};
use crate::blob::{Patch, Tree, TreeChild};
use crate::fan::{PointFan, WIDTH, certified_distance, point_patch, point_patch8};
use crate::num::tolerance::TREE_WEAK;
use crate::query::{ClosestPoint, Ended, QueryError, Stop, Work};
use crate::tree::WIDE;
use glam::Vec3;

/// Where an answer was found: the leaf to look at first for a query nearby. Any value is safe; a bad one costs a leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hint(u32);

impl Hint {
    /// Nothing is known.
    pub const NONE: Hint = Hint(u32::MAX);
}

/// Closest point of the surface to `point` (input units, the mesh's frame), with an interval that contains the distance to the input mesh.
///
/// `stack` is working memory; [`TreeHeader::stack_entries`](crate::blob::TreeHeader) entries make overflow impossible. With fewer the interval still
/// holds, and [`Ended::Capacity`] says so. Equidistant triangles: the least in blob order. All arithmetic is f32.
///
/// Cost: five to fifteen nodes and three to twelve leaves on scanned parts. The worst case is the whole tree, at the centre of a sphere: where
/// time is bounded, set [`Stop::steps`]. Farther than a million model sizes the interval is that of the model's box.
///
/// # Errors
/// [`QueryError::NotFinite`], [`QueryError::Tolerance`], [`QueryError::NoQueue`].
pub fn closest_point(
    tree: &Tree<'_>,
    point: [f32; 3],
    stop: &Stop,
    stack: &mut [TreeEntry],
) -> Result<ClosestPoint, QueryError> {
    closest_point_from(tree, point, stop, stack, &mut Hint::NONE.clone())
}

/// [`closest_point`], which looks at `hint`'s leaf first and leaves its own there. The answer has the same bits whatever the hint.
///
/// # Errors
/// Those of [`closest_point`].
#[inline]
pub fn closest_point_from(
    tree: &Tree<'_>,
    point: [f32; 3],
    stop: &Stop,
    stack: &mut [TreeEntry],
    hint: &mut Hint,
) -> Result<ClosestPoint, QueryError> {
    stop.check()?;
    if stack.is_empty() {
        return Err(QueryError::NoQueue);
    }
    let probe = Probe::new(tree, point)?;
    if probe.far {
        return from_afar(tree, &probe);
    }
    let mut work = Work::default();
    let mut seek = Closest::new(tree, &probe, stop);
    if *hint != Hint::NONE
        && let Some(TreeChild::Leaf(patch)) = tree.child(hint.0 >> 3, hint.0 & 7)
    {
        seek.bound_by(&patch).ok_or(QueryError::Model)?;
    }
    let descent = descend(tree, probe.p, stack, stop.steps, &mut seek, &mut work)?;
    seek.answer(descent, work, hint)
}

/// The best triangle so far.
#[derive(Clone, Copy)]
pub(super) struct Best {
    pub(super) distance_sq: f32,
    node: u32,
    child: u32,
    lane: u32,
}

struct Closest<'a> {
    tree: &'a Tree<'a>,
    probe: &'a Probe,
    stop: &'a Stop,
    /// Squared bound above which nothing matters.
    limit: f32,
    best: Best,
    /// Least certified square of a triangle whose own distance says too little.
    certified: f32,
    tolerant: bool,
}

impl<'a> Closest<'a> {
    #[inline(always)]
    fn new(tree: &'a Tree<'a>, probe: &'a Probe, stop: &'a Stop) -> Self {
        Closest {
            tree,
            probe,
            stop,
            limit: f32::from_bits(0x7E80_0000),
            best: Best { distance_sq: f32::INFINITY, node: u32::MAX, child: 0, lane: 0 },
            certified: f32::INFINITY,
            tolerant: stop.relative > 0.0 || stop.absolute > 0.0,
        }
    }

    /// Lowers the limit by a leaf that the descent will come to again.
    #[inline(always)]
    fn bound_by(&mut self, patch: &Patch<'_>) -> Option<()> {
        let near = nearest_triangle(patch, self.probe.p)?;
        self.limit = self.limit_for(near.distance_sq);
        Some(())
    }

    #[inline(always)]
    fn limit_for(&self, distance_sq: f32) -> f32 {
        if self.tolerant { self.tolerant_limit(distance_sq) } else { self.probe.limit(distance_sq) }
    }

    /// With a tolerance, what is not nearer by that much is not wanted.
    #[cold]
    fn tolerant_limit(&self, distance_sq: f32) -> f32 {
        let distance = libm::sqrtf(distance_sq);
        let absolute = self.probe.units.inward(self.stop.absolute);
        let wanted = (distance / (1.0 + self.stop.relative)).min(distance - absolute);
        if wanted > 0.0 { wanted * wanted } else { 0.0 }
    }

    #[inline(always)]
    fn improve(&mut self, distance_sq: f32, lane: usize, visit: &Visit<'_>) {
        let nearer = distance_sq < self.best.distance_sq
            || (distance_sq == self.best.distance_sq
                && self.number(visit.node, visit.lane, lane as u32) < self.best_number());
        if nearer {
            self.best = Best { distance_sq, node: visit.node, child: visit.lane, lane: lane as u32 };
            let limit = self.limit_for(distance_sq);
            if limit < self.limit {
                self.limit = limit;
            }
        }
    }

    #[cold]
    fn number(&self, node: u32, child: u32, lane: u32) -> Option<u32> {
        Some(self.tree.links(node)?.triangle(child).wrapping_add(lane))
    }

    #[cold]
    fn best_number(&self) -> Option<u32> {
        self.number(self.best.node, self.best.child, self.best.lane)
    }

    /// A triangle whose supporting plane is worse than its distance by more than rounding: slivers, and points next to the surface.
    #[cold]
    #[inline(never)]
    fn certify(&mut self, visit: &Visit<'_>) {
        let patch = &visit.patch;
        for lane in 0..patch.tag().triangles() {
            let which = usize::from(lane >= patch.tag().turn());
            let s = self.probe.p - patch.centre(which);
            let lower = certified_distance(s, patch.spoke(lane, which), patch.spoke(lane + 1, which));
            let lower_sq = lower * lower;
            let lower_sq = if lower_sq > visit.key { lower_sq } else { visit.key };
            if lower_sq < self.certified {
                self.certified = lower_sq;
            }
        }
    }

    #[inline(always)]
    fn answer(&self, descent: Descent, work: Work, hint: &mut Hint) -> Result<ClosestPoint, QueryError> {
        let Best { distance_sq, node, child, lane } = self.best;
        let mut least_sq = distance_sq;
        if self.certified < distance_sq * TREE_WEAK {
            least_sq = self.certified;
        }
        let mut ended = Ended::Exact;
        if let Descent::Short { least, steps } = descent {
            ended = if steps { Ended::Steps } else { Ended::Capacity };
            least_sq = least_sq.min(least);
        }
        if node == u32::MAX {
            let mut answer = from_afar(self.tree, self.probe)?;
            answer.lower = answer.lower.max(self.probe.lower(libm::sqrtf(least_sq))).min(answer.upper);
            return Ok(ClosestPoint { work, ended, ..answer });
        }
        *hint = Hint(node << 3 | child);
        let distance = libm::sqrtf(distance_sq);
        let mut least = if least_sq == distance_sq { distance } else { libm::sqrtf(least_sq) };
        if self.tolerant {
            let absolute = self.probe.units.inward(self.stop.absolute);
            least = least.min((distance / (1.0 + self.stop.relative)).min(distance - absolute).max(0.0));
            ended = if ended == Ended::Exact { Ended::Tolerance } else { ended };
        }
        let number = self.best_number().ok_or(QueryError::Model)?;
        let TreeChild::Leaf(patch) = self.tree.child(node, child).ok_or(QueryError::Model)? else {
            return Err(QueryError::Model);
        };
        Ok(ClosestPoint {
            lower: self.probe.lower(least),
            upper: self.probe.upper(distance),
            point: self.probe.units.point(witness(&patch, lane as usize, self.probe.p)),
            triangle: self.tree.source(number),
            work,
            ended,
        })
    }
}

impl Seek for Closest<'_> {
    #[inline(always)]
    fn limit(&self) -> f32 {
        self.limit
    }

    #[inline(always)]
    fn leaf(&mut self, visit: &Visit<'_>) -> Option<bool> {
        let near = nearest_triangle(&visit.patch, self.probe.p)?;
        if near.distance_sq <= self.best.distance_sq {
            self.improve(near.distance_sq, near.lane(), visit);
        }
        let certified_sq = near.certified_sq;
        let certified_sq = if certified_sq > visit.key { certified_sq } else { visit.key };
        if certified_sq < self.best.distance_sq * TREE_WEAK {
            self.certify(visit);
        }
        Some(true)
    }
}

/// The nearest triangle of a patch.
pub(super) struct NearestOf {
    /// Its squared distance.
    pub(super) distance_sq: f32,
    /// Least certified square of all triangles of the patch.
    pub(super) certified_sq: f32,
    /// All squared distances, where they were computed side by side.
    all: [f32; WIDTH],
    lane: usize,
}

impl NearestOf {
    /// The least lane that is so near.
    #[inline(always)]
    pub(super) fn lane(&self) -> usize {
        if WIDE { self.all.iter().position(|&d| d == self.distance_sq).unwrap_or(0) } else { self.lane }
    }
}

/// The nearest triangle of a patch.
#[inline(always)]
pub(super) fn nearest_triangle(patch: &Patch<'_>, p: Vec3) -> Option<NearestOf> {
    let count = patch.tag().triangles();
    if WIDE {
        let near = point_patch8(&patch.edges8(p)?, count);
        return Some(NearestOf {
            distance_sq: least_of(&near.distance_sq),
            certified_sq: least_of(&near.certified_sq),
            all: near.distance_sq,
            lane: 0,
        });
    }
    let turn = patch.tag().turn();
    let s = [p - patch.centre(0), p - patch.centre(patch.tag().centres() - 1)];
    let mut nearest = NearestOf { distance_sq: f32::MAX, certified_sq: f32::MAX, all: [0.0; WIDTH], lane: 0 };
    point_patch(
        count,
        turn,
        s,
        |i, which| patch.spoke(i, which),
        |i, near| {
            if near.distance_sq < nearest.distance_sq {
                (nearest.distance_sq, nearest.lane) = (near.distance_sq, i);
            }
            if near.certified_sq < nearest.certified_sq {
                nearest.certified_sq = near.certified_sq;
            }
        },
    );
    Some(nearest)
}

#[inline(always)]
fn least_of(values: &[f32; WIDTH]) -> f32 {
    let less = |a: f32, b: f32| if b < a { b } else { a };
    let [a, b, c, d, e, f, g, h] = *values;
    less(less(less(a, e), less(b, f)), less(less(c, g), less(d, h)))
}

/// The closest point of one triangle, grid units.
#[inline]
pub(super) fn witness(patch: &Patch<'_>, lane: usize, p: Vec3) -> Vec3 {
    let which = usize::from(lane >= patch.tag().turn());
    let centre = patch.centre(which);
    let fan = PointFan::new(p - centre);
    let (a, b) = (fan.spoke(patch.spoke(lane, which)), fan.spoke(patch.spoke(lane + 1, which)));
    let near = fan.triangle(&a, &b);
    centre + a.edge * near.v + b.edge * near.w
}

/// From far enough away every point is the closest, within a rounding of f32: the interval of the box, and a point of the surface.
#[cold]
fn from_afar(tree: &Tree<'_>, probe: &Probe) -> Result<ClosestPoint, QueryError> {
    let (low, high) = bounds(tree);
    // Scaled down by a power of two, so that no square overflows.
    let down = 1.0 / (1u64 << 60) as f32;
    let outside = (low - probe.p).max(probe.p - high).max(Vec3::ZERO) * down;
    let farthest = (low - probe.p).abs().max((probe.p - high).abs()) * down;
    let up = 1.0 / down;
    let near = libm::sqrtf(outside.dot(outside)) * up;
    let far = libm::sqrtf(farthest.dot(farthest)) * up;
    let mut node = 0;
    let (links, patch) = loop {
        let links = tree.links(node).ok_or(QueryError::Model)?;
        match tree.child(node, 0).ok_or(QueryError::Model)? {
            TreeChild::Node(child) => node = child,
            TreeChild::Leaf(patch) => break (links, patch),
        }
    };
    Ok(ClosestPoint {
        lower: probe.lower(near),
        upper: probe.upper(far),
        point: probe.units.point(patch.centre(0)),
        triangle: tree.source(links.triangle(0)),
        work: Work::default(),
        ended: Ended::Exact,
    })
}
