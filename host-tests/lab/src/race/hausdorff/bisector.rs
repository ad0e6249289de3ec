//! Meshsweeper's way: vertices in a spiral, and bounds from bisectors.
//!
//! Guéziec, *"Meshsweeper": From Closest Point to Hausdorff Distances Between Meshes* (2000),
//! section 6. The vertices are visited along a path that winds around a pivot, so that a coherent
//! query answers. A triangle is bounded by the closest points of its corners alone: by the largest
//! distance of its points from the nearest of the three. That distance is attained at a corner,
//! where a bisector plane of two closest points crosses an edge, or where two bisector planes cross
//! in the triangle (figure 9).

use arrayvec::ArrayVec;
use glam::DVec3;

use super::samples::{Sample, Sampler};

/// A triangle that planes have cut: each plane adds at most one corner.
type Polygon = ArrayVec<DVec3, 8>;

/// Samples of all points, in their order.
///
/// # Errors
/// None but a fault of the tree.
pub fn visit(
    points: &[DVec3],
    triangles: &[[u32; 3]],
    sampler: &mut Sampler<'_>,
) -> Result<Vec<Sample>, String> {
    let mut samples: Vec<Option<Sample>> = vec![None; points.len()];
    for v in spiral(points.len(), triangles) {
        samples[v as usize] = Some(sampler.sample_along(points[v as usize])?);
    }
    samples.into_iter().collect::<Option<_>>().ok_or_else(|| "a vertex was left out".to_owned())
}

/// Upper bound of the distance of a triangle's points: the largest of the three parts' bounds. Each
/// part is nearest to one of the feet.
pub fn bound(samples: [&Sample; 3]) -> f64 {
    let feet = samples.map(|sample| sample.foot);
    (0..3).map(|own| part_bound(samples.map(|s| s.point), feet, own)).fold(0.0, f64::max)
}

/// Two halves of a triangle: the new points, and the parts. 0 to 2 are the corners, from 3 on the
/// new points. Each new sample is shared.
pub fn cut([a, b, c]: [DVec3; 3]) -> (Vec<DVec3>, Vec<[usize; 3]>) {
    let lengths = [a - b, b - c, c - a].map(DVec3::length_squared);
    let longest = (0..3).max_by(|&i, &k| lengths[i].total_cmp(&lengths[k])).unwrap_or(0);
    let [p, q, r] = [0, 1, 2].map(|k| (longest + k) % 3);
    let middle = ([a, b, c][p] + [a, b, c][q]) * 0.5;
    (vec![middle], vec![[p, 3, r], [3, q, r]])
}

/// Largest distance from the foot `own`, of the part of a triangle that is nearest to it.
fn part_bound(corners: [DVec3; 3], feet: [DVec3; 3], own: usize) -> f64 {
    let mut polygon = Polygon::from_iter(corners);
    for other in (0..3).filter(|&other| feet[other] != feet[own]) {
        // Of two feet the first one fixes the sign, so that both parts end at the same points.
        let [first, second] = [own.min(other), own.max(other)];
        let across = feet[second] - feet[first];
        let middle = (feet[first] + feet[second]) * 0.5;
        let side = if own == first { -1.0 } else { 1.0 };
        polygon = kept(&polygon, |p| side * across.dot(p - middle));
    }
    polygon.iter().map(|p| (*p - feet[own]).length()).fold(0.0, f64::max)
}

/// The part of a convex polygon where `height` is not negative.
fn kept(polygon: &Polygon, height: impl Fn(DVec3) -> f64) -> Polygon {
    let mut part = Polygon::new();
    for (number, &p) in polygon.iter().enumerate() {
        let q = polygon[(number + 1) % polygon.len()];
        let (high, low) = (height(p), height(q));
        if high >= 0.0 {
            part.push(p);
        }
        if (high > 0.0) != (low > 0.0) && high != low {
            part.push(p + (q - p) * (high / (high - low)).clamp(0.0, 1.0));
        }
    }
    part
}

/// All vertices, each connected component in a spiral: the neighbours of a pivot in turn, then of
/// the first of those neighbours, and so on. Vertices of no triangle come last.
pub fn spiral(vertices: usize, triangles: &[[u32; 3]]) -> Vec<u32> {
    // For each vertex its triangles as the edges opposite to it.
    let mut around: Vec<Vec<[u32; 2]>> = vec![Vec::new(); vertices];
    for &[a, b, c] in triangles {
        for [pivot, from, to] in [[a, b, c], [b, c, a], [c, a, b]] {
            around[pivot as usize].push([from, to]);
        }
    }
    let mut order: Vec<u32> = Vec::with_capacity(vertices);
    let mut is_visited = vec![false; vertices];
    let starts = |is_used: bool| {
        let around = &around;
        (0..vertices as u32).filter(move |&v| around[v as usize].is_empty() != is_used)
    };
    for start in starts(true).chain(starts(false)) {
        if std::mem::replace(&mut is_visited[start as usize], true) {
            continue;
        }
        let mut pivot = order.len();
        order.push(start);
        while let Some(&centre) = order.get(pivot) {
            let last = order[order.len() - 1];
            for v in ring(&around[centre as usize], last) {
                if !std::mem::replace(&mut is_visited[v as usize], true) {
                    order.push(v);
                }
            }
            pivot += 1;
        }
    }
    order
}

/// The vertices around a pivot in turn, from `first` on if it is among them. Where the triangles
/// around the pivot do not form one ring, the walk goes on at the next triangle that is left.
fn ring(edges: &[[u32; 2]], first: u32) -> Vec<u32> {
    let mut left: Vec<[u32; 2]> = edges.to_vec();
    let mut ring = Vec::with_capacity(2 * edges.len());
    let mut at = first;
    while !left.is_empty() {
        let next = left.iter().position(|&[from, _]| from == at).unwrap_or(0);
        let [from, to] = left.swap_remove(next);
        ring.extend([from, to]);
        at = to;
    }
    ring
}

#[cfg(test)]
mod tests {
    use super::spiral;
    use meshsweep_host_tests::generate::torus;

    #[test]
    fn a_spiral_visits_every_vertex_once_and_mostly_neighbours() {
        let (positions, triangles) = torus(2.0, 0.5, 24, 12);
        let order = spiral(positions.len() + 1, &triangles);
        let mut sorted = order.clone();
        sorted.sort_unstable();
        assert_eq!(sorted, (0..=positions.len() as u32).collect::<Vec<_>>());
        let is_edge = |pair: &&[u32]| {
            triangles.iter().any(|corners| pair.iter().all(|vertex| corners.contains(vertex)))
        };
        let steps = order.windows(2).filter(is_edge).count();
        assert!(steps * 4 > order.len() * 3, "{steps} of {}", order.len());
    }
}
