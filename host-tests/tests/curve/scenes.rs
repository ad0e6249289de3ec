//! Curves, their blobs and their oracle.

use meshsweep::curve::{CurveOptions, Polyline, build};
use meshsweep::progress::Watch;
use meshsweep_core::{Curve, CurveSegment, ScratchEntry};
use meshsweep_host_tests::generate::Rng;
use meshsweep_host_tests::generate::curves::{
    circle, fence, open, spiral, tool_path, walk, zig_zag,
};
use meshsweep_host_tests::oracle::{Bounded, distance_to_segments};

pub struct Scene {
    pub name: &'static str,
    /// Ends of the input's segments, and their names.
    pub segments: Vec<([[f64; 3]; 2], CurveSegment)>,
    bytes: Vec<u8>,
}

impl Scene {
    pub fn new(name: &'static str, polylines: &[Polyline], is_f32: bool) -> Self {
        let bytes =
            build(polylines, &CurveOptions { is_f32 }, Watch::NONE).expect("a curve").0.to_bytes();
        let mut segments = Vec::new();
        for (polyline, Polyline { points, is_closed, .. }) in (0..).zip(polylines) {
            let mut points = points.clone();
            if *is_closed && points.first() != points.last() {
                points.push(points[0]);
            }
            let ends = points.windows(2).map(|pair| [pair[0], pair[1]]);
            let named = (0..).map(|segment| CurveSegment { polyline, segment });
            segments.extend(ends.zip(named));
        }
        Scene { name, segments, bytes }
    }

    pub fn curve(&self) -> Curve<'_> {
        Curve::open(&self.bytes).expect("opens")
    }

    pub fn truth(&self, p: [f32; 3]) -> Bounded {
        distance_to_segments(p, self.segments.iter().map(|(ends, _)| *ends))
    }

    /// The distance of one segment.
    pub fn distance(&self, p: [f32; 3], name: CurveSegment) -> Bounded {
        let named = self.segments.iter().filter(|(_, other)| *other == name);
        distance_to_segments(p, named.map(|(ends, _)| *ends))
    }

    /// The longest side of the box.
    pub fn size(&self) -> f32 {
        let [low, high] = self.curve().bounds();
        (0..3).fold(0.0, |size, axis| f32::max(size, high[axis] - low[axis]))
    }

    /// Points around the curve, near it at all scales, on it, and far away.
    pub fn points(&self, count: usize, seed: u64) -> Vec<[f32; 3]> {
        let mut rng = Rng::new(seed);
        let ([low, high], size) = (self.curve().bounds(), self.size());
        let mut point = |kind: usize| {
            let ([a, b], _) = self.segments[rng.below(self.segments.len())];
            let t = if kind.is_multiple_of(2) { 0.0 } else { rng.unit_f64() };
            let on: [f64; 3] = std::array::from_fn(|k| a[k] + t * (b[k] - a[k]));
            let away = match kind {
                0 | 1 => 0.0,
                2 | 3 => 1e-6,
                4 | 5 => 0.003,
                6 => 0.05,
                7 => 300.0,
                _ => return rng.point_in(low, high),
            };
            on.map(|x| x as f32 + away * size * rng.range(-1.0, 1.0))
        };
        (0..count).map(|k| point(k % 10)).collect()
    }
}

/// Each shape in f32 and on a grid.
pub fn scenes() -> Vec<Scene> {
    let a = [1.0, 2.0, 3.0];
    let scaled = |factor: f64, shift: f64| {
        let Polyline { points, .. } = walk(60, 8);
        let points = points.into_iter().map(|point| point.map(|x| (x + shift) * factor)).collect();
        vec![open(points)]
    };
    let mut random = Rng::new(77);
    let mut scattered = || std::array::from_fn(|_| random.unit_f64());
    [
        ("walk", vec![walk(400, 1)]),
        ("spiral", vec![spiral(400)]),
        ("zig-zag", vec![zig_zag(300)]),
        ("tool path", vec![tool_path(400)]),
        ("circle", vec![circle(100)]),
        ("fence", fence()),
        ("scattered", vec![open((0..200).map(|_| scattered()).collect())]),
        ("two points", vec![open(vec![[0.1; 3], [-0.7, 0.3, 0.2]])]),
        ("one place", vec![open(vec![a; 5])]),
        ("one place at the origin", vec![open(vec![[0.0; 3]; 3])]),
        ("repeated", vec![open(vec![a, a, [4.0, 2.0, 3.0], [4.0, 2.0, 3.0], a, [7.0, 7.0, 7.0]])]),
        ("collinear", vec![open((0..90).map(|k| [f64::from(k * k % 37), 0.5, 0.0]).collect())]),
        ("several", vec![walk(9, 1), open(vec![[0.5; 3]; 3]), circle(7), walk(1, 2)]),
        ("tiny", scaled(1e-25, 0.0)),
        ("huge", scaled(1e25, 0.0)),
        ("shifted", scaled(1.0, 3000.0)),
        (
            "mixed scales",
            vec![open(
                (0..60)
                    .map(|k| [(-0.9 * f64::from(k)).exp(), (-1.1 * f64::from(k)).exp(), 0.0])
                    .collect(),
            )],
        ),
    ]
    .into_iter()
    .flat_map(|(name, polylines)| [true, false].map(|is_f32| Scene::new(name, &polylines, is_f32)))
    .collect()
}

pub fn scratch(entries: usize) -> Vec<ScratchEntry> {
    vec![ScratchEntry::EMPTY; entries]
}
