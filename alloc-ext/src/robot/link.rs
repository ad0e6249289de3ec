//! A link's collision shapes as one mesh, and its blob.

use super::package::Packages;
use super::{shape, urdf};
use crate::builder::{Builder, Built, For};
use crate::error::BuildError;
use crate::mesh::{RawMesh, Unit, joined};
use meshsweep_core::internal::num::up_to_f32;
use std::path::Path;

/// A link with collision geometry.
#[derive(Clone, Debug)]
pub struct Link {
    /// Its name.
    pub name: String,
    /// Its blob, in the link's frame.
    pub built: Built,
    /// Index of its joint.
    pub joint: u16,
    /// No point of its geometry is farther from the origin of its frame, in metres.
    pub radius: f32,
    /// Rounding of its pose that the distances of its pairs have room for, in metres.
    pub rounding: f32,
    /// Round shapes became polyhedra that reach out of them by at most this, in metres.
    pub beyond: f64,
}

/// Builds a link's blob. Every error is [`BuildError::Robot`] with a line.
pub(super) fn built(
    file: &Path,
    of: &urdf::Link,
    joint: u16,
    packages: &Packages<'_>,
) -> Result<Link, BuildError> {
    let (mut parts, mut beyond): (Vec<(RawMesh, _)>, f64) = (Vec::new(), 0.0);
    for collision in &of.collisions {
        let refused = |what: String| {
            urdf::refused(file, collision.line, format!("collision of link {:?}: {what}", of.name))
        };
        let (raw, inner, more) = shape::mesh(&collision.shape, packages).map_err(refused)?;
        parts.push((raw, collision.placement.after(&inner)));
        beyond = beyond.max(more);
    }
    let refused =
        |what: String| urdf::refused(file, of.line, format!("link {:?}: {what}", of.name));
    let raw =
        joined(Path::new(&of.name), Unit::M, &parts).map_err(|error| refused(error.to_string()))?;
    let built = Builder::new().serve(For::Segment).unit(Unit::M).build(raw);
    let built = built.map_err(|error| refused(error.to_string()))?;
    let (mut radius, mut error) = (0f64, 0f64);
    if let Some(loaded) = &built.loaded {
        let length_sq = |p: &[f32; 3]| p.iter().map(|&x| f64::from(x).powi(2)).sum::<f64>();
        radius = loaded.mesh.positions.iter().map(length_sq).fold(0.0, f64::max).sqrt();
        error = loaded.error();
    }
    let radius = up_to_f32((radius + error) * (1.0 + 1e-12)).next_up();
    Ok(Link { name: of.name.clone(), built, joint, radius, rounding: 0.0, beyond })
}
