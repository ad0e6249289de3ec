//! Links and joints in the order of computation. A fixed joint becomes part of the next joint that
//! moves. A link with geometry behind fixed joints gets one fixed joint of its own.

use super::urdf::{Moves, Urdf, UrdfJoint, refused};
use crate::error::BuildError;
use crate::mesh::Placement;
use meshsweep_core::internal::num::up_to_f32;
use meshsweep_core::{Joint, JointAxis, JointKind, Pose, RoundedPose};
use std::collections::HashMap;
use std::path::Path;

/// A number that a caller gives for each pose: the place of a joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// The joint's name.
    pub joint: String,
    /// Whether the joint slides. If not, it turns, and the place is in radians.
    pub slides: bool,
    /// Lowest and highest place, radians or metres. Of a continuous joint −π and π.
    pub limits: [f64; 2],
}

/// A link with geometry.
pub(super) struct Body {
    /// Index of the link in the file.
    pub(super) link: usize,
    /// Index of its joint.
    pub(super) joint: u16,
    /// The last joint on the way from the world that moves. Bodies of one mover never move
    /// relative to each other.
    pub(super) mover: Option<u16>,
    /// The next body on the way to the world, if at most one joint between them moves.
    pub(super) neighbour: Option<usize>,
}

/// What firmware computes of a robot: only joints that a link with geometry needs.
pub(super) struct Mechanism {
    pub(super) joints: Vec<Joint>,
    pub(super) bodies: Vec<Body>,
    pub(super) places: Vec<Place>,
}

/// Where a link is.
#[derive(Clone)]
struct Frame {
    /// The last stored joint on the way from the world. `None`: the world itself.
    anchor: Option<u16>,
    /// In the frame of the anchor's link.
    placement: Placement,
    mover: Option<u16>,
    /// The last body on the way from the world, and how many joints after it move.
    body: Option<(usize, usize)>,
}

/// Indices of the links, parents first, each with the joint that carries it.
fn ordered(file: &Path, urdf: &Urdf) -> Result<Vec<(usize, Option<usize>)>, BuildError> {
    let link = |name: &str| urdf.links.iter().position(|link| link.name == name);
    let mut carrier: Vec<Option<usize>> = vec![None; urdf.links.len()];
    let mut carried: Vec<Vec<(usize, usize)>> = vec![Vec::new(); urdf.links.len()];
    for (index, joint) in urdf.joints.iter().enumerate() {
        let (Some(parent), Some(child)) = (link(&joint.parent), link(&joint.child)) else {
            continue;
        };
        if let Some(first) = carrier[child].replace(index) {
            let (child, first) = (&joint.child, &urdf.joints[first].name);
            let what =
                format!("joint {:?}: link {child:?} is carried by {first:?} already", joint.name);
            return Err(refused(file, joint.line, what));
        }
        carried[parent].push((child, index));
    }
    let mut roots = (0..urdf.links.len()).filter(|&link| carrier[link].is_none());
    let Some(root) = roots.next() else {
        let what = "no link is without a joint above it: nothing is the root".to_owned();
        return Err(BuildError::Robot { file: file.to_owned(), line: None, what });
    };
    if let Some(other) = roots.next() {
        let (first, other) = (&urdf.links[root].name, &urdf.links[other]);
        let what =
            format!("link {:?}: a second root, beside {first:?}; no joint joins them", other.name);
        return Err(refused(file, other.line, what));
    }
    let (mut order, mut open) = (Vec::new(), vec![(root, None)]);
    while let Some((link, joint)) = open.pop() {
        order.push((link, joint));
        open.extend(carried[link].iter().rev().map(|&(child, joint)| (child, Some(joint))));
    }
    let is_known = |link: usize| order.iter().any(|&(known, _)| known == link);
    match (0..urdf.links.len()).find(|&link| !is_known(link)) {
        Some(link) => {
            let link = &urdf.links[link];
            let what = format!("link {:?}: its joints go round in a circle", link.name);
            Err(refused(file, link.line, what))
        }
        None => Ok(order),
    }
}

impl Mechanism {
    pub(super) fn new(file: &Path, urdf: &Urdf) -> Result<Self, BuildError> {
        let order = ordered(file, urdf)?;
        // Links that carry no geometry need no pose.
        let mut is_needed: Vec<bool> =
            urdf.links.iter().map(|link| !link.collisions.is_empty()).collect();
        let index: HashMap<&str, usize> =
            urdf.links.iter().enumerate().map(|(at, link)| (link.name.as_str(), at)).collect();
        for &(link, joint) in order.iter().rev() {
            if let (true, Some(joint)) = (is_needed[link], joint) {
                is_needed[index[urdf.joints[joint].parent.as_str()]] = true;
            }
        }
        let mut all = Self { joints: Vec::new(), bodies: Vec::new(), places: Vec::new() };
        let still = Frame { anchor: None, placement: Placement::IDENTITY, mover: None, body: None };
        let mut frames: Vec<Frame> = vec![still; urdf.links.len()];
        for (link, joint) in order.into_iter().filter(|&(link, _)| is_needed[link]) {
            if let Some(joint) = joint.map(|joint| &urdf.joints[joint]) {
                let parent = &frames[index[joint.parent.as_str()]];
                let anchor = parent.anchor;
                let body = parent.body.map(|(body, moving)| (body, moving + 1));
                let placement = parent.placement.after(&joint.origin);
                frames[link] = if joint.moves == Moves::Not {
                    Frame { placement, ..parent.clone() }
                } else {
                    let axis = all.axis(file, urdf, joint)?;
                    let kind = if joint.moves == Moves::Turns {
                        JointKind::Turns(axis)
                    } else {
                        JointKind::Slides(axis)
                    };
                    let own = Some(all.push(file, joint.line, (anchor, &placement, kind))?);
                    Frame { anchor: own, placement: Placement::IDENTITY, mover: own, body }
                };
            }
            if urdf.links[link].collisions.is_empty() {
                continue;
            }
            let Frame { anchor, placement, mover, body } = frames[link].clone();
            let neighbour = body.and_then(|(body, moving)| (moving <= 1).then_some(body));
            let joint = match anchor {
                Some(anchor) if placement == Placement::IDENTITY => anchor,
                _ => {
                    all.push(file, urdf.links[link].line, (anchor, &placement, JointKind::Fixed))?
                }
            };
            frames[link].body = Some((all.bodies.len(), 0));
            all.bodies.push(Body { link, joint, mover, neighbour });
        }
        Ok(all)
    }

    /// Stores a joint; its index.
    fn push(
        &mut self,
        file: &Path,
        line: usize,
        (parent, placement, kind): (Option<u16>, &Placement, JointKind),
    ) -> Result<u16, BuildError> {
        let (rows, shift, [turn, moved]) = placement.rounded();
        if !rows.iter().flatten().chain(&shift).all(|x| x.is_finite()) {
            return Err(refused(file, line, "an origin is beyond f32 (3.4e38)".to_owned()));
        }
        let origin =
            RoundedPose::within(Pose::rigid(rows, shift), up_to_f32(turn), up_to_f32(moved));
        let index = u16::try_from(self.joints.len());
        let index = index.map_err(|_| refused(file, line, "too many joints".to_owned()))?;
        self.joints.push(Joint { parent, origin, kind });
        Ok(index)
    }

    /// The axis of a joint. A joint that mimics others takes the place of the last of them, by one
    /// factor and one offset.
    fn axis(
        &mut self,
        file: &Path,
        urdf: &Urdf,
        joint: &UrdfJoint,
    ) -> Result<JointAxis, BuildError> {
        let (mut of, mut factor, mut offset) = (joint, 1.0, 0.0);
        for step in 0.. {
            let Some(follows) = &of.follows else { break };
            let leader = urdf.joints.iter().find(|other| other.name == follows.joint);
            let leader =
                leader.filter(|leader| leader.moves != Moves::Not && step <= urdf.joints.len());
            let Some(leader) = leader else {
                let what = format!(
                    "joint {:?}: there is no {:?} that moves by itself, which it mimics",
                    joint.name, follows.joint
                );
                return Err(refused(file, joint.line, what));
            };
            (offset, factor) = (factor * follows.offset + offset, factor * follows.factor);
            of = leader;
        }
        let known = self.places.iter().position(|place| place.joint == of.name);
        let place = known.unwrap_or_else(|| {
            let slides = of.moves == Moves::Slides;
            self.places.push(Place { joint: of.name.clone(), slides, limits: of.limits });
            self.places.len() - 1
        });
        let place = u16::try_from(place);
        let place = place.map_err(|_| refused(file, joint.line, "too many joints".to_owned()))?;
        let follows = joint.follows.is_some().then_some([factor as f32, offset as f32]);
        let fits = |[by, offset]: [f32; 2]| (factor == 0.0 || by.is_normal()) && offset.is_finite();
        if !follows.is_none_or(fits) {
            let what = format!(
                "joint {:?}: it mimics by numbers beyond f32 (1.2e-38 to 3.4e38)",
                joint.name
            );
            return Err(refused(file, joint.line, what));
        }
        Ok(JointAxis { follows, ..JointAxis::new(joint.axis.map(|x| x as f32), place) })
    }

    /// Whether all joints between two bodies have more than one place.
    pub(super) fn is_free(&self, bodies: [usize; 2]) -> bool {
        let [a, b] = bodies.map(|body| -> Vec<u16> {
            let first = Some(self.bodies[body].joint);
            std::iter::successors(first, |&at| self.joints[usize::from(at)].parent).collect()
        });
        let of_one = |a: &[u16], b: &[u16]| {
            a.iter().filter(|joint| !b.contains(joint)).all(|&joint| {
                match &self.joints[usize::from(joint)].kind {
                    JointKind::Fixed => true,
                    JointKind::Turns(axis) | JointKind::Slides(axis) => {
                        let [low, high] = self.places[usize::from(axis.place)].limits;
                        low < high
                    }
                }
            })
        };
        of_one(&a, &b) && of_one(&b, &a)
    }
}
