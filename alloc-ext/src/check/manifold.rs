//! A triangle mesh that changes, as a map from directed edges to the vertex opposite.

use std::collections::{HashMap, HashSet};

/// Triangles by directed edge; oriented triangles only, each edge at most once in each direction.
#[derive(Clone, Debug, Default)]
pub struct Manifold {
    /// From edge `(a, b)` to `c`, for the triangle `a b c`.
    opposite: HashMap<(u32, u32), u32>,
    /// Number of triangles at each vertex.
    valence: HashMap<u32, u32>,
}

fn edges([a, b, c]: [u32; 3]) -> [(u32, u32, u32); 3] {
    [(a, b, c), (b, c, a), (c, a, b)]
}

/// Least corner first, orientation kept.
#[must_use]
pub fn canonical([a, b, c]: [u32; 3]) -> [u32; 3] {
    if a < b && a < c {
        [a, b, c]
    } else if b < c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

impl Manifold {
    /// Adds a triangle.
    ///
    /// # Errors
    /// It has no three corners, or an edge has a triangle on this side already.
    pub fn add(&mut self, triangle: [u32; 3]) -> Result<(), String> {
        let [a, b, c] = triangle;
        if a == b || b == c || c == a {
            return Err(format!("triangle {triangle:?} repeats a corner"));
        }
        for (from, to, opposite) in edges(triangle) {
            if self.opposite.insert((from, to), opposite).is_some() {
                return Err(format!("edge ({from}, {to}) has two triangles on one side"));
            }
            *self.valence.entry(from).or_default() += 1;
        }
        Ok(())
    }

    /// Takes a triangle out.
    ///
    /// # Errors
    /// It is not there.
    pub fn remove(&mut self, triangle: [u32; 3]) -> Result<(), String> {
        for (from, to, opposite) in edges(triangle) {
            if self.opposite.remove(&(from, to)) != Some(opposite) {
                return Err(format!("triangle {triangle:?} is not there"));
            }
            if let Some(count) = self.valence.get_mut(&from) {
                *count -= 1;
            }
        }
        Ok(())
    }

    /// Triangles at a vertex.
    pub(crate) fn valence(&self, vertex: u32) -> usize {
        self.valence.get(&vertex).map_or(0, |&n| n as usize)
    }

    /// The triangles at a vertex form one closed fan that begins with the edge to `start`.
    pub(crate) fn is_disc_at(&self, vertex: u32, start: u32) -> bool {
        let (mut spoke, mut count) = (start, 0);
        loop {
            let Some(&next) = self.opposite.get(&(vertex, spoke)) else { return false };
            // The neighbour across the next spoke is on its other side.
            count += 1;
            spoke = next;
            if spoke == start || count > self.valence(vertex) {
                return spoke == start && count == self.valence(vertex);
            }
        }
    }

    /// Every edge has its other side, and every vertex one closed fan.
    ///
    /// # Errors
    /// An edge is open, or the triangles at a vertex are not one fan.
    pub fn closed_manifold(&self) -> Result<(), String> {
        if let Some((a, b)) =
            self.opposite.keys().find(|(a, b)| !self.opposite.contains_key(&(*b, *a)))
        {
            return Err(format!("edge ({a}, {b}) is open"));
        }
        let mut seen = HashSet::new();
        for &(vertex, to) in self.opposite.keys() {
            if seen.insert(vertex) && !self.is_disc_at(vertex, to) {
                return Err(format!("the triangles at vertex {vertex} are not one fan"));
            }
        }
        Ok(())
    }

    /// All triangles, least corner first, sorted.
    #[must_use]
    pub fn triangles(&self) -> Vec<[u32; 3]> {
        let mut all: Vec<[u32; 3]> = self
            .opposite
            .iter()
            .filter(|((a, b), c)| a < b && a < *c)
            .map(|(&(a, b), &c)| [a, b, c])
            .collect();
        all.sort_unstable();
        all
    }
}
