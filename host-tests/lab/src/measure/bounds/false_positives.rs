//! How often bounds meet although the meshes do not: a mesh against itself, turned and moved at
//! random.

use meshsweep_host_tests::generate::Rng;
use meshsweep_host_tests::workload::Subject;
use meshsweep_host_tests::workload::contact::Surface;
use meshsweep_host_tests::workload::pose::{FARTHEST, Pose};
use meshsweep_xtask::table::{Table, fixed, row};

use super::all::Bounds;
use super::contenders::Contender;
use super::pose::Motion;

/// Poses of the moved mesh.
const POSES: usize = 2_000;

/// The poses, seeded.
pub(super) fn poses(bounds: &Bounds) -> Vec<Pose> {
    let mut rng = Rng::new(0x0070_6f73_6573);
    (0..POSES).map(|_| Pose::random(&mut rng, &bounds.sphere, FARTHEST)).collect()
}

/// Poses and what is true of them.
pub(super) struct Cases {
    pub(super) poses: Vec<Pose>,
    meshes_meet: Vec<bool>,
}

impl Cases {
    pub(super) fn new(subject: &Subject, bounds: &Bounds) -> Self {
        let surface = Surface::new(subject);
        let poses = poses(bounds);
        // The surfaces even where the hulls are apart: hulls are a bound like others, to be caught
        // if they are wrong.
        let meshes_meet = poses.iter().map(|pose| surface.meets_moved(pose)).collect();
        Self { poses, meshes_meet }
    }

    fn meet(&self) -> usize {
        self.meshes_meet.iter().filter(|meet| **meet).count()
    }
}

/// What a bound says of all cases.
pub(super) struct Tally {
    /// Pairs that it takes for meeting, of a hundred whose meshes do not meet.
    pub(super) wrong: f64,
    /// Pairs of which it denies that they meet although they do.
    missed: usize,
    /// Verdicts in f32 that are not those in f64.
    differ: usize,
    /// Mean of the moved bound's volume over the hull's.
    pub(super) volume: f64,
}

impl Tally {
    pub(super) fn of(cases: &Cases, contender: &mut Contender<'_>) -> Self {
        let judged: Vec<_> = cases.poses.iter().map(|pose| (contender.judge)(pose)).collect();
        let motions: Vec<Motion> = cases.poses.iter().map(Motion::of).collect();
        let mut verdicts = Vec::with_capacity(motions.len());
        contender.rig.update(&motions);
        contender.rig.test(&mut verdicts);
        let pairs = || judged.iter().zip(&cases.meshes_meet);
        let wrong = pairs().filter(|(bound, mesh)| bound.meets && !**mesh).count();
        Self {
            wrong: 100.0 * wrong as f64 / (POSES - cases.meet()).max(1) as f64,
            missed: pairs().filter(|(bound, mesh)| !bound.meets && **mesh).count(),
            differ: judged.iter().zip(&verdicts).filter(|(a, b)| a.meets != **b).count(),
            volume: judged.iter().map(|bound| bound.volume).sum::<f64>() / POSES as f64,
        }
    }
}

/// The table.
pub(super) fn table(cases: &Cases, contenders: &[Contender<'_>], tallies: &[Tally]) -> Table {
    let columns = [
        "bound",
        "bounded about",
        "points moved",
        "false %",
        "missed",
        "volume, of the hull's",
        "differ",
    ];
    let title = "A mesh against itself, moved: bounds that meet, of the pairs whose meshes do not";
    let mut table = Table::new("false_positives", title, &columns);
    for (contender, tally) in contenders.iter().zip(tallies) {
        table.push(row![
            contender.name,
            contender.about.name(),
            contender.vertices,
            fixed(tally.wrong, 1),
            tally.missed,
            fixed(tally.volume, 2),
            tally.differ,
        ]);
    }
    table.note(format!("{POSES} poses, seeded; {} pairs of meshes meet", cases.meet()));
    table.note(
        "meshes: surface against surface, by exact predicates; a part inside another does \
            not meet it",
    );
    table.note(
        "bounded about: moved vertices of the hull, or of the resting slabs, or a copy \
        that is turned; volumes: mean over the poses",
    );
    table.note(
        "rounded outward: this library's tribox, which holds what it bounds in real \
        arithmetic; the others are rounded to nearest",
    );
    table.note(
        "differ: verdicts in f32 that are not those in f64; an oriented box's errs to \
        meeting where axes are parallel",
    );
    table
}
