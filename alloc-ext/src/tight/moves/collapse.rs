//! Edge collapses, cheapest first. Each new vertex is placed against the original mesh.

use super::ahead::Waiting;
use super::editor::HullEditor;
use super::memo::{Key, Question};
use super::placement::PlacementObjective;
use super::star::StarFace;
use super::tolerance::CLEARANCES;
use crate::collapse::{self, Candidate, Collapsing, Connectivity, Schedule};
use glam::DVec3;
use std::cmp::Ordering;

/// A collapse or a split of an edge that may be tried.
#[derive(Clone, Copy, Debug)]
pub(super) struct EdgeEdit {
    /// Volume that it adds.
    pub cost: f64,
    pub ends: [u32; 2],
    /// The place of the new vertex.
    pub position: DVec3,
}

impl EdgeEdit {
    /// Cheapest first. The ends decide between equals, so that the order is unique.
    pub fn by_cost(&self, other: &Self) -> Ordering {
        self.cost.total_cmp(&other.cost).then(self.ends.cmp(&other.ends))
    }
}

/// Weight of the second term of a collapse's program.
const CENTRE_WEIGHT: f64 = PlacementObjective::PLAIN.centre_weight;

/// Weights that are tried where the new faces are too far from the mesh: volume counts less, and
/// the middle of the star more.
const STRONGER_CENTRE_WEIGHTS: [f64; 2] = [1.0, 100.0];

/// The hull's edges as the greedy loop sees them.
struct Edges<'e, 'm> {
    editor: &'e mut HullEditor<'m>,
    /// Time when the schedule was last filled with all edges.
    refilled: u32,
}

impl Collapsing for Edges<'_, '_> {
    /// The place of the new vertex.
    type Note = DVec3;

    fn mesh(&self) -> &Connectivity {
        &self.editor.shell.mesh
    }

    fn is_valid(&self, candidate: &Candidate<DVec3>) -> bool {
        let [a, b] = candidate.ends;
        self.mesh().neighbours(a).any(|v| v == b)
    }

    fn evaluate(&mut self, ends: [u32; 2], schedule: &mut Schedule<DVec3>) {
        if let Some(edit) = self.editor.evaluate_collapse(ends) {
            schedule.push(edit.cost, ends, edit.position);
        }
    }

    fn collapse(&mut self, candidate: &Candidate<DVec3>, _: &mut Schedule<DVec3>) -> bool {
        self.editor.collapse(candidate.ends, candidate.note)
    }

    /// Edges that were refused may be legal after other collapses.
    fn refill(&mut self, schedule: &mut Schedule<DVec3>) -> bool {
        if schedule.now() == self.refilled {
            return false;
        }
        self.refilled = schedule.now();
        let edges = self.mesh().edges();
        self.evaluate_all(&edges, schedule);
        true
    }

    fn reconsider(&mut self, vertex: u32, ring: &[u32], schedule: &mut Schedule<DVec3>) {
        let edges: Vec<_> = ring.iter().map(|&v| [vertex.min(v), vertex.max(v)]).collect();
        self.evaluate_all(&edges, schedule);
    }

    fn is_late(&self) -> bool {
        self.editor.is_late()
    }
}

impl Edges<'_, '_> {
    fn evaluate_all(&mut self, edges: &[[u32; 2]], schedule: &mut Schedule<DVec3>) {
        for edit in self.editor.evaluate_collapses(edges) {
            schedule.push(edit.cost, edit.ends, edit.position);
        }
    }
}

impl HullEditor<'_> {
    /// Collapses edges until at most `target` faces are left; false if no collapse is legal any
    /// more or the time is up before.
    pub fn decimate(&mut self, target: usize, mut on_progress: impl FnMut(usize)) -> bool {
        let mut schedule = Schedule::new(self.shell.vertex_slots() as usize);
        let mut edges = Edges { editor: self, refilled: 0 };
        collapse::run(&mut edges, &mut schedule, target, |edges| {
            on_progress(edges.editor.shell.face_count());
            true
        })
    }

    /// A collapse of an edge and its cost; `None` if it is not legal.
    pub(super) fn evaluate_collapse(&mut self, ends: [u32; 2]) -> Option<EdgeEdit> {
        let star = self.edge_star(ends)?;
        let answer = self.remembered(Question::Collapse, &star, |editor| {
            editor.place_collapse(&star, ends, CLEARANCES[0], CENTRE_WEIGHT)
        });
        self.star = star;
        answer.map(|(position, cost)| EdgeEdit { cost, ends, position })
    }

    /// The collapses of edges that are legal, in the order of the edges.
    pub(super) fn evaluate_collapses(&mut self, edges: &[[u32; 2]]) -> Vec<EdgeEdit> {
        let mut waiting = Vec::new();
        for &ends in edges {
            let Some(star) = self.edge_star(ends) else { continue };
            let key = Key::new(Question::Collapse, self.salt(), &star);
            if self.memo.get(key).is_none() {
                let (centre, objective) = self.collapse_objective(ends, CENTRE_WEIGHT);
                waiting.push(Waiting { key, star: star.clone(), centre, objective });
            }
            self.star = star;
        }
        self.remember_all(&waiting);
        edges.iter().filter_map(|&ends| self.evaluate_collapse(ends)).collect()
    }

    /// The star of an edge, with its faces in `dead`; `None` if the edge may not collapse.
    fn edge_star(&mut self, [a, b]: [u32; 2]) -> Option<Vec<StarFace>> {
        let Self { shell, dead, star, shape, .. } = self;
        star.clear();
        if !shell.mesh.collapsible_star(a, b, shape.max_valence, dead) {
            return None;
        }
        star.extend(dead.iter().map(|&f| shell.star_face(f, [a, b])));
        Some(std::mem::take(star))
    }

    /// Where a collapse is placed about, and what for.
    fn collapse_objective(
        &self,
        [a, b]: [u32; 2],
        centre_weight: f64,
    ) -> (DVec3, PlacementObjective) {
        let centre = (self.shell.position(a) + self.shell.position(b)) * 0.5;
        // A collapse may turn faces more than a vertex move.
        let upright = self.shape.upright;
        (centre, PlacementObjective { centre_weight, upright, ..PlacementObjective::PLAIN })
    }

    fn place_collapse(
        &mut self,
        star: &[StarFace],
        ends: [u32; 2],
        steps: f64,
        centre_weight: f64,
    ) -> Option<DVec3> {
        let (centre, objective) = self.collapse_objective(ends, centre_weight);
        self.place(star, centre, steps, &objective)
    }

    /// A place for a collapse whose new faces are near enough to the mesh: `x`, or nearer to the
    /// middle of the star.
    fn place_within_limit(
        &mut self,
        star: &[StarFace],
        ends: [u32; 2],
        steps: f64,
        x: DVec3,
    ) -> Option<DVec3> {
        if self.is_star_within_limit(star, x) {
            return Some(x);
        }
        for centre_weight in STRONGER_CENTRE_WEIGHTS {
            let nearer = self.place_collapse(star, ends, steps, centre_weight);
            if let Some(nearer) = nearer.filter(|&x| self.is_star_within_limit(star, x)) {
                return Some(nearer);
            }
        }
        // The star is too far whenever it is asked for again with the least clearance.
        if steps == CLEARANCES[0] {
            self.memo.put(Key::new(Question::Collapse, self.salt(), star), None);
        }
        None
    }

    /// Collapses an edge into its first end at `position`, or at the place for a greater clearance;
    /// false if neither is proved.
    pub(super) fn collapse(&mut self, ends: [u32; 2], position: DVec3) -> bool {
        let Some(star) = self.edge_star(ends) else { return false };
        let dead = self.dead.clone();
        let bases: Vec<_> = star.iter().map(|f| f.corners).collect();
        let mut proved = None;
        for steps in CLEARANCES {
            let placed = if steps == CLEARANCES[0] {
                Some(position)
            } else {
                self.place_collapse(&star, ends, steps, CENTRE_WEIGHT)
            };
            let Some(x) = placed.and_then(|x| self.place_within_limit(&star, ends, steps, x))
            else {
                break;
            };
            let new: Vec<_> =
                dead.iter().filter_map(|&f| self.shell.face_after(f, ends, x)).collect();
            if self.admits(&new, &dead, &bases, x) {
                proved = Some(x);
                break;
            }
        }
        self.star = star;
        if let Some(x) = proved {
            let [a, b] = ends;
            self.shell.collapse(a, b, x);
        }
        proved.is_some()
    }
}
