//! Edge collapses, cheapest first, each placed against the original mesh.

use crate::tight::moves::editor::HullEditor;
use crate::tight::moves::memo::{Key, Question};
use crate::tight::moves::placement::{PlacementObjective, StarFace};
use crate::tight::moves::vertex::CLEARANCES;
use glam::DVec3;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// A collapse that is worth trying.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EdgeMove {
    pub cost: f64,
    pub ends: [u32; 2],
    pub time: u32,
    pub position: DVec3,
}

impl Ord for EdgeMove {
    /// The cheapest is the greatest; the ends decide between equals, so that the order is one.
    fn cmp(&self, other: &Self) -> Ordering {
        other
            .cost
            .total_cmp(&self.cost)
            .then_with(|| other.ends.cmp(&self.ends))
            .then(self.time.cmp(&other.time))
    }
}
impl PartialOrd for EdgeMove {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl PartialEq for EdgeMove {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}
impl Eq for EdgeMove {}

/// Weight of the second term of a collapse's program; a collapse may turn faces more than a vertex
/// move.
const PULL: f64 = 0.05;

/// Those that are tried where the vertex would be out of reach: less volume counts less, and
/// staying in the middle of the star more.
const STRONGER_PULLS: [f64; 2] = [1.0, 100.0];

impl HullEditor<'_> {
    /// Collapses until at most `target` faces are left, or no collapse is legal or the time is up:
    /// then false.
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
            let EdgeMove { ends: [a, b], time, position, .. } = candidate;
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
    pub(crate) fn evaluate(&mut self, a: u32, b: u32, time: u32) -> Option<EdgeMove> {
        let star = self.edge_star(a, b)?;
        let key = Key::new(Question::Collapse, self.salt(), &star);
        let answer = match self.memo.get(key) {
            Some(answer) => answer,
            None => {
                let placed = self.place_collapse(&star, [a, b], CLEARANCES[0], PULL);
                let answer =
                    placed.map(|x| (x, star.iter().map(|f| f.added(x)).sum::<f64>() / 6.0));
                self.memo.put(key, answer);
                answer
            }
        };
        self.star = star;
        answer.map(|(position, cost)| EdgeMove { cost, ends: [a, b], time, position })
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

    fn place_collapse(
        &mut self,
        star: &[StarFace],
        [a, b]: [u32; 2],
        steps: f64,
        second_term: f64,
    ) -> Option<DVec3> {
        let centre = (self.shell.position(a) + self.shell.position(b)) * 0.5;
        let (clearance, upright) = (self.clearance(star, steps), self.shape.upright);
        let wish = PlacementObjective { second_term, tilt: DVec3::ZERO, upright, clearance };
        let x = self.placer.place(self.obstacle, star, centre, &wish)?;
        let x = self.rounding.round(x)?;
        self.is_shapely(star, x).then_some(x)
    }

    /// A place for a collapse of which the new faces are in reach: `x`, or nearer to the middle.
    fn in_reach(
        &mut self,
        star: &[StarFace],
        ends: [u32; 2],
        steps: f64,
        x: DVec3,
    ) -> Option<DVec3> {
        if self.is_star_within_limit(star, x) {
            return Some(x);
        }
        for pull in STRONGER_PULLS {
            let nearer = self.place_collapse(star, ends, steps, pull);
            if let Some(nearer) = nearer.filter(|&x| self.is_star_within_limit(star, x)) {
                return Some(nearer);
            }
        }
        // Far away now is far away whenever it is asked again, which begins with the least
        // clearance.
        if steps == CLEARANCES[0] {
            self.memo.put(Key::new(Question::Collapse, self.salt(), star), None);
        }
        None
    }

    /// Collapses the edge at `position`, or where a greater clearance puts it; false if neither can
    /// be proved.
    pub(crate) fn collapse(&mut self, a: u32, b: u32, position: DVec3) -> bool {
        let Some(star) = self.edge_star(a, b) else { return false };
        let dead = self.dead.clone();
        let bases: Vec<_> = star.iter().map(|f| f.corners).collect();
        let mut proved = None;
        for steps in CLEARANCES {
            let placed = if steps == CLEARANCES[0] {
                Some(position)
            } else {
                self.place_collapse(&star, [a, b], steps, PULL)
            };
            let Some(x) = placed.and_then(|x| self.in_reach(&star, [a, b], steps, x)) else {
                break;
            };
            let new: Vec<_> =
                dead.iter().filter_map(|&f| self.shell.face_after(f, [a, b], x)).collect();
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
