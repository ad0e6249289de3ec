//! The voxel closure: a closed surface around any triangles, open, crossing or loose.
//!
//! 1. A voxel that a triangle meets, or might by rounding, is *met*. Its eight corners are inside.
//! 2. Corners that the border of the grid reaches along grid edges, without passing a corner that
//!    is inside, are outside. All others are inside: regions that the triangles cut off from the
//!    border are filled.
//! 3. Marching tetrahedra make the surface between inside and outside. Each voxel is cut into six
//!    tetrahedra that share a diagonal (Kuhn), and every edge with two different ends is cut in its
//!    middle.
//!
//! The surface is a closed manifold for any choice of corners, because it is a level set in a
//! simplicial complex. It does not meet itself, because each of its triangles lies in one
//! tetrahedron. It lies in voxels that are not met, so it does not meet the mesh. It is nowhere
//! farther from the mesh than three diagonals of a voxel, except where it closes a hole that no
//! corner can be reached through.
//!
//! With a margin, corners are inside where the distance to the mesh is at most the margin, plus an
//! allowance for the volume that triangles cut off a ball. Edges are cut at that distance, not in
//! their middle. The surface is then close to all that has to be enclosed, if voxels are small
//! beside the margin. It is a hull only if it is proved to be one.
//!
//! The edge of a voxel is a power of two and the grid passes through the origin, so that the middle
//! of every edge is exact in single precision.

use super::triangle_voxels::{Block, visit_voxels};
use crate::geom::{Bounds, Triangle};
use crate::surface::split_exponent;
use crate::tight::deadline::Deadline;
use crate::tight::proof::Obstacle;
use glam::DVec3;
use meshsweep_core::internal::num::exp2;
use rustc_hash::FxHashMap;

/// A closed surface around triangles, and the grid that it came from.
#[derive(Clone, Debug)]
pub(crate) struct VoxelClosure {
    pub positions: Vec<DVec3>,
    pub triangles: Vec<[u32; 3]>,
    /// Edge of a voxel.
    pub edge: f64,
    /// Voxels along the longest side.
    pub voxels: usize,
}

/// Layers of voxels around the triangles: one that rounding might meet, one that nothing meets.
const PAD: i64 = 2;

/// Factor by which voxels are enlarged before they are tested: far above the rounding of the test,
/// far below a voxel.
const GROWN: f64 = 1.0 + 1e-6;

/// Largest coordinate in half-voxels: single precision holds all integers up to this.
const MOST_HALVES: f64 = 16_777_216.0;

/// The closure from a grid with at least `voxels` voxels, and fewer than twice as many, along the
/// longest side of the mesh and its margin. Far from the origin there are fewer, as single
/// precision has no coordinates for more. `None` if there is no room at all, or mesh and margin are
/// one point, or the deadline passes.
pub(super) fn voxel_closure(
    obstacle: &Obstacle,
    voxels: usize,
    deadline: Deadline<'_>,
) -> Option<VoxelClosure> {
    let bounds = obstacle.bounds().grown(obstacle.margin());
    let extent = (bounds.high - bounds.low).max_element();
    let farthest = bounds.low.abs().max(bounds.high.abs()).max_element();
    if !(extent > 0.0 && farthest.is_finite()) {
        return None;
    }
    let (_, above) = split_exponent(extent / voxels as f64);
    let mut exponent = above - 1;
    // A quarter of the range to spare for the layers around.
    while farthest * 2.0 > exp2(exponent) * MOST_HALVES * 0.75 || exponent < -148 {
        exponent += 1;
    }
    let edge = exp2(exponent);
    let first = (bounds.low / edge).floor().as_i64vec3() - PAD;
    let last = (bounds.high / edge).floor().as_i64vec3() + PAD + 1;
    let grid = Grid { edge, first: first.to_array(), corners: (last - first + 1).to_array() };
    if last.as_dvec3().abs().max_element() * edge > f64::from(f32::MAX) {
        return None;
    }
    let level = grid.level(obstacle.margin());
    let mut inside = match level {
        Some(level) => grid.corners_near(obstacle, level, deadline)?,
        None => grid.corners_met(obstacle.triangles()),
    };
    grid.fill(&mut inside);
    let (positions, triangles) = grid.surface(&inside, |inner, outer| match level {
        Some(level) => crossing(obstacle, level, inner, outer),
        None => (inner + outer) * 0.5,
    });
    Some(VoxelClosure {
        positions,
        triangles,
        edge,
        voxels: (grid.corners.into_iter().max().unwrap_or(1) - 1).unsigned_abs() as usize,
    })
}

/// Range in which an edge is cut, as fractions of it from its inner end, so that no triangle of the
/// surface is a needle or a point.
const ENDS: [f64; 2] = [0.05, 0.995];

/// Halvings of an edge to find where it is cut.
const HALVINGS: usize = 5;

/// The point between two corners whose distance to the mesh is `level`, on the outer side, rounded
/// to single precision.
fn crossing(obstacle: &Obstacle, level: f64, inner: DVec3, outer: DVec3) -> DVec3 {
    let [mut low, mut high] = ENDS;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        match distance(obstacle, inner.lerp(outer, middle)) {
            Some(distance) if distance < level => low = middle,
            _ => high = middle,
        }
    }
    inner.lerp(outer, high).as_vec3().as_dvec3()
}

/// The distance to the mesh, not exact.
fn distance(obstacle: &Obstacle, p: DVec3) -> Option<f64> {
    obstacle.nearest(p).map(|(_, [_, upper])| upper)
}

struct Grid {
    edge: f64,
    /// The least corner, in voxels from the origin.
    first: [i64; 3],
    /// Corners along each axis.
    corners: [i64; 3],
}

impl Grid {
    /// Number of a corner that is in the grid.
    fn index(&self, [i, j, k]: [i64; 3]) -> usize {
        ((k * self.corners[1] + j) * self.corners[0] + i).unsigned_abs() as usize
    }

    /// All corners, in the order of their numbers.
    fn all(&self) -> Vec<[i64; 3]> {
        let [nx, ny, nz] = self.corners;
        let row = |j: i64, k: i64| (0..nx).map(move |i| [i, j, k]);
        (0..nz).flat_map(|k| (0..ny).flat_map(move |j| row(j, k))).collect()
    }

    /// For each corner whether it belongs to a voxel that a triangle meets.
    fn corners_met(&self, triangles: impl Iterator<Item = Triangle>) -> Vec<bool> {
        let mut met = vec![false; self.all().len()];
        for triangle in triangles {
            let bounds = Bounds::of(&triangle);
            // One voxel more on either side, because the quotient is rounded. `visit_voxels`
            // decides.
            let [low, high] = [(bounds.low, -1), (bounds.high, 1)]
                .map(|(p, more)| ((p / self.edge).floor().as_i64vec3() + more).to_array());
            let at = |axis: usize, x: i64| (x - self.first[axis]).clamp(0, self.corners[axis] - 2);
            let around = [0, 1, 2].map(|axis| [at(axis, low[axis]), at(axis, high[axis])]);
            visit_voxels(
                &triangle,
                around,
                |block| self.grown(block),
                |cube| {
                    corners_of(cube).into_iter().for_each(|at| met[self.index(at)] = true);
                },
            );
        }
        met
    }

    /// The box of a block, enlarged by [`GROWN`].
    fn grown(&self, block: Block) -> Bounds {
        let middle = self.at(block.map(|[from, to]| from + to + 1));
        let half =
            DVec3::from(block.map(|[from, to]| (to - from + 1) as f64)) * (self.edge * 0.5 * GROWN);
        Bounds { low: middle - half, high: middle + half }
    }

    /// Distance from the mesh at which the surface is placed to keep a margin; `None` without one.
    ///
    /// The second term is the height that triangles as large as a voxel cut off a ball of that
    /// radius. The third term is the height that [`ENDS`] costs.
    fn level(&self, margin: f64) -> Option<f64> {
        let flattened = (self.edge * self.edge / (2.0 * margin)).min(2.0 * self.edge);
        (margin > 0.0).then(|| margin + flattened + 2.0 * (1.0 - ENDS[1]) * self.edge)
    }

    /// For each corner whether its distance to the mesh is about `level` at most; `None` if the
    /// deadline passes.
    fn corners_near(
        &self,
        obstacle: &Obstacle,
        level: f64,
        deadline: Deadline<'_>,
    ) -> Option<Vec<bool>> {
        let mut near = vec![false; self.all().len()];
        let [nx, ny, nz] = self.corners;
        for k in 0..nz {
            if deadline.has_passed() {
                return None;
            }
            for j in 0..ny {
                let mut i = 0;
                while i < nx {
                    let Some(distance) = distance(obstacle, self.at([2 * i, 2 * j, 2 * k])) else {
                        return Some(near);
                    };
                    // The distance is 1-Lipschitz, so that the next corners are known as well.
                    let same = 1 + ((distance - level).abs() / (self.edge * GROWN)).min(1e9) as i64;
                    for i in (i..(i + same).min(nx)).take_while(|_| distance <= level) {
                        near[self.index([i, j, k])] = true;
                    }
                    i += same;
                }
            }
        }
        Some(near)
    }

    /// A point, in half-voxels from the first corner.
    fn at(&self, halves: [i64; 3]) -> DVec3 {
        let axis = |k: usize| (2 * self.first[k] + halves[k]) as f64 * (self.edge * 0.5);
        DVec3::new(axis(0), axis(1), axis(2))
    }

    /// Makes all corners inside that the border does not reach.
    fn fill(&self, inside: &mut [bool]) {
        let mut outside = vec![false; inside.len()];
        // No triangle meets the outermost layer, so that all of it is connected.
        let mut open = vec![[0i64; 3]];
        outside[0] = true;
        while let Some(at) = open.pop() {
            for axis in 0..3 {
                for step in [-1i64, 1] {
                    let mut next = at;
                    next[axis] += step;
                    if next[axis] < 0 || next[axis] >= self.corners[axis] {
                        continue;
                    }
                    let index = self.index(next);
                    if !inside[index] && !outside[index] {
                        outside[index] = true;
                        open.push(next);
                    }
                }
            }
        }
        for (inside, outside) in inside.iter_mut().zip(outside) {
            *inside = !outside;
        }
    }

    /// The surface between inside and outside, by marching tetrahedra. `cut` places the vertex on
    /// an edge, given the inner and the outer end.
    fn surface(
        &self,
        inside: &[bool],
        cut: impl Fn(DVec3, DVec3) -> DVec3,
    ) -> (Vec<DVec3>, Vec<[u32; 3]>) {
        let mut positions = Vec::new();
        let mut triangles = Vec::new();
        let mut number: FxHashMap<[usize; 2], u32> = FxHashMap::default();
        let corners = self.all();
        let mut vertex = |p: usize, q: usize| {
            *number.entry([p.min(q), p.max(q)]).or_insert_with(|| {
                let [inner, outer] = if inside[p] { [p, q] } else { [q, p] };
                let [inner, outer] =
                    [inner, outer].map(|c| self.at(corners[c].map(|n: i64| 2 * n)));
                positions.push(cut(inner, outer));
                positions.len() as u32 - 1
            })
        };
        let [nx, ny, nz] = self.corners;
        for k in 0..nz - 1 {
            for j in 0..ny - 1 {
                for i in 0..nx - 1 {
                    let cube = corners_of([i, j, k]).map(|at| self.index(at));
                    let count = cube.iter().filter(|&&c| inside[c]).count();
                    if count == 0 || count == 8 {
                        continue;
                    }
                    for tetrahedron in TETRAHEDRA {
                        march(tetrahedron.map(|c| cube[c]), inside, &mut vertex, &mut triangles);
                    }
                }
            }
        }
        (positions, triangles)
    }
}

/// Corners of a voxel. The bits of a corner's number are x, y, z.
fn corners_of([i, j, k]: [i64; 3]) -> [[i64; 3]; 8] {
    [0, 1, 2, 3, 4, 5, 6, 7].map(|c| [i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)])
}

/// Kuhn's six tetrahedra of a cube, by corners whose bits are x, y, z. Each goes from corner 0 to
/// corner 7 along one axis after the other. All are positively oriented.
const TETRAHEDRA: [[usize; 4]; 6] =
    [[0, 1, 3, 7], [0, 3, 2, 7], [0, 2, 6, 7], [0, 6, 4, 7], [0, 4, 5, 7], [0, 5, 1, 7]];

/// The triangles of the surface in one tetrahedron, counter-clockwise seen from outside.
fn march(
    corners: [usize; 4],
    inside: &[bool],
    vertex: &mut impl FnMut(usize, usize) -> u32,
    triangles: &mut Vec<[u32; 3]>,
) {
    // Even permutations that bring the single corner, or the two corners that are inside, to the
    // front.
    const TO_FRONT: [[usize; 4]; 4] = [[0, 1, 2, 3], [1, 0, 3, 2], [2, 3, 0, 1], [3, 2, 1, 0]];
    const PAIR_TO_FRONT: [[usize; 4]; 6] =
        [[0, 1, 2, 3], [0, 2, 3, 1], [0, 3, 1, 2], [1, 2, 0, 3], [1, 3, 2, 0], [2, 3, 0, 1]];
    let is_in = corners.map(|c| inside[c]);
    let count = is_in.iter().filter(|&&i| i).count();
    match count {
        1 | 3 => {
            let alone = is_in.iter().position(|&i| i == (count == 1)).unwrap_or_default();
            let [a, b, c, d] = TO_FRONT[alone].map(|i| corners[i]);
            let [p, q, r] = [vertex(a, b), vertex(a, c), vertex(a, d)];
            triangles.push(if count == 1 { [p, q, r] } else { [p, r, q] });
        }
        2 => {
            let pair = PAIR_TO_FRONT.into_iter().find(|&[a, b, ..]| is_in[a] && is_in[b]);
            let [a, b, c, d] = pair.unwrap_or_default().map(|i| corners[i]);
            let [p, q, r, s] = [vertex(a, c), vertex(b, c), vertex(b, d), vertex(a, d)];
            triangles.extend([[p, r, q], [p, s, r]]);
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn around(triangles: &[Triangle]) -> Obstacle {
        let corners: Vec<DVec3> = triangles.concat();
        let numbers: Vec<[u32; 3]> =
            (0..triangles.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
        Obstacle::new(&corners, &numbers)
    }

    fn volume(surface: &VoxelClosure) -> f64 {
        let at = |v: u32| surface.positions[v as usize];
        surface.triangles.iter().map(|&[a, b, c]| at(a).dot(at(b).cross(at(c)))).sum::<f64>() / 6.0
    }

    #[test]
    fn tetrahedra_of_a_cube_fill_it_and_face_outwards() {
        let at = |c: usize| DVec3::new((c & 1) as f64, (c >> 1 & 1) as f64, (c >> 2) as f64);
        for [a, b, c, d] in TETRAHEDRA.map(|t| t.map(at)) {
            assert!(((b - a).cross(c - a).dot(d - a) - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn one_triangle_is_enclosed_by_a_closed_surface_that_faces_outwards() {
        let triangle =
            [DVec3::new(0.1, 0.2, 0.3), DVec3::new(1.0, 0.25, 0.125), DVec3::new(0.5, 1.5, 0.75)];
        for voxels in [1, 2, 5, 16] {
            let surface = voxel_closure(&around(&[triangle]), voxels, Deadline::default()).unwrap();
            assert!(volume(&surface) > 0.0);
            let mut edges: Vec<_> =
                surface.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
            edges.sort_unstable();
            assert!(edges.windows(2).all(|w| w[0] != w[1]));
            assert!(edges.iter().all(|&[a, b]| edges.binary_search(&[b, a]).is_ok()));
            assert!(surface.positions.iter().all(|p| p.as_vec3().as_dvec3() == *p));
        }
    }

    #[test]
    fn a_closed_box_is_filled() {
        let corner = |c: usize| DVec3::new((c & 1) as f64, (c >> 1 & 1) as f64, (c >> 2) as f64);
        let quads =
            [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles: Vec<Triangle> = quads
            .iter()
            .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]].map(|t| t.map(corner)))
            .collect();
        let surface = voxel_closure(&around(&triangles), 16, Deadline::default()).unwrap();
        assert!(volume(&surface) > 1.0 && volume(&surface) < 2.0, "{}", volume(&surface));
    }

    #[test]
    fn a_point_has_no_closure_and_far_triangles_have_larger_voxels() {
        assert!(voxel_closure(&around(&[[DVec3::ONE; 3]]), 8, Deadline::default()).is_none());
        let far =
            [DVec3::new(1e7, 0.0, 0.0), DVec3::new(1e7 + 4.0, 0.0, 0.0), DVec3::new(1e7, 4.0, 0.0)];
        let surface = voxel_closure(&around(&[far]), 64, Deadline::default()).unwrap();
        assert!(
            surface.voxels < 64 && surface.positions.iter().all(|p| p.as_vec3().as_dvec3() == *p)
        );
    }
}
