//! Moves of one vertex.

use super::ahead::Waiting;
use super::editor::HullEditor;
use super::memo::{Key, Question};
use super::placement::PlacementObjective;
use super::star::{added_volume, radius};
use super::tolerance::{CLEARANCES, GAIN};
use glam::DVec3;

/// Vertices whose settling is looked ahead to.
const AHEAD: usize = 24;

/// A plain vertex move.
fn settling(radius: f64) -> PlacementObjective {
    PlacementObjective {
        upright: Some(0.1),
        least_gain: GAIN * radius * radius * radius,
        ..PlacementObjective::PLAIN
    }
}

impl HullEditor<'_> {
    /// Moves a vertex to the place of least volume; the volume gained.
    pub(super) fn settle(&mut self, v: u32) -> Option<f64> {
        self.settle_at(v, None)
    }

    /// As [`settle`](Self::settle). `placed` is what [`place`](Self::place) gives the star, if that
    /// is known.
    fn settle_at(&mut self, v: u32, placed: Option<Option<DVec3>>) -> Option<f64> {
        let from = self.shell.position(v);
        self.take_star(v);
        let key = Key::new(Question::Settle, self.salt(), &self.star);
        if self.memo.get(key).is_some() {
            return None;
        }
        self.is_blocked_by_hull = false;
        let objective = settling(radius(&self.star, from));
        let gained = self.propose(v, from, &objective, placed);
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
        self.propose(v, centre, objective, None)
    }

    fn take_star(&mut self, v: u32) {
        let mut star = std::mem::take(&mut self.star);
        self.shell.vertex_star(v, &mut star);
        self.star = star;
    }

    /// Places vertex `v` of the star at hand and moves it, if the gain is enough and the move is
    /// proved. `placed` is the place with the least clearance, if that is known.
    fn propose(
        &mut self,
        v: u32,
        centre: DVec3,
        objective: &PlacementObjective,
        mut placed: Option<Option<DVec3>>,
    ) -> Option<f64> {
        let star = std::mem::take(&mut self.star);
        let mut outcome = None;
        for steps in CLEARANCES {
            let x = match placed.take() {
                Some(x) => x,
                None => self.place(&star, centre, steps, objective),
            };
            let Some(x) = x else { break };
            let gain = -added_volume(&star, x);
            if gain <= objective.least_gain || !self.is_star_within_limit(&star, x) {
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
        let all: Vec<u32> =
            (0..self.shell.vertex_slots()).filter(|&v| !self.shell.mesh.at(v).is_empty()).collect();
        for ahead in all.chunks(AHEAD) {
            if self.is_late() {
                break;
            }
            let mut placed = self.place_ahead(ahead).into_iter().peekable();
            for &v in ahead {
                let place = placed.next_if(|&(next, _)| next == v).map(|(_, place)| place);
                self.settle_at(v, place);
            }
        }
    }

    /// Places side by side those vertices that no other before them can change the star of.
    fn place_ahead(&mut self, vertices: &[u32]) -> Vec<(u32, Option<DVec3>)> {
        let mut waiting = Vec::new();
        let mut free = Vec::new();
        for (i, &v) in vertices.iter().enumerate() {
            if self.shell.mesh.neighbours(v).any(|u| vertices[..i].contains(&u)) {
                continue;
            }
            self.take_star(v);
            let key = Key::new(Question::Settle, self.salt(), &self.star);
            if self.memo.get(key).is_none() {
                let centre = self.shell.position(v);
                let objective = settling(radius(&self.star, centre));
                waiting.push(Waiting { key, star: self.star.clone(), centre, objective });
                free.push(v);
            }
        }
        free.into_iter().zip(self.place_all(&waiting)).collect()
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
