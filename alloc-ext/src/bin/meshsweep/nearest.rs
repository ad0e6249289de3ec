//! `meshsweep nearest`: the closest triangles, or segments of a curve, of each point.

use crate::args::{NearestArgs, PointArgs, files};
use crate::ask::{
    Answer, Question, write_curve_neighbor, write_end, write_neighbor, write_numbers,
};
use crate::failure::Failure;
use crate::output::refuse_same_file;
use crate::queries::Queries;
use crate::{blob_file, served};
use meshsweep_core::{Blob, BuildFor, Curve, CurveNeighbor, Ended, Interval, Neighbor, Work};

pub fn run(args: &NearestArgs) -> Result<(), Failure> {
    let NearestArgs { input: PointArgs { blob: file, points }, count, frame, search } = args;
    refuse_same_file(search.output.as_deref(), &files(&[file], points))?;
    let blob = blob_file::open(file)?;
    if let Some(frame) = *frame {
        return at_frame(args, &blob, frame);
    }
    if let Ok(curve) = blob.curve() {
        return of_curve(args, &curve);
    }
    let tree = served::require_tree(file, &blob, BuildFor::Closest)?;
    // There are no more triangles than the mesh has.
    let count = (*count).min(tree.triangle_count());
    let header = "query,rank,lower,upper,px,py,pz,triangle,work";
    Question::new(header, Queries::read(points)?, search).ask(
        || {
            let mut buffer = vec![Neighbor::EMPTY; count as usize];
            let mut scratch = search.scratch(tree.scratch_entries());
            move |point| {
                let near = tree.nearest(point, &mut buffer, search.budget(), &mut scratch)?;
                let found: Vec<Neighbor> = buffer.iter().take(near.stored).copied().collect();
                Ok(Answer { found, ended: near.ended, work: near.work })
            }
        },
        |out, query, _, Answer { found, work, .. }| {
            (1..).zip(found).try_for_each(|(rank, near): (usize, _)| {
                write!(out, "{query},{rank},")?;
                write_neighbor(out, near, *work)
            })
        },
    )
}

/// One triangle after another, by a sweep of the mesh at a key frame.
fn at_frame(args: &NearestArgs, blob: &Blob<'_>, frame: f32) -> Result<(), Failure> {
    let NearestArgs { input: PointArgs { blob: file, points }, count, search, .. } = args;
    let (hull, _) = served::require_frame(file, blob, frame)?;
    let entries = served::require_hull(file, blob)?.sweep_entries();
    let header = "query,rank,lower,upper,px,py,pz,triangle,work";
    Question::new(header, Queries::read(points)?, search).ask(
        || {
            let mut scratch = search.scratch(entries);
            move |point| {
                let mut sweep = hull.sweep(point, &mut scratch)?;
                let budget = search.budget();
                let (mut found, mut work) = (Vec::new(), Work::NONE);
                let mut ended = Ended::Exact;
                while found.len() < *count as usize {
                    // The steps are those of the whole question.
                    let left = match budget.steps {
                        u32::MAX => u32::MAX,
                        steps => steps.saturating_sub(work.opened),
                    };
                    let Some(next) = sweep.next_triangle(budget.with_steps(left))? else { break };
                    work = work.and(next.work);
                    ended = next.ended;
                    let Some(triangle) = next.triangle else { break };
                    found.push((triangle, next));
                }
                Ok(Answer { found, ended, work })
            }
        },
        |out, query, _, Answer { found, work, .. }| {
            (1..).zip(found).try_for_each(|(rank, (triangle, near)): (usize, _)| {
                let Interval { lower, upper } = near.distance;
                let [x, y, z] = near.point;
                write!(out, "{query},{rank},")?;
                write_numbers(out, &[lower, upper, x, y, z])?;
                write_end(out, Some(*triangle), *work)
            })
        },
    )
}

fn of_curve(args: &NearestArgs, curve: &Curve<'_>) -> Result<(), Failure> {
    let NearestArgs { input: PointArgs { points, .. }, count, search, .. } = args;
    let count = (*count).min(curve.segment_count());
    let header = "query,rank,lower,upper,px,py,pz,polyline,segment,work";
    Question::new(header, Queries::read(points)?, search).ask(
        || {
            let mut buffer = vec![CurveNeighbor::EMPTY; count as usize];
            let mut scratch = search.scratch(curve.scratch_entries() + served::BEST_FIRST);
            move |point| {
                let near = curve.nearest(point, &mut buffer, search.budget(), &mut scratch)?;
                let found: Vec<_> = buffer.iter().take(near.stored).copied().collect();
                Ok(Answer { found, ended: near.ended, work: near.work })
            }
        },
        |out, query, _, Answer { found, work, .. }| {
            (1..).zip(found).try_for_each(|(rank, near): (usize, _)| {
                write!(out, "{query},{rank},")?;
                write_curve_neighbor(out, near, *work)
            })
        },
    )
}
