//! Edge flips.

use crate::tight::moves::editor::{HullEditor, compactness};
use crate::tight::moves::memo::{Key, Question};
use crate::tight::moves::placement::StarFace;
use crate::tight::proof::predicates::{Face, side};

/// New faces keep this part of the worse compactness of the two old ones, or the least that the
/// shape conditions ask for.
const KEPT: f64 = 0.7;

/// Part of the hull's volume that a change has to gain: more than the rounding of its sum.
pub(crate) const LEAST_GAIN: f64 = 1e-9;

impl HullEditor<'_> {
    /// Flips every convex edge whose flip cuts off a tetrahedron without mesh; how many.
    pub fn flip_all(&mut self) -> usize {
        self.shell.edges().into_iter().filter(|&[a, b]| self.flip_inward(a, b)).count()
    }

    /// Flips every edge, convex or not, whose four corners then settle with less volume than
    /// before; how many.
    pub fn flip_search(&mut self) -> usize {
        self.shell.edges().into_iter().filter(|&[a, b]| self.flip_and_settle(a, b)).count()
    }

    fn flip_and_settle(&mut self, a: u32, b: u32) -> bool {
        if self.is_spent() {
            return false;
        }
        let Some([c, d]) = self.shell.mesh.wings(a, b).map(|w| w.apexes) else { return false };
        let corners = [a, b, c, d];
        let before = self.shell.volume();
        let places = corners.map(|v| self.shell.position(v));
        if !self.flip(a, b) {
            return false;
        }
        for _ in 0..2 {
            for v in corners {
                self.settle(v);
            }
        }
        let better = self.shell.volume() < before * (1.0 - LEAST_GAIN);
        if !better {
            for (v, at) in corners.into_iter().zip(places) {
                self.shell.move_vertex(v, at);
            }
            // The edge that came of the flip; no other move has changed it.
            self.shell.flip(c, d);
        }
        better
    }

    /// Flips the edge if it is convex and may be.
    fn flip_inward(&mut self, a: u32, b: u32) -> bool {
        let Some((faces, apex)) = self.shell.mesh.wings(a, b).map(|w| (w.triangles, w.apexes[1]))
        else {
            return false;
        };
        let left = self.shell.triangle(faces[0]);
        side(&left, self.shell.position(apex)) < 0.0 && self.flip(a, b)
    }

    /// Flips the edge `a b` if shape and proof allow it, whether the hull grows or not.
    pub fn flip(&mut self, a: u32, b: u32) -> bool {
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
        let area = |[p, q, r]: [glam::DVec3; 3]| (q - p).cross(r - p);
        let quality = |t| compactness(t, area(t).length());
        let least = (KEPT * quality(old[0]).min(quality(old[1]))).min(self.shape.min_compactness);
        if new.iter().any(|f| quality(f.at) < least) {
            return false;
        }
        let middle = area(old[0]).normalize_or_zero() + area(old[1]).normalize_or_zero();
        let upright = |f: &Face| {
            let normal = area(f.at);
            normal.dot(middle) >= self.shape.min_turn * normal.length() * middle.length()
        };
        // The tetrahedron that the flip cuts off or adds is that of either old face and the other's
        // third corner.
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
        self.is_in_its_own_way = false;
        if !self.admits(&new, &wings.triangles, &old[..1], pd) {
            if !self.is_in_its_own_way {
                self.memo.put(key, None);
            }
            return false;
        }
        self.shell.flip(a, b)
    }
}
