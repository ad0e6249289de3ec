//! The distance to a mesh, from every triangle in f64. It shares no code with queries.
//!
//! A sphere about each triangle bounds its distance from below and above. Triangles whose lower
//! bound exceeds the least upper bound cannot be nearest, so they are not computed.

use crate::check::distance;
use crate::mesh::Mesh;
use glam::DVec3;

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
        let triangles: Vec<[DVec3; 3]> = mesh.all_corners_f64().collect();
        let sphere = |corners: &[DVec3; 3]| {
            let centre = corners.iter().sum::<DVec3>() / 3.0;
            let radius = corners.iter().fold(0f64, |most, &p| most.max(p.distance(centre)));
            // More than the roundings of both.
            (centre, radius * (1.0 + 1e-9))
        };
        let spheres = triangles.iter().map(sphere).collect();
        Self { triangles, spheres }
    }

    /// The distance of a point.
    pub fn distance(&self, point: [f32; 3]) -> f64 {
        let p = glam::Vec3::from(point).as_dvec3();
        let upper = |&(centre, radius): &(DVec3, f64)| p.distance(centre) * (1.0 + 1e-12) + radius;
        let most = self.spheres.iter().map(upper).fold(f64::INFINITY, f64::min);
        let pairs = self.spheres.iter().zip(&self.triangles);
        let near = pairs
            .filter(|((centre, radius), _)| p.distance(*centre) * (1.0 - 1e-12) - radius <= most);
        near.map(|(_, &corners)| distance(p, corners)).fold(f64::INFINITY, f64::min)
    }
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
