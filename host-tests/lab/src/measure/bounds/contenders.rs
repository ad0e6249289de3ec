//! Every bound in every way that it can be moved: what is compared, one a row.

use glam::DVec3;
use meshsweep_core::Tribox;
use meshsweep_host_tests::workload::pose::Pose;

use super::all::Bounds;
use super::contact::Supports;
use super::dop::{Dop, Slabs};
use super::pose::parry;
use super::rig::{Rig, rigid, single, slabs};

/// What a moved bound is taken about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum About {
    /// The moved vertices of the mesh's convex hull: as tight as it can be.
    Hull,
    /// Its own moved vertices: the hull need not be kept.
    Own,
    /// Nothing: it turns with the mesh.
    Rigid,
}

impl About {
    /// In tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Hull => "hull's vertices",
            Self::Own => "own vertices",
            Self::Rigid => "nothing, it turns",
        }
    }
}

/// What is so of a bound at a pose, in f64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Judged {
    /// Whether it meets the resting one.
    pub meets: bool,
    /// Of the moved bound, over the convex hull's.
    pub volume: f64,
}

/// A bound and a way to move it.
pub struct Contender<'a> {
    /// The bound.
    pub name: &'static str,
    /// The way.
    pub about: About,
    /// Points that are moved.
    pub vertices: usize,
    /// What is so of it.
    pub judge: Box<dyn Fn(&Pose) -> Judged + 'a>,
    /// What it costs.
    pub rig: Box<dyn Rig + 'a>,
}

/// Coordinates between which f32 squares neither overflow nor vanish.
const SIZES: std::ops::Range<f64> = 1e-15..1e15;

/// All of them.
///
/// # Errors
/// The mesh is too large or too small for f32.
pub fn contenders(bounds: &Bounds) -> Result<Vec<Contender<'_>>, String> {
    let Bounds { hull, sphere, .. } = bounds;
    if !SIZES.contains(&sphere.radius) || sphere.centre.length() > SIZES.end {
        return Err(format!(
            "of a mesh of radius {:e} squares are beyond f32's range",
            sphere.radius
        ));
    }
    let mut all = Vec::new();
    for (slabs, rest, solid) in &bounds.slabs {
        for (about, points) in [(About::Hull, &hull.points), (About::Own, &solid.vertices)] {
            let is_own_box = slabs.label == "box" && about == About::Own;
            let rig = if is_own_box {
                Some(slabs::box_about_box(&hull.points))
            } else {
                slabs::about(slabs, points, &hull.points)
            };
            let moved = |pose: &Pose| Dop::of(slabs, points.iter().map(|p| pose.apply(*p)));
            all.push(Contender {
                name: slabs.label,
                about,
                vertices: points.len(),
                judge: Box::new(move |pose| judged(bounds, slabs, rest, &moved(pose), pose)),
                rig: rig.ok_or_else(|| format!("{} is in f64 only", slabs.name))?,
            });
        }
        if slabs.label == "tribox" {
            all.extend(outward(bounds, slabs)?);
        }
    }
    let volume = sphere.volume() / hull.volume();
    let meets =
        |pose: &Pose| pose.apply(sphere.centre).distance(sphere.centre) <= 2.0 * sphere.radius;
    all.push(Contender {
        name: "sphere",
        about: About::Rigid,
        vertices: 1,
        judge: Box::new(move |pose| Judged { meets: meets(pose), volume }),
        rig: rigid::sphere(sphere),
    });
    let oriented = &bounds.oriented;
    let volume = oriented.volume() / hull.volume();
    all.push(Contender {
        name: "oriented box, on a face",
        about: About::Rigid,
        vertices: 1,
        judge: Box::new(move |pose| Judged {
            meets: oriented.meets(&oriented.moved(pose.rotation, pose.shift)),
            volume,
        }),
        rig: rigid::oriented(oriented),
    });
    let supports = Supports::new(hull);
    all.push(Contender {
        name: "convex hull",
        about: About::Rigid,
        vertices: 0,
        judge: Box::new(move |pose| Judged {
            meets: supports.meets_moved(&parry(pose)),
            volume: 1.0,
        }),
        rig: rigid::hull(hull),
    });
    Ok(all)
}

fn judged(bounds: &Bounds, slabs: &Slabs, rest: &Dop, moved: &Dop, pose: &Pose) -> Judged {
    // The corners of what a ball encloses are within √3 of its radius, so the corners of what these
    // enclose within 3.
    let solid = moved.solid(slabs, pose.apply(bounds.sphere.centre), 2.0 * bounds.sphere.radius);
    Judged { meets: rest.meets(moved), volume: solid.volume() / bounds.hull.volume() }
}

/// The library's triboxes.
fn outward<'a>(bounds: &'a Bounds, slabs: &'a Slabs) -> Result<[Contender<'a>; 2], String> {
    let points: Vec<[f32; 3]> = bounds.hull.points.iter().map(|p| single(*p)).collect();
    let rest = Tribox::of_points(points.iter().copied()).map_err(|error| error.to_string())?;
    let dop = |tribox: Tribox| Dop {
        ranges: tribox.slabs().map(|(low, high)| [low, high].map(f64::from)).collect(),
    };
    let contender = |about, vertices, rig, moved: Box<dyn Fn(&Pose) -> Tribox>| Contender {
        name: "tribox rounded outward",
        about,
        vertices,
        judge: Box::new(move |pose| judged(bounds, slabs, &dop(rest), &dop(moved(pose)), pose)),
        rig,
    };
    let own = rest.boundary().vertices.len();
    let hull: &[DVec3] = &bounds.hull.points;
    let about_hull =
        move |pose: &Pose| pose.rounded().bound(points.iter().copied()).unwrap_or(Tribox::EMPTY);
    let about_own = move |pose: &Pose| rest.moved(&pose.rounded()).unwrap_or(Tribox::EMPTY);
    Ok([
        contender(
            About::Hull,
            hull.len(),
            slabs::outward_about_hull(rest, hull),
            Box::new(about_hull),
        ),
        contender(About::Own, own, slabs::outward_about_own(rest), Box::new(about_own)),
    ])
}
