//! Seeded queries, and the meshes and poses that they are about.
//!
//! ```text
//! subject (mesh) ─┬─ points, segments, field, paths
//! sphere ─ pose ──┴─ contact (whether a mesh meets its moved copy)
//! thresholds (verdicts about pairs, beside the oracle's)
//! ```

pub mod contact;
pub mod pose;
pub mod sphere;
mod subject;
pub mod thresholds;

pub use meshsweep::trade::Points;
pub use subject::Subject;

use crate::generate::Rng;

/// `count` points.
#[must_use]
pub fn points(subject: &Subject, kind: Points, count: usize) -> Vec<[f32; 3]> {
    let mut rng = Rng::new(0x0070_6f69_6e74);
    match kind {
        Points::Far => {
            let [low, high] = doubled(subject);
            (0..count).map(|_| rng.point_in(low, high)).collect()
        }
        Points::Near => {
            let areas = areas(subject);
            (0..count).map(|_| near(subject, &areas, &mut rng)).collect()
        }
        Points::Path => path(subject, &mut rng, count),
    }
}

/// `count` segments whose ends lie on two different sides of a box twice the mesh's: what gives the
/// hits of paper 000.
#[must_use]
pub fn segments(subject: &Subject, count: usize) -> Vec<[[f32; 3]; 2]> {
    let mut rng = Rng::new(0x7365_676d_656e_7473);
    let bounds = doubled(subject);
    let mut on_side = |side: usize| {
        let mut point = rng.point_in(bounds[0], bounds[1]);
        point[side % 3] = bounds[side / 3][side % 3];
        point
    };
    let mut sides = Rng::new(0x0073_6964_6573);
    (0..count)
        .map(|_| {
            let first = sides.below(6);
            let second = (first + 1 + sides.below(5)) % 6;
            [on_side(first), on_side(second)]
        })
        .collect()
}

/// Nodes of a grid with `side` nodes along each axis, x fastest, over the mesh's box enlarged by a
/// tenth.
#[must_use]
pub fn field(subject: &Subject, side: usize) -> Vec<[f32; 3]> {
    let [low, high] = enlarged(subject, 1.1);
    let at = |axis: usize, node: usize| {
        low[axis] + (high[axis] - low[axis]) * (node as f32 / side.saturating_sub(1).max(1) as f32)
    };
    let row = |y: usize, z: usize| (0..side).map(move |x| [at(0, x), at(1, y), at(2, z)]);
    (0..side).flat_map(|z| (0..side).flat_map(move |y| row(y, z))).collect()
}

/// Step of [`surface_path`] and [`orbit`] in diagonals of the mesh's box: a tool that crosses it in
/// 3 s, asked 1,000 times a second.
pub const COHERENT_STEP: f64 = 3.0e-4;

/// A wandering path about 1 % of the diagonal off the surface, on whichever side it began, in steps
/// of [`COHERENT_STEP`]. `closest` tells the closest point of the surface, which keeps the path
/// there.
pub fn surface_path(
    subject: &Subject,
    count: usize,
    closest: impl Fn([f32; 3]) -> [f32; 3],
) -> Vec<[f32; 3]> {
    let mut rng = Rng::new(0x0073_7572_6661_6365);
    let step = (COHERENT_STEP * subject.diagonal()) as f32;
    let off = (0.01 * subject.diagonal()) as f32;
    let mut here = glam::Vec3::from_array(near(subject, &areas(subject), &mut rng));
    let mut heading = glam::Vec3::from_array(rng.direction());
    (0..count)
        .map(|_| {
            let now = here.to_array();
            let away = here - glam::Vec3::from_array(closest(now));
            let distance = away.length();
            let outward = away.normalize_or_zero();
            heading =
                (heading + glam::Vec3::from_array(rng.direction()) * 0.03).normalize_or_zero();
            let pull = ((off - distance) / off).clamp(-1.0, 1.0);
            heading = (heading + outward * (0.2 * pull - 0.05 * heading.dot(outward)))
                .normalize_or_zero();
            here += heading * step;
            now
        })
        .collect()
}

/// Along a closed curve through and around the mesh, in a box of 1.5 times its extents, in steps of
/// about [`COHERENT_STEP`].
#[must_use]
pub fn orbit(subject: &Subject, count: usize) -> Vec<[f32; 3]> {
    // Frequencies without a common multiple worth mentioning: the curve does not come back.
    const FREQUENCIES: [f64; 3] = [0.70, 0.93, 1.13];
    const PHASES: [f64; 3] = [0.0, 0.4, 1.1];
    let [low, high] = enlarged(subject, 1.5).map(|corner| corner.map(f64::from));
    let amplitude: [f64; 3] = std::array::from_fn(|k| 0.5 * (high[k] - low[k]));
    let step = COHERENT_STEP * subject.diagonal();
    let mut time = 0.0;
    (0..count)
        .map(|_| {
            let angle = |k: usize| FREQUENCIES[k] * time + PHASES[k];
            let point = std::array::from_fn(|k| {
                (f64::midpoint(low[k], high[k]) + amplitude[k] * libm::sin(angle(k))) as f32
            });
            let speed_sq: f64 =
                (0..3).map(|k| (amplitude[k] * FREQUENCIES[k] * libm::cos(angle(k))).powi(2)).sum();
            // Where the curve nearly stops, time must not jump.
            time += step / speed_sq.sqrt().max(0.05 * subject.diagonal());
            point
        })
        .collect()
}

fn doubled(subject: &Subject) -> [[f32; 3]; 2] {
    enlarged(subject, 2.0)
}

/// The mesh's box about its middle, `factor` times as large.
fn enlarged(subject: &Subject, factor: f32) -> [[f32; 3]; 2] {
    let [low, high] = subject.bounds;
    let middle: [f32; 3] = std::array::from_fn(|k| f32::midpoint(low[k], high[k]));
    let half = 0.5 * factor;
    [
        std::array::from_fn(|k| middle[k] - half * (high[k] - low[k])),
        std::array::from_fn(|k| middle[k] + half * (high[k] - low[k])),
    ]
}

/// Running sums of the triangles' areas.
fn areas(subject: &Subject) -> Vec<f64> {
    let mut sum = 0.0;
    let triangles = 0..subject.mesh.triangles.len();
    triangles
        .map(|triangle| {
            let [a, b, c] = corners(subject, triangle);
            sum += 0.5 * (b - a).cross(c - a).length();
            sum
        })
        .collect()
}

fn corners(subject: &Subject, triangle: usize) -> [glam::DVec3; 3] {
    subject.mesh.triangles[triangle]
        .map(|v| glam::Vec3::from_array(subject.mesh.positions[v as usize]).as_dvec3())
}

fn near(subject: &Subject, areas: &[f64], rng: &mut Rng) -> [f32; 3] {
    let at = rng.unit_f64() * areas.last().copied().unwrap_or(0.0);
    let triangle = areas.partition_point(|&sum| sum <= at).min(areas.len() - 1);
    let [a, b, c] = corners(subject, triangle);
    let (u, v) = (rng.unit_f64(), rng.unit_f64());
    let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
    let on_surface = a + (b - a) * u + (c - a) * v;
    let sigma = 0.01 * subject.diagonal();
    let moved = on_surface + glam::DVec3::new(gaussian(rng), gaussian(rng), gaussian(rng)) * sigma;
    moved.as_vec3().to_array()
}

/// Box & Muller (1958).
fn gaussian(rng: &mut Rng) -> f64 {
    let radius = libm::sqrt(-2.0 * libm::log(1.0 - rng.unit_f64()));
    radius * libm::cos(std::f64::consts::TAU * rng.unit_f64())
}

fn path(subject: &Subject, rng: &mut Rng, count: usize) -> Vec<[f32; 3]> {
    let areas = areas(subject);
    let step = (0.001 * subject.diagonal()) as f32;
    let mut waypoint = || glam::Vec3::from_array(near(subject, &areas, rng));
    let (mut here, mut goal) = (waypoint(), waypoint());
    (0..count)
        .map(|_| {
            let left = goal - here;
            if left.length() <= step {
                here = goal;
                goal = waypoint();
            } else {
                here += left * (step / left.length());
            }
            here.to_array()
        })
        .collect()
}
