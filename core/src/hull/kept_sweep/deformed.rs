//! Sweeps of a mesh that deforms: at key frames, or moved freely.

use super::Sweep;
use super::motion::Ball;
use crate::hull::frame_hull::FrameHull;
use crate::hull::geometry::{Geometry, frame};
use crate::hull::moved_hull::MovedHull;
use crate::query::{QueryError, ScratchEntry};

impl<'a> FrameHull<'a> {
    /// A sweep about `point` (input units) of the mesh at this frame, which may go on to other
    /// frames ([`Sweep::move_to_frame`]). All else as for [`Hull::sweep`](crate::Hull::sweep).
    ///
    /// ```
    /// use meshsweep_core::{Budget, DeformableHull, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/bend.msw"));
    /// let (part, mut scratch) = (DeformableHull::open(bytes)?, Scratch::<512>::new());
    /// let mut sweep = part.at_frame(0.0)?.sweep([0.0, 0.0, 9.0], &mut scratch)?;
    /// for frame in [0.0, 0.125, 0.25, 0.375] {
    ///     sweep.move_to_frame(frame)?;
    ///     assert!(sweep.closest_point(Budget::EXACT)?.distance.lower > 0.0);
    /// }
    /// let mut within = 0; // Triangles that are within 8.1.
    /// while let Some(found) = sweep.next_triangle(Budget::EXACT)? {
    ///     if found.distance.lower > 8.1 {
    ///         break;
    ///     }
    ///     within += 1;
    /// }
    /// assert!(within < part.rest().triangle_count());
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`QueryError::NotFinite`], [`QueryError::NoScratch`].
    pub fn sweep<'m>(
        &self,
        point: [f32; 3],
        scratch: &'m mut [ScratchEntry],
    ) -> Result<Sweep<'m, FrameHull<'a>>, QueryError> {
        Sweep::about(*self, point, scratch)
    }
}

impl Sweep<'_, FrameHull<'_>> {
    /// Moves the mesh to another frame, as [`at_frame`](crate::DeformableHull::at_frame). Bounds
    /// are charged the largest displacement of a vertex on the way. After a motion over more than
    /// two intervals between keys the next search begins anew.
    ///
    /// Cost: constant within the interval of the last motion, else one pass over the vertices for
    /// each interval.
    ///
    /// # Errors
    /// [`QueryError::NoFrame`], which changes nothing.
    pub fn move_to_frame(&mut self, frame: f32) -> Result<(), QueryError> {
        let (hull, motion) = self.front.model.followed(frame)?;
        self.front.model = hull;
        self.deformed(motion);
        Ok(())
    }
}

impl<'a, 'v> MovedHull<'a, 'v> {
    /// A sweep about `point` (input units) of the mesh as the last update left it. The sweep takes
    /// the hull, moves its vertices ([`Sweep::update_within`]), and gives it back
    /// ([`Sweep::into_hull`]). All else as for [`Hull::sweep`](crate::Hull::sweep).
    ///
    /// ```
    /// use meshsweep_core::{Budget, DeformableHull, MovedVertex, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/bend.msw"));
    /// let part = DeformableHull::open(bytes)?;
    /// let (mut memory, mut scratch) = ([MovedVertex::EMPTY; 512], Scratch::<512>::new());
    /// let mut sweep = part.moved(&mut memory)?.sweep([0.0, 0.0, 9.0], &mut scratch)?;
    /// for step in 0..4 {
    ///     let height = 0.25 * step as f32;
    ///     sweep.update_within(0.5, |_| [0.0, 0.0, height])?;
    ///     let near = sweep.closest_point(Budget::EXACT)?;
    ///     assert!(near.distance.lower <= 9.0 - height && near.distance.upper >= 9.0 - height);
    /// }
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`QueryError::NotFinite`], [`QueryError::NoScratch`]; [`QueryError::NoPose`] after an update
    /// that failed.
    pub fn sweep<'m>(
        self,
        point: [f32; 3],
        scratch: &'m mut [ScratchEntry],
    ) -> Result<Sweep<'m, MovedHull<'a, 'v>>, QueryError> {
        Sweep::about(self, point, scratch)
    }
}

impl Sweep<'_, MovedHull<'_, '_>> {
    /// Moves the vertices of the mesh by [`MovedHull::update_within`]. Bounds are charged the
    /// largest displacement of a vertex.
    ///
    /// # Errors
    /// Those of [`MovedHull::update_within`]. After
    /// [`VertexOutOfDomain`](QueryError::VertexOutOfDomain) questions answer
    /// [`QueryError::NoPose`] until the next update.
    pub fn update_within(
        &mut self,
        slack: f32,
        place: impl FnMut(u32) -> [f32; 3],
    ) -> Result<(), QueryError> {
        let motion = self.front.model.follow(slack, place)?;
        self.deformed(motion);
        Ok(())
    }
}

impl<'a, G: Geometry<'a>> Sweep<'_, G> {
    /// The mesh moved: no vertex by more than `motion`, local frame.
    fn deformed(&mut self, motion: f64) {
        self.frame = frame(&self.front.model);
        self.ball = Ball::around(&self.front.model.vertex_box());
        self.charge(motion);
    }
}
