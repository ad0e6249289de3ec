//! Whether a mesh meets its moved copy, decided by exact predicates: the truth of overlap tests.

use glam::DVec3;
use meshsweep_core::Pose as CorePose;
use std::ops::ControlFlow;

use crate::oracle::moved::{self, Place};
use crate::oracle::{Bounded, distance_of_moved_triangles as distance_of_triangles, meets};

use super::Subject;
use super::pose::Pose;

/// Moved boxes are grown by this share of the mesh's size and distance from the origin: some ten
/// roundings to f32.
const GROWN: f64 = 1e-6;

/// Triangles of a leaf.
const LEAF: usize = 4;

/// A mesh and a tree of boxes over its triangles.
pub struct Surface<'a> {
    subject: &'a Subject,
    nodes: Vec<Node>,
    /// Triangle numbers; a leaf is a range of them.
    order: Vec<u32>,
    size: f64,
}

/// A box with its two children, or with its triangles.
struct Node {
    low: DVec3,
    high: DVec3,
    /// The first of two neighbours in `nodes`; 0 of a leaf.
    children: usize,
    first: usize,
    count: usize,
}

impl<'a> Surface<'a> {
    /// Builds the tree: halves at the median along the longest axis.
    #[must_use]
    pub fn new(subject: &'a Subject) -> Self {
        let count = subject.mesh.triangles.len();
        let far = subject.mesh.positions.iter().map(|p| point(*p).length());
        let mut surface = Self {
            subject,
            nodes: Vec::new(),
            order: (0..count as u32).collect(),
            size: far.fold(subject.diagonal(), f64::max),
        };
        let root = surface.node(0, count);
        surface.nodes.push(root);
        let mut next = 0;
        while next < surface.nodes.len() {
            surface.split(next);
            next += 1;
        }
        surface
    }

    /// Whether a triangle meets a triangle of the moved copy, whose vertices are rounded to f32.
    /// Exact of those. A part that is wholly inside a part of the copy does not meet it.
    #[must_use]
    pub fn meets_moved(&self, pose: &Pose) -> bool {
        self.any_meeting(pose, |a, b| {
            triangles_meet(self.corners(a), self.corners(b).map(|p| pose.apply_rounded(p)))
        })
    }

    /// The same without rounding: every number of `core` is exact. `pose` is the same motion up to
    /// rounding.
    #[must_use]
    pub fn meets_exactly(&self, core: &CorePose, pose: &Pose) -> bool {
        self.any_meeting(pose, |a, b| {
            let first = self.corners(a).map(Place::of);
            let second = self.corners(b).map(|p| Place::moved(p, &core.rotation, core.translation));
            moved::triangles_meet(first.each_ref(), second.each_ref())
        })
    }

    /// The distance of the mesh and its moved copy if it is at most `limit`, in 106 bits; else
    /// infinite. Every number of `core` is exact, and `pose` is the same motion up to rounding.
    /// Meshes that meet may give any number.
    #[must_use]
    pub fn distance_up_to(&self, core: &CorePose, pose: &Pose, limit: f64) -> Bounded {
        let mut best = Bounded { lower: f64::INFINITY, upper: f64::INFINITY };
        self.any_pair(pose, limit, |first, second| {
            let (p, q) = (self.corners(first), self.corners(second));
            let found = distance_of_triangles(p, q, &core.rotation, core.translation);
            best.lower = best.lower.min(found.lower);
            best.upper = best.upper.min(found.upper);
            ControlFlow::Continue(limit.min(best.upper))
        });
        best
    }

    /// Visits triangles and triangles of the moved copy whose boxes are at most `limit` apart. A
    /// visit may lower the limit, or end the search. Whether one ended it.
    fn any_pair(
        &self,
        pose: &Pose,
        mut limit: f64,
        mut visit: impl FnMut(u32, u32) -> ControlFlow<(), f64>,
    ) -> bool {
        let grown = DVec3::splat(GROWN * (self.size + pose.shift.length()));
        let moved: Vec<[DVec3; 2]> =
            self.nodes.iter().map(|node| moved_box([node.low, node.high], pose, grown)).collect();
        let mut stack = vec![(0, 0)];
        while let Some((i, j)) = stack.pop() {
            let (a, b) = (&self.nodes[i], &self.nodes[j]);
            if gap([a.low, a.high], moved[j]) > limit {
                continue;
            }
            if a.children > 0 && (b.children == 0 || a.count >= b.count) {
                stack.extend([(a.children, j), (a.children + 1, j)]);
            } else if b.children > 0 {
                stack.extend([(i, b.children), (i, b.children + 1)]);
            } else {
                let triangles = |node: &Node| &self.order[node.first..node.first + node.count];
                for &second in triangles(b) {
                    let box_of_second = moved_box(self.triangle_box(second), pose, grown);
                    for &first in triangles(a) {
                        if gap(self.triangle_box(first), box_of_second) > limit {
                            continue;
                        }
                        match visit(first, second) {
                            ControlFlow::Continue(lower) => limit = lower,
                            ControlFlow::Break(()) => return true,
                        }
                    }
                }
            }
        }
        false
    }

    /// Whether `test` holds for a triangle and a triangle of the moved copy whose boxes meet.
    fn any_meeting(&self, pose: &Pose, test: impl Fn(u32, u32) -> bool) -> bool {
        self.any_pair(pose, 0.0, |first, second| {
            if test(first, second) { ControlFlow::Break(()) } else { ControlFlow::Continue(0.0) }
        })
    }

    fn node(&self, first: usize, count: usize) -> Node {
        let boxes =
            self.order[first..first + count].iter().map(|&triangle| self.triangle_box(triangle));
        let empty = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        let [low, high] = boxes.fold(empty, |[l, h], [low, high]| [l.min(low), h.max(high)]);
        Node { low, high, children: 0, first, count }
    }

    fn split(&mut self, index: usize) {
        let Node { low, high, first, count, .. } = self.nodes[index];
        if count <= LEAF {
            return;
        }
        let extent = (high - low).to_array();
        let axis = (0..3).max_by(|&a, &b| extent[a].total_cmp(&extent[b])).unwrap_or(0);
        let mut range = self.order[first..first + count].to_vec();
        let middle = |triangle: u32| {
            let [low, high] = self.triangle_box(triangle);
            low[axis] + high[axis]
        };
        let half = count / 2;
        range.select_nth_unstable_by(half, |&a, &b| middle(a).total_cmp(&middle(b)));
        self.order[first..first + count].copy_from_slice(&range);
        self.nodes[index].children = self.nodes.len();
        let halves = [self.node(first, half), self.node(first + half, count - half)];
        self.nodes.extend(halves);
    }

    fn triangle_box(&self, triangle: u32) -> [DVec3; 2] {
        let [a, b, c] = self.corners(triangle).map(point);
        [a.min(b).min(c), a.max(b).max(c)]
    }

    fn corners(&self, triangle: u32) -> [[f32; 3]; 3] {
        self.subject.mesh.triangles[triangle as usize]
            .map(|v| self.subject.mesh.positions[v as usize])
    }
}

fn point(p: [f32; 3]) -> DVec3 {
    DVec3::from_array(p.map(f64::from))
}

/// Distance of two boxes of which one was grown by far more than rounding.
fn gap([low, high]: [DVec3; 2], [from, to]: [DVec3; 2]) -> f64 {
    (from - high).max(low - to).max(DVec3::ZERO).length()
}

/// The box about a moved box.
fn moved_box([low, high]: [DVec3; 2], pose: &Pose, grown: DVec3) -> [DVec3; 2] {
    let middle = pose.apply(0.5 * (low + high));
    let columns = [0, 1, 2].map(|k| pose.rotation.col(k).abs() * 0.5 * (high - low)[k]);
    let half = columns[0] + columns[1] + columns[2] + grown;
    [middle - half, middle + half]
}

/// Two triangles meet exactly if an edge of one meets the other.
fn triangles_meet(a: [[f32; 3]; 3], b: [[f32; 3]; 3]) -> bool {
    let edge_meets =
        |t: [[f32; 3]; 3], other| (0..3).any(|k| meets(t[k], t[(k + 1) % 3], other).is_some());
    edge_meets(a, b) || edge_meets(b, a)
}
#[cfg(test)]
mod tests {
    use super::{Pose, Surface, triangles_meet};
    use crate::generate::{Rng, torus};
    use crate::workload::Subject;
    use crate::workload::sphere::Sphere;
    use glam::DVec3;
    use meshsweep::mesh::Mesh;

    const FLAT: [[f32; 3]; 3] = [[0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];

    #[test]
    fn triangles_meet_through_either_or_in_a_plane() {
        let shifted =
            |by: [f32; 3], t: [[f32; 3]; 3]| t.map(|p| [p[0] + by[0], p[1] + by[1], p[2] + by[2]]);
        let spike = [[0.5, 0.5, -1.0], [1.0, 0.5, -1.0], [1.0, 1.0, 1.0]];
        assert!(triangles_meet(FLAT, spike) && triangles_meet(spike, FLAT));
        assert!(!triangles_meet(FLAT, shifted([0.0, 0.0, 1.5], spike)));
        let small = FLAT.map(|p| p.map(|x| 0.25 * x));
        assert!(triangles_meet(FLAT, shifted([1.0, 1.0, 0.0], small)), "inside, in the plane");
        assert!(!triangles_meet(FLAT, shifted([3.0, 3.0, 0.0], small)));
        assert!(!triangles_meet(FLAT, shifted([0.0, 0.0, 1e-30], FLAT)));
    }

    #[test]
    fn the_tree_leaves_no_pair_of_triangles_out() {
        let (positions, triangles) = torus(2.0, 0.5, 10, 6);
        let subject = Subject::of("torus", Mesh::new(positions, triangles));
        let surface = Surface::new(&subject);
        let sphere = Sphere { centre: DVec3::ZERO, radius: 2.5 };
        let mut rng = Rng::new(3);
        let mut met = 0;
        for _ in 0..60 {
            let pose = Pose::random(&mut rng, &sphere, 2.2);
            let moved: Vec<[[f32; 3]; 3]> =
                (0..120).map(|t| surface.corners(t).map(|p| pose.apply_rounded(p))).collect();
            let meets =
                (0..120).any(|a| moved.iter().any(|b| triangles_meet(surface.corners(a), *b)));
            assert_eq!(surface.meets_moved(&pose), meets);
            met += usize::from(meets);
        }
        assert!((10..50).contains(&met), "{met}");
    }
}
