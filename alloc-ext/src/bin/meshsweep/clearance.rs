//! `meshsweep clearance`: poses of a second mesh in, its distance from the first one out; or
//! whether it is within a distance; or whether the moves from pose to pose are clear.

use crate::args::{ClearanceArgs, MoveKind, MovedArgs};
use crate::ask::{Question, verdict_name, write_numbers, write_pair};
use crate::failure::Failure;
use crate::poses;
use crate::queries::Queries;
use crate::{blob_file, served, triboxes};
use meshsweep::counted::Counted;
use meshsweep_core::{BuildFor, Bvh, Interval, Motion, Pose, Relation};
use std::io::{self, Write};

/// Columns of the answers to --within.
const WITHIN: &str = "pose,within,first,second,work";

pub fn run(args: &ClearanceArgs) -> Result<(), Failure> {
    let MovedArgs { first, second, .. } = &args.input;
    poses::refuse_same_file(&args.input, &args.search)?;
    let blobs = [blob_file::open(first)?, blob_file::open(second)?];
    if let (true, Some(distance)) = (args.triboxes, args.within) {
        return triboxes::clearance(args, &blobs, distance);
    }
    let [blob, other] = blobs;
    let trees = [
        served::require_tree(first, &blob, BuildFor::Segment)?,
        served::require_tree(second, &other, BuildFor::Segment)?,
    ];
    if args.depth {
        for (file, blob) in [(first, &blob), (second, &other)] {
            let tree = served::require_tree(file, blob, BuildFor::Closest)?;
            served::require_tree(file, blob, BuildFor::Winding)?;
            if !tree.is_closed() {
                return Err(Failure::NotClosed {
                    file: file.clone(),
                    instead: "leave out --depth",
                });
            }
        }
    }
    let (poses, clearance) = (poses::read(&args.input)?, Clearance { args, trees });
    if let Some(kind) = args.moves {
        return clearance.ask_moves(kind, poses);
    }
    if args.depth {
        return clearance.ask_depth(poses);
    }
    match args.within {
        Some(distance) => clearance.ask_within(distance, poses),
        None => clearance.ask_distance(poses),
    }
}

struct Clearance<'a> {
    args: &'a ClearanceArgs,
    trees: [Bvh<'a>; 2],
}

impl Clearance<'_> {
    fn ask_distance(self, poses: Queries<12>) -> Result<(), Failure> {
        let Clearance { args: ClearanceArgs { search, rel, abs, .. }, trees: [first, second] } =
            self;
        let budget = search.budget().with_relative(*rel).with_absolute(*abs);
        let header = "pose,lower,upper,ax,ay,az,bx,by,bz,first,second,work";
        Question::new(header, poses, search).ask_each(
            Bvh::DISTANCE_ENTRIES,
            |row, scratch| first.distance_to(&second, poses::of_row(row), budget, scratch),
            |out, query, _, found| {
                let Interval { lower, upper } = found.distance;
                let [[ax, ay, az], [bx, by, bz]] = found.points;
                write!(out, "{query},")?;
                write_numbers(out, &[lower, upper, ax, ay, az, bx, by, bz])?;
                write_pair(out, Some(found.triangles), found.work)
            },
        )
    }

    fn ask_depth(self, poses: Queries<12>) -> Result<(), Failure> {
        let Clearance { args: ClearanceArgs { search, rel, abs, .. }, trees: [first, second] } =
            self;
        let budget = search.budget().with_relative(*rel).with_absolute(*abs);
        let entries = first.scratch_entries().max(second.scratch_entries());
        let header = "pose,solids,lower,upper,x,y,z,px,py,pz,work";
        Question::new(header, poses, search).ask_each(
            entries.max(Bvh::DISTANCE_ENTRIES),
            |row, scratch| first.penetration(&second, poses::of_row(row), budget, scratch),
            |out, query, _, found| {
                write!(out, "{query},{},", relation_name(found.relation))?;
                write_numbers(out, &[found.depth.lower, found.depth.upper])?;
                for point in [found.apart.map(|pose| pose.translation), found.deepest] {
                    match point {
                        Some(point) => write_numbers(out, &point)?,
                        None => write!(out, ",,,")?,
                    }
                }
                writeln!(out, "{}", found.work.total())
            },
        )
    }

    fn ask_within(self, distance: f32, poses: Queries<12>) -> Result<(), Failure> {
        let Clearance { args: ClearanceArgs { search, .. }, trees: [first, second] } = self;
        Question::new(WITHIN, poses, search).ask_each(
            Bvh::DISTANCE_ENTRIES,
            |row, scratch| {
                first.within_of(&second, poses::of_row(row), distance, search.budget(), scratch)
            },
            |out, query, _, found| {
                write!(out, "{query},{},", verdict_name(found.verdict))?;
                write_pair(out, found.witness, found.work)
            },
        )
    }

    fn ask_moves(self, kind: MoveKind, mut poses: Queries<12>) -> Result<(), Failure> {
        let Clearance { args: ClearanceArgs { search, within, .. }, trees: [first, second] } = self;
        let keep = within.unwrap_or(0.0);
        // A pose that begins no screw is refused where it stands, not where a move to it begins.
        let refused =
            |row: &[f32; 12]| Motion::screw(poses::of_row(*row), poses::of_row(*row)).err();
        let mut checked = poses.rows.iter().enumerate();
        let bad = checked.find_map(|(index, row)| Some((index, refused(row)?)));
        if let (MoveKind::Screw, Some((index, error))) = (kind, bad) {
            let place = poses.place(index);
            let failure = match poses::no_rotation(&poses::of_row(poses.rows[index])) {
                Some(fault) => Failure::Matrix { place, fault },
                None => Failure::Query { place, error },
            };
            poses.end_at(index, failure)?;
        }
        let turns = |pair: &[[f32; 12]]| {
            let [from, to] = [pair[0], pair[1]].map(poses::of_row);
            from.rotation != to.rotation
        };
        let count = poses.rows.windows(2).filter(|pair| turns(pair)).count();
        if kind == MoveKind::Straight && count > 0 {
            // A closed standard error does not withhold the answers.
            let _ = writeln!(
                io::stderr(),
                "{} between poses of different rotation: straight shrinks the mesh on the way, \
                 --moves screw keeps it rigid",
                Counted(count, "move")
            );
        }
        let moves =
            poses.moves(|from, to| row_of_poses([poses::of_row(from), poses::of_row(to)]))?;
        let header = "move,clear,t,ax,ay,az,bx,by,bz,first,second,work";
        Question::new(header, moves, search).ask_each(
            Bvh::DISTANCE_ENTRIES,
            |row: [f32; 24], scratch| {
                let [from, to] = poses_of_row(&row);
                let motion = match kind {
                    MoveKind::Straight => Motion::straight(from, to),
                    MoveKind::Screw => Motion::screw(from, to)?,
                };
                first.first_contact_of(&second, &motion, keep, search.budget(), scratch)
            },
            |out, query, _, found| {
                if found.is_clear() {
                    write!(out, "{query},yes,,,,,,,,")?;
                    return write_pair(out, None, found.work);
                }
                let [[ax, ay, az], [bx, by, bz]] = found.points;
                write!(out, "{query},undecided,")?;
                write_numbers(out, &[found.clear_until, ax, ay, az, bx, by, bz])?;
                write_pair(out, Some(found.triangles), found.work)
            },
        )
    }
}

fn relation_name(relation: Relation) -> &'static str {
    match relation {
        Relation::Apart => "apart",
        Relation::Overlap => "overlap",
        Relation::FirstInside => "first inside",
        Relation::SecondInside => "second inside",
        _ => "undecided",
    }
}

/// Two poses as one row: matrices, then translations.
fn row_of_poses(poses: [Pose; 2]) -> [f32; 24] {
    let mut numbers = poses
        .into_iter()
        .flat_map(|pose| pose.rotation.into_iter().flatten().chain(pose.translation));
    std::array::from_fn(|_| numbers.next().unwrap_or_default())
}

/// The poses of such a row.
fn poses_of_row(row: &[f32; 24]) -> [Pose; 2] {
    let pose = |at: usize| {
        let triple = |k: usize| [0, 1, 2].map(|i| row[at + 3 * k + i]);
        Pose::affine([0, 1, 2].map(triple), triple(3))
    };
    [pose(0), pose(12)]
}
