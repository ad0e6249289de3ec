//! The distance to a mesh, and the length of a segment that is free of it, from every triangle in
//! f64. Nothing here shares code with queries.
//!
//! A sphere about each triangle bounds its distance from below and above. Triangles whose lower
//! bound exceeds the least upper bound cannot be nearest, so they are not computed.

use crate::check::distance;
use crate::geom::{Triangle, segment_meets, side};
use crate::mesh::Mesh;
use glam::DVec3;
use rayon::prelude::*;

/// The triangles of a mesh with their spheres.
#[derive(Clone, Debug)]
pub(super) struct Truth {
    triangles: Vec<[DVec3; 3]>,
    /// Centre and radius.
    spheres: Vec<(DVec3, f64)>,
}

impl Truth {
    /// Of all triangles, those without area too.
    pub fn of(mesh: &Mesh) -> Self {
        Self::of_triangles(mesh.all_corners_f64().collect())
    }

    /// Of triangles, which may be segments or points.
    pub fn of_triangles(triangles: Vec<[DVec3; 3]>) -> Self {
        let sphere = |corners: &[DVec3; 3]| {
            let centre = corners.iter().sum::<DVec3>() / 3.0;
            let radius = corners.iter().fold(0f64, |most, &p| most.max(p.distance(centre)));
            // Covers the roundings of the centre and of distances to it.
            (centre, radius * (1.0 + 1e-9))
        };
        let spheres = triangles.iter().map(sphere).collect();
        Self { triangles, spheres }
    }

    /// The distances of points.
    pub fn distances(&self, points: &[[f32; 3]]) -> Vec<f64> {
        points.par_iter().map(|&point| self.distance(point)).collect()
    }

    /// The distances of points that are moved along z to the plane of the first corner.
    pub fn distances_in_plane(&self, points: &[[f32; 3]]) -> Vec<f64> {
        let z = self.triangles.first().map_or(0.0, |[a, ..]| a.z);
        points.par_iter().map(|&[x, y, _]| self.to(DVec3::new(x.into(), y.into(), z))).collect()
    }

    /// How far each segment, two points in a row, goes before it meets the mesh: its length if it
    /// does not. Whether it meets a triangle with an area is exact; where is rounded.
    pub fn free_lengths(&self, ends: &[[f32; 3]]) -> Vec<f64> {
        let free = |ends: &[[f32; 3]; 2]| {
            let [p, q] = ends.map(|end| glam::Vec3::from(end).as_dvec3());
            let (along, length) = (q - p, p.distance(q));
            let is_near = |&(centre, radius): &(DVec3, f64)| {
                let part = (along.dot(centre - p) / (length * length)).clamp(0.0, 1.0);
                let apart = centre.distance(p + along * part);
                // Without length the part is no number, and every triangle is looked at.
                apart.is_nan() || apart <= radius + 1e-9 * (length + centre.length())
            };
            let pairs = self.spheres.iter().zip(&self.triangles);
            let near = pairs.filter(|(sphere, _)| is_near(sphere));
            let meets = near.filter_map(|(_, t)| first_common(p, q, t));
            length * meets.fold(1.0, f64::min)
        };
        ends.as_chunks::<2>().0.par_iter().map(free).collect()
    }

    /// The distance of a point.
    pub fn distance(&self, point: [f32; 3]) -> f64 {
        self.to(glam::Vec3::from(point).as_dvec3())
    }

    fn to(&self, p: DVec3) -> f64 {
        let upper = |&(centre, radius): &(DVec3, f64)| p.distance(centre) * (1.0 + 1e-12) + radius;
        let most = self.spheres.iter().map(upper).fold(f64::INFINITY, f64::min);
        let pairs = self.spheres.iter().zip(&self.triangles);
        let near = pairs
            .filter(|((centre, radius), _)| p.distance(*centre) * (1.0 - 1e-12) - radius <= most);
        near.map(|(_, &corners)| distance(p, corners)).fold(f64::INFINITY, f64::min)
    }
}

/// The parameter of the first common point of a segment and a triangle with an area.
fn first_common(p: DVec3, q: DVec3, t: &Triangle) -> Option<f64> {
    let sides = [p, q].map(|end| side(t, end));
    if !segment_meets([p, q], sides, t) {
        return None;
    }
    let normal = (t[1] - t[0]).cross(t[2] - t[0]);
    let [from, to] = [p, q].map(|end| normal.dot(end - t[0]));
    if sides != [0.0; 2] {
        return Some(if sides[0] == 0.0 { 0.0 } else { (from / (from - to)).clamp(0.0, 1.0) });
    }
    // In the plane: the part of the segment that is on the inner side of all edges.
    let entry = (0..3).map(|i| {
        let inward = normal.cross(t[(i + 1) % 3] - t[i]);
        let [from, to] = [p, q].map(|end| inward.dot(end - t[i]));
        if from < 0.0 && to > from { (from / (from - to)).clamp(0.0, 1.0) } else { 0.0 }
    });
    Some(entry.fold(0.0, f64::max))
}

#[cfg(test)]
mod tests {
    use super::Truth;
    use crate::check::distance;
    use crate::mesh::Mesh;
    use crate::random::SplitMix;
    use glam::Vec3;

    #[test]
    fn leaving_triangles_out_by_their_spheres_changes_no_distance() {
        let mut random = SplitMix::new(7);
        let mut point = || random.direction().as_vec3().to_array();
        let positions: Vec<[f32; 3]> = (0..300).map(|_| point()).collect();
        let triangles = (0..100).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
        let mesh = Mesh::new(positions, triangles);
        let truth = Truth::of(&mesh);
        for _ in 0..50 {
            let p = point();
            let all = mesh.corners_f64().map(|t| distance(Vec3::from(p).as_dvec3(), t));
            assert_eq!(truth.distance(p), all.fold(f64::INFINITY, f64::min));
        }
    }
}
