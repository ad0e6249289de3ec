//! The target for distance fields of blobs.

use super::input::Input;
use super::suite::ask_all;
use crate::generate::fields;
use meshsweep_core::{Blob, Interval, QueryError, Sdf, SdfKind, Side, Verdict};
use meshsweep_suite::ask::sdf;
use std::sync::OnceLock;

/// Small valid blobs of fields of each kind and layout: one cell and many.
pub fn sdf_seeds() -> &'static [Vec<u8>] {
    static SEEDS: OnceLock<Vec<Vec<u8>>> = OnceLock::new();
    SEEDS.get_or_init(|| {
        vec![
            fields::any(1, SdfKind::Surface, [1, 1, 1], 1.0),
            fields::any(2, SdfKind::Signed, [5, 4, 3], 0.001),
            fields::any(3, SdfKind::Solid, [2, 9, 1], 1e-30),
            fields::any_tree(4, SdfKind::Surface, [1, 1, 1], 0, 1.0),
            fields::any_tree(5, SdfKind::Signed, [2, 3, 1], 60, 0.001),
            fields::any_tree(6, SdfKind::Solid, [3, 1, 4], 200, 1e-30),
        ]
    })
}

/// Asks everything of an opened field, at ordinary places and at hostile ones.
///
/// # Panics
/// If an answer is out of range.
pub fn ask_sdf(field: &Sdf<'_>) {
    for p in [[0.1, 0.2, 0.3], [5.0, -3.0, 1.0], [1e36, -1e36, 1e36], [1e-40, 0.0, -0.0]] {
        ask(field, p, 0.5);
    }
    let [least, greatest] = field.bounds();
    ask(field, least, 1e20);
    ask(field, greatest, 0.0);
    let bits = field.layout().cell_bits();
    let whole = field.cells().map(|cells| (cells << bits).cast_signed());
    assert!((1..=22).contains(&field.steps()), "{}", field.steps());
    for place in [[0; 3], whole, whole.map(|x| x - 1), whole.map(|x| x / 2), [i32::MIN; 3]] {
        if let Ok(found) = field.distance_in_units(place) {
            assert!(found.lower <= found.upper, "{found:?}");
        }
        let _ = field.gradient_in_units(place);
    }
}

fn ask(field: &Sdf<'_>, p: [f32; 3], distance: f32) {
    match field.distance_and_gradient(p) {
        Ok((found, _)) => {
            let interval = found.distance;
            assert!(interval.lower <= interval.upper, "{found:?}");
            assert!(interval.lower.is_finite(), "{found:?}");
            match found.side {
                Side::Outside => assert!(interval.lower > 0.0, "{found:?}"),
                Side::Inside => assert!(interval.upper < 0.0, "{found:?}"),
                _ => {}
            }
            assert_eq!(field.distance(p), Ok(found));
        }
        Err(error) => refused(error),
    }
    match (field.within(p, distance), field.distance(p)) {
        (Ok(verdict), Ok(found)) => {
            let Interval { lower, upper } = found.distance;
            match verdict {
                Verdict::Yes => assert!(lower.abs() <= distance && upper.abs() <= distance),
                Verdict::No => assert!(lower > distance || upper < -distance),
                _ => {}
            }
        }
        (Err(error), _) | (_, Err(error)) => refused(error),
    }
}

fn refused(error: QueryError) {
    let known = [QueryError::NotFinite, QueryError::OutOfDomain, QueryError::Tolerance];
    assert!(known.contains(&error), "{error:?}");
}

/// Any bytes, and edits of valid blobs.
///
/// # Panics
/// If an answer is out of range.
pub fn sdf(data: &[u8]) {
    if let Ok(opened) = Sdf::open(data) {
        ask_sdf(&opened);
    }
    let mut input = Input(data);
    let bytes = input.blob(sdf_seeds());
    let opened = Sdf::open(&bytes);
    if let Ok(blob) = Blob::open(&bytes) {
        assert_eq!(blob.sdf().is_ok(), opened.is_ok(), "{opened:?}");
    }
    let Ok(field) = opened else { return };
    ask_sdf(&field);
    ask(&field, input.point(), input.float());
    ask_all::<Sdf<'_>>(&bytes, sdf::Scratch::new(), &mut input);
}
