//! Triangles of a mesh and of a moved one, compared exactly: every coordinate is a sum of products
//! of floats, without rounding.
//!
//! Separating axes (Gottschalk 1996): two triangles are disjoint exactly if along a normal, a
//! product of two edges, or a normal's product with an edge one lies before the other. Doubles
//! decide where they can, with a margin of a thousand roundings; else integers do.

use meshsweep::check::dyadic::Dyadic;
use meshsweep::check::vector::{Number, cross, dot, minus};

/// A place, and the same rounded.
#[derive(Clone, Debug)]
pub struct Place {
    exact: [Dyadic; 3],
    /// Rounded to f64.
    pub near: [f64; 3],
}

impl Place {
    /// A vertex where it is.
    #[must_use]
    pub fn of(p: [f32; 3]) -> Place {
        Place { exact: p.map(|x| Dyadic::from(f64::from(x))), near: p.map(f64::from) }
    }

    /// A vertex at `rotation`·p + `translation`.
    #[must_use]
    pub fn moved(p: [f32; 3], rotation: &[[f32; 3]; 3], translation: [f32; 3]) -> Place {
        let number = |x: f32| Dyadic::from(f64::from(x));
        let p = p.map(number);
        let exact: [Dyadic; 3] =
            std::array::from_fn(|k| &dot(&rotation[k].map(number), &p) + &number(translation[k]));
        let near = exact.each_ref().map(Dyadic::rounded);
        Place { exact, near }
    }
}

/// All axes that can part two triangles of which each has an area, or is a segment.
fn axes<T: Number + Clone>(a: &[[T; 3]; 3], b: &[[T; 3]; 3]) -> Vec<[T; 3]> {
    let edges = |t: &[[T; 3]; 3]| [minus(&t[1], &t[0]), minus(&t[2], &t[1]), minus(&t[0], &t[2])];
    let (e, f) = (edges(a), edges(b));
    let (n, m) = (cross(&e[0], &e[1]), cross(&f[0], &f[1]));
    let mut axes = vec![n.clone(), m.clone()];
    for x in &e {
        axes.extend(f.iter().map(|y| cross(x, y)));
        axes.extend([cross(&n, x), cross(&m, x)]);
    }
    axes.extend(f.iter().flat_map(|y| [cross(&m, y), cross(&n, y)]));
    axes
}

/// By how much the one triangle lies before the other along an axis, and what that may be off by;
/// negative if it does not.
fn gap(axis: &[f64; 3], a: &[[f64; 3]; 3], b: &[[f64; 3]; 3], margin: f64) -> (f64, f64) {
    let along = |p: &[f64; 3]| dot(axis, p);
    let range = |t: &[[f64; 3]; 3]| {
        let [x, y, z] = t.each_ref().map(along);
        (x.min(y).min(z), x.max(y).max(z))
    };
    let ((a_low, a_high), (b_low, b_high)) = (range(a), range(b));
    ((b_low - a_high).max(a_low - b_high), margin)
}

/// Whether two closed triangles have a common point. Exact. Each must have an area, or the other
/// must and it be a segment.
#[must_use]
pub fn triangles_meet(a: [&Place; 3], b: [&Place; 3]) -> bool {
    // From a vertex, so that the margin is that of the triangles' size and of the coordinates' own
    // rounding.
    let origin = a[0].near;
    let local = |t: [&Place; 3]| t.map(|p| minus(&p.near, &origin));
    let (p, q) = (local(a), local(b));
    let largest = |t: &[[f64; 3]; 3]| t.iter().flatten().fold(0f64, |m, x| m.max(x.abs()));
    let size = largest(&p).max(largest(&q));
    let far = a.iter().chain(&b).flat_map(|p| p.near).fold(0f64, |m, x| m.max(x.abs()));
    // Axes are of second degree in lengths, or of third, so that what `near` was rounded by counts
    // as often.
    let (second, third) = (size * size, size * size * size);
    let mut open = false;
    for (number, axis) in axes(&p, &q).iter().enumerate() {
        let is_third = number >= 2 && (number >= 17 || (number - 2) % 5 >= 3);
        let length = if is_third { third } else { second };
        let margin = 1e-12 * (length * (size + far)) + f64::MIN_POSITIVE;
        let (gap, margin) = gap(axis, &p, &q, margin);
        if gap > margin {
            return false;
        }
        open |= gap >= -margin;
    }
    if !open {
        return true;
    }
    let exact = |t: [&Place; 3]| t.map(|p| p.exact.clone());
    let (p, q) = (exact(a), exact(b));
    !axes(&p, &q).iter().any(|axis| {
        let along = |p: &[Dyadic; 3]| dot(axis, p);
        let before = |x: &[[Dyadic; 3]; 3], y: &[[Dyadic; 3]; 3]| {
            let beyond = y.each_ref().map(along);
            x.each_ref().map(along).iter().all(|x| beyond.iter().all(|y| x < y))
        };
        before(&p, &q) || before(&q, &p)
    })
}

/// All pairs of triangles of two meshes that meet, by number. Cost: every pair of boxes.
#[must_use]
pub fn meeting_pairs(a: &[[Place; 3]], b: &[[Place; 3]]) -> Vec<[u32; 2]> {
    let bounds = |t: &[Place; 3]| {
        let of = |pick: fn(f64, f64) -> f64| {
            let corner: [f64; 3] =
                std::array::from_fn(|k| t.iter().map(|p| p.near[k]).reduce(pick).unwrap_or(0.0));
            corner
        };
        (of(f64::min), of(f64::max))
    };
    let boxes: Vec<_> = b.iter().map(bounds).collect();
    let mut pairs = Vec::new();
    for (i, t) in a.iter().enumerate() {
        let (low, high) = bounds(t);
        for (j, (from, to)) in boxes.iter().enumerate() {
            let is_near = (0..3).all(|k| {
                let doubt = 1e-15 * (low[k].abs() + high[k].abs() + from[k].abs() + to[k].abs());
                from[k] <= high[k] + doubt && low[k] <= to[k] + doubt
            });
            if is_near && triangles_meet(t.each_ref(), b[j].each_ref()) {
                pairs.push([i as u32, j as u32]);
            }
        }
    }
    pairs
}

#[cfg(test)]
mod tests {
    use super::{Place, triangles_meet};

    const ID: [[f32; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    const FLAT: [[f32; 3]; 3] = [[0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];

    fn meet(t: [[f32; 3]; 3], by: [f32; 3]) -> bool {
        let (a, b) = (FLAT.map(Place::of), t.map(|p| Place::moved(p, &ID, by)));
        let (forth, back) = (
            triangles_meet(a.each_ref(), b.each_ref()),
            triangles_meet(b.each_ref(), a.each_ref()),
        );
        assert_eq!(forth, back);
        forth
    }

    #[test]
    fn touching_counts_and_the_smallest_gap_does_not() {
        let spike = [[1.0, 1.0, 0.0], [2.0, 1.0, 2.0], [1.0, 2.0, 2.0]];
        assert!(meet(spike, [0.0; 3]));
        assert!(!meet(spike, [0.0, 0.0, 1e-30]));
        assert!(meet(spike, [0.0, 0.0, -1e-30]));
        assert!(meet(FLAT, [4.0, 0.0, 0.0]), "one vertex");
        assert!(!meet(FLAT, [4.0, 1e-30, 0.0]));
        assert!(meet(FLAT, [2.0, 2.0, 0.0]), "an edge");
        assert!(!meet(FLAT, [2.0, 2.0, 1e-38]));
        assert!(!meet(FLAT, [2.000_000_2, 2.0, 0.0]));
        let beyond = [[3.0, 3.0, -1.0], [4.0, 3.0, -1.0], [3.0, 4.0, 1.0]];
        assert!(!meet(beyond, [0.0; 3]), "it passes the plane beyond an edge");
        assert!(meet(beyond, [-2.0, -2.0, 0.0]));
    }
}
