//! From any triangles to their hull: what is asked is checked, made, and measured.

use super::boxes::Bounds;
use super::build::{Builder, Done};
use super::obstacle::Obstacle;
use super::options::{Goal, Options, Outcome, Progress, Report, WrapError};
use super::slack::slack;
use super::volume::{Solid, crosses_itself};
use crate::mesh::Mesh;
use crate::precision::{Stored, VertexBits, store};
use glam::DVec3;
use meshsweep_core::internal::num::exp2;
use rustc_hash::FxHashMap;
use std::time::Instant;

/// A hull and what is known of it.
#[derive(Clone, Debug)]
pub struct Hull {
    /// Closed, embedded, counter-clockwise seen from outside; `source` counts from 0.
    pub mesh: Mesh,
    /// What it is, and what it took.
    pub report: Report,
}

/// A hull of any triangles: see the module for what is proved of it.
///
/// Vertices that were moved to a grid before (see [`snap`](crate::precision::snap)) are enclosed
/// where they are in `mesh`.
///
/// # Errors
/// [`WrapError`].
pub fn wrap(
    mesh: &Mesh,
    options: &Options,
    on_progress: impl FnMut(Progress),
) -> Result<Hull, WrapError> {
    wrap_all(mesh, &[], options, on_progress)
}

/// As [`wrap`], of a mesh and further triangles, by their corners: those without area that
/// [`repair`](crate::mesh::repair) leaves out, and that are segments or points. They are enclosed
/// as the mesh is, and have no part in what bounds a volume.
///
/// # Errors
/// [`WrapError`].
pub fn wrap_all(
    mesh: &Mesh,
    further: &[[[f32; 3]; 3]],
    options: &Options,
    mut on_progress: impl FnMut(Progress),
) -> Result<Hull, WrapError> {
    let started = Instant::now();
    if mesh.triangles.is_empty() {
        return Err(WrapError::Empty);
    }
    if !(options.margin >= 0.0 && options.margin.is_finite()) {
        return Err(WrapError::BadMargin);
    }
    if matches!(options.goal, Goal::Slack(most) if most.is_nan() || most <= options.margin) {
        return Err(WrapError::SlackWithinMargin { margin: options.margin });
    }
    let positions: Vec<DVec3> =
        mesh.positions.iter().map(|&[x, y, z]| glam::Vec3::new(x, y, z).as_dvec3()).collect();
    let solid = Solid::of(mesh);
    if let (Goal::Void(_), Err(why)) = (options.goal, solid) {
        return Err(WrapError::NoVolume(why));
    }
    let crosses =
        matches!(options.goal, Goal::Void(_)) && crosses_itself(&positions, &mesh.triangles);
    // A hull keeps some steps of its grid off the mesh: a coarse one that holds the mesh is no
    // reason to store the hull on it.
    let bits = match options.vertex_bits {
        VertexBits::Auto => VertexBits::F32,
        bits => bits,
    };
    let stored = store(mesh, bits);
    let (positions, triangles) = joined(positions, &mesh.triangles, further);
    let obstacle = Obstacle::new(&positions, &triangles).with_margin(options.margin);
    let around = if further.is_empty() && options.margin <= 0.0 {
        stored.clone()
    } else {
        around(&positions, options.margin, bits)?
    };
    // A grid that the mesh is not on is for the hull alone: what it starts from is the mesh where
    // it is.
    let moved = stored.surface_error > mesh.rounding * exp2(-stored.scale_exponent);
    let stored = if moved { store(mesh, VertexBits::F32) } else { stored };
    let mut builder = Builder {
        obstacle: &obstacle,
        volume: solid.ok().map(|solid| solid.volume),
        solid: solid.ok(),
        options,
        // A limit that the clock has no number for is none.
        deadline: options.time_limit.and_then(|limit| started.checked_add(limit)),
        is_hurried: false,
        on_progress: &mut on_progress,
    };
    let Done { mut work, start, filled, mut stop } = builder.build(mesh, &stored, &around)?;
    work.drop_swallowed();
    if builder.is_hurried && stop == Outcome::Reached {
        stop = Outcome::OutOfTime;
    }
    let (at, triangles) = work.shell.compact();
    let hull_volume = work.shell.volume();
    let mut slack = slack(&work.shell, &obstacle);
    // Every face was bounded by the slack that was asked for, one by one.
    if let Goal::Slack(most) = options.goal
        && work.reach <= most
    {
        slack.upper = slack.upper.min(most).max(slack.lower);
    }
    let single = at.iter().map(|p| p.as_vec3().to_array()).collect();
    let hull = Mesh::new(single, triangles);
    let report = Report {
        faces: hull.triangles.len(),
        margin: options.margin,
        volume: hull_volume,
        void: solid.and_then(|solid| solid.void(&hull, hull_volume)),
        crosses,
        slack,
        start,
        filled: filled + work.swallowed,
        stop,
        stars: work.placer.stars,
        programs: work.placer.programs,
        proofs: work.proofs,
        refused: work.refused,
        time: started.elapsed(),
    };
    Ok(Hull { mesh: hull, report })
}

/// Positions and triangles with further ones, which share the vertices that are at the same place.
fn joined(
    mut positions: Vec<DVec3>,
    triangles: &[[u32; 3]],
    further: &[[[f32; 3]; 3]],
) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let mut triangles = triangles.to_vec();
    if further.is_empty() {
        return (positions, triangles);
    }
    // Both zeros are one place.
    let place = |p: DVec3| (p + 0.0).to_array().map(f64::to_bits);
    let mut number: FxHashMap<[u64; 3], u32> = FxHashMap::default();
    for (v, &p) in positions.iter().enumerate() {
        number.entry(place(p)).or_insert(v as u32);
    }
    for corners in further {
        triangles.push(corners.map(|[x, y, z]| {
            let p = glam::Vec3::new(x, y, z).as_dvec3();
            *number.entry(place(p)).or_insert_with(|| {
                positions.push(p);
                positions.len() as u32 - 1
            })
        }));
    }
    (positions, triangles)
}

/// The frame and the format of coordinates that hold all positions, or their box with the margin
/// around it.
fn around(positions: &[DVec3], margin: f64, bits: VertexBits) -> Result<Stored, WrapError> {
    let single = |p: &[DVec3]| p.iter().map(|p| p.as_vec3().to_array()).collect();
    if margin <= 0.0 {
        return Ok(store(&Mesh::new(single(positions), Vec::new()), bits));
    }
    let bounds = Bounds::of(positions).grown(margin);
    let corners = [bounds.low, bounds.high];
    if !corners.iter().all(|p| p.as_vec3().is_finite()) {
        return Err(WrapError::MarginTooLarge);
    }
    // The mesh's own grid says nothing about the places that a margin asks for.
    let bits = if bits == VertexBits::Auto { VertexBits::F32 } else { bits };
    Ok(store(&Mesh::new(single(&corners), Vec::new()), bits))
}
