//! The library's split hierarchy: certified answers from a sweep of swept triangles.

use meshsweep::collapse::Priority;
use meshsweep_core::{Budget, Hull, ScratchEntry};
use meshsweep_host_tests::workload::Subject;

use super::engine::{Answer, Engine, try_each};
use super::{Scope, Workload, is_closed};

/// Faces of the base hull: the builder's default.
const BASE_FACES: usize = 200;
/// Queries of one workload: 3 to 30 µs each.
const QUERIES: usize = 10_000;

struct Hierarchy<'a> {
    bytes: usize,
    hull: Hull<'a>,
    queue: Vec<ScratchEntry>,
}

/// On closed meshes that are not too large.
///
/// # Errors
/// The builder's refusal.
pub fn build<'a>(
    subject: &Subject,
    scope: &Scope,
    blob: &'a mut Vec<u8>,
) -> Result<Option<Box<dyn Engine + 'a>>, String> {
    if subject.mesh.triangles.len() > scope.hull_triangles || !is_closed(subject) {
        return Ok(None);
    }
    *blob = subject.build(BASE_FACES, Priority::Program)?.bytes;
    let hull = Hull::open(blob).map_err(|error| error.to_string())?;
    let queue = vec![ScratchEntry::EMPTY; hull.scratch_entries()];
    Ok(Some(Box::new(Hierarchy { bytes: blob.len(), hull, queue })))
}

impl Engine for Hierarchy<'_> {
    fn bytes(&self) -> usize {
        self.bytes
    }

    fn limit(&self, _: Workload) -> usize {
        QUERIES
    }

    fn closest(&mut self, points: &[[f32; 3]], answers: &mut Vec<Answer>) -> Result<(), String> {
        try_each(points, answers, |point| {
            let found = self.hull.closest_point(point, Budget::EXACT, &mut self.queue);
            found
                .map(|found| Answer::Distance(found.distance.upper))
                .map_err(|error| error.to_string())
        })
    }

    fn first_hits(
        &mut self,
        segments: &[[[f32; 3]; 2]],
        answers: &mut Vec<Answer>,
    ) -> Result<(), String> {
        try_each(segments, answers, |[a, b]| {
            let found = self.hull.first_hit(a, b, Budget::EXACT, &mut self.queue);
            let found = found.map_err(|error| error.to_string())?;
            Ok(found.hit.map_or(Answer::Miss, |hit| Answer::Hit(hit.t)))
        })
    }
}
