//! The score of a leaf in the greedy packing.

use glam::DVec3;

use super::MAX_LEAF_TRIANGLES;
use super::window::{WINDOW, Window};

// The weights extend the paper's `f` from fans to leaves: size, contact with the front, and the
// triangles left behind. They were chosen for few leaves and small boxes together, on two scanned
// meshes and a modelled one. They lie on a plateau: any one of them half or one and a half times as
// large moves the number of leaves and the sum of box areas by 3 % at most.

/// For each triangle of the leaf. Twice as much makes 1 % fewer leaves, with boxes 2 % larger.
const SIZE: i32 = 2;
/// Penalty for each edge between the leaf and a remaining triangle.
const FRONT_EDGE: i32 = 2;
/// For each edge inside the leaf.
const INNER_EDGE: i32 = 1;
/// Penalty for each triangle left without a neighbour: it will be a leaf by itself.
const ALONE: i32 = 64;
/// Penalty for each triangle left with one neighbour.
const DANGLING: i32 = 6;
/// Penalty for each lane that stays empty because the number of triangles cut off is no multiple
/// of [`MAX_LEAF_TRIANGLES`].
const EMPTY_LANE: i32 = 4;
/// Penalty for the box, in units of the area of its triangles. From half to twice as much, visits
/// change by 2 %.
///
/// The unit is an area, and no squared edge: that of a needle is huge, so its leaf would take in
/// triangles that lie far apart.
const SPREAD: f64 = 8.0;
/// Beside its half area a box counts its summed extents, times the root of the triangles' summed
/// squared edges, times this: a thin box is met as well.
const EXTENT: f64 = 0.05;
/// Triangles count as this part of their squared edges at least: some have no area.
const LEAST_AREA: f64 = 1.0 / 1024.0;

/// The triangles of a mask, by their index in the window.
fn each(mut mask: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        (mask != 0).then(|| {
            let i = mask.trailing_zeros() as usize;
            mask &= mask - 1;
            i
        })
    })
}

/// Size, contact, and the triangles next to the leaf: cheap enough for every candidate.
pub(super) fn contact(window: &Window, leaf: u32) -> i32 {
    // The triangles with at least one, two, three neighbours in the leaf, as masks.
    let (mut one, mut two, mut three) = (0, 0, 0);
    for i in each(leaf) {
        let neighbours = window.neighbours(i);
        three |= two & neighbours;
        two |= one & neighbours;
        one |= neighbours;
    }
    let has = window.degree_masks();
    let inner = count([one & leaf, two & leaf]) + count([three & leaf, 0]);
    let degrees = count([has[0] & leaf, has[1] & leaf]) + count([has[2] & leaf, 0]);
    // Outside, those all of whose neighbours are in the leaf, and all but one.
    let alone = (three | two & !has[2] | one & !has[1]) & !leaf;
    let dangling = (one & !two & has[1] & !has[2] | two & !three & has[2]) & !leaf;
    SIZE * count([leaf, 0]) - FRONT_EDGE * (degrees - inner) + INNER_EDGE * inner / 2
        - ALONE * count([alone, 0])
        - DANGLING * count([dangling, 0])
}

/// The triangles of two masks. A popcount of 64 bits costs as much as one of 32.
fn count([a, b]: [u32; 2]) -> i32 {
    (u64::from(a) << 32 | u64::from(b)).count_ones().cast_signed()
}

/// Score for the components that the leaf cuts off: 0 or less. Only components that end
/// within the window count. [`contact`] scores a component of one triangle.
pub(super) fn cut_off(window: &Window, leaf: u32) -> i32 {
    let mut rest = window.all() & !leaf;
    let mut empty_lanes = 0;
    while rest != 0 {
        let mut component = rest & rest.wrapping_neg();
        let mut new = component;
        while new != 0 {
            new =
                each(new).fold(0, |reached, i| reached | window.neighbours(i)) & rest & !component;
            component |= new;
        }
        rest &= !component;
        if component & window.border() == 0 && component.count_ones() > 1 {
            empty_lanes += (MAX_LEAF_TRIANGLES as u32
                - component.count_ones() % MAX_LEAF_TRIANGLES as u32)
                % MAX_LEAF_TRIANGLES as u32;
        }
    }
    -EMPTY_LANE * empty_lanes.cast_signed()
}

/// Extents of one window's triangles, each computed once.
#[derive(Default)]
pub(super) struct Spreads {
    extents: [Extent; WINDOW],
    /// The triangles of the window whose extent is known, as a mask.
    known: u32,
}

/// A triangle's box and sizes.
#[derive(Clone, Copy, Default)]
struct Extent {
    lower: DVec3,
    upper: DVec3,
    squared_edges: f64,
    area: f64,
}

impl Spreads {
    /// Forgets the extents of the last window.
    pub(super) fn clear(&mut self) {
        self.known = 0;
    }

    /// Score for the leaf's box: 0 at best, and lower the larger the box is for its triangles. The
    /// same at any scale. 0 if all edges of the leaf have length 0.
    pub(super) fn spread_score(
        &mut self,
        window: &Window,
        leaf: u32,
        triangles: &[[u32; 3]],
        positions: &[DVec3],
    ) -> f64 {
        for i in each(leaf & !self.known) {
            let [a, b, c] =
                triangles[window.triangles()[i] as usize].map(|v| positions[v as usize]);
            self.extents[i] = Extent {
                lower: least(least(a, b), c),
                upper: greatest(greatest(a, b), c),
                squared_edges: a.distance_squared(b)
                    + b.distance_squared(c)
                    + c.distance_squared(a),
                area: (b - a).cross(c - a).length() * 0.5,
            };
        }
        self.known |= leaf;
        let (mut lower, mut upper) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (mut squared_edges, mut area) = (0.0, 0.0);
        for extent in each(leaf).map(|i| &self.extents[i]) {
            lower = least(lower, extent.lower);
            upper = greatest(upper, extent.upper);
            squared_edges += extent.squared_edges;
            area += extent.area;
        }
        let size = upper - lower;
        let half_area = size.x * size.y + size.y * size.z + size.z * size.x;
        let extents = (size.x + size.y + size.z) * squared_edges.sqrt();
        let unit = area.max(squared_edges * LEAST_AREA);
        if unit > 0.0 { -SPREAD * (half_area + EXTENT * extents) / unit } else { 0.0 }
    }
}

// Plain comparisons compile to one instruction each; `f64::min` also orders NaN, which no position
// has.

fn least(a: DVec3, b: DVec3) -> DVec3 {
    let of = |a: f64, b: f64| if b < a { b } else { a };
    DVec3::new(of(a.x, b.x), of(a.y, b.y), of(a.z, b.z))
}

fn greatest(a: DVec3, b: DVec3) -> DVec3 {
    let of = |a: f64, b: f64| if b > a { b } else { a };
    DVec3::new(of(a.x, b.x), of(a.y, b.y), of(a.z, b.z))
}
