//! A mesh against itself in random motions: answers held to exact predicates, and time beside parry3d's.

use glam::DVec3;
use meshsweep_alloc::emit;
use meshsweep_alloc::tree::{TreeOptions, build};
use meshsweep_core::Tree;
use meshsweep_core::query::Work;
use meshsweep_core::query::tree::{Contact, PairEntry, TrianglePair, all_overlaps, overlap};
use meshsweep_core::tribox::Pose;
use parry3d::math::{Pose as ParryPose, Vector};
use parry3d::query::intersection_test;
use parry3d::shape::TriMesh;

use super::Subject;
use super::bounds::enclosing_sphere::Sphere;
use super::bounds::pose::Pose as Motion;
use super::stopwatch::{Stopwatch, fastest};
use super::table::{Cell, Table, fixed, row};
use crate::generate::Rng;
use crate::oracle::moved::{Place, triangles_meet};

/// Motions.
const MOTIONS: usize = 1_000;

/// Greatest distance of the two spheres' centres, of the radius: a little further than spheres reach.
const FARTHEST: f64 = 2.2;

/// Boxes of parry3d's trees are grown by this much of the mesh's diagonal and distance from the origin: some ten roundings to f32.
const GROWN: f32 = 1e-6;

/// A motion as each side takes it, and what is true of ours.
struct Case {
    parry: ParryPose,
    pose: Pose,
    meets: bool,
}

/// parry3d's shape of the mesh. Its tree also tells which triangles the exact predicates have to look at.
struct Rival<'a> {
    subject: &'a Subject,
    shape: TriMesh,
    reach: f32,
}

impl<'a> Rival<'a> {
    fn new(subject: &'a Subject) -> Result<Self, String> {
        let vertices: Vec<Vector> = subject.mesh.positions.iter().map(|p| Vector::from_array(*p)).collect();
        let reach = vertices.iter().map(|p| p.length()).fold(subject.diagonal() as f32, f32::max);
        let shape =
            TriMesh::new(vertices, subject.mesh.triangles.clone()).map_err(|error| error.to_string())?;
        Ok(Self { subject, shape, reach })
    }

    /// Whether the mesh meets itself after a motion, exactly.
    fn truth(&self, parry: &ParryPose, pose: &Pose) -> bool {
        let slack = GROWN * (self.reach + parry.translation.length());
        let corners =
            |t: u32| self.subject.mesh.triangles[t as usize].map(|v| self.subject.mesh.positions[v as usize]);
        let mut candidates = self.shape.bvh().leaf_pairs(self.shape.bvh(), |a, b| {
            let b = b.aabb().transform_by(parry);
            let wide = Vector::splat(slack);
            a.aabb().mins.cmple(b.maxs + wide).all() && (b.mins - wide).cmple(a.aabb().maxs).all()
        });
        candidates.any(|(a, b)| {
            let first = corners(a).map(Place::of);
            let second = corners(b).map(|p| Place::moved(p, &pose.rotation, pose.translation));
            triangles_meet(first.each_ref(), second.each_ref())
        })
    }

    fn meets(&self, parry: &ParryPose) -> Result<bool, String> {
        intersection_test(&ParryPose::IDENTITY, &self.shape, parry, &self.shape)
            .map(|answer| answer.intersecting)
            .map_err(|error| error.to_string())
    }
}

fn cases(subject: &Subject, rival: &Rival<'_>) -> Vec<Case> {
    let points: Vec<DVec3> =
        subject.mesh.positions.iter().map(|p| DVec3::from_array(p.map(f64::from))).collect();
    let sphere = Sphere::enclosing(&points);
    let mut rng = Rng::new(0x006f_7665_726c_6170);
    let case = |_| {
        let motion = Motion::random(&mut rng, &sphere, FARTHEST);
        let narrow = |v: DVec3| v.to_array().map(|x| x as f32);
        let rows = motion.rotation.transpose();
        let rotation = [narrow(rows.x_axis), narrow(rows.y_axis), narrow(rows.z_axis)];
        let pose = Pose { rotation, translation: narrow(motion.shift) };
        Case { meets: rival.truth(&motion.parry, &pose), parry: motion.parry, pose }
    };
    (0..MOTIONS).map(case).collect()
}

/// Answers of an engine, and nanoseconds for one: of the pairs that are apart, of those that meet.
struct Run<T> {
    answers: Vec<T>,
    nanoseconds: [f64; 2],
}

fn run<T>(cases: &[Case], mut ask: impl FnMut(&Case) -> Result<T, String>) -> Result<Run<T>, String> {
    let mut answers: Vec<Option<T>> = cases.iter().map(|_| None).collect();
    let mut nanoseconds = [0.0; 2];
    for (time, meets) in nanoseconds.iter_mut().zip([false, true]) {
        let mut asked = 0;
        let watch = Stopwatch::start();
        for (case, slot) in cases.iter().zip(&mut answers).filter(|(case, _)| case.meets == meets) {
            *slot = Some(ask(case)?);
            asked += 1;
        }
        *time = watch.nanoseconds_each(asked);
    }
    Ok(Run { answers: answers.into_iter().flatten().collect(), nanoseconds })
}

fn fastest_run<T>(cases: &[Case], mut ask: impl FnMut(&Case) -> Result<T, String>) -> Result<Run<T>, String> {
    fastest(|| run(cases, &mut ask), |run| run.nanoseconds.iter().sum())
}

/// Wrong answers, and answers left open.
struct Verdicts {
    wrong: usize,
    open: usize,
    work: [Work; 2],
    all_pairs: [f64; 2],
    time: [f64; 2],
}

fn ours(tree: &Tree<'_>, cases: &[Case]) -> Result<Verdicts, String> {
    let mut stack = [PairEntry::EMPTY; PairEntry::ENOUGH];
    let ask = |case: &Case| {
        overlap(tree, tree, &case.pose, u32::MAX, &mut stack).map_err(|error| error.to_string())
    };
    let Run { answers, nanoseconds } = fastest_run(cases, ask)?;
    let mut verdicts =
        Verdicts { wrong: 0, open: 0, work: [Work::default(); 2], all_pairs: [0.0; 2], time: nanoseconds };
    for (case, answer) in cases.iter().zip(&answers) {
        match answer.contact {
            Contact::Open => verdicts.open += 1,
            contact => verdicts.wrong += usize::from((contact == Contact::Meets) != case.meets),
        }
        let sum = &mut verdicts.work[usize::from(case.meets)];
        sum.nodes += answer.work.nodes;
        sum.triangles += answer.work.triangles;
        sum.exact += answer.work.exact;
        sum.splits += answer.work.splits;
    }
    let mut pairs = vec![TrianglePair::EMPTY; 1 << 20];
    let every = |case: &Case| {
        let found = all_overlaps(tree, tree, &case.pose, u32::MAX, &mut pairs, &mut stack);
        found.map(|found| found.stored).map_err(|error| error.to_string())
    };
    verdicts.all_pairs = run(cases, every)?.nanoseconds;
    Ok(verdicts)
}

/// The tables.
///
/// # Errors
/// The mesh is one that parry3d or the builder refuses, or an answer is wrong.
pub fn tables(subject: &Subject) -> Result<Vec<Table>, String> {
    let rival = Rival::new(subject)?;
    let cases = cases(subject, &rival);
    let meeting = cases.iter().filter(|case| case.meets).count();
    let parry = fastest_run(&cases, |case| rival.meets(&case.parry))?;
    let parry_wrong =
        cases.iter().zip(&parry.answers).filter(|(case, answer)| case.meets != **answer).count();
    let columns = [
        "engine",
        "wrong",
        "open",
        "us apart",
        "parry3d's",
        "us meeting",
        "parry3d's",
        "us all pairs, meeting",
    ];
    let mut times = Table::new("overlap", "A mesh against itself, moved: do the surfaces meet?", &columns);
    let columns = ["engine", "motions", "boxes", "nodes opened", "triangle pairs", "in f64"];
    let mut work = Table::new("overlap_work", "What that took, in mean", &columns);
    for (name, single) in [("16-bit grid", false), ("f32 vertices", true)] {
        let options = TreeOptions { closest: false, single, ..TreeOptions::default() };
        let bytes = emit::blob(None, Some(&build(&subject.mesh, 0.0, subject.triangles_read, &options).0));
        let tree = Tree::open(&bytes).map_err(|error| error.to_string())?;
        let verdicts = ours(&tree, &cases)?;
        let [apart, meets] = verdicts.time;
        let times_faster = |ours: f64, theirs: f64| fixed(theirs / ours, 1);
        times.push(row![
            name,
            verdicts.wrong,
            verdicts.open,
            fixed(apart / 1e3, 2),
            times_faster(apart, parry.nanoseconds[0]),
            fixed(meets / 1e3, 2),
            times_faster(meets, parry.nanoseconds[1]),
            fixed(verdicts.all_pairs[1] / 1e3, 1),
        ]);
        if verdicts.wrong > 0 {
            return Err(format!("{} wrong answers of {MOTIONS}, {name}", verdicts.wrong));
        }
        for (which, count, work_of) in
            [("apart", MOTIONS - meeting, verdicts.work[0]), ("meeting", meeting, verdicts.work[1])]
        {
            let each = |sum: u32| fixed(f64::from(sum) / count.max(1) as f64, 2);
            let Work { nodes, triangles, exact, splits } = work_of;
            work.push(row![
                format!("{name}, {which}"),
                count,
                each(nodes),
                each(splits),
                each(triangles),
                each(exact)
            ]);
        }
    }
    let one = || Cell::from("1.0");
    times.push(row![
        "parry3d",
        parry_wrong,
        0usize,
        fixed(parry.nanoseconds[0] / 1e3, 2),
        one(),
        fixed(parry.nanoseconds[1] / 1e3, 2),
        one(),
        Cell::Empty,
    ]);
    times.note(format!(
        "{MOTIONS} motions, seeded: any rotation, spheres' centres up to {FARTHEST} radii apart; {meeting} pairs meet by exact predicates"
    ));
    times.note(
        "open: nearer than the grid, or rounding, can tell; parry3d's: times faster than it in this run",
    );
    Ok(vec![times, work])
}
