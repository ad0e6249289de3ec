//! Questions to the box tree of a fixture.

use std::hint::black_box;
use std::path::Path;

use meshsweep::bvh::{TreeOptions, build};
use meshsweep_core::{Budget, Bvh, Facing, Pose, ScratchEntry, Work};

use super::PLACED;
use crate::workload::pose::{poses, sphere};
use crate::workload::{Points, Subject, points, segments};

/// Asks the first `queries` of `FIXTURE KIND`, and sums the answers' work; with the triangles of a
/// leaf.
pub fn ask(fixtures: &Path, question: &str, queries: usize) -> Result<(Work, f64), String> {
    let (fixture, kind) = question.split_once(' ').ok_or("no fixture in the question")?;
    let subject = Subject::load(&fixtures.join(fixture))?;
    let (tables, _) = build(
        meshsweep::mesh::Input {
            input_triangles: subject.triangles_read,
            ..subject.mesh.as_input()
        },
        &TreeOptions::default(),
    )
    .expect("builds");
    let bytes = tables.to_bytes();
    let tree = Bvh::open(&bytes).map_err(|error| error.to_string())?;
    let header = *tree.header();
    let triangles = f64::from(header.triangles) / f64::from(header.leaves);
    let entries = header.stack_entries as usize;
    let failed = |error: meshsweep_core::QueryError| error.to_string();
    let mut sum = Work::default();
    let mut add = |work: Work| {
        sum.splits += work.splits;
        sum.triangles += work.triangles;
    };
    if kind == "overlap" {
        let mut stack = [ScratchEntry::EMPTY; Bvh::OVERLAP_ENTRIES];
        let all: Vec<Pose> = poses(&sphere(&subject), PLACED).map(|(_, core)| core).collect();
        for pose in all.iter().take(queries) {
            add(black_box(tree.overlap(&tree, *pose, Budget::EXACT, &mut stack))
                .map_err(failed)?
                .work);
        }
        return Ok((sum, triangles));
    }
    // Placed for the greater number always, so that placing them is no part of the difference.
    if let Some(kind) = Points::ALL.into_iter().find(|points| points.name() == kind) {
        let mut stack = vec![ScratchEntry::EMPTY; entries];
        for point in points(&subject, kind, PLACED).into_iter().take(queries) {
            add(black_box(tree.closest_point(point, Budget::EXACT, &mut stack))
                .map_err(failed)?
                .work);
        }
    } else if kind == "clear" {
        let mut stack = vec![ScratchEntry::EMPTY; entries];
        let mut asked = Vec::new();
        for point in points(&subject, Points::Far, PLACED) {
            let near = tree.closest_point(point, Budget::EXACT, &mut stack).map_err(failed)?;
            asked.push((point, 0.9 * near.distance.lower));
        }
        for (point, distance) in asked.into_iter().take(queries) {
            add(black_box(tree.within(point, distance, Budget::EXACT, &mut stack))
                .map_err(failed)?
                .work);
        }
    } else {
        let mut stack = vec![ScratchEntry::EMPTY; entries];
        for [a, b] in segments(&subject, PLACED).into_iter().take(queries) {
            add(black_box(tree.first_hit(a, b, Facing::Both, Budget::EXACT, &mut stack))
                .map_err(failed)?
                .work);
        }
    }
    Ok((sum, triangles))
}
