//! Random kicks of vertices: perturb and settle again.

use super::editor::HullEditor;
use super::placement::PlacementObjective;
use super::star::radius;
use super::tolerance::GAIN;
use crate::random::SplitMix;
use glam::DVec3;

impl HullEditor<'_> {
    /// Pulls every vertex once in a random direction and settles it and its neighbours. Keeps the
    /// kicks that lose volume.
    pub fn kick_all(&mut self, random: &mut SplitMix, strength: f64) {
        for v in 0..self.shell.vertex_slots() {
            if self.is_spent() {
                break;
            }
            if !self.shell.mesh.at(v).is_empty() {
                self.kick(v, random.direction() * strength);
            }
        }
    }

    fn kick(&mut self, v: u32, tilt: DVec3) {
        let mut around: Vec<u32> = self.shell.mesh.neighbours(v).collect();
        around.push(v);
        let before: Vec<DVec3> = around.iter().map(|&u| self.shell.position(u)).collect();
        let from = self.shell.position(v);
        let objective = PlacementObjective { centre_weight: 0.3, tilt, upright: Some(0.1) };
        let Some(mut gained) = self.move_vertex(v, from, &objective) else { return };
        let radius = radius(&self.star, from);
        for &u in &around {
            gained += self.settle(u).unwrap_or(0.0);
        }
        let is_better = gained > GAIN * radius * radius * radius;
        if !is_better {
            for (&u, &at) in around.iter().zip(&before) {
                self.shell.move_vertex(u, at);
            }
        }
    }
}
