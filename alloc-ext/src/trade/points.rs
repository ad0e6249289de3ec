//! Points and segments far from a mesh, near it, and along a path.

use crate::curve::Polyline;
use crate::mesh::Mesh;
use crate::random::SplitMix;
use glam::DVec3;

/// A kind of points.
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

    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Far => "far",
            Self::Near => "near",
            Self::Path => "path",
        }
    }
}

/// Standard deviation of a near point about the surface, as a part of the diagonal.
const NEAR: f64 = 0.01;

/// Step of a path, as a part of the diagonal.
const STEP: f64 = 0.001;

/// Length of a segment near the surface, as a part of the diagonal.
const LENGTH: f64 = 0.1;

/// `count` points of a kind, the same in every run. Empty if the mesh has no triangle with an area.
#[must_use]
pub fn points(mesh: &Mesh, kind: Points, count: usize) -> Vec<[f32; 3]> {
    points_of(&Surface::of(mesh), kind, count)
}

/// The same of curves: near ones are on segments by length, then moved. Along an axis on which the
/// curves do not extend, as the z of a fence, no point leaves them. Empty without length.
#[must_use]
pub fn points_of_curves(polylines: &[Polyline], kind: Points, count: usize) -> Vec<[f32; 3]> {
    points_of(&Surface::of_curves(polylines), kind, count)
}

/// The diagonal of the box of curves.
#[must_use]
pub fn diagonal_of_curves(polylines: &[Polyline]) -> f64 {
    Surface::of_curves(polylines).diagonal()
}

fn points_of(surface: &Surface, kind: Points, count: usize) -> Vec<[f32; 3]> {
    if surface.sums.last().is_none_or(|&area| area <= 0.0) {
        return Vec::new();
    }
    let mut random = SplitMix::new(0x7472_6164_6500 + kind as u64);
    let single = |p: DVec3| p.as_vec3().to_array();
    match kind {
        Points::Far => {
            let (middle, size) = ((surface.low + surface.high) * 0.5, surface.high - surface.low);
            // A direction has coordinates from -1 to 1.
            (0..count).map(|_| single(middle + random.direction() * size)).collect()
        }
        Points::Near => (0..count).map(|_| single(surface.near(&mut random))).collect(),
        Points::Path => {
            let step = STEP * surface.diagonal();
            let (mut here, mut goal) = (surface.near(&mut random), surface.near(&mut random));
            let mut next = || {
                let left = goal - here;
                if left.length() <= step {
                    here = goal;
                    goal = surface.near(&mut random);
                } else {
                    here += left * (step / left.length());
                }
                single(here)
            };
            (0..count).map(|_| next()).collect()
        }
    }
}

/// `count` segments of a kind, the same in every run: two points each. Empty if the mesh has no
/// triangle with an area.
///
/// Far ones end on two different sides of a box twice the mesh's. Near ones begin near the surface,
/// and are a tenth of the diagonal long. Those of a path are its steps.
#[must_use]
pub fn segments(mesh: &Mesh, kind: Points, count: usize) -> Vec<[f32; 3]> {
    let mut random = SplitMix::new(0x7472_6164_6510 + kind as u64);
    match kind {
        Points::Far => {
            let mut ends = points(mesh, kind, 2 * count);
            let surface = Surface::of(mesh);
            let (middle, size) = ((surface.low + surface.high) * 0.5, surface.high - surface.low);
            for segment in ends.as_chunks_mut::<2>().0 {
                let first = (random.roll() * 6.0) as usize % 6;
                let second = (first + 1 + (random.roll() * 5.0) as usize % 5) % 6;
                for (end, side) in segment.iter_mut().zip([first, second]) {
                    let (axis, sign) = (side % 3, if side < 3 { -1.0 } else { 1.0 });
                    end[axis] = (middle[axis] + sign * size[axis]) as f32;
                }
            }
            ends
        }
        Points::Near => {
            let length = LENGTH * diagonal(mesh);
            let end = |from: [f32; 3]| {
                let offset = random.direction().normalize_or_zero() * length;
                [from, (DVec3::from(from.map(f64::from)) + offset).as_vec3().to_array()]
            };
            points(mesh, kind, count).into_iter().flat_map(end).collect()
        }
        Points::Path => {
            let places = points(mesh, kind, count + 1);
            places.windows(2).flat_map(|step| [step[0], step[1]]).collect()
        }
    }
}

/// The diagonal of the mesh's box.
#[must_use]
pub fn diagonal(mesh: &Mesh) -> f64 {
    let side = |k: usize| {
        let all = || mesh.positions.iter().map(|p| f64::from(p[k]));
        all().fold(f64::NEG_INFINITY, f64::max) - all().fold(f64::INFINITY, f64::min)
    };
    (0..3).map(|k| side(k).powi(2)).sum::<f64>().sqrt()
}

/// The segments of curves as triangles of two equal corners, the closing ones too.
pub(super) fn segments_of_curves(polylines: &[Polyline]) -> Vec<[DVec3; 3]> {
    let of = |polyline: &Polyline| {
        let points: Vec<DVec3> = polyline.points.iter().map(|&p| DVec3::from(p)).collect();
        let count = points.len() - usize::from(!polyline.is_closed);
        let end = move |k: usize| points[k % points.len()];
        (0..count).map(|k| [end(k), end(k + 1), end(k + 1)]).collect::<Vec<_>>()
    };
    polylines.iter().filter(|polyline| !polyline.points.is_empty()).flat_map(of).collect()
}

/// Triangles with running sums of their areas, or segments with those of their lengths, and the box
/// of all.
struct Surface {
    triangles: Vec<[DVec3; 3]>,
    sums: Vec<f64>,
    low: DVec3,
    high: DVec3,
    /// 1 along axes on which near points leave it, else 0.
    moved: DVec3,
}

impl Surface {
    fn of(mesh: &Mesh) -> Self {
        Self::by(mesh.corners_f64().collect(), |[a, b, c]| (b - a).cross(c - a).length())
    }

    fn of_curves(polylines: &[Polyline]) -> Self {
        let all = Self::by(segments_of_curves(polylines), |[a, b, _]| a.distance(*b));
        let is_flat = all.high.cmpeq(all.low);
        Self { moved: DVec3::select(is_flat, DVec3::ZERO, DVec3::ONE), ..all }
    }

    /// Each triangle is as likely as its size says.
    fn by(triangles: Vec<[DVec3; 3]>, size: impl Fn(&[DVec3; 3]) -> f64) -> Self {
        let mut sum = 0.0;
        let sums = triangles.iter().map(|triangle| {
            sum += size(triangle);
            sum
        });
        let sums = sums.collect();
        let corners = || triangles.iter().flatten();
        let low = corners().fold(DVec3::INFINITY, |low, &p| low.min(p));
        let high = corners().fold(DVec3::NEG_INFINITY, |high, &p| high.max(p));
        Self { triangles, sums, low, high, moved: DVec3::ONE }
    }

    fn diagonal(&self) -> f64 {
        (self.high - self.low).length()
    }

    fn near(&self, random: &mut SplitMix) -> DVec3 {
        let at = random.roll() * self.sums.last().copied().unwrap_or(0.0);
        let index = self.sums.partition_point(|&sum| sum <= at).min(self.triangles.len() - 1);
        let [a, b, c] = self.triangles[index];
        let (u, v) = (random.roll(), random.roll());
        let (u, v) = match (b == c, u + v > 1.0) {
            (true, _) => (u, 0.0),
            (_, true) => (1.0 - u, 1.0 - v),
            _ => (u, v),
        };
        let off = self.moved * DVec3::from_array([(); 3].map(|()| gaussian(random)));
        a + (b - a) * u + (c - a) * v + off * (NEAR * self.diagonal())
    }
}

/// Box & Muller (1958).
fn gaussian(random: &mut SplitMix) -> f64 {
    let radius = (-2.0 * (1.0 - random.roll()).ln()).sqrt();
    radius * (std::f64::consts::TAU * random.roll()).cos()
}
