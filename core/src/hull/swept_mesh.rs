//! The mesh that a sweep ends with (Guéziec 2000, 4.3 and Figure 6).
//!
//! A sweep replaces triangles by their children and builds no mesh. Here the splits that remove the
//! same triangles are performed, each after the splits that it requires. A split also brings faces
//! that no sweep asked for. Where these are within the distance, they are refined too. So the
//! performed splits are the least set with two properties, whatever the order:
//! - The split that removes a face within the distance is in it.
//! - The splits that a split requires are in it.

use super::format::{Instance, VertIdx};
use super::front::{Candidate, Refinable};
use super::geometry::{Geometry, frame};
use super::nearest::Nearest;
use super::refined_hull::{ErasedHull, Refined, RefinedHull, erased};
use crate::num::up_to_f32;
use crate::query::QueryError;

/// The mesh that [`RefinedHull::sweep_to`] made.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SweptMesh {
    /// Faces of the refined hull.
    pub faces: u32,
    /// Splits that were performed.
    pub splits: u32,
    /// The largest radius of the faces within the distance that were not refined, because the
    /// memory was full. Input units, rounded up. 0 if all were refined.
    pub error_left: f32,
}

impl<'t, const SPLITS: usize> RefinedHull<'t, SPLITS> {
    /// Makes the mesh that a sweep about `point` (input units) ends with at `distance` (input
    /// units): fine near the closest point, and as coarse elsewhere as the tables allow.
    ///
    /// `hull`: at rest ([`Hull`](crate::Hull)), at a key frame ([`FrameHull`](crate::FrameHull)) or
    /// moved ([`MovedHull`](crate::MovedHull)). Of the mesh that a kept sweep asks it is
    /// [`Sweep::hull`](crate::Sweep::hull). `distance`: the upper end of the answer, or the lower
    /// end of one that ended early.
    ///
    /// If [`SweptMesh::error_left`] is 0, each face is a triangle of the surface, or farther than
    /// `distance` even when it is swept by its radius. So every triangle of the stored surface
    /// within `distance` is a face. With an upper end the triangle of the closest point is one too.
    ///
    /// In any case the faces are a closed mesh which [encloses](crate::Hull::encloses) the surface
    /// at rest. Of an open surface they are open where it is. Moved faces need not enclose the
    /// surface. On a cut blob faces of the last level stay. The splits that were performed before
    /// are undone.
    ///
    /// Cost: `SPLITS`, and a bound for each face of the base hull and of each performed split.
    /// Source: Guéziec 2000, 4.3 and Figure 6.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Hull, HullFace, RefinedHull, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/bracket.msw"));
    /// let (part, mut scratch) = (Hull::open(bytes)?, Scratch::<512>::new());
    /// let (probe, mut refined) = ([90.0, 0.0, 40.0], RefinedHull::<400>::new());
    /// let near = part.sweep(probe, &mut scratch)?.closest_point(Budget::EXACT)?;
    /// let mesh = refined.sweep_to(&part, probe, near.distance.upper)?;
    /// assert!(mesh.error_left == 0.0 && mesh.faces < part.triangle_count());
    /// let mut faces = [HullFace::EMPTY; 1024];
    /// assert_eq!(refined.faces_into(&part, &mut faces), (mesh.faces as usize, 0));
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`QueryError::NotFinite`], [`QueryError::OutOfDomain`]; [`QueryError::Tolerance`] of a
    /// distance that is negative or not finite; [`QueryError::NoPose`] after an update that failed.
    /// The hull stays as it was.
    pub fn sweep_to(
        &mut self,
        hull: &impl Geometry<'t>,
        point: [f32; 3],
        distance: f32,
    ) -> Result<SweptMesh, QueryError> {
        sweep_to(erased(&mut self.state), hull, point, distance)
    }
}

impl<'t> ErasedHull<'t> {
    /// As [`RefinedHull::sweep_to`].
    ///
    /// # Errors
    /// Those of [`RefinedHull::sweep_to`].
    pub fn sweep_to(
        &mut self,
        hull: &impl Geometry<'t>,
        point: [f32; 3],
        distance: f32,
    ) -> Result<SweptMesh, QueryError> {
        sweep_to(&mut self.state, hull, point, distance)
    }
}

fn sweep_to<'t, G: Geometry<'t>>(
    state: &mut Refined,
    hull: &G,
    point: [f32; 3],
    distance: f32,
) -> Result<SweptMesh, QueryError> {
    let tables = *hull.tables();
    if !tables.has_hull() {
        return Err(QueryError::NO_HULL);
    }
    hull.check()?;
    if !(distance >= 0.0 && distance.is_finite()) {
        return Err(QueryError::Tolerance);
    }
    let frame = frame(hull);
    let mut nearest = Nearest::new(hull, frame.local_end(point)?).ok_or(QueryError::Unchecked)?;
    nearest.set_limit(frame.length(distance));
    state.begin(&tables);
    state.reset();
    let mut refining = Refining { state, hull, nearest, left: 0.0 };
    refining.run().ok_or(QueryError::Unchecked)?;
    let Refining { state, left, .. } = refining;
    Ok(SweptMesh {
        faces: state.face_count(&tables),
        splits: state.splits.len() as u32,
        error_left: up_to_f32(f64::from(left) * tables.scale()),
    })
}

/// A refined hull on its way to the mesh.
struct Refining<'s, 'h, G> {
    state: &'s mut Refined,
    hull: &'h G,
    /// The point, with the distance as its limit.
    nearest: Nearest,
    /// The largest radius of the faces for whose splits the memory is too short, local frame.
    left: f32,
}

impl<'t, G: Geometry<'t>> Refining<'_, '_, G> {
    /// Looks at each face of the base hull and of each split, those that are performed meanwhile
    /// among them.
    fn run(&mut self) -> Option<()> {
        let tables = *self.hull.tables();
        for number in 0..tables.header().base_triangles {
            self.meet(tables.base_triangle(number)?, number)?;
        }
        let mut position = 0;
        while let Some(split) = self.state.splits.get(position) {
            let split = tables.split(split)?;
            let mut number = split.first_triangle;
            for slot in 0..split.fine_len() {
                self.meet(split.fine(slot)?, number)?;
                number = number.checked_add(1)?;
            }
            position += 1;
        }
        Some(())
    }

    /// Refines a face that may be within the distance. `number` is that of
    /// [`Hull::radius`](crate::Hull::radius).
    fn meet(&mut self, corners: [VertIdx; 3], number: u32) -> Option<()> {
        let tables = self.hull.tables();
        let Some(split) = tables.removed_by(corners) else { return Some(()) };
        if !tables.has_part(number) || self.state.splits.contains(split) {
            return Some(());
        }
        let (corners, radius) = self.hull.triangle(corners, number, false)?;
        let (instance, refinable) = (Instance(0), Refinable::BySplit);
        let face = Candidate { corners, radius, instance, refinable };
        let [bound, ..] = self.nearest.bounds(core::slice::from_ref(&face));
        if bound <= self.nearest.limit_f32 && !self.state.perform_with_required(tables, split)? {
            // A radius may be 0, and something is left all the same.
            self.left = self.left.max(radius).max(f32::MIN_POSITIVE);
        }
        Some(())
    }
}
