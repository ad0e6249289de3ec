//! Every fault of the bytes is a typed error. Bytes that open are safe to query.

use super::{mesh, of, options};
use meshsweep::bvh::{TreeOptions, build};
use meshsweep::emit::assemble;
use meshsweep::progress::Watch;
use meshsweep::tight;
use meshsweep_core::{Blob, Bvh, OpenError, SectionKind, TightHulls};
use meshsweep_host_tests::corrupt::{
    self, assert_damage_is_safe, assert_only_the_whole_opens, entry, put_u32, seal, word,
};
use meshsweep_host_tests::fuzz_targets::{ask_tight, tight_seeds};
use meshsweep_host_tests::generate::{icosphere, torus};
use std::sync::OnceLock;

/// Three hulls.
fn small() -> Vec<u8> {
    static BYTES: OnceLock<Vec<u8>> = OnceLock::new();
    BYTES
        .get_or_init(|| of(&mesh(&torus(2.0, 0.75, 10, 6)), 0.0, &options(&[64, 70, 76])).0)
        .clone()
}

fn open(bytes: &[u8]) -> Result<(), OpenError> {
    TightHulls::open(bytes).map(|_| ())
}

fn ask(bytes: &[u8]) -> Result<(), OpenError> {
    TightHulls::open(bytes).map(|hulls| ask_tight(&hulls))
}

/// Opens after an edit of the section, the CRCs right.
fn edited(edit: impl FnOnce(&mut [u8])) -> Result<(), OpenError> {
    corrupt::edited(small(), SectionKind::TightHulls, edit, |bytes| {
        let result = open(bytes);
        assert_eq!(Blob::open(bytes).map(|_| ()), result, "the whole blob is as strict");
        result
    })
}

const RECORDS: usize = 8;
const RECORD: usize = 24;

fn hull(index: u32) -> Result<(), OpenError> {
    Err(OpenError::Record { section: SectionKind::TightHulls, index })
}

#[test]
fn the_section_stands_as_the_format_says() {
    let bytes = small();
    let at = entry(&bytes, SectionKind::TightHulls as u32);
    let section = &bytes[at.offset as usize..][..at.bytes as usize];
    let field =
        |record: usize, at: usize| word(section, RECORDS + RECORD * record + at).expect("there");
    assert_eq!(word(section, 0), Some(3));
    let mut end = RECORDS + 3 * RECORD;
    for record in 0..3 {
        let (offset, length, faces) = (field(record, 0), field(record, 4), field(record, 8));
        assert_eq!(offset as usize, end.next_multiple_of(4));
        assert_eq!(&section[offset as usize..][..8], b"meshswep");
        end = offset as usize + length as usize + 2 * faces as usize;
    }
    assert_eq!(end, section.len());
    assert_eq!(edited(|_| ()), Ok(()));
}

#[test]
fn open_rejects_truncation_and_every_flipped_bit() {
    assert_only_the_whole_opens(&small(), open);
}

#[test]
fn damage_with_right_checksums_is_refused_or_safe_to_ask() {
    assert_damage_is_safe(tight_seeds(), SectionKind::TightHulls, 1500, (1500, 20), ask);
}

#[test]
fn tables_that_contradict_themselves_are_named() {
    let counts = |result: Result<(), OpenError>| {
        assert!(matches!(result, Err(OpenError::Counts { .. })), "{result:?}")
    };
    counts(edited(|bytes| put_u32(bytes, 0, 0)));
    counts(edited(|bytes| put_u32(bytes, 0, 33)));
    counts(edited(|bytes| put_u32(bytes, 0, u32::MAX)));
    for reserved in [1, 2, 1 << 31] {
        assert_eq!(edited(|bytes| put_u32(bytes, 4, reserved)), Err(OpenError::Reserved));
    }
    let at = |record: usize, field: usize| RECORDS + RECORD * record + field;
    for (field, value) in
        [(0, 0), (0, u32::MAX), (4, 0), (4, u32::MAX), (8, 0), (8, 10_000), (8, u32::MAX)]
    {
        let result = edited(|bytes| put_u32(bytes, at(1, field), value));
        assert!(result.is_err() && result != hull(0), "{field} {value}: {result:?}");
    }
    for field in [12, 16] {
        for x in [f32::NAN, f32::INFINITY, -1.0] {
            assert_eq!(edited(|bytes| put_u32(bytes, at(2, field), x.to_bits())), hull(2));
        }
    }
    assert_eq!(edited(|bytes| put_u32(bytes, at(0, 20), f32::NAN.to_bits())), hull(0));
    // The last two bytes are the slack of the last face.
    for x in [f32::NAN, f32::INFINITY, -1.0] {
        let high = (x.to_bits() >> 16) as u16;
        assert_eq!(
            edited(|bytes| *bytes.last_chunk_mut().expect("two") = high.to_le_bytes()),
            hull(2)
        );
    }
}

#[test]
fn hulls_stand_beside_any_other_part_and_older_readers_pass_them_over() {
    let mesh = mesh(&icosphere(1));
    let (tight, _) = tight::build(mesh.as_input(), &options(&[64]), Watch::NONE).expect("room");
    let (tree, _) = build(mesh.as_input(), &TreeOptions::default(), Watch::NONE).expect("builds");
    let both = assemble([&tight, &tree]);
    let blob = Blob::open(&both).expect("opens");
    assert!(blob.bvh().is_ok() && blob.tight_hulls().is_ok() && blob.hull().is_err());
    assert!(Bvh::open(&both).is_ok());
    let alone = tree.to_bytes();
    let missing = OpenError::MissingSection { section: SectionKind::TightHulls };
    assert_eq!(open(&alone), Err(missing));
    assert!(Blob::open(&alone).expect("opens").tight_hulls().is_err());
    // A section that a tree's reader does not look at may hold anything; a kind that nobody knows
    // is passed over.
    let mut damaged = both.clone();
    let at = entry(&damaged, SectionKind::TightHulls as u32);
    damaged[at.offset as usize + 50] ^= 1;
    assert!(Bvh::open(&damaged).is_ok() && Blob::open(&damaged).is_err());
    let mut unknown = both.clone();
    put_u32(&mut unknown, at.at, 31);
    seal(&mut unknown);
    assert!(Blob::open(&unknown).expect("opens").tight_hulls().is_err());
}

#[test]
fn a_blob_in_a_hull_is_not_asked_for_hulls_of_its_own() {
    // The inner blob may hold sections of any kind that a tree's reader does not look at, hulls
    // among them: they are not followed.
    let inner = small();
    let mut outer = small();
    let at = entry(&outer, SectionKind::TightHulls as u32);
    let first = at.offset as usize + RECORDS;
    put_u32(&mut outer, first + 4, inner.len() as u32);
    seal(&mut outer);
    assert!(open(&outer).is_err());
}
