//! Which voxels a triangle meets, found by halving blocks of voxels: a long triangle meets few of
//! the voxels that its box meets.
//!
//! A triangle and a box have no point in common if and only if one of thirteen directions separates
//! them (Akenine-Möller 2001): the directions of the box's edges, the triangle's normal, and the
//! cross products of the edges of both. Any direction proves separation, so that only the rounding
//! of the projections has to be allowed for.

use crate::geom::{Bounds, Triangle};
use glam::DVec3;

/// Voxels along each axis: the first and the last.
pub(crate) type Block = [[i64; 2]; 3];

/// Calls `visit` with every voxel of a block that a triangle meets, and with no others but for
/// rounding. `grown` is the box of a block, larger than the block by more than rounding.
pub(crate) fn visit_voxels(
    triangle: &Triangle,
    of: Block,
    grown: impl Fn(Block) -> Bounds,
    mut visit: impl FnMut([i64; 3]),
) {
    let slabs = TriangleSlabs::new(triangle);
    let mut open = vec![of];
    while let Some(block) = open.pop() {
        if !slabs.meets(&grown(block)) {
            continue;
        }
        let further = block.map(|[from, to]| to - from);
        let axis =
            (0..3).fold(0, |most, axis| if further[axis] > further[most] { axis } else { most });
        if further[axis] <= 0 {
            visit(block.map(|[only, _]| only));
            continue;
        }
        let [from, to] = block[axis];
        let middle = (from + to).div_euclid(2);
        for half in [[from, middle], [middle + 1, to]] {
            let mut part = block;
            part[axis] = half;
            open.push(part);
        }
    }
}

/// A triangle between the pairs of planes that may separate it from a box.
struct TriangleSlabs {
    bounds: Bounds,
    corner: DVec3,
    /// Longest edge.
    extent: f64,
    slabs: [Slab; 10],
}

/// The interval that the triangle takes along a direction, measured from its first corner.
#[derive(Clone, Copy, Default)]
struct Slab {
    normal: DVec3,
    from: f64,
    to: f64,
    /// Not below the normal's length. Where the normal is a difference: not below the lengths of
    /// its terms.
    size: f64,
}

impl TriangleSlabs {
    fn new(triangle: &Triangle) -> Self {
        let [a, b, c] = *triangle;
        let edges = [b - a, c - b, a - c];
        let mut slabs = [Slab::default(); 10];
        let normal = edges[0].cross(c - a);
        // The triangle's own plane. Rounding of the normal moves the corners off the plane by less
        // than the size allows for.
        slabs[0] = Slab { normal, from: 0.0, to: 0.0, size: edges[0].length() * edges[2].length() };
        let products = edges.into_iter().flat_map(|edge| DVec3::AXES.map(|axis| edge.cross(axis)));
        for (slab, normal) in slabs[1..].iter_mut().zip(products) {
            let along = [0.0, normal.dot(b - a), normal.dot(c - a)];
            let from = along.into_iter().fold(f64::INFINITY, f64::min);
            let to = along.into_iter().fold(f64::NEG_INFINITY, f64::max);
            *slab = Slab { normal, from, to, size: normal.length() };
        }
        let extent = edges.map(DVec3::length).into_iter().fold(0.0, f64::max);
        Self { bounds: Bounds::of(triangle), corner: a, extent, slabs }
    }

    /// Never false for a box that the triangle meets.
    fn meets(&self, of: &Bounds) -> bool {
        if !self.bounds.meets(of) {
            return false;
        }
        let (middle, half) = ((of.low + of.high) * 0.5, (of.high - of.low) * 0.5);
        let a = self.corner - middle;
        let rounding = 64.0 * f64::EPSILON * (a.length() + half.length() + self.extent);
        self.slabs.iter().all(|slab| {
            let at = slab.normal.dot(a);
            let limit = half.dot(slab.normal.abs()) + slab.size * rounding;
            at + slab.from <= limit && at + slab.to >= -limit
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::SplitMix;

    /// Unit cubes.
    fn grown(block: Block) -> Bounds {
        let [from, to] = [block.map(|[from, _]| from), block.map(|[_, to]| to + 1)]
            .map(|corner| DVec3::from(corner.map(|x| x as f64)));
        Bounds { low: from - 1e-6, high: to + 1e-6 }
    }

    /// Whether a triangle has a point in a box, by cutting it at the box's six planes.
    fn is_cut(triangle: &Triangle, of: &Bounds) -> bool {
        let mut left = triangle.to_vec();
        for axis in DVec3::AXES {
            for (sign, offset) in [(1.0, of.low.dot(axis)), (-1.0, -of.high.dot(axis))] {
                let height = |p: DVec3| sign * p.dot(axis) - offset;
                let mut cut = Vec::new();
                for i in 0..left.len() {
                    let (p, q) = (left[i], left[(i + 1) % left.len()]);
                    let (hp, hq) = (height(p), height(q));
                    if hp >= 0.0 {
                        cut.push(p);
                    }
                    if (hp > 0.0 && hq < 0.0) || (hp < 0.0 && hq > 0.0) {
                        cut.push(p + (q - p) * (hp / (hp - hq)));
                    }
                }
                left = cut;
            }
        }
        !left.is_empty()
    }

    #[test]
    fn cubes_are_met_if_what_is_cut_of_the_triangle_at_their_planes_is_not_empty() {
        let mut dice = SplitMix::new(11);
        let mut counts = [0; 2];
        for kind in 0..60 {
            let mut point = || {
                let p = DVec3::new(dice.roll(), dice.roll(), dice.roll()) * 18.0 - 9.0;
                // Half of them on the grid, where to touch is to meet.
                if kind % 2 == 0 { p.round() } else { p.as_vec3().as_dvec3() }
            };
            let triangle = [point(), point(), point()];
            let mut found = Vec::new();
            visit_voxels(&triangle, [[-11, 10]; 3], grown, |cube| found.push(cube));
            found.sort_unstable();
            for cube in (0..22i64.pow(3)).map(|n| [n % 22 - 11, n / 22 % 22 - 11, n / 484 - 11]) {
                let is_found = found.binary_search(&cube).is_ok();
                let block = grown(cube.map(|x| [x, x]));
                let [smaller, larger] = [block.grown(-1e-9), block.grown(1e-9)];
                assert!(is_found || !is_cut(&triangle, &smaller), "{triangle:?} {cube:?}");
                assert!(!is_found || is_cut(&triangle, &larger), "{triangle:?} {cube:?}");
                counts[usize::from(is_found)] += 1;
            }
        }
        assert!(counts.iter().all(|&n| n > 1000), "{counts:?}");
    }

    #[test]
    fn halving_leaves_out_no_cube_that_is_met() {
        let mut dice = SplitMix::new(7);
        for size in [1e-9, 0.5, 3.0, 20.0] {
            for kind in 0..3 {
                let mut point = || {
                    let p = DVec3::new(dice.roll(), dice.roll(), dice.roll());
                    (p * size - 0.5 * size).as_vec3().as_dvec3()
                };
                let [a, b, c] = [point(), point(), point()];
                let triangle = match kind {
                    0 => [a, b, c],
                    1 => [(a + b) * 0.5, a, b],
                    _ => [a, b, (a + b) * 0.5 + (c - a) * 1e-7],
                };
                let slabs = TriangleSlabs::new(&triangle);
                let mut wanted = Vec::new();
                for (i, j, k) in
                    (0..22i64.pow(3)).map(|n| (n % 22 - 11, n / 22 % 22 - 11, n / 484 - 11))
                {
                    if slabs.meets(&grown([[i, i], [j, j], [k, k]])) {
                        wanted.push([i, j, k]);
                    }
                }
                let mut found = Vec::new();
                visit_voxels(&triangle, [[-11, 10]; 3], grown, |cube| found.push(cube));
                found.sort_unstable();
                wanted.sort_unstable();
                assert!(!wanted.is_empty() && found == wanted, "{triangle:?}");
                let middle = (triangle[0] + triangle[1] + triangle[2]) / 3.0;
                assert!(found.contains(&middle.floor().as_i64vec3().to_array()));
            }
        }
    }
}
