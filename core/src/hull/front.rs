//! The front of a sweep (Guéziec 2000, 3.2): triangles of any levels that stand for the surface.
//!
//! Each triangle of a level stands for a part of the surface, which the triangle swept by its
//! radius contains. In the builder's order a triangle is removed by the first split of its corners.
//! Of the triangles that this split brings, one to three are its children: their parts make up its
//! part. So a triangle can be replaced by its children alone, and no split has to be performed
//! first: the front is a set of bounds and not a mesh. No triangle is reached twice, so nothing has
//! to be remembered but the triangles that wait. Proof: `core/docs/rounding.md` §3.

use super::geometry::Geometry;
use crate::geom::LANES;
use crate::hull::format::layout::BASE_GROUP;
use crate::hull::format::{Hull, Instance, Named, SplitIdx, VertIdx};
use crate::num::each;
use crate::query::{ScratchEntry, SweepQueue, Work};
use glam::Vec3;

/// How a triangle can be refined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Refinable {
    /// A split refines it.
    BySplit,
    /// It is one of the surface.
    Surface,
    /// The split that refines it is not in the blob.
    Cut,
}

/// A triangle that the front came to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate {
    pub(crate) corners: [Vec3; 3],
    pub(crate) radius: f32,
    pub(crate) instance: Instance,
    pub(crate) refinable: Refinable,
}

impl Candidate {
    const EMPTY: Candidate = Candidate {
        corners: [Vec3::ZERO; 3],
        radius: 0.0,
        instance: Instance(0),
        refinable: Refinable::Cut,
    };
}

/// Receives triangles, bounds them, and queues those that may matter.
pub(crate) trait Visit {
    /// At most [`LANES`] triangles.
    fn visit(&mut self, found: &[Candidate], queue: &mut SweepQueue<'_>);
}

/// A vertex, and its split as it is stored.
#[derive(Clone, Copy)]
struct End {
    vertex: VertIdx,
    split: u32,
}

/// A triangle of a level.
#[derive(Clone, Copy)]
struct Triangle {
    instance: Instance,
    ends: [End; 3],
    /// Its number among the radii.
    radius: u32,
}

impl Triangle {
    /// The split that removes it, as it is stored.
    #[inline(always)]
    fn split(&self) -> u32 {
        let [a, b, c] = self.ends;
        a.split.min(b.split).min(c.split)
    }
}

/// Up to [`LANES`] triangles on their way to a visitor.
#[derive(Debug)]
struct Batch {
    found: [Candidate; LANES],
    len: usize,
}

impl Batch {
    const EMPTY: Batch = Batch { found: [Candidate::EMPTY; LANES], len: 0 };

    /// Less than [`LANES`] triangles wait.
    #[inline(always)]
    fn put(&mut self, candidate: Candidate) {
        self.found[self.len % LANES] = candidate;
        self.len += 1;
    }

    #[inline(always)]
    fn push(&mut self, candidate: Candidate, visitor: &mut impl Visit, queue: &mut SweepQueue<'_>) {
        self.put(candidate);
        if self.len == LANES {
            self.flush(visitor, queue);
        }
    }

    #[inline(always)]
    fn flush(&mut self, visitor: &mut impl Visit, queue: &mut SweepQueue<'_>) {
        if let Some(found) = self.found.get(..self.len) {
            visitor.visit(found, queue);
        }
        self.len = 0;
    }
}

/// Children of a triangle.
struct Children {
    triangles: [Triangle; CHILDREN],
    count: usize,
}

const CHILDREN: usize = 3;

/// Triangles and groups of all levels. No search on sound tables replaces more.
pub(crate) fn triangles(model: &Hull<'_>) -> u32 {
    let h = model.header();
    let triangles = h.rings.saturating_add(h.base_triangles).saturating_add(2 * h.splits);
    triangles.saturating_add(model.base_groups())
}

/// The triangles that wait.
#[derive(Debug)]
pub(crate) struct Front<'m, G> {
    pub(crate) model: G,
    pub(crate) queue: SweepQueue<'m>,
    pub(crate) work: Work,
    /// Triangles that may be replaced.
    steps: u32,
    batch: Batch,
}

impl<'a, 'm, G: Geometry<'a>> Front<'m, G> {
    /// An empty front that may replace `steps` triangles, at most as many as the tables hold. So a
    /// search ends even if checked tables name a triangle twice.
    pub(crate) fn new(model: &G, scratch: &'m mut [ScratchEntry], steps: u32) -> Self
    where
        G: Copy,
    {
        Front {
            steps: steps.min(triangles(model.tables())),
            model: *model,
            queue: SweepQueue::new(scratch, model.tables().scratch_entries()),
            work: Work::NONE,
            batch: Batch::EMPTY,
        }
    }

    /// Shows the groups of the base hull to the visitor.
    pub(crate) fn begin(&mut self, visitor: &mut impl Visit) -> Option<()> {
        let groups = self.model.tables().base_groups();
        self.queue.begin_children(groups);
        for index in 0..groups {
            let (corners, radius) = self.model.group(index)?;
            if self.is_partless(radius) {
                continue;
            }
            self.work.bounds += 1;
            let instance = self.model.tables().instance(Named::Group(index));
            let candidate = Candidate { corners, radius, instance, refinable: Refinable::BySplit };
            self.batch.push(candidate, visitor, &mut self.queue);
        }
        self.batch.flush(visitor, &mut self.queue);
        Some(())
    }

    /// A front whose queue never goes depth first, and that may replace no triangle yet.
    pub(crate) fn best_first(model: G, scratch: &'m mut [ScratchEntry]) -> Self {
        Front {
            queue: SweepQueue::best_first(scratch),
            work: Work::NONE,
            model,
            steps: 0,
            batch: Batch::EMPTY,
        }
    }

    /// For a search that starts once more: `steps` triangles in all may be replaced, and no more
    /// than the tables hold from now on.
    pub(crate) fn allow_anew(&mut self, steps: u32) {
        self.steps = steps.min(self.work.opened.saturating_add(triangles(self.model.tables())));
    }

    /// From now on, `steps` triangles may be replaced.
    pub(crate) fn allow(&mut self, steps: u32) {
        self.work = Work::NONE;
        self.steps = steps.min(triangles(self.model.tables()));
    }

    /// The triangle or group of a number. It is not counted as work.
    pub(crate) fn look(&self, instance: Instance) -> Option<Candidate> {
        let (corners, radius) = match self.model.tables().named(instance) {
            Named::Group(index) => {
                let (corners, radius) = self.model.group(index)?;
                return Some(Candidate {
                    corners,
                    radius,
                    instance,
                    refinable: Refinable::BySplit,
                });
            }
            Named::Base(index) => (self.model.tables().base_triangle(index)?, index),
            Named::Fine(split, slot) => {
                let split = self.model.tables().split(split)?;
                (split.fine(slot as usize)?, split.first_triangle.checked_add(slot)?)
            }
        };
        let refinable = self.refinable(self.model.tables().removed_by(corners));
        let (corners, radius) =
            self.model.triangle(corners, radius, refinable == Refinable::Surface)?;
        Some(Candidate { corners, radius, instance, refinable })
    }

    fn refinable(&self, split: Option<SplitIdx>) -> Refinable {
        match split {
            Some(_) => Refinable::BySplit,
            None if self.model.tables().is_cut() => Refinable::Cut,
            None => Refinable::Surface,
        }
    }

    /// Whether no triangle may be replaced any more.
    pub(crate) fn is_spent(&self) -> bool {
        self.work.opened >= self.steps
    }

    /// Replaces a triangle or a group by finer triangles. `None`: the model is unchecked.
    #[inline]
    pub(crate) fn open(&mut self, instance: Instance, visitor: &mut impl Visit) -> Option<()> {
        self.work.opened += 1;
        if let Named::Group(index) = self.model.tables().named(instance) {
            return self.open_group(index, visitor);
        }
        let [a, b, c] = self.model.tables().corners(instance)?;
        let ends = [self.end(a)?, self.end(b)?, self.end(c)?];
        let mut triangle = Triangle { instance, ends, radius: 0 };
        let mut split = self.model.tables().stored_split(triangle.split())?;
        let mut children = Children { triangles: [triangle; CHILDREN], count: 0 };
        loop {
            self.replace(&triangle, split, &mut children)?;
            if children.count != 1 || self.is_spent() {
                break;
            }
            // An only child has the same part of the surface. Its bound is hardly better, so it is
            // replaced at once.
            [triangle, ..] = children.triangles;
            let Some(next) = self.model.tables().stored_split(triangle.split()) else { break };
            split = next;
            self.work.opened += 1;
        }
        self.queue.begin_children(children.count as u32);
        for child in children.triangles.iter().take(children.count) {
            let candidate = self.candidate(child)?;
            if !self.is_partless(candidate.radius) {
                self.batch.put(candidate);
            }
        }
        self.batch.flush(visitor, &mut self.queue);
        Some(())
    }

    fn open_group(&mut self, index: u32, visitor: &mut impl Visit) -> Option<()> {
        let first = index.checked_mul(BASE_GROUP)?;
        let end = self.model.tables().header().base_triangles.min(first.checked_add(BASE_GROUP)?);
        self.queue.begin_children(end.saturating_sub(first));
        for radius in first..end {
            let [a, b, c] = self.model.tables().base_triangle(radius)?;
            let ends = [self.end(a)?, self.end(b)?, self.end(c)?];
            let instance = self.model.tables().instance(Named::Base(radius));
            let candidate = self.candidate(&Triangle { instance, ends, radius })?;
            if !self.is_partless(candidate.radius) {
                self.batch.push(candidate, visitor, &mut self.queue);
            }
        }
        self.batch.flush(visitor, &mut self.queue);
        Some(())
    }

    /// Whether a radius says that its triangle stands for no part of the surface.
    #[inline(always)]
    fn is_partless(&self, radius: f32) -> bool {
        radius == f32::INFINITY && !self.model.tables().encloses()
    }

    #[inline(always)]
    fn end(&self, vertex: VertIdx) -> Option<End> {
        Some(End { vertex, split: self.model.tables().stored_split_of(vertex)? })
    }

    /// The triangles that a split makes out of a triangle.
    #[inline(always)]
    fn replace(&self, triangle: &Triangle, index: SplitIdx, children: &mut Children) -> Option<()> {
        let split = self.model.tables().split(index)?;
        // The corner that is split is the only one with this split.
        let [a, b, c] = triangle.ends;
        let (from, to) = if a.split == index.0 {
            (b, c)
        } else if b.split == index.0 {
            (c, a)
        } else {
            (a, b)
        };
        let edge = split.find(from.vertex)?;
        let ring_len = split.ring_len();
        let Instance(first) = self.model.tables().instance(Named::Fine(index, 0));
        let child = |slot: usize, ends: [End; 3]| Triangle {
            instance: Instance(first.wrapping_add(slot as u32)),
            ends,
            radius: split.first_triangle.wrapping_add(slot as u32),
        };
        let Children { triangles, count } = children;
        *count = 1;
        let apex = if edge < split.right { split.origin } else { split.destination() };
        triangles[0] = child(edge, [self.end(apex)?, from, to]);
        if edge != split.right_parent && edge != split.left_parent {
            return Some(());
        }
        let (origin, destination) = (self.end(split.origin)?, self.end(split.destination())?);
        if edge == split.right_parent {
            let wing = if edge == split.right { from } else { to };
            triangles[1] = child(ring_len, [origin, wing, destination]);
            *count = 2;
        }
        if edge == split.left_parent {
            let wing = if edge == 0 { from } else { to };
            triangles[*count % CHILDREN] = child(ring_len + 1, [origin, destination, wing]);
            *count += 1;
        }
        Some(())
    }

    #[inline(always)]
    fn candidate(&mut self, triangle: &Triangle) -> Option<Candidate> {
        let Triangle { instance, ends, radius } = *triangle;
        let refinable = self.refinable(self.model.tables().stored_split(triangle.split()));
        let counter = if refinable == Refinable::Surface {
            &mut self.work.triangles
        } else {
            &mut self.work.bounds
        };
        *counter += 1;
        let corners = each(ends, |end| end.vertex);
        let (corners, radius) =
            self.model.triangle(corners, radius, refinable == Refinable::Surface)?;
        Some(Candidate { corners, radius, instance, refinable })
    }
}
