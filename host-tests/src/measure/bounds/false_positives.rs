//! How often bounds meet although the meshes do not: a mesh against itself, turned and moved at random.

use glam::DVec3;

use crate::generate::Rng;
use crate::measure::Subject;
use crate::measure::table::{Cell, Table, fixed, row};

use super::Bounds;
use super::contact::{Supports, Surface};
use super::convex_hull::ConvexHull;
use super::dop::{Dop, Slabs};
use super::enclosing_sphere::Sphere;
use super::pose::Pose;

/// Poses of the moved mesh.
const POSES: usize = 2_000;

/// Greatest distance of the two spheres' centres, of the radius: a little further than spheres reach, so that there is something
/// for them to tell apart.
const FARTHEST: f64 = 2.2;

/// A pose and what is true of it.
struct Case {
    pose: Pose,
    hulls_meet: bool,
    meshes_meet: bool,
}

fn cases(subject: &Subject, bounds: &Bounds) -> Result<Vec<Case>, String> {
    let surface = Surface::new(subject)?;
    let hull = Supports::new(&bounds.hull);
    let mut rng = Rng::new(0x0070_6f73_6573);
    let case = |_| {
        let pose = Pose::random(&mut rng, &bounds.sphere, FARTHEST);
        // The surfaces whatever the hulls say: those are a bound like others, to be caught if they are wrong.
        Case { hulls_meet: hull.meets_moved(&pose), meshes_meet: surface.meets_moved(&pose), pose }
    };
    Ok((0..POSES).map(case).collect())
}

/// What a bound says of all cases.
#[derive(Default)]
struct Tally {
    /// Pairs that it takes for meeting, of those whose meshes do not meet.
    wrong: usize,
    /// Pairs of which it denies that they meet although they do.
    missed: usize,
    comparisons: usize,
}

impl Tally {
    /// `meets` tells whether the bounds meet and the comparisons made.
    fn of(cases: &[Case], mut meets: impl FnMut(&Case) -> (bool, usize)) -> Self {
        let mut tally = Self::default();
        for case in cases {
            let (bounds_meet, comparisons) = meets(case);
            tally.comparisons += comparisons;
            tally.wrong += usize::from(bounds_meet && !case.meshes_meet);
            tally.missed += usize::from(!bounds_meet && case.meshes_meet);
        }
        tally
    }

    fn mean_comparisons(&self) -> Cell {
        fixed(self.comparisons as f64 / POSES as f64, 1)
    }
}

/// The slabs about a moved slab bound: they need its vertices alone, and are looser than those about the mesh.
struct Looser {
    tally: Tally,
    /// Mean of the volume over that of the tight slabs.
    volume: f64,
}

impl Looser {
    fn of(cases: &[Case], slabs: &Slabs, bounds: &Bounds, corners: &[DVec3], rest: &Dop) -> Self {
        let mut ratios = 0.0;
        let hull = &bounds.hull;
        let tally = Tally::of(cases, |case| {
            let loose = Dop::of(slabs, corners.iter().map(|p| case.pose.apply(*p)));
            let tight = moved(slabs, hull, &case.pose);
            // The corners of what a ball encloses are within √3 of its radius, so the corners of what these enclose within 3.
            let centre = case.pose.apply(bounds.sphere.centre);
            let volume = |dop: &Dop| dop.solid(slabs, centre, 2.0 * bounds.sphere.radius).volume();
            ratios += volume(&loose) / volume(&tight);
            rest.meets(&loose)
        });
        Self { tally, volume: ratios / POSES as f64 }
    }
}

fn moved(slabs: &Slabs, hull: &ConvexHull, pose: &Pose) -> Dop {
    Dop::of(slabs, hull.points.iter().map(|p| pose.apply(*p)))
}

/// The table.
pub(super) fn table(subject: &Subject, bounds: &Bounds) -> Result<Table, String> {
    let cases = cases(subject, bounds)?;
    let count = |of: fn(&Case) -> bool| cases.iter().filter(|case| of(case)).count();
    let apart = count(|case| !case.meshes_meet);
    let share = |tally: &Tally| fixed(100.0 * tally.wrong as f64 / apart.max(1) as f64, 1);
    let columns = [
        "bound",
        "false %",
        "comparisons, most",
        "mean",
        "vertices moved",
        "missed",
        "false % from own vertices",
        "own vertices",
        "volume x",
    ];
    let title = "A mesh against itself, moved: bounds that meet, of the pairs whose meshes do not";
    let mut table = Table::new("false_positives", title, &columns);
    for (slabs, rest, solid) in &bounds.slabs {
        let tight = Tally::of(&cases, |case| rest.meets(&moved(slabs, &bounds.hull, &case.pose)));
        let looser = Looser::of(&cases, slabs, bounds, &solid.vertices, rest);
        table.push(row![
            slabs.name,
            share(&tight),
            2 * slabs.directions.len(),
            tight.mean_comparisons(),
            bounds.hull.points.len(),
            tight.missed + looser.tally.missed,
            share(&looser.tally),
            solid.vertices.len(),
            fixed(looser.volume, 2),
        ]);
    }
    let mut push = |name: &str, tally: &Tally, comparisons: Option<usize>, moved: Option<usize>| {
        let mean = if comparisons.is_some() { tally.mean_comparisons() } else { Cell::Empty };
        let empty = Cell::Empty;
        table.push(row![
            name,
            share(tally),
            comparisons,
            mean,
            moved,
            tally.missed,
            empty.clone(),
            empty.clone(),
            empty
        ]);
    };
    let Sphere { centre, radius } = bounds.sphere;
    let spheres = Tally::of(&cases, |case| (case.pose.apply(centre).distance(centre) <= 2.0 * radius, 1));
    push("smallest enclosing sphere", &spheres, Some(1), Some(1));
    for (name, oriented) in &bounds.boxes {
        let boxes =
            Tally::of(&cases, |case| oriented.meets(&oriented.moved(case.pose.rotation, case.pose.shift)));
        push(name, &boxes, Some(15), Some(1));
    }
    push("convex hull", &Tally::of(&cases, |case| (case.hulls_meet, 0)), None, None);
    let (meet, hulls) = (count(|case| case.meshes_meet), count(|case| case.hulls_meet));
    table.note(format!("{POSES} poses, seeded; {hulls} pairs of hulls meet, {meet} pairs of meshes"));
    table
        .note("meshes: surface against surface, by exact predicates; a part inside another does not meet it");
    table.note(
        "hulls: parry3d's GJK, f32; comparisons of an oriented box: separating axes, each some 20 flops",
    );
    table.note("vertices moved: the hull's, about which tight slabs are taken; own vertices: the slabs' about the moved slabs' corners");
    Ok(table)
}
