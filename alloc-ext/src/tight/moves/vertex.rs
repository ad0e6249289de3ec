//! Moves of one vertex.

use super::editor::HullEditor;
use super::memo::{Key, Question};
use super::placement::PlacementObjective;
use super::star::{added_volume, radius};
use super::tolerance::{CLEARANCES, GAIN};
use glam::DVec3;

/// A plain vertex move: the second term is strong enough to slide along planes, and weak enough to
/// stay near the star.
const SETTLE: PlacementObjective =
    PlacementObjective { centre_weight: 0.05, tilt: DVec3::ZERO, upright: Some(0.1) };

impl HullEditor<'_> {
    /// Moves a vertex to the place of least volume; the volume gained.
    pub(super) fn settle(&mut self, v: u32) -> Option<f64> {
        let from = self.shell.position(v);
        self.take_star(v);
        let key = Key::new(Question::Settle, self.salt(), &self.star);
        if self.memo.get(key).is_some() {
            return None;
        }
        let radius = radius(&self.star, from);
        self.is_blocked_by_hull = false;
        let gained = self.propose(v, from, &SETTLE, |gain| gain > GAIN * radius * radius * radius);
        if gained.is_none() && !self.is_blocked_by_hull {
            self.memo.put(key, None);
        }
        gained
    }

    /// Moves a vertex to the best place for an objective about `centre`, even if the volume grows;
    /// the volume gained, which may be negative.
    pub(super) fn move_vertex(
        &mut self,
        v: u32,
        centre: DVec3,
        objective: &PlacementObjective,
    ) -> Option<f64> {
        self.take_star(v);
        self.propose(v, centre, objective, |_| true)
    }

    fn take_star(&mut self, v: u32) {
        let mut star = std::mem::take(&mut self.star);
        self.shell.vertex_star(v, &mut star);
        self.star = star;
    }

    /// Places vertex `v` of the star at hand and moves it, if the gain `is_enough` and the move is
    /// proved.
    fn propose(
        &mut self,
        v: u32,
        centre: DVec3,
        objective: &PlacementObjective,
        is_enough: impl Fn(f64) -> bool,
    ) -> Option<f64> {
        let star = std::mem::take(&mut self.star);
        let mut outcome = None;
        for steps in CLEARANCES {
            let Some(x) = self.place(&star, centre, steps, objective) else { break };
            let gain = -added_volume(&star, x);
            if !is_enough(gain) || !self.is_star_within_limit(&star, x) {
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
    fn admits_vertex(&mut self, v: u32, x: DVec3) -> bool {
        let dead: Vec<u32> = self.shell.mesh.at(v).to_vec();
        let new: Vec<_> =
            dead.iter().filter_map(|&f| self.shell.face_after(f, [v, v], x)).collect();
        let bases: Vec<_> = dead.iter().map(|&f| self.shell.triangle(f)).collect();
        self.admits(&new, &dead, &bases, x)
    }

    /// Settles every vertex once.
    pub fn settle_all(&mut self) {
        for v in 0..self.shell.vertex_slots() {
            if self.is_late() {
                break;
            }
            if !self.shell.mesh.at(v).is_empty() {
                self.settle(v);
            }
        }
    }

    /// Settles and flips until a round gains at most the fraction `least` of the volume beyond
    /// `floor`, or the rounds are used up.
    pub fn relax(&mut self, floor: f64, least: f64, rounds: usize) {
        for _ in 0..rounds {
            let before = self.shell.volume();
            self.settle_all();
            self.flip_all();
            let after = self.shell.volume();
            if before - after <= least * (after - floor).abs() || self.is_spent() {
                break;
            }
        }
    }
}
