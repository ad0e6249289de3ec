//! The stored precision: local frame, coordinate format, and rounding to it.
//!
//! A mesh is stored in a local frame that differs from the file's by a power of two, so the change
//! is exact. Coordinates are stored in the narrowest format that holds the mesh's own coordinates
//! exactly. Hull vertices are rounded to the same format.

use crate::mesh::Mesh;
use glam::DVec3;
use meshsweep_core::internal::format::layout::VertexFormat;
use meshsweep_core::internal::num::exp2;
use std::fmt;

/// Choice of the coordinate format.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum VertexBits {
    /// A hull stores its vertices exactly, in the narrowest format that can. A box tree's vertices
    /// move to a grid of 16 bits, unless the mesh is far from its origin.
    #[default]
    Auto,
    /// 16 bits a coordinate. Vertices that are not on the grid move to it, and the blob's surface
    /// error includes the distance.
    Grid16,
    /// 24 bits a coordinate; the same. A box tree has no such grid: its vertices are f32.
    Grid24,
    /// f32.
    F32,
}

impl VertexBits {
    /// Whether a box tree's vertices are f32 with this choice: a tree has no grid of 24 bits.
    pub(crate) const fn is_f32_in_tree(self) -> bool {
        matches!(self, Self::Grid24 | Self::F32)
    }
}

impl fmt::Display for VertexBits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Auto => "auto",
            Self::Grid16 => "16",
            Self::Grid24 => "24",
            Self::F32 => "32",
        })
    }
}

/// A mesh in the stored frame and precision.
#[derive(Clone, Debug)]
pub struct Stored {
    /// Input coordinate = local coordinate × 2^this.
    pub scale_exponent: i32,
    /// The coordinate format, and rounding to it.
    pub grid: Grid,
    /// Vertices in the local frame, exactly as stored.
    pub positions: Vec<DVec3>,
    /// Largest distance of a vertex between file and blob, local frame, rounded up.
    pub surface_error: f64,
}

/// Rounding of coordinates in the local frame to the stored format.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// The format.
    pub format: VertexFormat,
    /// Grid formats: the step is 2^this.
    pub exponent: i32,
    /// Grid formats: stored integer = coordinate / step − origin.
    pub origin: [i32; 3],
}

/// Part of a grid's range for the mesh itself. The rest is for hull vertices outside of it.
const FILL: f64 = 0.8;

/// Largest coordinate of a hull vertex, local units. The format's boxes end at 16.
const REACH: f64 = 8.0;

impl Grid {
    pub(crate) const F32: Grid = Grid { format: VertexFormat::F32, exponent: 0, origin: [0; 3] };

    /// Nearest stored coordinates; `None` outside the stored range.
    #[inline]
    pub fn round(&self, p: DVec3) -> Option<DVec3> {
        match self.format {
            VertexFormat::F32 => {
                let stored = p.as_vec3().as_dvec3();
                (stored.abs().max_element() <= REACH).then_some(stored)
            }
            VertexFormat::Grid16 | VertexFormat::Grid24 => {
                let step = exp2(self.exponent);
                let units = (p * exp2(-self.exponent)).round();
                let offset = units - DVec3::from(self.origin.map(f64::from));
                let inside =
                    offset.min_element() >= 0.0 && offset.max_element() <= self.max_units();
                inside.then(|| units * step)
            }
        }
    }

    /// Largest distance from a coordinate of magnitude `size` to the nearest stored one.
    pub fn half_step(&self, size: f64) -> f64 {
        match self.format {
            VertexFormat::F32 => size * f64::from(f32::EPSILON) / 2.0,
            _ => exp2(self.exponent) / 2.0,
        }
    }

    fn max_units(&self) -> f64 {
        match self.format {
            VertexFormat::Grid16 => 65_535.0,
            _ => 16_777_215.0,
        }
    }
}

/// Power of two that brings the largest coordinate of the mesh into [½, 1).
pub(crate) fn scale_exponent(mesh: &Mesh) -> i32 {
    let largest = mesh.positions.iter().flatten().fold(0f32, |m, x| m.max(x.abs()));
    let (_, exponent) = split_exponent(f64::from(largest));
    exponent
}

/// `x = m·2^e` with m in [½, 1), for normal f64.
pub(crate) fn split_exponent(x: f64) -> (f64, i32) {
    if x == 0.0 {
        return (0.0, 0);
    }
    let exponent = i32::try_from(x.to_bits() >> 52 & 0x7FF).unwrap_or(1022) - 1022;
    (x * exp2(-exponent), exponent)
}

/// Brings a mesh into the stored frame and precision.
///
/// With [`VertexBits::Auto`] nothing moves. With a grid, vertices that are not on it move to it,
/// and the distance is recorded. Then welding and repair would have to follow, so call [`snap`] on
/// the raw positions before them.
pub fn store(mesh: &Mesh, bits: VertexBits) -> Stored {
    let scale_exponent = scale_exponent(mesh);
    let local: Vec<DVec3> = mesh
        .positions
        .iter()
        .map(|&[x, y, z]| {
            DVec3::new(f64::from(x), f64::from(y), f64::from(z)) * exp2(-scale_exponent)
        })
        .collect();
    let lossless = |grid: &Grid| local.iter().all(|&p| grid.round(p) == Some(p));
    let grid = match bits {
        VertexBits::F32 => Grid::F32,
        VertexBits::Grid16 => fitting_grid(&local, VertexFormat::Grid16).unwrap_or(Grid::F32),
        VertexBits::Grid24 => fitting_grid(&local, VertexFormat::Grid24).unwrap_or(Grid::F32),
        VertexBits::Auto => [VertexFormat::Grid16, VertexFormat::Grid24]
            .into_iter()
            .filter_map(|format| fitting_grid(&local, format))
            .find(lossless)
            .unwrap_or(Grid::F32),
    };
    let mut moved = 0f64;
    let positions = local
        .iter()
        .map(|&p| {
            let stored = grid.round(p).unwrap_or(p);
            moved = moved.max((stored - p).length() * (1.0 + 1e-15));
            stored
        })
        .collect();
    let rounding = mesh.rounding * exp2(-scale_exponent);
    Stored { scale_exponent, grid, positions, surface_error: moved + rounding }
}

/// The finest power-of-two grid of a format on which the box of `local` takes at most [`FILL`] of
/// the range, if its coordinates can be summed in f32 exactly.
pub(crate) fn fitting_grid(local: &[DVec3], format: VertexFormat) -> Option<Grid> {
    let (low, high) = local
        .iter()
        .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(l, h), &p| (l.min(p), h.max(p)));
    let extent = (high - low).max_element();
    let probe = Grid { format, exponent: 0, origin: [0; 3] };
    let (_, exponent) = split_exponent(extent / (probe.max_units() * FILL));
    let step = exp2(exponent);
    let middle = (low + high) * 0.5;
    let origin = (middle / step - DVec3::splat((probe.max_units() / 2.0).floor())).floor();
    let end = origin + DVec3::splat(probe.max_units());
    let exact_sums =
        origin.abs().max(end.abs()).max_element() <= 16_777_216.0 && (-60..=0).contains(&exponent);
    let origin = [origin.x as i32, origin.y as i32, origin.z as i32];
    exact_sums.then_some(Grid { format, exponent, origin })
}

/// Moves raw positions to the grid that [`store`] would choose for them. Call it before welding and
/// repair. Returns the largest distance moved, rounded up, in the file's unit.
///
/// Does nothing for [`VertexBits::Auto`] and [`VertexBits::F32`].
pub fn snap(positions: &mut [[f64; 3]], bits: VertexBits) -> f64 {
    let format = match bits {
        VertexBits::Auto | VertexBits::F32 => return 0.0,
        VertexBits::Grid16 => VertexFormat::Grid16,
        VertexBits::Grid24 => VertexFormat::Grid24,
    };
    let largest = positions.iter().flatten().fold(0f64, |m, x| m.max(x.abs()));
    let (_, scale) = split_exponent(largest);
    let local: Vec<DVec3> = positions.iter().map(|&p| DVec3::from(p) * exp2(-scale)).collect();
    let Some(grid) = fitting_grid(&local, format) else { return 0.0 };
    let mut moved = 0f64;
    for (position, p) in positions.iter_mut().zip(local) {
        if let Some(stored) = grid.round(p) {
            moved = moved.max((stored - p).length() * exp2(scale) * (1.0 + 1e-15));
            *position = (stored * exp2(scale)).to_array();
        }
    }
    moved
}
