//! The order of the seeds.

use super::FanLeaf;
use super::adjacency::Adjacency;
use super::remaining::{Remaining, neighbours};
use std::collections::VecDeque;

/// Remaining triangles by their number of remaining neighbours, oldest first. An entry is stale if
/// the number has changed.
#[derive(Default)]
pub(super) struct Front {
    queues: [VecDeque<u32>; 4],
}

impl Front {
    pub(super) fn push(&mut self, triangle: u32, degree: usize) {
        self.queues[degree].push_back(triangle);
    }

    /// Takes a leaf's triangles, and puts their neighbours into the queues of their new degrees.
    pub(super) fn take(
        &mut self,
        leaf: &FanLeaf,
        adjacency: &Adjacency,
        remaining: &mut Remaining,
    ) {
        leaf.triangles().for_each(|t| remaining.take(adjacency, t));
        for neighbour in leaf.triangles().flat_map(|t| neighbours(adjacency, t)) {
            if remaining.has(neighbour) {
                self.push(neighbour, remaining.degree(neighbour));
            }
        }
    }

    pub(super) fn pop(&mut self, remaining: &Remaining) -> Option<u32> {
        let degree = self.lowest(remaining)?;
        self.queues[degree].pop_front()
    }

    /// The number of neighbours of the next triangle. Drops stale entries before it.
    fn lowest(&mut self, remaining: &Remaining) -> Option<usize> {
        (0..4).find(|&degree| {
            let queue = &mut self.queues[degree];
            while let Some(&triangle) = queue.front() {
                if remaining.has(triangle) && remaining.degree(triangle) == degree {
                    return true;
                }
                queue.pop_front();
            }
            false
        })
    }
}
