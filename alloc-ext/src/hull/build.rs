//! The stages of a hull hierarchy's build, in order, and their report.

use super::deform::{KeyTracks, vertex_numbers};
use super::forest::{Forest, grow};
use super::groups::{base_groups, sort_base};
use super::levels::{certify, levels};
use super::tables::{SplitRecord, Tables};
use super::wires::wires_off_surface;
use crate::clock::Instant;
use crate::collapse::{Conditions, Engine, History, Priority, Stuck, VertexOrder};
use crate::emit::Sections;
use crate::error::BuildError;
use crate::mesh::{Input, KeyFrame, Mesh};
use crate::progress::{Stage, Watch};
use crate::surface::{Closed, SignedVolume, Stored, VertexBits, close, require_valid, store};
use crate::tight::{FACES, outset};
use glam::{DVec3, Vec3};
use meshsweep_core::SectionKind;
use meshsweep_core::internal::geom::Aabb;
use meshsweep_core::internal::hull::format::layout::{MAX_RING, START_GROUP};
use meshsweep_core::internal::num::{Radius8, Radius16, sum_up, up_to_f32};
use std::time::Duration;

/// The levels of a hierarchy.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Levels<'a> {
    /// Outer hulls of a closed manifold mesh (see
    /// [`require_closed_manifold`](crate::mesh::require_closed_manifold)).
    ///
    /// Components may overlap. Where a mesh passes through itself inside out, it winds around
    /// points negatively, and its hulls do not enclose it there. Distances and
    /// [`first_hit`](meshsweep_core::Hull::first_hit) hold all the same.
    ///
    /// How far [wires](crate::mesh::Wire) are from the triangles with an area is part of the
    /// surface error: the hulls need not enclose them.
    #[default]
    Hulls,
    /// Meshes near the surface of any mesh: open, crossing itself, inside out, with edges of many
    /// triangles. They serve distances and segments and enclose nothing. See
    /// [`Hull::encloses`](meshsweep_core::Hull::encloses).
    ///
    /// Vertices are copied where the mesh is no manifold, and holes are closed by triangles that
    /// stand for no part of the surface (see [`close`]). The [priority](BuildOptions::priority)
    /// does not count.
    Sweep,
    /// Outer hulls of a mesh that deforms: by any motion of its vertices, and between these frames.
    /// The mesh itself is frame 0; without more frames there are no key frames.
    ///
    /// The mesh must pass [`require_deformable`](crate::mesh::require_deformable), and frames come
    /// from [`key_frame`](crate::mesh::key_frame).
    Deform(&'a [KeyFrame]),
    /// The same with the levels of [`Sweep`](Levels::Sweep), of any mesh.
    SweepDeform(&'a [KeyFrame]),
}

impl<'a> Levels<'a> {
    /// The frames of a mesh that deforms.
    fn frames(self) -> Option<&'a [KeyFrame]> {
        match self {
            Levels::Hulls | Levels::Sweep => None,
            Levels::Deform(frames) | Levels::SweepDeform(frames) => Some(frames),
        }
    }
}

/// Options of a build.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BuildOptions<'a> {
    /// What the levels are to be.
    pub levels: Levels<'a>,
    /// Faces of the base hull; the build stops earlier if no legal collapse is left.
    pub base_faces: usize,
    /// Order of collapses.
    pub priority: Priority,
    /// Conditions on collapses.
    pub conditions: Conditions,
    /// Coordinate format.
    pub vertex_bits: VertexBits,
}

impl Default for BuildOptions<'_> {
    fn default() -> Self {
        BuildOptions {
            levels: Levels::Hulls,
            base_faces: FACES as usize,
            priority: Priority::Program,
            conditions: Conditions::default(),
            vertex_bits: VertexBits::Auto,
        }
    }
}

impl BuildOptions<'_> {
    /// Sets the [levels](Self::levels).
    #[must_use]
    pub const fn with_levels<'b>(&self, levels: Levels<'b>) -> BuildOptions<'b> {
        let Self { base_faces, priority, conditions, vertex_bits, .. } = *self;
        BuildOptions { levels, base_faces, priority, conditions, vertex_bits }
    }
}

/// Counts, times and volume of a build.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct BuildReport {
    /// Faces of the base hull.
    pub base_faces: usize,
    /// Why it has more faces than asked for.
    pub stuck: Option<Stuck>,
    /// Linear programs solved.
    pub programs: u64,
    /// Time of the collapses.
    pub collapse_time: Duration,
    /// Time of the radii.
    pub sweep_time: Duration,
    /// Time of certifying the levels' distances.
    pub certify_time: Duration,
    /// The kind of its levels.
    pub kind: Kind,
    /// What the surface error carries of wires, input units; see [`wires_off_surface`].
    pub wires: f64,
}

/// The kind of a hierarchy's levels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// Outer hulls of a closed mesh, as it is stored.
    Hulls {
        /// Volume of the mesh, input units.
        volume: f64,
    },
    /// Meshes near the surface.
    SweepOnly {
        /// Holes of the mesh, after vertices were copied.
        holes: usize,
        /// Copies of vertices where the mesh is no manifold.
        copies: usize,
    },
}

/// Most triangles of a mesh: instances and ring entries must fit the format's counts.
const MAX_TRIANGLES: usize = 20_000_000;

/// The part of a build in which edges collapse.
const COLLAPSING: f64 = 0.7;

/// Builds a hull hierarchy.
///
/// # Errors
/// [`BuildError`]; of a mesh that deforms also [`BuildError::NotExact`] and
/// [`BuildError::FrameTooFar`].
pub fn build(
    input: Input<'_>,
    options: &BuildOptions<'_>,
    watch: Watch<'_>,
) -> Result<(Sections, BuildReport), BuildError> {
    let collapsing = watch.part(0.0, COLLAPSING);
    let is_exact = matches!(options.vertex_bits, VertexBits::Auto | VertexBits::F32);
    if options.levels.frames().is_some() && (!is_exact || input.moved > 0.0) {
        return Err(BuildError::NotExact);
    }
    let collapsed = match options.levels {
        Levels::Sweep | Levels::SweepDeform(_) => near(input.mesh, options, collapsing),
        Levels::Hulls | Levels::Deform(_) => outer(input, options, collapsing),
    }?;
    let certifying = watch.part(COLLAPSING, 1.0).during(Stage::Certifying);
    finish(input, options.levels, collapsed, certifying)
}

/// The collapses of a solid.
fn outer(
    input: Input<'_>,
    options: &BuildOptions<'_>,
    watch: Watch<'_>,
) -> Result<Collapsed, BuildError> {
    let mesh = input.mesh;
    if mesh.triangles.len() > MAX_TRIANGLES {
        return Err(BuildError::TooLarge { triangles: mesh.triangles.len(), most: MAX_TRIANGLES });
    }
    let stored = store_solid(mesh, options.vertex_bits);
    let volume = positive_volume(&stored, mesh)?;
    let wires = wires_off_surface(mesh)?;
    let started = Instant::now();
    let (history, stuck, programs) = collapse(&stored, mesh, options, options.base_faces, watch)?;
    let (time, kind) = (started.elapsed(), Kind::Hulls { volume });
    let places = (0..history.original_vertices).collect();
    Ok(Collapsed { stored, history, stuck, programs, time, kind, wires, places })
}

/// The collapses of any mesh.
fn near(
    mesh: &Mesh,
    options: &BuildOptions<'_>,
    watch: Watch<'_>,
) -> Result<Collapsed, BuildError> {
    require_valid(mesh, MAX_TRIANGLES)?;
    if mesh.triangles.is_empty() {
        return Err(BuildError::Empty);
    }
    let stored = store_solid(mesh, options.vertex_bits);
    let wires = wires_off_surface(mesh)?;
    let started = Instant::now();
    let Closed { triangles, fillers, holes, copies, places } =
        close(stored.positions.len(), &mesh.triangles);
    let count = triangles.len();
    if count > MAX_TRIANGLES {
        return Err(BuildError::TooLarge { triangles: count, most: MAX_TRIANGLES });
    }
    let at = |&v: &u32| stored.positions[v as usize];
    let positions: Vec<DVec3> = places.iter().map(at).collect();
    let (conditions, grid) = (options.conditions, stored.grid);
    let engine = Engine::near(&positions, &triangles, count - fillers, conditions, grid);
    let (history, stuck, programs) = run(engine, options.base_faces, watch)?;
    let (time, kind) = (started.elapsed(), Kind::SweepOnly { holes, copies });
    Ok(Collapsed { stored, history, stuck, programs, time, kind, wires, places })
}

/// A mesh and its collapses.
struct Collapsed {
    stored: Stored,
    history: History,
    stuck: Option<Stuck>,
    programs: u64,
    time: Duration,
    /// Volume in the local frame.
    kind: Kind,
    wires: f64,
    /// The vertex of the mesh that has the place of each original vertex of the history.
    places: Vec<u32>,
}

/// From the collapses to the sections.
fn finish(
    input: Input<'_>,
    wanted: Levels<'_>,
    collapsed: Collapsed,
    watch: Watch<'_>,
) -> Result<(Sections, BuildReport), BuildError> {
    let Collapsed { stored, history, stuck, programs, time: collapse_time, kind, wires, places } =
        collapsed;
    let frames = wanted.frames();
    let started = Instant::now();
    let order = VertexOrder::new(&history);
    let mesh = input.mesh;
    let mut tracks = KeyTracks::new(&history, &stored, (mesh, &places), frames.unwrap_or(&[]))?;
    let cover = |instance: u32, below: &[u32], corners| {
        tracks.cover(&history.positions, instance, below, corners);
    };
    let forest = grow(&history, cover, watch.part(0.0, 0.5))?;
    tracks.leave_out(&forest.radius);
    let sweep_time = started.elapsed();
    let started = Instant::now();
    let mut tables = assemble(&stored, input, &history, &order, &forest);
    let volume = match kind {
        Kind::Hulls { volume } => Some(volume),
        Kind::SweepOnly { .. } => None,
    };
    tables.encloses = volume.is_some();
    tables.levels = levels(&history, volume);
    certify(&mut tables, &history, watch.part(0.5, 1.0))?;
    // Levels were measured against triangles with an area. The wires' distance joins only now.
    if wires > 0.0 {
        let off = wires * meshsweep_core::internal::num::exp2(-stored.scale_exponent);
        tables.surface_error = sum_up(tables.surface_error, up_to_f32(off));
    }
    let mut sections = tables.sections();
    if frames.is_some() {
        let numbers = vertex_numbers(&tables, &order, (mesh, &places));
        sections.bodies.push((SectionKind::VertexNumbers, numbers));
        sections.bodies.push((SectionKind::KeyFrames, tracks.section(&history, &order)));
    }
    let scale = meshsweep_core::internal::num::exp2(stored.scale_exponent);
    let kind = match kind {
        Kind::Hulls { volume } => Kind::Hulls { volume: volume * scale * scale * scale },
        kind @ Kind::SweepOnly { .. } => kind,
    };
    let report = BuildReport {
        base_faces: tables.base.len(),
        stuck,
        programs,
        collapse_time,
        sweep_time,
        certify_time: started.elapsed(),
        kind,
        wires,
    };
    Ok((sections, report))
}

/// Vertices past those of the triangles are the wires'. They count only for the frame, which all
/// structures of a blob share.
fn store_solid(mesh: &Mesh, bits: VertexBits) -> Stored {
    let mut stored = store(mesh, bits);
    let used = mesh.triangles.iter().flatten().fold(0, |most, &v| most.max(v as usize + 1));
    if !mesh.wires.is_empty() {
        stored.positions.truncate(used);
    }
    stored
}

/// Parts of the faces asked for at which a hull is tried, if vertices of the mesh moved. With fewer
/// faces it may pass over a place that it comes too near with more.
const TRIED: [f64; 3] = [1.0, 0.75, 0.5];

/// A hull alone: its triangles in input units, its void as a part of the mesh's volume, and why
/// collapses ended early. It encloses the mesh without its wires, of a `&Mesh` or an [`Input`].
/// [`levels`](BuildOptions::levels) and [`base_faces`](BuildOptions::base_faces) play no part: the
/// number of faces is `faces`.
///
/// If vertices moved, it encloses the input before they did: it is moved outward, see [`outset`].
///
/// # Errors
/// [`BuildError::NotPositive`], [`BuildError::Cancelled`], [`BuildError::NotEnclosed`].
pub fn hull_of<'m>(
    input: impl Into<Input<'m>>,
    faces: usize,
    options: &BuildOptions<'_>,
    watch: Watch<'_>,
) -> Result<(Mesh, f64, Option<Stuck>), BuildError> {
    let input: Input<'m> = input.into();
    let (mesh, error) = (input.mesh, input.error_up());
    let stored = store_solid(mesh, options.vertex_bits);
    let volume = positive_volume(&stored, mesh)?;
    if error <= 0.0 {
        let (hull, added, stuck) = level(&stored, mesh, options, faces, watch)?;
        return Ok((hull, added / volume, stuck));
    }
    let solid = mesh.without_wires();
    for part in TRIED {
        let fewer = (faces as f64 * part) as usize;
        let (hull, _, stuck) = level(&stored, mesh, options, fewer, watch)?;
        if let Some(hull) = outset(&hull, &solid, error) {
            let scale = meshsweep_core::internal::num::exp2(-stored.scale_exponent);
            let local = hull.corners_f64().map(|corners| corners.map(|p| p * scale));
            let void = SignedVolume::of(local).value / volume - 1.0;
            return Ok((hull, void, stuck));
        }
    }
    Err(BuildError::NotEnclosed { error })
}

/// A hull on the mesh as stored, and the volume that it adds, local frame.
fn level(
    stored: &Stored,
    mesh: &Mesh,
    options: &BuildOptions<'_>,
    faces: usize,
    watch: Watch<'_>,
) -> Result<(Mesh, f64, Option<Stuck>), BuildError> {
    let (history, stuck, _) = collapse(stored, mesh, options, faces, watch)?;
    let order = VertexOrder::new(&history);
    let scale = meshsweep_core::internal::num::exp2(stored.scale_exponent);
    let positions = order.label[..order.base as usize]
        .iter()
        .map(|&l| (history.positions[l as usize] * scale).as_vec3().to_array())
        .collect();
    let triangles = history.base.iter().map(|t| t.map(|l| order.index[l as usize])).collect();
    let added = history.added_volume.iter().sum::<f64>();
    Ok((Mesh::new(positions, triangles), added, stuck))
}

/// Volume of the mesh in the local frame: the unit of void.
fn positive_volume(stored: &Stored, mesh: &Mesh) -> Result<f64, BuildError> {
    let corners = mesh.triangles.iter().map(|t| t.map(|v| stored.positions[v as usize]));
    let volume = SignedVolume::of(corners).value;
    let scale = meshsweep_core::internal::num::exp2(stored.scale_exponent);
    if volume > 0.0 {
        Ok(volume)
    } else {
        Err(BuildError::NotPositive { volume: volume * scale * scale * scale })
    }
}

fn collapse(
    stored: &Stored,
    mesh: &Mesh,
    options: &BuildOptions<'_>,
    faces: usize,
    watch: Watch<'_>,
) -> Result<(History, Option<Stuck>, u64), BuildError> {
    let Stored { positions, grid, .. } = stored;
    let (conditions, priority) = (options.conditions, options.priority);
    run(Engine::new(positions, &mesh.triangles, conditions, priority, *grid), faces, watch)
}

fn run(
    mut engine: Engine,
    faces: usize,
    watch: Watch<'_>,
) -> Result<(History, Option<Stuck>, u64), BuildError> {
    let from = engine.face_count();
    let of = from.saturating_sub(faces);
    let stuck = engine.run(faces, |left| {
        let done = from - left;
        watch.during(Stage::Collapsing { done, of }).goes_on(done as f64 / of.max(1) as f64)
    });
    watch.check()?;
    let programs = engine.programs();
    let mut history = engine.finish();
    sort_base(&mut history);
    Ok((history, stuck, programs))
}

fn assemble(
    stored: &Stored,
    input: Input<'_>,
    history: &History,
    order: &VertexOrder,
    forest: &Forest,
) -> Tables {
    let index = |label: u32| order.index[label as usize];
    let mut splits = Vec::with_capacity(history.collapses.len());
    let mut rings = Vec::with_capacity(history.rings.len());
    let radius = |instance: u32| Radius8::round_up(forest.radius[instance as usize]);
    let mut radii: Vec<Radius8> = history.base_instances.iter().map(|&i| radius(i)).collect();
    // The triangles of the mesh are the first instances.
    let originals = history.surface_triangles as u32;
    let numbers = |instances: &[u32]| {
        let finals = instances.iter().filter(|&&instance| instance < originals);
        finals.map(|&t| input.mesh.source[t as usize]).collect::<Vec<u32>>()
    };
    let mut source = numbers(&history.base_instances);
    let mut source_starts = Vec::new();
    let mut splits_with = vec![None; order.label.len()];
    for (at, collapse) in history.collapses.iter().enumerate().rev() {
        debug_assert!(collapse.ring_len as usize <= MAX_RING, "a star holds fewer triangles");
        let vertex = index(collapse.vertex);
        splits_with[vertex as usize] = Some(splits.len() as u32);
        let at_label = |l: u32| history.positions[l as usize];
        let corners =
            history.ring(collapse).iter().chain([&collapse.origin, &collapse.destination]);
        let star_radius =
            corners.map(|&l| at_label(l).distance(at_label(collapse.vertex))).fold(0.0, f64::max);
        // A triangle without a part of the surface asks for no split.
        let first = history.first_coarse(at);
        let error = (first..first + collapse.ring_len)
            .map(|instance| radius(instance).0)
            .filter(|&code| code != Radius8::INFINITE.0)
            .max();
        splits.push(SplitRecord {
            vertex,
            ring_start: rings.len() as u32,
            right: collapse.right as u8,
            before: forest.wings[at],
            star_radius: Radius8::round_up(star_radius * (1.0 + 1e-14)),
            error: Radius8(error.unwrap_or(0)),
        });
        rings.extend(history.ring(collapse).iter().map(|&l| index(l)));
        radii.extend(history.fine(at).iter().map(|&i| radius(i)));
        if splits.len() as u32 % START_GROUP == 1 {
            source_starts.push(source.len() as u32);
        }
        source.extend(numbers(history.fine(at)));
    }
    let single = |p: DVec3| p.as_vec3();
    let low = stored.positions.iter().fold(Vec3::INFINITY, |m, &p| m.min(single(p)));
    let high = stored.positions.iter().fold(Vec3::NEG_INFINITY, |m, &p| m.max(single(p)));
    let scale = meshsweep_core::internal::num::exp2(-stored.scale_exponent);
    Tables {
        scale_exponent: stored.scale_exponent,
        grid: stored.grid,
        surface_error: up_to_f32((stored.surface_error + input.moved * scale) * (1.0 + 1e-15)),
        vertices: order.label.iter().map(|&l| single(history.positions[l as usize])).collect(),
        base_vertices: order.base,
        base: history.base.iter().map(|t| t.map(index)).collect(),
        groups: base_groups(history, forest)
            .into_iter()
            .map(|(corners, radius)| (corners.map(index), Radius16::round_up(radius)))
            .collect(),
        splits,
        rings,
        radii,
        splits_with,
        source_starts,
        source,
        input_triangles: input.triangle_count(),
        surface_box: Aabb { min: low, max: high },
        levels: Vec::new(),
        queue_capacity: forest.queue_entries,
        is_cut: false,
        encloses: true,
    }
}
