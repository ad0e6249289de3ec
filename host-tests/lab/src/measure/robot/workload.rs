//! The arm's blobs, poses and pairs, and the true distances of the pairs.

use std::path::Path;

use meshsweep::bvh::{TreeOptions, build};
use meshsweep::progress::Watch;
use meshsweep_core::Pose;
use meshsweep_host_tests::oracle::placed::{Corners, Placed, Tree, distance};
use meshsweep_host_tests::workload::Subject;
use meshsweep_suite::ask::robot::{self, MODELS, PAIRS, Pair, Question, Row};
use rayon::prelude::*;

use super::arm::{self, Motion, NAMES};

/// Ticks of a run of `ticks.csv`.
const RUN: usize = 200;

/// Rows of one file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Set {
    /// Places some 40 mm apart, each a run of its own or not, as the guard likes.
    Path,
    /// Places a tick apart.
    Ticks,
}

/// A row, and what is true of it.
#[derive(Clone, Debug)]
pub struct Tick {
    /// Of which file.
    pub set: Set,
    motions: [Motion; MODELS],
    poses: [Pose; MODELS],
    begins: bool,
    /// The distance of each pair.
    pub truth: [f64; PAIRS.len()],
}

impl Tick {
    /// Whether each pair is farther than it must be.
    #[must_use]
    pub fn is_clear(&self) -> bool {
        self.truth.iter().zip(&PAIRS).all(|(truth, (_, _, limit))| *truth > f64::from(*limit))
    }
}

/// A pair that is asked about alone, and its distance.
#[derive(Clone, Copy, Debug)]
pub struct Single {
    /// The pair, with its question.
    pub pair: Pair,
    /// Its distance.
    pub truth: f64,
}

impl Single {
    /// How far the pair is beyond the distance that it must keep.
    #[must_use]
    pub fn beyond(&self) -> f64 {
        self.truth - f64::from(self.pair.distance)
    }
}

/// All that is asked.
#[derive(Clone, Debug)]
pub struct Workload {
    blobs: Vec<Vec<u8>>,
    /// Rows in the order of asking.
    pub ticks: Vec<Tick>,
    /// Pairs in the order of asking.
    pub singles: Vec<Single>,
}

/// A range of distances in metres: the least, and the first that is beyond.
pub type Range = [f64; 2];

/// Pairs by their distance beyond the threshold: those of [`Question::Within`].
pub const BEYOND: [(&str, Range); 6] = [
    ("nearer than the threshold", [f64::NEG_INFINITY, 0.0]),
    ("0 to 5 mm beyond it", [0.0, 0.005]),
    ("5 to 20 mm", [0.005, 0.02]),
    ("20 to 50 mm", [0.02, 0.05]),
    ("50 to 300 mm", [0.05, 0.3]),
    ("more than 300 mm", [0.3, f64::INFINITY]),
];

/// Pairs by their distance: those of [`Question::Distance`].
pub const APART: [(&str, Range); 4] = [
    ("0 to 20 mm apart", [0.0, 0.02]),
    ("20 to 50 mm", [0.02, 0.05]),
    ("50 to 300 mm", [0.05, 0.3]),
    ("more than 300 mm", [0.3, f64::INFINITY]),
];

/// Whether a number is in a range.
#[must_use]
pub fn is_in(range: Range, x: f64) -> bool {
    range[0] <= x && x < range[1]
}

impl Workload {
    /// Reads the folder: meshes, `path.csv` and `ticks.csv`. Of the places every `every`th is
    /// asked, of each run of ticks the first `1 / every`. `singles` pairs of each range are asked
    /// about alone, or all if they are fewer.
    ///
    /// # Errors
    /// A file that is missing or wrong.
    pub fn read(folder: &Path, every: usize, singles: usize) -> Result<Self, String> {
        let (mut blobs, mut meshes) = (Vec::new(), Vec::new());
        for name in NAMES {
            let file = folder.join(name).with_extension("stl");
            blobs.push(blob(&file)?);
            meshes.push(Tree::new(triangles(&file)?));
        }
        let read = |name: &str| {
            let file = folder.join(name);
            let text = std::fs::read_to_string(&file);
            arm::angles(&text.map_err(|error| format!("{}: {error}", file.display()))?)
        };
        let path = read("path.csv")?.into_iter().step_by(every).enumerate();
        let path = path.map(|(at, angles)| (Set::Path, at == 0, angles));
        let ticks =
            read("ticks.csv")?.into_iter().enumerate().filter(|(at, _)| at % RUN < RUN / every);
        let ticks = ticks.map(|(at, angles)| (Set::Ticks, at % RUN == 0, angles));
        let rows: Vec<_> = path.chain(ticks).collect();
        let of_row = |(set, begins, angles): (Set, bool, [f64; arm::JOINTS])| {
            let motions = arm::placed(angles);
            let poses = motions.map(|motion| motion.pose());
            let placed: Vec<Placed<'_>> =
                meshes.iter().zip(&poses).map(|(mesh, pose)| mesh.at(pose)).collect();
            let truth = PAIRS.map(|(a, b, _)| distance(&placed[a], &placed[b]));
            Tick { set, motions, poses, begins, truth }
        };
        let ticks: Vec<Tick> = rows.into_par_iter().map(of_row).collect();
        let asked = Single::drawn(&ticks, singles);
        Ok(Self { blobs, ticks, singles: asked })
    }

    /// Bytes of all blobs.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.blobs.iter().map(Vec::len).sum()
    }

    /// The bytes that the suite reads.
    #[must_use]
    pub fn laid(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        let blobs = std::array::from_fn(|at| self.blobs[at].as_slice());
        let row = |tick: &Tick| Row { begins: tick.begins, poses: tick.poses };
        let rows: Vec<Row> = self.ticks.iter().map(row).collect();
        let pairs: Vec<Pair> = self.singles.iter().map(|single| single.pair).collect();
        robot::lay(blobs, &rows, &pairs, |part| bytes.extend_from_slice(part));
        bytes
    }
}

impl Single {
    /// Pairs of the path, evenly from each range.
    fn drawn(ticks: &[Tick], most: usize) -> Vec<Self> {
        let rows = ticks.iter().filter(|tick| tick.set == Set::Path);
        let all: Vec<Self> = rows.flat_map(Self::of).collect();
        let mut drawn = Vec::new();
        let mut draw = |question, range, key: fn(&Self) -> f64| {
            let inside: Vec<&Self> =
                all.iter().filter(|single| is_in(range, key(single))).collect();
            let step = inside.len().div_ceil(most).max(1);
            let asked = inside.into_iter().step_by(step).copied();
            drawn.extend(
                asked.map(|Self { pair, truth }| Self { pair: Pair { question, ..pair }, truth }),
            );
        };
        for (_, range) in BEYOND {
            draw(Question::Within, range, Self::beyond);
        }
        for (_, range) in APART {
            draw(Question::Distance, range, |single| single.truth);
        }
        drawn
    }

    fn of(tick: &Tick) -> impl Iterator<Item = Self> {
        PAIRS.iter().zip(&tick.truth).map(|(&(a, b, distance), &truth)| {
            let pose = tick.motions[a].back().after(&tick.motions[b]).pose();
            let pair = Pair { question: Question::Within, models: [a, b], distance, pose };
            Self { pair, truth }
        })
    }
}

/// The mesh's box tree as `meshsweep build --for segment` makes it.
pub(super) fn blob(file: &Path) -> Result<Vec<u8>, String> {
    let subject = Subject::load_any(file)?;
    let mesh = subject.mesh.as_input();
    let input = meshsweep::mesh::Input { input_triangles: subject.triangles_read, ..mesh };
    let options = TreeOptions::default().with_closest(false);
    let built = build(input, &options, Watch::NONE).map_err(|error| error.to_string())?;
    Ok(built.0.to_bytes())
}

/// The triangles of a binary STL, by no code of the library.
pub(super) fn triangles(file: &Path) -> Result<Vec<Corners>, String> {
    let bytes = std::fs::read(file).map_err(|error| format!("{}: {error}", file.display()))?;
    let count = bytes.get(80..84).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]));
    let body = bytes.get(84..).unwrap_or_default();
    if count.is_none_or(|count| count == 0 || body.len() != 50 * count as usize) {
        return Err(format!("{} is no binary STL", file.display()));
    }
    let number = |b: &[u8]| f32::from_le_bytes([b[0], b[1], b[2], b[3]]);
    let corner = |record: &[u8], at: usize| [0, 4, 8].map(|k| number(&record[12 * at + k..]));
    Ok(body.chunks_exact(50).map(|record| [1, 2, 3].map(|at| corner(record, at))).collect())
}
