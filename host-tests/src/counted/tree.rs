//! Questions to the box tree of a fixture.

use std::hint::black_box;
use std::path::Path;

use meshsweep::bvh::{TreeOptions, build};
use meshsweep_core::Bvh;
use meshsweep_core::query::tree::{
    Facing, PairEntry, ScratchEntry, closest_point, first_hit, is_within, overlap,
};
use meshsweep_core::query::{Budget, Work};
use meshsweep_core::tribox::Pose;

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
    );
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
        let mut stack = [PairEntry::EMPTY; PairEntry::ENOUGH];
        let all: Vec<Pose> = poses(&sphere(&subject), PLACED).map(|(_, core)| core).collect();
        for pose in all.iter().take(queries) {
            add(black_box(overlap(&tree, &tree, pose, u32::MAX, &mut stack)).map_err(failed)?.work);
        }
        return Ok((sum, triangles));
    }
    // Placed for the greater number always, so that placing them is no part of the difference.
    if let Some(kind) = Points::ALL.into_iter().find(|points| points.name() == kind) {
        let mut stack = vec![ScratchEntry::EMPTY; entries];
        for point in points(&subject, kind, PLACED).into_iter().take(queries) {
            add(black_box(closest_point(&tree, point, &Budget::EXACT, &mut stack))
                .map_err(failed)?
                .work);
        }
    } else if kind == "clear" {
        let mut stack = vec![ScratchEntry::EMPTY; entries];
        let mut asked = Vec::new();
        for point in points(&subject, Points::Far, PLACED) {
            let near = closest_point(&tree, point, &Budget::EXACT, &mut stack).map_err(failed)?;
            asked.push((point, 0.9 * near.lower));
        }
        for (point, distance) in asked.into_iter().take(queries) {
            add(black_box(is_within(&tree, point, distance, &Budget::EXACT, &mut stack))
                .map_err(failed)?
                .work);
        }
    } else {
        let mut stack = vec![ScratchEntry::EMPTY; entries];
        for [a, b] in segments(&subject, PLACED).into_iter().take(queries) {
            add(black_box(first_hit(&tree, a, b, &Facing::Both, &mut stack)).map_err(failed)?.work);
        }
    }
    Ok((sum, triangles))
}
