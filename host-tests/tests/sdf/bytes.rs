//! Every fault of the bytes is a typed error. Bytes that open are safe to query.

use meshsweep_core::internal::sdf::format::layout::{SDF_BYTES, field};
use meshsweep_core::{Blob, Contradiction, OpenError, Sdf, SdfKind, SectionKind};
use meshsweep_host_tests::corrupt::{
    self, assert_damage_is_safe, assert_only_the_whole_opens, entry, put_u32,
};
use meshsweep_host_tests::fuzz_targets::{ask_sdf, sdf_seeds};
use meshsweep_host_tests::generate::fields;

fn small() -> Vec<u8> {
    fields::any(5, SdfKind::Signed, [2, 3, 1], 0.5)
}

fn open(bytes: &[u8]) -> Result<(), OpenError> {
    Sdf::open(bytes).map(|_| ())
}

fn ask(bytes: &[u8]) -> Result<(), OpenError> {
    Sdf::open(bytes).map(|field| ask_sdf(&field))
}

/// Opens after an edit of the section, the CRCs right.
fn edited(edit: impl FnOnce(&mut [u8])) -> Result<(), OpenError> {
    corrupt::edited(small(), SectionKind::Sdf, edit, |bytes| {
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
}

#[test]
fn numbers_out_of_range_are_named() {
    for axis in 0..3 {
        assert_eq!(with_byte(field::CELLS + axis, 0), wrong(Contradiction::FieldCells));
    }
    assert_eq!(with_byte(field::KIND, 3), wrong(Contradiction::FieldKind));
    assert_eq!(with_byte(field::RESERVED, 1), Err(OpenError::Reserved));
    assert_eq!(with_byte(field::RESERVED_2, 1), Err(OpenError::Reserved));
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

#[test]
fn bytes_that_open_are_safe_to_ask() {
    let seeds = sdf_seeds();
    assert_damage_is_safe(seeds, SectionKind::Sdf, 32, (200, 3), ask);
}
