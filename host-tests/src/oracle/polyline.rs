//! Distance of a point and polylines, every segment looked at, in 106 bits.

use super::distance::{Bounded, squared_to_segment};
use super::double::{Double, Vector};

/// Distance of `p` and the nearest of the segments `from to`; infinite if there is none.
#[must_use]
pub fn distance_to_segments(
    p: [f32; 3],
    segments: impl IntoIterator<Item = [[f64; 3]; 2]>,
) -> Bounded {
    let p = Vector::new(p);
    let mut best = Bounded { lower: f64::INFINITY, upper: f64::INFINITY };
    for ends in segments {
        let [from, to] = ends.map(|end| Vector(end.map(Double::new)));
        let distance = squared_to_segment(&p, &from, &to).sqrt();
        let found = Bounded::about(distance, p.minus(&from).norm_1() + to.minus(&from).norm_1());
        best.lower = best.lower.min(found.lower);
        best.upper = best.upper.min(found.upper);
    }
    best
}
