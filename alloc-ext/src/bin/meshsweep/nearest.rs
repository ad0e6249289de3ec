//! `meshsweep nearest`: the closest triangles, or segments of a curve, of each point.

use crate::args::{NearestArgs, PointArgs, files};
use crate::ask::{Answer, Question, write_curve_neighbor, write_neighbor};
use crate::failure::Failure;
use crate::output::refuse_same_file;
use crate::queries::Queries;
use crate::{blob_file, served};
use meshsweep_core::{BuildFor, Curve, CurveNeighbor, Neighbor};

pub fn run(args: &NearestArgs) -> Result<(), Failure> {
    let NearestArgs { input: PointArgs { blob: file, points }, count, search } = args;
    refuse_same_file(search.output.as_deref(), &files(&[file], points))?;
    let blob = blob_file::open(file)?;
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

fn of_curve(args: &NearestArgs, curve: &Curve<'_>) -> Result<(), Failure> {
    let NearestArgs { input: PointArgs { points, .. }, count, search } = args;
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
