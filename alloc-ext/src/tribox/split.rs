//! The binary tree of cells, grown where splitting saves most.

use super::cell::{Cell, Trust, Whole};
use super::choose::{Choice, Choosing, Measure, Planes};
use super::excess::excess;
use super::extent::Extent;
use super::extrema::Extrema;
use super::lattice::{Lattice, grown};
use super::polygons::HalfSpace;
use crate::bvh::MAX_TRIANGLES;
use crate::error::BuildError;
use crate::mesh::Mesh;
use crate::progress::Watch;
use crate::surface::require_valid;
use meshsweep_core::Bvh;
use meshsweep_core::Tribox;
use meshsweep_core::internal::num::exp2;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Most splits above a cell; the rounding bound of [`polygons`](super::polygons) counts on it.
pub(super) const DEPTH: u32 = 64;

/// Part of a tribox's measure by which a gain may fall short of its prediction: the effect of
/// rounding to f32 on thin triboxes.
const DOUBT: f64 = 1e-3;

/// Options of a split.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct SplitOptions {
    /// Most leaves.
    pub leaves: usize,
    /// The measure that splits minimise; `None`: volume, or area if the mesh's tribox has almost no
    /// volume.
    pub measure: Option<Measure>,
    /// Planes that are tried.
    pub planes: Planes,
    /// A cell is split only if that saves more than this part of its tribox's measure. The paper's
    /// rule where positive; at −∞ cells are split although the total grows, which may pay
    /// later.
    pub least_gain: f64,
    /// Cells are split until no [error](Node::error) is more than this, those of the greatest error
    /// first, whatever [`least_gain`](Self::least_gain) says; input units, in which a blob stores
    /// it if there is a [lattice](Self::lattice). `None`: those of the greatest gain first.
    pub error: Option<f64>,
    /// Where the best plane saves less than this part of the tribox's measure, planes are tried
    /// together with those that split both parts again.
    pub foresight: f64,
    /// Distance by which planes of [proxies](Node::proxy) may move outward so that small faces
    /// vanish, input units.
    pub simplify: f32,
    /// Grid of the proxies, with what vertices moved; `None`: each has a [grid](Tribox::on_grid)
    /// of its own, and vertices moved by [`Mesh::rounding`].
    pub lattice: Option<Lattice>,
}

impl Default for SplitOptions {
    fn default() -> Self {
        SplitOptions {
            leaves: 64,
            measure: None,
            planes: Planes::NINE,
            least_gain: 1e-4,
            error: None,
            foresight: 0.05,
            simplify: 0.0,
            lattice: None,
        }
    }
}

impl SplitOptions {
    setters! {
        /// Sets the number of [leaves](Self::leaves).
        with_leaves: usize => leaves,
        /// Sets the [planes](Self::planes) that are tried.
        with_planes: Planes => planes,
        /// Sets the [error](Self::error) that ends splitting.
        with_error: Option<f64> => error,
        /// Sets how far planes may move to [simplify](Self::simplify) proxies.
        with_simplify: f32 => simplify,
    }
}

/// A cell of the tree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Holds the part of the mesh, or of the solid, that is between the planes of the splits
    /// above, in real arithmetic. Inside of the parent's, and on its side of the split's
    /// plane.
    pub tribox: Tribox,
    /// The tribox that is drawn: the same [simplified](Tribox::snapped) as asked for, larger by
    /// what vertices moved when they were rounded, and on a [grid](Tribox::on_grid) or the
    /// [lattice](SplitOptions::lattice), so that every vertex is an f32. The proxies of a level
    /// hold the input as it was before its vertices moved.
    pub proxy: Tribox,
    /// Formula (10) of the paper for the proxy: how far it reaches beyond the convex hull of the
    /// part, input units, see [`Level::error`](super::Level::error).
    pub error: f64,
    /// Where it was split.
    pub split: Option<Split>,
}

/// A split of a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Split {
    /// Direction of the plane.
    pub slab: usize,
    /// Its parameter.
    pub at: f32,
    /// Numbers of the nodes where the parameter is less, and where it is greater.
    pub children: [u32; 2],
}

/// Cells of a mesh, the coarsest first.
#[derive(Clone, Debug)]
pub struct Hierarchy {
    /// The first one is the whole mesh; children come after their parents.
    pub nodes: Vec<Node>,
    /// Nodes in the order in which they were split.
    pub order: Vec<u32>,
    /// Whether the mesh bounds a solid, whose inside counts; else the triboxes hold its surface
    /// only.
    pub is_solid: bool,
    /// The measure that splits minimised.
    pub measure: Measure,
}

impl Hierarchy {
    /// Splits a mesh: a triangle soup, of which only the surface counts if it is not closed. The
    /// result is the same on every machine.
    ///
    /// `tree` is the mesh's [box tree](super::box_tree), which knows whether it is closed. Closed
    /// is a mesh of which every edge is run through as often in one direction as in the other;
    /// inside is where the winding number is not 0. Without triangles there is one empty node.
    ///
    /// Cost: for each leaf, and each plane tried there, one pass over its part of the mesh.
    ///
    /// # Errors
    /// [`BuildError::Triboxes`] if a coordinate is beyond [`Tribox::DOMAIN`]; those of
    /// [`bvh::build`](crate::bvh::build) on a mesh that [`repair`](crate::mesh::repair()) did not
    /// make.
    pub fn new(
        mesh: &Mesh,
        tree: &Bvh<'_>,
        options: &SplitOptions,
    ) -> Result<Hierarchy, BuildError> {
        Self::watched(mesh, tree, options, Watch::NONE)
    }

    /// [`new`](Self::new) under a watch.
    pub(super) fn watched(
        mesh: &Mesh,
        tree: &Bvh<'_>,
        options: &SplitOptions,
        watch: Watch<'_>,
    ) -> Result<Hierarchy, BuildError> {
        require_valid(mesh, MAX_TRIANGLES)?;
        let whole = Whole::new(mesh, tree);
        let root = whole.root(mesh)?;
        let measure = options.measure.unwrap_or(if is_flat(&root.tribox) {
            Measure::Area
        } else {
            Measure::Volume
        });
        let is_solid = whole.is_solid;
        let unit =
            options.lattice.map_or_else(|| grid_unit(&root.tribox), |lattice| lattice.spacing());
        let extrema = matches!(options.planes, Planes::Extrema(_)).then(|| Extrema::of(mesh));
        let choosing = Choosing {
            planes: options.planes,
            measure,
            unit,
            foresight: options.foresight,
            trust: Trust::Sketch,
            extrema: extrema.as_ref(),
            watch,
        };
        let mut growing =
            Growing { whole, options, choosing, nodes: Vec::new(), heap: BinaryHeap::new() };
        if root.tribox.is_empty() {
            let (tribox, proxy) = (Tribox::EMPTY, Tribox::EMPTY);
            let nodes = vec![Node { tribox, proxy, error: 0.0, split: None }];
            return Ok(Hierarchy { nodes, order: Vec::new(), is_solid, measure });
        }
        growing.put(root, 0);
        watch.check()?;
        let mut order = Vec::new();
        while order.len() + 1 < options.leaves.max(1)
            && let Some(leaf) = growing.heap.pop()
        {
            let Leaf { node, depth, choice: Choice { slab, at, .. }, parts, .. } = leaf;
            watch.step(order.len() + 1, options.leaves)?;
            let children = parts.map(|part| growing.put(part, depth + 1));
            growing.nodes[node as usize].split = Some(Split { slab, at: at as f32, children });
            order.push(node);
        }
        watch.check()?;
        Ok(Hierarchy { nodes: growing.nodes, order, is_solid, measure })
    }

    /// Nodes whose triboxes cover the mesh together: `count` of them, or as many as there are.
    /// Those of a greater count are parts of those of a lesser.
    #[must_use]
    pub fn leaves(&self, count: usize) -> Vec<u32> {
        let splits = &self.order[..self.order.len().min(count.saturating_sub(1))];
        let mut is_leaf = vec![false; self.nodes.len()];
        is_leaf[0] = true;
        for &node in splits {
            is_leaf[node as usize] = false;
            for child in self.nodes[node as usize].split.iter().flat_map(|split| split.children) {
                is_leaf[child as usize] = true;
            }
        }
        (0..self.nodes.len() as u32).filter(|&node| is_leaf[node as usize]).collect()
    }
}

/// Multiples of 2^-20 of the power of two above all parameters: splits lie on them, so that
/// [`Tribox::on_grid`] does not move them and proxies do not overlap.
fn grid_unit(tribox: &Tribox) -> f64 {
    let most = tribox.slabs().fold(0f32, |most, (low, high)| most.max(low.abs()).max(high.abs()));
    // `on_grid` has a quarter of its unit in f32.
    exp2(((most.to_bits() >> 23).cast_signed() - 126 - 20).max(-147))
}

/// Whether a tribox is too flat for volumes: some 3,500 times as wide as thick.
fn is_flat(tribox: &Tribox) -> bool {
    let Extent { area, volume } = Extent::of(tribox);
    volume <= 1e-4 * area * area.sqrt()
}

/// A leaf and its best split.
struct Leaf {
    /// The greatest is split first.
    rank: f64,
    node: u32,
    depth: u32,
    choice: Choice,
    parts: [Cell; 2],
}

impl Ord for Leaf {
    fn cmp(&self, other: &Self) -> Ordering {
        self.rank.total_cmp(&other.rank).then(other.node.cmp(&self.node))
    }
}
impl PartialOrd for Leaf {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl PartialEq for Leaf {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}
impl Eq for Leaf {}

struct Growing<'a> {
    whole: Whole<'a>,
    options: &'a SplitOptions,
    choosing: Choosing<'a>,
    nodes: Vec<Node>,
    heap: BinaryHeap<Leaf>,
}

impl Growing<'_> {
    /// Adds a cell; its number.
    fn put(&mut self, cell: Cell, depth: u32) -> u32 {
        let node = self.nodes.len() as u32;
        let simple = cell.tribox.snapped(self.options.simplify);
        let proxy = match self.options.lattice {
            Some(lattice) => lattice.around(&simple),
            None => grown(&simple, self.whole.rounding).on_grid(),
        };
        let error = excess(&proxy, &cell);
        self.nodes.push(Node { tribox: cell.tribox, proxy, error, split: None });
        if depth < DEPTH && self.options.leaves > 1 && !self.is_within(error) {
            let least =
                self.options.least_gain * self.choosing.measure.of(Extent::of(&cell.tribox));
            let by_error = self.options.error.is_some();
            let is_any = by_error || self.options.least_gain == f64::NEG_INFINITY;
            if let Some((choice, parts)) =
                self.choose(&cell).filter(|(choice, _)| is_any || choice.gain > least)
            {
                let rank = if by_error { error } else { choice.gain };
                self.heap.push(Leaf { rank, node, depth, choice, parts });
            }
        }
        node
    }

    /// Whether an error is as small as asked for, so that the cell is not split.
    fn is_within(&self, error: f64) -> bool {
        let claimed = self.options.lattice.map_or(error, |lattice| lattice.claimed(error));
        self.options.error.is_some_and(|most| claimed <= most)
    }

    /// The best split of a cell, and its parts.
    ///
    /// Where components of a solid overlap, the box tree takes some of the inside for outside and
    /// predicts gains that are too large. After the first such gain, planes are chosen by winding
    /// numbers.
    fn choose(&mut self, cell: &Cell) -> Option<(Choice, [Cell; 2])> {
        loop {
            let choice = self.choosing.best(&self.whole, cell)?;
            let half = |is_low: bool| HalfSpace { slab: choice.slab, at: choice.at, is_low };
            let part = |is_low: bool| self.whole.part(cell, &half(is_low), Trust::Proof);
            let parts = [part(true)?, part(false)?];
            let measure = |tribox: &Tribox| self.choosing.measure.of(Extent::of(tribox));
            let before = measure(&cell.tribox);
            let now = before - parts.iter().map(|part| measure(&part.tribox)).sum::<f64>();
            if self.choosing.trust == Trust::Proof || now >= choice.now - DOUBT * before {
                return Some((choice, parts));
            }
            self.choosing.trust = Trust::Proof;
        }
    }
}
