//! The section of triboxes read anew.

use super::turn::Turn;
use crate::check::bytes::{Cursor, check_header, header_word, section};

/// Normals of the slabs, in the order of the format.
pub(super) const NORMALS: [[f64; 3]; 9] = [
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, 1.0, 0.0],
    [1.0, -1.0, 0.0],
    [0.0, 1.0, 1.0],
    [0.0, 1.0, -1.0],
    [1.0, 0.0, 1.0],
    [-1.0, 0.0, 1.0],
];

/// A tribox in grid units: the least and the greatest product with each normal. Integers.
pub(super) type Slabs = [[f64; 2]; 9];

/// A record of the level table.
#[derive(Clone, Copy, Debug)]
pub(super) struct Level {
    pub(super) triboxes: usize,
    /// Claimed greatest distance of the boundary from the mesh, local frame.
    pub(super) distance: f64,
    /// Claimed greatest hull error of its nodes, local frame.
    pub(super) error: f64,
    /// Volumes over that of the solid, less 1.
    pub(super) void_ratio: f64,
}

/// All that the section holds.
pub(super) struct Triboxes {
    pub(super) scale_exponent: i32,
    pub(super) grid_exponent: i32,
    /// The union holds the inside too.
    pub(super) is_solid: bool,
    /// What turns the mesh to the frame of the triboxes.
    pub(super) turn: Option<Turn>,
    /// Levels.
    pub(super) levels: Vec<Level>,
    /// The node that each split splits.
    splits: Vec<usize>,
    /// Parameters, and the split of each node.
    nodes: Vec<(Slabs, Option<usize>)>,
    /// Claimed distance of each node's points from the convex hull of what it holds, local frame.
    errors: Vec<f64>,
    depth: usize,
}

impl Triboxes {
    pub(super) fn parse(bytes: &[u8]) -> Result<Self, String> {
        check_header(bytes)?;
        let mut cursor = Cursor(section(bytes, 19, "triboxes")?, "triboxes");
        let flags = cursor.uint(4)?;
        let grid_exponent = cursor.uint(4)?.cast_signed();
        let origin =
            [cursor.uint(4)?, cursor.uint(4)?, cursor.uint(4)?].map(|x| f64::from(x.cast_signed()));
        let [count, levels, depth] = [cursor.uint(4)?, cursor.uint(4)?, cursor.uint(4)?];
        let mut turn = None;
        if flags & 2 != 0 {
            let mut rows = [[0.0; 3]; 3];
            for entry in rows.iter_mut().flatten() {
                *entry = f64::from(cursor.float()?);
            }
            turn = Some(Turn::new(rows)?);
        }
        let mut read_levels = Vec::new();
        for _ in 0..levels {
            read_levels.push(Level {
                triboxes: cursor.uint(4)? as usize,
                distance: f64::from(cursor.float()?),
                error: f64::from(cursor.float()?),
                void_ratio: f64::from(cursor.float()?),
            });
        }
        let splits = (1..count).step_by(2).map(|_| cursor.uint(2).map(|node| node as usize));
        let splits = splits.collect::<Result<Vec<_>, _>>()?;
        let (mut nodes, mut errors) = (Vec::new(), Vec::new());
        for _ in 0..count {
            let mut slabs = Slabs::default();
            for (slab, normal) in slabs.iter_mut().zip(NORMALS) {
                let offset: f64 = (0..3).map(|k| normal[k] * origin[k]).sum();
                for end in slab {
                    *end = f64::from((cursor.uint(2)? as u16).cast_signed()) + offset;
                }
            }
            let split = Some(cursor.uint(2)? as usize).filter(|&split| split != 0xFFFF);
            // The upper half of an f32.
            errors.push(f64::from(f32::from_bits(cursor.uint(2)? << 16)));
            nodes.push((slabs, split));
        }
        cursor.end()?;
        Ok(Self {
            scale_exponent: header_word(bytes, 28)?.cast_signed(),
            grid_exponent,
            is_solid: flags & 1 != 0,
            turn,
            levels: read_levels,
            splits,
            nodes,
            errors,
            depth: depth as usize,
        })
    }

    /// Splits and nodes name each other, children are within their parents, and the last level has
    /// all nodes.
    pub(super) fn tree(&self) -> Result<(), String> {
        if self.nodes.len() != 2 * self.splits.len() + 1 {
            return Err(format!("{} nodes of {} splits", self.nodes.len(), self.splits.len()));
        }
        let mut depth = vec![0; self.nodes.len()];
        for (split, &parent) in self.splits.iter().enumerate() {
            if parent > 2 * split || self.nodes[parent].1 != Some(split) {
                return Err(format!("split {split} is not that of node {parent}"));
            }
            for child in [2 * split + 1, 2 * split + 2] {
                depth[child] = depth[parent] + 1;
                let both = self.nodes[child].0.iter().zip(&self.nodes[parent].0);
                if both.into_iter().any(|(inner, outer)| {
                    inner[0] < outer[0] || inner[1] > outer[1] || inner[0] > inner[1]
                }) {
                    return Err(format!("node {child} is not within its parent {parent}"));
                }
            }
        }
        if self.nodes.iter().filter(|(_, split)| split.is_some()).count() != self.splits.len() {
            return Err("a node names a split that does not exist".into());
        }
        if depth.iter().any(|&depth| depth > self.depth) {
            return Err(format!("a node is deeper than {}", self.depth));
        }
        let counts = self.levels.iter().map(|level| level.triboxes);
        if !counts.is_sorted_by(|a, b| a < b)
            || self.levels.first().is_none_or(|first| first.triboxes == 0)
            || self.levels.last().map(|last| last.triboxes) != Some(self.splits.len() + 1)
        {
            return Err("the last level has not all triboxes, or levels do not rise".into());
        }
        Ok(())
    }

    /// Each node's parameters, its parent, and the least error that is stated of it: its own, and
    /// that of each level that has it.
    pub(super) fn claims(&self) -> Vec<(Slabs, Option<usize>, f64)> {
        let mut parents = vec![None; self.nodes.len()];
        for (split, &parent) in self.splits.iter().enumerate() {
            (parents[2 * split + 1], parents[2 * split + 2]) = (Some(parent), Some(parent));
        }
        let mut errors = self.errors.clone();
        for level in &self.levels {
            for (node, _) in self.union(level.triboxes) {
                errors[node] = errors[node].min(level.error);
            }
        }
        let nodes = self.nodes.iter().map(|(slabs, _)| *slabs);
        nodes.zip(parents).zip(errors).map(|((slabs, up), error)| (slabs, up, error)).collect()
    }

    /// The triboxes of a level with so many, by the numbers of their nodes.
    pub(super) fn union(&self, count: usize) -> Vec<(usize, Slabs)> {
        let is_whole = |split: Option<usize>| split.is_none_or(|split| split + 1 >= count);
        let first = self.nodes.iter().enumerate().take((2 * count).saturating_sub(1));
        first
            .filter(|(_, (_, split))| is_whole(*split))
            .map(|(index, (slabs, _))| (index, *slabs))
            .collect()
    }
}
