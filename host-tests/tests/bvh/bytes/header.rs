//! Sections that are missing or too short, and fields of the tree's header.

use super::{blob_of, edited, open, record, sphere};
use meshsweep::bvh::TreeOptions;
use meshsweep_core::{Bvh, OpenError, SectionKind};
use meshsweep_host_tests::corrupt::{entries, entry, put_u32, seal, word};
use meshsweep_host_tests::generate::icosphere;

// Offsets.
const NODES: usize = 20;
const LEAVES: usize = 24;
const VERTICES: usize = 28;
const TRIANGLES: usize = 32;
const STACK: usize = 36;
const SURFACE_ERROR: usize = 40;
const REACH: usize = 44;

fn header_word(at: usize, value: u32) -> Result<(), OpenError> {
    edited(sphere(), SectionKind::Bvh, |bytes| put_u32(bytes, at, value))
}

fn is_count(result: Result<(), OpenError>) -> bool {
    matches!(result, Err(OpenError::Counts { .. }))
}

#[test]
fn a_blob_without_a_tree_says_so() {
    let mut bytes = sphere();
    let at = entry(&bytes, SectionKind::Bvh as u32).at;
    // A kind of some later version is passed over.
    put_u32(&mut bytes, at, 1000);
    seal(&mut bytes);
    assert_eq!(open(&bytes), Err(OpenError::MissingSection { section: SectionKind::Bvh }));
}

#[test]
fn a_missing_section_is_named() {
    for section in [SectionKind::TreeLinks, SectionKind::TreeFans, SectionKind::TreeSource] {
        let mut bytes = sphere();
        let at = entry(&bytes, section as u32).at;
        put_u32(&mut bytes, at, 1000);
        seal(&mut bytes);
        assert_eq!(open(&bytes), Err(OpenError::MissingSection { section }));
    }
}

#[test]
fn boxes_of_either_kind_may_be_missing_but_not_of_both() {
    let without = |kinds: &[SectionKind]| {
        let mut bytes = sphere();
        for (&kind, other) in kinds.iter().zip(1000..) {
            let at = entry(&bytes, kind as u32).at;
            put_u32(&mut bytes, at, other);
        }
        seal(&mut bytes);
        open(&bytes)
    };
    assert_eq!(without(&[SectionKind::TreeFrames]), Ok(()));
    assert_eq!(without(&[SectionKind::TreeBoxes]), Ok(()));
    assert_eq!(
        without(&[SectionKind::TreeFrames, SectionKind::TreeBoxes]),
        Err(OpenError::MissingSection { section: SectionKind::TreeFrames })
    );
}

#[test]
fn reserved_bits_of_the_header_must_be_zero() {
    for (at, value) in [(0, 1), (0, 32 << 8), (0, 1 << 16), (60, 1)] {
        assert_eq!(header_word(at, value), Err(OpenError::Reserved), "{value:#x} at {at}");
    }
}

#[test]
fn contradictory_and_huge_counts_are_refused() {
    for at in [NODES, LEAVES, VERTICES, TRIANGLES, STACK] {
        let bytes = sphere();
        let stored = word(&bytes, entry(&bytes, SectionKind::Bvh as u32).offset as usize + at);
        let stored = stored.expect("a header");
        let more =
            [stored - 1, stored + 1, 0, 1, 0xFFFF, 0x00FF_FFFF, 0x0100_0000, 0x0400_0001, u32::MAX];
        // Entries more than are needed are needed by nobody, but there is no harm in them.
        for value in more.into_iter().filter(|&value| at != STACK || value != stored + 1) {
            assert!(header_word(at, value).is_err(), "{value:#x} at {at}");
        }
    }
    assert!(is_count(header_word(NODES, 0)) && is_count(header_word(LEAVES, 0)));
    assert!(is_count(header_word(TRIANGLES, 0)) && is_count(header_word(STACK, 7)));
    assert!(is_count(header_word(LEAVES, 1)), "more leaves than the header says");
}

#[test]
fn a_grid_out_of_range_is_refused() {
    for (at, value) in [(4, 1), (4, -61), (8, 1 << 24), (12, -(1 << 24) - 1), (16, i32::MIN)] {
        assert!(is_count(header_word(at, i32::cast_unsigned(value))), "{value} at {at}");
    }
    // The header's scale exponent: a blob with a tree has less room.
    for exponent in [181i32, -181] {
        let mut bytes = sphere();
        put_u32(&mut bytes, 28, exponent.cast_unsigned());
        seal(&mut bytes);
        assert!(is_count(open(&bytes)), "{exponent}");
    }
}

#[test]
fn error_bounds_that_are_negative_or_not_finite_are_refused() {
    for at in [SURFACE_ERROR, REACH] {
        for x in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0] {
            assert!(is_count(header_word(at, x.to_bits())), "{x} at {at}");
        }
    }
    assert!(is_count(header_word(REACH, 1.1e7f32.to_bits())));
}

#[test]
fn an_inverted_box_is_refused_and_one_that_is_too_small_names_the_leaf() {
    let corner = |at: usize, value: u16| {
        edited(sphere(), SectionKind::Bvh, |bytes| {
            bytes[at..at + 2].copy_from_slice(&value.to_le_bytes())
        })
    };
    for axis in 0..3 {
        let bytes = sphere();
        let at = entry(&bytes, SectionKind::Bvh as u32).offset as usize + 48 + 2 * axis;
        let short = |at: usize| u16::from_le_bytes([bytes[at], bytes[at + 1]]);
        assert!(is_count(corner(48 + 2 * axis, short(at + 6) + 1)));
        for result in
            [corner(48 + 2 * axis, short(at) + 1), corner(54 + 2 * axis, short(at + 6) - 1)]
        {
            let named =
                matches!(result, Err(OpenError::Record { section: SectionKind::TreeFans, .. }));
            assert!(named, "{result:?}");
        }
    }
    let tight = edited(sphere(), SectionKind::Bvh, |bytes| put_u32(bytes, REACH, 1f32.to_bits()));
    assert_eq!(tight, record(SectionKind::TreeFans, 0), "a triangle longer than the reach");
}

#[test]
fn stack_entries_that_are_too_few_are_refused() {
    let bytes = sphere();
    let entries = Bvh::open(&bytes).expect("opens").header().stack_entries;
    let enough = (0..entries).find(|&fewer| header_word(STACK, fewer).is_ok());
    assert_eq!(enough, None, "the builder asks for {entries}");
}

#[test]
fn fewer_input_triangles_than_source_numbers_are_refused() {
    let mut bytes = sphere();
    put_u32(&mut bytes, 84, 319);
    seal(&mut bytes);
    assert!(matches!(
        open(&bytes),
        Err(OpenError::Record { section: SectionKind::TreeSource, .. })
    ));
}

#[test]
fn sections_of_a_wrong_length_are_refused() {
    let bytes = blob_of(icosphere(2), &TreeOptions::default().with_cull(true));
    for section in entries(&bytes) {
        for shorter in [4, 20, section.bytes] {
            let mut changed = bytes.clone();
            put_u32(&mut changed, section.at + 8, section.bytes.saturating_sub(shorter));
            seal(&mut changed);
            assert!(open(&changed).is_err(), "kind {} shorter by {shorter}", section.kind);
        }
    }
}
