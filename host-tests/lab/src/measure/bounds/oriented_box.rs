//! Boxes along axes of their own.

use glam::{DMat3, DVec2, DVec3};

use super::convex_hull::ConvexHull;

/// Below this a product of two axes gives no direction: they are parallel, and other axes decide.
const PARALLEL: f64 = 1e-9;

/// A box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrientedBox {
    /// Its axes: columns, a rotation or a reflection.
    pub axes: DMat3,
    /// Its centre.
    pub centre: DVec3,
    /// Half its extents.
    pub half: DVec3,
}

impl OrientedBox {
    /// The tightest along given axes.
    fn along(axes: DMat3, points: &[DVec3]) -> Self {
        let local = points.iter().map(|p| axes.transpose() * *p);
        let (low, high) = local.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| {
            (low.min(p), high.max(p))
        });
        Self { axes, centre: axes * ((low + high) / 2.0), half: (high - low) / 2.0 }
    }

    /// The least volume of those with one side on a face of the hull, and another on an edge of its
    /// shadow there. The least box of all may do without a face (O'Rourke 1985), though by
    /// little.
    #[must_use]
    pub fn on_a_face(hull: &ConvexHull) -> Self {
        let mut best: Option<(f64, DMat3)> = None;
        for t in &hull.triangles {
            let [a, b, c] = t.map(|v| hull.points[v]);
            let Some(z) = (b - a).cross(c - a).try_normalize() else { continue };
            let (u, v) = z.any_orthonormal_pair();
            let heights = hull.points.iter().map(|p| z.dot(*p - a));
            let height = -heights.fold(0.0, f64::min);
            let shadow =
                outline(hull.points.iter().map(|p| DVec2::new(u.dot(*p), v.dot(*p))).collect());
            for (k, from) in shadow.iter().enumerate() {
                let Some(x) = (shadow[(k + 1) % shadow.len()] - *from).try_normalize() else {
                    continue;
                };
                let volume = height * extent(&shadow, x) * extent(&shadow, x.perp());
                if best.is_none_or(|(least, _)| volume < least) {
                    let x = u * x.x + v * x.y;
                    best = Some((volume, DMat3::from_cols(x, z.cross(x), z)));
                }
            }
        }
        Self::along(best.map_or(DMat3::IDENTITY, |(_, axes)| axes), &hull.points)
    }

    /// Its volume.
    #[must_use]
    pub fn volume(&self) -> f64 {
        8.0 * self.half.x * self.half.y * self.half.z
    }

    /// The box moved by p ↦ `rotation`·p + `shift`.
    #[must_use]
    pub fn moved(&self, rotation: DMat3, shift: DVec3) -> Self {
        Self { axes: rotation * self.axes, centre: rotation * self.centre + shift, half: self.half }
    }

    /// Whether the two share a point, by 15 separating axes (Gottschalk et al. 1996).
    #[must_use]
    pub fn meets(&self, other: &Self) -> bool {
        let columns = |b: &Self| [b.axes.x_axis, b.axes.y_axis, b.axes.z_axis];
        let (ours, theirs) = (columns(self), columns(other));
        let products = ours.iter().flat_map(|a| theirs.iter().map(|b| a.cross(*b)));
        let between = other.centre - self.centre;
        let reach = |b: &Self, axis: DVec3| b.half.dot((b.axes.transpose() * axis).abs());
        let parts = |axis: DVec3| {
            axis.length_squared() > PARALLEL * PARALLEL
                && between.dot(axis).abs() > reach(self, axis) + reach(other, axis)
        };
        !ours.into_iter().chain(theirs).chain(products).any(parts)
    }
}

fn extent(points: &[DVec2], direction: DVec2) -> f64 {
    let along = points.iter().map(|p| direction.dot(*p));
    let (low, high) =
        along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    high - low
}

/// The convex hull of points in a plane, counter-clockwise (Andrew 1979). Roundings only move a
/// box's axes.
fn outline(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let half = |points: &mut dyn Iterator<Item = &DVec2>| {
        let mut chain: Vec<DVec2> = Vec::new();
        for &p in points {
            while let [.., a, b] = chain[..]
                && (b - a).perp_dot(p - b) <= 0.0
            {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut lower = half(&mut points.iter());
    lower.extend(half(&mut points.iter().rev()));
    lower
}

#[cfg(test)]
mod tests {
    use super::{ConvexHull, OrientedBox};
    use crate::measure::bounds::pose::parry;
    use glam::{DMat3, DQuat, DVec3};
    use meshsweep_host_tests::generate::Rng;
    use meshsweep_host_tests::workload::pose::Pose;
    use meshsweep_host_tests::workload::sphere::Sphere;
    use parry3d::math::Vector;
    use parry3d::query::details::intersection_test_cuboid_cuboid;
    use parry3d::shape::Cuboid;

    fn brick() -> Vec<DVec3> {
        let sign = |k: usize, bit: usize| if k >> bit & 1 == 1 { 1.0 } else { -1.0 };
        (0..8).map(|k| DVec3::new(sign(k, 0), 2.0 * sign(k, 1), 5.0 * sign(k, 2))).collect()
    }

    #[test]
    fn a_turned_brick_is_its_own_box() {
        let turn = DMat3::from_quat(DQuat::from_xyzw(0.1, -0.5, 0.7, 0.4).normalize());
        let points: Vec<DVec3> =
            brick().iter().map(|p| turn * *p + DVec3::new(3.0, 1.0, -8.0)).collect();
        let tight = OrientedBox::on_a_face(&ConvexHull::new(&points).expect("not flat"));
        assert!((tight.volume() - 80.0).abs() < 1e-9);
        assert!((tight.centre - DVec3::new(3.0, 1.0, -8.0)).length() < 1e-9);
    }

    #[test]
    fn parry3d_agrees_where_a_hair_does_not_decide() {
        let mut rng = Rng::new(15);
        let sphere = Sphere { centre: DVec3::ZERO, radius: 3.0 };
        let (mut met, mut apart) = (0, 0);
        for _ in 0..2_000 {
            let half = DVec3::from_array(rng.point_in([0.2; 3], [2.5; 3]).map(f64::from));
            let sized = |by: f64| OrientedBox {
                axes: DMat3::IDENTITY,
                centre: DVec3::ZERO,
                half: half * by,
            };
            let pose = Pose::random(&mut rng, &sphere, 2.2);
            let meets = |by: f64| sized(by).meets(&sized(by).moved(pose.rotation, pose.shift));
            if meets(0.9999) != meets(1.0001) {
                continue;
            }
            let cuboid = Cuboid::new(Vector::from_array(half.to_array().map(|x| x as f32)));
            let wanted = intersection_test_cuboid_cuboid(&parry(&pose), &cuboid, &cuboid);
            assert_eq!(meets(1.0), wanted, "{half} {} {}", pose.rotation, pose.shift);
            *(if wanted { &mut met } else { &mut apart }) += 1;
        }
        assert!(met > 300 && apart > 300, "{met} {apart}");
    }
}
