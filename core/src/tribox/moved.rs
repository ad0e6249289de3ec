//! Triboxes of moved points (Crosnier & Rossignac 1999, section 3: from a hull's vertices, or from
//! the vertices of the tribox).

use super::bounds::{Tribox, TriboxError, checked};
use super::directions::SLABS;
use crate::geom::Pose;
use crate::num::tolerance::{PRODUCT_UNDERFLOW, TRIBOX_COORDINATE, U32};
use crate::num::{greater, lesser, sum_down, sum_up};

impl Pose {
    pub(crate) fn check(&self) -> Result<(), TriboxError> {
        checked(self.translation)?;
        for row in self.rotation {
            if checked(row)?.iter().any(|entry| entry.abs() > 2.0) {
                return Err(TriboxError::OutOfDomain);
            }
        }
        Ok(())
    }

    /// The moved point, and the sum of the sizes of each coordinate's terms.
    #[inline(always)]
    pub(super) fn apply(&self, [x, y, z]: [f32; 3]) -> ([f32; 3], [f32; 3]) {
        let (mut place, mut size) = ([0f32; 3], [0f32; 3]);
        let rows = self.rotation.iter().zip(self.translation);
        for ((place, size), (&[a, b, c], t)) in place.iter_mut().zip(&mut size).zip(rows) {
            let (p, q, r) = (a * x, b * y, c * z);
            *place = (p + q) + (r + t);
            *size = (p.abs() + q.abs()) + (r.abs() + t.abs());
        }
        (place, size)
    }

    /// The tribox of all points after the motion. Tight except for rounding: each plane is moved
    /// outward once, as far as the worst point needs.
    ///
    /// # Errors
    /// If a number is not finite, a coordinate beyond [`Tribox::DOMAIN`] before or after the
    /// motion, or an entry of the matrix beyond 2.
    pub fn bound(&self, points: impl IntoIterator<Item = [f32; 3]>) -> Result<Tribox, TriboxError> {
        self.check()?;
        self.around(points, 0.0)
    }

    /// The tribox of points that are known up to `doubt` per coordinate.
    fn around(
        &self,
        points: impl IntoIterator<Item = [f32; 3]>,
        doubt: f32,
    ) -> Result<Tribox, TriboxError> {
        let mut around = Tribox::EMPTY;
        let mut sizes = [0f32; 3];
        for point in points {
            let (place, size) = self.apply(checked(point)?);
            let [x, y, z] = checked(place)?;
            for (most, size) in sizes.iter_mut().zip(size) {
                *most = greater(*most, size);
            }
            let along = [x, y, z, x + y, x - y, y + z, y - z, z + x, z - x];
            for ((low, high), along) in around.low.iter_mut().zip(&mut around.high).zip(along) {
                *low = lesser(*low, along);
                *high = greater(*high, along);
            }
        }
        if around.is_empty() {
            return Ok(around);
        }
        let mut margins = [0f32; 3];
        for ((margin, size), [a, b, c]) in margins.iter_mut().zip(sizes).zip(self.rotation) {
            let spread = (a.abs() + b.abs() + c.abs()) * doubt;
            *margin = size * (TRIBOX_COORDINATE * U32)
                + spread * (1.0 + TRIBOX_COORDINATE * U32)
                + PRODUCT_UNDERFLOW;
        }
        let ([x, y, z], [sx, sy, sz]) = (margins, sizes);
        // The sum of two coordinates is rounded once more.
        let sum = |a: f32, b: f32, size: f32| sum_up(sum_up(a, b), size * (2.0 * U32));
        let (xy, yz, zx) = (sum(x, y, sx + sy), sum(y, z, sy + sz), sum(z, x, sz + sx));
        let planes = around.low.iter_mut().zip(around.high.iter_mut());
        for ((low, high), by) in planes.zip([x, y, z, xy, xy, yz, yz, zx, zx]) {
            (*low, *high) = (sum_down(*low, -by), sum_up(*high, by));
        }
        Ok(around)
    }
}

impl Tribox {
    /// The tribox after a motion. It is the tribox of its moved vertices, and so larger than that
    /// of the moved object, the more so the rounder the object. For a tight one keep the vertices
    /// of the object's convex hull for [`Pose::bound`].
    ///
    /// # Errors
    /// As [`Pose::bound`].
    pub fn moved(&self, pose: &Pose) -> Result<Tribox, TriboxError> {
        pose.check()?;
        if self.is_empty() {
            return Ok(Tribox::EMPTY);
        }
        let largest = |most: f32, x: f32| if x.abs() > most { x.abs() } else { most };
        let size = (0..SLABS).fold(0f32, |most, slab| {
            let at = |of: &[f32; SLABS]| of.get(slab).copied().unwrap_or(0.0);
            largest(largest(most, at(&self.low)), at(&self.high))
        });
        // Error of the computed vertices: five roundings, and as many again if rounding decided the
        // corner's case.
        let doubt = (16.0 * U32) * size;
        pose.around(self.boundary().vertices, doubt)
    }
}
