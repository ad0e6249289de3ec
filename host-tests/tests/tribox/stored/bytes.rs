//! Every fault of the bytes is a typed error. Bytes that open are safe to query.

use super::{mesh, of};
use meshsweep::bvh::{TreeOptions, build};
use meshsweep::emit::assemble;
use meshsweep::hull::{self, BuildOptions};
use meshsweep::progress::Watch;
use meshsweep::tribox::{self, TriboxOptions, cut};
use meshsweep_core::{Blob, Bvh, OpenError, SectionKind, Triboxes};
use meshsweep_host_tests::corrupt::{
    self, assert_damage_is_safe, assert_only_the_whole_opens, entry, put_u32, seal, word,
};
use meshsweep_host_tests::fuzz_targets::{ask_triboxes, triboxes_seeds};
use meshsweep_host_tests::generate::{groove_block, icosphere, torus};
use std::collections::HashSet;
use std::sync::OnceLock;

/// Sixteen triboxes: five levels, fifteen splits.
fn small() -> Vec<u8> {
    static BYTES: OnceLock<Vec<u8>> = OnceLock::new();
    BYTES.get_or_init(|| of(&torus(2.0, 0.75, 10, 6), 16)).clone()
}

fn open(bytes: &[u8]) -> Result<(), OpenError> {
    Triboxes::open(bytes).map(|_| ())
}

fn ask(bytes: &[u8]) -> Result<(), OpenError> {
    Triboxes::open(bytes).map(|triboxes| ask_triboxes(&triboxes, &triboxes))
}

/// Opens after an edit of the section, the CRCs right.
fn edited(edit: impl FnOnce(&mut [u8])) -> Result<(), OpenError> {
    corrupt::edited(small(), SectionKind::Triboxes, edit, |bytes| {
        let result = open(bytes);
        assert_eq!(Blob::open(bytes).map(|_| ()), result, "the whole blob is as strict");
        result
    })
}

// Where things stand in the section.
const LEVELS: usize = 32;
const SPLITS: usize = LEVELS + 5 * 16;
const NODES: usize = SPLITS + 15 * 2;
const NODE: usize = 40;

fn node(index: u32) -> Result<(), OpenError> {
    Err(OpenError::Record { section: SectionKind::Triboxes, index })
}

#[test]
fn the_section_stands_as_the_format_says() {
    let bytes = small();
    let at = entry(&bytes, SectionKind::Triboxes as u32);
    assert_eq!(at.bytes as usize, NODES + 31 * NODE);
    assert_eq!(edited(|_| ()), Ok(()));
}

#[test]
fn open_rejects_truncation_and_every_flipped_bit() {
    assert_only_the_whole_opens(&small(), open);
}

#[test]
fn damage_with_right_checksums_is_refused_or_safe_to_ask() {
    assert_damage_is_safe(triboxes_seeds(), SectionKind::Triboxes, 1000, (2000, 30), ask);
}

#[test]
fn headers_out_of_range_are_named() {
    let counts = |result: Result<(), OpenError>| matches!(result, Err(OpenError::Counts { .. }));
    assert_eq!(edited(|bytes| bytes[0] |= 4), Err(OpenError::Reserved));
    for (at, value) in
        [(4, 41), (4, -41i32 as u32), (8, 1 << 19), (16, -(1 << 19) as u32), (20, 30), (20, 65_537)]
    {
        assert!(counts(edited(|bytes| put_u32(bytes, at, value))), "{value} at {at}");
    }
    assert!(counts(edited(|bytes| put_u32(bytes, 24, 0))), "no level");
    assert!(counts(edited(|bytes| put_u32(bytes, 24, 33))), "too many levels");
    assert!(counts(edited(|bytes| put_u32(bytes, 28, 65))), "too deep");
    assert!(counts(edited(|bytes| put_u32(bytes, 28, 1))), "deeper than it says");
    assert_eq!(
        edited(|bytes| put_u32(bytes, 20, 29)),
        Err(OpenError::Section { index: 0 }),
        "of another length"
    );
    assert_eq!(
        edited(|bytes| put_u32(bytes, 24, 4)),
        Err(OpenError::Section { index: 0 }),
        "of another length"
    );
}

#[test]
fn levels_that_do_not_rise_or_are_no_numbers_are_named() {
    let counts = |result: Result<(), OpenError>| {
        assert!(matches!(result, Err(OpenError::Counts { .. })), "{result:?}")
    };
    counts(edited(|bytes| put_u32(bytes, LEVELS, 0)));
    counts(edited(|bytes| put_u32(bytes, LEVELS + 16, 1)));
    counts(edited(|bytes| put_u32(bytes, LEVELS + 4 * 16, 17)));
    for field in [4, 8, 12] {
        for x in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            counts(edited(|bytes| put_u32(bytes, LEVELS + field, x.to_bits())));
        }
    }
    counts(edited(|bytes| put_u32(bytes, LEVELS + 4, (-1f32).to_bits())));
    assert_eq!(
        edited(|bytes| put_u32(bytes, LEVELS + 12, (-0.5f32).to_bits())),
        Ok(()),
        "parts may overlap"
    );
}

#[test]
fn links_that_make_no_tree_name_the_node() {
    let short = |bytes: &[u8], at: usize| u16::from_le_bytes([bytes[at], bytes[at + 1]]);
    let link = |index: usize| NODES + NODE * index + 36;
    // The root is not split, or by another split.
    for value in [u16::MAX, 1, 14, 15, 1000] {
        let result = edited(|bytes| bytes[link(0)..][..2].copy_from_slice(&value.to_le_bytes()));
        assert!(
            matches!(result, Err(OpenError::Record { index: 0..=2, .. })),
            "{value}: {result:?}"
        );
    }
    // A split of a node that comes after it, of itself, of one that is split already.
    for (split, value) in [(3usize, 30u16), (3, 7), (1, 0)] {
        let result =
            edited(|bytes| bytes[SPLITS + 2 * split..][..2].copy_from_slice(&value.to_le_bytes()));
        assert!(matches!(result, Err(OpenError::Record { .. })), "{split} of {value}: {result:?}");
    }
    // Two nodes that exchange their splits: each is named by another.
    let result = edited(|bytes| {
        let (a, b) = (short(bytes, SPLITS + 2), short(bytes, SPLITS + 4));
        bytes[link(a.into())..][..2].copy_from_slice(&2u16.to_le_bytes());
        bytes[link(b.into())..][..2].copy_from_slice(&1u16.to_le_bytes());
    });
    assert!(matches!(result, Err(OpenError::Record { .. })), "{result:?}");
}

#[test]
fn planes_that_do_not_touch_or_leave_the_parent_name_the_node() {
    for index in [0usize, 5, 30] {
        for plane in 0..18 {
            let mut seen = HashSet::new();
            for by in [-30_000i16, -2000, -1, 1, 2000, 30_000] {
                let result = edited(|bytes| {
                    let at = NODES + NODE * index + 2 * plane;
                    let value = i16::from_le_bytes([bytes[at], bytes[at + 1]]);
                    bytes[at..at + 2].copy_from_slice(&value.saturating_add(by).to_le_bytes());
                });
                seen.insert(result.is_err());
                if index == 30 && result.is_err() {
                    assert_eq!(result, node(30));
                }
            }
            assert!(seen.contains(&true), "plane {plane} of {index}");
        }
    }
    for error in [0x7F80u16, 0x7FC0, 0x8001] {
        let result = edited(|bytes| {
            bytes[NODES + NODE * 7 + 38..][..2].copy_from_slice(&error.to_le_bytes())
        });
        assert_eq!(result, node(7));
    }
}

#[test]
fn blobs_hold_triboxes_beside_anything_or_alone() {
    let torus = mesh(&groove_block());
    let (triboxes, _) = tribox::build(torus.as_input(), &TriboxOptions::new(8), Watch::NONE)
        .expect("in the domain");
    let (tree, _) = build(torus.as_input(), &TreeOptions::default(), Watch::NONE).expect("builds");
    let options = BuildOptions { base_faces: 40, ..BuildOptions::default() };
    let hull = hull::build(torus.as_input(), &options, Watch::NONE).expect("a hull").0;
    for parts in 1..8 {
        let has = |bit: i32| parts >> bit & 1 == 1;
        let bytes = assemble(
            [has(0).then_some(&hull), has(1).then_some(&tree), has(2).then_some(&triboxes)]
                .into_iter()
                .flatten(),
        );
        let blob = Blob::open(&bytes).expect("opens");
        assert_eq!(
            (blob.hull().is_ok(), blob.bvh().is_ok(), blob.triboxes().is_ok()),
            (has(0), has(1), has(2))
        );
        assert_eq!(Bvh::open(&bytes).is_ok(), has(1));
        assert_eq!(Triboxes::open(&bytes).is_ok(), has(2));
        if !has(2) {
            let missing = OpenError::MissingSection { section: SectionKind::Triboxes };
            assert_eq!(open(&bytes), Err(missing));
            // An older blob: nothing else of it has changed.
            let mut older = bytes.clone();
            older[10] = 1;
            seal(&mut older);
            assert!(Blob::open(&older).is_ok());
        }
    }
    assert!(Blob::open(&assemble([])).is_err());
    // A section that a tree's reader does not look at may hold anything.
    let mut bytes = assemble([&tree, &triboxes]);
    let at = entry(&bytes, SectionKind::Triboxes as u32).offset as usize;
    bytes[at + 50] ^= 1;
    assert!(Bvh::open(&bytes).is_ok() && Blob::open(&bytes).is_err());
}

#[test]
fn every_cut_is_the_blob_that_the_prefix_of_splits_makes() {
    let bytes = of(&icosphere(2), 24);
    let blob = Blob::open(&bytes).expect("opens");
    let all = blob.triboxes().expect("there");
    for level in all.levels() {
        let tables = cut(&blob, level.triboxes).expect("a level");
        let bytes = tables.to_bytes();
        let cut_blob = Blob::open(&bytes).expect("opens");
        let left = cut_blob.triboxes().expect("there");
        assert_eq!(left.leaf_count(), level.triboxes);
        assert_eq!(cut_blob.header().surface_box, blob.header().surface_box);
        let coarser = all.coarser(level.triboxes);
        assert_eq!(left.leaves().collect::<Vec<_>>(), coarser.leaves().collect::<Vec<_>>());
        for node in 0..left.node_count() {
            let of = |triboxes: &Triboxes<'_>| {
                (
                    triboxes.node(node),
                    triboxes.children(node),
                    triboxes.parent(node),
                    triboxes.error(node),
                )
            };
            assert_eq!(of(&left), of(&coarser));
        }
        assert!(left.levels().eq(all.levels().take(left.level_count() as usize)));
    }
    // Between two levels, the coarser; below all, the first; without a limit, what it was.
    let leaves = |count: u32| {
        word(&cut(&blob, count).expect("there").bodies[0].1, 20).expect("nodes") / 2 + 1
    };
    assert_eq!([leaves(0), leaves(1), leaves(7), leaves(u32::MAX)], [1, 1, 4, 24]);
    assert_eq!(
        meshsweep::cut::cut_blob(&blob, &meshsweep::cut::Keep::default()).expect("a blob"),
        bytes
    );
}
