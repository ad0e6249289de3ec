//! A coarser hull hierarchy out of a finer one: every section runs coarse to fine, so a cut keeps a
//! prefix of each.

use super::tables::Tables;
use meshsweep_core::Hull;

/// Tables of a hull hierarchy after level `index`: a valid, certified, coarser hierarchy. The last
/// level gives all of it. `None` if there is no such level.
#[must_use]
pub fn cut(whole: &Hull<'_>, index: u32) -> Option<Tables> {
    let level = whole.level(index)?;
    let mut tables = Tables::from_hull(whole)?;
    if index + 1 == whole.header().levels {
        return Some(tables);
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
    tables.source_starts.clear();
    tables.source.clear();
    tables.levels.truncate(index as usize + 1);
    // No queue holds a triangle twice.
    tables.queue_capacity = tables.queue_capacity.min(tables.radii.len() as u32);
    tables.is_cut = true;
    Some(tables)
}
