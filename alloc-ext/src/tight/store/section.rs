//! The bytes of the section: writing, cutting, and reading a hull back.

use super::distances::Distances;
use crate::bvh::{self, TreeOptions};
use crate::emit::Sections;
use crate::error::BuildError;
use crate::mesh::{Input, Mesh};
use crate::progress::Watch;
use crate::surface::scale_exponent;
use glam::Vec3;
use meshsweep_core::SectionKind;
use meshsweep_core::TightRecord;
use meshsweep_core::internal::format::Header;
use meshsweep_core::internal::format::layout::SECTION_ALIGNMENT;
use meshsweep_core::internal::geom::Aabb;
use meshsweep_core::internal::num::{Radius16, down_to_f32, exp2, up_to_f32};
use meshsweep_core::internal::tight::format::layout::{TIGHT_BYTES, TIGHT_HULL_BYTES};
use meshsweep_core::{Blob, TightHull, TightHulls};
use std::collections::BTreeMap;

/// A hull and its record as bytes of the section.
pub(super) struct Stored {
    record: TightRecord,
    blob: Vec<u8>,
    slacks: Vec<u8>,
}

impl Stored {
    /// A hull, the distance that the vertices of its mesh were moved, its distances, its void or 0,
    /// and the options of its tree.
    pub(super) fn new(
        hull: &Mesh,
        moved: f64,
        distances: &Distances,
        void: f64,
        options: &TreeOptions,
    ) -> Result<Stored, BuildError> {
        let blob = hull_tree(hull, moved, options)?;
        let slacks =
            distances.slacks.iter().flat_map(|&slack| Radius16::round_up(slack).0.to_le_bytes());
        let record = TightRecord {
            faces: hull.triangles.len() as u32,
            slack: up_to_f32(distances.slack.upper),
            depth: up_to_f32(distances.depth.upper),
            // A mesh of very little volume may give a ratio beyond the range of f32.
            void_ratio: void.min(f64::from(f32::MAX)) as f32,
        };
        Ok(Stored { record, blob, slacks: slacks.collect() })
    }

    /// Bytes in the section, without padding.
    pub(super) fn bytes(&self) -> usize {
        TIGHT_HULL_BYTES + self.blob.len() + self.slacks.len()
    }
}

/// The blob of the hull's tree, in single precision if a grid of 16 bits moves a vertex.
fn hull_tree(hull: &Mesh, moved: f64, options: &TreeOptions) -> Result<Vec<u8>, BuildError> {
    let of = |is_f32: bool, moved: f64, rounding: f64| {
        let hull = Mesh { rounding, ..hull.clone() };
        let options = options.with_f32(is_f32);
        Ok::<Sections, BuildError>(
            bvh::build(Input { moved, ..hull.as_input() }, &options, Watch::NONE)?.0,
        )
    };
    let is_f32 = options.is_f32 || of(false, 0.0, 0.0)?.header.surface_error > 0.0;
    Ok(of(is_f32, moved, hull.rounding)?.to_bytes())
}

/// The section of a chain of hulls.
pub(super) fn sections(input: Input<'_>, hulls: &[Stored]) -> Sections {
    let mesh = input.mesh;
    let exponent = scale_exponent(mesh);
    let local = exp2(-exponent);
    let bound = |pick: fn(f32, f32) -> f32, from: f32, round: fn(f64) -> f32| {
        Vec3::from([0, 1, 2].map(|axis| {
            let all = mesh.positions.iter().map(|p| p[axis]);
            round(f64::from(all.fold(from, pick)) * local)
        }))
    };
    let bounds = Aabb {
        min: bound(f32::min, f32::INFINITY, down_to_f32),
        max: bound(f32::max, f32::NEG_INFINITY, up_to_f32),
    };
    let bodies = vec![(SectionKind::TightHulls, section(hulls))];
    let error = up_to_f32(input.error() * local);
    Sections::new(exponent, error, input.triangle_count(), bounds, bodies)
}

fn section(hulls: &[Stored]) -> Vec<u8> {
    let mut out = Vec::new();
    out.extend((hulls.len() as u32).to_le_bytes());
    // No flags.
    out.extend(0u32.to_le_bytes());
    let mut end = TIGHT_BYTES + hulls.len() * TIGHT_HULL_BYTES;
    for hull in hulls {
        let start = end.next_multiple_of(SECTION_ALIGNMENT);
        out.extend(hull.record.write(start as u32, hull.blob.len() as u32));
        end = start + hull.blob.len() + hull.slacks.len();
    }
    for hull in hulls {
        out.resize(out.len().next_multiple_of(SECTION_ALIGNMENT), 0);
        out.extend(&hull.blob);
        out.extend(&hull.slacks);
    }
    out
}

/// The tight hulls of a blob that have at most `faces` faces, and the coarsest in any case; `None`
/// if the blob has no tight hulls.
#[must_use]
pub fn cut(blob: &Blob<'_>, faces: u32) -> Option<Sections> {
    let hulls = blob.tight_hulls().ok()?;
    let count = hulls.records().take_while(|record| record.faces <= faces).count().max(1);
    let kept: Option<Vec<Stored>> = (0..count as u32).map(|index| stored(&hulls, index)).collect();
    let h = blob.header();
    let bodies = vec![(SectionKind::TightHulls, section(&kept?))];
    let Header { scale_exponent, surface_error, input_triangles, surface_box, .. } = *h;
    Some(Sections::new(
        scale_exponent,
        surface_error,
        input_triangles,
        Aabb::of(surface_box),
        bodies,
    ))
}

fn stored(hulls: &TightHulls<'_>, index: u32) -> Option<Stored> {
    let hull = hulls.get(index)?;
    let record = *hull.record();
    let slacks = (0..record.faces).map(|face| hull.slack(face)).collect::<Option<Vec<f32>>>()?;
    let slacks =
        slacks.into_iter().flat_map(|slack| Radius16::round_up(f64::from(slack)).0.to_le_bytes());
    Some(Stored { record, blob: hull.bytes().to_vec(), slacks: slacks.collect() })
}

/// A stored hull as a mesh in its unit, vertices exactly as stored; faces in their own order.
#[must_use]
pub fn hull_mesh(hull: &TightHull<'_>) -> Mesh {
    let tree = hull.bvh();
    // The unit is a power of two, so that the product is exact. The sum removes the sign of zeros,
    // by which no two corners differ.
    let unit = exp2(tree.header().grid_exponent + tree.scale_exponent());
    let in_input_units = |p: Vec3| p.to_array().map(|x| (f64::from(x) * unit) as f32 + 0.0);
    let mut faces: Vec<(u32, [[f32; 3]; 3])> = Vec::new();
    for node in 0..tree.header().nodes {
        let Some(links) = tree.links(node) else { continue };
        for child in links.inner..links.count {
            let Some(leaf) = tree.leaf(node, child) else { continue };
            for lane in 0..leaf.shape().triangles() {
                let number = tree.source(links.triangle(child).wrapping_add(lane as u32));
                let corners = leaf.corners(lane).map(in_input_units);
                faces.extend(number.map(|number| (number, corners)));
            }
        }
    }
    faces.sort_unstable_by_key(|(number, _)| *number);
    let mut number_of: BTreeMap<[u32; 3], u32> = BTreeMap::new();
    let mut positions = Vec::new();
    let triangles = faces.iter().map(|(_, corners)| {
        corners.map(|corner| {
            *number_of.entry(corner.map(f32::to_bits)).or_insert_with(|| {
                positions.push(corner);
                positions.len() as u32 - 1
            })
        })
    });
    let triangles = triangles.collect();
    Mesh::new(positions, triangles)
}
