//! Bounds as a program would have them, in f32: moved with each pose, then tested against the
//! resting one.
//!
//! What is timed is here, what is true is not: verdicts of these are compared with those in f64.

pub mod rigid;
pub mod slabs;

use super::pose::Motion;

/// One bound and its moved copies.
pub trait Rig {
    /// Bounds it anew at each pose, in place of those of before.
    fn update(&mut self, motions: &[Motion]);

    /// Whether each of the moved ones meets the resting one, in place of what `verdicts` held.
    fn test(&self, verdicts: &mut Vec<bool>);
}

/// A rig of a bound, of how it moves and of when two of it meet.
pub struct Moving<B, Update, Meets> {
    rest: B,
    moved: Vec<B>,
    update: Update,
    meets: Meets,
}

impl<B, Update: Fn(&Motion) -> B, Meets: Fn(&B, &B) -> bool> Moving<B, Update, Meets> {
    /// Nothing moved yet.
    pub fn new(rest: B, update: Update, meets: Meets) -> Self {
        Self { rest, moved: Vec::new(), update, meets }
    }
}

impl<B, Update: Fn(&Motion) -> B, Meets: Fn(&B, &B) -> bool> Rig for Moving<B, Update, Meets> {
    fn update(&mut self, motions: &[Motion]) {
        self.moved.clear();
        self.moved.extend(motions.iter().map(&self.update));
    }

    fn test(&self, verdicts: &mut Vec<bool>) {
        verdicts.clear();
        verdicts.extend(self.moved.iter().map(|moved| (self.meets)(&self.rest, moved)));
    }
}

/// A point rounded to f32; vertices of the mesh are such already.
pub(super) fn single(point: glam::DVec3) -> [f32; 3] {
    point.to_array().map(|x| x as f32)
}
