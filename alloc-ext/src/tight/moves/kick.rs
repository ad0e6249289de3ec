//! Random kicks of vertices: perturb and settle again.

use super::editor::HullEditor;
use super::placement::PlacementObjective;
use super::side_by_side::Edit;
use super::star::radius;
use super::tolerance::GAIN;
use crate::random::SplitMix;
use glam::DVec3;

impl HullEditor<'_> {
    /// Pulls every vertex once in a random direction and settles it and its neighbours. Keeps the
    /// kicks that lose volume.
    pub fn kick_all(&mut self, random: &mut SplitMix, strength: f64) {
        let kicks: Vec<(u32, DVec3)> = (0..self.shell.vertex_slots())
            .filter(|&v| !self.shell.mesh.at(v).is_empty())
            .map(|v| (v, random.direction() * strength))
            .collect();
        self.try_side_by_side(kicks.into_iter(), |worker, (v, tilt)| worker.kick(v, tilt));
    }

    fn kick(&mut self, v: u32, tilt: DVec3) -> Option<Edit> {
        let around: Vec<u32> = self.shell.mesh.neighbours(v).chain([v]).collect();
        let from = self.shell.position(v);
        let objective = PlacementObjective {
            centre_weight: 0.3,
            tilt,
            upright: Some(0.1),
            ..PlacementObjective::PLAIN
        };
        let mut gained = self.move_vertex(v, from, &objective)?;
        let radius = radius(&self.star, from);
        for &u in &around {
            gained += self.settle(u).unwrap_or(0.0);
        }
        let moves = || around.iter().map(|&u| (u, self.shell.position(u))).collect();
        (gained > GAIN * radius * radius * radius).then(|| Edit { flip: None, moves: moves() })
    }
}
