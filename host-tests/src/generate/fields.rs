//! Distance fields of any codes and errors, and of any tree: they are those of no mesh, and open.

use meshsweep::emit::Sections;
use meshsweep_core::internal::geom::Aabb;
use meshsweep_core::internal::sdf::format::SdfHeader;
use meshsweep_core::internal::sdf::format::layout::{BOOK, MOST_BASE, MOST_STEP, tree};
use meshsweep_core::{SdfKind, SdfLayout, SectionKind};

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
        layout: SdfLayout::Lattice,
        cells,
        steps: 0,
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

/// A blob of a tree of about so many leaves, whose nodes halve random axes, with random leaves.
#[must_use]
pub fn any_tree(seed: u64, kind: SdfKind, roots: [u8; 3], leaves: usize, unit: f32) -> Vec<u8> {
    let rng = &mut Rng::new(seed);
    let mut header = header(rng, kind, roots, unit);
    header.layout = SdfLayout::Tree;
    header.step = (header.step - 1) % tree::MOST_STEP + 1;
    let count = roots.iter().map(|&n| usize::from(n)).product();
    let mut entries = vec![[0; tree::ENTRY_BYTES]; count];
    // Numbers of entries that are to be written, the next one last, with levels and depth.
    let mut open: Vec<(usize, [u32; 3], u8)> =
        (0..count).rev().map(|root| (root, [0; 3], 1)).collect();
    while let Some((number, mut levels, depth)) = open.pop() {
        header.steps = header.steps.max(depth);
        let axes = rng.below(8) as u8;
        let is_halved = |axis: usize| axes >> axis & 1 != 0;
        let fits = (0..3).all(|axis| !is_halved(axis) || levels[axis] < tree::MOST_LEVEL);
        if axes == 0 || !fits || entries.len() >= leaves {
            let bits = rng.next_u64().to_le_bytes();
            entries[number] = [bits[0], bits[1], bits[2], bits[3] | tree::IS_LEAF, bits[4]];
            continue;
        }
        let first = entries.len();
        let [a, b] = u16::try_from(first - number - 1).expect("a small tree").to_le_bytes();
        entries[number] = [a, b, 0, axes, 0];
        for (axis, level) in levels.iter_mut().enumerate() {
            *level += u32::from(is_halved(axis));
        }
        entries.resize(first + (1 << axes.count_ones()), [0; tree::ENTRY_BYTES]);
        open.extend((first..entries.len()).rev().map(|child| (child, levels, depth + 1)));
    }
    let mut section = header.write().to_vec();
    section.extend(entries.into_flattened());
    blob(section)
}
