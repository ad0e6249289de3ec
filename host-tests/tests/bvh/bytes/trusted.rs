//! Opening without a check of the records.

use super::{blob_of, open, single, sphere};
use meshsweep::bvh::TreeOptions;
use meshsweep_core::{Blob, Bvh, OpenError, SectionKind, TightHulls};
use meshsweep_host_tests::corrupt::{assert_only_the_whole_opens, entry};
use meshsweep_host_tests::fuzz_targets::tree_seeds;
use meshsweep_host_tests::generate::icosphere;

fn trusted(bytes: &[u8]) -> Result<(), OpenError> {
    Bvh::open_trusted(bytes).map(|_| ())
}

#[test]
fn a_trusted_tree_is_the_opened_one() {
    for bytes in tree_seeds() {
        let opened = format!("{:?}", Bvh::open(bytes).expect("opens"));
        assert_eq!(format!("{:?}", Bvh::open_trusted(bytes).expect("opens")), opened);
    }
    let bytes = std::fs::read("../fixtures/hulls.msw").expect("the fixture is there");
    let opened = format!("{:?}", TightHulls::open(&bytes).expect("opens"));
    assert_eq!(format!("{:?}", TightHulls::open_trusted(&bytes).expect("opens")), opened);
}

#[test]
fn trust_refuses_a_beginning_and_any_flipped_bit_before_the_sections() {
    for bytes in [sphere(), single()] {
        let sections = Blob::open(&bytes).expect("opens").header().header_bytes as usize;
        for length in 0..bytes.len() {
            assert!(trusted(&bytes[..length]).is_err(), "{length} bytes");
        }
        let mut flipped = bytes.clone();
        for bit in 0..8 * sections {
            flipped[bit / 8] ^= 1 << (bit % 8);
            assert!(trusted(&flipped).is_err(), "bit {bit}");
            flipped[bit / 8] ^= 1 << (bit % 8);
        }
    }
}

/// Such a tree kept a coherent query from its end.
#[test]
fn a_trusted_tight_hull_whose_header_has_no_numbers_is_not_given_out() {
    let mut bytes = std::fs::read("../fixtures/hulls.msw").expect("the fixture is there");
    let hulls = TightHulls::open(&bytes).expect("opens");
    let inner = hulls.get(0).expect("a hull").bytes();
    let at = inner.as_ptr().addr() - bytes.as_ptr().addr();
    let star_radius = at + entry(inner, SectionKind::Bvh as u32).offset as usize + 44;
    bytes[star_radius..][..4].copy_from_slice(&f32::NAN.to_le_bytes());
    let hulls = TightHulls::open_trusted(&bytes).expect("opens");
    assert!(hulls.get(0).is_none() && hulls.get(1).is_some());
}

#[test]
fn a_checksum_tells_every_flipped_bit() {
    let small = blob_of(icosphere(0), &TreeOptions::default());
    assert_only_the_whole_opens(&small, |bytes| Blob::checksum(bytes).map(|_| ()));
}

#[test]
fn a_checksum_names_the_section_that_changed_and_trust_does_not_look() {
    let mut bytes = sphere();
    let fans = entry(&bytes, SectionKind::TreeFans as u32);
    bytes[fans.offset as usize] ^= 1;
    let wrong = Err(OpenError::Crc { section: Some(SectionKind::TreeFans) });
    assert_eq!(
        (Blob::checksum(&bytes).map(|_| ()), open(&bytes), trusted(&bytes)),
        (wrong, wrong, Ok(()))
    );
}

#[test]
fn blobs_with_other_contents_have_other_checksums() {
    let [a, b] = [sphere(), single()].map(|bytes| Blob::checksum(&bytes).expect("sound"));
    assert_ne!(a, b);
}
