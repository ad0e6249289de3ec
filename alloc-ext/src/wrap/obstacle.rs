//! The original mesh as that which a hull may not meet: its triangles, its vertices, and one
//! witness of each connected part.

use super::boxes::{Bounds, BoxTree};
use super::cells::{CellTree, Frontier};
use super::connected::connected;
use super::distance::Reach;
use super::predicates::{Triangle, in_sunken, meet};
use super::region::{Plane, Tetrahedron};
use glam::DVec3;
use meshsweep_core::internal::geom::point_triangle;

/// Any set of triangles, in its own unit.
#[derive(Clone, Debug)]
pub(super) struct Obstacle {
    triangles: Vec<Triangle>,
    triangle_tree: BoxTree,
    triangle_cells: CellTree,
    points: Vec<DVec3>,
    point_cells: CellTree,
    witnesses: Vec<DVec3>,
    witness_tree: BoxTree,
    /// Distance within which nothing may come, if it is above 0.
    margin: f64,
}

/// Factor by which the bound of a plane's rounding exceeds `f64`'s unit: the products have eight
/// roundings, and what is kept for nothing costs one exact test.
const ROUNDINGS: f64 = 4096.0 * f64::EPSILON;

impl Obstacle {
    /// Of positions that are `f32` numbers.
    pub fn new(positions: &[DVec3], triangles: &[[u32; 3]]) -> Self {
        let all: Vec<Triangle> =
            triangles.iter().map(|t| t.map(|v| positions[v as usize])).collect();
        let boxes: Vec<Bounds> = all.iter().map(|t| Bounds::of(t)).collect();
        let (triangle_tree, order) = BoxTree::new(&boxes);
        let triangles_in_order: Vec<Triangle> = order.iter().map(|&i| all[i as usize]).collect();
        let triangle_cells =
            CellTree::new(&triangles_in_order.iter().map(|t| Bounds::of(t)).collect::<Vec<_>>());
        let points = positions.to_vec();
        let point_cells =
            CellTree::new(&points.iter().map(|&p| Bounds { low: p, high: p }).collect::<Vec<_>>());
        let (witnesses, witness_tree) = tree_of(&witnesses(positions, triangles));
        Self {
            triangles: triangles_in_order,
            triangle_tree,
            triangle_cells,
            points,
            point_cells,
            witnesses,
            witness_tree,
            margin: 0.0,
        }
    }

    /// The same, with a distance that nothing may come within.
    pub fn with_margin(self, margin: f64) -> Self {
        Self { margin, ..self }
    }

    /// See [`with_margin`](Self::with_margin).
    pub fn margin(&self) -> f64 {
        self.margin
    }

    /// The box of all triangles.
    pub fn bounds(&self) -> Bounds {
        self.triangles.iter().flatten().fold(Bounds::EMPTY, |b, &p| b.with(p))
    }

    /// All triangles.
    pub fn triangles(&self) -> &[Triangle] {
        &self.triangles
    }

    /// One vertex of each connected part.
    pub fn witnesses(&self) -> &[DVec3] {
        &self.witnesses
    }

    /// Whether a face touches or crosses any triangle: exact; or is not certainly farther from it
    /// than the margin.
    pub fn meets(&self, face: &Triangle) -> bool {
        if self.margin > 0.0 { self.is_near(face) } else { self.touches(face) }
    }

    fn is_near(&self, face: &Triangle) -> bool {
        let reach = Reach::new(self.margin);
        let bounds = Bounds::of(face);
        let [a, b, c] = *face;
        let normal = (b - a).cross(c - a);
        let mut near = false;
        self.triangle_tree.visit(
            |of| !reach.parts_box(face, &bounds, normal, of),
            |i| {
                near = !reach.parts(face, normal, &self.triangles[i]);
                !near
            },
        );
        near
    }

    fn touches(&self, face: &Triangle) -> bool {
        let bounds = Bounds::of(face);
        let [a, b, c] = *face;
        let (ab, ac) = (b - a, c - a);
        let normal = ab.cross(ac);
        let size = bounds.low.abs().max(bounds.high.abs()).max_element();
        let offset = normal.dot(a);
        // The tree's boxes that are looked at overlap the face's, but may be larger by any factor.
        let unit = ROUNDINGS * ab.length() * ac.length();
        let keep = |of: &Bounds| {
            if !of.meets(&bounds) {
                return false;
            }
            let slack = unit * size.max(of.low.abs().max(of.high.abs()).max_element());
            of.support(normal) - offset >= -slack && of.support(-normal) + offset >= -slack
        };
        let mut met = false;
        self.triangle_tree.visit(keep, |i| {
            met = meet(face, &self.triangles[i]);
            !met
        });
        met
    }

    /// Whether a witness lies in a tetrahedron that leaves the hull when the corner opposite to
    /// each base moves to `apex`. Exact.
    pub fn has_witness_in(&self, bases: &[Triangle], apex: DVec3) -> bool {
        let mut found = false;
        for base in bases {
            let bounds = Bounds::of(base).with(apex);
            self.witness_tree.visit(
                |of| of.meets(&bounds),
                |i| {
                    found = in_sunken(base, apex, self.witnesses[i]);
                    !found
                },
            );
            if found {
                break;
            }
        }
        found
    }

    /// Where queries in these bounds begin: among the vertices, and among the triangles.
    pub fn frontiers(&self, bounds: &Bounds, [points, triangles]: &mut [Frontier; 2]) {
        self.point_cells.frontier(bounds, points);
        self.triangle_cells.frontier(bounds, triangles);
    }

    /// The highest plane that `raise` makes of the vertices in a tetrahedron; see `Search`. Not
    /// exact.
    #[inline]
    pub fn highest_point(
        &self,
        near: &Frontier,
        tetrahedron: &Tetrahedron,
        raise: impl Fn(DVec3) -> Option<Plane>,
    ) -> Option<Plane> {
        let mut highest = None::<Plane>;
        let probe = self.point_cells.probe(tetrahedron.bounds(), tetrahedron.planes());
        self.point_cells.visit(near, probe, |i| {
            let p = self.points[i];
            let stands_out = highest.is_none_or(|plane| plane.holds(p)) && tetrahedron.holds(p);
            let raised = if stands_out { raise(p) } else { None };
            highest = raised.or(highest);
            raised
        });
        highest
    }

    /// As [`highest_point`](Self::highest_point), of the corners of what triangles have in common
    /// with the tetrahedron.
    #[inline]
    pub fn highest_piece(
        &self,
        near: &Frontier,
        tetrahedron: &Tetrahedron,
        raise: impl Fn(DVec3) -> Option<Plane>,
    ) -> Option<Plane> {
        let mut highest = None::<Plane>;
        let probe = self.triangle_cells.probe(tetrahedron.bounds(), tetrahedron.planes());
        self.triangle_cells.visit(near, probe, |i| {
            let triangle = &self.triangles[i];
            if highest.is_some_and(|plane| triangle.iter().all(|&p| !plane.holds(p))) {
                return None;
            }
            let mut raised = None;
            tetrahedron.clip(triangle, |p| raised = raise(p).or(raised));
            highest = raised.or(highest);
            raised
        });
        highest
    }

    /// Calls `visit` with the vertices in all boxes that pass `keep`, and perhaps others.
    #[inline]
    pub fn visit_points(
        &self,
        near: &Frontier,
        keep: impl Fn(&Bounds) -> bool,
        visit: impl Fn(DVec3),
    ) {
        self.point_cells.visit_kept(near, keep, |i| visit(self.points[i]));
    }

    /// As [`visit_points`](Self::visit_points), with the triangles.
    #[inline]
    pub fn visit_triangles(
        &self,
        near: &Frontier,
        keep: impl Fn(&Bounds) -> bool,
        visit: impl Fn(&Triangle),
    ) {
        self.triangle_cells.visit_kept(near, keep, |i| visit(&self.triangles[i]));
    }

    /// The triangle nearest to a point, and bounds of the distance to all.
    pub fn nearest(&self, p: DVec3) -> Option<(Triangle, [f64; 2])> {
        let mut lower = f64::INFINITY;
        let distance_sq = |i: usize| {
            let [a, b, c] = self.triangles[i];
            let bounds = point_triangle(p, a, b, c);
            lower = lower.min(bounds.lower);
            bounds.upper * bounds.upper
        };
        let (found, _) = self.triangle_tree.nearest(p, distance_sq)?;
        let [a, b, c] = self.triangles[found];
        let upper = point_triangle(p, a, b, c).upper;
        // What the tree passed over is no nearer than that, but for the rounding of a box's
        // distance.
        Some((self.triangles[found], [lower.min(upper * (1.0 - 1e-12)), upper]))
    }
}

fn tree_of(points: &[DVec3]) -> (Vec<DVec3>, BoxTree) {
    let boxes: Vec<Bounds> = points.iter().map(|&p| Bounds { low: p, high: p }).collect();
    let (tree, order) = BoxTree::new(&boxes);
    (order.iter().map(|&i| points[i as usize]).collect(), tree)
}

/// The vertex with the least number of each part that is connected by shared vertices.
fn witnesses(positions: &[DVec3], triangles: &[[u32; 3]]) -> Vec<DVec3> {
    let least = connected(positions.len(), triangles);
    let mut used = vec![false; positions.len()];
    triangles.iter().flatten().for_each(|&v| used[v as usize] = true);
    (0..positions.len())
        .filter(|&v| used[v] && least[v] == v as u32)
        .map(|v| positions[v])
        .collect()
}
