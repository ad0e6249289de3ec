//! How far a tribox reaches beyond the convex hull of the mesh in it.
//!
//! The part of the mesh in a tribox is no less than what the builder split off for it. So the hull
//! of that part is no smaller, and the distance is no larger than that which is stated. Of a solid
//! the part's inside counts: its hull is that of the surface in the tribox and of the tribox's
//! corners that lie inside.

use super::parse::Slabs;
use super::shape::{Shape, inside};
use crate::check::distance::ROUNDING;
use crate::check::enclosure::Winding;
use glam::DVec3;

/// Steps towards the nearest point of a hull.
const STEPS: usize = 1000;

/// Whether a distance is what is stated.
pub(super) enum Reach {
    Within,
    /// A corner is farther.
    Beyond(DVec3, f64),
    /// Steps ran out.
    Undecided,
}

/// What a claim is proved of, grid units.
pub(super) struct Content<'a> {
    pub(super) mesh: &'a [[DVec3; 3]],
    /// Of a solid.
    pub(super) winding: Option<&'a Winding>,
    /// What a coordinate may be off.
    pub(super) doubt: f64,
}

impl Content<'_> {
    /// The triangles, of some, that may meet a tribox.
    pub(super) fn near(&self, slabs: &Slabs, of: &[u32]) -> Vec<u32> {
        let meets = |&number: &u32| {
            let corners = &self.mesh[number as usize];
            (0..3).all(|k| {
                corners.iter().any(|p| p[k] >= slabs[k][0] - self.doubt)
                    && corners.iter().any(|p| p[k] <= slabs[k][1] + self.doubt)
            })
        };
        of.iter().copied().filter(meets).collect()
    }

    /// Whether no point of a tribox is farther than `limit` from the convex hull of what it holds
    /// of these triangles.
    pub(super) fn reach(&self, slabs: &Slabs, of: &[u32], limit: f64) -> Reach {
        let most = limit * ROUNDING + self.doubt;
        let parts = of.iter().map(|&number| inside(&self.mesh[number as usize], slabs, self.doubt));
        let mut held: Vec<DVec3> = parts.flatten().collect();
        let mut corners = Shape::of(slabs).corners;
        corners.sort_by(|a, b| {
            a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z))
        });
        corners.dedup_by(|a, b| a.distance(*b) <= self.doubt);
        let far = |held: &[DVec3]| {
            corners
                .iter()
                .map(|&corner| away(corner, held, most))
                .find(|of| !matches!(of, Reach::Within))
        };
        let Some(first) = far(&held) else { return Reach::Within };
        let Some(winding) = self.winding else { return first };
        // A corner on a face is on the surface, and so inside.
        let is_inside = |p: &&DVec3| winding.around(p.to_array()) != Ok(0);
        held.extend(corners.iter().filter(is_inside));
        far(&held).unwrap_or(Reach::Within)
    }
}

/// Whether a point is within `most` of the convex hull of others: a point of the hull is found that
/// is so near, or a plane that parts the hull from all that is so near.
fn away(from: DVec3, held: &[DVec3], most: f64) -> Reach {
    let Some(&first) = held.first() else { return Reach::Beyond(from, f64::INFINITY) };
    let mut simplex = vec![first - from];
    let mut near = simplex[0];
    for _ in 0..STEPS {
        let length = near.length();
        if length <= most {
            return Reach::Within;
        }
        let along = |p: &DVec3| near.dot(*p - from);
        let Some(&support) = held.iter().min_by(|a, b| along(a).total_cmp(&along(b))) else {
            break;
        };
        if along(&support) > most * length {
            return Reach::Beyond(from, length);
        }
        simplex.push(support - from);
        let next = nearest(&mut simplex);
        if next.length() >= length {
            // The support is on the plane already: nothing is nearer.
            return if length > most * (1.0 + 1e-9) {
                Reach::Beyond(from, length)
            } else {
                Reach::Undecided
            };
        }
        near = next;
    }
    Reach::Undecided
}

/// The point of a simplex of up to four corners, or five where rounding left four, that is nearest
/// to the origin. Leaves the corners of the face that it lies in.
fn nearest(simplex: &mut Vec<DVec3>) -> DVec3 {
    let mut best: Option<(DVec3, Vec<DVec3>)> = None;
    for face in 1u32..1 << simplex.len() {
        let corners: Vec<DVec3> =
            (0..simplex.len()).filter(|k| face >> k & 1 == 1).map(|k| simplex[k]).collect();
        let Some(foot) = foot(&corners) else { continue };
        if best.as_ref().is_none_or(|(least, _)| foot.length_squared() < least.length_squared()) {
            best = Some((foot, corners));
        }
    }
    match best {
        Some((foot, corners)) => {
            *simplex = corners;
            foot
        }
        None => DVec3::INFINITY,
    }
}

/// The point of the plane through some corners that is nearest to the origin, if it lies between
/// them.
fn foot(corners: &[DVec3]) -> Option<DVec3> {
    let (&a, others) = corners.split_first()?;
    let ways: Vec<DVec3> = others.iter().map(|&p| p - a).collect();
    let parts: Vec<f64> = match ways[..] {
        [] => vec![],
        [u] => vec![-a.dot(u) / u.length_squared()],
        [u, v] => {
            let normal = u.cross(v);
            let square = normal.length_squared();
            vec![v.cross(a).dot(normal) / square, a.cross(u).dot(normal) / square]
        }
        [u, v, w] => {
            let volume = u.dot(v.cross(w));
            let of = |p: DVec3, q: DVec3| -a.dot(p.cross(q)) / volume;
            vec![of(v, w), of(w, u), of(u, v)]
        }
        _ => return None,
    };
    let is_between = parts.iter().all(|&part| part >= 0.0) && parts.iter().sum::<f64>() <= 1.0;
    is_between.then(|| parts.iter().zip(ways).fold(a, |at, (&part, way)| at + way * part))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_corner_is_as_far_from_a_hull_as_from_its_face_edge_or_corner() {
        let corner =
            |i: u32| DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2));
        let cube: Vec<DVec3> = (0..8).map(corner).collect();
        for (from, distance) in [
            ([0.3, 0.6, 2.0], 1.0),
            ([-3.0, 0.5, 5.0], 5.0),
            ([3.0, 2.0, -2.0], 3.0),
            ([0.5, 0.25, 0.75], 0.0),
        ] {
            let from = DVec3::from(from);
            assert!(matches!(away(from, &cube, distance + 1e-13), Reach::Within), "{from}");
            if distance > 0.0 {
                let less = distance * (1.0 - 1e-6);
                assert!(matches!(away(from, &cube, less), Reach::Beyond(..)), "{from}");
            }
        }
    }
}
