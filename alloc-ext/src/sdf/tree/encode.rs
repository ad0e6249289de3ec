//! The section's bytes of a tree.

use super::codes::Scale;
use crate::sdf::domain::Domain;
use meshsweep_core::internal::sdf::format::SdfHeader;
use meshsweep_core::internal::sdf::format::layout::BOOK;
use meshsweep_core::internal::sdf::format::layout::tree::{ENTRY_BYTES, WIDTHS};
use meshsweep_core::{SdfKind, SdfLayout};

/// A question reads `steps` entries at most. All widths of the book fit 16 bits.
pub(super) fn section(
    domain: &Domain,
    kind: SdfKind,
    scale: Scale,
    steps: u8,
    book: &[u32; WIDTHS],
    entries: Vec<[u8; ENTRY_BYTES]>,
) -> Vec<u8> {
    let book = book.map(|width| width as u16);
    let [low, high] = [0, BOOK].map(|from| std::array::from_fn(|k| book[from + k]));
    let header = SdfHeader {
        origin: domain.origin,
        per_unit: domain.per_unit,
        unit: domain.unit,
        base: scale.base,
        step: scale.step,
        kind,
        layout: SdfLayout::Tree,
        cells: domain.cells.map(|count| count as u8),
        steps,
        low,
        high,
    };
    let mut section = header.write().to_vec();
    section.extend(entries.into_flattened());
    section
}
