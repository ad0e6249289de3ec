//! The hull under edit, and the conditions that every edit must satisfy.
//!
//! # Invariant
//! From the initial hull to the last edit:
//! 1. the hull is a closed surface whose faces share no points but common edges and corners;
//! 2. the hull has no point in common with the mesh;
//! 3. every connected component of the mesh is inside.
//!
//! An edit replaces some faces by others with the same boundary. The first two conditions are
//! tested on the new faces. The third follows: a component that does not meet the new hull is
//! inside or outside as a whole, so that one vertex of it, its witness, decides. The winding number
//! around the witness changes only if the witness lies in one of the tetrahedra between the old
//! faces and the new vertex, and it falls only in a tetrahedron that is cut off. Where it rises,
//! the new hull encloses a component of itself. Such components are
//! [dropped](HullEditor::drop_enclosed) at the end of each stage.

use super::memo::{GOLDEN, Key, Memo, Question};
use super::placement::{PlacementObjective, Placer};
use super::rounding::Rounding;
use super::shell::Shell;
use super::star::{StarFace, added_volume, corners};
use crate::geom::{Bounds, Face, Triangle, fits};
use crate::tight::deadline::Deadline;
use crate::tight::proof::{DistanceField, Obstacle};
use glam::DVec3;

/// Shape conditions of edits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shape {
    /// Least compactness of a new face, unless the worst old face was little better.
    pub min_compactness: f64,
    /// Cosine of the largest turn of a face.
    pub min_turn: f64,
    /// Least fraction of a face's area that a collapse keeps, seen along the old normal; `None`:
    /// any.
    pub upright: Option<f64>,
    /// Largest valence.
    pub max_valence: usize,
}

/// Part of the worst old compactness that new faces keep where it was below
/// [`Shape::min_compactness`].
const KEPT_COMPACTNESS: f64 = 0.8;

/// The hull under edit. The module states its invariant.
#[derive(Clone, Debug)]
pub(crate) struct HullEditor<'a> {
    pub obstacle: &'a Obstacle,
    pub shell: Shell,
    pub placer: Placer,
    pub rounding: Rounding,
    pub shape: Shape,
    /// Number of stars after which no new edit begins.
    pub star_limit: Option<u64>,
    pub deadline: Deadline<'a>,
    /// Components that [`drop_enclosed`](Self::drop_enclosed) has dropped.
    pub enclosed: usize,
    /// No point of a new face is farther than this from the mesh.
    pub max_distance: f64,
    pub(super) distance_field: DistanceField,
    /// Whether the hull itself refused an edit since this was last set to false. The refusal may
    /// not last, because the hull changes.
    pub(super) is_blocked_by_hull: bool,
    pub(super) memo: Memo,
    /// Buffer for the star of an edit, kept to save allocations.
    pub(super) star: Vec<StarFace>,
    /// Buffer for the faces that an edit removes.
    pub(super) dead: Vec<u32>,
    /// Where vertices may go.
    room: Bounds,
}

/// The mesh's bounding box, enlarged by its longest side and twice the margin.
fn room(obstacle: &Obstacle) -> Bounds {
    let bounds = obstacle.bounds();
    bounds.grown((bounds.high - bounds.low).max_element() + 2.0 * obstacle.margin())
}

impl<'a> HullEditor<'a> {
    /// Of a proved hull.
    pub fn new(obstacle: &'a Obstacle, shell: Shell, rounding: Rounding, shape: Shape) -> Self {
        Self {
            obstacle,
            shell,
            placer: Placer::default(),
            rounding,
            shape,
            star_limit: None,
            deadline: Deadline::default(),
            enclosed: 0,
            max_distance: f64::INFINITY,
            distance_field: DistanceField::new(f64::INFINITY),
            is_blocked_by_hull: false,
            memo: Memo::default(),
            star: Vec::new(),
            dead: Vec::new(),
            room: room(obstacle),
        }
    }

    /// Drops components of the hull that lie inside others.
    ///
    /// No edit lets the mesh out, but an outward edit may sweep over a whole smaller component of
    /// the hull. The faces of that component are no outside any more.
    pub fn drop_enclosed(&mut self) {
        if let Some((shell, dropped)) = self.shell.outermost()
            && dropped > 0
        {
            (self.shell, self.enclosed) = (shell, self.enclosed + dropped);
        }
    }

    /// Whether the deadline has passed.
    pub fn is_late(&self) -> bool {
        self.deadline.has_passed()
    }

    /// Whether stars or time are used up.
    pub fn is_spent(&self) -> bool {
        self.star_limit.is_some_and(|limit| self.placer.stars >= limit) || self.is_late()
    }

    /// Takes over the work counters of a clone.
    pub fn take_counts(&mut self, clone: &Self) {
        (self.placer.stars, self.placer.programs) = (clone.placer.stars, clone.placer.programs);
    }

    /// A clone that counts its own work.
    pub(super) fn worker(&self) -> Self {
        Self { placer: Placer::default(), ..self.clone() }
    }

    /// Adds the work counters of another hull.
    pub fn add_counts(&mut self, other: &Self) {
        self.placer.stars += other.placer.stars;
        self.placer.programs += other.placer.programs;
    }

    /// Whether `new` may replace the faces `dead`, where the moving corner of each of `bases` goes
    /// to `apex`. Exact.
    pub(super) fn admits(
        &mut self,
        new: &[Face],
        dead: &[u32],
        bases: &[Triangle],
        apex: DVec3,
    ) -> bool {
        let shell = &self.shell;
        let is_embedded = fits(new, |bounds, is_apart| {
            shell.near(bounds, |f| dead.contains(&f) || is_apart(&shell.face(f)))
        });
        self.is_blocked_by_hull |= !is_embedded;
        is_embedded
            && !new.iter().any(|face| self.obstacle.meets(&face.at))
            && !self.obstacle.has_witness_in(bases, apex)
    }

    /// Whether a star with its vertex at `x` has a sound shape and `x` is not too far from the
    /// mesh: thin spikes cost next to no volume.
    fn is_shapely(&self, star: &[StarFace], x: DVec3) -> bool {
        if self.room.with(x) != self.room {
            return false;
        }
        let worst = star.iter().map(|f| compactness(f.corners, f.double_area)).fold(1.0, f64::min);
        let least = self.shape.min_compactness.min(KEPT_COMPACTNESS * worst);
        star.iter().all(|face| {
            let Some([a, b]) = face.ring else { return true };
            let cross = (a - x).cross(b - x);
            let length = cross.length();
            length > 0.0
                && compactness([x, a, b], length) >= least
                && cross.dot(face.normal) >= self.shape.min_turn * length
        })
    }

    /// The place for the vertex of a star, rounded and shapely, which keeps `steps` half-steps of
    /// the grid from planes. Not proved.
    pub(super) fn place(
        &mut self,
        star: &[StarFace],
        centre: DVec3,
        steps: f64,
        objective: &PlacementObjective,
    ) -> Option<DVec3> {
        let mut placer = std::mem::take(&mut self.placer);
        let x = self.place_by(&mut placer, star, centre, steps, objective);
        self.placer = placer;
        x
    }

    /// As [`place`](Self::place), with a placer of the caller's.
    pub(super) fn place_by(
        &self,
        placer: &mut Placer,
        star: &[StarFace],
        centre: DVec3,
        steps: f64,
        objective: &PlacementObjective,
    ) -> Option<DVec3> {
        let size = corners(star).map(|p| p.abs().max_element()).fold(0.0, f64::max);
        let clearance = self.rounding.half_step(size) * steps;
        let x = placer.place(self.obstacle, star, centre, clearance, objective)?;
        let x = self.rounding.round(x)?;
        self.is_shapely(star, x).then_some(x)
    }

    /// The answer that a star got before, or the place that `place` gives it now and the volume
    /// that this adds.
    pub(super) fn remembered(
        &mut self,
        question: Question,
        star: &[StarFace],
        place: impl FnOnce(&mut Self) -> Option<DVec3>,
    ) -> Option<(DVec3, f64)> {
        let key = Key::new(question, self.salt(), star);
        if let Some(answer) = self.memo.get(key) {
            return answer;
        }
        let answer = place(self).map(|x| (x, added_volume(star, x)));
        self.memo.put(key, answer);
        answer
    }

    /// A hash of the state, besides the star, that an answer about a star depends on.
    pub(super) fn salt(&self) -> u64 {
        (self.shape.max_valence as u64).wrapping_mul(GOLDEN) ^ self.max_distance.to_bits()
    }
}

/// 2·√3, which makes the equilateral triangle's compactness 1.
const TWICE_SQRT_3: f64 = 3.464_101_615_137_754_6;

/// Compactness of a triangle: 1 if it is equilateral, near 0 for needles.
pub(super) fn compactness([a, b, c]: Triangle, double_area: f64) -> f64 {
    let edges = (b - a).length_squared() + (c - b).length_squared() + (a - c).length_squared();
    if edges > 0.0 { TWICE_SQRT_3 * double_area / edges } else { 0.0 }
}
