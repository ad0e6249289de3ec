//! The library's box tree: certified answers in f32.
//!
//! The blob serves distances and segments alike. Every answer is computed whole, with its interval
//! and triangle, though the race looks at its point or parameter alone.

use meshsweep::progress::Watch;
use std::hint::black_box;

use meshsweep::bvh::{FastBvh, TreeOptions, build as build_tree, closest_points};
use meshsweep_core::{Budget, Bvh, CoherentQuery, Facing, Hint, ScratchEntry, Verdict};
use meshsweep_host_tests::workload::Subject;

use super::engine::{Answer, Answers, Engine};
use super::on_one_thread;
use super::workload::{HitKind, Workload};
use crate::measure::stopwatch::Stopwatch;

/// How a list of queries is asked.
#[derive(Clone, Copy, PartialEq)]
pub enum Mode {
    /// Each on its own.
    Alone,
    /// The same with the instructions that the program is compiled for.
    Compiled,
    /// Each with the one before as a hint.
    Hint,
    /// Each from where the one before ended.
    Coherent,
    /// All at once, in Morton order where they come in none.
    Batch,
}

struct Tree<'a> {
    bytes: usize,
    tree: FastBvh<'a>,
    stack: Vec<ScratchEntry>,
    mode: Mode,
}

/// A tree of a mesh, which may be open.
///
/// # Errors
/// None but a fault of the builder.
pub fn build<'a>(
    subject: &Subject,
    blob: &'a mut Vec<u8>,
    mode: Mode,
    is_f32: bool,
) -> Result<Box<dyn Engine + 'a>, String> {
    let input = meshsweep::mesh::Input {
        input_triangles: subject.triangles_read,
        ..subject.mesh.as_input()
    };
    let options = TreeOptions::default().with_f32(is_f32);
    let (tables, _) =
        build_tree(input, &options, Watch::NONE).map_err(|error| error.to_string())?;
    *blob = tables.to_bytes();
    let tree = FastBvh::new(Bvh::open(blob).map_err(|error| error.to_string())?);
    let stack = vec![ScratchEntry::EMPTY; tree.scratch_entries()];
    Ok(Box::new(Tree { bytes: blob.len(), tree, stack, mode }))
}

impl Engine for Tree<'_> {
    fn bytes(&self) -> usize {
        self.bytes
    }

    fn answers(&self, workload: Workload) -> bool {
        use Workload::{Far, Field, Near, Orbit, Path};
        match self.mode {
            Mode::Alone | Mode::Compiled => true,
            Mode::Hint | Mode::Coherent => matches!(workload, Path | Orbit),
            Mode::Batch => matches!(workload, Far | Near | Field),
        }
    }

    fn closest(&mut self, points: &[[f32; 3]]) -> Result<Answers, String> {
        let Self { tree, stack, .. } = self;
        let (mut hint, mut query) = (Hint::NONE, CoherentQuery::<128>::new());
        match self.mode {
            Mode::Alone => Answers::each(points, |point| {
                black_box(tree.closest_point(point, Budget::EXACT, stack))
                    .map(|found| Answer::Point(found.point))
            }),
            Mode::Compiled => Answers::each(points, |point| {
                black_box((**tree).closest_point(point, Budget::EXACT, stack))
                    .map(|found| Answer::Point(found.point))
            }),
            Mode::Hint => Answers::each(points, |point| {
                black_box(tree.closest_point_from(point, &mut hint, Budget::EXACT, stack))
                    .map(|found| Answer::Point(found.point))
            }),
            Mode::Coherent => Answers::each(points, |point| {
                black_box(query.closest_point(tree, point, Budget::EXACT, stack))
                    .map(|found| Answer::Point(found.closest.point))
            }),
            Mode::Batch => on_one_thread(|| {
                let watch = Stopwatch::start();
                let found = black_box(closest_points(tree, points, &Budget::EXACT));
                let seconds = watch.seconds();
                let found = found.map_err(|error| error.to_string())?;
                let all = found.iter().map(|found| Answer::Point(found.point)).collect();
                Ok(Answers { all, seconds })
            }),
        }
    }

    fn hits(&mut self, segments: &[[[f32; 3]; 2]], kind: HitKind) -> Result<Answers, String> {
        let Self { tree, stack, mode, .. } = self;
        let (is_compiled, facing, budget) = (*mode == Mode::Compiled, Facing::Both, Budget::EXACT);
        match kind {
            HitKind::First => Answers::each(segments, |[a, b]| {
                black_box(if is_compiled {
                    (**tree).first_hit(a, b, facing, budget, stack)
                } else {
                    tree.first_hit(a, b, facing, budget, stack)
                })
                .map(|found| found.hit.map_or(Answer::Miss, |hit| Answer::Hit(hit.t)))
            }),
            HitKind::Any => Answers::each(segments, |[a, b]| {
                black_box(if is_compiled {
                    (**tree).any_hit(a, b, facing, budget, stack)
                } else {
                    tree.any_hit(a, b, facing, budget, stack)
                })
                .map(|found| match found.verdict {
                    Verdict::Yes => Answer::Meets,
                    Verdict::No => Answer::Miss,
                    _ => Answer::Undecided,
                })
            }),
        }
    }
}
