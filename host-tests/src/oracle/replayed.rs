//! A refined hull by the tables alone, and whether a focus needs a split: by arithmetic of its own.

use crate::generate::Rng;
use glam::DVec3;
use meshsweep::check::{Manifold, Surface, Winding};
use meshsweep_core::internal::hull::format::SplitIdx;
use meshsweep_core::{Focus, Hull, VertIdx};
use std::collections::BTreeSet;

/// A refined hull by the tables alone: a set of splits, and a mesh that refuses what does not fit.
#[derive(Debug)]
pub struct Replayed<'t> {
    hull: Hull<'t>,
    mesh: Manifold,
    performed: BTreeSet<u32>,
}

impl<'t> Replayed<'t> {
    /// The base hull.
    ///
    /// # Panics
    /// If it is no mesh.
    #[must_use]
    pub fn new(hull: Hull<'t>) -> Self {
        let mut mesh = Manifold::default();
        for triangle in 0..hull.header().base_triangles {
            let corners = hull.base_triangle(triangle).expect("in range");
            mesh.add(corners.map(|v| v.0)).expect("the base hull is a mesh");
        }
        Self { hull, mesh, performed: BTreeSet::new() }
    }

    /// Splits that are performed.
    #[must_use]
    pub fn performed(&self) -> &BTreeSet<u32> {
        &self.performed
    }

    /// Its triangles, in order.
    #[must_use]
    pub fn triangles(&self) -> Vec<[u32; 3]> {
        self.mesh.triangles()
    }

    /// The vertex that a split replaces, and its ring.
    fn named(&self, split: u32) -> impl Iterator<Item = VertIdx> {
        let split = self.hull.split(SplitIdx(split)).expect("in range");
        let ring = (0..split.ring_len()).map(move |i| split.ring(i).expect("in range"));
        std::iter::once(split.vertex).chain(ring)
    }

    fn requires(&self, split: u32) -> BTreeSet<u32> {
        self.named(split).filter_map(|v| self.hull.made_by(v)).map(|maker| maker.0).collect()
    }

    /// Whether the vertices that a split names exist, and it is not performed.
    #[must_use]
    pub fn may_perform(&self, split: u32) -> bool {
        !self.performed.contains(&split) && self.requires(split).is_subset(&self.performed)
    }

    /// Whether a split is performed, and no other needs its vertices.
    #[must_use]
    pub fn may_undo(&self, split: u32) -> bool {
        self.performed.contains(&split)
            && !self.performed.range(split + 1..).any(|&s| self.requires(s).contains(&split))
    }

    /// Performs a split that is not performed, after those that it requires.
    ///
    /// # Panics
    /// If a split does not fit.
    pub fn perform(&mut self, split: u32) {
        let mut waiting = vec![split];
        while let Some(&split) = waiting.last() {
            let missing: Vec<u32> =
                self.requires(split).difference(&self.performed).copied().collect();
            if missing.is_empty() {
                waiting.pop();
                if !self.performed.contains(&split) {
                    self.turn(split, true);
                }
            }
            waiting.extend(missing);
        }
    }

    /// Replaces the coarse triangles of a split by the fine ones, or the reverse.
    ///
    /// # Panics
    /// If the coarse ones are not there, or the fine ones do not fit.
    pub fn turn(&mut self, number: u32, perform: bool) {
        let split = self.hull.split(SplitIdx(number)).expect("in range");
        let coarse = (0..split.ring_len()).map(|i| split.coarse(i).expect("in range"));
        let fine = (0..split.fine_len()).map(|i| split.fine(i).expect("in range"));
        let mut stars = [coarse.collect::<Vec<_>>(), fine.collect()];
        if !perform {
            stars.reverse();
        }
        let [old, new] = stars;
        for corners in old {
            self.mesh.remove(corners.map(|v| v.0)).expect("the star of the vertex");
        }
        for corners in new {
            self.mesh.add(corners.map(|v| v.0)).expect("a free place");
        }
        let changed =
            if perform { self.performed.insert(number) } else { self.performed.remove(&number) };
        assert!(changed);
    }

    /// Closed, a manifold, and around each point at least as often as the surface, in exact
    /// arithmetic.
    ///
    /// # Panics
    /// If it is not so.
    pub fn assert_encloses(&self, points: &Inside) {
        self.mesh.closed_manifold().expect("a closed manifold");
        let hull = Winding::new(&surface(&self.hull, self.mesh.triangles()));
        for &(p, turns) in &points.0 {
            let around = hull.around(p).expect("below the surface is no face");
            assert!(around >= turns, "{p:?} is not enclosed");
        }
    }

    /// Vertices that exist, each with the split that would replace it.
    #[must_use]
    pub fn existing(&self) -> Vec<(VertIdx, SplitIdx)> {
        let of_base = 0..self.hull.header().base_vertices;
        let brought = self.performed.iter().flat_map(|&split| {
            let first = self.hull.header().base_vertices + 2 * split;
            [first, first + 1]
        });
        let replaced_by = |v| {
            let split = self.hull.split_of(VertIdx(v))?;
            (!self.performed.contains(&split.0)).then_some((VertIdx(v), split))
        };
        of_base.chain(brought).filter_map(replaced_by).collect()
    }
}

/// Points just below the surface, each with the surface's winding number.
#[derive(Debug)]
pub struct Inside(Vec<([f64; 3], i64)>);

fn surface(hull: &Hull<'_>, triangles: Vec<[u32; 3]>) -> Surface {
    let position = |v| hull.position(VertIdx(v)).expect("in range").as_dvec3().to_array();
    Surface { positions: (0..hull.header().vertices).map(position).collect(), triangles }
}

impl Inside {
    /// Of a hull hierarchy.
    ///
    /// # Panics
    /// If its finest level is no mesh.
    #[must_use]
    pub fn new(hull: Hull<'_>) -> Self {
        let mut finest = Replayed::new(hull);
        (0..hull.split_count()).for_each(|split| finest.turn(split, true));
        let part = surface(&hull, finest.mesh.triangles());
        let winding = Winding::new(&part);
        let mut rng = Rng::new(91);
        let mut points = Vec::new();
        while points.len() < 60 {
            // Just below the surface, where a hull that cuts into the part shows.
            let triangle = part.triangles[rng.below(part.triangles.len())];
            let [a, b, c] = triangle.map(|v| DVec3::from(part.positions[v as usize]));
            let weights = [rng.unit_f64(), rng.unit_f64(), rng.unit_f64()];
            let sum: f64 = weights.iter().sum();
            let on = (a * weights[0] + b * weights[1] + c * weights[2]) / sum;
            let inward = (c - a).cross(b - a);
            let p = (on + inward.normalize_or_zero() * 1e-7).to_array();
            if let Ok(turns @ 1..) = winding.around(p) {
                points.push((p, turns));
            }
        }
        Self(points)
    }
}

/// Whether a ball certainly meets a focus and an error is certainly not allowed there, in the local
/// frame, by arithmetic of its own.
///
/// # Panics
/// If the hull has no such vertex.
#[must_use]
pub fn is_needed(
    hull: &Hull<'_>,
    focus: &Focus,
    wanted: f32,
    vertex: VertIdx,
    [reach, error]: [f32; 2],
) -> bool {
    const SURE: f64 = 1e-5;
    let local = |p: [f32; 3]| DVec3::from(p.map(f64::from)) / hull.scale();
    let length = |x: f32| f64::from(x) / hull.scale();
    let v = hull.position(vertex).expect("in range").as_dvec3();
    let (reach, error) = (f64::from(reach), f64::from(error));
    let least_error = length(wanted);
    let gap = match *focus {
        Focus::Everywhere => 0.0,
        Focus::Ball { centre, radius } => v.distance(local(centre)) - length(radius),
        Focus::Box { a, b } => {
            let (a, b) = (local(a), local(b));
            v.clamp(a.min(b), a.max(b)).distance(v)
        }
        Focus::Segment { a, b, radius } => {
            let (a, way) = (local(a), local(b) - local(a));
            let t = ((v - a).dot(way) / way.length_squared()).clamp(0.0, 1.0);
            v.distance(a + way * t) - length(radius)
        }
        Focus::Eye { position, axis, cosine, error_per_distance } => {
            let from = v - local(position);
            let distance = (from.length() - reach).max(0.0);
            let axis = DVec3::from(axis.map(f64::from)).normalize();
            let angle = (from.dot(axis) / from.length()).clamp(-1.0, 1.0).acos();
            let half = f64::from(cosine).acos();
            let span = (reach / from.length()).clamp(0.0, 1.0).asin();
            return error > least_error * (1.0 + SURE)
                && error > f64::from(error_per_distance) * distance * (1.0 + SURE)
                && (distance == 0.0 || angle - span < half - SURE);
        }
        _ => unreachable!("no other focus"),
    };
    gap < reach * (1.0 - SURE) && error > least_error * (1.0 + SURE)
}
