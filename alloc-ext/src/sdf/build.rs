//! The build of a field: which one is kept.

use super::domain::Domain;
use super::field::{Field, SdfReport, Work};
use super::options::SdfOptions;
use super::tree;
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

/// A field before its proof.
struct Candidate<'a> {
    /// The mean width of its intervals, in the mesh's unit. No proof makes it smaller.
    width: f64,
    prove: Prove<'a>,
}

/// Proves a field; `None` if the errors do not fit their numbers.
type Prove<'a> = Box<dyn FnOnce(Watch<'_>) -> Result<Option<Field>, BuildError> + 'a>;

/// The second draft is proved only if the proved field is wider, in the mean, than this times the
/// draft.
const ENOUGH: f64 = 1.05;

impl Work<'_> {
    /// The field of the smaller mean width, or of one that is nearly as small.
    fn narrowest(&self, watch: Watch<'_>) -> Result<Field, BuildError> {
        let is_wanted = |layout| self.options.layout.is_none_or(|wanted| wanted == layout);
        let bytes = self.options.bytes;
        if self.options.layout == Some(SdfLayout::Tree) && bytes < LEAST_OF_TREE {
            return Err(BuildError::FieldTooSmall { bytes, least: LEAST_OF_TREE });
        }
        // Of the time: the lattice's draft.
        let drafted = match self.options.layout {
            Some(SdfLayout::Lattice) => 0.4,
            Some(SdfLayout::Tree) => 0.0,
            _ => 0.2,
        };
        let mut lattice = match is_wanted(SdfLayout::Lattice) {
            true => self.candidate(watch.part(0.0, drafted))?,
            false => None,
        };
        let watch = watch.part(drafted, 1.0);
        if !is_wanted(SdfLayout::Tree) {
            return self.narrower(lattice, None, watch);
        }
        let mut with_tree = || {
            let most_bytes = bytes as usize;
            let domain = Domain::of_tree(&self.surface, self.options.margin, most_bytes)?;
            self.with_maker(&domain, watch, |maker, watch| {
                let made = tree::leaves(maker, most_bytes, watch.part(0.0, 0.65))?;
                let watch = watch.part(0.65, 1.0);
                let Some((laid, made)) = made else {
                    return self.narrower(lattice.take(), None, watch);
                };
                let draft = maker.draft(laid, made.iter().collect()).ok();
                let tree = draft.map(|draft| Candidate {
                    width: maker.mean_width(&draft) / f64::from(domain.per_unit),
                    prove: Box::new(|watch| {
                        let tree = maker.proved(draft, watch)?.ok();
                        Ok(tree.map(|tree| self.of_tree(&domain, tree)))
                    }),
                });
                self.narrower(lattice.take(), tree, watch)
            })
        };
        match with_tree() {
            // A unit of a tree is smaller: what f32 cannot place may fit a lattice.
            Err(BuildError::FieldUnit { .. }) if lattice.is_some() => {
                self.narrower(lattice, None, watch)
            }
            found => found,
        }
    }

    /// A lattice before its proof; `None` if its errors do not fit their numbers.
    fn candidate(&self, watch: Watch<'_>) -> Result<Option<Candidate<'_>>, BuildError> {
        let draft = self.draft(self.options.bytes as usize, watch)?;
        Ok(draft.has_room().then(|| Candidate {
            width: draft.mean_width(self.kind),
            prove: Box::new(|watch| match self.proved(draft, watch) {
                Err(BuildError::FieldTooWide { .. }) => Ok(None),
                found => Ok(Some(found?.0)),
            }),
        }))
    }

    /// Proves the narrower of two; the other too, if that may be narrower by more than a little.
    fn narrower(
        &self,
        lattice: Option<Candidate<'_>>,
        tree: Option<Candidate<'_>>,
        watch: Watch<'_>,
    ) -> Result<Field, BuildError> {
        let mut all: Vec<Candidate<'_>> = [lattice, tree].into_iter().flatten().collect();
        all.sort_by(|a, b| a.width.total_cmp(&b.width));
        let widths: Vec<f64> = all.iter().map(|candidate| candidate.width).collect();
        let mut best: Option<Field> = None;
        for (number, Candidate { width, prove }) in all.into_iter().enumerate() {
            let wide = best.as_ref().map_or(f64::INFINITY, |field| field.report.mean_width);
            if wide <= ENOUGH * width {
                break;
            }
            let part = |number: usize| number as f64 / widths.len() as f64;
            let found = prove(watch.part(part(number), part(number + 1)))?;
            if let Some(Field { body, report }) = found.filter(|of| of.report.mean_width < wide) {
                let other = widths.get(1 - number).copied();
                let drafted_widths = other.map(|other| [width, other]);
                best = Some(Field { body, report: SdfReport { drafted_widths, ..report } });
            }
        }
        best.ok_or_else(|| self.too_wide())
    }
}
