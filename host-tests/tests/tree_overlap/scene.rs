//! Meshes with their trees, motions, and what is true of them.

use meshsweep::emit::blob;
use meshsweep::mesh::Mesh;
use meshsweep::tree::{TreeOptions, build};
use meshsweep_core::Bvh;
use meshsweep_core::query::Ended;
use meshsweep_core::query::tree::{
    Contact, Overlap, PairEntry, TrianglePair, all_overlaps, overlap,
};
use meshsweep_core::tribox::Pose;
use meshsweep_host_tests::generate::{Rng, Triangles};
use meshsweep_host_tests::oracle::moved::{Place, meeting_pairs};

pub type Point = [f32; 3];

pub const IDENTITY: [Point; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// A mesh as it was given, and the blobs of its trees: on a grid, then with f32 vertices.
pub struct Scene {
    pub positions: Vec<Point>,
    pub triangles: Vec<[u32; 3]>,
    blobs: [Vec<u8>; 2],
}

impl Scene {
    pub fn new(mesh: Triangles) -> Scene {
        Scene::moved(mesh, 0.0, 0)
    }

    /// The blobs are of a mesh whose vertices were moved by up to `by` before, which their surface
    /// error says.
    pub fn moved((positions, triangles): Triangles, by: f32, seed: u64) -> Scene {
        let rng = &mut Rng::new(seed);
        let stored = positions.iter().map(|p| {
            let (length, way) = (0.99 * by * rng.unit_f32(), rng.direction());
            std::array::from_fn(|k| p[k] + length * way[k])
        });
        let mesh = Mesh::new(stored.collect(), triangles.clone());
        let blobs = [false, true].map(|single| {
            let options = TreeOptions { closest: false, single, ..TreeOptions::default() };
            blob(None, Some(&build(&mesh, f64::from(by), triangles.len(), &options).0))
        });
        Scene { positions, triangles, blobs }
    }

    /// On the grid, then with f32 vertices.
    pub fn trees(&self) -> [Bvh<'_>; 2] {
        self.blobs.each_ref().map(|bytes| Bvh::open(bytes).expect("opens"))
    }

    fn places(&self, at: impl Fn(Point) -> Place) -> Vec<[Place; 3]> {
        let places: Vec<Place> = self.positions.iter().map(|&p| at(p)).collect();
        self.triangles.iter().map(|t| t.map(|v| places[v as usize].clone())).collect()
    }

    /// Least and greatest corner.
    pub fn bounds(&self) -> (Point, Point) {
        let fold = |f: fn(f32, f32) -> f32| {
            std::array::from_fn(|k| self.positions.iter().map(|p| p[k]).reduce(f).unwrap_or(0.0))
        };
        (fold(f32::min), fold(f32::max))
    }
}

/// Pairs of triangles that meet, by exact predicates.
pub fn truth(a: &Scene, b: &Scene, pose: &Pose) -> Vec<[u32; 2]> {
    let moved = |p: Point| Place::moved(p, &pose.rotation, pose.translation);
    meeting_pairs(&a.places(Place::of), &b.places(moved))
}

/// A rotation up to rounding.
pub fn rotation(rng: &mut Rng) -> [Point; 3] {
    let x = rng.direction().map(f64::from);
    let other = rng.direction().map(f64::from);
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let unit = |v: [f64; 3]| {
        let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        v.map(|x| x / length)
    };
    let z = unit(cross(x, other));
    [x, cross(z, x), z].map(|row| row.map(|x| x as f32))
}

/// A motion that brings the middle of `b` to `place`, with any rotation.
pub fn placed(b: &Scene, rotation: [Point; 3], place: Point) -> Pose {
    let (low, high) = b.bounds();
    let middle: [f64; 3] = std::array::from_fn(|k| 0.5 * (f64::from(low[k]) + f64::from(high[k])));
    let translation = std::array::from_fn(|k| {
        let turned: f64 = (0..3).map(|j| f64::from(rotation[k][j]) * middle[j]).sum();
        (f64::from(place[k]) - turned) as f32
    });
    Pose { rotation, translation }
}

/// Random motions that leave the one now inside, now across, now beside the other.
pub fn motions(a: &Scene, b: &Scene, count: usize, seed: u64) -> Vec<Pose> {
    let mut rng = Rng::new(seed);
    let ((low, high), (from, to)) = (a.bounds(), b.bounds());
    let size = |low: Point, high: Point| (0..3).map(|k| high[k] - low[k]).fold(0f32, f32::max);
    let grown = 0.7 * size(from, to);
    let (low, high) = (low.map(|x| x - grown), high.map(|x| x + grown));
    (0..count)
        .map(|_| {
            let rotation = rotation(&mut rng);
            placed(b, rotation, rng.point_in(low, high))
        })
        .collect()
}

pub fn ask(a: &Bvh<'_>, b: &Bvh<'_>, pose: &Pose) -> Overlap {
    let mut stack = [PairEntry::EMPTY; PairEntry::ENOUGH];
    overlap(a, b, pose, u32::MAX, &mut stack).expect("answers")
}

/// All pairs and how the search ended; nothing may be dropped.
pub fn ask_all(a: &Bvh<'_>, b: &Bvh<'_>, pose: &Pose) -> (Vec<TrianglePair>, Ended) {
    let mut stack = [PairEntry::EMPTY; PairEntry::ENOUGH];
    let mut pairs = vec![TrianglePair::EMPTY; 200_000];
    let all = all_overlaps(a, b, pose, u32::MAX, &mut pairs, &mut stack).expect("answers");
    assert_eq!(all.dropped, 0);
    pairs.truncate(all.stored);
    (pairs, all.ended)
}

/// How often each answer was given.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Tally {
    pub apart: usize,
    pub meets: usize,
    pub open: usize,
}

/// Holds every answer about two meshes to the exact one, for each pair of their trees; counts the
/// answers of each.
pub fn holds(name: &str, a: &Scene, b: &Scene, pose: &Pose, tallies: &mut [Tally; 4]) {
    let truth = truth(a, b, pose);
    for (number, tally) in tallies.iter_mut().enumerate() {
        let (first, second) = (a.trees()[number & 1], b.trees()[number >> 1]);
        let name = format!("{name}, trees {number}, {pose:?}");
        let answer = ask(&first, &second, pose);
        let ended = match answer.contact {
            Contact::Apart => {
                tally.apart += 1;
                assert!(truth.is_empty(), "{name}: wrongly apart: {} pairs meet", truth.len());
                Ended::Exact
            }
            Contact::Meets => {
                tally.meets += 1;
                let pair = answer.triangles.expect("a pair");
                assert!(truth.contains(&pair), "{name}: {pair:?} do not meet");
                Ended::Exact
            }
            Contact::Open => {
                tally.open += 1;
                assert!(answer.triangles.is_some(), "{name}: which pair is open");
                Ended::Level
            }
        };
        assert_eq!(answer.ended, ended, "{name}");
        let (pairs, ended) = ask_all(&first, &second, pose);
        let mut listed: Vec<[u32; 2]> = pairs.iter().map(|pair| pair.triangles).collect();
        listed.sort_unstable();
        let count = listed.len();
        listed.dedup();
        assert_eq!(count, listed.len(), "{name}: a pair is listed twice");
        for pair in &truth {
            assert!(listed.binary_search(pair).is_ok(), "{name}: {pair:?} is missing");
        }
        for pair in pairs.iter().filter(|pair| pair.is_certain) {
            assert!(truth.contains(&pair.triangles), "{name}: {pair:?} do not meet");
        }
        let all_certain = pairs.iter().all(|pair| pair.is_certain);
        assert_eq!(ended, if all_certain { Ended::Exact } else { Ended::Level }, "{name}");
        assert_eq!(answer.contact == Contact::Apart, pairs.is_empty(), "{name}");
        assert_eq!(
            answer.contact == Contact::Meets,
            pairs.iter().any(|pair| pair.is_certain),
            "{name}"
        );
    }
}
