//! Edge collapses, cheapest first, each placed against the original mesh.

use super::memo::{Key, Question};
use super::placement::{StarFace, Wish};
use super::vertex::CLEARANCES;
use super::work::Work;
use glam::DVec3;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// A collapse that is worth trying.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    pub cost: f64,
    pub ends: [u32; 2],
    pub time: u32,
    pub position: DVec3,
}

impl Ord for Candidate {
    /// The cheapest is the greatest; the ends decide between equals, so that the order is one.
    fn cmp(&self, other: &Self) -> Ordering {
        other
            .cost
            .total_cmp(&self.cost)
            .then_with(|| other.ends.cmp(&self.ends))
            .then(self.time.cmp(&other.time))
    }
}
impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}
impl Eq for Candidate {}

/// A collapse may turn faces more than a vertex move.
const COLLAPSE: Wish = Wish { second_term: 0.05, tilt: DVec3::ZERO, upright: Some(0.05), clearance: 0.0 };

impl Work<'_> {
    /// Collapses until at most `target` faces are left, or no collapse is legal or the time is up: then false.
    pub fn decimate(&mut self, target: usize, mut on_progress: impl FnMut(usize)) -> bool {
        let mut queue = BinaryHeap::new();
        let mut changed = vec![0u32; self.shell.vertex_slots() as usize];
        let mut now = 0;
        let mut refill = true;
        while self.shell.face_count() > target {
            if self.is_late() {
                return false;
            }
            let Some(candidate) = queue.pop() else {
                // Edges that were refused may be legal now that others are gone.
                if !refill {
                    return false;
                }
                refill = false;
                now += 1;
                for [a, b] in self.shell.edges() {
                    queue.extend(self.evaluate(a, b, now));
                }
                continue;
            };
            let Candidate { ends: [a, b], time, position, .. } = candidate;
            if !self.shell.mesh.neighbours(a).any(|v| v == b) {
                continue;
            }
            if time < changed[a as usize].max(changed[b as usize]) {
                queue.extend(self.evaluate(a, b, now));
                continue;
            }
            if !self.collapse(a, b, position) {
                continue;
            }
            refill = true;
            now += 1;
            let ring: Vec<u32> = self.shell.mesh.neighbours(a).collect();
            changed[a as usize] = now;
            ring.iter().for_each(|&v| changed[v as usize] = now);
            for &v in &ring {
                queue.extend(self.evaluate(a.min(v), a.max(v), now));
            }
            on_progress(self.shell.face_count());
        }
        true
    }

    /// What an edge's collapse would cost; `None` if it is not legal.
    pub(super) fn evaluate(&mut self, a: u32, b: u32, time: u32) -> Option<Candidate> {
        let star = self.edge_star(a, b)?;
        let key = Key::new(Question::Collapse, self.shape.max_valence, &star);
        let answer = match self.memo.get(key) {
            Some(answer) => answer,
            None => {
                let placed = self.place_collapse(&star, a, b, CLEARANCES[0]);
                let answer = placed.map(|x| (x, star.iter().map(|f| f.added(x)).sum::<f64>() / 6.0));
                self.memo.put(key, answer);
                answer
            }
        };
        self.star = star;
        answer.map(|(position, cost)| Candidate { cost, ends: [a, b], time, position })
    }

    fn edge_star(&mut self, a: u32, b: u32) -> Option<Vec<StarFace>> {
        let mut dead = std::mem::take(&mut self.dead);
        let legal = self.shell.mesh.collapsible_star(a, b, self.shape.max_valence, &mut dead);
        let mut star = std::mem::take(&mut self.star);
        star.clear();
        if legal {
            star.extend(dead.iter().map(|&f| self.shell.star_face(f, [a, b])));
        }
        self.dead = dead;
        if legal {
            Some(star)
        } else {
            self.star = star;
            None
        }
    }

    fn place_collapse(&mut self, star: &[StarFace], a: u32, b: u32, steps: f64) -> Option<DVec3> {
        let centre = (self.shell.position(a) + self.shell.position(b)) * 0.5;
        let wish = Wish { clearance: self.clearance(star, steps), upright: self.shape.upright, ..COLLAPSE };
        let x = self.placer.place(self.obstacle, star, centre, &wish)?;
        let x = self.rounding.round(x)?;
        self.is_shapely(star, x).then_some(x)
    }

    /// Collapses the edge at `position`, or where a greater clearance puts it; false if neither can be proved.
    pub(super) fn collapse(&mut self, a: u32, b: u32, position: DVec3) -> bool {
        let Some(star) = self.edge_star(a, b) else { return false };
        let dead = self.dead.clone();
        let bases: Vec<_> = star.iter().map(|f| f.corners).collect();
        let mut proved = None;
        for steps in CLEARANCES {
            let placed =
                if steps == CLEARANCES[0] { Some(position) } else { self.place_collapse(&star, a, b, steps) };
            let Some(x) = placed else { break };
            let new: Vec<_> = dead.iter().filter_map(|&f| self.shell.face_after(f, [a, b], x)).collect();
            if self.admits(&new, &dead, &bases, x) {
                proved = Some(x);
                break;
            }
        }
        self.star = star;
        if let Some(x) = proved {
            self.shell.collapse(a, b, x);
        }
        proved.is_some()
    }
}
