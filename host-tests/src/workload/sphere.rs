//! The smallest sphere about points (Welzl 1991), without the moves to the front.

use glam::DVec3;

use crate::generate::Rng;

/// A point that is no further out is taken for enclosed, of the radius: keeps points that lie on
/// the sphere from replacing each other.
const ON_SPHERE: f64 = 1e-12;

/// A sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Its centre.
    pub centre: DVec3,
    /// Its radius; negative if there is no point.
    pub radius: f64,
}

impl Sphere {
    /// The smallest about all points; encloses them up to the rounding of one distance. Expected
    /// O(n).
    #[must_use]
    pub fn enclosing(points: &[DVec3]) -> Self {
        let mut shuffled = points.to_vec();
        let mut rng = Rng::new(0x7370_6865_7265);
        for last in (1..shuffled.len()).rev() {
            shuffled.swap(last, rng.below(last + 1));
        }
        let Self { centre, .. } = with_boundary(&shuffled, &mut Vec::with_capacity(4));
        let radius = points.iter().map(|p| p.distance(centre)).fold(-1.0, f64::max);
        Self { centre, radius }
    }

    fn excludes(&self, p: DVec3) -> bool {
        self.radius < 0.0 || p.distance(self.centre) > self.radius * (1.0 + ON_SPHERE)
    }
}

/// The smallest sphere about `points` that passes through `boundary`.
fn with_boundary(points: &[DVec3], boundary: &mut Vec<DVec3>) -> Sphere {
    let mut sphere = through(boundary);
    if boundary.len() == 4 {
        return sphere;
    }
    for (index, &p) in points.iter().enumerate() {
        if sphere.excludes(p) {
            boundary.push(p);
            sphere = with_boundary(&points[..index], boundary);
            boundary.pop();
        }
    }
    sphere
}

/// The smallest sphere that passes through up to four points.
fn through(points: &[DVec3]) -> Sphere {
    let Some((&first, others)) = points.split_first() else {
        return Sphere { centre: DVec3::ZERO, radius: -1.0 };
    };
    let arms: Vec<DVec3> = others.iter().map(|p| *p - first).collect();
    let offset = match arms[..] {
        [] => DVec3::ZERO,
        [a] => a / 2.0,
        [a, b] => {
            let normal = a.cross(b);
            (b.cross(normal) * a.length_squared() + normal.cross(a) * b.length_squared())
                / (2.0 * normal.length_squared())
        }
        [a, b, c, ..] => {
            let sum = b.cross(c) * a.length_squared()
                + c.cross(a) * b.length_squared()
                + a.cross(b) * c.length_squared();
            sum / (2.0 * a.dot(b.cross(c)))
        }
    };
    Sphere { centre: first + offset, radius: offset.length() }
}

#[cfg(test)]
mod tests {
    use super::Sphere;
    use crate::generate::Rng;
    use glam::DVec3;

    #[test]
    fn known_points_have_known_spheres() {
        let corners =
            (0..8).map(|k| DVec3::new((k & 1) as f64, (k >> 1 & 1) as f64, (k >> 2) as f64));
        let cube = Sphere::enclosing(&corners.collect::<Vec<_>>());
        assert!((cube.centre - DVec3::splat(0.5)).length() < 1e-12);
        assert!((cube.radius - 0.75f64.sqrt()).abs() < 1e-12);
        let pair = Sphere::enclosing(&[DVec3::X, DVec3::Y]);
        assert!((pair.radius - 0.5f64.sqrt()).abs() < 1e-12);
        assert_eq!(Sphere::enclosing(&[DVec3::X]).radius, 0.0);
    }

    #[test]
    fn no_direction_improves_a_smallest_sphere() {
        let mut rng = Rng::new(1991);
        for _ in 0..100 {
            let points: Vec<DVec3> = (0..60)
                .map(|_| {
                    DVec3::from_array(
                        rng.point_in([-3.0, -2.0, 5.0], [3.0, 2.0, 6.0]).map(f64::from),
                    )
                })
                .collect();
            let sphere = Sphere::enclosing(&points);
            for _ in 0..50 {
                let step = DVec3::from_array(rng.direction().map(f64::from)) * 1e-4;
                let reach =
                    points.iter().map(|p| p.distance(sphere.centre + step)).fold(0.0, f64::max);
                assert!(reach > sphere.radius);
            }
        }
    }
}
