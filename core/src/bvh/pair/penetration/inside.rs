//! Whether a component of one surface lies inside another one that it does not meet.
//!
//! A ball that the other surface does not enter is on one side of it. So the descent ends at boxes
//! that are farther from the other surface than they are large. It needs no list of components.

use super::pair_queries::PairQueries;
use crate::bvh::pair::placed_pair::PlacedPair;
use crate::bvh::pair::stored_pair::StoredPair;
use crate::bvh::tree::axis_intervals::AxisIntervals;
use crate::bvh::tree::format::Bvh;
use crate::bvh::tree::format::layout::MAX_TREE_DEPTH;
use crate::bvh::tree::input_box::{bounds_of, corners_of_input};
use crate::geom::Pose;
use crate::geom::fan::WIDTH;
use crate::num::tolerance::{U32, U64};
use crate::query::{QueryError, Relation, RelativePose, Side, Undecided};

impl PairQueries<'_, '_> {
    /// How two solids lie to each other whose surfaces do not meet at a pose.
    pub(super) fn relation(&mut self, pose: &Pose) -> Result<Relation, QueryError> {
        let [a, b] = self.trees;
        let second = self.side_of_surface(&MovedSurface::new([a, b], pose, 0.0)?)?;
        if second == Side::Inside {
            return Ok(Relation::SecondInside);
        }
        let relative = PlacedPair::new(pose, &Pose::IDENTITY, a)?;
        let first = self.side_of_surface(&MovedSurface::new(
            [b, a],
            &relative.pose,
            relative.lengths.error,
        )?)?;
        Ok(match (first, second) {
            (Side::Inside, _) => Relation::FirstInside,
            (Side::Undecided(why), _) | (_, Side::Undecided(why)) => Relation::Undecided(why),
            (Side::Outside, _) => Relation::Apart,
        })
    }

    /// `Inside` if any of the surface is, `Outside` if all of it is.
    fn side_of_surface(&mut self, surface: &MovedSurface<'_>) -> Result<Side, QueryError> {
        let mut stack = [(0u32, 0u32); MAX_TREE_DEPTH];
        let mut used = 0;
        let mut side = Side::Outside;
        let mut now = Some(0);
        let mut opened = 0;
        while let Some(node) = now {
            opened += 1;
            if opened > surface.tree().most_steps() {
                return Err(QueryError::Unchecked);
            }
            let open = match self.side_of_children(surface, node)? {
                ChildSides { side: Side::Inside, .. } => return Ok(Side::Inside),
                ChildSides { side: Side::Undecided(why), open } => {
                    side = Side::Undecided(why);
                    open
                }
                ChildSides { open, .. } => open,
            };
            // A checked tree is not deeper.
            *stack.get_mut(used).ok_or(QueryError::Unchecked)? = (node, open);
            used += 1;
            now = loop {
                let Some(top) = used.checked_sub(1) else { break None };
                let (node, open) = stack.get_mut(top).ok_or(QueryError::Unchecked)?;
                if *open == 0 {
                    used = top;
                    continue;
                }
                let child = surface.tree().child(*node, open.trailing_zeros());
                *open &= *open - 1;
                break Some(child.ok_or(QueryError::Unchecked)?.at);
            };
        }
        Ok(side)
    }

    fn side_of_children(
        &mut self,
        surface: &MovedSurface<'_>,
        node: u32,
    ) -> Result<ChildSides, QueryError> {
        let (boxes, count) = surface.boxes(node).ok_or(QueryError::Unchecked)?;
        let mut found = ChildSides { side: Side::Outside, open: 0 };
        for (i, [low, high]) in (0..count).zip(boxes) {
            if self.is_spent() {
                found.side = Side::Undecided(Undecided::Steps);
                break;
            }
            let side = match surface.outside(low, high) {
                Some(side) => Some(side),
                None => self.side_of_box(surface, low, high)?,
            };
            let child = surface.tree().child(node, i).ok_or(QueryError::Unchecked)?;
            let side = match side {
                Some(Side::Inside) => Side::Inside,
                Some(Side::Outside) => Side::Outside,
                _ if child.is_leaf() => self.side_of_leaf(surface, node, i)?,
                _ => {
                    found.open |= 1 << i;
                    continue;
                }
            };
            match side {
                Side::Inside => return Ok(ChildSides { side, open: 0 }),
                Side::Undecided(_) => found.side = side,
                Side::Outside => {}
            }
        }
        Ok(found)
    }

    fn side_of_box(
        &mut self,
        surface: &MovedSurface<'_>,
        low: [f64; 3],
        high: [f64; 3],
    ) -> Result<Option<Side>, QueryError> {
        let ([a, b, c], [x, y, z]) = (low, high);
        let (u, v, w) = (x - a, y - b, z - c);
        let radius = 0.5 * libm::sqrt((u * u + v * v) + w * w) * (1.0 + 16.0 * U64);
        let middle = [a + 0.5 * u, b + 0.5 * v, c + 0.5 * w];
        self.side_of_ball(surface.other(), middle, radius + surface.error)
    }

    /// Each triangle by its vertices: it does not meet the other surface, so one of them decides.
    fn side_of_leaf(
        &mut self,
        surface: &MovedSurface<'_>,
        node: u32,
        child: u32,
    ) -> Result<Side, QueryError> {
        let leaf = surface.tree().leaf(node, child).ok_or(QueryError::Unchecked)?;
        let mut all = Side::Outside;
        for lane in 0..leaf.shape().triangles().min(WIDTH) {
            let mut side = Side::Undecided(Undecided::Resolution);
            for corner in leaf.corners(lane) {
                let at = surface.to_input(corner.to_array());
                match self.side_of_ball(surface.other(), at, surface.error)? {
                    Some(Side::Undecided(why)) => side = Side::Undecided(why),
                    Some(decided) => {
                        side = decided;
                        break;
                    }
                    None => {}
                }
            }
            match side {
                Side::Inside => return Ok(side),
                Side::Undecided(_) => all = side,
                Side::Outside => {}
            }
        }
        Ok(all)
    }
}

/// What is known of the children of a node.
struct ChildSides {
    side: Side,
    /// ChildSides to look into, as bits.
    open: u32,
}

/// A surface whose sides are asked for, in the frame of the other one.
struct MovedSurface<'a> {
    pair: StoredPair<'a>,
    relative: RelativePose,
    /// A point of the input's surface is no farther than this from its stored place, input units.
    error: f64,
    /// The box of the other surface, input units.
    low: [f64; 3],
    high: [f64; 3],
}

impl<'a> MovedSurface<'a> {
    /// The second tree's surface in the first one's frame, by a pose that is off by at most
    /// `error`.
    fn new(trees: [&'a Bvh<'a>; 2], pose: &Pose, error: f64) -> Result<Self, QueryError> {
        let pair = StoredPair::new(trees, pose)?;
        let [other, _] = trees;
        let [low, high] = bounds_of(corners_of_input(other));
        let rounding = pair.lengths.error + 2.0 * pair.common.vertices.vertex_error_f64;
        let error = error + rounding * pair.lengths.unit;
        let relative = pair.relative();
        Ok(MovedSurface { pair, relative, error: error * (1.0 + 16.0 * U64), low, high })
    }

    fn tree(&self) -> &'a Bvh<'a> {
        let [_, tree] = self.pair.trees;
        tree
    }

    fn other(&self) -> &'a Bvh<'a> {
        let [other, _] = self.pair.trees;
        other
    }

    /// The boxes of a node's children, input units, and their count.
    fn boxes(&self, node: u32) -> Option<([[[f64; 3]; 2]; WIDTH], u32)> {
        let [_, frame] = &self.relative.frames;
        let count = self.tree().links(node)?.count.min(WIDTH as u32);
        let intervals = AxisIntervals::of(frame, self.tree().boxes(node)?, count)?;
        let mut boxes = [[[0.0; 3]; 2]; WIDTH];
        let ([lx, ly, lz, ..], [hx, hy, hz, ..]) = (intervals.low, intervals.high);
        for (i, [low, high]) in boxes.iter_mut().enumerate() {
            let at = |x: &[f32; WIDTH]| x.get(i).copied().map_or(0.0, f64::from);
            *low = self.pair.to_input_f64([at(&lx), at(&ly), at(&lz)]);
            *high = self.pair.to_input_f64([at(&hx), at(&hy), at(&hz)]);
        }
        Some((boxes, count))
    }

    /// `Outside` if a box is beside the box of the other surface.
    fn outside(&self, low: [f64; 3], high: [f64; 3]) -> Option<Side> {
        let sides = low.iter().zip(&high).zip(self.low.iter().zip(&self.high));
        let mut is_outside = false;
        for ((low, high), (least, most)) in sides {
            // Far more than the rounding of both corners.
            let room = self.error + f64::from(U32) * (low.abs() + high.abs());
            is_outside |= low - room > *most || high + room < *least;
        }
        is_outside.then_some(Side::Outside)
    }

    /// The place of a stored vertex in the frame of the other surface, input units.
    fn to_input(&self, vertex: [f32; 3]) -> [f64; 3] {
        self.pair.to_input_f64(self.pair.moved(vertex))
    }
}
