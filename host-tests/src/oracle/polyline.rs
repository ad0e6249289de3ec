//! Distance of a point and polylines, every segment looked at, in 106 bits.

use super::distance::{Bounded, DOUBLE_ERROR, squared_to_segment};
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
        let margin = DOUBLE_ERROR * (p.minus(&from).norm_1() + to.minus(&from).norm_1());
        best.lower = best.lower.min((distance.hi.next_down() - margin).next_down().max(0.0));
        best.upper = best.upper.min((distance.hi.next_up() + margin).next_up());
    }
    best
}
