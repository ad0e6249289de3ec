//! Every fault of the bytes is a typed error. Bytes that open are safe to query.

use meshsweep_core::internal::sdf::format::layout::{SDF_BYTES, field, tree};
use meshsweep_core::{Blob, Contradiction, OpenError, Sdf, SdfKind, SdfLayout, SectionKind};
use meshsweep_host_tests::corrupt::{
    self, assert_damage_is_safe, assert_only_the_whole_opens, entry, put_u32,
};
use meshsweep_host_tests::fuzz_targets::{ask_sdf, sdf_seeds};
use meshsweep_host_tests::generate::{Rng, fields};

fn small() -> Vec<u8> {
    fields::any(5, SdfKind::Signed, [2, 3, 1], 0.5)
}

fn open(bytes: &[u8]) -> Result<(), OpenError> {
    Sdf::open(bytes).map(|_| ())
}

fn ask(bytes: &[u8]) -> Result<(), OpenError> {
    Sdf::open(bytes).map(|field| ask_sdf(&field))
}

fn small_tree() -> Vec<u8> {
    fields::any_tree(5, SdfKind::Signed, [2, 1, 2], 40, 0.5)
}

/// Opens after an edit of the section, the CRCs right.
fn edited(edit: impl FnOnce(&mut [u8])) -> Result<(), OpenError> {
    edited_of(small(), edit)
}

fn edited_of(bytes: Vec<u8>, edit: impl FnOnce(&mut [u8])) -> Result<(), OpenError> {
    corrupt::edited(bytes, SectionKind::Sdf, edit, |bytes| {
        let result = open(bytes);
        assert_eq!(Blob::open(bytes).map(|_| ()), result, "the whole blob is as strict");
        result
    })
}

fn with_byte(at: usize, byte: u8) -> Result<(), OpenError> {
    edited(|section| section[at] = byte)
}

fn with_f32(at: usize, number: f32) -> Result<(), OpenError> {
    edited(|section| put_u32(section, at, number.to_bits()))
}

const fn wrong(what: Contradiction) -> Result<(), OpenError> {
    Err(OpenError::Counts { what })
}

#[test]
fn the_section_stands_as_the_format_says() {
    let at = entry(&small(), SectionKind::Sdf as u32);
    assert_eq!(at.bytes as usize, SDF_BYTES + 3 * 4 * 2 + 2 * 3);
    assert_eq!(edited(|_| ()), Ok(()));
    let bytes = small();
    let header = Sdf::open(&bytes).expect("opens").header();
    let section = &bytes[at.offset as usize..][..SDF_BYTES];
    assert_eq!(header.write(), section, "the header is written as it is read");
}

#[test]
fn open_rejects_truncation_and_every_flipped_bit() {
    assert_only_the_whole_opens(&small(), open);
    assert_only_the_whole_opens(&small_tree(), open);
}

#[test]
fn numbers_out_of_range_are_named() {
    for axis in 0..3 {
        assert_eq!(with_byte(field::CELLS + axis, 0), wrong(Contradiction::FieldCells));
    }
    assert_eq!(with_byte(field::KIND, 3), wrong(Contradiction::FieldKind));
    assert_eq!(with_byte(field::LAYOUT, 2), Err(OpenError::Reserved));
    assert_eq!(with_byte(field::STEPS, 1), Err(OpenError::Reserved));
    let step = |step: u16| {
        edited(|section| section[field::STEP..][..2].copy_from_slice(&step.to_le_bytes()))
    };
    assert_eq!(step(0), wrong(Contradiction::FieldStep));
    assert_eq!(step(8193), wrong(Contradiction::FieldStep));
    assert_eq!(step(8192), Ok(()));
    for base in [(1 << 28) + 1, -(1 << 28) - 1, i32::MIN, i32::MAX] {
        let base = edited(|section| put_u32(section, field::BASE, i32::cast_unsigned(base)));
        assert_eq!(base, wrong(Contradiction::FieldStep));
    }
    for bad in [f32::NAN, f32::INFINITY, 0.0, -0.5, 1e-40, 0.6] {
        assert_eq!(with_f32(field::UNIT, bad), wrong(Contradiction::FieldUnit), "{bad}");
        assert_eq!(with_f32(field::PER_UNIT, bad), wrong(Contradiction::FieldUnit), "{bad}");
    }
    for axis in 0..3 {
        let at = field::ORIGIN + 4 * axis;
        assert_eq!(with_f32(at, f32::NAN), wrong(Contradiction::FieldUnit));
    }
}

#[test]
fn a_lattice_of_another_size_is_malformed() {
    let other = with_byte(field::CELLS, 3);
    assert!(matches!(other, Err(OpenError::Section { .. })), "{other:?}");
    let most = edited(|section| section[field::CELLS..][..3].fill(255));
    assert!(matches!(most, Err(OpenError::Section { .. })), "{most:?}");
    let short = edited(|section| section[field::CELLS..][..3].fill(1));
    assert!(matches!(short, Err(OpenError::Section { .. })), "{short:?}");
}

/// Opens a tree after an edit of its section.
fn edited_tree(edit: impl FnOnce(&mut [u8])) -> Result<(), OpenError> {
    edited_of(small_tree(), edit)
}

#[test]
fn entries_that_are_no_tree_are_named() {
    assert_eq!(edited_tree(|_| ()), Ok(()));
    let entry = |number: usize| SDF_BYTES + tree::ENTRY_BYTES * number;
    let bytes = small_tree();
    let field = Sdf::open(&bytes).expect("opens");
    let nodes: Vec<usize> = (0..field.entries().len())
        .filter(|&number| field.entries()[number][3] & tree::IS_LEAF == 0)
        .collect();
    assert!(nodes.len() > 5 && field.steps() > 3, "{} {}", nodes.len(), field.steps());
    let no_tree = wrong(Contradiction::FieldTree);
    for &node in &nodes {
        let [a, b, _, kind, _] = field.entries()[node];
        // A first child that is another: one before, one after, nearer, farther, none.
        let first = u16::from_le_bytes([a, b]);
        for other in [first.wrapping_sub(1), first + 1, first / 2, first + node as u16, u16::MAX] {
            if other == first {
                continue;
            }
            let edit = |section: &mut [u8]| {
                section[entry(node)..][..2].copy_from_slice(&other.to_le_bytes());
            };
            assert_eq!(edited_tree(edit), no_tree, "{node} {other}");
        }
        // No axis, another number of axes, a bit of no meaning, bytes that should be 0.
        for (at, byte) in [(3, 0), (3, kind ^ 1), (3, kind ^ 7), (3, kind | 8), (2, 1), (4, 255)] {
            let told = edited_tree(|section| section[entry(node) + at] = byte);
            assert_eq!(told, no_tree, "{node} {at} {byte}");
        }
        let told = edited_tree(|section| section[entry(node) + 3] |= tree::IS_LEAF);
        assert_eq!(told, no_tree, "{node}");
    }
    for steps in [0, field.steps() as u8 - 1, field.steps() as u8 + 1, 22, 23, 255] {
        let told = edited_tree(|section| section[field::STEPS] = steps);
        assert_eq!(told, no_tree, "{steps}");
    }
    assert_eq!(edited_tree(|section| section[field::CELLS] = 8), wrong(Contradiction::FieldCells));
    assert_eq!(edited_tree(|section| section[field::CELLS] = 3), no_tree);
    let step = |step: u16| {
        edited_tree(|section| section[field::STEP..][..2].copy_from_slice(&step.to_le_bytes()))
    };
    assert_eq!(step(tree::MOST_STEP), Ok(()));
    assert_eq!(step(tree::MOST_STEP + 1), wrong(Contradiction::FieldStep));
}

#[test]
fn a_tree_that_halves_an_axis_more_often_than_it_has_bits_is_refused() {
    let chain = |count: usize| {
        let mut header = fields::header(&mut Rng::new(1), SdfKind::Signed, [1; 3], 0.5);
        (header.layout, header.steps, header.step) = (SdfLayout::Tree, count as u8 + 1, 1);
        let mut section = header.write().to_vec();
        // Each node's first child is the next node.
        section.extend([0, 0, 0, 2, 0]);
        for _ in 1..count {
            section.extend([1, 0, 0, 2, 0]);
            section.extend([0, 0, 0, tree::IS_LEAF, 0]);
        }
        section.extend([[0, 0, 0, tree::IS_LEAF, 0]; 2].as_flattened());
        fields::blob(section)
    };
    assert_eq!(open(&chain(7)), Ok(()));
    assert_eq!(open(&chain(8)), wrong(Contradiction::FieldTree));
}

#[test]
fn a_tree_that_is_trusted_is_safe_to_ask_whatever_its_entries_are() {
    let mut rng = Rng::new(3);
    for _ in 0..500 {
        let told: Result<(), OpenError> = corrupt::edited(
            small_tree(),
            SectionKind::Sdf,
            |section| {
                for byte in &mut section[SDF_BYTES..] {
                    if rng.below(3) == 0 {
                        *byte = rng.next_u64() as u8;
                    }
                }
            },
            |bytes| Sdf::open_trusted(bytes).map(|field| ask_any(&field)),
        );
        assert_eq!(told, Ok(()));
    }
}

/// Asks without a look at the answers.
fn ask_any(field: &Sdf<'_>) {
    let size = field.cells().map(|cells| (cells << field.layout().cell_bits()).cast_signed());
    for part in 0..64 {
        let place = size.map(|size| size / 64 * part + 5);
        let _ = field.distance_in_units(place);
        let _ = field.gradient_in_units(place);
    }
}

#[test]
fn bytes_that_open_are_safe_to_ask() {
    let seeds = sdf_seeds();
    assert_damage_is_safe(seeds, SectionKind::Sdf, 32, (200, 3), ask);
}
