//! Which pairs of links keep a distance, and why others do not.

use super::link::Link;
use super::mechanism::{Body, Mechanism, Place};
use super::options::RobotOptions;
use crate::random::SplitMix;
use meshsweep_core::{Budget, Bvh, Pose, QueryError, RoundedPose, ScratchEntry, link_poses};
use std::fmt;

/// Two links that keep a distance. Links count as in [`Robot::links`](super::Robot::links).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RobotPair {
    /// Indices of the links.
    pub links: [usize; 2],
    /// The distance that was asked for.
    pub keep: f64,
    /// The same, and the rounding of both poses.
    pub distance: f32,
}

/// Why a pair of links is not looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Skipped {
    /// A joint joins them, or links without geometry and their joints do.
    Neighbours,
    /// They do not move relative to each other.
    Rigid,
    /// The SRDF disables them, for another reason than `Never`.
    Disabled,
    /// They are not farther apart than their distance at any of the places that were tried.
    AlwaysNear,
}

impl fmt::Display for Skipped {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Neighbours => "neighbours",
            Self::Rigid => "fixed to each other",
            Self::Disabled => "disabled by the SRDF",
            Self::AlwaysNear => "too near at every place that was tried",
        })
    }
}

/// Two links, by their indices.
type Two = [usize; 2];

/// Pairs that keep a distance, and others with the reason.
pub(super) type Chosen = (Vec<(Two, f64)>, Vec<(Two, Skipped)>);

/// Chooses among all pairs. A pair that is named by an option is never left out.
pub(super) fn chosen(
    mechanism: &Mechanism,
    links: &[Link],
    disabled: &[([String; 2], String)],
    options: &RobotOptions,
) -> Result<Chosen, QueryError> {
    let is = |names: &[String; 2], [a, b]: Two| {
        let [a, b] = [&links[a].name, &links[b].name];
        [a, b] == [&names[0], &names[1]] || [b, a] == [&names[0], &names[1]]
    };
    let bodies: &[Body] = &mechanism.bodies;
    let why = |pair @ [a, b]: Two| {
        // A reason that was found by sampling proves nothing.
        let by_srdf = |(names, reason): &([String; 2], String)| is(names, pair) && reason != NEVER;
        if bodies[b].parent == Some(a) || bodies[a].parent == Some(b) {
            Some(Skipped::Neighbours)
        } else if bodies[a].mover == bodies[b].mover {
            Some(Skipped::Rigid)
        } else {
            disabled.iter().any(by_srdf).then_some(Skipped::Disabled)
        }
    };
    let (mut kept, mut open, mut skipped) = (Vec::new(), Vec::new(), Vec::new());
    for pair in (0..links.len()).flat_map(|a| (a + 1..links.len()).map(move |b| [a, b])) {
        let own = options.keep_pairs.iter().rev().find(|(names, _)| is(names, pair));
        match (own, why(pair)) {
            (Some((_, keep)), _) => kept.push((pair, *keep)),
            (None, Some(why)) => skipped.push((pair, why)),
            (None, None) => open.push((pair, options.keep)),
        }
    }
    let near = always_near(mechanism, links, open.clone(), options.samples)?;
    kept.extend(open.into_iter().filter(|pair| !near.contains(pair)));
    skipped.extend(near.into_iter().map(|(pair, _)| (pair, Skipped::AlwaysNear)));
    kept.sort_by_key(|(pair, _)| *pair);
    skipped.sort_by_key(|(pair, _)| *pair);
    Ok((kept, skipped))
}

/// The reason of an SRDF for pairs that its writer found far apart at all places that it tried.
pub(super) const NEVER: &str = "Never";

/// The pairs that are too near in every sample; none of no samples.
fn always_near(
    mechanism: &Mechanism,
    links: &[Link],
    pairs: Vec<(Two, f64)>,
    samples: u32,
) -> Result<Vec<(Two, f64)>, QueryError> {
    let mut near = if samples == 0 { Vec::new() } else { pairs };
    let blobs: Vec<_> = links.iter().map(|link| link.built.blob()).collect();
    let trees = blobs.iter().map(|blob| blob.bvh().map_err(|_| QueryError::Unchecked));
    let trees = trees.collect::<Result<Vec<Bvh<'_>>, _>>()?;
    let mut scratch = vec![ScratchEntry::EMPTY; Bvh::DISTANCE_ENTRIES];
    for places in sampled(&mechanism.places, samples) {
        if near.is_empty() {
            break;
        }
        let poses = mechanism.poses(&places)?;
        let mut failed = None;
        near.retain(|&([a, b], keep)| {
            let relative = poses[b].pose.relative_to(&poses[a].pose);
            let found = relative.and_then(|relative| {
                let (distance, budget) = (keep as f32, Budget::EXACT);
                trees[a].within_of(&trees[b], relative.pose, distance, budget, &mut scratch)
            });
            found.map_or_else(
                |error| {
                    failed = Some(error);
                    true
                },
                |found| !found.is_clear(),
            )
        });
        failed.map_or(Ok(()), Err)?;
    }
    Ok(near)
}

/// Places within the limits, the same in every run.
pub(super) fn sampled(places: &[Place], samples: u32) -> impl Iterator<Item = Vec<f32>> + '_ {
    let mut random = SplitMix::new(1);
    (0..samples).map(move |_| {
        let place = |place: &Place| {
            let [low, high] = place.limits;
            (low + (high - low) * random.roll()) as f32
        };
        places.iter().map(place).collect()
    })
}

impl Mechanism {
    /// The poses of the bodies.
    pub(super) fn poses(&self, places: &[f32]) -> Result<Vec<RoundedPose>, QueryError> {
        let mut all = vec![RoundedPose::exact(Pose::IDENTITY); self.joints.len()];
        link_poses(&self.joints, places, &mut all)?;
        Ok(self.bodies.iter().map(|body| all[usize::from(body.joint)]).collect())
    }
}
