//! One of two models: a hull hierarchy, or a triangle, which is a model of one triangle.

use crate::geom::Aabb;
use crate::hull::format::{Hull, Instance};
use crate::hull::front::{Candidate, Front, Refinable, Visit, triangles};
use crate::hull::geometry::Geometry;
use crate::num::greater;
use crate::query::{Extended, Frame, QueryError};
use glam::{DVec3, Vec3};

/// Number of a model as a whole. No triangle of a hierarchy that may wait has this number.
const ROOT: Instance = Instance(u32::MAX);

#[derive(Debug)]
pub(super) struct Model<G> {
    /// The hierarchy; none of a triangle.
    front: Option<Front<'static, G>>,
    /// The ball that contains the model, or the triangle.
    pub(super) root: Candidate,
    pub(super) extended: Extended,
}

impl<'a, G: Geometry<'a>> Model<G> {
    pub(super) fn of_hull(hull: &G) -> Result<Model<G>, QueryError>
    where
        G: Copy,
    {
        if !hull.tables().has_hull() {
            return Err(QueryError::NO_HULL);
        }
        let bounds = hull.vertex_box();
        let centre = (bounds.min + bounds.max) * 0.5;
        // The corner that is farthest from the rounded centre.
        let far = (bounds.max - centre).max(centre - bounds.min);
        let radius = libm::sqrtf(far.dot(far)) * (1.0 + 4.0 * f32::EPSILON);
        Ok(Model {
            front: Some(Front::new(hull, &mut [], 0)),
            root: Candidate {
                corners: [centre; 3],
                radius,
                instance: ROOT,
                refinable: Refinable::BySplit,
            },
            extended: extended(
                hull.tables().header().scale_exponent,
                &bounds,
                centre,
                hull.surface_error(),
            ),
        })
    }

    /// A triangle in input units. Its own unit is not smaller than the hull's, so small triangles
    /// need no second path.
    pub(super) fn of_triangle(
        corners: [[f32; 3]; 3],
        hull: &Hull<'_>,
    ) -> Result<Model<G>, QueryError> {
        let header = hull.header();
        let frame = Frame::of(header);
        let mut largest = 0f32;
        for corner in corners {
            frame.local_end(corner)?;
            largest = corner.iter().fold(largest, |most, x| greater(most, x.abs()));
        }
        // The power of two above the largest coordinate.
        let above = (largest.to_bits() >> 23).cast_signed() - 126;
        let exponent = greater(above, header.scale_exponent);
        let local = |x: f32| f64::from(x) * crate::num::exp2(exponent.wrapping_neg());
        let stored = corners.map(|corner| Vec3::from_array(corner.map(|x| local(x) as f32)));
        let is_exact = stored
            .iter()
            .zip(&corners)
            .all(|(stored, corner)| stored.as_dvec3() == DVec3::from_array(corner.map(local)));
        let [a, b, c] = stored;
        let bounds = Aabb { min: a.min(b).min(c), max: a.max(b).max(c) };
        // Only an underflow is not exact.
        let error = if is_exact { 0.0 } else { f64::from(f32::MIN_POSITIVE) };
        Ok(Model {
            front: None,
            root: Candidate {
                corners: stored,
                radius: 0.0,
                instance: ROOT,
                refinable: Refinable::Surface,
            },
            extended: extended(exponent, &bounds, (bounds.min + bounds.max) * 0.5, error),
        })
    }

    /// The triangle, the group or the whole of a number.
    #[inline]
    pub(super) fn look(&self, instance: Instance) -> Option<Candidate> {
        if instance == ROOT { Some(self.root) } else { self.front.as_ref()?.look(instance) }
    }

    /// Shows the next finer triangles, after at most `steps` replacements, and returns how many
    /// were made. `None`: the model is unchecked.
    #[inline]
    pub(super) fn open(
        &mut self,
        instance: Instance,
        steps: u32,
        visitor: &mut impl Visit,
    ) -> Option<u32> {
        let front = self.front.as_mut()?;
        front.allow(steps);
        if instance == ROOT {
            front.begin(visitor)?;
            return Some(1);
        }
        front.open(instance, visitor)?;
        Some(front.work.opened)
    }

    /// Triangles of all levels.
    pub(super) fn triangles(&self) -> u32 {
        self.front.as_ref().map_or(1, |front| triangles(front.model.tables()))
    }

    pub(super) fn is_cut(&self) -> bool {
        self.front.as_ref().is_some_and(|front| front.model.tables().is_cut())
    }
}

/// With this many entries for this side no search ends for lack of memory.
///
/// The hierarchy's own number counts the siblings that wait while one is opened, but for those
/// that are not opened. Of these only the last opened triangle's wait: up to 16 of a group, 3
/// of a split.
pub(super) fn entries(hull: &Hull<'_>) -> usize {
    hull.scratch_entries().saturating_add(20)
}

fn extended(exponent: i32, bounds: &Aabb, origin: Vec3, error: f64) -> Extended {
    let origin = origin.as_dvec3();
    let far = (bounds.max.as_dvec3() - origin).abs().max((origin - bounds.min.as_dvec3()).abs());
    Extended { exponent, origin: origin.to_array(), extent: far.to_array(), error }
}
