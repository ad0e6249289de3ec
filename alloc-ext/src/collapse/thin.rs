//! Rounds of collapses for fine meshes, where the order of collapses does not show: a round takes
//! the cheapest edges whose stars share no face.
//!
//! [`Engine`](super::Engine) gives a better hull of as many faces and takes four times as long. It
//! solves a linear program for each edge around each collapse, and reads memory in no order.

use super::Conditions;
use super::greedy::{self, Candidate, Collapsing, Schedule};
use super::star::Connectivity;
use super::surface::Surface;
use crate::surface::Grid;
use glam::DVec3;
use rayon::prelude::*;

/// Part of the edges that a round tries. With more, the hull grows into itself in narrow places.
const TRIED: f64 = 0.1;

/// Triangles whose edges a thread evaluates at least.
const TRIANGLES_A_THREAD: usize = 1000;

/// The last round is the one that collapses fewer than one in this many of its edges.
const TOO_FEW: usize = 100;

/// Positions, on `grid`, and triangles of a hull of a closed manifold mesh, whose positions are on
/// `grid` too. The hull winds around every point that the mesh winds around.
///
/// It has `target` faces, or one more. It has more if hardly an edge may collapse, or if `stop`
/// returns true. `stop` is called after each round with the number of faces.
pub fn thin(
    positions: &[DVec3],
    triangles: &[[u32; 3]],
    target: usize,
    conditions: Conditions,
    grid: Grid,
    stop: impl FnMut(usize) -> bool,
) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let mut schedule = Schedule::new(positions.len());
    let surface = Surface::new(positions.to_vec(), triangles, conditions, grid);
    let mut rounds = Rounds { surface, conditions, grid, costs: Vec::new(), round: None, stop };
    greedy::run(&mut rounds, &mut schedule, target + 1, |_| true);
    rounds.surface.compact()
}

/// A surface whose edges are evaluated once a round.
struct Rounds<F> {
    surface: Surface,
    conditions: Conditions,
    grid: Grid,
    /// Cost of edge `3 · t + k`, which runs from corner `k` of triangle `t` to the next one. It
    /// counts where the first end is the lesser.
    costs: Vec<f64>,
    round: Option<Round>,
    stop: F,
}

/// A round of collapses.
struct Round {
    /// When it began.
    time: u32,
    tried: usize,
    collapsed: usize,
}

impl<F: FnMut(usize) -> bool> Collapsing for Rounds<F> {
    type Note = ();

    fn mesh(&self) -> &Connectivity {
        &self.surface.mesh
    }

    /// A round does not try an edge again whose star has changed.
    fn evaluate(&mut self, _ends: [u32; 2], _schedule: &mut Schedule) {}

    fn is_valid(&self, _candidate: &Candidate) -> bool {
        true
    }

    fn collapse(&mut self, candidate: &Candidate, _schedule: &mut Schedule) -> bool {
        let [a, b] = candidate.ends;
        let placed =
            if self.surface.gather([a, b]) { self.surface.place([a, b], true).ok() } else { None };
        let Some(placement) = placed else {
            // Refused until its star changes.
            self.costs[candidate.rank as usize] = f64::INFINITY;
            return false;
        };
        self.surface.collapse(a, b, placement.position);
        if let Some(round) = &mut self.round {
            round.collapsed += 1;
        }
        true
    }

    /// The next round.
    fn refill(&mut self, schedule: &mut Schedule) -> bool {
        let mesh = &self.surface.mesh;
        if let Some(Round { tried, collapsed, .. }) = self.round {
            if collapsed * TOO_FEW <= tried || (self.stop)(mesh.alive_count()) {
                return false;
            }
            if mesh.alive_count() * 2 < mesh.corners.len() {
                let (positions, triangles) = self.surface.compact();
                *schedule = Schedule::new(positions.len());
                self.surface = Surface::new(positions, &triangles, self.conditions, self.grid);
                self.costs.clear();
            }
        }
        self.update_costs(schedule);
        let cheapest = self.cheapest();
        let time = schedule.now();
        self.round = Some(Round { time, tried: cheapest.len(), collapsed: 0 });
        for (cost, rank) in cheapest {
            schedule.add(Candidate { cost, rank, ends: self.ends(rank), time, note: () });
        }
        true
    }
}

impl<F> Rounds<F> {
    fn ends(&self, edge: u32) -> [u32; 2] {
        let corners = self.surface.mesh.corners[edge as usize / 3];
        [corners[edge as usize % 3], corners[(edge as usize + 1) % 3]]
    }

    /// Evaluates the edges whose stars the last round has changed, or all.
    fn update_costs(&mut self, schedule: &Schedule) {
        let edge_count = 3 * self.surface.mesh.corners.len();
        let last = self.round.as_ref().map_or(0, |round| round.time);
        let all = self.costs.len() != edge_count;
        self.costs.resize(edge_count, f64::INFINITY);
        let Self { surface, costs, .. } = self;
        let surface = &*surface;
        costs.par_chunks_mut(3).with_min_len(TRIANGLES_A_THREAD).enumerate().for_each(
            |(triangle, costs)| {
                let corners = surface.mesh.corners[triangle];
                let is_alive = surface.mesh.is_alive(triangle as u32);
                for (k, cost) in costs.iter_mut().enumerate() {
                    let ends = [corners[k], corners[(k + 1) % 3]];
                    if !is_alive || ends[0] > ends[1] {
                        *cost = f64::INFINITY;
                    } else if all || schedule.is_stale(ends, last) {
                        *cost = surface.span(ends);
                    }
                }
            },
        );
    }

    fn cheapest(&self) -> Vec<(f64, u32)> {
        let all = self.costs.iter().zip(0u32..).filter(|(cost, _)| **cost < f64::INFINITY);
        let mut all: Vec<(f64, u32)> = all.map(|(&cost, edge)| (cost, edge)).collect();
        let tried = (all.len() as f64 * TRIED) as usize + 1;
        if tried < all.len() {
            all.select_nth_unstable_by(tried, |a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            all.truncate(tried);
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collapse::{Engine, Priority};
    use crate::geom::crosses_itself;
    use crate::mesh::{Mesh, require_closed_manifold};
    use crate::surface::{VertexBits, store};
    use robust::{Coord3D, orient3d};

    /// A lumpy torus around the z-axis.
    fn torus(n: u32) -> Mesh {
        let angle = |i: u32| f64::from(i) / f64::from(n) * std::f64::consts::TAU;
        let place = |i: u32| {
            let (u, v) = (angle(i / n), angle(i % n));
            let r = 3.0 + v.cos();
            [r * u.cos(), r * u.sin(), v.sin()]
        };
        let positions = (0..n * n)
            .map(|i| {
                place(i).map(|x| (x * (1.0 + 1e-3 * f64::from(i * 7919 % 101) / 101.0)) as f32)
            })
            .collect();
        let at = |i: u32, j: u32| i % n * n + j % n;
        let quad = |i: u32, j: u32| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        let quads = (0..n).flat_map(|i| (0..n).map(move |j| quad(i, j)));
        Mesh::new(positions, quads.flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect())
    }

    #[test]
    fn a_surface_that_has_to_stay_apart_does_not_grow_into_itself() {
        let mesh = torus(40);
        // Two tori, one above the other, with a gap that hulls of few faces close.
        let above = mesh.positions.iter().map(|&[x, y, z]| [x, y, z + 2.05]);
        let positions: Vec<[f32; 3]> = mesh.positions.iter().copied().chain(above).collect();
        let count = mesh.positions.len() as u32;
        let next = mesh.triangles.iter().map(|t| t.map(|v| v + count));
        let mesh = Mesh::new(positions, mesh.triangles.iter().copied().chain(next).collect());
        let stored = store(&mesh, VertexBits::F32);
        for keeps_apart in [false, true] {
            let conditions =
                Conditions { compactness_ratio: 0.4, keeps_apart, ..Conditions::STANDARD };
            let (positions, triangles) =
                thin(&stored.positions, &mesh.triangles, 1000, conditions, stored.grid, |_| false);
            let mut engine =
                Engine::new(&positions, &triangles, conditions, Priority::Program, stored.grid);
            engine.run(300, |_| true);
            let faces: Vec<[u32; 3]> = engine.faces().collect();
            assert!(faces.len() < 400, "{}", faces.len());
            assert_eq!(crosses_itself(engine.positions(), &faces), !keeps_apart);
        }
    }

    fn crossings(from: DVec3, to: DVec3, faces: &[[DVec3; 3]]) -> i32 {
        let side = |a: DVec3, b: DVec3, c: DVec3, d: DVec3| {
            let [a, b, c, d] = [a, b, c, d].map(|p| Coord3D { x: p.x, y: p.y, z: p.z });
            orient3d(a, b, c, d)
        };
        let crossed = |&[a, b, c]: &[DVec3; 3]| {
            let turns = [side(from, to, a, b), side(from, to, b, c), side(from, to, c, a)];
            let passes = turns.iter().all(|&t| t > 0.0) || turns.iter().all(|&t| t < 0.0);
            i32::from(passes && side(a, b, c, from) * side(a, b, c, to) < 0.0)
        };
        faces.iter().map(crossed).sum()
    }

    #[test]
    fn a_thinned_surface_is_closed_has_the_faces_asked_for_and_every_vertex_inside_or_on_it() {
        let mesh = torus(40);
        let stored = store(&mesh, VertexBits::F32);
        for target in [400, 1000, 3199, 3200, 5000] {
            let conditions = Conditions { compactness_ratio: 0.4, ..Conditions::STANDARD };
            let thinned = |stop| {
                thin(&stored.positions, &mesh.triangles, target, conditions, stored.grid, |_| stop)
            };
            let (positions, triangles) = thinned(false);
            assert!(triangles.len() >= target.min(3200) && triangles.len() <= target.min(3200) + 1);
            assert_eq!(
                thinned(false),
                (positions.clone(), triangles.clone()),
                "not the same twice"
            );
            let single = positions.iter().map(|p| p.as_vec3().to_array()).collect();
            let hull = Mesh::new(single, triangles.clone());
            assert!(
                hull.positions
                    .iter()
                    .zip(&positions)
                    .all(|(p, q)| glam::Vec3::from(*p).as_dvec3() == *q)
            );
            require_closed_manifold(&hull).unwrap();
            let faces: Vec<_> =
                triangles.iter().map(|t| t.map(|v| positions[v as usize])).collect();
            // Off the hull's vertices, so that none is on the line.
            let far = DVec3::new(11.37, 23.91, 57.13);
            for &p in stored.positions.iter().filter(|p| !positions.contains(p)) {
                let on = |[a, b, c]: &[DVec3; 3]| (*b - *a).cross(*c - *a).dot(p - *a).abs() < 1e-9;
                assert!(
                    crossings(p, far, &faces) % 2 == 1 || faces.iter().any(on),
                    "{target}: {p}"
                );
            }
        }
        let (_, after_a_round) = thin(
            &stored.positions,
            &mesh.triangles,
            100,
            Conditions::STANDARD,
            stored.grid,
            |_| true,
        );
        assert!(
            after_a_round.len() > 2000 && after_a_round.len() < 3200,
            "{}",
            after_a_round.len()
        );
    }
}
