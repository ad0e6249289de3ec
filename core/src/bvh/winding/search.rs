//! The passes of a winding number.

use super::flux::Flux;
use super::moment_flux::SeenNode;
use crate::bvh::tree::format::{Bvh, Links};
use crate::geom::{SeenCorner, SolidAngles};
use crate::num::tolerance::{WINDING_FAR, WINDING_FAR_ERROR};
use crate::num::{greater, lesser};
use crate::query::{Ended, Interval, QueryError, ScratchEntry, Side, Work};
use glam::Vec3;

/// Largest radius of a node over its distance, for each pass. In the last one every triangle counts
/// by itself.
const RATIOS: [f32; 6] = [0.4, 0.25, 0.15, 0.08, 0.04, 0.0];

/// Least part of the error that is worth another pass.
const WORTH_A_PASS: f32 = 1.0 / 32.0;

/// The query, and the work of its passes.
pub(super) struct WindingSearch<'a> {
    pub(super) tree: Bvh<'a>,
    /// Grid units.
    pub(super) p: Vec3,
    /// How far vertices and the point may be from their true places, grid units.
    pub(super) error: f32,
    /// No winding number is greater.
    pub(super) most: f32,
    /// Wanted width of the interval, or 0.
    pub(super) absolute: f32,
    /// Nodes that may still be opened.
    pub(super) steps: u32,
    pub(super) work: Work,
}

/// What one pass adds up.
struct Pass {
    /// Of nodes that were replaced by their moments.
    flux: Flux,
    /// Of the other triangles.
    angles: SolidAngles,
    /// The part of the error that smaller nodes would lessen.
    truncation: f32,
    /// The triangles of some node are missing from the sum.
    is_unknown: bool,
    /// Why nodes were not opened that should have been.
    cut_short: Option<Ended>,
}

/// A node on the stack.
struct Waiting {
    node: u32,
    /// What its vertices' moves change is in the error already, as a part of a larger node's.
    moves_counted: bool,
}

impl Waiting {
    fn read(entry: ScratchEntry) -> Waiting {
        Waiting { node: entry.node(), moves_counted: entry.key() > 0.0 }
    }

    fn entry(&self) -> ScratchEntry {
        ScratchEntry::new(if self.moves_counted { 1.0 } else { 0.0 }, self.node)
    }
}

impl WindingSearch<'_> {
    /// The number from so far away that squares would leave f32's range: |w| ≤ Σ area/(4π·d²). The
    /// distance is at least 2^36 (§20).
    pub(super) fn number_from_afar(&self) -> (Interval, Ended) {
        let header = self.tree.header();
        let bound = if self.error <= WINDING_FAR_ERROR {
            // The input's triangles may be larger than the stored ones.
            let largest_star = header.star_radius + 4.0 * self.error;
            let bound = header.triangles as f32 * (largest_star * largest_star) * WINDING_FAR;
            lesser(bound + f32::MIN_POSITIVE, self.most)
        } else {
            self.most
        };
        let number = Interval::new(-bound, bound);
        (number, self.ended(number, Ended::Resolution))
    }

    /// The number in passes of rising cost.
    pub(super) fn number_in_passes(
        &mut self,
        scratch: &mut [ScratchEntry],
    ) -> Result<(Interval, Ended), QueryError> {
        let mut number = Interval::new(-self.most, self.most);
        for ratio in RATIOS {
            let pass = self.pass(ratio, scratch)?;
            if !pass.is_unknown {
                let found = pass.flux.winding(self.most);
                let (lower, upper) =
                    (greater(number.lower, found.lower), lesser(number.upper, found.upper));
                // Intervals of sound moments always meet. Those of forged moments may not.
                if lower <= upper {
                    number = Interval::new(lower, upper);
                }
            }
            let ended = self.ended(number, pass.cut_short.unwrap_or(Ended::Resolution));
            if ended != Ended::Resolution || !pass.may_improve() {
                return Ok((number, ended));
            }
        }
        Ok((number, Ended::Resolution))
    }

    /// The number of the solid that the mesh bounds: in one that faces inwards as a whole the
    /// file's number is −1.
    pub(super) fn of_solid(&self, number: Interval) -> Interval {
        match self.tree.turned().are_all() {
            true => Interval::new(-number.upper, -number.lower),
            false => number,
        }
    }

    /// Why the search ends with this number: it is good enough, or `otherwise`.
    fn ended(&self, number: Interval, otherwise: Ended) -> Ended {
        let number = self.of_solid(number);
        let is_settled = side_of(number).is_some() || number.upper < -0.5;
        let is_narrow = number.upper - number.lower <= self.absolute;
        match (is_settled, self.absolute > 0.0) {
            (true, false) => Ended::Exact,
            (true, true) if is_narrow => Ended::Tolerance,
            _ => otherwise,
        }
    }

    fn pass(&mut self, ratio: f32, scratch: &mut [ScratchEntry]) -> Result<Pass, QueryError> {
        let mut pass = Pass {
            flux: Flux::default(),
            angles: SolidAngles::NONE,
            truncation: 0.0,
            is_unknown: false,
            cut_short: None,
        };
        let mut waiting = 0;
        let mut left = self.tree.most_steps();
        let mut next = Some(Waiting { node: 0, moves_counted: false });
        while let Some(Waiting { node, moves_counted }) = next {
            left = left.checked_sub(1).ok_or(QueryError::Unchecked)?;
            let moments = self.tree.moments(node).ok_or(QueryError::Unchecked)?;
            let seen = SeenNode::new(moments, self.p, self.error);
            self.work.bounds = self.work.bounds.saturating_add(1);
            // Moves that are not in the sum's error yet.
            let mut uncounted = if moves_counted { 0.0 } else { self.error };
            let is_small = seen.is_small(ratio);
            if is_small || self.steps == 0 {
                if !is_small {
                    pass.cut_short = Some(Ended::Steps);
                }
                pass.take_moments(&seen, uncounted);
            } else {
                self.steps -= 1;
                self.work.opened = self.work.opened.saturating_add(1);
                if uncounted > 0.0 && seen.bounds_moves(uncounted) {
                    // This bound covers all below the node, so the children add none.
                    pass.flux.add(0.0, seen.moved(uncounted));
                    uncounted = 0.0;
                }
                self.open(node, uncounted, scratch, &mut waiting, &mut pass)?;
            }
            next = waiting.checked_sub(1).and_then(|last| {
                waiting = last;
                scratch.get(last).copied().map(Waiting::read)
            });
        }
        let (sum, error) = pass.angles.sum();
        pass.flux.add_sum(sum, error, pass.angles.terms());
        Ok(pass)
    }

    /// Puts the inner children of a node on the stack, and adds the triangles of its leaves.
    fn open(
        &mut self,
        node: u32,
        uncounted: f32,
        scratch: &mut [ScratchEntry],
        waiting: &mut usize,
        pass: &mut Pass,
    ) -> Result<(), QueryError> {
        let links = self.tree.links(node).ok_or(QueryError::Unchecked)?;
        for index in 0..links.inner {
            let child = links.child(index).at;
            if let Some(slot) = scratch.get_mut(*waiting) {
                *slot = Waiting { node: child, moves_counted: uncounted == 0.0 }.entry();
                *waiting += 1;
            } else {
                let moments = self.tree.moments(child).ok_or(QueryError::Unchecked)?;
                pass.cut_short = Some(Ended::Scratch);
                pass.take_moments(&SeenNode::new(moments, self.p, self.error), uncounted);
            }
        }
        self.add_leaves(&links, uncounted, &mut pass.angles).ok_or(QueryError::Unchecked)
    }

    /// Adds the solid angles of the triangles of a node's leaves.
    fn add_leaves(
        &mut self,
        links: &Links,
        uncounted: f32,
        angles: &mut SolidAngles,
    ) -> Option<()> {
        for index in links.inner..links.count {
            let leaf = self.tree.leaf_at(links.vertex(index), links.shape(index))?;
            let shape = leaf.shape();
            let (triangles, turn) = (shape.triangles(), shape.turn());
            self.work.triangles = self.work.triangles.saturating_add(triangles as u32);
            // Neighbouring triangles share a vertex of the ring: one measurement serves both.
            let seen = |v: Vec3| SeenCorner::new(v - self.p);
            let first = seen(leaf.centre(0));
            let second = if shape.centres() > 1 { seen(leaf.centre(1)) } else { first };
            let mut here = seen(leaf.ring(0));
            for lane in 0..triangles {
                let next = seen(leaf.ring(lane + 1));
                let corners = match lane >= turn {
                    false => [first, here, next],
                    true if shape.second_reversed() => [second, next, here],
                    true => [second, here, next],
                };
                angles.add(corners, uncounted);
                here = next;
            }
        }
        Some(())
    }
}

impl Pass {
    /// Whether smaller nodes would narrow the interval: not if nearly all of the error is that of
    /// moved vertices and of rounding.
    fn may_improve(&self) -> bool {
        self.is_unknown || self.truncation > self.flux.error() * WORTH_A_PASS
    }

    /// Adds the moments of a node, and what moves of `uncounted` change.
    fn take_moments(&mut self, seen: &SeenNode, uncounted: f32) {
        if seen.is_away() {
            let (flux, off) = seen.flux();
            self.truncation += off;
            self.flux.add(flux, off);
            self.flux.add(0.0, seen.moved(uncounted));
        } else {
            self.is_unknown = true;
        }
    }
}

/// The side that a number proves. A number of −½ or less proves none: the surface is inside out
/// about the point, and may bound a solid all the same.
pub(super) fn side_of(number: Interval) -> Option<Side> {
    match number {
        Interval { lower, .. } if lower > 0.5 => Some(Side::Inside),
        Interval { lower, upper } if lower > -0.5 && upper < 0.5 => Some(Side::Outside),
        _ => None,
    }
}
