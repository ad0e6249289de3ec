//! Closed components: their volumes, their nesting, and whether they are inside out.
//!
//! A component that lies in no other must face outwards. It is *inside out* if its signed volume is
//! negative. Then it is turned together with all components inside it, for those were drawn
//! relative to it. A component inside another is never judged on its own: facing inwards it is a
//! cavity, facing outwards it is a solid within a solid, and both are valid.
//!
//! *What is proved before a component is turned.*
//! - It shares only points with itself and others, but for common corners and edges.
//! - No other component touches it from outside.
//! - A point within one of its faces or edges lies in no closed component.
//! - Its box lies in the box of no open component, which might be a skin with holes.
//! - No component of unproved nesting has a box that meets its box: a component is turned with the
//!   whole of its inside or not at all.
//!
//! If one of these is not proved, the component is in *doubt* and is not turned. So is one whose
//! volume may be zero within rounding.
//!
//! Components that are open, one-sided or on a non-manifold edge have no inside.

use super::volume::SignedVolume;
use super::winding::Components;
use crate::geom::{Bounds, Contact, Enclosures, FaceTree, faces, inner_points};
use glam::{DVec3, Vec3};
use std::sync::Mutex;
use std::sync::atomic::AtomicBool;
use std::sync::atomic::Ordering::Relaxed;

/// A closed two-sided component.
pub(super) struct ClosedComponent {
    /// Its number in [`Components`].
    pub number: u32,
    /// Its first triangle.
    pub first: u32,
    pub volume: SignedVolume,
    pub standing: Standing,
}

/// How a closed component lies to the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Standing {
    /// It faces outwards, and is not proved to lie in one that is inside out. It is not turned.
    Kept,
    /// It is inside out, and lies in no other.
    InsideOut,
    /// It lies in one that is inside out, to be turned with it.
    InInsideOut,
    /// It lies in another that faces outwards, and faces inwards.
    Cavity,
    /// It faces inwards, and may be a cavity or inside out.
    Doubt {
        /// Whether its box and an inner point lie in another closed component.
        may_be_cavity: bool,
    },
}

impl Standing {
    /// Whether repair turns the component.
    pub(super) fn is_turned(self) -> bool {
        matches!(self, Self::InsideOut | Self::InInsideOut)
    }
}

/// All closed two-sided components of `triangles`, which must be wound consistently.
///
/// Cost: linear, if no component faces inwards. Else a search for the contacts of all faces.
pub(super) fn closed_components(
    positions: &[[f32; 3]],
    triangles: &[[u32; 3]],
    parts: &Components,
) -> Vec<ClosedComponent> {
    let count = parts.kinds.len();
    let is_closed = |part: usize| parts.kinds[part].closed && parts.kinds[part].conflict.is_none();
    let mut members: Vec<Vec<u32>> = vec![Vec::new(); count];
    for (t, &part) in parts.part.iter().enumerate() {
        members[part as usize].push(t as u32);
    }
    let corners = |&t: &u32| triangles[t as usize].map(|v| positions[v as usize]);
    let wide = |triangle: [[f32; 3]; 3]| triangle.map(|p| Vec3::from(p).as_dvec3());
    let closed: Vec<u32> = (0..count as u32).filter(|&part| is_closed(part as usize)).collect();
    let of = |&number: &u32| {
        let of = &members[number as usize];
        let volume = SignedVolume::of(of.iter().map(|t| wide(corners(t))));
        ClosedComponent { number, first: of[0], volume, standing: Standing::Kept }
    };
    let mut components: Vec<ClosedComponent> = closed.iter().map(of).collect();
    if components.iter().any(|of| of.volume.is_negative()) {
        let faces_in: Vec<bool> = components.iter().map(|of| of.volume.is_negative()).collect();
        let surroundings =
            Surroundings::new(positions, triangles, parts, (&closed, &faces_in), &members);
        let standings: Vec<Standing> =
            (0..closed.len()).map(|i| surroundings.standing(i, &faces_in)).collect();
        components.iter_mut().zip(standings).for_each(|(of, standing)| of.standing = standing);
    }
    components
}

/// What each closed component meets, and which others have it inside.
struct Surroundings {
    /// For each closed component, by its place among them.
    of: Vec<Surrounding>,
}

struct Surrounding {
    /// It crosses itself or another component, or its nesting is not proved.
    is_doubtful: bool,
    /// Closed components that have it inside.
    containers: Vec<usize>,
    /// Components that touch it in points: closed ones, by their places among the closed ones.
    touching: Vec<Option<usize>>,
    /// It faces inwards, and its box lies in that of an open component.
    may_be_in_open: bool,
    /// It faces inwards, and a doubtful component may lie in it: their boxes meet.
    may_hold_doubt: bool,
}

impl Surroundings {
    fn new(
        positions: &[[f32; 3]],
        triangles: &[[u32; 3]],
        parts: &Components,
        (closed, faces_in): (&[u32], &[bool]),
        members: &[Vec<u32>],
    ) -> Self {
        let wide: Vec<DVec3> = positions.iter().map(|&p| Vec3::from(p).as_dvec3()).collect();
        let flags = || (0..parts.kinds.len()).map(|_| AtomicBool::new(false)).collect::<Vec<_>>();
        let (crossing, crosses_itself) = (flags(), flags());
        let touching: Mutex<Vec<[u32; 2]>> = Mutex::default();
        let parts_of = |pair: [usize; 2]| pair.map(|t| parts.part[t]);
        let is_set = |flags: &[AtomicBool], part: u32| flags[part as usize].load(Relaxed);
        // A pair whose parts are known to cross tells nothing new. So surfaces that overlap with
        // all their faces take little time. Which pairs are left out changes no flag.
        let tells_more = |pair: [usize; 2]| {
            let [a, b] = parts_of(pair);
            !(is_set(&crossing, a)
                && is_set(&crossing, b)
                && (a != b || is_set(&crosses_itself, a)))
        };
        FaceTree::new(&faces(&wide, triangles)).visit_contacts(tells_more, |pair, contact| {
            let [a, b] = parts_of(pair);
            if contact != Contact::Point {
                crossing[a as usize].store(true, Relaxed);
                crossing[b as usize].store(true, Relaxed);
                crosses_itself[a as usize].fetch_or(a == b, Relaxed);
            } else if a != b
                && let Ok(mut touching) = touching.lock()
            {
                touching.extend([[a, b], [b, a]]);
            }
        });
        let [crossing, crosses_itself] = [crossing, crosses_itself]
            .map(|flags| flags.into_iter().map(AtomicBool::into_inner).collect::<Vec<bool>>());
        let mut touching = touching.into_inner().unwrap_or_default();
        touching.sort_unstable();
        touching.dedup();
        let bounds: Vec<Bounds> = members
            .iter()
            .map(|of| {
                let corners = of.iter().flat_map(|&t| triangles[t as usize]);
                corners.map(|v| wide[v as usize]).fold(Bounds::EMPTY, Bounds::with)
            })
            .collect();
        let place_of = |part: u32| closed.binary_search(&part).ok();
        let open: Vec<usize> =
            (0..members.len()).filter(|&part| place_of(part as u32).is_none()).collect();
        let corners_of = |part: u32| {
            let corners = |&t: &u32| triangles[t as usize].map(|v| positions[v as usize]);
            members[part as usize].iter().map(corners)
        };
        let enclosures = Enclosures::new(closed.iter().map(|&part| corners_of(part).collect()));
        let holds = |part: usize, other: usize| bounds[part].contains(&bounds[other]);
        let self_crossing: Vec<usize> =
            closed.iter().map(|&of| of as usize).filter(|&of| crosses_itself[of]).collect();
        let mut of: Vec<Surrounding> = closed
            .iter()
            .enumerate()
            .map(|(i, &part)| {
                let number = part as usize;
                let inner =
                    inner_points(corners_of(part)).find(|&p| !enclosures.touches(p, Some(i)));
                let containers = inner.map(|p| enclosures.around(p, Some(i))).unwrap_or_default();
                // A surface that crosses itself may have a point inside of which the parity is
                // even.
                let is_unclear =
                    self_crossing.iter().any(|&other| other != number && holds(other, number));
                Surrounding {
                    is_doubtful: crossing[number] || inner.is_none() || is_unclear,
                    containers,
                    touching: with(&touching, part).map(place_of).collect(),
                    may_be_in_open: faces_in[i] && open.iter().any(|&other| holds(other, number)),
                    may_hold_doubt: false,
                }
            })
            .collect();
        let doubtful: Vec<u32> = (closed.iter().zip(&of))
            .filter(|(_, of)| of.is_doubtful)
            .map(|(&part, _)| part)
            .collect();
        for ((&part, of), _) in closed.iter().zip(&mut of).zip(faces_in).filter(|(_, is)| **is) {
            let meets = |other: &u32| {
                *other != part && bounds[*other as usize].meets(&bounds[part as usize])
            };
            of.may_hold_doubt = doubtful.iter().any(meets);
        }
        Self { of }
    }

    /// Whether a component is proved to lie in no other, and nothing touches it from without.
    fn is_proved_outermost(&self, i: usize) -> bool {
        let Surrounding { is_doubtful, containers, touching, may_be_in_open, may_hold_doubt } =
            &self.of[i];
        let is_within = |other: &Option<usize>| {
            other.is_some_and(|other| {
                !self.of[other].is_doubtful && self.of[other].containers.contains(&i)
            })
        };
        let is_clear = !is_doubtful && !may_be_in_open && !may_hold_doubt;
        is_clear && containers.is_empty() && touching.iter().all(is_within)
    }

    fn standing(&self, i: usize, faces_in: &[bool]) -> Standing {
        let faces_in = |i: usize| faces_in[i];
        let Surrounding { is_doubtful, containers, .. } = &self.of[i];
        let doubt = match faces_in(i) {
            true => Standing::Doubt { may_be_cavity: !containers.is_empty() },
            false => Standing::Kept,
        };
        if *is_doubtful {
            return doubt;
        }
        if containers.is_empty() {
            return match (faces_in(i), self.is_proved_outermost(i)) {
                (true, true) => Standing::InsideOut,
                _ => doubt,
            };
        }
        let mut outermost = containers.iter().filter(|&&of| self.of[of].containers.is_empty());
        match (outermost.next(), outermost.next()) {
            (Some(&of), None) if faces_in(of) && self.is_proved_outermost(of) => {
                Standing::InInsideOut
            }
            (Some(&of), None) if faces_in(i) && !faces_in(of) => Standing::Cavity,
            _ => doubt,
        }
    }
}

/// The seconds of the pairs, which are sorted, with a first.
fn with(pairs: &[[u32; 2]], first: u32) -> impl Iterator<Item = u32> {
    let from = pairs.partition_point(|pair| pair[0] < first);
    pairs[from..].iter().take_while(move |pair| pair[0] == first).map(|pair| pair[1])
}
