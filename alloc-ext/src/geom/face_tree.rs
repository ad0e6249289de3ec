//! Faces and a static tree of their boxes: which of them meet, and how often they wind around a
//! point.

use super::bounds::Bounds;
use super::contact::Contact;
use super::predicates::{Face, is_degenerate, segment_meets, side};
use super::ray::ray_crossing;
use super::tree::StaticTree;
use glam::DVec3;
use rayon::prelude::*;

/// Faces that are asked for each other. Faces without area meet none, and wind around nothing.
pub(crate) struct FaceTree<'a> {
    faces: &'a [Face],
    boxes: Vec<Bounds>,
    has_area: Vec<bool>,
    tree: StaticTree,
}

/// How a face meets all others.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Meeting {
    /// Whether it [crosses](Contact::Crossing) another.
    pub crosses: bool,
    /// Its edges that others touch along the edge, one bit each; not all of a face that crosses.
    pub touched_edges: u8,
}

/// Faces whose contacts are searched before they are counted.
const BLOCK: usize = 1 << 12;

impl<'a> FaceTree<'a> {
    /// Cost: n log n.
    pub fn new(faces: &'a [Face]) -> Self {
        let boxes: Vec<Bounds> = faces.par_iter().map(|face| Bounds::of(&face.at)).collect();
        let has_area = faces.par_iter().map(|face| !is_degenerate(&face.at)).collect();
        let tree = StaticTree::new(&boxes);
        Self { faces, boxes, has_area, tree }
    }

    pub fn has_area(&self, face: u32) -> bool {
        self.has_area[face as usize]
    }

    /// Pairs of faces that are not [apart](Contact::Apart), ascending. Exact. After `most`
    /// crossings the search soon ends: then there may be more.
    ///
    /// Cost: one query of the tree for each face, on all threads. The pairs are the same on any
    /// number of threads.
    pub fn contacts(&self, most: usize) -> Vec<([u32; 2], Contact)> {
        let mut found = Vec::new();
        let (mut from, mut crossings) = (0, 0);
        while from < self.faces.len() && crossings < most {
            let (to, counted) = ((from + BLOCK).min(self.faces.len()), found.len());
            let block = (from..to).into_par_iter();
            found.par_extend(block.flat_map_iter(|i| self.contacts_with_later(i, most)));
            crossings += found[counted..].iter().filter(|(_, of)| *of == Contact::Crossing).count();
            from = to;
        }
        found
    }

    fn contacts_with_later(&self, i: usize, most: usize) -> Vec<([u32; 2], Contact)> {
        let (mut found, mut crossings) = (Vec::new(), 0);
        if self.has_area[i] {
            self.tree.visit_meeting(&self.boxes[i], |j| {
                if j > i && self.has_area[j] && self.boxes[j].meets(&self.boxes[i]) {
                    let contact = Contact::of(&self.faces[i], &self.faces[j]);
                    crossings += usize::from(contact == Contact::Crossing);
                    if contact != Contact::Apart {
                        found.push(([i as u32, j as u32], contact));
                    }
                }
                crossings < most
            });
        }
        found.sort_unstable_by_key(|(pair, _)| *pair);
        found
    }

    /// Calls `found` with every pair of faces that is `wanted` and not [apart](Contact::Apart), on
    /// all threads and in any order. Exact.
    ///
    /// Cost: one query of the tree for each face, and a test for each wanted pair whose boxes meet.
    pub fn visit_contacts(
        &self,
        wanted: impl Fn([usize; 2]) -> bool + Sync,
        found: impl Fn([usize; 2], Contact) + Sync,
    ) {
        (0..self.faces.len()).into_par_iter().filter(|&i| self.has_area[i]).for_each(|i| {
            self.tree.visit_meeting(&self.boxes[i], |j| {
                let may_meet = j > i && self.has_area[j] && self.boxes[j].meets(&self.boxes[i]);
                if may_meet && wanted([i, j]) {
                    let contact = Contact::of(&self.faces[i], &self.faces[j]);
                    if contact != Contact::Apart {
                        found([i, j], contact);
                    }
                }
                true
            });
        });
    }

    /// How each face meets the others.
    ///
    /// Cost: one query of the tree for each face, on all threads; a face that crosses one other is
    /// not tested against more.
    pub fn meetings(&self) -> Vec<Meeting> {
        (0..self.faces.len()).into_par_iter().map(|i| self.meeting(i)).collect()
    }

    fn meeting(&self, i: usize) -> Meeting {
        let mut meeting = Meeting { crosses: false, touched_edges: 0 };
        if self.has_area[i] {
            self.tree.visit_meeting(&self.boxes[i], |j| {
                if j != i && self.has_area[j] && self.boxes[j].meets(&self.boxes[i]) {
                    match Contact::of(&self.faces[i], &self.faces[j]) {
                        Contact::Apart | Contact::Point => {}
                        Contact::Edges([edges, _]) => meeting.touched_edges |= edges,
                        Contact::Crossing => meeting.crosses = true,
                    }
                }
                !meeting.crosses
            });
        }
        meeting
    }

    /// The winding number of a point of a closed surface that lies on no face, each face `times`.
    /// Exact.
    pub fn winding(&self, p: DVec3, times: impl Fn(usize) -> i32) -> i32 {
        let ray = Bounds { low: p, high: DVec3::new(p.x, p.y, f64::INFINITY) };
        let mut winding = 0;
        self.tree.visit_meeting(&ray, |i| {
            winding +=
                times(i) * ray_crossing(p.to_array(), &self.faces[i].at.map(|p| p.to_array()));
            true
        });
        winding
    }

    /// A point in front of a face with area, from which a segment leads through this face and meets
    /// no other. `None` if none was found: others are too near.
    pub fn in_front(&self, face: u32) -> Option<DVec3> {
        let at = &self.faces[face as usize].at;
        let middle = (at[0] + at[1] + at[2]) / 3.0;
        let normal = (at[1] - at[0]).cross(at[2] - at[0]).normalize_or_zero();
        let size = middle.abs().max_element() + (at[1] - at[0]).abs().max_element();
        FRACTIONS.into_iter().find_map(|fraction| {
            let (p, q) = (middle + normal * (size * fraction), middle - normal * (size * fraction));
            let passes = side(at, p) > 0.0 && side(at, q) < 0.0;
            let bounds = Bounds::of(&[p, q]);
            let is_clear_of = |i: usize| {
                let meets = || {
                    let other = &self.faces[i].at;
                    segment_meets([p, q], [side(other, p), side(other, q)], other)
                };
                i == face as usize || !self.has_area[i] || !self.boxes[i].meets(&bounds) || !meets()
            };
            let is_through = || segment_meets([p, q], [side(at, p), side(at, q)], at);
            (passes && is_through() && self.tree.visit_meeting(&bounds, is_clear_of)).then_some(p)
        })
    }
}

/// Half lengths of the segments that are tried, as fractions of the coordinates: longer than the
/// rounding of `f64`, the first shorter than a step of `f32`.
const FRACTIONS: [f64; 2] = [1.0 / (1u64 << 30) as f64, 1.0 / (1u64 << 44) as f64];
