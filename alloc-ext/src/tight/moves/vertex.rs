//! Vertex moves.

use crate::tight::moves::editor::HullEditor;
use crate::tight::moves::memo::{Key, Question};
use crate::tight::moves::placement::PlacementObjective;
use glam::DVec3;

/// Half-steps of the grid kept from planes, by attempt: rounding moves a vertex by less than two,
/// and what the first do not prove the last may.
pub(crate) const CLEARANCES: [f64; 2] = [4.0, 16.0];

/// Volumes that differ by less than this part of the star's radius cubed are equal: moves must come
/// to an end, and each makes the stars around ask anew. With a thousandth of it half the answers
/// are asked for again.
pub(crate) const GAIN: f64 = 1e-6;

/// A plain vertex move: a pull strong enough to slide along planes, weak enough to stay near the
/// star.
pub(crate) const SETTLE: PlacementObjective =
    PlacementObjective { second_term: 0.05, tilt: DVec3::ZERO, upright: Some(0.1), clearance: 0.0 };

impl HullEditor<'_> {
    /// Moves a vertex to where the volume is least; what is gained.
    pub fn settle(&mut self, v: u32) -> Option<f64> {
        let from = self.shell.position(v);
        self.take_star(v);
        let key = Key::new(Question::Settle, self.salt(), &self.star);
        if self.memo.get(key).is_some() {
            return None;
        }
        let radius = self.star_radius(from);
        self.is_in_its_own_way = false;
        let gained = self.propose(v, from, &SETTLE, |gain| gain > GAIN * radius * radius * radius);
        if gained.is_none() && !self.is_in_its_own_way {
            self.memo.put(key, None);
        }
        gained
    }

    /// Moves a vertex where `wish` wants it, whether the volume falls or not; the volume gained,
    /// which may be negative.
    pub fn disturb(&mut self, v: u32, wish: &PlacementObjective) -> Option<f64> {
        self.take_star(v);
        self.propose(v, self.shell.position(v), wish, |_| true)
    }

    /// Moves a vertex as `wish` wants it, which is about `centre`; whether it did.
    pub fn move_to(&mut self, v: u32, centre: DVec3, wish: &PlacementObjective) -> bool {
        self.take_star(v);
        self.propose(v, centre, wish, |_| true).is_some()
    }

    fn take_star(&mut self, v: u32) {
        let mut star = std::mem::take(&mut self.star);
        self.shell.vertex_star(v, &mut star);
        self.star = star;
    }

    pub(crate) fn star_radius(&self, centre: DVec3) -> f64 {
        let corners = self.star.iter().flat_map(|f| f.corners);
        corners.map(|p| (p - centre).length_squared()).fold(0.0, f64::max).sqrt()
    }

    /// Places vertex `v` of the star at hand and proves it, if `wanted` likes what it gains.
    fn propose(
        &mut self,
        v: u32,
        centre: DVec3,
        wish: &PlacementObjective,
        wanted: impl Fn(f64) -> bool,
    ) -> Option<f64> {
        let star = std::mem::take(&mut self.star);
        let mut outcome = None;
        for steps in CLEARANCES {
            let clearance = self.clearance(&star, steps);
            let wish = PlacementObjective { clearance, ..*wish };
            let placed = self.placer.place(self.obstacle, &star, centre, &wish);
            let Some(x) = placed.and_then(|x| self.rounding.round(x)) else { break };
            let gain = -star.iter().map(|f| f.added(x)).sum::<f64>() / 6.0;
            if !wanted(gain) || !self.is_shapely(&star, x) || !self.is_star_within_limit(&star, x) {
                break;
            }
            if self.admits_vertex(v, x) {
                self.shell.move_vertex(v, x);
                outcome = Some(gain);
                break;
            }
        }
        self.star = star;
        outcome
    }

    /// Whether `v` may move to `x`. Exact.
    pub fn admits_vertex(&mut self, v: u32, x: DVec3) -> bool {
        let dead: Vec<u32> = self.shell.mesh.at(v).to_vec();
        let new: Vec<_> =
            dead.iter().filter_map(|&f| self.shell.face_after(f, [v, v], x)).collect();
        let bases: Vec<_> = dead.iter().map(|&f| self.shell.triangle(f)).collect();
        self.admits(&new, &dead, &bases, x)
    }

    /// Settles every vertex once; the volume gained.
    pub fn sweep(&mut self) -> f64 {
        let mut gained = 0.0;
        for v in 0..self.shell.vertex_slots() {
            if self.is_late() {
                break;
            }
            if !self.shell.mesh.at(v).is_empty() {
                gained += self.settle(v).unwrap_or(0.0);
            }
        }
        gained
    }
}
