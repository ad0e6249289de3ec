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
    /// The distance that was asked for, in metres.
    pub keep: f64,
    /// `keep` and the rounding of both poses, rounded up: what
    /// [`KeptPair`](meshsweep_core::KeptPair) takes.
    pub distance: f32,
}

/// Why a pair of links is not looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Skipped {
    /// At most one joint that moves is between them, and no link with geometry.
    Neighbours,
    /// They do not move relative to each other.
    Rigid,
    /// The SRDF disables them, for another reason than `Never`.
    Disabled,
    /// Their surfaces meet at each of the places that were tried, and each joint between them has
    /// more than one place.
    AlwaysMeet,
}

impl fmt::Display for Skipped {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Neighbours => "neighbours",
            Self::Rigid => "fixed to each other",
            Self::Disabled => "disabled by the SRDF",
            Self::AlwaysMeet => "meet at every place that was tried",
        })
    }
}

/// Two links, by their indices.
type Two = [usize; 2];

/// Two links, and the distance that they are to keep.
type Kept = (Two, f64);

/// All pairs.
#[derive(Default)]
pub(super) struct Chosen {
    /// They keep a distance.
    pub(super) kept: Vec<Kept>,
    /// They do not, and why.
    pub(super) skipped: Vec<(Two, Skipped)>,
    /// They are nearer than the distance at each of the places that were tried, but are not
    /// [`Skipped::AlwaysMeet`]. [`Robot::read`](super::Robot::read) refuses them.
    pub(super) near: Vec<Kept>,
    /// How many are kept that an SRDF disables as never near.
    pub(super) never: usize,
}

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
        let by_srdf =
            |(names, reason): &([String; 2], String)| is(names, pair) && !is_by_sampling(reason);
        if bodies[b].neighbour == Some(a) || bodies[a].neighbour == Some(b) {
            Some(Skipped::Neighbours)
        } else if bodies[a].mover == bodies[b].mover {
            Some(Skipped::Rigid)
        } else {
            disabled.iter().any(by_srdf).then_some(Skipped::Disabled)
        }
    };
    let (mut all, mut open) = (Chosen::default(), Vec::new());
    for pair in (0..links.len()).flat_map(|a| (a + 1..links.len()).map(move |b| [a, b])) {
        let own = options.keep_pairs.iter().rev().find(|(names, _)| is(names, pair));
        match (own, why(pair)) {
            (Some((_, keep)), _) => all.kept.push((pair, *keep)),
            (None, Some(why)) => all.skipped.push((pair, why)),
            (None, None) => open.push((pair, options.keep)),
        }
    }
    let near = always_near(mechanism, links, &open, options.samples)?;
    all.kept.extend(open.into_iter().filter(|open| near.iter().all(|(near, _)| near != open)));
    for (near, meets) in near {
        // Places that a joint never had say nothing.
        if meets && mechanism.is_free(near.0) {
            all.skipped.push((near.0, Skipped::AlwaysMeet));
        } else {
            all.near.push(near);
        }
    }
    all.kept.sort_by_key(|(pair, _)| *pair);
    all.skipped.sort_by_key(|(pair, _)| *pair);
    let is_never = |(pair, _): &&Kept| {
        disabled.iter().any(|(names, reason)| is(names, *pair) && is_by_sampling(reason))
    };
    all.never = all.kept.iter().filter(is_never).count();
    Ok(all)
}

/// Whether an SRDF disables a pair because its writer found it far apart at all places that it
/// tried. That proves nothing.
fn is_by_sampling(reason: &str) -> bool {
    reason.trim().eq_ignore_ascii_case("never")
}

/// The pairs that are too near in every sample, and whether they meet in each. Without samples
/// there are none.
fn always_near(
    mechanism: &Mechanism,
    links: &[Link],
    pairs: &[Kept],
    samples: u32,
) -> Result<Vec<(Kept, bool)>, QueryError> {
    let mut near: Vec<_> = pairs.iter().map(|pair| (*pair, true)).collect();
    if samples == 0 {
        near.clear();
    }
    let blobs: Vec<_> = links.iter().map(|link| link.built.blob()).collect();
    let trees = blobs.iter().map(|blob| blob.bvh().map_err(|_| QueryError::Unchecked));
    let trees = trees.collect::<Result<Vec<Bvh<'_>>, _>>()?;
    let mut scratch = vec![ScratchEntry::EMPTY; Bvh::DISTANCE_ENTRIES];
    for places in sampled(&mechanism.places, samples) {
        if near.is_empty() {
            break;
        }
        let poses = mechanism.poses(&places)?;
        let mut failed: Option<QueryError> = None;
        near.retain_mut(|(([a, b], keep), meets)| {
            let relative = poses[*b].pose.relative_to(&poses[*a].pose);
            let mut is_near = |distance: f32| -> Result<bool, QueryError> {
                let (a, b, pose) = (&trees[*a], &trees[*b], relative?.pose);
                let found = a.within_of(b, pose, distance, Budget::EXACT, &mut scratch)?;
                Ok(!found.is_clear())
            };
            let found = is_near(*keep as f32).and_then(|near| {
                *meets = *meets && near && is_near(0.0)?;
                Ok(near)
            });
            found.unwrap_or_else(|error| {
                failed = Some(error);
                true
            })
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
