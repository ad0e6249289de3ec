//! The distance of two meshes, each at its place, in f64: fast enough for thousands of pairs of
//! real parts.
//!
//! A tree of boxes, and its own distance of two triangles: nine pairs of edges, and the heights of
//! the corners that are over the other triangle.

use glam::DVec3;
use meshsweep_core::Pose;

type Triangle = [DVec3; 3];

/// Triangles of a leaf.
const LEAF: usize = 2;

/// A triangle as files have it.
pub type Corners = [[f32; 3]; 3];

/// What a node holds: two later nodes, or triangles from the first on.
#[derive(Clone, Copy, Debug)]
enum Below {
    Nodes([usize; 2]),
    Triangles { first: usize, count: usize },
}

/// A mesh under a tree.
#[derive(Clone, Debug, Default)]
pub struct Tree {
    triangles: Vec<Corners>,
    nodes: Vec<Below>,
}

impl Tree {
    /// The tree of these triangles, of which there is one at least.
    #[must_use]
    pub fn new(triangles: Vec<Corners>) -> Self {
        let mut tree = Self::default();
        tree.add(triangles);
        tree
    }

    /// Adds a node, and what is below it behind it.
    fn add(&mut self, mut triangles: Vec<Corners>) -> usize {
        let at = self.nodes.len();
        let (first, count) = (self.triangles.len(), triangles.len());
        self.nodes.push(Below::Triangles { first, count });
        if count <= LEAF {
            self.triangles.append(&mut triangles);
            return at;
        }
        let width = |k: usize| {
            let all = || triangles.iter().flatten().map(|p| p[k]);
            all().fold(f32::NEG_INFINITY, f32::max) - all().fold(f32::INFINITY, f32::min)
        };
        let axis = (0..3).max_by(|&i, &j| width(i).total_cmp(&width(j))).unwrap_or(0);
        let key = |t: &Corners| t.iter().map(|p| p[axis]).sum::<f32>();
        triangles.sort_by(|a, b| key(a).total_cmp(&key(b)));
        let others = triangles.split_off(count / 2);
        let children = [self.add(triangles), self.add(others)];
        self.nodes[at] = Below::Nodes(children);
        at
    }

    /// At a place. The pose's numbers are exact, and any matrix will do.
    #[must_use]
    pub fn at(&self, pose: &Pose) -> Placed<'_> {
        let moved = |p: [f32; 3]| {
            let p = DVec3::from(p.map(f64::from));
            let along = |row: [f32; 3]| DVec3::from(row.map(f64::from)).dot(p);
            DVec3::from(pose.rotation.map(along)) + DVec3::from(pose.translation.map(f64::from))
        };
        let triangles: Vec<Triangle> = self.triangles.iter().map(|t| t.map(moved)).collect();
        let mut boxes = vec![Box3::EMPTY; self.nodes.len()];
        for (at, below) in self.nodes.iter().enumerate().rev() {
            boxes[at] = match *below {
                Below::Nodes([a, b]) => boxes[a].with(boxes[b].low).with(boxes[b].high),
                Below::Triangles { first, count } => {
                    let inside = triangles[first..first + count].iter().flatten();
                    inside.fold(Box3::EMPTY, |around, p| around.with(*p))
                }
            };
        }
        Placed { nodes: &self.nodes, triangles, boxes }
    }
}

#[derive(Clone, Copy, Debug)]
struct Box3 {
    low: DVec3,
    high: DVec3,
}

impl Box3 {
    const EMPTY: Self = Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };

    fn with(self, p: DVec3) -> Self {
        Self { low: self.low.min(p), high: self.high.max(p) }
    }

    /// The distance of two boxes.
    fn gap(&self, other: &Self) -> f64 {
        (self.low - other.high).max(other.low - self.high).max(DVec3::ZERO).length()
    }
}

/// A mesh at its place.
#[derive(Clone, Debug)]
pub struct Placed<'a> {
    nodes: &'a [Below],
    triangles: Vec<Triangle>,
    boxes: Vec<Box3>,
}

/// The distance of both surfaces in the world; 0 where they meet. Exact up to some roundings of
/// f64.
#[must_use]
pub fn distance(a: &Placed<'_>, b: &Placed<'_>) -> f64 {
    let mut best = f64::INFINITY;
    descend(a, b, [0, 0], &mut best);
    best
}

fn descend(a: &Placed<'_>, b: &Placed<'_>, [i, j]: [usize; 2], best: &mut f64) {
    let size = |b: &Box3| (b.high - b.low).length();
    let pairs = match (a.nodes[i], b.nodes[j]) {
        (Below::Nodes([k, l]), Below::Nodes(_)) if size(&a.boxes[i]) >= size(&b.boxes[j]) => {
            [[k, j], [l, j]]
        }
        (_, Below::Nodes([m, n])) => [[i, m], [i, n]],
        (Below::Nodes([k, l]), Below::Triangles { .. }) => [[k, j], [l, j]],
        (Below::Triangles { first, count }, Below::Triangles { first: second, count: others }) => {
            for t in &a.triangles[first..first + count] {
                for u in &b.triangles[second..second + others] {
                    *best = best.min(of_triangles(t, u));
                }
            }
            return;
        }
    };
    let mut pairs = pairs.map(|[i, j]| (a.boxes[i].gap(&b.boxes[j]), [i, j]));
    pairs.sort_by(|p, q| p.0.total_cmp(&q.0));
    for (gap, pair) in pairs {
        // With room for the rounding of both.
        if gap * (1.0 - 1e-12) < *best {
            descend(a, b, pair, best);
        }
    }
}

/// The distance of two triangles: 0 if an edge of one crosses the other, else the least of nine
/// pairs of edges and of the corners that are over the other's inside.
fn of_triangles(t: &Triangle, u: &Triangle) -> f64 {
    let sides = |t: &Triangle| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]];
    let crosses = |t: &Triangle, u: &Triangle| sides(t).iter().any(|s| does_cross(s, u));
    if crosses(t, u) || crosses(u, t) {
        return 0.0;
    }
    let mut least = f64::INFINITY;
    for s in &sides(t) {
        for r in &sides(u) {
            least = least.min(of_edges(s, r));
        }
    }
    let over = |t: &Triangle, u: &Triangle| {
        t.iter().filter_map(|p| height(*p, u)).fold(f64::INFINITY, f64::min)
    };
    least.min(over(t, u)).min(over(u, t))
}

fn does_cross(&[a, b]: &[DVec3; 2], &[p, q, r]: &Triangle) -> bool {
    let normal = (q - p).cross(r - p);
    let (above, below) = (normal.dot(a - p), normal.dot(b - p));
    if above * below > 0.0 || above == below {
        return false;
    }
    let way = b - a;
    let side = |p: DVec3, q: DVec3| way.dot((p - a).cross(q - a));
    let sides = [side(p, q), side(q, r), side(r, p)];
    sides.iter().all(|x| *x >= 0.0) || sides.iter().all(|x| *x <= 0.0)
}

/// The height of a point over the triangle, if its foot is inside.
fn height(point: DVec3, &[p, q, r]: &Triangle) -> Option<f64> {
    let normal = (q - p).cross(r - p);
    let is_in = |p: DVec3, q: DVec3| (q - p).cross(point - p).dot(normal) >= 0.0;
    let size = normal.length();
    (size > 0.0 && is_in(p, q) && is_in(q, r) && is_in(r, p))
        .then(|| (normal.dot(point - p) / size).abs())
}

fn to_edge(point: DVec3, &[a, b]: &[DVec3; 2]) -> f64 {
    let way = b - a;
    let square = way.length_squared();
    let t = if square > 0.0 { (way.dot(point - a) / square).clamp(0.0, 1.0) } else { 0.0 };
    (a + t * way - point).length()
}

fn of_edges(s: &[DVec3; 2], r: &[DVec3; 2]) -> f64 {
    let (d, e, way) = (s[1] - s[0], r[1] - r[0], r[0] - s[0]);
    let across = d.cross(e);
    let square = across.length_squared();
    let is_part = |x: f64| (0.0..=1.0).contains(&x);
    if square > 0.0
        && is_part(way.cross(e).dot(across) / square)
        && is_part(way.cross(d).dot(across) / square)
    {
        return (way.dot(across) / square.sqrt()).abs();
    }
    let ends = [to_edge(s[0], r), to_edge(s[1], r), to_edge(r[0], s), to_edge(r[1], s)];
    ends.into_iter().fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::{Tree, distance};
    use crate::generate::{Rng, block, torus};
    use crate::oracle::distance_of_meshes;
    use meshsweep_core::Pose;

    #[test]
    fn it_is_the_distance_in_106_bits() {
        let (a, b) = (torus(1.0, 0.3, 12, 8), block([-0.2, -0.3, -0.4], [0.5, 0.6, 0.7]));
        let corners = |(positions, triangles): &(Vec<[f32; 3]>, Vec<[u32; 3]>)| {
            triangles.iter().map(|t| t.map(|v| positions[v as usize])).collect()
        };
        let [x, y] = [&a, &b].map(|mesh| Tree::new(corners(mesh)));
        let (mut rng, mut met) = (Rng::new(1), 0);
        for _ in 0..100 {
            // Any matrix will do.
            let row = || [0, 1, 2].map(|_| rng.range(-1.0, 1.0));
            let rotation = std::iter::repeat_with(row).take(3).collect::<Vec<_>>();
            let rotation = [rotation[0], rotation[1], rotation[2]];
            let translation = rng.point_in([-2.0; 3], [2.0; 3]);
            let truth = distance_of_meshes((&a.0, &a.1), (&b.0, &b.1), &rotation, translation);
            let pose = Pose::affine(rotation, translation);
            let found = distance(&x.at(&Pose::IDENTITY), &y.at(&pose));
            met += usize::from(found == 0.0);
            let is_near = truth.lower - 1e-12 <= found && found <= truth.upper + 1e-12;
            assert!(is_near, "{found} {truth:?}");
        }
        assert!((10..90).contains(&met), "{met}");
    }
}
