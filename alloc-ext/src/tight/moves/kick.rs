//! Perturb and settle again: what a hull of a given number of faces can still lose.

use crate::tight::moves::editor::HullEditor;
use crate::tight::moves::placement::PlacementObjective;
use crate::tight::moves::vertex::GAIN;
use glam::DVec3;

/// Chance without chance: the same numbers in every run (Steele, Lea & Flood 2014, SplitMix64).
#[derive(Clone, Debug)]
pub(crate) struct SplitMix(u64);

impl SplitMix {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Uniform in [0, 1).
    pub fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        (((z ^ (z >> 31)) >> 11) as f64) / (1u64 << 53) as f64
    }

    /// Each coordinate uniform in [−1, 1).
    fn direction(&mut self) -> DVec3 {
        DVec3::new(self.roll(), self.roll(), self.roll()) * 2.0 - 1.0
    }
}

/// How far polishing goes: a number of stars, so that the result does not depend on the machine.
#[derive(Clone, Debug)]
pub(crate) struct Polish {
    dice: SplitMix,
    from: u64,
    until: u64,
}

/// Stars that any hull gets with an effort of 1.
const STARS: f64 = 10_000.0;

/// Stars for each face beyond that.
const STARS_PER_FACE: f64 = 10.0;

/// Polishing ends when this many rounds together gain less than [`TOO_LITTLE`] of the void.
const IDLE_ROUNDS: usize = 3;

/// See [`IDLE_ROUNDS`].
const TOO_LITTLE: f64 = 2e-4;

/// Length of the random part of a pull, where the direction of least volume has length 1.
const STRENGTH: f64 = 1.5;

/// A round tries every edge's flip once in so many rounds: most find nothing new.
const FLIP_ROUNDS: usize = 3;

impl Polish {
    pub fn new(editor: &HullEditor<'_>, effort: f64) -> Self {
        let stars = (STARS + STARS_PER_FACE * editor.shell.face_count() as f64) * effort.max(0.0);
        let from = editor.placer.stars;
        Self { dice: SplitMix::new(1), from, until: from.saturating_add(stars as u64) }
    }

    /// Exchanges, flips and kicks in rounds until the stars are used up, the time is, or nothing is
    /// gained. `volume` is what no hull gets below.
    pub fn run(
        &mut self,
        editor: &mut HullEditor<'_>,
        volume: f64,
        mut on_progress: impl FnMut(u64, u64),
    ) {
        editor.limit = Some(self.until);
        editor.relax(volume, 2e-3, 30);
        let mut past = vec![editor.shell.volume()];
        let mut round = 0;
        while !editor.is_spent() {
            editor.exchange((editor.shell.face_count() / 10).clamp(8, 60));
            editor.flip_all();
            if round % FLIP_ROUNDS == 0 {
                editor.flip_search();
            }
            editor.kick_all(&mut self.dice, STRENGTH);
            editor.flip_all();
            round += 1;
            on_progress(editor.placer.stars.min(self.until) - self.from, self.until - self.from);
            past.push(editor.shell.volume());
            if let [.., before, _, _, now] = past[..]
                && round >= IDLE_ROUNDS
                && before - now <= TOO_LITTLE * (now - volume)
            {
                break;
            }
        }
        editor.limit = None;
    }
}

impl HullEditor<'_> {
    /// Sweeps and flips until a round gains less than `least` of the void.
    pub fn relax(&mut self, volume: f64, least: f64, rounds: usize) {
        for _ in 0..rounds {
            let before = self.shell.volume();
            self.sweep();
            self.flip_all();
            let after = self.shell.volume();
            if before - after <= least * (after - volume).abs() || self.is_spent() {
                break;
            }
        }
    }

    /// Pulls every vertex once in a random direction and lets it and its neighbours settle; keeps
    /// what loses volume. How many did.
    pub fn kick_all(&mut self, dice: &mut SplitMix, strength: f64) -> usize {
        let mut kept = 0;
        for v in 0..self.shell.vertex_slots() {
            if self.is_spent() {
                break;
            }
            if !self.shell.mesh.at(v).is_empty() {
                kept += usize::from(self.kick(v, dice, strength));
            }
        }
        kept
    }

    fn kick(&mut self, v: u32, dice: &mut SplitMix, strength: f64) -> bool {
        let mut around: Vec<u32> = self.shell.mesh.neighbours(v).collect();
        around.push(v);
        let before: Vec<DVec3> = around.iter().map(|&u| self.shell.position(u)).collect();
        let wish = PlacementObjective {
            second_term: 0.3,
            tilt: dice.direction() * strength,
            upright: Some(0.1),
            clearance: 0.0,
        };
        let Some(mut gained) = self.disturb(v, &wish) else { return false };
        let radius = self.star_radius(before[before.len() - 1]);
        for &u in &around {
            gained += self.settle(u).unwrap_or(0.0);
        }
        let better = gained > GAIN * radius * radius * radius;
        if !better {
            for (&u, &at) in around.iter().zip(&before) {
                self.shell.move_vertex(u, at);
            }
        }
        better
    }
}
