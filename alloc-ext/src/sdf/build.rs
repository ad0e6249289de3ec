//! The build of a field: which one is kept.

use super::domain::Domain;
use super::field::{Draft, Field, SdfReport, Work};
use super::options::SdfOptions;
use super::tree::{self, Beside};
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
use meshsweep_core::internal::sdf::format::layout::{SDF_BYTES, tree as tree_layout};
use meshsweep_core::{SdfKind, SdfLayout, SectionKind};

/// Bytes of the smallest tree: the header and one leaf.
const LEAST_OF_TREE: u32 = (SDF_BYTES + tree_layout::ENTRY_BYTES) as u32;

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
    let Field { body, report } = match options.error {
        Some(error) => of.fewest(error, watch)?,
        None => of.narrowest(watch)?,
    };
    let time = started.elapsed();
    let report = SdfReport { lacks_sides, time, ..report };
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
    /// The field of the smaller mean width. Both layouts are drafted and one is proved: a proof
    /// takes half of the time, and widens few cells.
    fn narrowest(&self, watch: Watch<'_>) -> Result<Field, BuildError> {
        let is_wanted = |layout| self.options.layout.is_none_or(|wanted| wanted == layout);
        let bytes = self.options.bytes;
        if self.options.layout == Some(SdfLayout::Tree) && bytes < LEAST_OF_TREE {
            return Err(BuildError::FieldTooSmall { bytes, least: LEAST_OF_TREE });
        }
        // Of the time: lattice's draft, tree's draft, the proof of one.
        let [of_lattice, of_tree] = match self.options.layout {
            Some(SdfLayout::Lattice) => [0.4, 0.4],
            Some(SdfLayout::Tree) => [0.0, 1.0],
            _ => [0.2, 0.7],
        };
        let lattice = match is_wanted(SdfLayout::Lattice) {
            true => Some(self.draft(bytes as usize, watch.part(0.0, of_lattice))?),
            false => None,
        };
        let lattice = lattice.filter(Draft::has_room);
        let width = lattice.as_ref().map(|draft| draft.mean_width(self.kind));
        let (tree, width_of_tree) = match is_wanted(SdfLayout::Tree) {
            // A unit of a tree is smaller: what f32 cannot place may fit a lattice.
            true => match self.tree(width, watch.part(of_lattice, 1.0)) {
                Err(BuildError::FieldUnit { .. }) if lattice.is_some() => (None, None),
                found => found?,
            },
            false => (None, None),
        };
        let with_widths = |Field { body, report }: Field, kept: Option<f64>, other: Option<f64>| {
            let drafted_widths = kept.zip(other).map(|(kept, other)| [kept, other]);
            Field { body, report: SdfReport { drafted_widths, ..report } }
        };
        match (tree, lattice) {
            (Some(tree), _) => Ok(with_widths(tree, width_of_tree, width)),
            (None, None) => Err(self.too_wide()),
            (None, Some(lattice)) => match self.proved(lattice, watch.part(of_tree, 1.0)) {
                // The tree has wider intervals, and may have room for them.
                Err(BuildError::FieldTooWide { .. }) if width_of_tree.is_some() => {
                    let (tree, _) = self.tree(None, watch.part(1.0, 1.0))?;
                    tree.ok_or_else(|| self.too_wide())
                }
                found => Ok(with_widths(found?.0, width, width_of_tree)),
            },
        }
    }

    /// A tree, unless it has intervals of a mean width that is no less than another field's, before
    /// the proof of either; `None` if it does not fit the numbers of a tree. Also that width.
    fn tree(
        &self,
        other: Option<f64>,
        watch: Watch<'_>,
    ) -> Result<(Option<Field>, Option<f64>), BuildError> {
        let most_bytes = self.options.bytes as usize;
        let domain = Domain::of_tree(&self.surface, self.options.margin, most_bytes)?;
        let per_unit = f64::from(domain.per_unit);
        let other = other.map(|other| other * per_unit);
        let found = self.with_maker(&domain, watch, |maker, watch| {
            tree::build(maker, most_bytes, other, watch)
        })?;
        Ok(match found {
            Beside::Tree { tree, drafted } => {
                (Some(self.of_tree(&domain, tree)), Some(drafted / per_unit))
            }
            Beside::Wider(drafted) => (None, Some(drafted / per_unit)),
            Beside::NoRoom => (None, None),
        })
    }
}
