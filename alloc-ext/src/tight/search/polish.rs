//! Polishing: edits in rounds that lose volume at a given number of faces.

use crate::random::SplitMix;
use crate::tight::moves::HullEditor;

/// How far polishing goes: a number of stars, so that the result does not depend on the machine.
#[derive(Clone, Debug)]
pub(super) struct Polish {
    random: SplitMix,
    from: u64,
    until: u64,
}

/// Stars for any hull with an effort of 1.
const STARS: f64 = 10_000.0;

/// Further stars for each face.
const STARS_PER_FACE: f64 = 10.0;

/// Polishing ends when this many rounds together gain at most [`LEAST_FRACTION`] of the volume
/// beyond the floor.
const IDLE_ROUNDS: usize = 3;

/// See [`IDLE_ROUNDS`].
const LEAST_FRACTION: f64 = 2e-4;

/// Length of the random direction of a kick, where the direction of least volume has length 1.
const STRENGTH: f64 = 1.5;

/// At the beginning the hull relaxes until a round gains less than this fraction of the volume
/// beyond the floor, but for so many rounds at most.
const RELAXED: (f64, usize) = (2e-3, 30);

/// Exchanges of a round: one for so many faces, within these limits.
const FACES_PER_EXCHANGE: usize = 10;

/// See [`FACES_PER_EXCHANGE`].
const EXCHANGES: [usize; 2] = [8, 60];

/// Every edge's flip is tried once in this many rounds: most flips gain nothing.
const FLIP_ROUNDS: usize = 3;

impl Polish {
    pub fn new(editor: &HullEditor<'_>, effort: f64) -> Self {
        let stars = (STARS + STARS_PER_FACE * editor.shell.face_count() as f64) * effort.max(0.0);
        let from = editor.placer.stars;
        Self { random: SplitMix::new(1), from, until: from.saturating_add(stars as u64) }
    }

    /// Exchanges, flips and kicks in rounds until the stars or the time are used up, or little is
    /// gained beyond the volume `floor`. A hull may have less volume than that if components of the
    /// mesh overlap.
    pub fn run(
        &mut self,
        editor: &mut HullEditor<'_>,
        floor: f64,
        mut on_progress: impl FnMut(u64, u64),
    ) {
        editor.star_limit = Some(self.until);
        let [fewest, most] = EXCHANGES;
        editor.relax(floor, RELAXED.0, RELAXED.1);
        let mut past = vec![editor.shell.volume()];
        let mut round = 0;
        while !editor.is_spent() {
            let exchanges = editor.shell.face_count() / FACES_PER_EXCHANGE;
            editor.exchange(exchanges.clamp(fewest, most));
            editor.flip_all();
            if round % FLIP_ROUNDS == 0 {
                editor.flip_search();
            }
            editor.kick_all(&mut self.random, STRENGTH);
            editor.flip_all();
            round += 1;
            on_progress(editor.placer.stars.min(self.until) - self.from, self.until - self.from);
            let now = editor.shell.volume();
            past.push(now);
            if let Some(before) = past.iter().rev().nth(IDLE_ROUNDS)
                && before - now <= LEAST_FRACTION * (now - floor)
            {
                break;
            }
        }
        editor.star_limit = None;
    }
}
