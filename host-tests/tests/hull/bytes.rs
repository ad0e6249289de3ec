//! Opening bytes: every fault is a typed error. Bytes that open are safe to query.

use super::scenes::options;
use meshsweep::cut::cut;
use meshsweep_core::{
    Blob, Budget, Contradiction, Ended, Hull, OpenError, ScratchEntry, SectionKind,
};
use meshsweep_host_tests::corrupt::{
    ask_hull, assert_only_the_whole_opens, entries, entry, flip_bits, put_u32, seal, swap_entries,
    word,
};
use meshsweep_host_tests::generate::{Rng, cube, icosphere, rough_sphere};
use meshsweep_host_tests::oracle::{contacts, distance_to_mesh};
use meshsweep_host_tests::scene::Scene;
use std::collections::HashSet;

fn small() -> Vec<u8> {
    Scene::hull("icosphere", icosphere(1), &options(8)).bytes
}

fn cube_blob() -> Vec<u8> {
    Scene::hull("cube", cube(1), &options(4)).bytes
}

/// Opens a small blob after an edit, its CRCs right.
fn edited(edit: impl FnOnce(&mut Vec<u8>)) -> Result<(), OpenError> {
    let mut bytes = small();
    edit(&mut bytes);
    seal(&mut bytes);
    Hull::open(&bytes).map(|_| ())
}

#[test]
fn open_rejects_truncation_and_every_flipped_bit() {
    for bytes in [cube_blob(), small()] {
        assert_only_the_whole_opens(&bytes, |bytes| Hull::open(bytes).map(|_| ()));
    }
}

#[test]
fn every_flipped_bit_with_right_checksums_is_refused_or_safe_to_ask() {
    for bytes in [cube_blob(), small()] {
        let outcome = flip_bits(&bytes, 0..8 * bytes.len(), |bytes| {
            Hull::open(bytes).map(|model| ask_hull(&model))
        });
        assert!(outcome.opened > 100 && outcome.reasons.len() >= 8, "{outcome:?}");
    }
}

#[test]
fn not_a_blob_is_named() {
    assert_eq!(edited(|b| b[0] = b'M'), Err(OpenError::NotABlob));
}

#[test]
fn another_version_is_named() {
    assert_eq!(edited(|b| b[8] = 1), Err(OpenError::Version { found: 1 }));
    assert_eq!(edited(|b| b[10] = 7), Ok(()), "a later minor version is read");
}

#[test]
fn trailing_bytes_are_named() {
    let mut bytes = small();
    let expected = bytes.len() as u32;
    bytes.push(0);
    let error = OpenError::TrailingBytes { expected, found: expected + 1 };
    assert_eq!(Hull::open(&bytes).map(|_| ()), Err(error));
}

#[test]
fn an_unknown_vertex_format_is_named() {
    assert_eq!(edited(|b| b[32] = 9), Err(OpenError::VertexFormat { found: 9 }));
}

#[test]
fn nan_in_the_header_is_named() {
    for at in [88, 92, 104, 116, 128] {
        for x in [f32::NAN, f32::INFINITY] {
            let result = edited(|b| put_u32(b, at, x.to_bits()));
            assert!(matches!(result, Err(OpenError::NotFinite { .. })), "{at}: {result:?}");
        }
    }
}

#[test]
fn reserved_bytes_must_be_zero() {
    for at in (72..76).chain(148..156) {
        assert_eq!(edited(|b| b[at] = 1), Err(OpenError::Reserved));
    }
}

#[test]
fn damaged_checksums_are_named_by_section() {
    let bytes = small();
    for section in Blob::open(&bytes).expect("opens").sections() {
        let mut damaged = bytes.clone();
        damaged[section.offset as usize] ^= 1;
        assert_eq!(
            Hull::open(&damaged).map(|_| ()),
            Err(OpenError::Crc { section: Some(section.kind) })
        );
    }
    let mut damaged = bytes.clone();
    damaged[84] ^= 1;
    assert_eq!(Hull::open(&damaged).map(|_| ()), Err(OpenError::Crc { section: None }));
}

#[test]
fn a_missing_section_is_named() {
    let result = edited(|b| {
        let at = entry(b, SectionKind::Radii as u32).at;
        // A kind of some later version is passed over.
        put_u32(b, at, 1000);
    });
    assert_eq!(result, Err(OpenError::MissingSection { section: SectionKind::Radii }));
}

#[test]
fn overlapping_duplicate_misaligned_and_disordered_sections_are_named() {
    let malformed =
        |result: Result<(), OpenError>| matches!(result, Err(OpenError::Section { .. }));
    assert!(malformed(edited(|b| swap_entries(b, 1, 2))), "out of order");
    assert!(malformed(edited(|b| {
        let table = entries(b);
        put_u32(b, table[2].at, table[1].kind);
    })));
    for shift in [-4i32, -1, 1, 4, 1 << 20] {
        let result = edited(|b| {
            let e = entries(b)[2];
            put_u32(b, e.at + 4, e.offset.wrapping_add_signed(shift));
        });
        assert!(malformed(result), "offset {shift}: {result:?}");
    }
    for length in [0, 1, u32::MAX, u32::MAX - 8] {
        let result = edited(|b| {
            let e = entries(b)[2];
            put_u32(b, e.at + 8, length);
        });
        assert!(result.is_err(), "length {length}");
    }
}

#[test]
fn contradictory_and_huge_counts_are_refused() {
    for at in [12, 20, 52, 56, 60, 64, 68, 76, 80, 140] {
        for value in [0, 1, 0xFF, 0xFFFF, 0x0FFF_FFFF, 0x1000_0000, 0x7FFF_FFFF, u32::MAX] {
            let mut bytes = small();
            if word(&bytes, at) == Some(value) || (at == 140 && value <= 0xFF) {
                continue;
            }
            put_u32(&mut bytes, at, value);
            seal(&mut bytes);
            assert!(Hull::open(&bytes).is_err(), "{value:#x} at {at}");
        }
    }
    assert!(matches!(
        edited(|b| put_u32(b, 140, 0)),
        Err(OpenError::Counts { what: Contradiction::HullScratch })
    ));
    assert!(matches!(
        edited(|b| put_u32(b, 28, 300)),
        Err(OpenError::Counts { what: Contradiction::HullScale })
    ));
    assert!(matches!(edited(|b| put_u32(b, 88, (-1f32).to_bits())), Err(OpenError::Counts { .. })));
    assert!(matches!(edited(|b| put_u32(b, 92, 9f32.to_bits())), Err(OpenError::Counts { .. })));
}

/// Sets the first index of a section to its greatest value and expects the section to be named.
fn bad_index(kind: SectionKind, skip: usize, value: u8) {
    let result = edited(|b| {
        let at = entry(b, kind as u32).offset as usize + skip;
        b[at] = value;
    });
    assert!(
        matches!(result, Err(OpenError::Record { section, .. }) if section == kind),
        "{kind:?}: {result:?}"
    );
}

#[test]
fn indices_out_of_range_are_named_by_section() {
    for kind in [
        SectionKind::BaseTriangles,
        SectionKind::BaseGroups,
        SectionKind::Splits,
        SectionKind::Rings,
        SectionKind::SourceStarts,
        SectionKind::Source,
    ] {
        bad_index(kind, 0, 0xFE);
    }
    bad_index(SectionKind::SplitsWith, 0, 0xFE);
}

#[test]
fn a_vertex_outside_the_box_or_not_a_number_is_named() {
    for x in [f32::NAN, f32::INFINITY, 15.0] {
        let mut bytes = Scene::hull("rough", rough_sphere(1, 0.2, 3), &options(8)).bytes;
        let e = entry(&bytes, SectionKind::Vertices as u32);
        assert_eq!(bytes[32], 0, "stored as f32");
        put_u32(&mut bytes, e.offset as usize + 4, x.to_bits());
        seal(&mut bytes);
        let error = OpenError::Record { section: SectionKind::Vertices, index: 0 };
        assert_eq!(Hull::open(&bytes).map(|_| ()), Err(error));
    }
}

#[test]
fn a_ring_that_needs_a_later_split_is_refused() {
    let bytes = small();
    let h = *Hull::open(&bytes).expect("opens").header();
    assert!(h.vertex_index_bytes() == 1 && h.splits > 2);
    let at = entry(&bytes, SectionKind::Rings as u32).offset as usize;
    // A vertex that the first split itself makes, and one of the last split.
    for vertex in [h.base_vertices, h.vertices - 1] {
        let mut looped = bytes.clone();
        looped[at] = vertex as u8;
        seal(&mut looped);
        let error = OpenError::Record { section: SectionKind::Rings, index: 0 };
        assert_eq!(Hull::open(&looped).map(|_| ()), Err(error));
    }
}

#[test]
fn a_level_table_that_falls_or_ends_early_is_refused() {
    let levels = |field: usize, value: u32| {
        edited(|b| {
            let at = entry(b, SectionKind::Levels as u32).offset as usize + 4 * field;
            put_u32(b, at, value);
        })
    };
    assert!(matches!(
        levels(1, 1 << 20),
        Err(OpenError::Record { section: SectionKind::Levels, index: 0 })
    ));
    assert!(matches!(
        levels(2, f32::NAN.to_bits()),
        Err(OpenError::Record { section: SectionKind::Levels, .. })
    ));
}

#[test]
fn a_blob_cut_at_any_level_opens_and_still_contains_the_truth() {
    let scene = Scene::hull("rough sphere", rough_sphere(3, 0.2, 7), &options(40));
    let whole = scene.model();
    for level in 0..whole.header().levels {
        let bytes = cut(&whole, level).expect("the level exists").to_bytes();
        let model = Hull::open(&bytes).unwrap_or_else(|e| panic!("level {level}: {e}"));
        let finest = whole.header().levels == level + 1;
        let mut queue = vec![ScratchEntry::EMPTY; model.scratch_entries()];
        let mut rng = Rng::new(41);
        for p in scene.points(120, &mut rng) {
            let answer = model.closest_point(p, Budget::EXACT, &mut queue).expect("finite");
            let truth = distance_to_mesh(p, &scene.positions, &scene.triangles);
            let holds = f64::from(answer.distance.lower) <= truth.upper
                && truth.lower <= f64::from(answer.distance.upper);
            assert!(holds, "level {level}: {p:?}: {answer:?} {truth:?}");
            assert_eq!((answer.triangle.is_some(), answer.ended == Ended::Exact), (finest, finest));
        }
        for _ in 0..120 {
            let (a, b) = (scene.around(2.0, &mut rng), scene.around(2.0, &mut rng));
            let answer = model.first_hit(a, b, Budget::EXACT, &mut queue).expect("in the domain");
            if let Some(first) = contacts(a, b, &scene.positions, &scene.triangles).first() {
                assert!(
                    f64::from(answer.t.lower) <= first.t_upper,
                    "level {level}: {a:?} {b:?}: {answer:?}"
                );
            }
        }
        let last = model.levels().last().expect("it has levels");
        let mut edges = HashSet::new();
        for face in model.faces(&last) {
            let [a, b, c] = face.corners;
            edges.extend([(a, b), (b, c), (c, a)]);
        }
        assert_eq!(edges.len(), 3 * last.faces as usize);
        assert!(
            edges.iter().all(|&(a, b)| edges.contains(&(b, a))),
            "level {level}: the hull is open"
        );
    }
}
