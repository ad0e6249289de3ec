//! From any triangles to their tight hull: options are checked, the hull is searched and measured.

use super::deadline::Deadline;
use super::moves::{Rounding, slack};
use super::options::{Goal, Options};
use super::proof::Obstacle;
use super::report::{Outcome, Report};
use super::search::{CandidateHull, HullSearch};
use crate::bvh::MAX_TRIANGLES;
use crate::clock::Instant;
use crate::error::BuildError;
use crate::geom::{Bounds, crosses_itself};
use crate::mesh::{Input, Mesh};
use crate::progress::{Stage, Watch};
use crate::surface::{Solid, Stored, VertexBits, require_valid, store};
use glam::{DVec3, Vec3};
use meshsweep_core::internal::num::exp2;
use std::borrow::Cow;
use std::sync::atomic::{AtomicBool, Ordering};

/// Half-steps of the hull's grid up to which a margin needs no search. Rounding to `f32` moves a
/// vertex by √3 of them at most, and edits keep four.
const FEW_STEPS: f64 = 2.0;

/// A tight hull and its measures.
#[derive(Clone, Debug)]
pub struct Hull {
    /// Closed, embedded, counter-clockwise seen from outside; `source` counts from 0.
    pub mesh: Mesh,
    /// Measures of the hull and of the work for it.
    pub report: Report,
}

/// A tight hull of any triangles and [wires](crate::mesh::Wire), of a `&Mesh` or an [`Input`]. The
/// [module](crate::tight) lists the proved properties. Wires bound no volume.
///
/// The hull encloses the input before its vertices were rounded to `f32` and moved to a grid: it
/// keeps a distance of [`Mesh::rounding`] and [`Input::moved`] from the mesh.
///
/// # Errors
/// [`BuildError`].
pub fn wrap<'m>(
    input: impl Into<Input<'m>>,
    options: &Options,
    watch: Watch<'_>,
) -> Result<Hull, BuildError> {
    wrap_obstacle(input.into(), options, watch).map(|(hull, _)| hull)
}

/// As [`wrap()`], with the mesh as the obstacle of the search.
pub(super) fn wrap_obstacle(
    input: Input<'_>,
    options: &Options,
    watch: Watch<'_>,
) -> Result<(Hull, Obstacle), BuildError> {
    let started = Instant::now();
    let mesh = input.mesh;
    require_valid(mesh, MAX_TRIANGLES)?;
    let triangles: Vec<[u32; 3]> = mesh.all_triangles().collect();
    if triangles.is_empty() {
        return Err(BuildError::Empty);
    }
    let is_of_rounding = options.margin <= 0.0;
    let input_error = input.error_up();
    let options = &options.of_mesh(input_error)?;
    let positions: Vec<DVec3> = mesh.positions.iter().map(|&p| Vec3::from(p).as_dvec3()).collect();
    let obstacle = Obstacle::new(&positions, &triangles);
    // The surface that the search starts from has no wires, unless the mesh has only wires.
    let surface = if mesh.wires.is_empty() {
        Cow::Borrowed(mesh)
    } else if mesh.triangles.is_empty() {
        let Mesh { rounding, .. } = *mesh;
        Cow::Owned(Mesh { rounding, ..Mesh::new(mesh.positions.clone(), triangles) })
    } else {
        Cow::Owned(mesh.without_wires())
    };
    let mesh = &*surface;
    let solid = Solid::of(mesh);
    if let (Goal::Void(_), Err(why)) = (options.goal, solid) {
        return Err(BuildError::NoVolume(why));
    }
    let crosses =
        matches!(options.goal, Goal::Void(_)) && crosses_itself(&positions, &mesh.triangles);
    // A hull keeps some steps of its grid off the mesh. A coarse grid that holds the mesh is
    // therefore no reason to store the hull on it.
    let bits = match options.vertex_bits {
        VertexBits::Auto => VertexBits::F32,
        bits => bits,
    };
    let stored = store(mesh, bits);
    let is_whole = mesh.positions.len() == positions.len();
    let hull_frame = if is_whole && options.margin <= 0.0 {
        stored.clone()
    } else {
        hull_frame(&positions, options.margin, bits)?
    };
    let Bounds { low, high } = obstacle.bounds();
    let size = low.abs().max(high.abs()).max_element();
    let steps = Rounding::new(hull_frame.grid, hull_frame.scale_exponent).half_step(size);
    let obstacle = if is_of_rounding && options.margin <= FEW_STEPS * steps {
        obstacle.with_narrow_margin(options.margin)
    } else {
        obstacle.with_margin(options.margin)
    };
    // If the mesh is not on the grid, the grid is for the hull alone. The search starts from the
    // mesh as it is.
    let is_moved = stored.surface_error > mesh.rounding * exp2(-stored.scale_exponent);
    let stored = if is_moved { store(mesh, VertexBits::F32) } else { stored };
    let is_cancelled = AtomicBool::new(false);
    // Searches on other threads end by this flag: the watch stays on the caller's.
    let mut show = |stage| {
        if !watch.during(stage).goes_on(part_done(stage)) {
            is_cancelled.store(true, Ordering::Relaxed);
        }
    };
    let mut search = HullSearch {
        mesh,
        stored: &stored,
        hull_frame: &hull_frame,
        obstacle: &obstacle,
        solid: solid.ok(),
        options,
        // A limit beyond the range of the clock is no limit.
        deadline: Deadline {
            at: options.time_limit.and_then(|limit| started.checked_add(limit)),
            cancelled: Some(&is_cancelled),
        },
        is_hurried: false,
        on_progress: &mut show,
    };
    let found = search.run();
    watch.check()?;
    let CandidateHull { mut editor, start, filled, mut stop } = found?;
    editor.drop_enclosed();
    if search.is_hurried && stop == Outcome::Reached {
        stop = Outcome::OutOfTime;
    }
    let (positions, triangles) = editor.shell.compact();
    let volume = editor.shell.volume();
    let mut slack = slack(&editor.shell, &obstacle);
    // Every face was proved to be within the slack that was asked for.
    if let Goal::Slack(most) = options.goal
        && editor.max_distance <= most
    {
        slack.upper = slack.upper.min(most).max(slack.lower);
    }
    let mesh = Mesh::new(to_f32(&positions), triangles);
    let report = Report {
        faces: mesh.triangles.len(),
        volume,
        void: solid.and_then(|solid| solid.void(&mesh, volume)),
        crosses,
        slack,
        input_error,
        start,
        filled: filled + editor.enclosed,
        stop,
        stars: editor.placer.stars,
        programs: editor.placer.programs,
        time: started.elapsed(),
    };
    Ok((Hull { mesh, report }, obstacle))
}

/// The part of the work on a hull that is done.
fn part_done(stage: Stage) -> f64 {
    let ([from, to], done, of) = match stage {
        Stage::Collapsing { done, of } => ([0.0, 0.2], done, of),
        Stage::Shrinking { done, of } => ([0.2, 0.5], done, of),
        Stage::Polishing { done, of } => ([0.5, 0.9], done, of),
        _ => return 0.9,
    };
    from + (to - from) * (done as f64 / of.max(1) as f64).min(1.0)
}

fn to_f32(positions: &[DVec3]) -> Vec<[f32; 3]> {
    positions.iter().map(|p| p.as_vec3().to_array()).collect()
}

/// The frame and the coordinate format that hold all positions, or with a margin their box enlarged
/// by it.
fn hull_frame(positions: &[DVec3], margin: f64, bits: VertexBits) -> Result<Stored, BuildError> {
    if margin <= 0.0 {
        return Ok(store(&Mesh::new(to_f32(positions), Vec::new()), bits));
    }
    let bounds = Bounds::of(positions).grown(margin);
    let corners = [bounds.low, bounds.high];
    if !corners.iter().all(|p| p.as_vec3().is_finite()) {
        return Err(BuildError::MarginTooLarge);
    }
    Ok(store(&Mesh::new(to_f32(&corners), Vec::new()), bits))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::TAU;

    /// A torus with bumps.
    fn torus() -> Mesh {
        let [around, across] = [36u32, 18u32];
        let at = |n: u32, of: u32| TAU * n as f32 / of as f32;
        let corner = |n: u32| {
            let (u, v) = (at(n / across, around), at(n % across, across));
            let radius = 0.4 + 0.03 * (5.0 * u + 3.0 * v).sin();
            let out = 1.0 + radius * v.cos();
            [out * u.cos(), out * u.sin(), radius * v.sin()]
        };
        let number = |i: u32, j: u32| i % around * across + j % across;
        let quads = (0..around * across).flat_map(|n| {
            let (i, j) = (n / across, n % across);
            let [a, b, c, d] =
                [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)];
            [[a, b, c], [a, c, d]]
        });
        Mesh::new((0..around * across).map(corner).collect(), quads.collect())
    }

    #[test]
    fn a_hull_is_the_same_with_any_number_of_threads() {
        let mesh = torus();
        for goal in [Goal::Faces(120), Goal::Slack(0.05)] {
            let hull = |threads: usize| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                let options = Options::new(goal).with_effort(0.05);
                let hull = pool.install(|| wrap(&mesh, &options, Watch::NONE)).unwrap();
                let Report { stars, programs, .. } = hull.report;
                (hull.mesh.positions, hull.mesh.triangles, stars, programs)
            };
            let one = hull(1);
            assert!(one.2 > 0 && [2, 5].into_iter().all(|threads| hull(threads) == one));
        }
    }
}
