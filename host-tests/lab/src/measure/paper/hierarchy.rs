//! A binary tree of discrete oriented polytopes (Klosowski et al. 1998), as papers 000 and 003 set
//! their own structures against.

use glam::DVec3;

use super::dop::{Dop, Slabs};

/// Bounds of elements that the caller numbers.
pub struct Hierarchy<'a> {
    slabs: &'a Slabs,
    nodes: Vec<Node>,
    elements: Vec<u32>,
}

struct Node {
    dop: Dop,
    /// The second child, where there are children; the first is the next node.
    second: Option<usize>,
    /// The node's elements.
    range: std::ops::Range<usize>,
}

impl<'a> Hierarchy<'a> {
    /// A tree over elements by their points; leaves have at most `leaf` elements. Each node is
    /// split at the mean of its elements' centres along the axis on which the centres are spread
    /// widest.
    #[must_use]
    pub fn new(slabs: &'a Slabs, points: &[Vec<DVec3>], leaf: usize) -> Self {
        let centres: Vec<DVec3> =
            points.iter().map(|of| of.iter().sum::<DVec3>() / of.len().max(1) as f64).collect();
        let mut tree =
            Self { slabs, nodes: Vec::new(), elements: (0..points.len() as u32).collect() };
        // A range, and the node whose second child it is.
        let mut open = vec![(0..points.len(), None)];
        while let Some((range, parent)) = open.pop() {
            let index = tree.nodes.len();
            if let Some(parent) = parent {
                let parent: &mut Node = &mut tree.nodes[parent];
                parent.second = Some(index);
            }
            let elements = &mut tree.elements[range.clone()];
            let all = elements.iter().flat_map(|&e| points[e as usize].iter().copied());
            tree.nodes.push(Node { dop: Dop::of(slabs, all), second: None, range: range.clone() });
            if range.len() > leaf {
                let middle = range.start + halves(elements, &centres);
                // The first child is taken next, so that it follows its parent.
                open.push((middle..range.end, Some(index)));
                open.push((range.start..middle, None));
            }
        }
        tree
    }

    /// Calls `told` for each element of the leaves whose bound meets the segment's own. Returns the
    /// number of nodes tested.
    pub fn meeting(&self, ends: [DVec3; 2], told: impl FnMut(u32)) -> u64 {
        let segment = Dop::of(self.slabs, ends.into_iter());
        self.passing(|dop| dop.meets(&segment), told)
    }

    /// As [`meeting`](Self::meeting), for the leaves whose bound the segment itself meets.
    pub fn crossed(&self, ends: [DVec3; 2], told: impl FnMut(u32)) -> u64 {
        let along = |end: DVec3| self.slabs.directions.iter().map(move |d| d.dot(end));
        let slabs: Vec<[f64; 2]> = along(ends[0])
            .zip(along(ends[1]))
            .map(|(from, to)| [from, 1.0 / (to - from)])
            .collect();
        let meets = |dop: &Dop| {
            let (mut enters, mut leaves) = (0f64, 1f64);
            for ([low, high], [from, inverse]) in dop.ranges.iter().zip(&slabs) {
                let (a, b) = ((low - from) * inverse, (high - from) * inverse);
                // A segment that does not leave a side of the slab.
                if a.is_nan() || b.is_nan() {
                    continue;
                }
                (enters, leaves) = (enters.max(a.min(b)), leaves.min(a.max(b)));
            }
            enters <= leaves
        };
        self.passing(meets, told)
    }

    fn passing(&self, passes: impl Fn(&Dop) -> bool, mut told: impl FnMut(u32)) -> u64 {
        let (mut open, mut tested) = (vec![0], 0);
        while let Some(index) = open.pop() {
            let node = &self.nodes[index];
            tested += 1;
            if passes(&node.dop) {
                match node.second {
                    Some(second) => open.extend([second, index + 1]),
                    None => self.elements[node.range.clone()].iter().for_each(|&e| told(e)),
                }
            }
        }
        tested
    }

    /// Searches the least squared distance from a point. `told` gets an element and the least so
    /// far, and lowers it. The slabs are the axes'. Returns the number of nodes tested.
    pub fn nearest(&self, point: DVec3, mut told: impl FnMut(u32, &mut f64)) -> u64 {
        let mut least = f64::INFINITY;
        let (mut open, mut tested) = (vec![(0, 0.0)], 0);
        let to = |index: usize| distance_sq(&self.nodes[index].dop, point);
        while let Some((index, bound)) = open.pop() {
            if bound >= least {
                continue;
            }
            let node = &self.nodes[index];
            let Some(second) = node.second else {
                self.elements[node.range.clone()].iter().for_each(|&e| told(e, &mut least));
                continue;
            };
            tested += 2;
            let (first, second) = ((index + 1, to(index + 1)), (second, to(second)));
            // The nearer child is taken next.
            open.extend(if first.1 < second.1 { [second, first] } else { [first, second] });
        }
        tested
    }
}

fn distance_sq(dop: &Dop, point: DVec3) -> f64 {
    let pairs = dop.ranges.iter().zip(point.to_array());
    pairs.map(|([low, high], x)| (low - x).max(x - high).max(0.0).powi(2)).sum()
}

/// Moves the elements before the mean of their centres to the front; how many they are. Equal
/// halves where the centres do not part them.
fn halves(elements: &mut [u32], centres: &[DVec3]) -> usize {
    let of = |e: u32| centres[e as usize];
    let infinite = DVec3::splat(f64::INFINITY);
    let (mut low, mut high, mut sum) = (infinite, -infinite, DVec3::ZERO);
    for &e in elements.iter() {
        (low, high, sum) = (low.min(of(e)), high.max(of(e)), sum + of(e));
    }
    let spread = (high - low).to_array();
    let axis = (0..3).max_by(|&i, &j| spread[i].total_cmp(&spread[j])).unwrap_or(0);
    let mean = sum[axis] / elements.len().max(1) as f64;
    let mut count = 0;
    for i in 0..elements.len() {
        if of(elements[i])[axis] < mean {
            elements.swap(i, count);
            count += 1;
        }
    }
    if count == 0 || count == elements.len() { elements.len() / 2 } else { count }
}
