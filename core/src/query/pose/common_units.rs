//! Two models in one frame: the pose of the second in the frame of the first.
//!
//! Lengths are in *common units*: the units of the model with the larger ones, so that no number
//! grows when it is converted. The frame is the first model's, with the first model's origin, so
//! that a mesh far from its own zero costs no precision. See `core/docs/rounding.md` §11.

use super::rotation::{check_rigid, is_rotation, skew_of};
use crate::geom::{Pose, dot, transposed};
use crate::num::tolerance::{
    OVERLAP_FARTHEST, OVERLAP_INTERVAL, OVERLAP_UNDERFLOW, OVERLAP_VERTEX, U32, U64,
};
use crate::num::{SOFT_FLOAT, exp2, greater};
use crate::query::error::QueryError;

/// Directions along which boxes are compared: the axes of both models' boxes.
pub(crate) const DIRECTIONS: usize = 6;

/// Largest ratio of the models' units, as a power of two. At 2^40 the smaller model is a point
/// to the larger one.
pub(crate) const UNITS_APART: i32 = 40;

/// A model in its own units.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extended {
    /// Input units of one unit: 2^this.
    pub(crate) exponent: i32,
    /// The place that its vertices are taken from.
    pub(crate) origin: [f64; 3],
    /// How far its vertices are from the origin, along each axis.
    pub(crate) extent: [f64; 3],
    /// How far a vertex of the input may be from the stored one.
    pub(crate) error: f64,
}

/// The place of a model along the directions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ModelFrame {
    /// A place `q` of this model, in its units from `origin`, is at `rows[d]·q + shift[d]`
    /// along direction d.
    pub(crate) rows: [[f32; 3]; DIRECTIONS],
    pub(crate) shift: [f32; DIRECTIONS],
    /// The model's origin.
    pub(crate) origin: [f32; 3],
    /// Intervals are made longer by this at both ends.
    pub(crate) grow: [f32; DIRECTIONS],
    /// Common units in one unit of the model.
    pub(crate) unit: f32,
}

/// How places of both models are carried to common units.
#[derive(Clone, Copy, Debug)]
pub(crate) struct VertexPose {
    /// Common units in one unit of each model.
    pub(crate) units: [f32; 2],
    /// A place `q` of the second model, from its origin, is at `matrix·q + shift`.
    pub(crate) matrix: [[f32; 3]; 3],
    pub(crate) shift: [f32; 3],
    pub(crate) shift_f64: [f64; 3],
    /// Greatest error of a vertex computed in f32. It includes the surface errors of both
    /// [`Extended`]; `StoredPair::new` sets these to 0, so that its errors are rounding alone.
    pub(crate) vertex_error: f32,
    /// The same in f64.
    pub(crate) vertex_error_f64: f64,
    /// The parts of `vertex_error` and of `vertex_error_f64` that rounding has.
    pub(crate) rounding: [f64; 2],
    /// Upper bound of the length in common units of a moved unit of the second model.
    pub(crate) longest: f64,
}

/// The pose of both models in common units.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RelativePose {
    pub(crate) frames: [ModelFrame; 2],
    pub(crate) vertices: VertexPose,
}

/// What [`RelativePose::relate`] finds: the pose of two models, at whatever distance.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CommonPose {
    pub(crate) vertices: VertexPose,
    /// The numbers are small enough for f32.
    pub(crate) is_in_range: bool,
    /// The sum of both surface errors and of the rounding of a vertex, common units.
    error: f64,
}

/// The greatest that `row·q` can be for `|q| ≤ extent`, axis by axis.
fn most([a, b, c]: [f64; 3], [x, y, z]: [f64; 3]) -> f64 {
    (a.abs() * x + b.abs() * y) + c.abs() * z
}

/// The same in f32, rounded.
fn most_f32([a, b, c]: [f32; 3], [x, y, z]: [f32; 3]) -> f32 {
    (a * x).abs() + (b * y).abs() + (c * z).abs()
}

impl RelativePose {
    /// The pose in common units. `None` if the models are so far from each other that no pair can
    /// meet.
    ///
    /// # Errors
    /// Those of [`check`](Self::check); [`QueryError::PoseOutOfDomain`] if a length is beyond 2^30
    /// common units.
    pub(crate) fn new(
        a: &Extended,
        b: &Extended,
        pose: &Pose,
    ) -> Result<Option<RelativePose>, QueryError> {
        let common = RelativePose::relate(a, b, pose)?;
        let (pose, is_apart) = RelativePose::along_axes(a, b, pose, &common);
        if is_apart {
            return Ok(None);
        }
        if common.is_in_range { Ok(Some(pose)) } else { Err(QueryError::PoseOutOfDomain) }
    }

    /// Refuses a pose that no question about two models takes. `[a, b]`: the exponents of their
    /// units.
    ///
    /// # Errors
    /// [`QueryError::NotFinite`]; [`QueryError::PoseOutOfDomain`] for an entry beyond 2, or units
    /// more than 2^40 apart; [`QueryError::NotRigid`].
    #[inline(always)]
    pub(crate) fn check(pose: &Pose, exponents: [i32; 2]) -> Result<(), QueryError> {
        let [a, b] = exponents;
        // No entry of a matrix that is nearly a rotation is beyond 2, infinite or NaN.
        let is_usual = !pose.is_affine
            && a - b <= UNITS_APART
            && b - a <= UNITS_APART
            && is_rotation(&pose.rotation, skew_of(&pose.rotation))
            && are_finite(pose.translation);
        if is_usual { Ok(()) } else { RelativePose::check_any(pose, exponents) }
    }

    /// The same, of any pose.
    #[inline(never)]
    fn check_any(pose: &Pose, [a, b]: [i32; 2]) -> Result<(), QueryError> {
        // As integers: a comparison of f32 is a call where there is no float unit.
        let size = |x: &f32| x.to_bits() & !(1 << 31);
        let largest = pose.rotation.iter().flatten().map(size).fold(0, greater);
        let farthest = pose.translation.iter().map(size).fold(largest, greater);
        if farthest >= f32::INFINITY.to_bits() {
            return Err(QueryError::NotFinite);
        }
        if largest > 2f32.to_bits() || a - b > UNITS_APART || b - a > UNITS_APART {
            return Err(QueryError::PoseOutOfDomain);
        }
        check_rigid(pose)
    }

    /// How places are carried, also of models that are far from each other. Errors: those of
    /// [`check`](Self::check).
    #[inline(never)]
    pub(crate) fn relate(
        a: &Extended,
        b: &Extended,
        pose: &Pose,
    ) -> Result<CommonPose, QueryError> {
        let (ea, eb) = (a.exponent, b.exponent);
        let common = greater(eb, ea);
        RelativePose::check(pose, [ea, eb])?;
        let units = [exp2(ea - common), exp2(eb - common)];
        let [unit_a, unit_b] = units;
        let rotation = pose.rotation.map(|row| row.map(f64::from));
        // Products of f32 are exact in f64; the sum of seven terms is rounded six times.
        let (from, into) = (b.origin, a.origin);
        let scale = exp2(common.wrapping_neg());
        let mut shift_f64 = pose.translation.map(|x| f64::from(x) * scale);
        for k in 0..3 {
            shift_f64[k] += dot(rotation[k], from) * unit_b - into[k] * unit_a;
        }
        let longest = unit_b * stretch(&rotation);
        let (error_a, error_b) = (a.error * unit_a, b.error * longest);
        // Along each axis, an upper bound of a moved vertex's coordinate, and of its difference
        // from a vertex of the first model.
        let (rows, origin_a, origin_b) = (pose.rotation, narrow(into), narrow(from));
        let sizes = |extent: [f64; 3], unit: f64| narrow(extent).map(|x| x * unit as f32);
        let (extent_a, extent_b) = (sizes(a.extent, unit_a), sizes(b.extent, unit_b));
        let mut near = 0.0;
        let mut origins = 0.0;
        for k in 0..3 {
            let extents = most_f32(rows[k], extent_b) + extent_a[k];
            near = greater(near, f64::from(extents) + shift_f64[k].abs());
            let both =
                most_f32(rows[k], origin_b) * unit_b as f32 + origin_a[k].abs() * unit_a as f32;
            origins = greater(origins, both);
        }
        let near = near * (1.0 + 16.0 * f64::from(U32));
        // The same before large terms cancel: the rounding is in proportion to these.
        let far = near + f64::from(origins * (1.0 + 16.0 * U32));
        let errors = error_a + error_b;
        let rounded = OVERLAP_VERTEX * U64 * far;
        let larger = greater(error_b, error_a);
        let rounded_f32 = OVERLAP_VERTEX * f64::from(U32) * near;
        let vertices = VertexPose {
            units: units.map(|x| x as f32),
            matrix: pose.rotation.map(|row| row.map(|x| x * unit_b as f32)),
            shift: narrow(shift_f64),
            shift_f64,
            vertex_error: (larger + rounded_f32) as f32 * (1.0 + 2.0 * U32),
            vertex_error_f64: larger + rounded,
            rounding: [rounded_f32, rounded],
            longest,
        };
        // NaN is out of range too.
        let is_in_range = far + errors <= OVERLAP_FARTHEST;
        Ok(CommonPose { vertices, is_in_range, error: errors + rounded })
    }

    /// The places along the axes of both models, and whether it is proved that nothing of one model
    /// meets the other.
    #[inline(never)]
    pub(crate) fn along_axes(
        a: &Extended,
        b: &Extended,
        pose: &Pose,
        common: &CommonPose,
    ) -> (RelativePose, bool) {
        let CommonPose { vertices, error, .. } = *common;
        let units = vertices.units.map(f64::from);
        let [unit_a, unit_b] = units;
        let (extent_a, extent_b) = (a.extent.map(|x| x * unit_a), b.extent.map(|x| x * unit_b));
        let columns = transposed(&pose.rotation.map(|row| row.map(f64::from)));
        let [c0, c1, c2] = columns;
        let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let directions = [x, y, z, c0, c1, c2];
        let back = directions.map(|d| columns.map(|column| dot(column, d)));
        let away = directions.map(|d| dot(d, vertices.shift_f64));
        let mut grow = [0f32; DIRECTIONS];
        let mut is_apart = false;
        for (((grow, d), row), away) in grow.iter_mut().zip(directions).zip(back).zip(away) {
            let both = most(d, extent_a) + most(row, extent_b);
            let error = error * libm::sqrt(dot(d, d)) + OVERLAP_UNDERFLOW;
            is_apart |= away.abs() * (1.0 - 64.0 * U64) > both + error;
            *grow = ((both + away.abs()) * (OVERLAP_INTERVAL * f64::from(U32)) + error) as f32
                * (1.0 + 2.0 * U32);
        }
        let [first, second] = vertices.units;
        let first = ModelFrame {
            rows: directions.map(|d| narrow(d.map(|x| x * unit_a))),
            shift: [0.0; DIRECTIONS],
            origin: narrow(a.origin),
            grow,
            unit: first,
        };
        let second = ModelFrame {
            rows: back.map(|row| narrow(row.map(|x| x * unit_b))),
            shift: away.map(|x| x as f32),
            origin: narrow(b.origin),
            grow: [0.0; DIRECTIONS],
            unit: second,
        };
        (RelativePose { frames: [first, second], vertices }, is_apart)
    }
}

fn narrow(v: [f64; 3]) -> [f32; 3] {
    v.map(|x| x as f32)
}

/// Upper bound of the factor by which a matrix makes lengths longer; 1 for a rotation.
///
/// The square of a 2-norm is the 2-norm of the product of the matrix and its transpose. That is at
/// most the product's largest row sum.
fn stretch(rows: &[[f64; 3]; 3]) -> f64 {
    let [a, b, c] = *rows;
    let (ab, bc, ca) = (dot(a, b).abs(), dot(b, c).abs(), dot(c, a).abs());
    let sums = [dot(a, a) + ab + ca, ab + dot(b, b) + bc, ca + bc + dot(c, c)];
    let most = sums.into_iter().fold(0.0, greater);
    libm::sqrt(most) * (1.0 + 16.0 * U64)
}

/// Whether no number is infinite or NaN.
#[inline(always)]
fn are_finite(numbers: [f32; 3]) -> bool {
    let [x, y, z] = numbers;
    if SOFT_FLOAT {
        let size = |x: f32| x.to_bits() << 1;
        greater(greater(size(x), size(y)), size(z)) < f32::INFINITY.to_bits() << 1
    } else {
        // Only of finite numbers this is 0.
        x * 0.0 + y * 0.0 + z * 0.0 == 0.0
    }
}
