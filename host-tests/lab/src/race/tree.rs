//! The library's box tree: certified answers in f32.
//!
//! The blob serves distances and segments alike. Every answer is computed whole, with its interval
//! and triangle, though the race looks at its point or parameter alone.

use meshsweep::progress::Watch;
use std::hint::black_box;

use meshsweep::bvh::{FastBvh, TreeOptions, build as build_tree, closest_points};
use meshsweep_core::{Budget, Bvh, CoherentQuery, Facing, ScratchEntry, Verdict};
use meshsweep_host_tests::workload::Subject;

use rayon::{ThreadPool, ThreadPoolBuilder};

use super::engine::{Answer, Engine, try_each};
use super::workload::{HitKind, Workload};

/// How a list of points is asked.
#[derive(Clone, Copy, PartialEq)]
enum Way {
    /// Each on its own.
    Alone,
    /// The same with the instructions that the program is compiled for.
    Compiled,
    /// Each from where the one before ended.
    Coherent,
    /// All at once, in Morton order where they come in none.
    Batch,
}

struct Tree<'a> {
    bytes: usize,
    tree: FastBvh<'a>,
    stack: Vec<ScratchEntry>,
    /// One thread, for a batch.
    pool: ThreadPool,
    way: Way,
    workloads: &'static [Workload],
}

/// A tree of a mesh, which may be open.
fn open<'a>(
    subject: &Subject,
    is_f32: bool,
    blob: &'a mut Vec<u8>,
    way: Way,
    workloads: &'static [Workload],
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
    let pool = ThreadPoolBuilder::new().num_threads(1).build().map_err(|e| e.to_string())?;
    Ok(Box::new(Tree { bytes: blob.len(), tree, stack, pool, way, workloads }))
}

/// One query after the other.
///
/// # Errors
/// None but a fault of the builder.
pub fn build<'a>(subject: &Subject, blob: &'a mut Vec<u8>) -> Result<Box<dyn Engine + 'a>, String> {
    open(subject, false, blob, Way::Alone, &Workload::ALL)
}

/// One query after the other, without the instructions of this processor.
///
/// # Errors
/// None but a fault of the builder.
pub fn build_compiled<'a>(
    subject: &Subject,
    blob: &'a mut Vec<u8>,
) -> Result<Box<dyn Engine + 'a>, String> {
    let workloads = &[Workload::Far, Workload::Near, Workload::Segments, Workload::AnyHit];
    open(subject, false, blob, Way::Compiled, workloads)
}

/// With vertices as they were, in f32.
///
/// # Errors
/// None but a fault of the builder.
pub fn build_single<'a>(
    subject: &Subject,
    blob: &'a mut Vec<u8>,
) -> Result<Box<dyn Engine + 'a>, String> {
    let workloads = &[Workload::Far, Workload::Near, Workload::Segments, Workload::AnyHit];
    open(subject, true, blob, Way::Alone, workloads)
}

/// On paths, a coherent query.
///
/// # Errors
/// None but a fault of the builder.
pub fn build_coherent<'a>(
    subject: &Subject,
    blob: &'a mut Vec<u8>,
) -> Result<Box<dyn Engine + 'a>, String> {
    open(subject, false, blob, Way::Coherent, &[Workload::Path, Workload::Orbit])
}

/// All queries of a list at once.
///
/// # Errors
/// None but a fault of the builder.
pub fn build_batch<'a>(
    subject: &Subject,
    blob: &'a mut Vec<u8>,
) -> Result<Box<dyn Engine + 'a>, String> {
    let workloads = &[Workload::Far, Workload::Near, Workload::Field];
    open(subject, false, blob, Way::Batch, workloads)
}

impl Engine for Tree<'_> {
    fn bytes(&self) -> usize {
        self.bytes
    }

    fn answers(&self, workload: Workload) -> bool {
        self.workloads.contains(&workload)
    }

    fn closest(&mut self, points: &[[f32; 3]], answers: &mut Vec<Answer>) -> Result<(), String> {
        let Self { tree, stack, pool, .. } = self;
        match self.way {
            Way::Alone => try_each(points, answers, |point| {
                let found = black_box(tree.closest_point(point, Budget::EXACT, stack));
                found.map(|found| Answer::Point(found.point)).map_err(|error| error.to_string())
            }),
            Way::Compiled => try_each(points, answers, |point| {
                let found = black_box((**tree).closest_point(point, Budget::EXACT, stack));
                found.map(|found| Answer::Point(found.point)).map_err(|error| error.to_string())
            }),
            Way::Coherent => {
                let mut query = CoherentQuery::<128>::new();
                try_each(points, answers, |point| {
                    let found = black_box(query.closest_point(tree, point, Budget::EXACT, stack));
                    found
                        .map(|found| Answer::Point(found.closest.point))
                        .map_err(|error| error.to_string())
                })
            }
            Way::Batch => {
                let found = pool
                    .install(|| closest_points(tree, points, &Budget::EXACT))
                    .map_err(|error| error.to_string())?;
                answers.clear();
                answers.extend(found.iter().map(|found| Answer::Point(found.point)));
                Ok(())
            }
        }
    }

    fn hits(
        &mut self,
        segments: &[[[f32; 3]; 2]],
        kind: HitKind,
        answers: &mut Vec<Answer>,
    ) -> Result<(), String> {
        let Self { tree, stack, way, .. } = self;
        let (is_compiled, facing, budget) = (*way == Way::Compiled, Facing::Both, Budget::EXACT);
        match kind {
            HitKind::First => try_each(segments, answers, |[a, b]| {
                let found = black_box(if is_compiled {
                    (**tree).first_hit(a, b, facing, budget, stack)
                } else {
                    tree.first_hit(a, b, facing, budget, stack)
                });
                let found = found.map_err(|error| error.to_string())?;
                Ok(found.hit.map_or(Answer::Miss, |hit| Answer::Hit(hit.t)))
            }),
            HitKind::Any => try_each(segments, answers, |[a, b]| {
                let found = black_box(if is_compiled {
                    (**tree).any_hit(a, b, facing, budget, stack)
                } else {
                    tree.any_hit(a, b, facing, budget, stack)
                });
                Ok(match found.map_err(|error| error.to_string())?.verdict {
                    Verdict::Yes => Answer::Meets,
                    Verdict::No => Answer::Miss,
                    _ => Answer::Undecided,
                })
            }),
        }
    }
}
