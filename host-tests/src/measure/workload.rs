//! Seeded queries.

use crate::generate::Rng;

use super::Subject;

/// Points to ask the closest point of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Points {
    /// Uniform in a box twice the mesh's.
    Far,
    /// On the surface by area, then moved by a Gaussian of 1 % of the diagonal on each axis.
    Near,
    /// Along straight lines between near points, in steps of 0.1 % of the diagonal.
    Path,
}

impl Points {
    /// All kinds.
    pub const ALL: [Self; 3] = [Self::Far, Self::Near, Self::Path];

    /// Its name in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Far => "far",
            Self::Near => "near",
            Self::Path => "path",
        }
    }
}

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

/// `count` segments whose ends lie on two different sides of a box twice the mesh's: what gives the hits of paper 000.
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

fn doubled(subject: &Subject) -> [[f32; 3]; 2] {
    let [low, high] = subject.bounds;
    let middle: [f32; 3] = std::array::from_fn(|k| f32::midpoint(low[k], high[k]));
    [
        std::array::from_fn(|k| middle[k] - (high[k] - low[k])),
        std::array::from_fn(|k| middle[k] + (high[k] - low[k])),
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
