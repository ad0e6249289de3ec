//! `meshsweep clearance`: poses of a second mesh in, its distance from the first one out.

use crate::args::{ClearanceArgs, MovedArgs};
use crate::ask::{self, Answer, Question, verdict_name, write_numbers, write_pair};
use crate::failure::Failure;
use crate::poses::{self, AskPoses};
use crate::queries::Queries;
use crate::{blob_file, served};
use meshsweep_core::{BuildFor, Bvh, Interval, Pose};

pub fn run(args: &ClearanceArgs) -> Result<(), Failure> {
    let MovedArgs { first, second, .. } = &args.input;
    poses::refuse_same_file(&args.input, &args.search)?;
    let (blob, other) = (blob_file::open(first)?, blob_file::open(second)?);
    let trees = [
        served::require_tree(first, &blob, BuildFor::Segment)?,
        served::require_tree(second, &other, BuildFor::Segment)?,
    ];
    poses::ask(&args.input, Clearance { args, trees })
}

struct Clearance<'a> {
    args: &'a ClearanceArgs,
    trees: [Bvh<'a>; 2],
}

impl AskPoses for Clearance<'_> {
    fn ask<const N: usize>(
        self,
        poses: Queries<N>,
        pose_of: fn([f32; N]) -> Pose,
    ) -> Result<(), Failure> {
        match self.args.within {
            Some(distance) => self.ask_within(distance, poses, pose_of),
            None => self.ask_distance(poses, pose_of),
        }
    }
}

impl Clearance<'_> {
    fn ask_distance<const N: usize>(
        self,
        poses: Queries<N>,
        pose_of: fn([f32; N]) -> Pose,
    ) -> Result<(), Failure> {
        let Clearance { args: ClearanceArgs { search, rel, abs, .. }, trees: [first, second] } =
            self;
        let budget = search.budget().with_relative(*rel).with_absolute(*abs);
        let header = "pose,lower,upper,ax,ay,az,bx,by,bz,first,second,work";
        Question::new(header, poses, search).ask(
            || {
                let mut scratch = search.scratch(Bvh::DISTANCE_ENTRIES);
                move |row| {
                    let found = first.distance(&second, pose_of(row), budget, &mut scratch)?;
                    Ok(Answer { found, ended: found.ended, work: found.work })
                }
            },
            |out, query, _, Answer { found, work, .. }| {
                let Interval { lower, upper } = found.distance;
                let [[ax, ay, az], [bx, by, bz]] = found.points;
                write!(out, "{query},")?;
                write_numbers(out, &[lower, upper, ax, ay, az, bx, by, bz])?;
                write_pair(out, Some(found.triangles), *work)
            },
        )
    }

    fn ask_within<const N: usize>(
        self,
        distance: f32,
        poses: Queries<N>,
        pose_of: fn([f32; N]) -> Pose,
    ) -> Result<(), Failure> {
        let Clearance { args: ClearanceArgs { search, .. }, trees: [first, second] } = self;
        Question::new("pose,within,first,second,work", poses, search).ask(
            || {
                let mut scratch = search.scratch(Bvh::DISTANCE_ENTRIES);
                move |row| {
                    let (pose, budget) = (pose_of(row), search.budget());
                    let found = first.within_of(&second, pose, distance, budget, &mut scratch)?;
                    Ok(Answer { found, ended: ask::ended(found.verdict), work: found.work })
                }
            },
            |out, query, _, Answer { found, work, .. }| {
                write!(out, "{query},{},", verdict_name(found.verdict))?;
                write_pair(out, found.triangles, *work)
            },
        )
    }
}
