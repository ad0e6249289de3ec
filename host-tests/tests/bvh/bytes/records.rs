//! Boxes, vertices and source numbers.

use super::{edited, record, single, sphere};
use meshsweep_core::{Bvh, OpenError, SectionKind};
use meshsweep_host_tests::corrupt::{entry, put_u32, word};

// Bytes of records.
const FRAME: usize = 76;
const BOXES: usize = 72;

#[test]
fn boxes_out_of_range_name_the_node() {
    // The fields that may not be negative come last.
    let (kind, fields, signed) = (SectionKind::TreeBoxes, 6, 3);
    for (node, field) in [0, 3].into_iter().flat_map(|node| (0..fields).map(move |f| (node, f))) {
        let negative = (field >= signed).then_some(-1.0);
        let huge = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e38];
        for x in huge.into_iter().chain(negative) {
            let result = edited(sphere(), kind, |section| {
                put_u32(section, BOXES * node + 48 + 4 * field, x.to_bits());
            });
            assert_eq!(result, record(kind, node as u32), "{x} in field {field}");
        }
    }
}

#[test]
fn frames_that_lengthen_or_have_unknown_exponents_name_the_node() {
    let kind = SectionKind::TreeFrames;
    for node in [0, 3] {
        let changed = |change: &dyn Fn(&mut [u8])| {
            edited(sphere(), kind, |section| change(&mut section[FRAME * node..][..FRAME]))
        };
        assert_eq!(changed(&|_| ()), Ok(()));
        for entry in 0..9 {
            for large in [8193i16, i16::MAX, -8193, i16::MIN] {
                let result = changed(&|frame| {
                    frame[48 + 2 * entry..][..2].copy_from_slice(&large.to_le_bytes());
                });
                assert_eq!(result, record(kind, node as u32), "{large} in entry {entry}");
            }
        }
        // Each row is short enough, and together they lengthen what lies along all of them.
        let result = changed(&|frame| {
            for entry in frame[48..66].chunks_mut(2) {
                entry.copy_from_slice(&4_700i16.to_le_bytes());
            }
        });
        assert_eq!(result, record(kind, node as u32));
        for axis in 0..3 {
            assert_eq!(changed(&|frame| frame[72 + axis] = 9), Ok(()));
            assert_eq!(changed(&|frame| frame[72 + axis] = 10), record(kind, node as u32));
        }
        assert_eq!(changed(&|frame| frame[75] = 1), record(kind, node as u32));
    }
}

#[test]
fn frames_far_from_the_model_name_the_node() {
    let kind = SectionKind::TreeFrames;
    let bytes = sphere();
    let header = *Bvh::open(&bytes).expect("opens").header();
    let size = (0..3).map(|k| header.high[k] - header.low[k]).max().expect("three axes");
    let mut far = 0;
    for (node, axis) in [0, 3].into_iter().flat_map(|node| (0..3).map(move |axis| (node, axis))) {
        let beyond = u32::from(header.high[axis]) + u32::from(size / 4);
        for (origin, expected) in [(beyond, Ok(())), (beyond + 1, record(kind, node as u32))] {
            let Ok(origin) = u16::try_from(origin) else { continue };
            let result = edited(bytes.clone(), kind, |section| {
                section[FRAME * node + 66 + 2 * axis..][..2].copy_from_slice(&origin.to_le_bytes());
            });
            assert_eq!(result, expected, "{origin} along axis {axis}");
            far += 1;
        }
    }
    assert!(far > 0, "the sphere fills its grid");
}

#[test]
fn vertices_that_are_outside_or_not_numbers_name_the_leaf() {
    let fans = |bytes: Vec<u8>, at: usize, value: u32| {
        edited(bytes, SectionKind::TreeFans, |fans| put_u32(fans, at, value))
    };
    for x in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e9, -1e9] {
        assert_eq!(fans(single(), 4, x.to_bits()), record(SectionKind::TreeFans, 0), "{x}");
    }
    // On the grid every number is one: the sphere does not fill its grid, so the greatest lies
    // outside.
    assert_eq!(fans(sphere(), 0, u32::MAX), record(SectionKind::TreeFans, 0));
}

#[test]
fn bytes_after_the_last_leaf_must_be_zero() {
    for bytes in [sphere(), single()] {
        let length = entry(&bytes, SectionKind::TreeFans as u32).bytes as usize;
        let padding = if Bvh::open(&bytes).expect("opens").header().is_f32() { 96 } else { 48 };
        for at in [length - 1, length - padding] {
            let result = edited(bytes.clone(), SectionKind::TreeFans, |fans| fans[at] = 1);
            assert_eq!(result, Err(OpenError::MissingSection { section: SectionKind::TreeFans }));
        }
    }
}

#[test]
fn source_numbers_out_of_range_name_the_block_or_the_triangle() {
    let source = |at: usize, change: fn(u32) -> u32| {
        edited(sphere(), SectionKind::TreeSource, |bytes| {
            put_u32(bytes, at, change(word(bytes, at).expect("a record")));
        })
    };
    // The second block's least number, offset and width.
    let in_block = source(8, |_| 320);
    assert_eq!(in_block, record(SectionKind::TreeSource, 64), "a number past the input's");
    assert_eq!(
        source(8, |_| u32::MAX),
        record(SectionKind::TreeSource, 64),
        "a sum past the integers"
    );
    for change in
        [(|word| word + 32) as fn(u32) -> u32, |word| word - 32, |_| u32::MAX, |word| word & 31]
    {
        assert_eq!(source(12, change), record(SectionKind::TreeSource, 1), "data elsewhere");
    }
    assert_eq!(
        source(12, |word| word ^ 1),
        record(SectionKind::TreeSource, 2),
        "the next block is elsewhere"
    );
    // The last of five blocks: too wide for the section.
    let missing = Err(OpenError::MissingSection { section: SectionKind::TreeSource });
    assert_eq!(source(36, |word| word | 31), missing);
}
