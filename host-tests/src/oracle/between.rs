//! Distance of a mesh and a moved one, in 106 bits.
//!
//! The least of six vertices with triangles and nine pairs of edges. Edges by triple products: the
//! lines' common perpendicular if its feet are on both edges, else the nearest end.

use super::distance::{Bounded, distance_between, least_root, squared_to_segment};
use super::double::{Double, Vector};
use super::moved::{self, Place};
use meshsweep_core::Pose;

/// A mesh: its vertices and triangles.
pub type Mesh<'a> = (&'a [[f32; 3]], &'a [[u32; 3]]);

/// Distance of `a` and of `b` after `rotation`·v + `translation`. It is 0 if they meet, by exact
/// predicates. Cost: every pair of boxes, and 106 bits for the pairs that may be the nearest.
#[must_use]
pub fn distance_of_meshes(
    a: Mesh<'_>,
    b: Mesh<'_>,
    rotation: &[[f32; 3]; 3],
    translation: [f32; 3],
) -> Bounded {
    let first = corners(a, Place::of);
    let second = corners(b, |p| Place::moved(p, rotation, translation));
    let stay = corners(a, Vector::new);
    let moved = corners(b, |p| moved_place(p, rotation, translation));
    let boxes = |places: &[[Place; 3]]| {
        places.iter().map(|t| bounds(&t.each_ref().map(|p| p.near))).collect()
    };
    let mut best = Bounded { lower: f64::INFINITY, upper: f64::INFINITY };
    for (gap, i, j) in by_gap(boxes(&first), boxes(&second)) {
        if gap > best.upper {
            break;
        }
        if gap == 0.0 && moved::triangles_meet(first[i].each_ref(), second[j].each_ref()) {
            return Bounded { lower: 0.0, upper: 0.0 };
        }
        let found = distance_of_triangles(&stay[i], &moved[j]);
        best.lower = best.lower.min(found.lower);
        best.upper = best.upper.min(found.upper);
    }
    best
}

/// Distance of a triangle and of one after `rotation`·v + `translation`, if they do not meet.
#[must_use]
pub fn distance_of_moved_triangles(
    a: [[f32; 3]; 3],
    b: [[f32; 3]; 3],
    rotation: &[[f32; 3]; 3],
    translation: [f32; 3],
) -> Bounded {
    distance_of_triangles(&a.map(Vector::new), &b.map(|p| moved_place(p, rotation, translation)))
}

/// Distance of two meshes that do not meet, each moved by its own matrix and translation. Cost:
/// every pair of boxes, and 106 bits for the pairs that may be the nearest.
#[must_use]
pub fn distance_of_placed(a: (Mesh<'_>, &Pose), b: (Mesh<'_>, &Pose)) -> Bounded {
    let [first, second] = [a, b]
        .map(|(mesh, pose)| corners(mesh, |p| moved_place(p, &pose.rotation, pose.translation)));
    let near = |v: &Vector| v.0.map(|x| x.hi);
    let boxes =
        |moved: &[[Vector; 3]]| moved.iter().map(|t| bounds(&t.each_ref().map(near))).collect();
    let mut best = Bounded { lower: f64::INFINITY, upper: f64::INFINITY };
    for (gap, i, j) in by_gap(boxes(&first), boxes(&second)) {
        if gap > best.upper {
            break;
        }
        let found = distance_of_triangles(&first[i], &second[j]);
        best.lower = best.lower.min(found.lower);
        best.upper = best.upper.min(found.upper);
    }
    best
}

/// All pairs of boxes, the nearest first, each with a lower bound of its distance.
fn by_gap(boxes: Vec<Box3>, others: Vec<Box3>) -> Vec<(f64, usize, usize)> {
    let mut pairs = Vec::with_capacity(boxes.len() * others.len());
    for (i, near) in boxes.iter().enumerate() {
        pairs.extend(others.iter().enumerate().map(|(j, other)| (gap(near, other), i, j)));
    }
    pairs.sort_unstable_by(|x, y| x.0.total_cmp(&y.0));
    pairs
}

fn moved_place(p: [f32; 3], rotation: &[[f32; 3]; 3], translation: [f32; 3]) -> Vector {
    let at = Vector::new(p);
    let turned = Vector(std::array::from_fn(|k| Vector::new(rotation[k]).dot(&at)));
    turned.plus(&Vector::new(translation))
}

fn corners<T>((positions, triangles): Mesh<'_>, of: impl Fn([f32; 3]) -> T) -> Vec<[T; 3]> {
    triangles.iter().map(|t| t.map(|v| of(positions[v as usize]))).collect()
}

type Box3 = [[f64; 3]; 2];

fn bounds(t: &[[f64; 3]; 3]) -> Box3 {
    let of = |pick: fn(f64, f64) -> f64| {
        std::array::from_fn(|k| t.iter().map(|p| p[k]).reduce(pick).unwrap_or(0.0))
    };
    [of(f64::min), of(f64::max)]
}

/// A lower bound of the distance of two boxes whose coordinates were rounded.
fn gap([low, high]: &Box3, [from, to]: &Box3) -> f64 {
    let size = [low, high, from, to].into_iter().flatten().fold(0f64, |m, x| m.max(x.abs()));
    let along = |k: usize| (from[k] - high[k]).max(low[k] - to[k]).max(0.0);
    let squared: f64 = (0..3).map(|k| along(k) * along(k)).sum();
    (squared.sqrt() * (1.0 - 1e-12) - 1e-14 * size).max(0.0)
}

/// Distance of two triangles that do not meet.
fn distance_of_triangles(a: &[Vector; 3], b: &[Vector; 3]) -> Bounded {
    let mut best = Bounded { lower: f64::INFINITY, upper: f64::INFINITY };
    let mut consider = |found: Bounded| {
        best.lower = best.lower.min(found.lower);
        best.upper = best.upper.min(found.upper);
    };
    a.iter().for_each(|p| consider(distance_between(p, b)));
    b.iter().for_each(|p| consider(distance_between(p, a)));
    for i in 0..3 {
        for j in 0..3 {
            consider(distance_of_edges([&a[i], &a[(i + 1) % 3]], [&b[j], &b[(j + 1) % 3]]));
        }
    }
    best
}

fn distance_of_edges([from, to]: [&Vector; 2], [start, end]: [&Vector; 2]) -> Bounded {
    let (d, e, way) = (to.minus(from), end.minus(start), start.minus(from));
    let size = d.norm_1() + e.norm_1() + way.norm_1();
    let across = d.cross(&e);
    let squared = across.dot(&across);
    let is_part = |x: Double| !(-x).is_positive() && !(x - Double::ONE).is_positive();
    let over = squared.is_positive()
        && is_part(way.cross(&e).dot(&across) / squared)
        && is_part(way.cross(&d).dot(&across) / squared);
    let distance = if over {
        let height = way.dot(&across) / squared.sqrt();
        if height.is_positive() { height } else { -height }
    } else {
        let ends = [(from, start, end), (to, start, end), (start, from, to), (end, from, to)];
        least_root(ends.map(|(p, from, to)| squared_to_segment(p, from, to)))
    };
    Bounded::about(distance, size)
}

#[cfg(test)]
mod tests {
    use super::distance_of_meshes;
    use crate::generate::corpus::IDENTITY;

    #[test]
    fn vertices_faces_edges_and_contact() {
        let flat = vec![[0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
        let spike = vec![[1.0, 1.0, 1.0], [1.5, 1.0, 3.0], [1.0, 1.5, 3.0]];
        let across = vec![[-1.0, 2.0, 2.0], [5.0, 2.0, 2.0], [2.0, 2.0, 9.0]];
        let one = [[0, 1, 2]];
        for (b, by, expected) in [
            (&spike, [0.0; 3], 1.0),
            (&spike, [0.0, 0.0, -2.0], 0.0),
            (&spike, [3.0, -5.0, 0.0], 17f64.sqrt()),
            (&across, [0.0; 3], 2.0),
            (&flat, [0.0, 0.0, 7.0], 7.0),
            (&flat, [5.0, 5.0, 0.0], 18f64.sqrt()),
        ] {
            for (x, y, by) in [(&flat, b, by), (b, &flat, by.map(|x: f32| -x))] {
                let d = distance_of_meshes((x, &one), (y, &one), &IDENTITY, by);
                let inside = d.lower <= expected && expected <= d.upper;
                assert!(inside && d.upper - d.lower < 1e-14, "{b:?} {by:?} {d:?} {expected}");
            }
        }
    }
}
