//! Edge splits; and exchanges: a split where the hull is loose for a collapse where it is not.

use super::ahead::Waiting;
use super::collapse::EdgeEdit;
use super::editor::HullEditor;
use super::memo::{Key, Question};
use super::placement::PlacementObjective;
use super::star::StarFace;
use super::tolerance::{CLEARANCES, LEAST_GAIN};
use crate::geom::Face;
use glam::DVec3;

/// As for a collapse: new faces may stand steeply on the old ones.
const SPLIT: PlacementObjective =
    PlacementObjective { upright: Some(0.05), ..PlacementObjective::PLAIN };

/// A split is tried for a collapse if it gains this fraction of the collapse's cost. The vertices
/// around both settle afterwards and gain more.
const HOPE: f64 = 0.5;

impl HullEditor<'_> {
    /// The star of a split about the middle of an edge; `None` if the edge may not be split.
    fn split_star(&self, [a, b]: [u32; 2]) -> Option<(DVec3, [StarFace; 4])> {
        let [c, d] = self.shell.mesh.wings(a, b)?.apexes;
        if [c, d].into_iter().any(|v| self.shell.mesh.at(v).len() >= self.shape.max_valence) {
            return None;
        }
        let [pa, pb, pc, pd] = [a, b, c, d].map(|v| self.shell.position(v));
        let middle = (pa + pb) * 0.5;
        let star = [[pc, pa], [pb, pc], [pd, pb], [pa, pd]]
            .map(|ring| StarFace::new([middle, ring[0], ring[1]], Some(ring)));
        Some((middle, star))
    }

    /// A split of an edge and its cost, which is negative if the hull loses volume.
    pub(super) fn evaluate_split(&mut self, ends: [u32; 2]) -> Option<EdgeEdit> {
        let (middle, star) = self.split_star(ends)?;
        let answer = self.remembered(Question::Split, &star, |editor| {
            editor.place(&star, middle, CLEARANCES[0], &SPLIT)
        });
        answer.map(|(position, cost)| EdgeEdit { cost, ends, position })
    }

    /// Splits an edge if the split is proved; the new vertex.
    pub(super) fn split(&mut self, split: &EdgeEdit) -> Option<u32> {
        let [a, b] = split.ends;
        let x = split.position;
        let wings = self.shell.mesh.wings(a, b)?;
        let [c, d] = wings.apexes;
        let v = self.shell.vertex_slots();
        let at = |u: u32| if u == v { x } else { self.shell.position(u) };
        let new =
            [[v, c, a], [v, b, c], [v, d, b], [v, a, d]].map(|ids| Face { ids, at: ids.map(at) });
        let bases = wings.triangles.map(|f| self.shell.triangle(f));
        if !new.iter().all(|face| self.is_within_limit(&face.at))
            || !self.admits(&new, &wings.triangles, &bases, x)
        {
            return None;
        }
        self.shell.split(a, b, x)
    }

    /// The splits of edges, cheapest first.
    fn splits(&mut self, edges: &[[u32; 2]]) -> Vec<EdgeEdit> {
        let mut waiting = Vec::new();
        for &ends in edges {
            let Some((centre, star)) = self.split_star(ends) else { continue };
            let key = Key::new(Question::Split, self.salt(), &star);
            if self.memo.get(key).is_none() {
                waiting.push(Waiting { key, star: star.to_vec(), centre, objective: SPLIT });
            }
        }
        self.remember_all(&waiting);
        let mut splits: Vec<_> =
            edges.iter().filter_map(|&ends| self.evaluate_split(ends)).collect();
        splits.sort_unstable_by(EdgeEdit::by_cost);
        splits
    }

    /// The ends of an edge and the apexes of its two faces; `None` if the edge is gone.
    fn corners_around(&self, ends: [u32; 2]) -> Option<[u32; 4]> {
        let [a, b] = ends;
        let [c, d] = self.shell.mesh.wings(a, b)?.apexes;
        Some([a, b, c, d])
    }

    /// Splits the edges that gain most until there are `target` faces, or no split gains volume.
    pub fn refine(&mut self, target: usize) {
        while self.shell.face_count() + 2 <= target && !self.is_late() {
            let splits = self.splits(&self.shell.mesh.edges());
            let before = self.shell.face_count();
            let mut touched: Vec<u32> = Vec::new();
            for split in splits.iter().filter(|split| split.cost < 0.0) {
                if self.shell.face_count() + 2 > target {
                    break;
                }
                let Some(around) = self.corners_around(split.ends) else { continue };
                if around.iter().any(|v| touched.contains(v)) {
                    continue;
                }
                if let Some(v) = self.split(split) {
                    for u in around.into_iter().chain([v]) {
                        self.settle(u);
                    }
                    touched.extend(around);
                }
            }
            if self.shell.face_count() == before {
                break;
            }
        }
    }

    /// Tries to exchange the best splits for the cheapest collapses. Keeps the exchanges that make
    /// the hull smaller.
    pub fn exchange(&mut self, attempts: usize) {
        let edges = self.shell.mesh.edges();
        let splits = self.splits(&edges);
        let mut collapses = self.evaluate_collapses(&edges);
        collapses.sort_unstable_by(EdgeEdit::by_cost);
        let mut touched: Vec<u32> = Vec::new();
        let mut tries = 0;
        let mut next_collapse = 0;
        for split in &splits {
            if tries >= attempts || self.is_spent() {
                break;
            }
            let Some(around_split) = self.corners_around(split.ends) else { continue };
            if around_split.iter().any(|v| touched.contains(v)) {
                continue;
            }
            let mesh = &self.shell.mesh;
            let found = collapses[next_collapse..].iter().position(|c| {
                let is_near = |v: &u32| {
                    c.ends.contains(v)
                        || c.ends.iter().any(|&e| mesh.neighbours(e).any(|u| u == *v))
                };
                !c.ends.iter().any(|v| touched.contains(v)) && !around_split.iter().any(is_near)
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
                touched.extend(ring);
                touched.extend(collapse.ends);
                touched.extend(around_split);
            } else {
                self.shell = saved;
            }
        }
    }

    fn swap(&mut self, split: &EdgeEdit, collapse: &EdgeEdit, around_split: &[u32]) -> bool {
        if !self.collapse(collapse.ends, collapse.position) {
            return false;
        }
        let Some(v) = self.split(split) else { return false };
        let [a, _] = collapse.ends;
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
