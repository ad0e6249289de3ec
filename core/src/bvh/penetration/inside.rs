//! Whether a part of one surface lies inside another one that it does not meet.
//!
//! A part of a surface that does not meet the other one is on one side of it, and so is everything
//! near it. So the descent ends at a node whose boxes are farther from the other surface than they
//! are large. It needs no list of connected parts.

use super::asking::Asking;
use crate::bvh::format::Bvh;
use crate::bvh::input_box::corners_of_input;
use crate::bvh::overlap::{AxisIntervals, StoredPair};
use crate::bvh::scene::{Placed, Relative};
use crate::geom::Pose;
use crate::geom::fan::WIDTH;
use crate::num::tolerance::{U32, U64};
use crate::num::{greater, lesser};
use crate::query::{QueryError, Relation, Side, Undecided};

/// No tree has more levels.
const LEVELS: usize = 64;

impl Asking<'_, '_> {
    /// How two solids lie to each other whose surfaces do not meet.
    pub(super) fn relation(&mut self) -> Result<Relation, QueryError> {
        let ([a, b], pose) = (self.trees, self.pose);
        let second = self.side_of_parts(&Parts::new([a, b], &pose, 0.0)?)?;
        if second == Side::Inside {
            return Ok(Relation::SecondInside);
        }
        let placed = [Placed { tree: *b, pose }, Placed { tree: *a, pose: Pose::IDENTITY }];
        let [world, moved] = &placed;
        let relative = Relative::new(world, moved)?;
        let first = self.side_of_parts(&Parts::new([b, a], &relative.pose, relative.error)?)?;
        Ok(match [first, second] {
            [Side::Inside, _] => Relation::FirstInside,
            [Side::Outside, Side::Outside] => Relation::Apart,
            [Side::Undecided(why), _] | [_, Side::Undecided(why)] => Relation::Undecided(why),
            [_, Side::Inside] => Relation::SecondInside,
        })
    }

    /// `Inside` if a part of the surface is, `Outside` if all of it is outside.
    fn side_of_parts(&mut self, parts: &Parts<'_>) -> Result<Side, QueryError> {
        let mut stack = [(0u32, 0u32); LEVELS];
        let mut used = 0;
        let mut side = Side::Outside;
        let mut now = Some(0);
        while let Some(node) = now {
            let open = match self.side_of_children(parts, node)? {
                Children { side: Side::Inside, .. } => return Ok(Side::Inside),
                Children { side: Side::Undecided(why), open } => {
                    side = Side::Undecided(why);
                    open
                }
                Children { open, .. } => open,
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
                let child = parts.tree().child(*node, open.trailing_zeros());
                *open &= *open - 1;
                break Some(child.ok_or(QueryError::Unchecked)?.at);
            };
        }
        Ok(side)
    }

    fn side_of_children(&mut self, parts: &Parts<'_>, node: u32) -> Result<Children, QueryError> {
        let (boxes, count) = parts.boxes(node).ok_or(QueryError::Unchecked)?;
        let mut found = Children { side: Side::Outside, open: 0 };
        for (i, [low, high]) in (0..count).zip(boxes) {
            if self.is_spent() {
                found.side = Side::Undecided(Undecided::Steps);
                break;
            }
            let side = match parts.outside(low, high) {
                Some(side) => Some(side),
                None => self.side_of_box(parts, low, high)?,
            };
            let child = parts.tree().child(node, i).ok_or(QueryError::Unchecked)?;
            let side = match side {
                Some(Side::Inside) => Side::Inside,
                Some(Side::Outside) => Side::Outside,
                _ if child.is_leaf() => self.side_of_leaf(parts, node, i)?,
                _ => {
                    found.open |= 1 << i;
                    continue;
                }
            };
            match side {
                Side::Inside => return Ok(Children { side, open: 0 }),
                Side::Undecided(_) => found.side = side,
                Side::Outside => {}
            }
        }
        Ok(found)
    }

    fn side_of_box(
        &mut self,
        parts: &Parts<'_>,
        low: [f64; 3],
        high: [f64; 3],
    ) -> Result<Option<Side>, QueryError> {
        let ([a, b, c], [x, y, z]) = (low, high);
        let (u, v, w) = (x - a, y - b, z - c);
        let radius = 0.5 * libm::sqrt((u * u + v * v) + w * w) * (1.0 + 16.0 * U64);
        let middle = [a + 0.5 * u, b + 0.5 * v, c + 0.5 * w];
        self.side_of_ball(parts.other(), middle, radius + parts.error)
    }

    /// Each triangle by its vertices: it does not meet the other surface, so one of them decides.
    fn side_of_leaf(
        &mut self,
        parts: &Parts<'_>,
        node: u32,
        child: u32,
    ) -> Result<Side, QueryError> {
        let leaf = parts.tree().leaf(node, child).ok_or(QueryError::Unchecked)?;
        let mut all = Side::Outside;
        for lane in 0..leaf.shape().triangles().min(WIDTH) {
            let mut side = Side::Undecided(Undecided::Resolution);
            for corner in leaf.corners(lane) {
                let at = parts.place(corner.to_array());
                match self.side_of_ball(parts.other(), at, parts.error)? {
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
struct Children {
    side: Side,
    /// Children to look into, as bits.
    open: u32,
}

/// The surface whose parts are looked at, in the frame of the other one.
struct Parts<'a> {
    pair: StoredPair<'a>,
    /// A point of the input's surface is no farther than this from its stored place, input units.
    error: f64,
    /// The box of the other surface, input units.
    low: [f64; 3],
    high: [f64; 3],
}

impl<'a> Parts<'a> {
    /// The second tree's surface in the first one's frame, by a pose that is off by at most
    /// `error`.
    fn new(trees: [&'a Bvh<'a>; 2], pose: &Pose, error: f64) -> Result<Self, QueryError> {
        let pair = StoredPair::new(trees, pose)?;
        let [other, _] = trees;
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for corner in corners_of_input(other) {
            for ((low, high), x) in low.iter_mut().zip(&mut high).zip(corner) {
                *low = lesser(*low, x);
                *high = greater(*high, x);
            }
        }
        let rounding = pair.lengths.error + 2.0 * pair.pose.vertex_error_exact;
        let error = error + rounding * pair.lengths.unit;
        Ok(Parts { pair, error: error * (1.0 + 16.0 * U64), low, high })
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
        let [_, frame] = &self.pair.pose.frames;
        let count = self.tree().links(node)?.count.min(WIDTH as u32);
        let intervals = AxisIntervals::of(frame, self.tree().boxes(node)?, count)?;
        let mut boxes = [[[0.0; 3]; 2]; WIDTH];
        let ([lx, ly, lz, ..], [hx, hy, hz, ..]) = (intervals.low, intervals.high);
        for (i, [low, high]) in boxes.iter_mut().enumerate() {
            let at = |x: &[f32; WIDTH]| x.get(i).copied().map_or(0.0, f64::from);
            *low = self.pair.place_exact([at(&lx), at(&ly), at(&lz)]);
            *high = self.pair.place_exact([at(&hx), at(&hy), at(&hz)]);
        }
        Some((boxes, count))
    }

    /// `Outside` if a box is beside the box of the other surface.
    fn outside(&self, low: [f64; 3], high: [f64; 3]) -> Option<Side> {
        let sides = low.iter().zip(&high).zip(self.low.iter().zip(&self.high));
        let mut is_outside = false;
        for ((low, high), (least, most)) in sides {
            let room = self.error + f64::from(U32) * (low.abs() + high.abs());
            is_outside |= low - room > *most || high + room < *least;
        }
        is_outside.then_some(Side::Outside)
    }

    /// The place of a stored vertex in the frame of the other surface, input units.
    fn place(&self, vertex: [f32; 3]) -> [f64; 3] {
        self.pair.place_exact(self.pair.moved(vertex))
    }
}
