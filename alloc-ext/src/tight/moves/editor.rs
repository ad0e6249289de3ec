//! A hull, the mesh that it must not meet, and what a local move has to satisfy.
//!
//! The invariant, from the first hull to the last: the hull is a closed surface whose faces have no
//! point in common but the edges and corners that they share; it has no point in common with the
//! mesh; and every connected part of the mesh is inside.
//!
//! A move replaces some faces by others with the same boundary. The first two are tested as they
//! stand. The third follows: a part that does not meet the new hull is inside it or outside as a
//! whole, so that its witness decides. The number of times that the surface winds around the
//! witness changes only if it lies in one of the tetrahedra between old faces and the new vertex,
//! and falls only for one that is cut off. Where it rises, the new hull encloses a part of itself,
//! which is [dropped](Work::drop_enclosed) at the end of each stage.

use crate::tight::initial::levels::keep_outermost;
use crate::tight::moves::memo::{GOLDEN, Memo};
use crate::tight::moves::placement::{Placer, StarFace};
use crate::tight::moves::rounding::Rounding;
use crate::tight::moves::shell::Shell;
use crate::tight::proof::boxes::Bounds;
use crate::tight::proof::distance_field::DistanceField;
use crate::tight::proof::obstacle::Obstacle;
use crate::tight::proof::predicates::{Face, Triangle, are_apart, is_degenerate};
use glam::DVec3;
use std::time::Instant;

/// Shape conditions of moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shape {
    /// Compactness that a new face has at least, unless the worst of those before was little
    /// better.
    pub min_compactness: f64,
    /// Cosine of the largest turn of a face.
    pub min_turn: f64,
    /// Least part of a face's area that a collapse keeps when it is seen along the old normal;
    /// `None`: any.
    pub upright: Option<f64>,
    /// Largest valence.
    pub max_valence: usize,
}

/// Part of the worst compactness before a move that is kept where it was below
/// [`Shape::min_compactness`].
const KEPT_COMPACTNESS: f64 = 0.8;

/// See the module.
#[derive(Clone, Debug)]
pub(crate) struct HullEditor<'a> {
    pub obstacle: &'a Obstacle,
    pub shell: Shell,
    pub placer: Placer,
    pub rounding: Rounding,
    pub shape: Shape,
    /// Moves that had to be proved, and those that could not.
    pub proofs: u64,
    pub refused: u64,
    /// Whether a move was refused because of the hull, which changes, since this was last set to
    /// false.
    pub is_in_its_own_way: bool,
    /// Stars after which no new move of a polish begins.
    pub limit: Option<u64>,
    /// When to stop, if at all.
    pub deadline: Option<Instant>,
    pub star: Vec<StarFace>,
    pub dead: Vec<u32>,
    pub memo: Memo,
    /// Parts that [`drop_enclosed`](Self::drop_enclosed) dropped.
    pub enclosed: usize,
    /// Distance from the mesh that no point of a new face exceeds.
    pub reach: f64,
    /// What is known of distances.
    pub field: DistanceField,
    /// Where vertices may go.
    room: Bounds,
}

/// The mesh's box, and around it the margin and the longest side.
fn room(obstacle: &Obstacle) -> Bounds {
    let bounds = obstacle.bounds();
    bounds.grown((bounds.high - bounds.low).max_element() + 2.0 * obstacle.margin())
}

impl<'a> HullEditor<'a> {
    pub fn new(obstacle: &'a Obstacle, shell: Shell, rounding: Rounding, shape: Shape) -> Self {
        Self {
            obstacle,
            shell,
            placer: Placer::default(),
            rounding,
            shape,
            proofs: 0,
            refused: 0,
            is_in_its_own_way: false,
            limit: None,
            deadline: None,
            star: Vec::new(),
            dead: Vec::new(),
            memo: Memo::default(),
            enclosed: 0,
            reach: f64::INFINITY,
            field: DistanceField::new(f64::INFINITY),
            room: room(obstacle),
        }
    }

    /// Drops parts of the hull that have come to lie inside of another. No move lets the mesh out,
    /// but an outward one may sweep over all of a smaller part of the hull; its faces would
    /// then be taken for an outside that they are not.
    pub fn drop_enclosed(&mut self) {
        let (shell, enclosed) = keep_outermost(self.shell.clone());
        if enclosed > 0 {
            (self.shell, self.enclosed) = (shell, self.enclosed + enclosed);
        }
    }

    /// Whether the time is up.
    pub fn is_late(&self) -> bool {
        self.deadline.is_some_and(|deadline| Instant::now() >= deadline)
    }

    /// Whether stars or time are used up.
    pub fn is_spent(&self) -> bool {
        self.limit.is_some_and(|limit| self.placer.stars >= limit) || self.is_late()
    }

    /// Counts another's work since the two parted as its own.
    pub fn take_counts(&mut self, other: &Self) {
        self.placer.stars = other.placer.stars;
        self.placer.programs = other.placer.programs;
        self.proofs = other.proofs;
        self.refused = other.refused;
    }

    /// Adds the work of another to its own.
    pub fn add_counts(&mut self, other: &Self) {
        self.placer.stars += other.placer.stars;
        self.placer.programs += other.placer.programs;
        self.proofs += other.proofs;
        self.refused += other.refused;
    }

    /// Whether `new` may take the place of the faces `dead`, the moving corner of `bases` going to
    /// `apex`. Exact.
    pub fn admits(&mut self, new: &[Face], dead: &[u32], bases: &[Triangle], apex: DVec3) -> bool {
        self.proofs += 1;
        let embedded = self.keeps_embedded(new, dead);
        self.is_in_its_own_way |= !embedded;
        let admitted = embedded
            && !new.iter().any(|face| self.obstacle.meets(&face.at))
            && !self.obstacle.has_witness_in(bases, apex);
        self.refused += u64::from(!admitted);
        admitted
    }

    fn keeps_embedded(&self, new: &[Face], dead: &[u32]) -> bool {
        if new.iter().any(|face| is_degenerate(&face.at)) {
            return false;
        }
        let among = |i: usize| new[..i].iter().all(|other| are_apart(&new[i], other));
        if !(1..new.len()).all(among) {
            return false;
        }
        let boxes: Vec<Bounds> = new.iter().map(|face| Bounds::of(&face.at)).collect();
        let all = boxes.iter().fold(Bounds::EMPTY, |all, &b| all.join(b));
        self.shell.near(&all, |f| {
            if dead.contains(&f) {
                return true;
            }
            let old = self.shell.face(f);
            let bounds = Bounds::of(&old.at);
            new.iter().zip(&boxes).all(|(face, b)| !b.meets(&bounds) || are_apart(face, &old))
        })
    }

    /// Whether a star may have its vertex at `x` by shape, and by its distance from the mesh: thin
    /// spikes cost next to no volume.
    pub fn is_shapely(&self, star: &[StarFace], x: DVec3) -> bool {
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

    /// What answers about a star depend on beside it.
    pub fn salt(&self) -> u64 {
        (self.shape.max_valence as u64).wrapping_mul(GOLDEN) ^ self.reach.to_bits()
    }

    /// Distance to keep from planes so that rounding does not cross them: `steps` half-steps at the
    /// star.
    pub fn clearance(&self, star: &[StarFace], steps: f64) -> f64 {
        let size =
            star.iter().flat_map(|f| f.corners).map(|p| p.abs().max_element()).fold(0.0, f64::max);
        self.rounding.half_step(size) * steps
    }
}

/// 2·√3, which makes the equilateral triangle's compactness 1.
const TWICE_SQRT_3: f64 = 3.464_101_615_137_754_6;

/// 1 for the equilateral triangle, towards 0 for needles.
pub(crate) fn compactness([a, b, c]: Triangle, double_area: f64) -> f64 {
    let edges = (b - a).length_squared() + (c - b).length_squared() + (a - c).length_squared();
    if edges > 0.0 { TWICE_SQRT_3 * double_area / edges } else { 0.0 }
}
