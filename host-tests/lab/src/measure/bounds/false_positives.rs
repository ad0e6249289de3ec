//! How often bounds meet although the meshes do not: a mesh against itself, turned and moved at
//! random.

use meshsweep_host_tests::generate::Rng;
use meshsweep_host_tests::workload::Subject;
use meshsweep_host_tests::workload::contact::Surface;
use meshsweep_host_tests::workload::pose::{FARTHEST, Pose};
use meshsweep_xtask::table::{Cell, Table, fixed, row};

use super::Bounds;
use super::contact::Supports;
use super::contenders::{About, Contender};
use super::pose::parry;

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
    hulls_meet: usize,
    meshes_meet: Vec<bool>,
}

impl Cases {
    pub(super) fn new(subject: &Subject, bounds: &Bounds) -> Self {
        let surface = Surface::new(subject);
        let hull = Supports::new(&bounds.hull);
        let poses = poses(bounds);
        // The surfaces whatever the hulls say: those are a bound like others, to be caught if they
        // are wrong.
        let meshes_meet = poses.iter().map(|pose| surface.meets_moved(pose)).collect();
        let hulls_meet = poses.iter().filter(|pose| hull.meets_moved(&parry(pose))).count();
        Self { poses, hulls_meet, meshes_meet }
    }

    fn meet(&self) -> usize {
        self.meshes_meet.iter().filter(|meet| **meet).count()
    }
}

/// What a bound says of all cases.
pub(super) struct Tally {
    /// Its verdicts.
    pub(super) meets: Vec<bool>,
    /// Pairs that it takes for meeting, of a hundred whose meshes do not meet.
    pub(super) wrong: f64,
    /// Pairs of which it denies that they meet although they do.
    missed: usize,
    /// Mean.
    comparisons: f64,
    /// Moved, over the hull's, pose by pose.
    volumes: Vec<f64>,
}

impl Tally {
    pub(super) fn of(cases: &Cases, contender: &Contender<'_>) -> Self {
        let judged: Vec<_> = cases.poses.iter().map(|pose| (contender.judge)(pose)).collect();
        let pairs = || judged.iter().zip(&cases.meshes_meet);
        let wrong = pairs().filter(|(bound, mesh)| bound.meets && !**mesh).count();
        Self {
            meets: judged.iter().map(|bound| bound.meets).collect(),
            wrong: 100.0 * wrong as f64 / (POSES - cases.meet()).max(1) as f64,
            missed: pairs().filter(|(bound, mesh)| !bound.meets && **mesh).count(),
            comparisons: judged.iter().map(|bound| bound.comparisons).sum::<usize>() as f64
                / POSES as f64,
            volumes: judged.iter().map(|bound| bound.volume).collect(),
        }
    }

    /// Mean of the moved bound's volume over the hull's.
    pub(super) fn volume(&self) -> f64 {
        self.volumes.iter().sum::<f64>() / POSES as f64
    }

    /// Mean of the volume over another's at the same pose.
    fn volume_over(&self, other: &Self) -> f64 {
        self.volumes.iter().zip(&other.volumes).map(|(ours, theirs)| ours / theirs).sum::<f64>()
            / POSES as f64
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
        "comparisons, most",
        "mean",
        "volume, of the hull's",
        "of that about the hull's vertices",
    ];
    let title = "A mesh against itself, moved: bounds that meet, of the pairs whose meshes do not";
    let mut table = Table::new("false_positives", title, &columns);
    for (index, (contender, tally)) in contenders.iter().zip(tallies).enumerate() {
        let tight = index.checked_sub(1).filter(|_| contender.about == About::Own);
        table.push(row![
            contender.name,
            contender.about.name(),
            contender.vertices,
            fixed(tally.wrong, 1),
            tally.missed,
            contender.most,
            contender.most.map(|_| fixed(tally.comparisons, 1)),
            fixed(tally.volume(), 2),
            tight.map_or(Cell::Empty, |tight| fixed(tally.volume_over(&tallies[tight]), 2)),
        ]);
    }
    let (meet, hulls) = (cases.meet(), cases.hulls_meet);
    table.note(format!(
        "{POSES} poses, seeded; {hulls} pairs of hulls meet, {meet} pairs of meshes"
    ));
    table
        .note("meshes: surface against surface, by exact predicates; a part inside another does not meet it");
    table.note(
        "hulls: parry3d's GJK, f32; comparisons of an oriented box: separating axes, each some 20 flops",
    );
    table.note("bounded about: moved vertices of the hull, or of the resting slabs, or a copy that is turned; volumes: mean over the poses");
    table.note("rounded outward: this library's tribox, which holds what it bounds in real arithmetic; the others are rounded to nearest");
    table
}
