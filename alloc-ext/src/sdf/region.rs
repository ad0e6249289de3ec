//! The triangles that can be nearest to a point of a box.
//!
//! The distance to a triangle is convex. So with the unit vector *n* from its closest point to the
//! box's centre *c* it is at least D + n·(x − c) at every point x of the box, where D is the height
//! of *c* over the triangle along *n*. Any unit vector would do: a rounded one is as sound. The
//! distance to the surface is at most |x − q|, where *q* is the surface's point next to *c*. If the
//! first is above the second at the eight corners, it is so in all of the box, because their
//! difference is convex: the triangle is nearest nowhere, and no part of the box need look at it.
//!
//! Near the surface the triangles within a ball are kept too, see [`Region::ball`].
//!
//! *Groups.* Eight neighbouring triangles are a group, and what is said of a triangle holds for the
//! corners of a group too. The unit vector leads from their mean to the centre, so a group that the
//! box sees from the front is as thin as its part of the surface. Where a group is farther than the
//! nearest point it stands for its triangles. It is opened where it may have the nearest point,
//! where it lies in the ball, and where its bound is the least of all. *Lost*: the boxes of groups;
//! they are opened nearly always, and on the horse take 1.6 times the time (*historical*).

use super::facet::Facet;
use super::function::Linear;
use crate::geom::{Bounds, Frontier, StaticTree, spatial_order};
use glam::DVec3;
use std::ops::Range;

/// Margin for rounding, units.
///
/// Places of vertices are off by 2^-32. Coordinates are below 2^19, distances below 2^20. A
/// difference, a product with a unit vector and the sums of three lose less than sixteen parts in
/// 2^53 of such a length: 2^-29. All that is computed of a box adds fewer than a hundred of them.
pub(super) const MARGIN: f64 = 1.0 / (1 << 20) as f64;

/// Triangles that are this much farther than the nearest one count as nearest too, units.
pub(super) const TIE: f64 = 1.0 / (1 << 10) as f64;

/// Radii of a box by which its ball is larger than the distance. At least 2.25, for the proof of
/// flat surfaces (`super::bound`). Of cubes, balls of parts then lie in that of the whole; parts of
/// other boxes are asked.
const BALL: f64 = 2.3;

/// A surface that is nearer than so many radii may meet the box. At least 1.
const MET: f64 = 1.01;

/// Triangles of a group.
const GROUP: usize = 8;

/// Most groups that are opened to see whether the surface is flat.
const MOST_OPENED: usize = 16;

/// Mark of a group among triangles.
const IS_GROUP: u32 = 1 << 31;

/// A triangle that may be nearest somewhere in a box, or a group of them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Near {
    facet: u32,
    /// The point of it that is closest to the box's centre; no place of a group.
    pub point: DVec3,
    /// Unit vector from there to the box's centre; of a group from the mean of its corners.
    pub normal: DVec3,
    /// Height of the box's centre over it along this vector: no more than its distance.
    pub height: f64,
}

impl Near {
    /// The triangle; `None` of a group.
    #[inline]
    pub fn facet(&self) -> Option<u32> {
        (self.facet & IS_GROUP == 0).then_some(self.facet)
    }

    /// The triangle's or group's distance less a linear function is at least this in a box about
    /// the same centre, beside the function's value there.
    #[inline]
    pub fn least(&self, gradient: DVec3, half: DVec3) -> f64 {
        self.height - (self.normal - gradient).abs().dot(half)
    }
}

/// A box and its nearest triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Region {
    pub centre: DVec3,
    pub half: DVec3,
    pub radius: f64,
    /// The triangle nearest to the centre.
    pub facet: u32,
    /// The point of the surface nearest to the centre.
    pub point: DVec3,
    /// Its distance, rounded up.
    pub distance: f64,
    /// No triangle is nearer to the centre. Groups that stay closed are farther than `distance`.
    pub least: f64,
    /// Whether triangles of the ball are kept.
    has_ball: bool,
    /// Whether the groups in the ball are open.
    pub is_open: bool,
    /// Distances of that point from the eight corners, rounded up.
    pub ends: [f64; 8],
}

/// The corners of a box about its centre.
#[inline]
pub(super) fn corners(half: DVec3) -> [DVec3; 8] {
    let DVec3 { x, y, z } = half;
    let corner = DVec3::new;
    [
        corner(-x, -y, -z),
        corner(x, -y, -z),
        corner(-x, y, -z),
        corner(x, y, -z),
        corner(-x, -y, z),
        corner(x, -y, z),
        corner(-x, y, z),
        corner(x, y, z),
    ]
}

/// The parts of a box, halved along its long sides: their half sides and their centres. A cube has
/// eight.
pub(super) fn parts(centre: DVec3, half: DVec3) -> (DVec3, impl Iterator<Item = DVec3>) {
    let is_long = half.cmpgt(DVec3::splat(0.6 * half.max_element()));
    let of_part = DVec3::select(is_long, 0.5 * half, half);
    let long = is_long.bitmask() as usize;
    let corners = corners(of_part).into_iter().enumerate();
    let kept = corners.filter(move |(corner, _)| corner & !long == 0);
    let way = move |corner: DVec3| DVec3::select(is_long, corner, DVec3::ZERO);
    (of_part, kept.map(move |(_, corner)| centre + way(corner)))
}

impl Region {
    /// With the triangle that is nearest to its centre, and its closest point.
    fn new([centre, half]: [DVec3; 2], (facet, point): (u32, DVec3), has_ball: bool) -> Self {
        let distance = (centre - point).length() + MARGIN;
        let radius = half.length();
        let mut ends = [0.0; 8];
        for (end, corner) in ends.iter_mut().zip(corners(half)) {
            *end = (centre + corner - point).length() + MARGIN;
        }
        Self {
            has_ball,
            centre,
            half,
            radius,
            facet,
            point,
            distance,
            least: f64::INFINITY,
            is_open: false,
            ends,
        }
    }

    /// Radius of the ball about the centre whose triangles are kept, if the surface meets the box.
    /// Where the ball of a part is not within that of the whole, the part has none.
    pub fn ball(&self) -> Option<f64> {
        let is_met = self.has_ball && self.distance <= MET * self.radius;
        is_met.then_some(self.distance + BALL * self.radius)
    }

    /// Whether something with this normal and height over the box's centre may be nearest.
    #[inline]
    fn may_be_nearest(&self, normal: DVec3, height: f64) -> bool {
        // The corner where the heights along the normal are least compared with the point's.
        let DVec3 { x, y, z } = normal * self.half;
        let edges = [-x - y - z, x - y - z, -x + y - z, x + y - z];
        let edges =
            [edges[0], edges[1], edges[2], edges[3], -edges[3], -edges[2], -edges[1], -edges[0]];
        let mut is_near = false;
        for (edge, end) in edges.into_iter().zip(self.ends) {
            is_near |= height + edge <= end + TIE;
        }
        is_near
    }
}

/// A group of triangles.
#[derive(Debug)]
struct Group {
    /// The mean of its corners.
    middle: DVec3,
    /// Where its corners are.
    corners: Range<usize>,
}

/// The triangles of a mesh in the field's frame.
#[derive(Debug)]
pub(super) struct Facets {
    all: Vec<Facet>,
    tree: StaticTree,
    groups: Vec<Group>,
    /// The corners of each group's triangles.
    corners: Vec<DVec3>,
    tree_of_groups: StaticTree,
}

impl Facets {
    pub fn new(all: Vec<Facet>) -> Self {
        let of = |facet: &Facet| Bounds::of(&facet.at);
        let boxes: Vec<Bounds> = all.iter().map(of).collect();
        let order = spatial_order(&boxes);
        let all: Vec<Facet> = order.into_iter().map(|facet| all[facet as usize]).collect();
        let boxes: Vec<Bounds> = all.iter().map(of).collect();
        let (mut groups, mut bounds, mut corners) = (Vec::new(), Vec::new(), Vec::new());
        for members in all.chunks(GROUP) {
            let mut of_group: Vec<DVec3> = members.iter().flat_map(|facet| facet.at).collect();
            of_group.sort_unstable_by(|a, b| {
                let order = |axis: usize| a[axis].total_cmp(&b[axis]);
                order(0).then(order(1)).then(order(2))
            });
            of_group.dedup();
            let middle = of_group.iter().sum::<DVec3>() / of_group.len() as f64;
            bounds.push(Bounds::of(&of_group));
            groups.push(Group { middle, corners: corners.len()..corners.len() + of_group.len() });
            corners.extend(of_group);
        }
        let tree_of_groups = StaticTree::new(&bounds);
        Self { tree: StaticTree::new(&boxes), all, groups, corners, tree_of_groups }
    }

    /// A unit vector from a group to a point, shorter only next to the mean of its corners, and the
    /// point's height over the group along it.
    #[inline]
    fn over_group(&self, group: u32, p: DVec3) -> (DVec3, f64) {
        let Group { middle, corners, .. } = &self.groups[(group & !IS_GROUP) as usize];
        let away = p - middle;
        let normal = away / away.length().max(MARGIN);
        let heights = self.corners[corners.clone()].iter().map(|&corner| normal.dot(p - corner));
        (normal, heights.fold(f64::INFINITY, f64::min) - MARGIN)
    }

    pub fn facet(&self, facet: u32) -> &Facet {
        &self.all[facet as usize]
    }

    #[inline]
    fn closest(&self, facet: u32, p: DVec3) -> DVec3 {
        self.all[facet as usize].closest(p)
    }

    /// The triangles of a group.
    fn members(&self, group: u32) -> Range<u32> {
        let first = (group & !IS_GROUP) * GROUP as u32;
        first..(first + GROUP as u32).min(self.all.len() as u32)
    }

    /// A triangle of a box, if it is one to keep.
    #[inline]
    fn kept(&self, region: &mut Region, facet: u32, point: DVec3) -> Option<Near> {
        let of = &self.all[facet as usize];
        let away = region.centre - point;
        let length = away.length();
        // On the triangle its own normal leads away from it.
        let normal = if length > TIE { away / length } else { of.normal };
        let height = -of.support(region.centre, normal);
        region.least = region.least.min(height - MARGIN);
        let is_kept = region.may_be_nearest(normal, height)
            || region.ball().is_some_and(|radius| height <= radius + TIE);
        is_kept.then_some(Near { facet, point, normal, height })
    }

    /// Appends a group of a box, or its triangles, if they are to be kept.
    fn keep_group(&self, region: &mut Region, facet: u32, nears: &mut Vec<Near>) {
        let (normal, height) = self.over_group(facet, region.centre);
        if height <= region.distance + TIE {
            self.open(region, facet, nears);
            return;
        }
        let is_in_ball = region.ball().is_some_and(|radius| height <= radius + TIE);
        if is_in_ball || region.may_be_nearest(normal, height) {
            nears.push(Near { facet, point: region.centre, normal, height });
        }
    }

    fn open(&self, region: &mut Region, group: u32, nears: &mut Vec<Near>) {
        for facet in self.members(group) {
            let point = self.closest(facet, region.centre);
            nears.extend(self.kept(region, facet, point));
        }
    }

    /// The triangles of a box, appended to others.
    pub fn gather(
        &self,
        [centre, half]: [DVec3; 2],
        has_ball: bool,
        nears: &mut Vec<Near>,
    ) -> Region {
        let to = |item: usize| (centre - self.closest(item as u32, centre)).length_squared();
        let facet = self.tree.nearest(centre, to).map_or(0, |(item, _)| item as u32);
        let start = nears.len();
        let nearest = (facet, self.closest(facet, centre));
        let mut region = Region::new([centre, half], nearest, has_ball);
        let seen = region;
        let ball = region.ball().unwrap_or(0.0);
        let keep = |bounds: &Bounds| {
            let away = centre - centre.clamp(bounds.low, bounds.high);
            let length = away.length();
            length <= ball + TIE
                || length <= 2.0 * seen.radius
                || seen.may_be_nearest(away / length, length - MARGIN)
        };
        self.tree_of_groups.visit_kept(&Frontier::whole(), keep, |group| {
            self.keep_group(&mut region, group as u32 | IS_GROUP, nears);
            true
        });
        self.open_ball(&mut region, start, nears);
        region
    }

    /// The triangle nearest to a point of a region, and its closest point, out of those of the
    /// region.
    pub fn nearest(&self, whole: &Region, nears: &[Near], p: DVec3) -> (u32, DVec3) {
        let moved = p - whole.centre;
        let mut nearest = (whole.facet, whole.point);
        let mut square = (p - whole.point).length_squared();
        let mut least = square.sqrt();
        let height = |near: &Near| near.height + near.normal.dot(moved);
        let mut look = |near: &Near, least: &mut f64| {
            let facets = match near.facet() {
                Some(facet) => facet..facet + 1,
                None if self.over_group(near.facet, p).1 < *least => self.members(near.facet),
                None => return,
            };
            for facet in facets {
                let point = self.closest(facet, p);
                let found = (p - point).length_squared();
                if found < square {
                    (nearest, square) = ((facet, point), found);
                    *least = square.sqrt();
                }
            }
        };
        for near in nears {
            if height(near) < least {
                look(near, &mut least);
            }
        }
        nearest
    }

    /// The triangles of a part of a region, out of those of the region, appended.
    pub fn narrow(
        &self,
        whole: &Region,
        range: Range<usize>,
        [centre, half]: [DVec3; 2],
        nears: &mut Vec<Near>,
    ) -> Region {
        let moved = centre - whole.centre;
        let nearest = self.nearest(whole, &nears[range.clone()], centre);
        // Where the surface misses the whole it misses the part.
        let mut region = Region::new([centre, half], nearest, whole.ball().is_some());
        // Only triangles in the whole's ball were kept.
        let is_within = |ball: f64| whole.ball().is_some_and(|of| ball + moved.length() <= of);
        region.has_ball = region.ball().is_none_or(is_within);
        let start = nears.len();
        // A triangle's height over the whole bounds its distance in the part too.
        let ball = region.ball().unwrap_or(f64::NEG_INFINITY) + TIE;
        for number in range {
            let near = nears[number];
            let height = near.height + near.normal.dot(moved);
            if height > ball && !region.may_be_nearest(near.normal, height) {
                continue;
            }
            match near.facet() {
                Some(facet) => {
                    let point = self.closest(facet, centre);
                    nears.extend(self.kept(&mut region, facet, point));
                }
                None => self.keep_group(&mut region, near.facet, nears),
            }
        }
        self.open_ball(&mut region, start, nears);
        region
    }

    /// Opens the groups whose bound of the distance less a linear function is the least. The
    /// triangles of the region are all from `start`. Whether there were any.
    pub fn open_least(
        &self,
        region: &mut Region,
        linear: &Linear,
        start: usize,
        nears: &mut Vec<Near>,
    ) -> bool {
        let half = region.half;
        let least = |near: &Near| near.least(linear.gradient, half);
        let facets = nears[start..].iter().filter(|near| near.facet().is_some());
        let bound = facets.map(least).fold(f64::INFINITY, f64::min);
        let is_opened = |near: &Near| near.facet().is_none() && least(near) < bound;
        let opens = nears[start..].iter().any(is_opened);
        self.open_all(region, start, nears, is_opened);
        opens
    }

    /// Opens the groups in the ball, if they are few: of the others the surface is not flat.
    fn open_ball(&self, region: &mut Region, start: usize, nears: &mut Vec<Near>) {
        let Some(ball) = region.ball() else { return };
        let is_in = |near: &Near| near.height <= ball + TIE;
        let is_group = |near: &&Near| near.facet().is_none() && is_in(near);
        region.is_open = nears[start..].iter().filter(is_group).count() <= MOST_OPENED;
        if region.is_open {
            self.open_all(region, start, nears, is_in);
        }
    }

    /// Opens groups.
    fn open_all(
        &self,
        region: &mut Region,
        start: usize,
        nears: &mut Vec<Near>,
        is_opened: impl Fn(&Near) -> bool,
    ) {
        let mut number = start;
        while number < nears.len() {
            let near = nears[number];
            if near.facet().is_none() && is_opened(&near) {
                nears.swap_remove(number);
                self.open(region, near.facet, nears);
            } else {
                number += 1;
            }
        }
    }
}
