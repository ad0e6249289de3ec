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

/// Polishing ends when this many rounds together gain less than [`LEAST_PART`] of the void.
const IDLE_ROUNDS: usize = 3;

/// See [`IDLE_ROUNDS`].
const LEAST_PART: f64 = 2e-4;

/// Length of the random part of a kick, where the direction of least volume has length 1.
const STRENGTH: f64 = 1.5;

/// Every edge's flip is tried once in this many rounds: most flips gain nothing.
const FLIP_ROUNDS: usize = 3;

impl Polish {
    pub fn new(editor: &HullEditor<'_>, effort: f64) -> Self {
        let stars = (STARS + STARS_PER_FACE * editor.shell.face_count() as f64) * effort.max(0.0);
        let from = editor.placer.stars;
        Self { random: SplitMix::new(1), from, until: from.saturating_add(stars as u64) }
    }

    /// Exchanges, flips and kicks in rounds until the stars or the time are used up, or little is
    /// gained. No hull has less volume than `floor`.
    pub fn run(
        &mut self,
        editor: &mut HullEditor<'_>,
        floor: f64,
        mut on_progress: impl FnMut(u64, u64),
    ) {
        editor.star_limit = Some(self.until);
        editor.relax(floor, 2e-3, 30);
        let mut past = vec![editor.shell.volume()];
        let mut round = 0;
        while !editor.is_spent() {
            editor.exchange((editor.shell.face_count() / 10).clamp(8, 60));
            editor.flip_all();
            if round % FLIP_ROUNDS == 0 {
                editor.flip_search();
            }
            editor.kick_all(&mut self.random, STRENGTH);
            editor.flip_all();
            round += 1;
            on_progress(editor.placer.stars.min(self.until) - self.from, self.until - self.from);
            past.push(editor.shell.volume());
            if let [.., before, _, _, now] = past[..]
                && round >= IDLE_ROUNDS
                && before - now <= LEAST_PART * (now - floor)
            {
                break;
            }
        }
        editor.star_limit = None;
    }
}
