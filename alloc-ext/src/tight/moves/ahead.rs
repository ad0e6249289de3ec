//! Placements that are computed side by side, before the edits that ask for them.
//!
//! A placement depends on its star alone, and a list of stars is the same with any number of
//! threads. So is the result.

use super::editor::HullEditor;
use super::memo::Key;
use super::placement::{PlacementObjective, Placer};
use super::star::{StarFace, added_volume};
use super::tolerance::CLEARANCES;
use glam::DVec3;
use rayon::prelude::*;

/// A star that waits for its placement with the least clearance.
pub(super) struct Waiting {
    pub key: Key,
    pub star: Vec<StarFace>,
    pub centre: DVec3,
    pub objective: PlacementObjective,
}

impl HullEditor<'_> {
    /// Places stars side by side.
    pub(super) fn place_all(&mut self, waiting: &[Waiting]) -> Vec<Option<DVec3>> {
        let editor = &*self;
        let place = |placer: &mut Placer, of: &Waiting| {
            (placer.stars, placer.programs) = (0, 0);
            let x = editor.place_by(placer, &of.star, of.centre, CLEARANCES[0], &of.objective);
            (x, placer.stars, placer.programs)
        };
        let placed: Vec<_> =
            waiting.par_iter().map_init(Placer::default, |placer, of| place(placer, of)).collect();
        let take = |(x, stars, programs)| {
            self.placer.stars += stars;
            self.placer.programs += programs;
            x
        };
        placed.into_iter().map(take).collect()
    }

    /// Remembers the answers of stars.
    pub(super) fn remember_all(&mut self, waiting: &[Waiting]) {
        let placed = self.place_all(waiting);
        for (Waiting { key, star, .. }, x) in waiting.iter().zip(placed) {
            self.memo.put(*key, x.map(|x| (x, added_volume(star, x))));
        }
    }
}
