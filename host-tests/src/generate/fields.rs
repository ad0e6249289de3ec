//! Distance fields of any codes and errors: they are those of no mesh, and open.

use meshsweep::emit::Sections;
use meshsweep_core::internal::geom::Aabb;
use meshsweep_core::internal::sdf::format::SdfHeader;
use meshsweep_core::internal::sdf::format::layout::{BOOK, MOST_BASE, MOST_STEP};
use meshsweep_core::{SdfKind, SectionKind};

use super::Rng;

/// A header of a lattice with so many cells: a unit of `unit`, codes and errors of any size.
#[must_use]
pub fn header(rng: &mut Rng, kind: SdfKind, cells: [u8; 3], unit: f32) -> SdfHeader {
    let mut below = |most: u32| rng.below(most as usize) as u32;
    let per_unit = 1.0 / unit;
    SdfHeader {
        origin: [0; 3].map(|_| (below(4001) as f32 - 2000.0) * unit),
        per_unit,
        unit: 1.0 / per_unit,
        base: below(2 * MOST_BASE.unsigned_abs()).cast_signed() - MOST_BASE,
        step: below(u32::from(MOST_STEP)) as u16 + 1,
        kind,
        cells,
        low: [0; BOOK].map(|_| below(1 << 16) as u16),
        high: [0; BOOK].map(|_| below(1 << 16) as u16),
    }
}

/// A blob with this section.
#[must_use]
pub fn blob(section: Vec<u8>) -> Vec<u8> {
    let bodies = vec![(SectionKind::Sdf, section)];
    let bounds = Aabb { min: glam::Vec3::ZERO, max: glam::Vec3::ZERO };
    Sections::new(0, 0.0, 1, bounds, bodies).to_bytes()
}

/// A blob of such a field, with random codes and random errors.
#[must_use]
pub fn any(seed: u64, kind: SdfKind, cells: [u8; 3], unit: f32) -> Vec<u8> {
    let rng = &mut Rng::new(seed);
    let header = header(rng, kind, cells, unit);
    let [corners, cells] = header.counts();
    let mut section = header.write().to_vec();
    section.extend((0..corners + cells).map(|_| rng.next_u64() as u8));
    blob(section)
}
