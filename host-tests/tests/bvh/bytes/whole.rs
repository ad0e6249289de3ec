//! Bytes changed anywhere.

use super::{ask_everything, blob_of, open, single, sphere};
use meshsweep::bvh::TreeOptions;
use meshsweep_core::{Bvh, SectionKind};
use meshsweep_host_tests::corrupt::{
    assert_only_the_whole_opens, entries, entry, flip_bits, put_u32, replace_bytes, seal,
};
use meshsweep_host_tests::fuzz_targets::tree_seeds;
use meshsweep_host_tests::generate::{Rng, cube, groove_block};

const HOSTILE: [u32; 9] =
    [0, 1, 0x0080_0000, 0x7F7F_FFFF, 0x7F80_0000, 0xFF80_0000, 0x7FC0_0000, 0x7FFF_FFFF, u32::MAX];

#[test]
fn open_rejects_truncation_and_every_flipped_bit() {
    assert_only_the_whole_opens(&blob_of(cube(1), &TreeOptions::default()), open);
}

#[test]
fn every_flipped_bit_with_right_checksums_is_refused_or_safe_to_ask() {
    for bytes in tree_seeds().iter().filter(|bytes| bytes.len() < 3000) {
        let ask = |bytes: &[u8]| Bvh::open(bytes).map(|tree| ask_everything(&tree, true));
        let outcome = flip_bits(bytes, 0..8 * bytes.len(), ask);
        assert!(outcome.opened > 100 && outcome.reasons.len() >= 7, "{outcome:?}");
    }
}

#[test]
fn every_word_replaced_by_a_hostile_one_is_refused_or_safe_to_ask() {
    for bytes in [sphere(), single()] {
        let (mut opened, mut refused) = (0, 0);
        for section in entries(&bytes) {
            for at in (section.offset..section.offset + section.bytes).step_by(4) {
                // All of what is small, and a part of what repeats itself.
                if section.bytes > 1000 && at / 4 % 17 != 0 {
                    continue;
                }
                for value in HOSTILE {
                    let mut changed = bytes.clone();
                    put_u32(&mut changed, at as usize, value);
                    seal(&mut changed);
                    match Bvh::open(&changed) {
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
        blob_of(groove_block(), &TreeOptions::default().with_cull(true)),
        blob_of(groove_block(), &TreeOptions::default().with_f32(true)),
    ];
    let rng = &mut Rng::new(77);
    for bytes in &blobs {
        let sections = entries(bytes);
        let [frames, boxes] =
            [SectionKind::TreeFrames, SectionKind::TreeBoxes].map(|kind| entry(bytes, kind as u32));
        // Two times of three the boxes: their bytes may be anything, so that such blobs open.
        let section = |run: usize, rng: &mut Rng| match run % 3 {
            0 => sections[rng.below(sections.len())],
            1 => frames,
            _ => boxes,
        };
        let ask = |bytes: &[u8]| Bvh::open(bytes).map(|tree| ask_everything(&tree, false));
        let outcome = replace_bytes(bytes, (1200, 40), rng, section, ask);
        assert!(outcome.opened > 100 && outcome.refused > 100, "{outcome:?}");
    }
}
