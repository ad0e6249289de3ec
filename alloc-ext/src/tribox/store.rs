//! Tribox hierarchies as a section of a blob.

use super::choose::{Measure, Planes};
use super::gain::Gain;
use super::grown::{Grid, Grown, Splitting};
use super::lattice::Lattice;
use super::level::{Level, level_watched};
use super::orient::Turn;
use super::split::{Hierarchy, Node, SplitOptions};
use crate::clock::Instant;
use crate::emit::Sections;
use crate::error::BuildError;
use crate::mesh::{Input, Mesh};
use crate::progress::{Stage, Watch};
use crate::surface::{SignedVolume, scale_exponent};
use glam::Vec3;
use meshsweep_core::SectionKind;
use meshsweep_core::TriboxLevel;
use meshsweep_core::internal::geom::Aabb;
use meshsweep_core::internal::num::{exp2, up_to_f32};
use meshsweep_core::internal::tribox::FACES;
use meshsweep_core::internal::tribox::format::TriboxesHeader;
use meshsweep_core::internal::tribox::format::layout::{
    MAX_TRIBOXES, TRIBOX_BYTES, TRIBOX_LEVEL_BYTES, TRIBOX_SPLIT_BYTES, TRIBOX_TURN_BYTES,
    TRIBOXES_BYTES, TRIBOXES_SOLID, TRIBOXES_TURNED,
};
use meshsweep_core::{Blob, Bvh, Tribox};
use std::time::Duration;

/// How many triboxes to make, and in which frame.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct TriboxOptions {
    /// Most triboxes of the finest level.
    pub count: u32,
    /// Splitting ends where every tribox of the finest level is within this distance of the convex
    /// hull of what it holds, input units: formula (10) of the paper. `None`: where it gains
    /// nothing.
    pub error: Option<f64>,
    /// The mesh is also split in the orientation in which its tribox has the least of this measure.
    /// The blob keeps the turned triboxes if they are fewer, where [`error`](Self::error) is set,
    /// else if the finest level has less of the measure in all. Cost: a second split.
    pub orient: Option<Measure>,
    /// Planes just beyond local extrema of the mesh are tried too. Cost: the mesh is also split
    /// without them, for the report of the gain.
    pub extrema: bool,
}

impl TriboxOptions {
    /// At most so many triboxes.
    #[must_use]
    pub const fn new(count: u32) -> Self {
        Self { count, error: None, orient: None, extrema: false }
    }

    setters! {
        /// Sets the [error](Self::error) that ends splitting.
        with_error: Option<f64> => error,
        /// Sets the measure of the [orientation](Self::orient).
        with_orient: Option<Measure> => orient,
        /// Sets whether planes just beyond [extrema](Self::extrema) are tried.
        with_extrema: bool => extrema,
    }

    /// What splits a mesh.
    fn split(&self) -> SplitOptions {
        let planes = if self.extrema { Planes::EXTREMA } else { Planes::NINE };
        SplitOptions {
            planes,
            leaves: self.count.clamp(1, MAX_TRIBOXES) as usize,
            error: self.error,
            ..SplitOptions::default()
        }
    }
}

/// Levels and time of a hierarchy.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct TriboxReport {
    /// Levels as measured, coarse to fine.
    pub levels: Vec<Level>,
    /// The largest error of a tribox of the finest level as stored, input units. `None` of none.
    pub reached: Option<f64>,
    /// Whether the triboxes hold a solid, not its surface only.
    pub is_solid: bool,
    /// What [`orient`](TriboxOptions::orient) gained. `None` if it was not asked for.
    pub oriented: Option<Gain>,
    /// What [`extrema`](TriboxOptions::extrema) gained along the mesh's axes. `None` if they were not
    /// tried.
    pub extrema: Option<Gain>,
    /// Time of the whole build.
    pub time: Duration,
}

/// Splits a mesh into triboxes, and measures unions of 1, 2, 4, … of them.
///
/// The triboxes hold the input. Any triangle soup will do; see [`Hierarchy::new`] for what they
/// hold, and for the cost. The section of a mesh without triangles is empty, and its blob does not
/// open. With [`orient`](TriboxOptions::orient) the mesh is split twice.
///
/// # Errors
/// [`BuildError::Triboxes`] if a coordinate is not finite or beyond
/// [`Tribox::DOMAIN`](meshsweep_core::Tribox::DOMAIN); those of [`bvh::build`](crate::bvh::build).
pub fn build(
    input: Input<'_>,
    options: &TriboxOptions,
    watch: Watch<'_>,
) -> Result<(Sections, TriboxReport), BuildError> {
    let watch = watch.during(Stage::Triboxes);
    let started = Instant::now();
    let scale = scale_exponent(input.mesh);
    let local = exp2(-scale);
    let used = input.mesh.all_triangles().flatten().map(|v| input.mesh.positions[v as usize]);
    let whole = Tribox::of_points(used)?;
    let tables = |bounds: Aabb, section: Vec<u8>| {
        let error = Lattice::room(input.error()) * local;
        sections(scale, up_to_f32(error), input.triangle_count(), bounds, section)
    };
    if whole.is_empty() {
        let tables = tables(Aabb { min: Vec3::ZERO, max: Vec3::ZERO }, Vec::new());
        let report = TriboxReport {
            levels: Vec::new(),
            reached: None,
            is_solid: false,
            oriented: None,
            extrema: None,
            time: started.elapsed(),
        };
        return Ok((tables, report));
    }
    let splitting = |options: TriboxOptions| Splitting {
        mesh: input.mesh,
        options: options.split(),
        grid: Grid::Blob(input.error()),
    };
    let plain = options.with_extrema(false);
    let plain = options.extrema.then(|| splitting(plain).oriented(None, watch.part(0.0, 0.3)));
    let from = if plain.is_some() { 0.3 } else { 0.0 };
    let plain = plain.transpose()?.map(|(plain, _)| plain.hierarchy);
    let (grown, oriented) = splitting(*options).oriented(options.orient, watch.part(from, 0.8))?;
    let is_by_error = options.error.is_some();
    let extrema =
        plain.map(|plain| Gain::of_planes(&plain, &grown.hierarchy, oriented, is_by_error));
    let lattice = match grown.lattice {
        Some(lattice) => lattice,
        None => Lattice::in_frame(&grown.mesh, scale, input.error())?,
    };
    let Grown { mesh, bytes, hierarchy, turn, .. } = grown;
    let tree = Bvh::open(&bytes).map_err(BuildError::Reopen)?;
    let counts = (0..).map(|k| 1usize << k).take_while(|&count| count < hierarchy.order.len() + 1);
    let counts = counts.chain([hierarchy.order.len() + 1]);
    let counts: Vec<usize> = counts.collect();
    let mut levels = Vec::with_capacity(counts.len());
    let ends = |level: usize| 0.8 + 0.2 * level as f64 / counts.len() as f64;
    for (number, &count) in counts.iter().enumerate() {
        let part = watch.part(ends(number), ends(number + 1));
        levels.push(level_watched(&hierarchy, count, &mesh, &tree, part));
        part.step(1, 1)?;
    }
    let solid = hierarchy.is_solid.then(|| volume(&mesh)).filter(|&volume| volume > 0.0);
    let records = levels.iter().map(|level| TriboxLevel {
        triboxes: level.triboxes as u32,
        distance: up_to_f32(lattice.in_local_units(level.distance.upper)),
        error: up_to_f32(lattice.in_local_units(level.error)),
        // The ratio to a tiny volume may exceed f32.
        void_ratio: solid.map_or(0.0, |solid| level.void(solid).min(f64::from(f32::MAX)) as f32),
    });
    let corner =
        |of: &[f32; 9]| Vec3::from([of[0], of[1], of[2]].map(|x| (f64::from(x) * local) as f32));
    let section = section(&hierarchy, &lattice, turn, &records.collect::<Vec<_>>());
    let bounds = Aabb { min: corner(&whole.low), max: corner(&whole.high) };
    let tables = tables(bounds, section);
    let reached = levels.last().map(|level| lattice.claimed(level.error));
    let (is_solid, time) = (hierarchy.is_solid, started.elapsed());
    Ok((tables, TriboxReport { levels, reached, is_solid, oriented, extrema, time }))
}

/// Volume that a closed mesh bounds, cubed input units.
pub fn volume(mesh: &Mesh) -> f64 {
    SignedVolume::of(mesh.corners_f64()).value.abs()
}

/// A node in the order of the splits.
struct Placed {
    /// In the hierarchy.
    number: u32,
    /// Splits above.
    depth: u32,
    split: Option<u16>,
}

fn section(
    hierarchy: &Hierarchy,
    lattice: &Lattice,
    turn: Option<Turn>,
    levels: &[TriboxLevel],
) -> Vec<u8> {
    let mut placed = vec![Placed { number: 0, depth: 0, split: None }];
    let mut place_of = vec![0usize; hierarchy.nodes.len()];
    let mut splits: Vec<u16> = Vec::new();
    for (split, &number) in hierarchy.order.iter().enumerate() {
        let place = place_of[number as usize];
        placed[place].split = Some(split as u16);
        splits.push(place as u16);
        let depth = placed[place].depth + 1;
        let node: &Node = &hierarchy.nodes[number as usize];
        for child in node.split.iter().flat_map(|split| split.children) {
            place_of[child as usize] = placed.len();
            placed.push(Placed { number: child, depth, split: None });
        }
    }
    let header = TriboxesHeader {
        flags: if hierarchy.is_solid { TRIBOXES_SOLID } else { 0 }
            | if turn.is_some() { TRIBOXES_TURNED } else { 0 },
        grid_exponent: lattice.grid_exponent,
        grid_origin: lattice.origin,
        nodes: placed.len() as u32,
        levels: levels.len() as u32,
        depth: placed.iter().map(|placed| placed.depth).max().unwrap_or(0),
    };
    let mut out = header.write().to_vec();
    let numbers = turn.into_iter().flat_map(|turn| turn.rows).flatten();
    numbers.for_each(|x| out.extend(x.to_le_bytes()));
    for level in levels {
        out.extend(level.triboxes.to_le_bytes());
        // Local here.
        [level.distance, level.error, level.void_ratio]
            .iter()
            .for_each(|x| out.extend(x.to_le_bytes()));
    }
    splits.iter().for_each(|node| out.extend(node.to_le_bytes()));
    for Placed { number, split, .. } in placed {
        let node = &hierarchy.nodes[number as usize];
        let stored = lattice.stored(&node.tribox).expect("all nodes are inside of the first");
        stored.iter().flatten().for_each(|x| out.extend(x.to_le_bytes()));
        out.extend(split.unwrap_or(u16::MAX).to_le_bytes());
        out.extend(lattice.stored_error(node.error).0.to_le_bytes());
    }
    out
}

/// The triboxes of a blob after the finest level of at most `count`; `None` if it has none. Every
/// table is a prefix of what it was.
#[must_use]
pub fn cut(blob: &Blob<'_>, count: u32) -> Option<Sections> {
    let triboxes = blob.triboxes().ok()?;
    let level_count = triboxes.levels().take_while(|level| level.triboxes <= count.max(1)).count();
    let leaves = triboxes.level(level_count.checked_sub(1)? as u32)?.triboxes;
    let coarser = triboxes.coarser(leaves);
    let above = |node: u32| {
        std::iter::successors(Some(node), |&node| coarser.parent(node)).count() as u32 - 1
    };
    let depth = (0..coarser.node_count()).map(above).max()?;
    let header = TriboxesHeader {
        nodes: coarser.node_count(),
        levels: level_count as u32,
        depth,
        ..*triboxes.header()
    };
    let place = blob.sections().find(|section| section.kind == SectionKind::Triboxes)?;
    let old = blob.bytes().get(place.offset as usize..)?.get(..place.bytes as usize)?;
    let turn_bytes = if triboxes.is_turned() { TRIBOX_TURN_BYTES } else { 0 };
    let (turn, rest) = old.get(TRIBOXES_BYTES..)?.split_at_checked(turn_bytes)?;
    let (levels, rest) =
        rest.split_at_checked(triboxes.level_count() as usize * TRIBOX_LEVEL_BYTES)?;
    let (splits, nodes) =
        rest.split_at_checked((triboxes.leaf_count() as usize - 1) * TRIBOX_SPLIT_BYTES)?;
    let kept = leaves as usize - 1;
    let mut section = header.write().to_vec();
    section.extend(turn);
    section.extend(&levels[..level_count * TRIBOX_LEVEL_BYTES]);
    section.extend(&splits[..kept * TRIBOX_SPLIT_BYTES]);
    for (node, record) in (0..coarser.node_count()).zip(nodes.chunks(TRIBOX_BYTES)) {
        let mut record = record.to_vec();
        if coarser.children(node).is_none() {
            record[2 * FACES..2 * FACES + 2].copy_from_slice(&u16::MAX.to_le_bytes());
        }
        section.extend(record);
    }
    let h = blob.header();
    Some(sections(
        h.scale_exponent,
        h.surface_error,
        h.input_triangles,
        Aabb::of(h.surface_box),
        section,
    ))
}

fn sections(
    scale_exponent: i32,
    surface_error: f32,
    input_triangles: u32,
    bounds: Aabb,
    section: Vec<u8>,
) -> Sections {
    let bodies = vec![(SectionKind::Triboxes, section)];
    Sections::new(scale_exponent, surface_error, input_triangles, bounds, bodies)
}
