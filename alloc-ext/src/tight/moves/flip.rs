//! Edge flips.

use super::editor::{HullEditor, compactness};
use super::memo::{Key, Question};
use super::side_by_side::Edit;
use super::star::StarFace;
use super::tolerance::LEAST_GAIN;
use crate::geom::{Face, Triangle, side};

/// Part of the worse compactness of the two old faces that new faces keep, if the shape conditions
/// ask for more.
const KEPT_COMPACTNESS: f64 = 0.7;

impl HullEditor<'_> {
    /// Flips every convex edge whose flip cuts off a tetrahedron without mesh.
    pub fn flip_all(&mut self) {
        for [a, b] in self.shell.mesh.edges() {
            self.flip_inward(a, b);
        }
    }

    /// Flips every edge, convex or not, whose four corners then settle with less volume than
    /// before.
    pub fn flip_search(&mut self) {
        let edges = self.shell.mesh.edges();
        self.try_side_by_side(edges.into_iter(), |worker, ends| worker.flip_and_settle(ends));
    }

    fn flip_and_settle(&mut self, ends: [u32; 2]) -> Option<Edit> {
        let [a, b] = ends;
        let [c, d] = self.shell.mesh.wings(a, b)?.apexes;
        let corners = [a, b, c, d];
        let before = self.shell.volume();
        if !self.flip(a, b) {
            return None;
        }
        for _ in 0..2 {
            for v in corners {
                self.settle(v);
            }
        }
        let moves = || corners.map(|v| (v, self.shell.position(v))).to_vec();
        let is_better = self.shell.volume() < before * (1.0 - LEAST_GAIN);
        is_better.then(|| Edit { flip: Some(ends), moves: moves() })
    }

    /// Flips the edge if it is convex and the flip is proved.
    fn flip_inward(&mut self, a: u32, b: u32) {
        let Some(wings) = self.shell.mesh.wings(a, b) else { return };
        let left = self.shell.triangle(wings.triangles[0]);
        if side(&left, self.shell.position(wings.apexes[1])) < 0.0 {
            self.flip(a, b);
        }
    }

    /// Flips the edge `a b` if shape and proof allow it, whether the hull grows or not.
    pub(super) fn flip(&mut self, a: u32, b: u32) -> bool {
        let Some(wings) = self.shell.mesh.wings(a, b) else { return false };
        let [c, d] = wings.apexes;
        let mesh = &self.shell.mesh;
        let max = self.shape.max_valence;
        if mesh.at(a).len() <= 3
            || mesh.at(b).len() <= 3
            || mesh.at(c).len() >= max
            || mesh.at(d).len() >= max
        {
            return false;
        }
        if c == d || mesh.neighbours(c).any(|v| v == d) {
            return false;
        }
        let old = wings.triangles.map(|f| self.shell.triangle(f));
        let [pa, pb, pc, pd] = [a, b, c, d].map(|v| self.shell.position(v));
        let new =
            [Face { ids: [a, d, c], at: [pa, pd, pc] }, Face { ids: [d, b, c], at: [pd, pb, pc] }];
        let area = |[p, q, r]: Triangle| (q - p).cross(r - p);
        let quality = |t| compactness(t, area(t).length());
        let least = (KEPT_COMPACTNESS * quality(old[0]).min(quality(old[1])))
            .min(self.shape.min_compactness);
        if new.iter().any(|f| quality(f.at) < least) {
            return false;
        }
        let middle = area(old[0]).normalize_or_zero() + area(old[1]).normalize_or_zero();
        let upright = |f: &Face| {
            let normal = area(f.at);
            normal.dot(middle) >= self.shape.min_turn * normal.length() * middle.length()
        };
        if !new.iter().all(upright) {
            return false;
        }
        let key = Key::new(Question::Flip, self.salt(), &old.map(|t| StarFace::new(t, None)));
        if self.memo.get(key).is_some() {
            return false;
        }
        if !new.iter().all(|f| self.is_within_limit(&f.at)) {
            self.memo.put(key, None);
            return false;
        }
        self.is_blocked_by_hull = false;
        // A flip adds or cuts off one tetrahedron: an old face and the third corner of the other.
        if !self.admits(&new, &wings.triangles, &old[..1], pd) {
            if !self.is_blocked_by_hull {
                self.memo.put(key, None);
            }
            return false;
        }
        self.shell.flip(a, b)
    }
}
