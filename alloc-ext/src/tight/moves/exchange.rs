//! Splits, and exchanges: a split where the hull is loose for a collapse where it is not.

use crate::tight::moves::collapse::EdgeMove;
use crate::tight::moves::editor::HullEditor;
use crate::tight::moves::flip::LEAST_GAIN;
use crate::tight::moves::memo::{Key, Question};
use crate::tight::moves::placement::{PlacementObjective, StarFace};
use crate::tight::moves::vertex::CLEARANCES;
use glam::DVec3;

/// As a collapse: new faces may stand steeply on the old ones.
const SPLIT: PlacementObjective = PlacementObjective {
    second_term: 0.05,
    tilt: DVec3::ZERO,
    upright: Some(0.05),
    clearance: 0.0,
};

/// A split is tried for a collapse if it gains this part of what that costs: the vertices around
/// both settle afterwards and gain more.
const HOPE: f64 = 0.5;

impl HullEditor<'_> {
    /// What splitting an edge would cost: less than nothing.
    pub(crate) fn evaluate_split(&mut self, a: u32, b: u32) -> Option<EdgeMove> {
        let wings = self.shell.mesh.wings(a, b)?;
        let [c, d] = wings.apexes;
        if [c, d].into_iter().any(|v| self.shell.mesh.at(v).len() >= self.shape.max_valence) {
            return None;
        }
        let [pa, pb, pc, pd] = [a, b, c, d].map(|v| self.shell.position(v));
        let middle = (pa + pb) * 0.5;
        let mut star = std::mem::take(&mut self.star);
        star.clear();
        star.extend(
            [[pc, pa], [pb, pc], [pd, pb], [pa, pd]]
                .map(|ring| StarFace::new([middle, ring[0], ring[1]], Some(ring))),
        );
        let key = Key::new(Question::Split, self.salt(), &star);
        let answer = match self.memo.get(key) {
            Some(answer) => answer,
            None => {
                let wish =
                    PlacementObjective { clearance: self.clearance(&star, CLEARANCES[0]), ..SPLIT };
                let placed = self.placer.place(self.obstacle, &star, middle, &wish);
                let placed = placed.and_then(|x| self.rounding.round(x));
                let placed = placed.filter(|&x| self.is_shapely(&star, x));
                let answer =
                    placed.map(|x| (x, star.iter().map(|f| f.added(x)).sum::<f64>() / 6.0));
                self.memo.put(key, answer);
                answer
            }
        };
        self.star = star;
        answer.map(|(position, cost)| EdgeMove { cost, ends: [a, b], time: 0, position })
    }

    /// Splits an edge, if that can be proved; the new vertex.
    pub(crate) fn split(&mut self, split: &EdgeMove) -> Option<u32> {
        let [a, b] = split.ends;
        let x = split.position;
        let wings = self.shell.mesh.wings(a, b)?;
        let [c, d] = wings.apexes;
        let v = self.shell.vertex_slots();
        let at = |u: u32| if u == v { x } else { self.shell.position(u) };
        let new = [[v, c, a], [v, b, c], [v, d, b], [v, a, d]]
            .map(|ids| crate::tight::proof::predicates::Face { ids, at: ids.map(at) });
        let bases = wings.triangles.map(|f| self.shell.triangle(f));
        if !new.iter().all(|face| self.is_within_limit(&face.at))
            || !self.admits(&new, &wings.triangles, &bases, x)
        {
            return None;
        }
        self.shell.split(a, b, x)
    }

    /// Splits the edges that gain most until there are `target` faces, or nothing is gained.
    pub fn refine(&mut self, target: usize) {
        while self.shell.face_count() + 2 <= target && !self.is_late() {
            let edges = self.shell.edges();
            let mut splits: Vec<_> =
                edges.iter().filter_map(|&[a, b]| self.evaluate_split(a, b)).collect();
            splits.sort_unstable_by(|a, b| b.cmp(a));
            let before = self.shell.face_count();
            let mut touched: Vec<u32> = Vec::new();
            for split in splits.iter().filter(|split| split.cost < 0.0) {
                if self.shell.face_count() + 2 > target {
                    break;
                }
                let [a, b] = split.ends;
                let Some(wings) = self.shell.mesh.wings(a, b) else { continue };
                let around = [split.ends, wings.apexes].concat();
                if around.iter().any(|v| touched.contains(v)) {
                    continue;
                }
                if let Some(v) = self.split(split) {
                    around.iter().chain([&v]).for_each(|&u| {
                        self.settle(u);
                    });
                    touched.extend(around);
                }
            }
            if self.shell.face_count() == before {
                break;
            }
        }
    }

    /// Tries to exchange the best splits for the cheapest collapses; how many made the hull
    /// smaller.
    pub fn exchange(&mut self, attempts: usize) -> usize {
        let edges = self.shell.edges();
        let mut splits: Vec<_> =
            edges.iter().filter_map(|&[a, b]| self.evaluate_split(a, b)).collect();
        let mut collapses: Vec<_> =
            edges.iter().filter_map(|&[a, b]| self.evaluate(a, b, 0)).collect();
        splits.sort_unstable_by(|a, b| b.cmp(a));
        collapses.sort_unstable_by(|a, b| b.cmp(a));
        let mut touched: Vec<u32> = Vec::new();
        let mut kept = 0;
        let mut tries = 0;
        let mut next_collapse = 0;
        for split in &splits {
            if tries >= attempts || self.is_spent() {
                break;
            }
            let Some(wings) = self.shell.mesh.wings(split.ends[0], split.ends[1]) else { continue };
            let around_split = [split.ends, wings.apexes].concat();
            if around_split.iter().any(|v| touched.contains(v)) {
                continue;
            }
            let found = collapses[next_collapse..].iter().position(|c| {
                let mesh = &self.shell.mesh;
                let near = |v: &u32| {
                    c.ends.contains(v)
                        || c.ends.iter().any(|&e| mesh.neighbours(e).any(|u| u == *v))
                };
                !c.ends.iter().any(|v| touched.contains(v)) && !around_split.iter().any(near)
            });
            let Some(found) = found else { break };
            let collapse = collapses[next_collapse + found];
            if -split.cost < HOPE * collapse.cost {
                break;
            }
            next_collapse += found + 1;
            tries += 1;
            let (before, saved) = (self.shell.volume(), self.shell.clone());
            let ring: Vec<u32> =
                collapse.ends.iter().flat_map(|&e| self.shell.mesh.neighbours(e)).collect();
            if self.swap(split, &collapse, &around_split)
                && self.shell.volume() < before * (1.0 - LEAST_GAIN)
            {
                kept += 1;
                touched.extend(ring);
                touched.extend(collapse.ends);
                touched.extend(around_split);
            } else {
                self.shell = saved;
            }
        }
        kept
    }

    fn swap(&mut self, split: &EdgeMove, collapse: &EdgeMove, around_split: &[u32]) -> bool {
        let [a, b] = collapse.ends;
        if !self.collapse(a, b, collapse.position) {
            return false;
        }
        let Some(v) = self.split(split) else { return false };
        let mut around: Vec<u32> = self.shell.mesh.neighbours(a).collect();
        around.push(a);
        around.extend(around_split);
        around.push(v);
        for _ in 0..2 {
            for &u in &around {
                self.settle(u);
            }
        }
        true
    }
}
