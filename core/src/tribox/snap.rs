//! Simplified triboxes (Crosnier & Rossignac 1999, section 3): planes are moved outward until small
//! faces vanish.

use super::bounds::Tribox;
use super::directions::{FACES, SLABS};

/// A plane: its slab, and whether it is where that is greatest.
type Plane = (usize, bool);

/// All planes.
fn planes() -> impl Iterator<Item = Plane> {
    (0..FACES).map(|face| (face / 2, face % 2 == 1))
}

impl Tribox {
    /// A tribox with fewer faces that holds this one. Planes are moved outward, none by more than
    /// `tolerance` (in the parameters' unit), those nearest to being idle first, and only if that
    /// leaves fewer faces. Vertices may move farther where planes meet at small angles.
    ///
    /// Negative and NaN tolerances move no plane. A tribox without volume may get some.
    /// [`Boundary::cleaned`](super::Boundary::cleaned) then shows fewer faces. Cost: some hundred
    /// to some thousand times that of [`tightened`](Tribox::tightened).
    #[must_use]
    pub fn snapped(&self, tolerance: f32) -> Tribox {
        let mut snapped = *self;
        if self.is_empty() {
            return snapped;
        }
        let mut faces = snapped.showing();
        // Bits of planes without which there are no fewer faces.
        let mut refused = 0u32;
        while let Some((plane, implied)) = snapped.nearest_idle(self, tolerance, refused) {
            let mut trial = snapped;
            trial.set(plane, implied);
            let fewer = trial.showing();
            if fewer < faces {
                (snapped, faces, refused) = (trial, fewer, 0);
            } else {
                refused |= 1 << (2 * plane.0 + usize::from(plane.1));
            }
        }
        snapped
    }

    /// The plane that is idle after the shortest motion from its place in `original`, and its new
    /// place, among those within the tolerance and not refused.
    fn nearest_idle(
        &self,
        original: &Tribox,
        tolerance: f32,
        refused: u32,
    ) -> Option<(Plane, f32)> {
        let mut nearest: Option<(f32, Plane, f32)> = None;
        for plane in planes()
            .filter(|(slab, is_high)| refused >> (2 * slab + usize::from(*is_high)) & 1 == 0)
        {
            let implied = self.implied(plane);
            let length = if plane.0 < 3 { 1.0 } else { core::f32::consts::SQRT_2 };
            let moved = (implied - original.parameter(plane)).abs() / length;
            let shows = implied != self.parameter(plane);
            if shows && moved <= tolerance && nearest.is_none_or(|(least, ..)| moved < least) {
                nearest = Some((moved, plane, implied));
            }
        }
        nearest.map(|(_, plane, implied)| (plane, implied))
    }

    /// Number of planes that are not idle.
    fn showing(&self) -> usize {
        planes().filter(|&plane| self.implied(plane) != self.parameter(plane)).count()
    }

    /// The farthest place at which a plane still touches, given the others. Its own place if that
    /// is farther outward.
    fn implied(&self, plane @ (_, is_high): Plane) -> f32 {
        let here = self.parameter(plane);
        let mut without = *self;
        without.set(plane, if is_high { f32::INFINITY } else { f32::NEG_INFINITY });
        let implied = without.tightened().parameter(plane);
        let outward = if is_high { implied > here } else { implied < here };
        if outward { implied } else { here }
    }

    fn parameter(&self, (slab, is_high): Plane) -> f32 {
        let of = if is_high { &self.high } else { &self.low };
        of.get(slab % SLABS).copied().unwrap_or(0.0)
    }

    fn set(&mut self, (slab, is_high): Plane, value: f32) {
        let of = if is_high { &mut self.high } else { &mut self.low };
        if let Some(slot) = of.get_mut(slab) {
            *slot = value;
        }
    }
}
