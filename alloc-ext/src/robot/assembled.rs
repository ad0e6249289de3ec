//! The stages from a description to a robot.

use super::link::{self, Link};
use super::mechanism::{Mechanism, Place};
use super::options::RobotOptions;
use super::package::Packages;
use super::pairs::{self, RobotPair, Skipped};
use super::urdf::{self, Urdf};
use crate::error::BuildError;
use crate::load::bytes_of;
use meshsweep_core::internal::num::up_to_f32;
use meshsweep_core::{Joint, QueryError};
use std::path::Path;

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
    /// The places that [`link_poses`](meshsweep_core::link_poses) takes, in this order.
    pub places: Vec<Place>,
    /// Pairs that keep a distance.
    pub pairs: Vec<RobotPair>,
    /// All other pairs.
    pub skipped: Vec<([usize; 2], Skipped)>,
    /// How many pairs are kept that an SRDF disables for the reason `Never`: samples prove nothing.
    pub never: usize,
    /// Names of an SRDF that are no link.
    pub unknown: Vec<String>,
}

/// Random places at which rounding is measured, beside the lowest and the highest places.
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
    /// [`BuildError::Unreadable`] for the description or the SRDF. [`BuildError::Robot`] for all
    /// else, also for a mesh and for what [`Builder::build`](crate::Builder::build) refuses. It
    /// names the line where one element is to blame.
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
            .map(|body| link::built(file, &urdf.links[body.link], body.joint, &packages));
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
        let chosen = pairs::chosen(&mechanism, &links, &disabled, options).map_err(refused)?;
        if !chosen.near.is_empty() {
            let name = |&([a, b], keep): &([usize; 2], f64)| {
                format!("{}, {} at {keep}", links[a].name, links[b].name)
            };
            let named: Vec<String> = chosen.near.iter().map(name).collect();
            return Err(other(format!(
                "{}: nearer at each of {} random places, but not certain to meet at all places; \
                 give their distance by --keep A,B=D, or disable them in the SRDF",
                named.join("; "),
                options.samples,
            )));
        }
        if chosen.kept.is_empty() {
            let what = "no pair of links keeps a distance; name pairs by --keep A,B=D";
            return Err(other(what.to_owned()));
        }
        let pair = |(two @ [a, b], keep): ([usize; 2], f64)| {
            let rounding = f64::from(links[a].rounding) + f64::from(links[b].rounding);
            RobotPair { links: two, keep, distance: up_to_f32(keep + rounding).next_up() }
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
            pairs: chosen.kept.into_iter().map(pair).collect(),
            skipped: chosen.skipped,
            never: chosen.never,
            unknown,
            name: urdf.name,
            links,
            joints: mechanism.joints,
            places: mechanism.places,
        })
    }
}

/// Measures the rounding of the links' poses at many places and at the limits.
fn measure_rounding(mechanism: &Mechanism, links: &mut [Link]) -> Result<(), QueryError> {
    let limit =
        |end: usize| mechanism.places.iter().map(|place| place.limits[end] as f32).collect();
    let all = pairs::sampled(&mechanism.places, ROUNDED_AT).chain([limit(0), limit(1)]);
    for places in all {
        for (link, pose) in links.iter_mut().zip(mechanism.poses(&places)?) {
            link.rounding = link.rounding.max(pose.motion(link.radius));
        }
    }
    links
        .iter_mut()
        .for_each(|link| link.rounding = up_to_f32(f64::from(link.rounding) * ROUNDING_ROOM));
    Ok(())
}
