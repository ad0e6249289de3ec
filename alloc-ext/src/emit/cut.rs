//! A coarser blob out of a finer one: every section runs coarse to fine, so a cut keeps a prefix of
//! each.

use super::bytes::{Parts, assemble};
use super::tables::Tables;
use crate::tree::TreeTables;
use crate::{tight, tribox};
use meshsweep_core::{Blob, Hull, SectionKind};

/// Why a blob was not cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CutError {
    /// There is no such level.
    NoLevel {
        /// Asked for.
        wanted: u32,
        /// Levels there are.
        levels: u32,
    },
    /// The blob has no triboxes.
    NoTriboxes,
    /// The blob has no tight hulls.
    NoTightHulls,
    /// The model is not one that was opened.
    Model,
}

impl std::fmt::Display for CutError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            CutError::NoLevel { levels: 0, .. } => {
                write!(f, "the blob has no hull hierarchy to cut: build it with --for hull")
            }
            CutError::NoLevel { wanted, levels } => {
                write!(f, "level {wanted} does not exist: the blob has levels 0 to {}", levels - 1)
            }
            CutError::NoTriboxes => {
                write!(f, "the blob has no triboxes to cut: build it with --for triboxes")
            }
            CutError::NoTightHulls => {
                write!(f, "the blob has no tight hulls to cut: build it with --for tight")
            }
            CutError::Model => write!(f, "the blob was not opened"),
        }
    }
}

impl std::error::Error for CutError {}

/// What to keep of a blob; what nothing is said of stays as it is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Keep {
    /// The finest level of the hull hierarchy. A box tree cannot be cut: it is left out.
    pub level: Option<u32>,
    /// Of the triboxes the finest level of at most so many.
    pub triboxes: Option<u32>,
    /// The tight hulls of at most so many faces, at least the coarsest.
    pub tight: Option<u32>,
}

/// What is left of a blob.
///
/// # Errors
/// [`CutError`] if there is nothing of the kind to cut.
pub fn cut_blob(blob: &Blob<'_>, keep: &Keep) -> Result<Vec<u8>, CutError> {
    let hull = match (keep.level, blob.hull()) {
        (Some(level), Ok(hull)) => Some(cut(&hull, level)?),
        (Some(wanted), Err(_)) => return Err(CutError::NoLevel { wanted, levels: 0 }),
        (None, Ok(hull)) => Some(Tables::from_model(&hull).ok_or(CutError::Model)?),
        (None, Err(_)) => None,
    };
    let tree = if keep.level.is_none() { tree(blob) } else { None };
    if keep.triboxes.is_some() && blob.triboxes().is_err() {
        return Err(CutError::NoTriboxes);
    }
    if keep.tight.is_some() && blob.tight_hulls().is_err() {
        return Err(CutError::NoTightHulls);
    }
    let triboxes = tribox::cut(blob, keep.triboxes.unwrap_or(u32::MAX));
    let tight = tight::cut(blob, keep.tight.unwrap_or(u32::MAX));
    Ok(assemble(&Parts {
        hull: hull.as_ref(),
        tree: tree.as_ref(),
        triboxes: triboxes.as_ref(),
        tight: tight.as_ref(),
    }))
}

/// The box tree as it stands in a blob.
fn tree(blob: &Blob<'_>) -> Option<TreeTables> {
    let tree = blob.bvh().ok()?;
    let sections = blob.sections().filter(|section| section.kind.is_bvh()).filter_map(|section| {
        let bytes = blob.bytes().get(section.offset as usize..)?.get(..section.bytes as usize)?;
        Some((section.kind, bytes.to_vec()))
    });
    let sections: Vec<(SectionKind, Vec<u8>)> = sections.collect();
    let (scale_exponent, input_triangles) = (tree.scale_exponent(), tree.input_triangles());
    Some(TreeTables { scale_exponent, input_triangles, header: *tree.header(), sections })
}

/// Tables of the model's hull hierarchy after level `index`, a valid and still certified coarser
/// model; the last level returns all of it.
///
/// # Errors
/// [`CutError::NoLevel`].
pub fn cut(model: &Hull<'_>, index: u32) -> Result<Tables, CutError> {
    let level = model
        .level(index)
        .ok_or(CutError::NoLevel { wanted: index, levels: model.header().levels })?;
    let mut tables = Tables::from_model(model).ok_or(CutError::Model)?;
    if index + 1 == model.header().levels {
        return Ok(tables);
    }
    let splits = level.splits as usize;
    let rings = tables.splits.get(splits).map_or(tables.rings.len(), |s| s.ring_start as usize);
    tables.vertices.truncate(tables.base_vertices as usize + 2 * splits);
    tables.splits_with.truncate(tables.vertices.len());
    for split in &mut tables.splits_with {
        *split = split.filter(|&s| (s as usize) < splits);
    }
    tables.splits.truncate(splits);
    tables.rings.truncate(rings);
    tables.radii.truncate(tables.base.len() + rings + 2 * splits);
    tables.nodes.truncate(level.nodes as usize);
    for node in &mut tables.nodes {
        if node.leaf || node.first + u32::from(node.count) > level.nodes {
            (node.first, node.count, node.leaf) = (0, 0, true);
        }
    }
    tables.surface.clear();
    tables.source.clear();
    tables.levels.truncate(index as usize + 1);
    tables.queue_capacity = tables.queue_capacity.min(level.nodes);
    tables.is_cut = true;
    Ok(tables)
}
