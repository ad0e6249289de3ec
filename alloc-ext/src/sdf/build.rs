//! The build of a field: which one is kept.

use super::field::{Field, SdfReport, Work};
use super::options::SdfOptions;
use crate::bvh::FileSides;
use crate::clock::Instant;
use crate::emit::Sections;
use crate::error::BuildError;
use crate::geom::Bounds;
use crate::mesh::Input;
use crate::progress::{Stage, Watch};
use crate::surface::scale_exponent;
use glam::{DVec3, Vec3};
use meshsweep_core::internal::geom::Aabb;
use meshsweep_core::internal::num::{exp2, up_to_f32};
use meshsweep_core::internal::sdf::format::layout::{SDF_BYTES, tree};
use meshsweep_core::{SdfKind, SdfLayout, SectionKind};

/// Bytes of the smallest tree: the header and one leaf.
const LEAST_OF_TREE: u32 = (SDF_BYTES + tree::ENTRY_BYTES) as u32;

/// Builds the field of a mesh. Same mesh and options, same bytes, on any number of threads.
///
/// Cost: some seconds, for samples and proof. `watch` can end it.
///
/// # Errors
/// [`BuildError::Empty`]: no triangle. [`BuildError::NegativeMargin`].
/// [`BuildError::MarginTooLarge`]: mesh and margin leave the range of f32.
/// [`BuildError::FieldUnit`]: a unit is no normal f32, or f32 cannot place the lattice about the
/// mesh. [`BuildError::NoSides`]: a signed or solid field of a mesh that is not closed, or whose
/// walls were merged. [`BuildError::FieldTooSmall`]: a tree of fewer bytes than one leaf takes.
/// [`BuildError::FieldTooWide`]: an error does not fit 16 bits, in any layout that was asked for.
/// [`BuildError::FieldNotNarrow`], [`BuildError::FieldNeedsBytes`]: no field of at most these bytes
/// was found that is as narrow as asked for. [`BuildError::Cancelled`].
pub fn build(
    input: Input<'_>,
    options: &SdfOptions,
    watch: Watch<'_>,
) -> Result<(Sections, SdfReport), BuildError> {
    let watch = watch.during(Stage::Sdf);
    let started = Instant::now();
    let mesh = input.mesh;
    let corners = mesh.all_corners_f64().flatten();
    let bounds = corners.fold(Bounds::EMPTY, Bounds::with);
    if mesh.all_triangles().next().is_none() {
        return Err(BuildError::Empty);
    }
    let surface = bounds.grown(input.error_up());
    let sides = match options.kind {
        Some(SdfKind::Surface) => None,
        _ => FileSides::of(mesh)?,
    };
    let lacks_sides = sides.is_none() && options.kind != Some(SdfKind::Surface);
    let kind = match (options.kind, lacks_sides) {
        (Some(kind), true) => return Err(BuildError::NoSides { kind: kind.name() }),
        (Some(kind), false) => kind,
        (None, true) => SdfKind::Surface,
        (None, false) => SdfKind::Signed,
    };
    let of = Work { input, surface, options, kind, sides: sides.as_ref() };
    let (Field { body, report }, other) = match options.error {
        Some(error) => (of.fewest(error, watch)?, None),
        None => of.narrowest(watch)?,
    };
    let time = started.elapsed();
    let report = SdfReport { lacks_sides, other_width: other, time, ..report };
    let scale = scale_exponent(mesh);
    let local = exp2(-scale);
    let corner = |p: DVec3| -> Vec3 { (p * local).as_vec3() };
    let header = Sections::new(
        scale,
        up_to_f32(input.error_up() * local),
        input.triangle_count(),
        Aabb { min: corner(bounds.low), max: corner(bounds.high) },
        vec![(SectionKind::Sdf, body)],
    );
    Ok((header, report))
}

impl Work<'_> {
    /// The field of the smaller mean width, and the mean width of the other.
    fn narrowest(&self, watch: Watch<'_>) -> Result<(Field, Option<f64>), BuildError> {
        let is_wanted = |layout| self.options.layout.is_none_or(|wanted| wanted == layout);
        let lattice = match is_wanted(SdfLayout::Lattice) {
            true => match self.lattice(watch.part(0.0, 0.5)) {
                Err(BuildError::FieldTooWide { .. }) => None,
                found => Some(found?),
            },
            false => None,
        };
        if self.options.layout == Some(SdfLayout::Tree) && self.options.bytes < LEAST_OF_TREE {
            let bytes = self.options.bytes;
            return Err(BuildError::FieldTooSmall { bytes, least: LEAST_OF_TREE });
        }
        let tree = match is_wanted(SdfLayout::Tree) {
            // A unit of a tree is smaller: what f32 cannot place may fit a lattice.
            true => match self.tree(watch.part(0.5, 1.0)) {
                Err(BuildError::FieldUnit { .. }) if lattice.is_some() => None,
                found => found?,
            },
            false => None,
        };
        let width = |field: &Option<Field>| field.as_ref().map(|field| field.report.mean_width);
        let widths = [width(&lattice), width(&tree)];
        let is_narrower = widths[1].is_some_and(|tree| widths[0].is_none_or(|other| tree < other));
        let (field, other) = if is_narrower { (tree, widths[0]) } else { (lattice, widths[1]) };
        Ok((field.ok_or_else(|| self.too_wide())?, other))
    }
}
