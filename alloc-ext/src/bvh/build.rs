//! The stages of a box tree's build, in order, and their report.

use super::cones::cones;
use super::encode;
use super::fans::{self, Effort, Fan, FanLeaf, Packed};
use super::moments::moments;
use super::nodes::fit::{axis_aligned_boxes, shared_frames, unturned_frames};
use super::nodes::order::{Topology, topology};
use super::packing::{self, PackingReport};
use super::sides::{Sided, Sides, SidesReport};
use super::source;
use super::store::{OnGrid, store};
use super::stored_triangles::{Copies, StoredTriangles};
use super::unfold::unfold;
use crate::clock::Instant;
use crate::emit::Sections;
use crate::error::BuildError;
use crate::mesh::{Input, Mesh, Wire};
use crate::progress::{Stage, Watch};
use glam::DVec3;
use meshsweep_core::SectionKind;
use meshsweep_core::internal::bvh::tree::format::BvhHeader;
use meshsweep_core::internal::bvh::tree::format::layout::{BOXES_BYTES, FRAME_BYTES, LINK_BYTES};
use meshsweep_core::internal::bvh::tree::format::layout::{
    BVH_CLOSED, BVH_F32, BVH_SIDELESS, BVH_SIDES_LOST, BVH_TURNED,
};
use meshsweep_core::internal::geom::fan::WIDTH;
use meshsweep_core::internal::num::up_to_f32;
use rayon::prelude::*;
use std::time::Duration;

/// The questions that a box tree serves, and how it stores vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct TreeOptions {
    /// Whether to store boxes in shared frames, for closest points.
    pub closest: bool,
    /// Whether to store axis-aligned boxes, for segments and overlap.
    pub segments: bool,
    /// Whether to store normal cones, for culling.
    pub cull: bool,
    /// Whether to store moments of nodes, for winding numbers.
    pub winding: bool,
    /// Whether to store vertices in f32 instead of 16 bits on a grid.
    pub is_f32: bool,
    /// Whether to store vertices in f32 if the grid is too coarse or loses sides: see [`WhyF32`].
    pub allows_f32: bool,
}

/// Why vertices are stored in f32 although [`TreeOptions::is_f32`] is not set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum WhyF32 {
    /// The mesh is too far from its origin: a grid would move vertices farther than a 32,768th of
    /// its longest side.
    TooFar,
    /// On the grid faces change places, so that a tree for closest points would decide no sides,
    /// and no places next to theirs were found where they do not. In f32 they do not. A tree with
    /// winding numbers needs no such sides.
    Sides,
}

impl Default for TreeOptions {
    /// Closest points and segments, no culling, no winding numbers, vertices on a grid.
    fn default() -> Self {
        TreeOptions {
            closest: true,
            segments: true,
            cull: false,
            winding: false,
            is_f32: false,
            allows_f32: false,
        }
    }
}

impl TreeOptions {
    setters! {
        /// Sets whether the tree serves [closest points](Self::closest).
        with_closest: bool => closest,
        /// Sets whether the tree serves [segments](Self::segments).
        with_segments: bool => segments,
        /// Sets whether the tree serves [culling](Self::cull).
        with_cull: bool => cull,
        /// Sets whether the tree serves [winding numbers](Self::winding).
        with_winding: bool => winding,
        /// Sets whether [vertices are f32](Self::is_f32).
        with_f32: bool => is_f32,
        /// Sets whether [f32 is allowed](Self::allows_f32).
        with_f32_allowed: bool => allows_f32,
    }

    /// Whether the tree has boxes for distances.
    pub(super) const fn stores_frames(&self) -> bool {
        self.closest || !self.segments
    }

    /// Bytes of a node in the sections that hold links and boxes.
    fn node_bytes(&self) -> usize {
        let sections =
            [(true, LINK_BYTES), (self.stores_frames(), FRAME_BYTES), (self.segments, BOXES_BYTES)];
        sections.iter().filter(|(is, _)| *is).map(|(_, bytes)| bytes).sum()
    }

    const fn copies(&self) -> Copies {
        if self.winding {
            Copies::All
        } else if self.segments || self.cull {
            Copies::EachWinding
        } else {
            Copies::First
        }
    }
}

/// Counts and time of a build.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct TreeReport {
    /// Triangles.
    pub triangles: usize,
    /// Leaves.
    pub leaves: usize,
    /// The cells that leaves were packed in.
    pub packing: PackingReport,
    /// Nodes.
    pub nodes: usize,
    /// Children per node.
    pub mean_children: f64,
    /// Nodes on the longest path from the root.
    pub depth: usize,
    /// The tree's header.
    pub header: BvhHeader,
    /// Why vertices are f32 although [`TreeOptions::is_f32`] was not set.
    pub why_f32: Option<WhyF32>,
    /// Where the nearest triangle of a closed mesh tells no side, and why; else `None`.
    pub sides: Option<SidesReport>,
    /// Time of the whole build.
    pub time: Duration,
}

/// Most triangles of a tree. With more, node numbers or offsets of source numbers could exceed the
/// format's range.
pub const MAX_TRIANGLES: usize = 1 << 24;

/// Part of the work after which leaves are packed; then frames are searched; then boxes are made.
const PACKED: f64 = 0.5;
/// See [`PACKED`].
const FRAMED: f64 = 0.9;
/// See [`PACKED`].
const BOXED: f64 = 0.95;

/// Builds the box tree of any triangle soup.
///
/// Every triangle is kept, even if the grid makes it degenerate. Each [`Wire`] is kept as a
/// triangle with a repeated corner, in a leaf of its own.
///
/// Cost: O(n log n), about 3 µs a triangle, on all threads of rayon's current pool. The bytes are
/// the same on any number of threads.
///
/// # Errors
/// [`BuildError::TooLarge`] on a mesh of more than [`MAX_TRIANGLES`];
/// [`BuildError::NoSuchVertex`], [`BuildError::NotFinite`] and [`BuildError::SourceNumbers`] on one
/// that [`repair`](crate::mesh::repair) did not make; [`BuildError::Cancelled`].
pub fn build(
    input: Input<'_>,
    options: &TreeOptions,
    watch: Watch<'_>,
) -> Result<(Sections, TreeReport), BuildError> {
    build_in(input, options, Purpose::Stored, watch.during(Stage::BoxTree))
}

/// What a tree is built for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Purpose {
    /// To be stored.
    Stored,
    /// For many questions of a builder.
    Asked,
    /// For few questions of a builder. It takes a third of the time, and a little more for each
    /// answer.
    AskedLittle,
}

/// [`build`] for a purpose.
pub(super) fn build_in(
    input: Input<'_>,
    options: &TreeOptions,
    purpose: Purpose,
    watch: Watch<'_>,
) -> Result<(Sections, TreeReport), BuildError> {
    let started = Instant::now();
    let is_quick = purpose == Purpose::AskedLittle;
    let stored = StoredTriangles::of(input.mesh, options.copies(), MAX_TRIANGLES)?;
    let (mesh, edges) = (&*stored.mesh, &stored.edges);
    let input = Input { mesh, ..input };
    let triangles = mesh.triangles.len() + mesh.wires.len();
    let Vertices { grid, mut flags, why_f32, sides } =
        store_vertices(input, &stored, options, is_quick);
    let is_f32 = flags & BVH_F32 != 0;
    let effort = if is_quick { Effort::QUICK } else { packing::effort(mesh.triangles.len()) };
    let part = watch.part(0.0, PACKED);
    let packing = match purpose {
        Purpose::Stored => {
            packing::of_stored(options.node_bytes(), options.winding, mesh.triangles.len(), is_f32)
        }
        _ => packing::quick(),
    };
    let packed = fans::pack(&mesh.triangles, &grid.positions, packing, effort, part)?;
    let packing = PackingReport::of(&packed);
    let Packed { mut leaves, .. } = packed;
    leaves.extend((mesh.triangles.len() as u32..).zip(&mesh.wires).map(wire_leaf));
    let points: Vec<Vec<DVec3>> = leaves.par_iter().map(|leaf| points(leaf, &grid)).collect();
    let views: Vec<&[DVec3]> = points.iter().map(Vec::as_slice).collect();
    let bounds: Vec<(DVec3, DVec3)> = points.par_iter().map(|points| bounds(points)).collect();
    watch.part(PACKED, 1.0).step(0, 1)?;
    let topology = topology(&bounds);
    let sources: Vec<u32> = mesh.all_sources().collect();
    let in_order =
        || topology.leaf_order.iter().flat_map(|&leaf| leaves[leaf as usize].triangles());
    let [mut links, mut fans, mut numbers] = <[Vec<u8>; 3]>::default();
    // The watch stays on this thread.
    let of_boxes = rayon::in_place_scope(|scope| {
        scope.spawn(|_| links = encode::links(&topology, &leaves));
        scope.spawn(|_| fans = encode::fans(&topology, &leaves, &grid, is_f32));
        scope.spawn(|_| {
            numbers = source::pack(&in_order().map(|t| sources[t as usize]).collect::<Vec<_>>());
        });
        boxes(&topology, &views, options, is_quick, &grid, watch)
    })?;
    let mut sections = vec![(SectionKind::TreeLinks, links)];
    sections.extend(of_boxes);
    sections.extend([(SectionKind::TreeFans, fans), (SectionKind::TreeSource, numbers)]);
    if options.cull {
        sections.push((SectionKind::TreeCones, cones(&topology, &leaves, &grid.positions)));
    }
    if options.winding {
        let bytes = moments(mesh, edges, &topology, &leaves, &grid, watch.part(BOXED, 1.0))?;
        sections.push((SectionKind::TreeMoments, bytes));
    }
    let has_sides = flags & (BVH_CLOSED | BVH_SIDES_LOST) == BVH_CLOSED;
    if has_sides && options.stores_frames() && stored.turned.contains(&true) {
        flags |= BVH_TURNED;
        // Without a section all are turned.
        if stored.turned.contains(&false) {
            let is_turned = |t: u32| stored.turned.get(t as usize).is_some_and(|&is| is);
            sections.push((SectionKind::TreeTurned, encode::bits(in_order().map(is_turned))));
        }
    }
    if has_sides && options.stores_frames() && sides.sideless.contains(&true) {
        flags |= BVH_SIDELESS;
        let is_sideless = |t: u32| sides.sideless.get(t as usize).is_some_and(|&is| is);
        sections.push((SectionKind::TreeSideless, encode::bits(in_order().map(is_sideless))));
    }
    let header = header(mesh, &grid, &leaves, flags, topology.waiting_entries);
    let header = BvhHeader { nodes: topology.nodes.len() as u32, ..header };
    sections.insert(0, (SectionKind::Bvh, header.write().to_vec()));
    debug_assert_eq!(sections[1].1.len(), topology.nodes.len() * LINK_BYTES);
    let children: usize = topology.nodes.iter().map(|node| node.child_count()).sum();
    let report = TreeReport {
        triangles,
        leaves: leaves.len(),
        packing,
        nodes: topology.nodes.len(),
        mean_children: children as f64 / topology.nodes.len().max(1) as f64,
        depth: topology.depth,
        header,
        why_f32,
        sides: sides.report(),
        time: started.elapsed(),
    };
    let sections = encode::sections(grid.scale_exponent, input.triangle_count(), &header, sections);
    Ok((sections, report))
}

/// The sections of boxes that are asked for.
fn boxes(
    topology: &Topology,
    leaves: &[&[DVec3]],
    options: &TreeOptions,
    is_quick: bool,
    grid: &OnGrid,
    watch: Watch<'_>,
) -> Result<Vec<(SectionKind, Vec<u8>)>, BuildError> {
    let framed = watch.part(PACKED, FRAMED);
    framed.step(0, 1)?;
    let mut sections = Vec::new();
    if options.stores_frames() {
        let frames = match is_quick {
            true => unturned_frames(topology, leaves, framed)?,
            false => shared_frames(topology, leaves, framed)?,
        };
        sections.push((SectionKind::TreeFrames, encode::frames(&frames)));
    }
    if options.segments {
        let boxes = axis_aligned_boxes(topology, leaves, watch.part(FRAMED, BOXED))?;
        sections.push((SectionKind::TreeBoxes, encode::boxes(&boxes, grid.origin)));
    }
    Ok(sections)
}

/// The leaf of a wire. From its first end both spokes lead to the second: so the kernels see two
/// equal edges, and find the closest point of the segment in the way of an edge.
fn wire_leaf((number, wire): (u32, &Wire)) -> FanLeaf {
    let [centre, end] = wire.ends;
    let ring = [end; 2].into_iter().collect();
    let triangles = [number].into_iter().collect();
    FanLeaf { first: Fan { centre, ring, triangles, reversed: false }, second: None }
}

/// Points from the grid's origin whose convex hull holds the leaf's vertices. A vertex that is not
/// exact from there, because a coordinate is tiny beside the origin, is held by up to eight points.
fn points(leaf: &FanLeaf, grid: &OnGrid) -> Vec<DVec3> {
    let (centres, ring) = encode::vertices(leaf);
    let mut out = Vec::with_capacity(centres.len() + ring.len());
    for &v in centres.iter().chain(&ring) {
        let from = out.len();
        out.push(DVec3::ZERO);
        for axis in 0..3 {
            let ends = difference(grid.positions[v as usize][axis], grid.origin[axis].into());
            let count = out.len();
            if ends[0] < ends[1] {
                out.extend_from_within(from..count);
            }
            let (low, high) = out[from..].split_at_mut(count - from);
            low.iter_mut().for_each(|point| point[axis] = ends[0]);
            high.iter_mut().for_each(|point| point[axis] = ends[1]);
        }
    }
    out
}

/// Ends of an interval that contains `a` − `b`, equal if the difference is exact (Knuth, TAOCP
/// 4.2.2).
fn difference(a: f64, b: f64) -> [f64; 2] {
    let difference = a - b;
    let of_b = a - difference;
    let error = (a - (difference + of_b)) + (of_b - b);
    if error == 0.0 { [difference; 2] } else { [difference.next_down(), difference.next_up()] }
}

fn bounds(points: &[DVec3]) -> (DVec3, DVec3) {
    points.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(l, h), &p| (l.min(p), h.max(p)))
}

/// Vertices as they are stored, and the tree's flags.
struct Vertices {
    grid: OnGrid,
    flags: u8,
    why_f32: Option<WhyF32>,
    sides: Sides,
}

/// Stores the vertices in the format that is asked for, or in f32 if the grid is too coarse. On a
/// grid where faces cross some vertices move to other points of it; if that does not help and f32
/// does, f32 it is. A quick build does not test sides: its tree stores f32, and only steers a
/// search. Sides are those of the triangles as repair wound them, which have the stored vertices.
fn store_vertices(
    input: Input<'_>,
    stored: &StoredTriangles<'_>,
    options: &TreeOptions,
    is_quick: bool,
) -> Vertices {
    let sided = stored.sided.map(|mesh| Sided::new(mesh, stored));
    let sides = |grid: &OnGrid| match &sided {
        Some(sided) if !is_quick => sided.sides(grid),
        Some(_) => Sides::ALL,
        None => Sides::NONE,
    };
    // Without boxes for distances there are no bits that would name some triangles.
    let has_no_bits = |sides: &Sides| sides.defect.is_some() && !options.stores_frames();
    let vertices = |grid: OnGrid, why_f32: Option<WhyF32>, sides: Sides| {
        let of = [
            (stored.is_closed, BVH_CLOSED),
            (grid.is_f32, BVH_F32),
            (stored.is_closed && (sides.are_lost || has_no_bits(&sides)), BVH_SIDES_LOST),
        ];
        let flags = of.into_iter().fold(0, |flags, (is, flag)| flags | if is { flag } else { 0 });
        Vertices { grid, flags, why_f32, sides }
    };
    let grid = store(input, options.is_f32);
    if !options.is_f32 && options.allows_f32 && grid.is_coarse() {
        let exact = store(input, true);
        let sides = sides(&exact);
        return vertices(exact, Some(WhyF32::TooFar), sides);
    }
    let on_grid = sides(&grid);
    let Some(sided) = &sided else { return vertices(grid, None, on_grid) };
    let wants_sides = options.stores_frames() && !options.winding;
    if on_grid.defect.is_none() || options.is_f32 || !wants_sides {
        return vertices(grid, None, on_grid);
    }
    let unfolded = unfold(input, sided, &grid, &on_grid);
    let unfolded = match unfolded {
        Some((grid, sides)) if sides.defect.is_none() => return vertices(grid, None, sides),
        unfolded => unfolded,
    };
    let exact = store(input, true);
    let mut defect = sided.still_crossing(&on_grid.crossings, &exact);
    if defect.is_none() {
        let in_f32 = sides(&exact);
        if in_f32.defect.is_none() && options.allows_f32 {
            return vertices(exact, Some(WhyF32::Sides), in_f32);
        }
        defect = in_f32.defect;
    }
    // The surface has the defect in f32 too, or f32 is not wanted.
    let defect = defect.or(on_grid.defect);
    match unfolded {
        Some((grid, unfolded)) => vertices(grid, None, Sides { defect, ..unfolded }),
        None => vertices(grid, None, Sides { defect, ..on_grid }),
    }
}

fn header(
    mesh: &Mesh,
    grid: &OnGrid,
    leaves: &[FanLeaf],
    flags: u8,
    waiting_entries: usize,
) -> BvhHeader {
    let norm = |v: DVec3| v.x.abs() + v.y.abs() + v.z.abs();
    let mut reach = 0f64;
    for leaf in leaves {
        for fan in std::iter::once(&leaf.first).chain(&leaf.second) {
            let spoke =
                |v: u32| norm(grid.positions[v as usize] - grid.positions[fan.centre as usize]);
            for pair in fan.ring.windows(2) {
                reach = reach.max(spoke(pair[0]) + spoke(pair[1]));
            }
        }
    }
    // Rounded before the origin is subtracted: a difference may lose a tiny coordinate.
    let origin = DVec3::from(grid.origin.map(f64::from));
    let nothing = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) = leaves.iter().fold(nothing, |(low, high), leaf| {
        let (centres, ring) = encode::vertices(leaf);
        centres
            .iter()
            .chain(&ring)
            .map(|&v| grid.positions[v as usize])
            .fold((low, high), |(low, high), p| {
                (low.min(p.floor() - origin), high.max(p.ceil() - origin))
            })
    });
    let short = |v: DVec3| [v.x as u16, v.y as u16, v.z as u16];
    let vertices: usize = leaves.iter().map(|leaf| encode::tag(leaf).vertices()).sum();
    BvhHeader {
        flags,
        grid_exponent: grid.exponent,
        grid_origin: grid.origin,
        nodes: 0,
        leaves: leaves.len() as u32,
        vertices: vertices as u32,
        triangles: (mesh.triangles.len() + mesh.wires.len()) as u32,
        stack_entries: (waiting_entries + WIDTH) as u32,
        surface_error: up_to_f32(grid.surface_error),
        // Spokes are rounded when they are f32.
        star_radius: up_to_f32(reach * (1.0 + 1e-6)),
        low: short(low),
        high: short(high),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_difference_that_is_not_exact_is_between_its_ends() {
        assert_eq!(difference(3.5, -2.0), [5.5; 2]);
        assert_eq!(difference(1e-40, 0.0), [1e-40; 2]);
        let [low, high] = difference(-1e-40, 1.0);
        assert!(low < -1.0 && -1.0 < high);
    }

    #[test]
    fn a_mesh_of_more_triangles_than_a_tree_numbers_is_refused() {
        let mesh = Mesh { triangles: vec![[0; 3]; MAX_TRIANGLES + 1], ..Mesh::default() };
        let input = Input { mesh: &mesh, moved: 0.0, input_triangles: 0 };
        let refused = build(input, &TreeOptions::default(), Watch::NONE).map(|_| ());
        let wanted = BuildError::TooLarge { triangles: (1 << 24) + 1, most: 1 << 24 };
        assert_eq!(refused, Err(wanted));
    }
}
