//! From a robot's description (URDF) to blobs of its links, its joints, and the pairs of links that
//! keep a distance.
//!
//! ```text
//! URDF ─ links, joints ─┬─ mechanism ─ joints in order ─┬─ pairs ─ Robot ─ source: Rust
//!                       └─ shapes, meshes ─ Builder ─ blobs ─┘
//! ```
//!
//! Lengths are in metres and angles in radians, as in the file.

mod mechanism;
mod package;
mod pairs;
mod shape;
mod source;
mod urdf;

use crate::builder::{Builder, Built, For};
use crate::error::BuildError;
use crate::load::bytes_of;
use crate::mesh::{RawMesh, Unit, joined};
use mechanism::{Mechanism, up};
use meshsweep_core::Joint;
use package::Packages;
use std::path::{Path, PathBuf};
use urdf::Urdf;

pub use mechanism::Place;
pub use pairs::{RobotPair, Skipped};

/// How a robot's description is read.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct RobotOptions {
    /// A file whose `disable_collisions` name pairs to leave out.
    pub srdf: Option<PathBuf>,
    /// Folders of packages, by their names.
    pub packages: Vec<(String, PathBuf)>,
    /// The distance to keep, in metres.
    pub keep: f64,
    /// Pairs of links that keep a distance of their own.
    pub keep_pairs: Vec<([String; 2], f64)>,
    /// Random places at which pairs are tried that may be too near at all places. 0: none is left
    /// out for that.
    pub samples: u32,
}

impl Default for RobotOptions {
    fn default() -> Self {
        Self { srdf: None, packages: Vec::new(), keep: 0.0, keep_pairs: Vec::new(), samples: 1000 }
    }
}

/// A link with collision geometry.
#[derive(Clone, Debug)]
pub struct Link {
    /// Its name.
    pub name: String,
    /// Its blob, in the link's frame.
    pub built: Built,
    /// Index of its joint.
    pub joint: u16,
    /// No point of its geometry is farther from the origin of its frame.
    pub radius: f32,
    /// Rounding of its pose that the distances of its pairs have room for.
    pub rounding: f32,
    /// A round shape of it became a polyhedron that reaches out of it by at most this.
    pub beyond: f64,
}

/// A robot, as firmware needs it.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Robot {
    /// Its name.
    pub name: String,
    /// Links with geometry, parents first.
    pub links: Vec<Link>,
    /// Links without collision geometry: nothing guards them.
    pub without_geometry: Vec<String>,
    /// For [`link_poses`](meshsweep_core::link_poses).
    pub joints: Vec<Joint>,
    /// The numbers that a pose needs.
    pub places: Vec<Place>,
    /// Pairs that keep a distance.
    pub pairs: Vec<RobotPair>,
    /// All other pairs.
    pub skipped: Vec<([usize; 2], Skipped)>,
    /// Pairs that an SRDF disables for the reason `Never`, and that are kept: samples prove nothing.
    pub never: usize,
    /// Names of an SRDF that are no link.
    pub unknown: Vec<String>,
}

/// Places at which rounding is measured.
const ROUNDED_AT: u32 = 256;

/// Room for rounding at other places, as a factor. The emitted code refuses places that need more.
const ROUNDING_ROOM: f64 = 2.0;

impl Robot {
    /// Reads a description and its meshes, and builds a blob of each link that serves questions
    /// about two models.
    ///
    /// Several collision shapes of a link are one mesh. A box is exact. A cylinder and a sphere
    /// become polyhedra that contain them ([`Link::beyond`]).
    ///
    /// # Errors
    /// [`BuildError::Robot`] names the element and its line; [`BuildError::Unreadable`]; those of
    /// [`Builder::build`].
    pub fn read(file: &Path, options: &RobotOptions) -> Result<Self, BuildError> {
        let urdf = Urdf::read(file, &bytes_of(file)?)?;
        let mechanism = Mechanism::new(file, &urdf)?;
        let srdf = options.srdf.as_deref();
        let disabled = srdf.map(|srdf| urdf::disabled_pairs(srdf, &bytes_of(srdf)?));
        let disabled = disabled.transpose()?.unwrap_or_default();
        let other = |what: String| BuildError::Robot { file: file.to_owned(), line: None, what };
        let packages = Packages::new(file, &options.packages);
        let links = mechanism
            .bodies
            .iter()
            .map(|body| link(file, &urdf.links[body.link], body.joint, &packages));
        let mut links = links.collect::<Result<Vec<_>, _>>()?;
        if links.is_empty() {
            return Err(other("no link has collision geometry".to_owned()));
        }
        let named = options.keep_pairs.iter().flat_map(|(names, _)| names);
        if let Some(name) =
            named.into_iter().find(|name| links.iter().all(|link| &link.name != *name))
        {
            return Err(other(format!("there is no link {name:?} with collision geometry")));
        }
        let refused = |error| other(format!("the joints: {error}"));
        measure_rounding(&mechanism, &mut links).map_err(refused)?;
        let (kept, skipped) =
            pairs::chosen(&mechanism, &links, &disabled, options).map_err(refused)?;
        let pair = |(two @ [a, b], keep): ([usize; 2], f64)| {
            let rounding = f64::from(links[a].rounding) + f64::from(links[b].rounding);
            RobotPair { links: two, keep, distance: up(keep + rounding).next_up() }
        };
        let is_link = |name: &str| urdf.links.iter().any(|link| link.name == name);
        let mut unknown: Vec<String> = disabled
            .iter()
            .flat_map(|(names, _)| names)
            .filter(|name| !is_link(name))
            .cloned()
            .collect();
        unknown.sort();
        unknown.dedup();
        let is_bare = |link: &&urdf::Link| link.collisions.is_empty();
        let without_geometry = urdf.links.iter().filter(is_bare).map(|link| link.name.clone());
        Ok(Self {
            without_geometry: without_geometry.collect(),
            pairs: kept.into_iter().map(pair).collect(),
            skipped,
            never: disabled.iter().filter(|(_, reason)| reason == pairs::NEVER).count(),
            unknown,
            name: urdf.name,
            links,
            joints: mechanism.joints,
            places: mechanism.places,
        })
    }
}

/// Builds a link's blob.
fn link(
    file: &Path,
    of: &urdf::Link,
    joint: u16,
    packages: &Packages<'_>,
) -> Result<Link, BuildError> {
    let (mut parts, mut beyond): (Vec<(RawMesh, _)>, f64) = (Vec::new(), 0.0);
    for collision in &of.collisions {
        let refused = |what: String| {
            urdf::refused(file, collision.line, format!("collision of link {:?}: {what}", of.name))
        };
        let (raw, inner, more) = shape::mesh(&collision.shape, packages).map_err(refused)?;
        parts.push((raw, collision.placement.after(&inner)));
        beyond = beyond.max(more);
    }
    let refused =
        |what: String| urdf::refused(file, of.line, format!("link {:?}: {what}", of.name));
    let raw =
        joined(Path::new(&of.name), Unit::M, &parts).map_err(|error| refused(error.to_string()))?;
    let built = Builder::new().serve(For::Segment).unit(Unit::M).build(raw);
    let built = built.map_err(|error| refused(error.to_string()))?;
    let (mut radius, mut error) = (0f64, 0f64);
    if let Some(loaded) = &built.loaded {
        let length_sq = |p: &[f32; 3]| p.iter().map(|&x| f64::from(x).powi(2)).sum::<f64>();
        radius = loaded.mesh.positions.iter().map(length_sq).fold(0.0, f64::max).sqrt();
        error = loaded.error();
    }
    let radius = up((radius + error) * (1.0 + 1e-12)).next_up();
    Ok(Link { name: of.name.clone(), built, joint, radius, rounding: 0.0, beyond })
}

/// Measures the rounding of the links' poses at many places and at the limits.
fn measure_rounding(
    mechanism: &Mechanism,
    links: &mut [Link],
) -> Result<(), meshsweep_core::QueryError> {
    let limit =
        |end: usize| mechanism.places.iter().map(|place| place.limits[end] as f32).collect();
    let all = pairs::sampled(&mechanism.places, ROUNDED_AT).chain([limit(0), limit(1)]);
    for places in all {
        for (link, pose) in links.iter_mut().zip(mechanism.poses(&places)?) {
            link.rounding = link.rounding.max(pose.motion(link.radius));
        }
    }
    links.iter_mut().for_each(|link| link.rounding = up(f64::from(link.rounding) * ROUNDING_ROOM));
    Ok(())
}
