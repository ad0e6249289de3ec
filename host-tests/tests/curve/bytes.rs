//! Every fault of the bytes is a typed error. Bytes that open are safe to query.

use meshsweep::BuildError;
use meshsweep::curve::{CurveError, CurveOptions, Polyline, Zone, build};
use meshsweep::progress::Watch;
use meshsweep_core::{Blob, Curve, OpenError, SectionKind};
use meshsweep_host_tests::corrupt::{
    self, assert_damage_is_safe, assert_only_the_whole_opens, entry, put_u32,
};
use meshsweep_host_tests::fuzz_targets::{ask_curve, curve_seeds};
use meshsweep_host_tests::generate::curves::{circle, open as line, walk};

/// A walk of nine segments and a closed ring of seven: eighteen points in f32.
fn small() -> Vec<u8> {
    build(&[walk(9, 1), circle(7)], &CurveOptions { is_f32: true }, Watch::NONE)
        .expect("finite")
        .0
        .to_bytes()
}

fn open(bytes: &[u8]) -> Result<(), OpenError> {
    Curve::open(bytes).map(|_| ())
}

fn ask(bytes: &[u8]) -> Result<(), OpenError> {
    Curve::open(bytes).map(|curve| ask_curve(&curve))
}

/// Opens after an edit of the section, the CRCs right.
fn edited(edit: impl FnOnce(&mut [u8])) -> Result<(), OpenError> {
    corrupt::edited(small(), SectionKind::Curves, edit, |bytes| {
        let result = open(bytes);
        assert_eq!(Blob::open(bytes).map(|_| ()), result, "the whole blob is as strict");
        result
    })
}

// Where things stand in the section.
const POLYLINES: usize = 32;
const POINTS: usize = POLYLINES + 2 * 4;
const NODES: usize = POINTS + 18 * 12;
const NODE: usize = 4;

fn record(index: u32) -> Result<(), OpenError> {
    Err(OpenError::Record { section: SectionKind::Curves, index })
}

#[test]
fn the_section_stands_as_the_format_says() {
    let at = entry(&small(), SectionKind::Curves as u32);
    assert_eq!(at.bytes as usize, NODES + 16 * NODE);
    assert_eq!(edited(|_| ()), Ok(()));
}

#[test]
fn open_rejects_truncation_and_every_flipped_bit() {
    assert_only_the_whole_opens(&small(), open);
}

#[test]
fn damage_with_right_checksums_is_refused_or_safe_to_ask() {
    assert_damage_is_safe(curve_seeds(), SectionKind::Curves, 1500, (2000, 30), ask);
}

#[test]
fn headers_out_of_range_are_named() {
    let counts = |result: Result<(), OpenError>| matches!(result, Err(OpenError::Counts { .. }));
    assert_eq!(edited(|bytes| bytes[0] |= 4), Err(OpenError::Reserved));
    for (at, value) in [(20, 1 << 28), (24, 0), (24, 10), (28, 65), (28, 0), (28, 9)] {
        assert!(counts(edited(|bytes| put_u32(bytes, at, value))), "{value} at {at}");
    }
    let malformed = Err(OpenError::Section { index: 0 });
    assert_eq!(edited(|bytes| put_u32(bytes, 20, 17)), malformed);
    assert_eq!(edited(|bytes| put_u32(bytes, 24, 3)), malformed);
    // Not f32: the grid matters, and points are shorter.
    assert_eq!(edited(|bytes| bytes[0] &= !2), malformed);
    for (at, value) in [(4, 1), (4, -61i32 as u32), (8, 1 << 24), (16, -(1 << 25) as u32)] {
        let grid = |bytes: &mut [u8]| {
            bytes[0] &= !2;
            put_u32(bytes, at, value);
        };
        assert!(counts(edited(grid)), "{value} at {at}");
    }
}

#[test]
fn polylines_points_and_nodes_that_do_not_fit_are_named() {
    assert_eq!(edited(|bytes| put_u32(bytes, POLYLINES, 1)), record(0), "not from the start");
    assert_eq!(edited(|bytes| put_u32(bytes, POLYLINES + 4, 1)), record(0), "one point");
    assert_eq!(edited(|bytes| put_u32(bytes, POLYLINES + 4, 17)), record(1), "one point");
    assert_eq!(edited(|bytes| bytes[POLYLINES + 3] |= 0x80), record(0), "not closed");
    for x in [f32::NAN, f32::INFINITY, 5.0] {
        let point = |bytes: &mut [u8]| put_u32(bytes, POINTS + 3 * 12, x.to_bits());
        assert_eq!(edited(point), record(3), "{x} is not in the box");
    }
    assert_eq!(edited(|bytes| bytes[NODES + 1] = 16), record(0), "the root does not hold all");
    for index in 1..16 {
        for byte in [0, 1] {
            let node = |bytes: &mut [u8]| bytes[NODES + index * NODE + byte] ^= 1;
            assert!(matches!(edited(node), Err(OpenError::Record { .. })), "{index} {byte}");
        }
    }
    for radius in [0x7FC0u16, 0x7F80, 0x8001, 0xBF80] {
        let node = |bytes: &mut [u8]| {
            bytes[NODES + 2 * NODE + 2..][..2].copy_from_slice(&radius.to_le_bytes());
        };
        assert!(matches!(edited(node), Err(OpenError::Record { .. })), "{radius:x}");
    }
}

/// A ring that is an exclusion zone in a ring that is none.
fn zoned() -> Vec<u8> {
    let exclusion = Polyline { zone: Zone::Exclusion, ..circle(7) };
    let built = build(&[circle(9), exclusion], &CurveOptions { is_f32: true }, Watch::NONE);
    built.expect("finite").0.to_bytes()
}

#[test]
fn zones_are_of_known_kinds_one_for_each_polyline_and_of_curves() {
    let bytes = zoned();
    assert_eq!(u16::from_le_bytes([bytes[10], bytes[11]]), 4, "the minor version");
    let whole = entry(&bytes, SectionKind::CurveZones as u32);
    assert_eq!(bytes[whole.offset as usize..][..whole.bytes as usize], [0, 1]);
    assert_only_the_whole_opens(&bytes, open);
    let edit = |edit: &dyn Fn(&mut [u8])| {
        corrupt::edited(zoned(), SectionKind::CurveZones, edit, |bytes| {
            assert_eq!(Blob::open(bytes).map(|_| ()), open(bytes), "the whole blob is as strict");
            open(bytes)
        })
    };
    let bad = |index| Err(OpenError::Record { section: SectionKind::CurveZones, index });
    assert_eq!(edit(&|zones| zones.copy_from_slice(&[1, 0])), Ok(()));
    assert_eq!(edit(&|zones| zones[1] = 2), bad(1));
    assert_eq!(edit(&|zones| zones[0] = 255), bad(0));
    // An exclusion zone that is not closed.
    let opened = corrupt::edited(
        bytes.clone(),
        SectionKind::Curves,
        |curves| curves[POLYLINES + 7] &= 0x7F,
        open,
    );
    assert_eq!(opened, bad(1));
    // Zones without curves are none.
    let mut alone = bytes;
    let at = 160 + 16 * (0..2).find(|k| alone[160 + 16 * k] == 21).expect("curves");
    put_u32(&mut alone, at, 99);
    corrupt::seal(&mut alone);
    let missing = OpenError::MissingSection { section: SectionKind::Curves };
    assert_eq!(Blob::open(&alone).map(|_| ()), Err(missing));
}

#[test]
fn damaged_zones_are_refused_or_safe_to_ask() {
    assert_damage_is_safe(&[zoned()], SectionKind::CurveZones, 16, (200, 3), ask);
}

#[test]
fn curves_that_cannot_be_stored_are_refused() {
    let refused = |polylines: &[Polyline]| {
        let BuildError::Curve { error, .. } =
            build(polylines, &CurveOptions { is_f32: true }, Watch::NONE).unwrap_err()
        else {
            panic!("another error");
        };
        error
    };
    assert_eq!(refused(&[]), CurveError::NoPoints);
    let bad = CurveError::Polyline { polyline: 1 };
    for points in [vec![], vec![[0.0; 3]], vec![[0.0; 3], [0.0, f64::NAN, 0.0]], vec![[1e39; 3]; 2]]
    {
        assert_eq!(refused(&[circle(3), line(points)]), bad);
    }
    let open_zone = Polyline { zone: Zone::Exclusion, ..walk(3, 1) };
    assert_eq!(refused(&[circle(3), open_zone]), CurveError::OpenZone { polyline: 1 });
    let largest = 1e-39;
    assert_eq!(refused(&[line(vec![[0.0; 3], [largest; 3]])]), CurveError::TooSmall { largest });
}
