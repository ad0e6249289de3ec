//! The original mesh as the obstacle that a hull may not meet: its triangles, its vertices, and one
//! witness of each connected component.

use super::clearance::Clearance;
use super::tetrahedron::Tetrahedron;
use crate::geom::{Bounds, Frontier, Plane, StaticTree, Triangle, is_cut_off, meet, spatial_order};
use crate::mesh::Mesh;
use crate::surface::least_connected;
use glam::{DVec3, Vec3};
use meshsweep_core::internal::geom::point_triangle;

/// Any set of triangles, in its own unit, with search trees.
#[derive(Clone, Debug)]
pub(crate) struct Obstacle {
    /// In single precision, which holds them exactly.
    triangles: Vec<[Vec3; 3]>,
    triangle_tree: StaticTree,
    /// In single precision too.
    points: Vec<Vec3>,
    point_tree: StaticTree<1>,
    witnesses: Vec<DVec3>,
    witness_tree: StaticTree<1>,
    /// Distance within which no face may come; 0 for none.
    margin: f64,
    /// Whether the margin is more than the steps that placements keep anyway.
    is_wide: bool,
}

/// Sine between two edges of a face up to which the face counts as a needle. Rounding turns the
/// normal of any other face by less than 2^-50 / 1e-6 = 1e-9, which is far below the distance that
/// the tree adds to its boxes.
const NEEDLE: f64 = 1e-6;

/// Normal of a triangle, as long as twice its area.
fn normal([a, b, c]: &Triangle) -> DVec3 {
    (b - a).cross(c - a)
}

fn tree_of_points(points: &[DVec3]) -> StaticTree<1> {
    StaticTree::of_corners(&points.iter().map(|&p| [p]).collect::<Vec<_>>())
}

impl Obstacle {
    /// Of positions that are `f32` numbers. Cost: O(n log n).
    pub fn new(positions: &[DVec3], triangles: &[[u32; 3]]) -> Self {
        let bounds = |t: &[u32; 3]| Bounds::of(&t.map(|v| positions[v as usize]));
        let of_triangles = || {
            let order = spatial_order(&triangles.iter().map(bounds).collect::<Vec<_>>());
            let sorted: Vec<Triangle> = order
                .iter()
                .map(|&i| triangles[i as usize].map(|v| positions[v as usize]))
                .collect();
            let tree = StaticTree::of_corners(&sorted)
                .with_disks(|i| normal(&sorted[i]), |i, points| points.extend(sorted[i]));
            (tree, sorted.iter().map(|t| t.map(|p| p.as_vec3())).collect())
        };
        let of_points = || {
            let mut normals = vec![DVec3::ZERO; positions.len()];
            for t in triangles {
                let normal = normal(&t.map(|v| positions[v as usize]));
                t.iter().for_each(|&v| normals[v as usize] += normal);
            }
            let mut tree = tree_of_points(positions)
                .with_disks(|i| normals[i], |i, points| points.push(positions[i]));
            let points = tree.renumber().iter().map(|&i| positions[i as usize].as_vec3()).collect();
            (tree, points, witnesses(positions, triangles))
        };
        let ((triangle_tree, sorted), (point_tree, points, witnesses)) =
            rayon::join(of_triangles, of_points);
        Self {
            triangle_tree,
            triangles: sorted,
            point_tree,
            points,
            witness_tree: tree_of_points(&witnesses),
            witnesses,
            margin: 0.0,
            is_wide: false,
        }
    }

    /// Of a mesh and its wires.
    pub fn of(mesh: &Mesh) -> Self {
        let positions: Vec<DVec3> =
            mesh.positions.iter().map(|p| DVec3::from(p.map(f64::from))).collect();
        Self::new(&positions, &mesh.all_triangles().collect::<Vec<_>>())
    }

    /// The same with a margin: a distance within which no face may come.
    pub fn with_margin(self, margin: f64) -> Self {
        Self { margin, is_wide: margin > 0.0, ..self }
    }

    /// The same with a margin that is no more than a few steps of the hull's grid. Every edit is
    /// proved to keep it. Placements do not search for what is near: they keep some steps more from
    /// what they cut off, and faces that turn towards the mesh elsewhere are rarely that near.
    pub fn with_narrow_margin(self, margin: f64) -> Self {
        Self { margin, is_wide: false, ..self }
    }

    /// See [`with_margin`](Self::with_margin).
    pub fn margin(&self) -> f64 {
        self.margin
    }

    /// Whether placements search for the mesh near a face; see
    /// [`with_narrow_margin`](Self::with_narrow_margin).
    pub fn has_wide_margin(&self) -> bool {
        self.is_wide
    }

    /// The bounding box of all triangles.
    pub fn bounds(&self) -> Bounds {
        self.triangles().flatten().fold(Bounds::EMPTY, Bounds::with)
    }

    /// All triangles.
    pub fn triangles(&self) -> impl Iterator<Item = Triangle> + '_ {
        (0..self.triangles.len()).map(|i| self.triangle(i))
    }

    /// All triangles in single precision, those near each other next to each other.
    pub fn singles(&self) -> &[[Vec3; 3]] {
        &self.triangles
    }

    fn triangle(&self, i: usize) -> Triangle {
        self.triangles[i].map(|p| p.as_dvec3())
    }

    fn point(&self, i: usize) -> DVec3 {
        self.points[i].as_dvec3()
    }

    /// One vertex of each connected component.
    pub fn witnesses(&self) -> &[DVec3] {
        &self.witnesses
    }

    /// Whether a face has a point in common with any triangle, which is exact; with a margin,
    /// whether the face is not proved to keep the margin.
    pub fn meets(&self, face: &Triangle) -> bool {
        if self.margin > 0.0 { !self.keeps_margin(face) } else { self.touches(face) }
    }

    fn keeps_margin(&self, face: &Triangle) -> bool {
        let clearance = Clearance::new(self.margin);
        let bounds = Bounds::of(face);
        let [a, b, c] = *face;
        let normal = (b - a).cross(c - a);
        self.triangle_tree.visit_kept(
            &Frontier::whole(),
            |of| !clearance.separates_box(face, &bounds, normal, of),
            |i| clearance.separates(face, normal, &self.triangle(i)),
        )
    }

    fn touches(&self, face: &Triangle) -> bool {
        let [a, b, c] = *face;
        let normal = normal(face);
        let length = normal.length();
        let unit = normal / length;
        // Both sides of the face's plane, and the walls on its edges, if its normal is known well
        // enough. A wall has all corners on or in front of it, wherever rounding turns it to.
        let walls = [[a, b], [b, c], [c, a]].map(|[from, to]| {
            let normal = unit.cross(to - from).normalize_or_zero();
            let offset = face.iter().fold(f64::INFINITY, |least, &p| least.min(normal.dot(p)));
            Plane { normal, offset }
        });
        let [front, back] = [unit, -unit].map(|normal| Plane { normal, offset: normal.dot(a) });
        let [ab, bc, ca] = walls;
        let planes = [front, back, ab, bc, ca];
        let is_needle = length <= NEEDLE * (b - a).length() * (c - a).length();
        let planes = if is_needle { &[] } else { &planes[..] };
        let visit = |i: usize| !meet(face, &self.triangle(i));
        !self.triangle_tree.visit_reached(&Bounds::of(face), planes, visit)
    }

    /// Whether an edit that replaces the faces `bases` by faces at `apex` cuts a witness off the
    /// hull. Exact.
    pub fn has_witness_in(&self, bases: &[Triangle], apex: DVec3) -> bool {
        bases.iter().any(|base| {
            let bounds = Bounds::of(base).with(apex);
            !self
                .witness_tree
                .visit_meeting(&bounds, |i| !is_cut_off(base, apex, self.witnesses[i]))
        })
    }

    /// Where queries in these bounds begin: among the vertices, and among the triangles.
    pub fn frontiers(&self, bounds: &Bounds, [points, triangles]: &mut [Frontier; 2]) {
        self.point_tree.frontier(bounds, points);
        self.triangle_tree.frontier(bounds, triangles);
    }

    /// The highest plane that `raise` makes of the vertices in a tetrahedron. Not exact.
    #[inline]
    pub fn highest_point(
        &self,
        near: &Frontier,
        tetrahedron: &Tetrahedron,
        raise: impl Fn(DVec3) -> Option<Plane>,
    ) -> Option<Plane> {
        highest(&self.point_tree, near, tetrahedron, |i, highest| {
            let p = self.point(i);
            let stands_out = highest.is_none_or(|plane| plane.holds(p)) && tetrahedron.holds(p);
            if stands_out { raise(p) } else { None }
        })
    }

    /// As [`highest_point`](Self::highest_point), of the corners of the parts of triangles that lie
    /// in the tetrahedron.
    #[inline]
    pub fn highest_piece(
        &self,
        near: &Frontier,
        tetrahedron: &Tetrahedron,
        raise: impl Fn(DVec3) -> Option<Plane>,
    ) -> Option<Plane> {
        highest(&self.triangle_tree, near, tetrahedron, |i, highest| {
            let triangle = self.triangle(i);
            if highest.is_some_and(|plane| triangle.iter().all(|&p| !plane.holds(p))) {
                return None;
            }
            let mut raised = None;
            tetrahedron.clip(&triangle, |p| raised = raise(p).or(raised));
            raised
        })
    }

    /// Calls `visit` with the vertices in all boxes that pass `keep`, and perhaps with others.
    #[inline]
    pub fn visit_points(
        &self,
        near: &Frontier,
        keep: impl Fn(&Bounds) -> bool,
        visit: impl Fn(DVec3),
    ) {
        self.point_tree.visit_kept(near, keep, |i| {
            visit(self.point(i));
            true
        });
    }

    /// As [`visit_points`](Self::visit_points), with the triangles.
    #[inline]
    pub fn visit_triangles(
        &self,
        near: &Frontier,
        keep: impl Fn(&Bounds) -> bool,
        visit: impl Fn(&Triangle),
    ) {
        self.triangle_tree.visit_kept(near, keep, |i| {
            visit(&self.triangle(i));
            true
        });
    }

    /// The triangle nearest to a point, and bounds of the distance to the mesh.
    pub fn nearest(&self, p: DVec3) -> Option<(Triangle, [f64; 2])> {
        let mut lower = f64::INFINITY;
        let distance_sq = |i: usize| {
            let [a, b, c] = self.triangle(i);
            let bounds = point_triangle(p, a, b, c);
            lower = lower.min(bounds.lower);
            bounds.upper * bounds.upper
        };
        let (found, _) = self.triangle_tree.nearest(p, distance_sq)?;
        let triangle = self.triangle(found);
        let [a, b, c] = triangle;
        let upper = point_triangle(p, a, b, c).upper;
        // Triangles that the tree passed over are no nearer, but for the rounding of a box's
        // distance.
        Some((triangle, [lower.min(upper * (1.0 - 1e-12)), upper]))
    }
}

/// The least vertex of each connected component.
fn witnesses(positions: &[DVec3], triangles: &[[u32; 3]]) -> Vec<DVec3> {
    let least = least_connected(positions.len(), triangles);
    let mut used = vec![false; positions.len()];
    triangles.iter().flatten().for_each(|&v| used[v as usize] = true);
    (0..positions.len())
        .filter(|&v| used[v] && least[v] == v as u32)
        .map(|v| positions[v])
        .collect()
}

/// The last plane that `raise` makes of an item and the highest plane so far.
#[inline]
fn highest<const CORNERS: usize>(
    tree: &StaticTree<CORNERS>,
    near: &Frontier,
    tetrahedron: &Tetrahedron,
    raise: impl Fn(usize, Option<Plane>) -> Option<Plane>,
) -> Option<Plane> {
    let mut highest = None;
    let probe = tree.probe(tetrahedron.bounds(), tetrahedron.turning_planes());
    tree.visit_raising(near, probe, |i| {
        let raised = raise(i, highest);
        highest = raised.or(highest);
        raised
    });
    highest
}
