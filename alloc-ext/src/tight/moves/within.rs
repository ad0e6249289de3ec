//! The distance of the hull from the mesh, and edits that make it smaller.
//!
//! Least volume alone lets a thin spike stand, because a spike costs next to nothing. Where a slack
//! is asked for, every edit keeps the new faces within [`HullEditor::max_distance`] of the mesh. A
//! hull that is farther is brought nearer first. Around its worst face corners are pulled towards
//! the mesh and edges are collapsed, flipped and split. An edit is made if the worst new face is
//! nearer than the worst old face.

use super::editor::HullEditor;
use super::placement::PlacementObjective;
use super::shell::Shell;
use super::star::StarFace;
use crate::geom::Triangle;
use crate::hausdorff::{Farthest, Nearest, farthest, is_within};
use crate::tight::proof::{DistanceField, Obstacle};
use glam::DVec3;
use meshsweep_core::internal::geom::point_triangle;

fn nearest(obstacle: &Obstacle, p: DVec3) -> Option<Nearest> {
    let (triangle, [lower, upper]) = obstacle.nearest(p)?;
    Some(Nearest { lower, upper, triangle: Some(triangle) })
}

/// Bounds of the largest distance from a point of the hull to the mesh. Cost: see [`farthest`].
pub(crate) fn slack(shell: &Shell, obstacle: &Obstacle) -> Farthest {
    farthest(shell.alive().map(|f| shell.triangle(f)), 0.0, |p| nearest(obstacle, p))
}

/// Most pieces that a face is cut into to decide whether it is within the limit. If they do not
/// decide, the face counts as too far.
const MOST_PIECES: usize = 4000;

/// Steps of the distance field in the largest distance.
const FIELD_STEPS: f64 = 8.0;

/// Least fraction by which an edit brings the worst face nearer.
const NEARER: f64 = 0.05;

/// A hull is given up if fewer than one in this many of its far faces came nearer in a round.
const HOPELESS: usize = 20;

/// A hull is also given up if splits have made its faces this many times as many, plus
/// [`MORE_FACES`].
const TIMES_FACES: usize = 2;

/// See [`TIMES_FACES`].
const MORE_FACES: usize = 500;

/// Pulls a vertex to a place. The volume hardly counts.
const PULL: PlacementObjective =
    PlacementObjective { centre_weight: 1e3, upright: Some(0.01), ..PlacementObjective::PLAIN };

impl HullEditor<'_> {
    /// Whether no point of a face is farther than [`max_distance`](Self::max_distance) from the
    /// mesh.
    pub(super) fn is_within_limit(&mut self, face: &Triangle) -> bool {
        let obstacle = self.obstacle;
        !self.has_distance_limit()
            || is_within(
                *face,
                self.max_distance,
                MOST_PIECES,
                |p| self.distance_field.about(obstacle, p),
                |p| nearest(obstacle, p),
            )
    }

    /// Whether all faces of a star with its vertex at `x` are within the limit.
    pub(super) fn is_star_within_limit(&mut self, star: &[StarFace], x: DVec3) -> bool {
        !self.has_distance_limit()
            || self.distance_field.about(self.obstacle, x)[0] <= self.max_distance
                && star
                    .iter()
                    .filter_map(|face| face.ring)
                    .all(|[a, b]| self.is_within_limit(&[x, a, b]))
    }

    /// Whether edits keep a largest distance from the mesh.
    pub fn has_distance_limit(&self) -> bool {
        self.max_distance < f64::INFINITY
    }

    /// An upper bound of the largest distance from a point of the hull to the mesh.
    pub fn slack(&self) -> f64 {
        slack(&self.shell, self.obstacle).upper
    }

    /// Sets the largest distance of a point of a new face from the mesh.
    pub fn limit_distance(&mut self, most: f64) {
        self.max_distance = most;
        if self.distance_field.step() != most / FIELD_STEPS {
            self.distance_field = DistanceField::new(most / FIELD_STEPS);
        }
    }

    /// An upper bound of the largest distance of some faces from the mesh, as tight as a distance
    /// above `enough` needs.
    fn distance(&self, faces: &[u32], enough: f64) -> f64 {
        let corners = faces.iter().map(|&f| self.shell.triangle(f));
        farthest(corners, enough, |p| nearest(self.obstacle, p)).upper
    }

    /// Brings every face within a distance of the mesh, and limits later edits to that distance.
    /// False if some faces stay farther or the time is up; the limit is then the one before.
    pub fn bring_within(&mut self, most: f64) -> bool {
        let before = self.max_distance;
        self.limit_distance(most);
        let is_within = self.bring_all_within(most);
        self.max_distance = if is_within { most } else { before };
        is_within
    }

    /// True only after each face was proved to be within.
    fn bring_all_within(&mut self, most: f64) -> bool {
        let mut faces: Vec<u32> = self.shell.alive().collect();
        let mut is_all = true;
        let too_many = TIMES_FACES * faces.len() + MORE_FACES;
        loop {
            self.max_distance = most;
            let mut far: Vec<(f64, u32)> = Vec::new();
            for &f in &faces {
                if self.is_late() {
                    return false;
                }
                if self.shell.mesh.is_alive(f) && !self.is_within_limit(&self.shell.triangle(f)) {
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
            // Rounds come to an end, because each edit brings its faces nearer by a fraction.
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

    /// Tries the edits around a face until one brings its faces nearer; the new faces.
    fn bring_nearer(&mut self, f: u32, most: f64) -> Option<Vec<u32>> {
        let [a, b, c] = self.shell.mesh.corners[f as usize];
        // The farthest corner first.
        let mut corners = [a, b, c].map(|v| (self.height(v), v));
        corners.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        for (_, v) in corners {
            let star = self.shell.mesh.at(v).to_vec();
            self.require_nearer(&star, most);
            if self.pull(v) {
                return Some(star);
            }
        }
        let edges = [[a, b], [b, c], [c, a]].map(|[u, v]| [u.min(v), u.max(v)]);
        for ends in edges {
            let star = ends.map(|v| self.shell.mesh.at(v)).concat();
            self.require_nearer(&star, most);
            if let Some(collapse) = self.evaluate_collapse(ends)
                && self.collapse(ends, collapse.position)
            {
                return Some(self.shell.mesh.at(ends[0]).to_vec());
            }
        }
        for [u, v] in edges {
            let Some(wings) = self.shell.mesh.wings(u, v) else { continue };
            self.require_nearer(&wings.triangles, most);
            if self.flip(u, v) {
                return Some(wings.triangles.to_vec());
            }
            if let Some(split) = self.evaluate_split([u, v])
                && let Some(new) = self.split(&split)
            {
                return Some(self.shell.mesh.at(new).to_vec());
            }
        }
        None
    }

    /// Sets the largest distance so that an edit of these faces brings the worst of them nearer.
    fn require_nearer(&mut self, faces: &[u32], most: f64) {
        self.max_distance = most.max(self.distance(faces, most) * (1.0 - NEARER));
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
        self.move_vertex(v, target, &PULL).is_some()
    }
}
