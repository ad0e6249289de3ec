//! `meshsweep closest`: points in, intervals and closest points out.

use crate::args::{ClosestArgs, Engine as EngineName, PointArgs, files};
use crate::ask::{Question, write_element, write_numbers};
use crate::failure::Failure;
use crate::output::refuse_same_file;
use crate::queries::Queries;
use crate::served::Engine;
use crate::{blob_file, served, triboxes};
use meshsweep::bvh::{BATCH, FastBvh, closest_points_until_refused};
use meshsweep::distances::{Closest, Distances};
use meshsweep_core::{Blob, BuildFor, Interval};
use std::io::{self, Write};

pub fn run(args: &ClosestArgs) -> Result<(), Failure> {
    let ClosestArgs { input: PointArgs { blob: file, points }, search, .. } = args;
    refuse_same_file(search.output.as_deref(), &files(&[file], points))?;
    let blob = blob_file::open(file)?;
    if args.triboxes {
        return triboxes::closest(args, &blob);
    }
    let budget = search.budget().with_relative(args.rel).with_absolute(args.abs);
    let header = "x,y,z,lower,upper,px,py,pz,triangle,work";
    if let Some(frame) = args.frame {
        let (hull, entries) = served::require_frame(file, &blob, frame)?;
        let ask = |point, scratch: &mut [_]| {
            hull.closest_point(point, budget, scratch).map(Closest::from)
        };
        return Question::new(header, Queries::read(points)?, search).ask_each(entries, ask, write);
    }
    let structure = structure(args, &blob)?;
    let header = match structure {
        Distances::Curve(_) => "x,y,z,lower,upper,px,py,pz,polyline,segment,safe_motion,work",
        _ => header,
    };
    let is_by_hull = matches!(structure, Distances::Tight(_));
    let question = Question { is_by_hull, ..Question::new(header, Queries::read(points)?, search) };
    let entries = served::entries(&structure);
    let Distances::Tree(tree) = structure else {
        let ask = |point, scratch: &mut [_]| structure.closest_point(point, budget, scratch);
        return question.ask_each(entries, ask, write);
    };
    let tree = FastBvh::new(tree);
    if args.precise || search.scratch.is_some() {
        let ask = |point, scratch: &mut [_]| {
            let found = match args.precise {
                true => tree.closest_point_precise(point, budget, scratch)?,
                false => tree.closest_point(point, budget, scratch)?,
            };
            Ok(found.into())
        };
        return question.ask_each(entries, ask, write);
    }
    search.threads.start();
    let ask = |points: &[[f32; 3]], _| {
        let (found, refused) = closest_points_until_refused(&tree, points, &budget);
        let refused = refused.map(|refused| (refused.index, refused.error));
        (found.into_iter().map(Closest::from).collect(), refused)
    };
    question.ask_all(BATCH, &ask, &write)
}

/// The structure that the options choose; or else the box tree, with a tolerance by its distance
/// field if there is one, the hull hierarchy, the finest
/// tight hull.
fn structure<'a>(args: &ClosestArgs, blob: &Blob<'a>) -> Result<Distances<'a>, Failure> {
    let file = &args.input.blob;
    let tree_chosen = match args.precise {
        true => Some(true),
        false => args.engine.map(|engine| engine == EngineName::Tree),
    };
    if tree_chosen.is_none() {
        if let (Ok(curve), None) = (blob.curve(), args.tight) {
            return Ok(Distances::Curve(curve));
        }
        if let Some(hull) = served::tight_hull(file, blob, args.tight)? {
            return Ok(Distances::Tight(hull));
        }
    }
    Ok(match served::choose(file, blob, BuildFor::Closest, tree_chosen)? {
        Engine::Tree(tree) => match served::tree_with_field(blob) {
            // Without a tolerance the field spares nothing.
            Some(both) if !args.precise && (args.rel > 0.0 || args.abs > 0.0) => {
                Distances::TreeWithField(both)
            }
            _ => Distances::Tree(tree),
        },
        Engine::Hull(hull) => Distances::Hull(hull),
    })
}

fn write(out: &mut dyn Write, _: usize, point: &[f32; 3], found: &Closest) -> io::Result<()> {
    let Interval { lower, upper } = found.distance;
    let [x, y, z] = found.point;
    write_numbers(out, point)?;
    write_numbers(out, &[lower, upper, x, y, z])?;
    write_element(out, found.safe_motion.is_some(), found.element)?;
    write_numbers(out, found.safe_motion.as_slice())?;
    writeln!(out, "{}", found.work.total())
}
