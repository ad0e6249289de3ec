//! No index: every triangle, one after the other, in f32.

use std::mem::size_of;

use glam::Vec3;
use meshsweep_host_tests::workload::Subject;

use super::engine::{Answer, Engine, each};
use super::{Scope, Workload};

/// Triangles tested in one workload: a quarter of a second.
const TESTS: usize = 20_000_000;

/// Corner `a`, edges `ab` and `ac`.
struct Scalar(Vec<[Vec3; 3]>);

/// On every mesh.
///
/// # Errors
/// None.
pub fn build<'a>(
    subject: &Subject,
    _: &Scope,
    _: &'a mut Vec<u8>,
) -> Result<Option<Box<dyn Engine + 'a>>, String> {
    let at = |v: u32| Vec3::from_array(subject.mesh.positions[v as usize]);
    let triangles = subject.mesh.triangles.iter();
    let triangles = triangles.map(|&[a, b, c]| [at(a), at(b) - at(a), at(c) - at(a)]).collect();
    Ok(Some(Box::new(Scalar(triangles))))
}

impl Engine for Scalar {
    fn bytes(&self) -> usize {
        self.0.len() * size_of::<[Vec3; 3]>()
    }

    fn limit(&self, _: Workload) -> usize {
        (TESTS / self.0.len().max(1)).clamp(8, 1000)
    }

    fn closest(&mut self, points: &[[f32; 3]], answers: &mut Vec<Answer>) -> Result<(), String> {
        each(points, answers, |point| {
            let p = Vec3::from_array(point);
            let least = self
                .0
                .iter()
                .map(|triangle| distance_sq(p, triangle))
                .fold(f32::INFINITY, f32::min);
            Answer::Distance(least.sqrt())
        });
        Ok(())
    }

    fn first_hits(
        &mut self,
        segments: &[[[f32; 3]; 2]],
        answers: &mut Vec<Answer>,
    ) -> Result<(), String> {
        each(segments, answers, |[a, b]| {
            let (from, direction) =
                (Vec3::from_array(a), Vec3::from_array(b) - Vec3::from_array(a));
            let first = self.0.iter().map(|triangle| meet(from, direction, triangle));
            let first = first.fold(f32::INFINITY, f32::min);
            if first.is_finite() { Answer::Hit(first) } else { Answer::Miss }
        });
        Ok(())
    }
}

/// Squared distance by the regions of Ericson, *Real-Time Collision Detection* (2005), 5.1.5, as
/// the residual's length.
#[inline]
fn distance_sq(p: Vec3, &[a, ab, ac]: &[Vec3; 3]) -> f32 {
    let ap = p - a;
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    let (aa, bb, cc) = (ab.dot(ab), ab.dot(ac), ac.dot(ac));
    let (d3, d4, d5, d6) = (d1 - aa, d2 - bb, d1 - bb, d2 - cc);
    let (va, vb, vc) = (d3 * d6 - d5 * d4, d5 * d2 - d1 * d6, d1 * d4 - d3 * d2);
    let (u, v) = if d1 <= 0.0 && d2 <= 0.0 {
        (0.0, 0.0)
    } else if d3 >= 0.0 && d4 <= d3 {
        (1.0, 0.0)
    } else if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        (d1 / aa, 0.0)
    } else if d6 >= 0.0 && d5 <= d6 {
        (0.0, 1.0)
    } else if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        (0.0, d2 / cc)
    } else if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        let w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        (1.0 - w, w)
    } else {
        let scale = 1.0 / (va + vb + vc);
        (vb * scale, vc * scale)
    };
    (ap - ab * u - ac * v).length_squared()
}

/// Parameter at which a segment meets a triangle (Möller & Trumbore 1997), infinity where it does
/// not.
#[inline]
fn meet(from: Vec3, direction: Vec3, &[a, ab, ac]: &[Vec3; 3]) -> f32 {
    let p = direction.cross(ac);
    let inverse = 1.0 / ab.dot(p);
    let s = from - a;
    let u = s.dot(p) * inverse;
    let q = s.cross(ab);
    let v = direction.dot(q) * inverse;
    let t = ac.dot(q) * inverse;
    // A determinant of zero makes these NaN or infinite, and the comparisons false.
    if u >= 0.0 && v >= 0.0 && u + v <= 1.0 && (0.0..=1.0).contains(&t) { t } else { f32::INFINITY }
}

#[cfg(test)]
mod tests {
    use super::{distance_sq, meet};
    use glam::Vec3;

    const TRIANGLE: [Vec3; 3] = [Vec3::ZERO, Vec3::X, Vec3::Y];

    #[test]
    fn the_closest_feature_is_the_regions() {
        let above = |x, y| distance_sq(Vec3::new(x, y, 2.0), &TRIANGLE);
        assert_eq!(above(0.25, 0.25), 4.0);
        assert_eq!(above(-3.0, -4.0), 29.0);
        assert_eq!(above(2.0, 0.0), 5.0);
        assert_eq!(above(0.5, -1.0), 5.0);
        assert_eq!(above(1.0, 1.0), 4.5);
    }

    #[test]
    fn a_segment_meets_the_triangle_from_either_side() {
        let (high, low) = (Vec3::new(0.25, 0.25, 1.0), Vec3::new(0.25, 0.25, -3.0));
        assert_eq!(meet(high, low - high, &TRIANGLE), 0.25);
        assert_eq!(meet(low, high - low, &TRIANGLE), 0.75);
        assert_eq!(meet(high + Vec3::X, low - high, &TRIANGLE), f32::INFINITY);
        assert_eq!(meet(high, Vec3::X, &TRIANGLE), f32::INFINITY);
    }
}
