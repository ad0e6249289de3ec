//! `meshsweep closest`: points in, intervals and closest points out.

use crate::args::{ClosestArgs, Engine as EngineName, PointArgs, files};
use crate::ask::{Answer, Question, write_end, write_numbers};
use crate::failure::Failure;
use crate::output::refuse_same_file;
use crate::queries::Queries;
use crate::served::Engine;
use crate::{blob_file, curve, served};
use meshsweep::bvh::FastBvh;
use meshsweep_core::{BuildFor, ClosestPoint, Hint, Interval, QueryError};
use std::io::{self, Write};

/// Points that the box tree sorts and answers at once: enough for neighbours to be near, and for
/// all threads to have some.
const BATCH: usize = 1 << 14;

pub fn run(args: &ClosestArgs) -> Result<(), Failure> {
    let ClosestArgs { input: PointArgs { blob: file, points }, search, .. } = args;
    refuse_same_file(search.output.as_deref(), &files(&[file], points))?;
    let blob = blob_file::open(file)?;
    let budget = search.budget().with_relative(args.rel).with_absolute(args.abs);
    if let Ok(curve) = blob.curve()
        && args.engine.is_none()
        && args.tight.is_none()
        && args.frame.is_none()
        && !args.precise
    {
        return curve::closest(curve, args, Queries::read(points)?, budget);
    }
    let header = "x,y,z,lower,upper,px,py,pz,triangle,work";
    let question = |points| Question::new(header, points, search);
    if let Some(frame) = args.frame {
        let (hull, entries) = served::require_frame(file, &blob, frame)?;
        let asker = || {
            let mut scratch = search.scratch(entries);
            move |point| Ok(answer(hull.closest_point(point, budget, &mut scratch)?))
        };
        return question(Queries::read(points)?).ask(asker, write);
    }
    let tree_chosen = match args.precise {
        true => Some(true),
        false => args.engine.map(|engine| engine == EngineName::Tree),
    };
    let hull = match tree_chosen {
        Some(_) => None,
        None => served::tight_hull(file, &blob, args.tight)?,
    };
    if let Some(hull) = hull {
        let asker = || {
            let mut scratch = search.scratch(hull.scratch_entries());
            move |point| Ok(answer(hull.closest_point(point, budget, &mut scratch)?))
        };
        let question = question(Queries::read(points)?);
        return Question { is_by_hull: true, ..question }.ask(asker, write);
    }
    let engine = served::choose(file, &blob, BuildFor::Closest, tree_chosen)?;
    let points = Queries::read(points)?;
    let tree = match engine {
        Engine::Tree(tree) => FastBvh::new(tree),
        Engine::Hull(hull) => {
            let asker = || {
                let mut scratch = search.scratch(engine.scratch_entries());
                move |point| Ok(answer(hull.closest_point(point, budget, &mut scratch)?))
            };
            return question(points).ask(asker, write);
        }
    };
    if args.precise {
        let asker = || {
            let mut scratch = search.scratch(tree.scratch_entries());
            move |point| Ok(answer(tree.closest_point_precise(point, budget, &mut scratch)?))
        };
        return question(points).ask(asker, write);
    }
    // Two entries more for each point sort a batch.
    let entries = tree.scratch_entries() + 2 * BATCH.min(points.rows.len());
    let worker = || {
        let mut scratch = search.scratch(entries);
        let mut found = Vec::new();
        move |rows: &[[f32; 3]], answers: &mut Vec<_>| {
            found.resize(rows.len(), ClosestPoint::EMPTY);
            // Without a hint: so the work does not depend on the batch before.
            let mut hint = Hint::NONE;
            tree.closest_points(rows, &mut hint, &mut found, budget, &mut scratch).map_err(
                |error| match error {
                    QueryError::PointNotFinite { index } => (index as usize, QueryError::NotFinite),
                    error => (0, error),
                },
            )?;
            answers.extend(found.iter().copied().map(answer));
            Ok(())
        }
    };
    question(points).ask_many(BATCH, worker, write)
}

fn answer(found: ClosestPoint) -> Answer<ClosestPoint> {
    Answer { found, ended: found.ended, work: found.work }
}

fn write(
    out: &mut dyn Write,
    _: usize,
    point: &[f32; 3],
    &Answer { found, work, .. }: &Answer<ClosestPoint>,
) -> io::Result<()> {
    let Interval { lower, upper } = found.distance;
    let [x, y, z] = found.point;
    write_numbers(out, point)?;
    write_numbers(out, &[lower, upper, x, y, z])?;
    write_end(out, found.triangle, work)
}
