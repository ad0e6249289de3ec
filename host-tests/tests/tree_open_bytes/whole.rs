//! Bytes changed anywhere.

use super::{ask_everything, blob_of, open, single, sphere};
use meshsweep_alloc::tree::TreeOptions;
use meshsweep_core::blob::layout::SectionKind;
use meshsweep_core::{OpenError, Tree};
use meshsweep_host_tests::corrupt::{entries, entry, put_u32, seal};
use meshsweep_host_tests::fuzz_targets::tree_seeds;
use meshsweep_host_tests::generate::{Rng, bracket, cube};
use std::collections::HashSet;

const HOSTILE: [u32; 9] =
    [0, 1, 0x0080_0000, 0x7F7F_FFFF, 0x7F80_0000, 0xFF80_0000, 0x7FC0_0000, 0x7FFF_FFFF, u32::MAX];

fn cube_blob() -> Vec<u8> {
    blob_of(cube(1), &TreeOptions::default())
}

#[test]
fn open_rejects_truncation_at_every_length() {
    let bytes = cube_blob();
    for length in 0..bytes.len() {
        let error = open(&bytes[..length]).expect_err("cut short");
        assert!(
            matches!(error, OpenError::Truncated { found, .. } if found as usize == length),
            "{length}: {error:?}"
        );
    }
}

#[test]
fn open_rejects_every_flipped_bit() {
    let mut bytes = cube_blob();
    for bit in 0..8 * bytes.len() {
        bytes[bit / 8] ^= 1 << (bit % 8);
        assert!(open(&bytes).is_err(), "bit {bit}");
        bytes[bit / 8] ^= 1 << (bit % 8);
    }
    assert_eq!(open(&bytes), Ok(()));
}

#[test]
fn every_flipped_bit_with_right_checksums_is_refused_or_safe_to_ask() {
    for bytes in tree_seeds().iter().filter(|bytes| bytes.len() < 3000) {
        let (mut opened, mut refused) = (0, HashSet::new());
        for bit in 0..8 * bytes.len() {
            let mut flipped = bytes.clone();
            flipped[bit / 8] ^= 1 << (bit % 8);
            seal(&mut flipped);
            match Tree::open(&flipped) {
                Ok(tree) => {
                    opened += 1;
                    ask_everything(&tree, true);
                }
                Err(error) => {
                    refused.insert(std::mem::discriminant(&error));
                }
            }
        }
        assert!(opened > 100 && refused.len() >= 7, "{opened} opened, {} kinds of refusal", refused.len());
    }
}

#[test]
fn every_word_replaced_by_a_hostile_one_is_refused_or_safe_to_ask() {
    for bytes in [sphere(), single()] {
        let (mut opened, mut refused) = (0, 0);
        for section in entries(&bytes) {
            for at in (section.offset..section.offset + section.bytes).step_by(4) {
                // All of what is small, and a part of what repeats itself.
                if section.bytes > 1000 && at / 4 % 7 != 0 {
                    continue;
                }
                for value in HOSTILE {
                    let mut changed = bytes.clone();
                    put_u32(&mut changed, at as usize, value);
                    seal(&mut changed);
                    match Tree::open(&changed) {
                        Ok(tree) => {
                            opened += 1;
                            ask_everything(&tree, true);
                        }
                        Err(_) => refused += 1,
                    }
                }
            }
        }
        assert!(opened > 100 && refused > 1000, "{opened} opened, {refused} refused");
    }
}

#[test]
fn random_edits_with_right_checksums_are_refused_or_safe_to_ask() {
    let blobs = [
        blob_of(bracket(), &TreeOptions { cull: true, ..TreeOptions::default() }),
        blob_of(bracket(), &TreeOptions { single: true, ..TreeOptions::default() }),
    ];
    let rng = &mut Rng::new(77);
    for bytes in &blobs {
        let sections = entries(bytes);
        let [frames, boxes] =
            [SectionKind::TreeFrames, SectionKind::TreeBoxes].map(|kind| entry(bytes, kind as u32));
        let (mut opened, mut refused) = (0, 0);
        for run in 0..1200 {
            let mut changed = bytes.clone();
            for _ in 0..1 + rng.below(if run % 2 == 0 { 2 } else { 40 }) {
                // Two times of three the boxes: their bytes may be anything, so that such blobs open.
                let section = match run % 3 {
                    0 => sections[rng.below(sections.len())],
                    1 => frames,
                    _ => boxes,
                };
                changed[section.offset as usize + rng.below(section.bytes as usize)] = rng.next_u64() as u8;
            }
            seal(&mut changed);
            match Tree::open(&changed) {
                Ok(tree) => {
                    opened += 1;
                    ask_everything(&tree, false);
                }
                Err(_) => refused += 1,
            }
        }
        assert!(opened > 100 && refused > 100, "{opened} opened, {refused} refused");
    }
}
