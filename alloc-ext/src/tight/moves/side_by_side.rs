//! Edits that are tried side by side on the same hull.
//!
//! Edits that lose volume are made in their order. An edit that depends on what one before it
//! changed waits for the next turn. How many are tried in a turn depends on the hull alone, so that
//! the result is the same with any number of threads.

use super::editor::HullEditor;
use super::memo::{Answer, Key};
use crate::geom::{Bounds, are_apart};
use glam::DVec3;
use rayon::prelude::*;
use rustc_hash::FxHashMap;
use std::collections::VecDeque;

/// Edits of a turn: one for so many vertices, within these limits. Of more, too many would have to
/// wait for each other.
const VERTICES_PER_EDIT: usize = 25;

/// See [`VERTICES_PER_EDIT`].
const SIDE_BY_SIDE: [usize; 2] = [4, 64];

/// An edit that lost volume on a clone of the hull.
pub(super) struct Edit {
    /// The edge that is flipped first, if there is one.
    pub flip: Option<[u32; 2]>,
    /// The vertices that may move, the ends and apexes of the edge among them, with their places.
    /// The edit depends on them and their neighbours.
    pub moves: Vec<(u32, DVec3)>,
}

/// What came of an edit on a clone.
struct Tried {
    edit: Option<Edit>,
    stars: u64,
    programs: u64,
    answers: FxHashMap<Key, Answer>,
    distances: FxHashMap<[i32; 3], [f64; 2]>,
}

/// What the edits of a turn have changed.
#[derive(Default)]
struct Changed {
    vertices: Vec<u32>,
    faces: Vec<u32>,
}

impl<'a> HullEditor<'a> {
    /// Tries edits until all were tried or the work is up. `attempt` makes one on a clone; the hull
    /// of the clone is put back afterwards.
    pub(super) fn try_side_by_side<T: Copy + Send + Sync>(
        &mut self,
        edits: impl Iterator<Item = T>,
        attempt: impl Fn(&mut HullEditor<'a>, T) -> Option<Edit> + Sync,
    ) {
        let mut waiting: VecDeque<T> = edits.collect();
        let [least, most] = SIDE_BY_SIDE;
        let at_once = (self.shell.face_count() / 2 / VERTICES_PER_EDIT).clamp(least, most);
        while !waiting.is_empty() && !self.is_spent() {
            let turn: Vec<T> = waiting.drain(..at_once.min(waiting.len())).collect();
            let tried = self.try_turn(&turn, &attempt);
            let mut changed = Changed::default();
            let mut wait = Vec::new();
            for (of, tried) in turn.iter().zip(tried) {
                self.placer.stars += tried.stars;
                self.placer.programs += tried.programs;
                tried.answers.into_iter().for_each(|(key, answer)| self.memo.put(key, answer));
                self.distance_field.add(tried.distances);
                let Some(edit) = tried.edit else { continue };
                // The first never waits.
                if self.depends_on(&edit, &changed.vertices) {
                    wait.push(*of);
                } else {
                    self.make(&edit, &mut changed);
                }
            }
            wait.into_iter().rev().for_each(|of| waiting.push_front(of));
        }
    }

    fn try_turn<T: Copy + Send + Sync>(
        &self,
        turn: &[T],
        attempt: &(impl Fn(&mut HullEditor<'a>, T) -> Option<Edit> + Sync),
    ) -> Vec<Tried> {
        let tried = turn.par_iter().with_max_len(1).map(|&of| {
            let mut worker = self.worker();
            Tried {
                edit: attempt(&mut worker, of),
                stars: worker.placer.stars,
                programs: worker.placer.programs,
                answers: worker.memo.take_added(),
                distances: worker.distance_field.take_added(),
            }
        });
        tried.collect()
    }

    fn depends_on(&self, edit: &Edit, changed: &[u32]) -> bool {
        let mesh = &self.shell.mesh;
        let is_near =
            |v: u32| changed.contains(&v) || mesh.neighbours(v).any(|u| changed.contains(&u));
        !changed.is_empty() && edit.moves.iter().any(|&(v, _)| is_near(v))
    }

    /// Makes an edit as on the clone, unless a new face meets one that the clone had elsewhere.
    fn make(&mut self, edit: &Edit, changed: &mut Changed) {
        let saved = if changed.faces.is_empty() { None } else { Some(self.shell.clone()) };
        if let Some([a, b]) = edit.flip
            && !self.shell.flip(a, b)
        {
            return;
        }
        for &(v, x) in &edit.moves {
            if self.shell.position(v) != x {
                self.shell.move_vertex(v, x);
            }
        }
        let mut faces: Vec<u32> =
            edit.moves.iter().flat_map(|&(v, _)| self.shell.mesh.at(v)).copied().collect();
        faces.sort_unstable();
        faces.dedup();
        let is_apart = |&f: &u32| {
            let face = self.shell.face(f);
            let bounds = Bounds::of(&face.at);
            changed.faces.iter().all(|&g| {
                let other = self.shell.face(g);
                f == g || !bounds.meets(&Bounds::of(&other.at)) || are_apart(&face, &other)
            })
        };
        match saved {
            Some(saved) if !faces.iter().all(is_apart) => self.shell = saved,
            _ => {
                changed.faces.extend(faces);
                changed.vertices.extend(edit.moves.iter().map(|&(v, _)| v));
            }
        }
    }
}
