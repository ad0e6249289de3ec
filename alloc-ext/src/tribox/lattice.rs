//! The grid that a blob stores triboxes on.

use crate::mesh::Mesh;
use crate::surface::scale_exponent;
use meshsweep_core::internal::num::{Radius16, down_to_f32, exp2, up_to_f32};
use meshsweep_core::internal::tribox::{DIRECTIONS, SLABS};
use meshsweep_core::{Tribox, TriboxError};

/// Largest coordinate of the origin: what a reader accepts.
const MAX_ORIGIN: f64 = (1u32 << 18) as f64;

/// Finest grid: its units are numbers of f32, and so are their halves and quarters.
const FINEST: i32 = -147;

/// A tribox that holds all points within `distance` of this one.
pub(super) fn grown(tribox: &Tribox, distance: f64) -> Tribox {
    if tribox.is_empty() || distance <= 0.0 {
        return *tribox;
    }
    let by = |slab: usize| {
        let length = if slab < 3 { 1.0 } else { std::f64::consts::SQRT_2 };
        // Far more than the rounding of the product and the root.
        distance * length * (1.0 + 1e-9)
    };
    let low = |slab: usize| down_to_f32((f64::from(tribox.low[slab]) - by(slab)).next_down());
    let high = |slab: usize| up_to_f32((f64::from(tribox.high[slab]) + by(slab)).next_up());
    Tribox { low: std::array::from_fn(low), high: std::array::from_fn(high) }
}

/// A power-of-two grid of integers of 16 bits around an origin.
///
/// Parameters are rounded outward to even integers; tightened, they are integers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lattice {
    /// Input coordinate = local coordinate × 2^this.
    pub scale_exponent: i32,
    /// Local coordinate = coordinate in units × 2^this.
    pub grid_exponent: i32,
    /// Origin of the stored parameters, units.
    pub origin: [i32; 3],
    /// Distance by which planes move outward before they are rounded: the error of the input, input
    /// units.
    pub padding: f64,
    /// Factor of lengths in the triboxes' frame that bounds them in the mesh's: 1 unless the mesh
    /// was [turned](super::Turn).
    pub stretch: f64,
}

impl Lattice {
    /// The finest grid that holds a mesh whose vertices may be up to `padding` off, input units.
    ///
    /// # Errors
    /// If a coordinate is not finite or beyond [`Tribox::DOMAIN`]; a mesh without triangles is on
    /// any grid.
    pub fn of(mesh: &Mesh, padding: f64) -> Result<Lattice, TriboxError> {
        Self::in_frame(mesh, scale_exponent(mesh), padding)
    }

    /// [`of`](Self::of) a mesh in the local frame of this [scale](Self::scale_exponent), which
    /// another section of the blob may have.
    pub(super) fn in_frame(mesh: &Mesh, scale: i32, padding: f64) -> Result<Lattice, TriboxError> {
        let used = mesh.all_triangles().flatten().map(|v| mesh.positions[v as usize]);
        let whole = Tribox::of_points(used)?;
        let padding = Self::room(padding);
        let on = |grid_exponent: i32| {
            let unit = exp2(scale + grid_exponent);
            let centre = |axis: usize| {
                (f64::from(whole.low[axis]) + f64::from(whole.high[axis])) / 2.0 / unit
            };
            let origin =
                [0, 1, 2].map(|axis| if whole.is_empty() { 0.0 } else { centre(axis).round() });
            let lattice = Lattice {
                scale_exponent: scale,
                grid_exponent,
                // Beyond the integers it does not fit anyway.
                origin: origin.map(|x| x as i32),
                padding,
                stretch: 1.0,
            };
            let near = origin.iter().all(|x| x.abs() <= MAX_ORIGIN);
            (near && (whole.is_empty() || lattice.stored(&whole).is_some())).then_some(lattice)
        };
        // Local coordinates are below 1, so that 16 bits hold units of 2^-13 in any case.
        let finest = (-20).max(FINEST - scale);
        Ok((finest..40).find_map(on).expect("a grid of one unit holds everything"))
    }

    /// A padding with room for its rounding in f64.
    pub(super) fn room(padding: f64) -> f64 {
        padding * (1.0 + 1e-6)
    }

    /// Planes of splits lie at even multiples of this, input units.
    pub fn spacing(&self) -> f64 {
        2.0 * self.unit()
    }

    /// Input units of a unit.
    fn unit(&self) -> f64 {
        exp2(self.scale_exponent + self.grid_exponent)
    }

    /// A length beyond the mesh, local units of the mesh's frame: what it is to the input.
    pub(super) fn in_local_units(&self, length: f64) -> f64 {
        (length + self.padding) * self.stretch * exp2(-self.scale_exponent)
    }

    /// A node's hull error as it is stored.
    pub(super) fn stored_error(&self, error: f64) -> Radius16 {
        Radius16::round_up(self.in_local_units(error))
    }

    /// The same, input units.
    pub(super) fn claimed(&self, error: f64) -> f64 {
        f64::from(self.stored_error(error).get()) * exp2(self.scale_exponent)
    }

    /// Origin along the directions.
    fn offsets(&self) -> [i32; SLABS] {
        DIRECTIONS.map(|d| d.iter().zip(self.origin).map(|(&d, x)| i32::from(d) * x).sum())
    }

    /// The tightest tribox of integers that holds this one, if all parameters are moved outward to
    /// even ones first; in units.
    fn in_units(&self, tribox: &Tribox) -> Tribox {
        // Where nothing is padded the quotient is exact, up to f64's least number.
        let round = |x: f32, slab: usize, sign: f64| {
            let length = if slab < 3 { 1.0 } else { std::f64::consts::SQRT_2 };
            let doubt = if self.padding > 0.0 { f64::from(x).abs() * f64::EPSILON } else { 0.0 };
            let moved = sign * f64::from(x) + (self.padding * length + 2.0 * doubt);
            // Outward is up.
            (2.0 * sign * (moved / self.spacing()).ceil()) as f32
        };
        let units = Tribox {
            low: std::array::from_fn(|slab| round(tribox.low[slab], slab, -1.0)),
            high: std::array::from_fn(|slab| round(tribox.high[slab], slab, 1.0)),
        };
        units.tightened()
    }

    /// A tribox on the grid that holds this one, padded, input units. Monotone: a tribox inside of
    /// another has a result inside of the other's result.
    #[must_use]
    pub fn around(&self, tribox: &Tribox) -> Tribox {
        if tribox.is_empty() {
            return Tribox::EMPTY;
        }
        let units = self.in_units(tribox);
        let scaled = |x: f32| (f64::from(x) * self.unit()) as f32;
        Tribox { low: units.low.map(scaled), high: units.high.map(scaled) }
    }

    /// Parameters as stored: least and greatest value of each slab; `None` if 16 bits do not hold
    /// them.
    pub(super) fn stored(&self, tribox: &Tribox) -> Option<[[i16; 2]; SLABS]> {
        let units = self.in_units(tribox);
        let offsets = self.offsets();
        let mut stored = [[0i16; 2]; SLABS];
        for (slab, place) in stored.iter_mut().enumerate() {
            let short = |x: f32| i16::try_from(f64::from(x) as i64 - i64::from(offsets[slab])).ok();
            *place = [short(units.low[slab])?, short(units.high[slab])?];
        }
        Some(stored)
    }
}
