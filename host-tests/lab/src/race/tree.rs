//! The library's box tree: certified answers in f32.
//!
//! The blob serves distances and segments alike. Every answer is computed whole, with its interval
//! and triangle, though the race looks at its point or parameter alone.

use std::hint::black_box;

use meshsweep::bvh::{TreeOptions, build as build_tree};
use meshsweep_core::{Budget, Bvh, ClosestPoint, CoherentQuery, Facing, Hint, ScratchEntry};
use meshsweep_host_tests::workload::Subject;

use super::engine::{Answer, Engine, try_each};
use super::{Scope, Workload};

/// One query after the other, each on its own.
struct Alone<'a> {
    bytes: usize,
    tree: Bvh<'a>,
    stack: Vec<ScratchEntry>,
    workloads: &'static [Workload],
}

/// Builds a tree of a mesh, which may be open, and opens it; the blob's bytes.
fn open<'a>(
    subject: &Subject,
    options: &TreeOptions,
    blob: &'a mut Vec<u8>,
) -> Result<(usize, Bvh<'a>), String> {
    let (tables, _) = build_tree(
        meshsweep::mesh::Input {
            input_triangles: subject.triangles_read,
            ..subject.mesh.as_input()
        },
        options,
    )
    .expect("builds");
    *blob = tables.to_bytes();
    let tree = Bvh::open(blob).map_err(|error| error.to_string())?;
    Ok((blob.len(), tree))
}

fn alone<'a>(
    subject: &Subject,
    options: &TreeOptions,
    blob: &'a mut Vec<u8>,
    workloads: &'static [Workload],
) -> Result<Option<Box<dyn Engine + 'a>>, String> {
    let (bytes, tree) = open(subject, options, blob)?;
    let entries = tree.header().stack_entries as usize;
    Ok(Some(Box::new(Alone { bytes, tree, stack: vec![ScratchEntry::EMPTY; entries], workloads })))
}

/// On every mesh.
///
/// # Errors
/// None but a fault of the builder.
pub fn build<'a>(
    subject: &Subject,
    _: &Scope,
    blob: &'a mut Vec<u8>,
) -> Result<Option<Box<dyn Engine + 'a>>, String> {
    alone(subject, &TreeOptions::default(), blob, &Workload::ALL)
}

/// With vertices as they were, in f32.
///
/// # Errors
/// None but a fault of the builder.
pub fn build_single<'a>(
    subject: &Subject,
    _: &Scope,
    blob: &'a mut Vec<u8>,
) -> Result<Option<Box<dyn Engine + 'a>>, String> {
    let options = TreeOptions::default().with_f32(true);
    alone(subject, &options, blob, &[Workload::Far, Workload::Near, Workload::Segments])
}

impl Engine for Alone<'_> {
    fn bytes(&self) -> usize {
        self.bytes
    }

    fn limit(&self, workload: Workload) -> usize {
        if self.workloads.contains(&workload) { usize::MAX } else { 0 }
    }

    fn closest(&mut self, points: &[[f32; 3]], answers: &mut Vec<Answer>) -> Result<(), String> {
        try_each(points, answers, |point| {
            let found = black_box(self.tree.closest_point(point, Budget::EXACT, &mut self.stack));
            found.map(|found| Answer::Point(found.point)).map_err(|error| error.to_string())
        })
    }

    fn first_hits(
        &mut self,
        segments: &[[[f32; 3]; 2]],
        answers: &mut Vec<Answer>,
    ) -> Result<(), String> {
        try_each(segments, answers, |[a, b]| {
            let found =
                black_box(self.tree.first_hit(a, b, Facing::Both, Budget::EXACT, &mut self.stack));
            let found = found.map_err(|error| error.to_string())?;
            Ok(found.hit.map_or(Answer::Miss, |hit| Answer::Hit(hit.t)))
        })
    }
}

/// On paths, each query from where the one before ended.
///
/// # Errors
/// None but a fault of the builder.
pub fn build_session<'a>(
    subject: &Subject,
    _: &Scope,
    blob: &'a mut Vec<u8>,
) -> Result<Option<Box<dyn Engine + 'a>>, String> {
    let (bytes, tree) = open(subject, &TreeOptions::default(), blob)?;
    let stack = vec![ScratchEntry::EMPTY; tree.header().stack_entries as usize];
    Ok(Some(Box::new(Following { bytes, tree, stack })))
}

struct Following<'a> {
    bytes: usize,
    tree: Bvh<'a>,
    stack: Vec<ScratchEntry>,
}

impl Engine for Following<'_> {
    fn bytes(&self) -> usize {
        self.bytes
    }

    fn limit(&self, workload: Workload) -> usize {
        if matches!(workload, Workload::Path | Workload::Orbit) { usize::MAX } else { 0 }
    }

    fn closest(&mut self, points: &[[f32; 3]], answers: &mut Vec<Answer>) -> Result<(), String> {
        let mut session = CoherentQuery::<128>::new();
        try_each(points, answers, |point| {
            let found =
                black_box(session.closest_point(&self.tree, point, Budget::EXACT, &mut self.stack));
            found.map(|found| Answer::Point(found.closest.point)).map_err(|error| error.to_string())
        })
    }

    fn first_hits(&mut self, _: &[[[f32; 3]; 2]], answers: &mut Vec<Answer>) -> Result<(), String> {
        answers.clear();
        Ok(())
    }
}

/// All queries of a list at once, in Morton order where they come in none.
///
/// # Errors
/// None but a fault of the builder.
pub fn build_batch<'a>(
    subject: &Subject,
    _: &Scope,
    blob: &'a mut Vec<u8>,
) -> Result<Option<Box<dyn Engine + 'a>>, String> {
    let (bytes, tree) = open(subject, &TreeOptions::default(), blob)?;
    let stack = vec![ScratchEntry::EMPTY; tree.header().stack_entries as usize];
    Ok(Some(Box::new(Batched { bytes, tree, stack, found: Vec::new() })))
}

struct Batched<'a> {
    bytes: usize,
    tree: Bvh<'a>,
    stack: Vec<ScratchEntry>,
    found: Vec<ClosestPoint>,
}

impl Engine for Batched<'_> {
    fn bytes(&self) -> usize {
        self.bytes
    }

    fn limit(&self, workload: Workload) -> usize {
        if matches!(workload, Workload::Far | Workload::Near | Workload::Field) {
            usize::MAX
        } else {
            0
        }
    }

    fn closest(&mut self, points: &[[f32; 3]], answers: &mut Vec<Answer>) -> Result<(), String> {
        self.found.resize(points.len(), ClosestPoint::EMPTY);
        // The entries behind the descent's own put the points in order.
        let entries = self.tree.scratch_entries() + 2 * points.len();
        self.stack.resize(entries, ScratchEntry::EMPTY);
        let Self { tree, stack, found, .. } = self;
        tree.closest_points(points, &mut Hint::NONE.clone(), found, Budget::EXACT, stack)
            .map_err(|error| error.to_string())?;
        answers.clear();
        answers.extend(self.found.iter().map(|found| Answer::Point(found.point)));
        Ok(())
    }

    fn first_hits(&mut self, _: &[[[f32; 3]; 2]], answers: &mut Vec<Answer>) -> Result<(), String> {
        answers.clear();
        Ok(())
    }
}
