//! The cover tree: the forest without its chains, with one root, in the order in which a blob
//! stores it.
//!
//! Any swept triangle that contains the leaves below a node bounds the node. So chains of single
//! children shrink to their finest triangle. Small subtrees become lists of triangles. Nodes that
//! hardly bound better than their parent are skipped. Above the base hull, nodes are made from its
//! vertices.

use super::forest::{Forest, NO_PARENT, cover_radius};
use super::swept::best_cover;
use crate::collapse::{History, VertexOrder};
use glam::DVec3;

/// Children of a node.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Offspring {
    /// Nodes `first .. first + count` of [`Cover::nodes`].
    Nodes {
        /// First.
        first: usize,
        /// How many.
        count: usize,
    },
    /// Triangles `first .. first + count` of [`Cover::triangles`].
    Triangles {
        /// First.
        first: usize,
        /// How many.
        count: usize,
    },
}

/// A node of the cover tree.
#[derive(Clone, Debug, PartialEq)]
pub struct CoverNode {
    /// Corners, labels of the history.
    pub corners: [u32; 3],
    /// Radius, local frame.
    pub radius: f64,
    /// Splits that must have been performed before all corners exist.
    pub ready: u32,
    /// Its children.
    pub offspring: Offspring,
}

/// The cover tree as a blob stores it.
#[derive(Clone, Debug, Default)]
pub struct Cover {
    /// Nodes; 0 is the root.
    pub nodes: Vec<CoverNode>,
    /// Original triangles in leaf order.
    pub triangles: Vec<u32>,
    /// For each level given to [`plant`], the nodes that a blob cut there keeps.
    pub node_limits: Vec<u32>,
    /// Queue entries that a depth-first descent may need.
    pub queue_capacity: u32,
}

/// Most triangles of a leaf.
const LEAF_TRIANGLES: usize = 8;
/// Most children of a node.
const FAN_OUT: usize = 4;

/// Builds the tree. `levels` are split counts, coarse to fine, the last one all splits: child
/// groups are stored level by level, so that a blob can be cut after any of them.
pub fn plant(history: &History, order: &VertexOrder, forest: &Forest, levels: &[u32]) -> Cover {
    let grove = Grove::new(history, forest);
    let mut drafts = Drafts { history, order, forest, drafts: Vec::new() };
    let roots = grove
        .roots
        .iter()
        .map(|&(bottom, position)| (drafts.grow(&grove, bottom), position))
        .collect();
    let root = drafts.crown(roots);
    emit(&drafts.drafts, root, levels)
}

/// The forest without its chains.
struct Grove {
    /// Children of each branching instance, each the finest of its chain.
    children: Vec<Vec<u32>>,
    /// Original triangles below each instance.
    leaves: Vec<u32>,
    /// Finest instance of the chain of each base triangle that covers original triangles, and the
    /// base triangle's position.
    roots: Vec<(u32, usize)>,
}

impl Grove {
    fn new(history: &History, forest: &Forest) -> Self {
        let count = history.instances();
        let originals = history.original_triangles.len();
        let mut children: Vec<Vec<u32>> = vec![Vec::new(); count];
        let mut leaves = vec![0u32; count];
        leaves[..originals].fill(1);
        // Parents are made after their children, so the order of instances is bottom-up.
        let mut bottom: Vec<u32> = (0..count as u32).collect();
        for instance in 0..count {
            if let [only] = children[instance][..] {
                bottom[instance] = only;
            }
            let parent = forest.parent[instance];
            if parent != NO_PARENT && leaves[instance] > 0 {
                children[parent as usize].push(bottom[instance]);
                leaves[parent as usize] += leaves[instance];
            }
        }
        let roots = history
            .base_instances
            .iter()
            .enumerate()
            .filter(|&(_, &instance)| leaves[instance as usize] > 0)
            .map(|(position, &instance)| (bottom[instance as usize], position))
            .collect();
        Grove { children, leaves, roots }
    }

    fn is_small(&self, instance: u32) -> bool {
        self.leaves[instance as usize] as usize <= LEAF_TRIANGLES
    }

    /// Original triangles below an instance, ascending.
    fn triangles(&self, instance: u32) -> Vec<u32> {
        let mut found = Vec::new();
        let mut stack = vec![instance];
        while let Some(at) = stack.pop() {
            let children = &self.children[at as usize];
            if children.is_empty() { found.push(at) } else { stack.extend(children) }
        }
        found.sort_unstable();
        found
    }
}

/// Node of the tree under construction.
struct Draft {
    corners: [u32; 3],
    radius: f64,
    ready: u32,
    children: Vec<usize>,
    triangles: Vec<u32>,
}

struct Drafts<'a> {
    history: &'a History,
    order: &'a VertexOrder,
    forest: &'a Forest,
    drafts: Vec<Draft>,
}

impl Drafts<'_> {
    /// Corners (labels) of an instance: the mesh's own triangles, then `ring_len` for each
    /// collapse.
    fn corners(&self, instance: u32) -> [u32; 3] {
        let originals = self.history.original_triangles.len() as u32;
        match instance.checked_sub(originals) {
            None => self.history.original_triangles[instance as usize],
            Some(past) => {
                let index = self.history.collapses.partition_point(|c| c.ring_start <= past) - 1;
                let collapse = &self.history.collapses[index];
                self.history.coarse_corners(collapse, (past - collapse.ring_start) as usize)
            }
        }
    }

    fn positions(&self, corners: [u32; 3]) -> [DVec3; 3] {
        corners.map(|l| self.history.positions[l as usize])
    }

    fn ready(&self, corners: [u32; 3]) -> u32 {
        corners.into_iter().map(|l| self.order.ready(l)).max().unwrap_or(0)
    }

    fn add(
        &mut self,
        corners: [u32; 3],
        radius: f64,
        children: Vec<usize>,
        triangles: Vec<u32>,
    ) -> usize {
        let ready = self.ready(corners);
        self.drafts.push(Draft { corners, radius, ready, children, triangles });
        self.drafts.len() - 1
    }

    /// The subtree below a branching instance; returns its draft. An explicit stack, as forests can
    /// be deep.
    fn grow(&mut self, grove: &Grove, root: u32) -> usize {
        let top = self.draft_of(grove, root);
        let mut open = vec![(root, top)];
        while let Some((instance, draft)) = open.pop() {
            if grove.is_small(instance) {
                continue;
            }
            let (large, small) = self.widen(grove, instance);
            let mut children = self.gather_leaves(grove, &small, self.drafts[draft].radius);
            for child in large {
                let child_draft = self.draft_of(grove, child);
                open.push((child, child_draft));
                children.push(child_draft);
            }
            self.drafts[draft].children = children;
        }
        top
    }

    fn draft_of(&mut self, grove: &Grove, instance: u32) -> usize {
        let triangles =
            if grove.is_small(instance) { grove.triangles(instance) } else { Vec::new() };
        let corners = self.corners(instance);
        self.add(corners, self.forest.radius[instance as usize], Vec::new(), triangles)
    }

    /// Children of an instance, the largest opened in its place while there is room: (large,
    /// small).
    fn widen(&self, grove: &Grove, instance: u32) -> (Vec<u32>, Vec<u32>) {
        let split =
            |list: &[u32]| list.iter().copied().partition::<Vec<u32>, _>(|&c| !grove.is_small(c));
        let (mut large, mut small) = split(&grove.children[instance as usize]);
        loop {
            let radius = |c: u32| self.forest.radius[c as usize];
            let widest = (0..large.len()).max_by(|&i, &j| {
                radius(large[i]).total_cmp(&radius(large[j])).then(large[j].cmp(&large[i]))
            });
            let Some(at) = widest else { break };
            let below = &grove.children[large[at] as usize];
            if large.len() + below.len() + small.len().div_ceil(2) > FAN_OUT + 1 {
                break;
            }
            let opened = large.swap_remove(at);
            let (more_large, more_small) = split(&grove.children[opened as usize]);
            large.extend(more_large);
            small.extend(more_small);
        }
        (large, small)
    }

    /// Leaf nodes for small subtrees; neighbours share one where a single triangle covers them no
    /// worse than the parent does.
    fn gather_leaves(&mut self, grove: &Grove, small: &[u32], parent_radius: f64) -> Vec<usize> {
        let mut groups: Vec<(u32, f64, Vec<u32>)> = Vec::new();
        for &instance in small {
            let triangles = grove.triangles(instance);
            let mut best: Option<(usize, u32, f64)> = None;
            for (at, (cover, _, members)) in groups.iter().enumerate() {
                if members.len() + triangles.len() > LEAF_TRIANGLES {
                    continue;
                }
                let vertices: Vec<u32> = members
                    .iter()
                    .chain(&triangles)
                    .flat_map(|&t| self.history.original_triangles[t as usize])
                    .collect();
                for candidate in [*cover, instance] {
                    let corners = self.positions(self.corners(candidate));
                    let radius = cover_radius(&self.history.positions, &vertices, corners);
                    if radius <= SHARE * parent_radius && best.is_none_or(|(_, _, r)| radius < r) {
                        best = Some((at, candidate, radius));
                    }
                }
            }
            match best {
                Some((at, cover, radius)) => {
                    let (old_cover, old_radius, members) = &mut groups[at];
                    *old_cover = cover;
                    *old_radius = radius;
                    members.extend(triangles);
                }
                None => groups.push((instance, self.forest.radius[instance as usize], triangles)),
            }
        }
        groups
            .into_iter()
            .map(|(cover, radius, triangles)| {
                self.add(self.corners(cover), radius, Vec::new(), triangles)
            })
            .collect()
    }

    /// Nodes above the base hull's, down to one root: groups by median split, each covered by the
    /// best of a few triangles made of base vertices (a point, a segment, a face).
    fn crown(&mut self, roots: Vec<(usize, usize)>) -> usize {
        // Bottom-up over a binary split kept in an explicit list of tasks.
        enum Task {
            Split(Vec<(usize, usize)>),
            Join { members: Vec<(usize, usize)>, parts: usize },
        }
        let all = roots.clone();
        let mut tasks = vec![Task::Split(roots)];
        let mut done: Vec<usize> = Vec::new();
        while let Some(task) = tasks.pop() {
            match task {
                Task::Split(members) if members.len() == 1 => done.push(members[0].0),
                Task::Split(members) if members.len() <= FAN_OUT => {
                    let children = members.iter().map(|&(draft, _)| draft).collect();
                    let node = self.crown_node(&members, children);
                    done.push(node);
                }
                Task::Split(members) => {
                    let parts = self.divide(&members);
                    tasks.push(Task::Join { members, parts: parts.len() });
                    tasks.extend(parts.into_iter().map(Task::Split));
                }
                Task::Join { members, parts } => {
                    let children = done.split_off(done.len() - parts);
                    let node = self.crown_node(&members, children);
                    done.push(node);
                }
            }
        }
        let root = done.pop().unwrap_or(0);
        // One base triangle may cover everything by a node of a finer level. The root must exist
        // at every level.
        if self.drafts[root].ready > 0 { self.crown_node(&all, vec![root]) } else { root }
    }

    fn centre(&self, draft: usize) -> DVec3 {
        let [a, b, c] = self.positions(self.drafts[draft].corners);
        (a + b + c) / 3.0
    }

    /// Up to eight parts of equal size, by three median splits along the longest axis.
    fn divide(&self, members: &[(usize, usize)]) -> Vec<Vec<(usize, usize)>> {
        let mut parts = vec![members.to_vec()];
        for _ in 0..3 {
            parts = parts
                .into_iter()
                .flat_map(|mut part| {
                    if part.len() < 2 {
                        return vec![part];
                    }
                    let centres = part.iter().map(|&(d, _)| self.centre(d));
                    let (low, high) = centres
                        .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(l, h), c| {
                            (l.min(c), h.max(c))
                        });
                    let extent = (high - low).to_array();
                    let axis = (0..3).max_by(|&i, &j| extent[i].total_cmp(&extent[j])).unwrap_or(0);
                    part.sort_by(|&(a, i), &(b, j)| {
                        self.centre(a).to_array()[axis]
                            .total_cmp(&self.centre(b).to_array()[axis])
                            .then(i.cmp(&j))
                    });
                    let right = part.split_off(part.len() / 2);
                    vec![part, right]
                })
                .collect();
        }
        parts
    }

    fn crown_node(&mut self, members: &[(usize, usize)], children: Vec<usize>) -> usize {
        let mut vertices: Vec<u32> = members
            .iter()
            .flat_map(|&(_, p)| self.forest.base_vertices[p].iter().copied())
            .collect();
        vertices.sort_unstable();
        vertices.dedup();
        let faces: Vec<[u32; 3]> = members.iter().map(|&(_, p)| self.history.base[p]).collect();
        let base: Vec<u32> = faces.iter().flatten().copied().collect();
        let (corners, radius) = best_cover(&self.history.positions, &faces, &base, &vertices);
        self.add(corners, radius, children, Vec::new())
    }
}

/// Leaves share a node if one triangle covers them within this part of the parent's radius.
const SHARE: f64 = 0.7;

/// Stored order: child groups level by level, within a level in the order of their parents; then
/// triangles in node order.
fn emit(drafts: &[Draft], root: usize, levels: &[u32]) -> Cover {
    let mut cover = Cover::default();
    let mut order = vec![root];
    let mut first: Vec<Option<usize>> = vec![None; drafts.len()];
    let mut group_ready = vec![0u32; drafts.len()];
    let mut depth_first = vec![1u32; drafts.len()];
    for &limit in levels {
        let mut at = 0;
        while at < order.len() {
            let draft = order[at];
            at += 1;
            let children = &drafts[draft].children;
            if children.is_empty() || first[draft].is_some() {
                continue;
            }
            let ready = children
                .iter()
                .map(|&c| drafts[c].ready)
                .max()
                .unwrap_or(0)
                .max(group_ready[draft]);
            if ready > limit {
                continue;
            }
            first[draft] = Some(order.len());
            for &child in children {
                group_ready[child] = ready;
                depth_first[child] = depth_first[draft] + children.len() as u32 - 1;
            }
            order.extend(children);
        }
        cover.node_limits.push(order.len() as u32);
    }
    for &draft in &order {
        let Draft { corners, radius, ready, ref children, ref triangles } = drafts[draft];
        let offspring = match first[draft] {
            Some(first) => Offspring::Nodes { first, count: children.len() },
            None => Offspring::Triangles { first: cover.triangles.len(), count: triangles.len() },
        };
        cover.triangles.extend(triangles);
        cover.queue_capacity = cover.queue_capacity.max(depth_first[draft]);
        cover.nodes.push(CoverNode { corners, radius, ready, offspring });
    }
    cover
}
