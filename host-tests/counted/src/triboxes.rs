//! Questions to a tribox hierarchy.

use std::hint::black_box;

use meshsweep_core::{Budget, NodePair, Pose, QueryError, ScratchEntry, Tribox, Triboxes};

use crate::Counted;

pub(crate) fn ask(counted: &Counted<'_>, question: &str, queries: usize) -> Result<(), String> {
    let triboxes = Triboxes::open(counted.blob).map_err(|error| error.to_string())?;
    let failed = |error: QueryError| error.to_string();
    let mut stack = vec![ScratchEntry::EMPTY; triboxes.scratch_entries()];
    let mut pairs = vec![ScratchEntry::EMPTY; triboxes.separation_entries(&triboxes)];
    match question {
        "distance" => {
            for point in counted.points(queries) {
                black_box(triboxes.distance(point, Budget::EXACT, &mut stack).map_err(failed)?);
            }
        }
        "clip" => {
            for [a, b] in counted.segments(queries) {
                black_box(triboxes.clip(a, b, Budget::EXACT, &mut stack).map_err(failed)?);
            }
        }
        "apart" => {
            for pose in counted.poses(queries) {
                let answer = triboxes.separation(&triboxes, pose, Budget::EXACT, &mut pairs);
                black_box(answer.map_err(failed)?);
            }
        }
        "candidates" => {
            let mut found = vec![NodePair::EMPTY; 4096];
            for pose in counted.poses(queries) {
                let answer =
                    triboxes.candidates(&triboxes, pose, &mut found, Budget::EXACT, &mut pairs);
                black_box(answer.map_err(failed)?);
            }
        }
        "by vertices" => {
            for pose in counted.poses(queries) {
                black_box(by_vertices(&triboxes, &triboxes, &pose));
            }
        }
        _ => return Err(format!("no question `{question}` to triboxes")),
    }
    Ok(())
}

/// The paper's test of two tribox hierarchies: the larger tribox's children are tested, the moved
/// tribox is bounded about its vertices, nine slabs decide. Whether they are apart, and the pairs
/// tested.
#[must_use]
pub fn by_vertices(a: &Triboxes<'_>, b: &Triboxes<'_>, pose: &Pose) -> (bool, u32) {
    let width = |t: &Tribox| (0..3).map(|k| t.high[k] - t.low[k]).sum::<f32>();
    let mut stack = vec![(0, 0)];
    let mut tested = 0;
    while let Some((i, j)) = stack.pop() {
        let (Some(first), Some(second)) = (a.node(i), b.node(j)) else { continue };
        tested += 1;
        let Ok(moved) = second.moved(pose) else { return (false, tested) };
        if !first.overlaps(&moved) {
            continue;
        }
        match (a.children(i), b.children(j)) {
            (None, None) => return (false, tested),
            (Some(below), other) if other.is_none() || width(&first) >= width(&second) => {
                stack.extend(below.map(|i| (i, j)));
            }
            (_, other) => stack.extend(other.into_iter().flatten().map(|j| (i, j))),
        }
    }
    (true, tested)
}
