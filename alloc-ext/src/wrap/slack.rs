//! How far a hull is from the mesh, and moves that bring it nearer.
//!
//! Least volume alone lets a thin spike stand: it costs next to nothing. Where a slack is asked
//! for, every move keeps the faces that it makes within [`Work::reach`] of the mesh, and a hull
//! that is farther is first brought there: the worst face's corners are pulled towards the mesh,
//! its edges are collapsed, flipped and split, each time to where the worst of the new faces is
//! nearer than the worst of the old.

use super::decimate::Candidate;
use super::field::Field;
use super::obstacle::Obstacle;
use super::placement::{StarFace, Wish};
use super::predicates::Triangle;
use super::shell::Shell;
use super::work::Work;
use crate::hull::{Farthest, Nearest, farthest, is_within};
use glam::DVec3;
use meshsweep_core::internal::geom::point_triangle;

fn nearest(obstacle: &Obstacle, p: DVec3) -> Option<Nearest> {
    let (triangle, [lower, upper]) = obstacle.nearest(p)?;
    Some(Nearest { lower, upper, triangle: Some(triangle) })
}

/// Bounds of the largest distance from a point of the hull to the mesh. Cost: see [`farthest`].
pub(super) fn slack(shell: &Shell, obstacle: &Obstacle) -> Farthest {
    farthest(shell.alive().map(|f| shell.triangle(f)), 0.0, |p| nearest(obstacle, p))
}

/// Pieces that a face is cut into at most to see whether it is in reach: where they do not tell, it
/// counts as out of it.
const PIECES: usize = 4000;

/// Steps of the field in a slack.
const STEPS: f64 = 8.0;

/// Least part by which a move brings the worst face nearer.
const NEARER: f64 = 0.05;

/// A hull is given up where fewer than one in this many of its far faces came nearer in a round.
const HOPELESS: usize = 20;

/// A hull is given up, too, where splits have made so many times as many faces, and these more.
const SPLIT: usize = 2;

/// See [`SPLIT`].
const SPLIT_BESIDES: usize = 500;

/// Pulls a vertex to a place, whatever volume that costs.
const PULL: Wish =
    Wish { second_term: 1e3, tilt: DVec3::ZERO, upright: Some(0.01), clearance: 0.0 };

impl Work<'_> {
    /// Whether no point of a face is farther from the mesh than [`reach`](Self::reach).
    pub fn is_in_reach(&mut self, face: &Triangle) -> bool {
        let obstacle = self.obstacle;
        self.reach == f64::INFINITY
            || is_within(
                *face,
                self.reach,
                PIECES,
                |p| self.field.about(obstacle, p),
                |p| nearest(obstacle, p),
            )
    }

    /// Whether all faces of a star that has its vertex at `x` are in reach.
    pub fn is_star_in_reach(&mut self, star: &[StarFace], x: DVec3) -> bool {
        self.reach == f64::INFINITY
            || self.field.about(self.obstacle, x)[0] <= self.reach
                && star
                    .iter()
                    .filter_map(|face| face.ring)
                    .all(|[a, b]| self.is_in_reach(&[x, a, b]))
    }

    /// Whether a slack is kept.
    pub fn is_kept_near(&self) -> bool {
        self.reach < f64::INFINITY
    }

    /// Not below the largest distance from a point of the hull to the mesh.
    pub fn slack(&self) -> f64 {
        slack(&self.shell, self.obstacle).upper
    }

    /// From now on no new face has a point farther from the mesh.
    pub fn stay_within(&mut self, most: f64) {
        self.reach = most;
        if self.field.step() != most / STEPS {
            self.field = Field::new(most / STEPS);
        }
    }

    /// Not below the largest distance of some faces from the mesh, as far as it is more than
    /// `enough`.
    fn distance(&self, faces: &[u32], enough: f64) -> f64 {
        let corners = faces.iter().map(|&f| self.shell.triangle(f));
        farthest(corners, enough, |p| nearest(self.obstacle, p)).upper
    }

    /// Brings every face within a distance of the mesh and keeps it there from then on; false, and
    /// the reach is as before, if some stay outside or the time is up.
    pub fn come_within(&mut self, most: f64) -> bool {
        let before = self.reach;
        self.stay_within(most);
        let is_done = self.bring_all_within(most);
        self.reach = if is_done { most } else { before };
        is_done
    }

    /// True only after each face was found to be within.
    fn bring_all_within(&mut self, most: f64) -> bool {
        let mut faces: Vec<u32> = self.shell.alive().collect();
        let mut is_all = true;
        let too_many = SPLIT * faces.len() + SPLIT_BESIDES;
        loop {
            self.reach = most;
            let mut far: Vec<(f64, u32)> = Vec::new();
            for &f in &faces {
                if self.is_late() {
                    return false;
                }
                if self.shell.mesh.is_alive(f) && !self.is_in_reach(&self.shell.triangle(f)) {
                    far.push((self.distance(&[f], most), f));
                }
            }
            if far.is_empty() {
                if is_all {
                    return true;
                }
                faces = self.shell.alive().collect();
                is_all = true;
                continue;
            }
            far.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
            // Moves end, as each brings what it changes nearer by a part.
            let mut moved = 0;
            let mut changed: Vec<u32> = Vec::new();
            for &(_, f) in &far {
                if self.is_late() {
                    return false;
                }
                changed.push(f);
                if self.shell.mesh.is_alive(f)
                    && let Some(faces) = self.bring_nearer(f, most)
                {
                    moved += 1;
                    changed.extend(faces);
                }
            }
            if moved * HOPELESS <= far.len() || self.shell.face_count() > too_many {
                return false;
            }
            changed.sort_unstable();
            changed.dedup();
            (faces, is_all) = (changed, false);
        }
    }

    /// Tries the moves around a face until one brings what it changes nearer: the faces that it
    /// made.
    fn bring_nearer(&mut self, f: u32, most: f64) -> Option<Vec<u32>> {
        let [a, b, c] = self.shell.mesh.corners[f as usize];
        // The farthest corner first.
        let mut corners = [a, b, c].map(|v| (self.height(v), v));
        corners.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        for (_, v) in corners {
            let star = self.shell.mesh.at(v).to_vec();
            self.aim(&star, most);
            if self.pull(v) {
                return Some(star);
            }
        }
        let edges = [[a, b], [b, c], [c, a]].map(|[u, v]| [u.min(v), u.max(v)]);
        for [u, v] in edges {
            let mut star = self.shell.mesh.at(u).to_vec();
            star.extend(self.shell.mesh.at(v));
            self.aim(&star, most);
            if let Some(Candidate { position, .. }) = self.evaluate(u, v, 0)
                && self.collapse(u, v, position)
            {
                return Some(self.shell.mesh.at(u).to_vec());
            }
        }
        for [u, v] in edges {
            let Some(wings) = self.shell.mesh.wings(u, v) else { continue };
            self.aim(&wings.triangles, most);
            if self.flip(u, v) {
                return Some(wings.triangles.to_vec());
            }
            if let Some(split) = self.evaluate_split(u, v)
                && let Some(new) = self.split(&split)
            {
                return Some(self.shell.mesh.at(new).to_vec());
            }
        }
        None
    }

    /// Sets the reach to what is an improvement for some faces.
    fn aim(&mut self, faces: &[u32], most: f64) {
        self.reach = most.max(self.distance(faces, most) * (1.0 - NEARER));
    }

    fn height(&self, v: u32) -> f64 {
        self.obstacle.nearest(self.shell.position(v)).map_or(0.0, |(_, [_, upper])| upper)
    }

    /// Moves a vertex as near to the mesh as its star lets it.
    fn pull(&mut self, v: u32) -> bool {
        let from = self.shell.position(v);
        let Some(([a, b, c], _)) = self.obstacle.nearest(from) else { return false };
        let near = point_triangle(from, a, b, c);
        let target = a + (b - a) * near.u + (c - a) * near.v;
        self.move_to(v, target, &PULL)
    }
}
