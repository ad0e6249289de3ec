//! Every triangle in f64, by other formulas than the core's.

use glam::{DVec3, Vec3};
use meshsweep_host_tests::oracle::wide_distance_sq;
use meshsweep_host_tests::workload::Subject;

/// All triangles of a mesh.
pub struct Brute(Vec<[DVec3; 3]>);

impl Brute {
    /// Takes over the mesh.
    pub fn new(subject: &Subject) -> Self {
        let at = |v: u32| Vec3::from_array(subject.mesh.positions[v as usize]).as_dvec3();
        Self::of(subject.mesh.triangles.iter().map(|corners| corners.map(at)).collect())
    }

    /// Takes over triangles.
    pub fn of(triangles: Vec<[DVec3; 3]>) -> Self {
        Self(triangles)
    }

    /// Distance to the surface.
    pub fn distance(&self, point: [f32; 3]) -> f64 {
        let p = point.map(f64::from);
        self.0
            .iter()
            .map(|corners| wide_distance_sq(p, corners.map(|corner| corner.to_array())))
            .fold(f64::INFINITY, f64::min)
            .sqrt()
    }

    /// Parameter of the first hit of a segment, and whether every triangle was hit or missed by a
    /// clear margin.
    pub fn first_hit(&self, ends: [[f32; 3]; 2]) -> (Option<f64>, bool) {
        let [a, b] = ends.map(|end| Vec3::from_array(end).as_dvec3());
        let mut first = f64::INFINITY;
        let mut clear = true;
        for triangle in &self.0 {
            let (t, margin) = cross(a, b - a, triangle);
            clear &= margin.abs() > 1.0e-9;
            if margin > 0.0 {
                first = first.min(t);
            }
        }
        (first.is_finite().then_some(first), clear)
    }
}

/// Parameter at which a line crosses a triangle's plane (Möller & Trumbore 1997), and by what
/// margin it is inside the triangle and the segment: negative outside.
pub fn cross(from: DVec3, direction: DVec3, &[a, b, c]: &[DVec3; 3]) -> (f64, f64) {
    let (ab, ac) = (b - a, c - a);
    let p = direction.cross(ac);
    let determinant = ab.dot(p);
    if determinant == 0.0 {
        return (0.0, -1.0);
    }
    let s = from - a;
    let u = s.dot(p) / determinant;
    let q = s.cross(ab);
    let v = direction.dot(q) / determinant;
    let t = ac.dot(q) / determinant;
    (t, u.min(v).min(1.0 - u - v).min(t).min(1.0 - t))
}
