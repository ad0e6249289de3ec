//! The look-up in integers and in f32, beside the stored numbers in exact arithmetic.

use meshsweep_core::internal::sdf::format::layout::value_loss;
use meshsweep_core::{QueryError, Sdf, SdfKind, Side};
use meshsweep_host_tests::generate::{EXTREME_SCALES, Rng, fields};

/// The trilinear function of the codes at a place, in 2^-33 of a code, and the errors of its cell:
/// exact, and by another formula than the core's.
fn trilinear(field: &Sdf<'_>, place: [i64; 3]) -> (i128, [i128; 2]) {
    let header = field.header();
    let cells = header.cells.map(i64::from);
    let corners = cells.map(|n| n + 1);
    let cell: [i64; 3] = std::array::from_fn(|k| (place[k] / 2048).min(cells[k] - 1));
    let mut sum = 0i128;
    for corner in 0..8i64 {
        let up = [corner & 1, corner >> 1 & 1, corner >> 2];
        let mut weight = 1i128;
        let mut at = [0i64; 3];
        for k in 0..3 {
            let fraction = place[k] - 2048 * cell[k];
            weight *= i128::from(if up[k] == 1 { fraction } else { 2048 - fraction });
            at[k] = cell[k] + up[k];
        }
        let index = (at[2] * corners[1] + at[1]) * corners[0] + at[0];
        sum += weight * i128::from(field.codes()[index as usize]);
    }
    let index = (cell[2] * cells[1] + cell[1]) * cells[0] + cell[0];
    let errors = usize::from(field.errors()[index as usize]);
    (sum, [header.low[errors % 16].into(), header.high[errors / 16].into()])
}

/// The bounds of a place that the stored numbers say, in 2^-33 of a unit, and the most that the
/// look-up may add below.
fn stored(field: &Sdf<'_>, place: [i64; 3]) -> [i128; 3] {
    let header = field.header();
    let (codes, [low, high]) = trilinear(field, place);
    let value = i128::from(header.step) * codes;
    let one = 1i128 << 33;
    let at = |units: i128| (i128::from(header.base) + units) * one + value;
    [at(-low), at(high), i128::from(value_loss(header.step)) * one]
}

pub fn lattices() -> impl Iterator<Item = (Vec<u8>, u64)> {
    let sizes = [[1, 1, 1], [1, 2, 3], [7, 1, 2], [19, 20, 18], [255, 1, 2], [1, 255, 1]];
    (0..).zip(sizes).flat_map(|(k, cells)| {
        SdfKind::ALL.into_iter().map(move |kind| {
            let seed = 8 * k + kind as u64;
            (fields::any(seed, kind, cells, 0.001 * (k + 1) as f32), seed)
        })
    })
}

fn place(rng: &mut Rng, field: &Sdf<'_>) -> [i64; 3] {
    field.cells().map(|cells| {
        let cells = cells as usize;
        // Corners and sides of cells too.
        let place = match rng.below(4) {
            0 => 2048 * rng.below(cells),
            1 => 2048 * (1 + rng.below(cells)) - 1,
            _ => rng.below(2048 * cells),
        };
        place.cast_signed() as i64
    })
}

#[test]
fn bounds_in_units_are_those_of_the_stored_numbers_and_no_wider_than_said() {
    for (bytes, seed) in lattices() {
        let (field, mut rng) = (Sdf::open(&bytes).expect("opens"), Rng::new(seed));
        for _ in 0..2000 {
            let place = place(&mut rng, &field);
            let [low, high, loss] = stored(&field, place);
            let found = field.distance_in_units(place.map(|x| x as i32)).expect("in the field");
            let cut = |x: i128| if field.kind() == SdfKind::Signed { x } else { x.max(0) };
            let [lower, upper] = [found.lower, found.upper].map(|x| i128::from(x) << 33);
            assert!(lower <= cut(low) && lower >= cut(low - loss), "{place:?} {found:?}");
            assert!(upper <= cut(high) && upper >= cut(high - loss), "{place:?} {found:?}");
        }
    }
}

#[test]
fn the_interval_of_a_point_contains_that_of_every_place_that_rounding_may_reach() {
    for (bytes, seed) in lattices() {
        let (field, mut rng) = (Sdf::open(&bytes).expect("opens"), Rng::new(seed));
        let [least, greatest] = field.bounds();
        let header = field.header();
        for _ in 0..2000 {
            let point: [f32; 3] = std::array::from_fn(|k| rng.range(least[k], greatest[k]));
            let Ok(whole) = field.units_of(point) else { continue };
            for k in 0..3 {
                // The point's place in real arithmetic, half a unit off the origin.
                let from = f64::from(point[k]) - f64::from(header.origin[k]);
                let exact = from * f64::from(header.per_unit) - 0.5;
                assert!((exact - f64::from(whole[k])).abs() <= 0.5 + 0.0625, "{point:?}");
            }
            let units = field.distance_in_units(whole).expect("in the field");
            let found = field.distance(point).expect("finite").distance;
            let unit = 1.0 / f64::from(header.per_unit);
            let [lower, upper] = [found.lower, found.upper].map(f64::from);
            let [below, above] = [units.lower - 1, units.upper + 1].map(|x| f64::from(x) * unit);
            let slack = 1e-6 * (below.abs() + above.abs());
            let least = if field.kind() == SdfKind::Signed { below } else { below.max(0.0) };
            assert!(lower <= least && lower >= least - slack, "{point:?} {found:?}");
            assert!(upper >= above && upper <= above + slack, "{point:?} {found:?}");
        }
    }
}

/// A field of the distance to a ball, exact at corners but for the rounding of codes: its errors are
/// so large that they hold for certain.
fn ball(unit: f32, origin: [f32; 3]) -> Vec<u8> {
    let mut header = fields::header(&mut Rng::new(0), SdfKind::Signed, [12; 3], unit);
    header.origin = origin;
    (header.base, header.step) = (-8 * 2048, 128);
    // A code is a sixteenth of a cell; a cell's diagonal is more than all errors.
    (header.low, header.high) = ([4096; 16], [4096; 16]);
    let mut section = header.write().to_vec();
    for k in 0..13usize.pow(3) {
        let at = [k % 13, k / 13 % 13, k / 169].map(|x| x as f64 - 6.0);
        let far = at.iter().map(|x| x * x).sum::<f64>().sqrt() - 3.0;
        section.push(((far + 8.0) * 16.0).round() as u8);
    }
    section.extend([0; 1728]);
    fields::blob(section)
}

/// The ball's distance from a point, in units, in f64.
fn of_ball(field: &Sdf<'_>, point: [f32; 3]) -> f64 {
    let header = field.header();
    let from = |k: usize| {
        let from = f64::from(point[k]) - f64::from(header.origin[k]);
        from * f64::from(header.per_unit) - 0.5 - 6.0 * 2048.0
    };
    (0..3).map(|k| from(k).powi(2)).sum::<f64>().sqrt() - 3.0 * 2048.0
}

#[test]
fn intervals_of_a_ball_hold_within_the_field_and_outside_at_any_scale_and_place() {
    for scale in EXTREME_SCALES.into_iter().filter(|scale| (1e-30..=1e30).contains(scale)) {
        for origin in [[0.0; 3], [-3.0, 70.0, 1e4]] {
            let bytes = ball(scale / 2048.0, origin.map(|x: f32| x * scale));
            let (field, mut rng) = (Sdf::open(&bytes).expect("opens"), Rng::new(7));
            let unit = 1.0 / f64::from(field.header().per_unit);
            for round in 0..3000 {
                let reach = [13.0, 40.0, 1e3, 1e7][round % 4] * scale;
                let point: [f32; 3] =
                    std::array::from_fn(|k| field.header().origin[k] + rng.range(-reach, reach));
                let truth = of_ball(&field, point) * unit;
                let found = field.distance(point).expect("finite");
                let [lower, upper] = [found.distance.lower, found.distance.upper].map(f64::from);
                assert!(lower <= truth && truth <= upper, "{point:?} {found:?} {truth}");
                assert!(upper - lower <= 2e4 * unit + 1e-4 * truth.abs(), "{point:?} {found:?}");
                match found.side {
                    Side::Outside => assert!(truth > 0.0),
                    Side::Inside => assert!(truth < 0.0),
                    _ => assert!(truth.abs() < 2e4 * unit),
                }
            }
        }
    }
}

#[test]
fn lower_ends_are_numbers_where_f32_ends() {
    let bytes = ball((1u128 << 99) as f32, [0.0; 3]);
    let field = Sdf::open(&bytes).expect("opens");
    for x in [3e38, -3e38, 1e37, f32::MAX] {
        for point in [[x; 3], [x, 0.0, 0.0], [x, -x, x]] {
            let truth = of_ball(&field, point) / f64::from(field.header().per_unit);
            let found = field.distance(point).expect("finite").distance;
            assert!(f64::from(found.lower) <= truth, "{point:?} {found:?}");
            assert!(truth <= f64::from(found.upper), "{point:?} {found:?}");
        }
    }
    // A unit so large that a bound within the field would overflow.
    assert!(Sdf::open(&fields::any(1, SdfKind::Signed, [2; 3], (1u128 << 125) as f32)).is_err());
}

#[test]
fn bounds_in_units_of_a_ball_hold_outside_of_the_field() {
    let bytes = ball(0.25, [0.0; 3]);
    let (field, mut rng) = (Sdf::open(&bytes).expect("opens"), Rng::new(3));
    for round in 0..10_000 {
        let reach = [30_000, 100_000, 1 << 28][round % 3];
        let place = [0; 3].map(|_| {
            let from = rng.below(2 * reach + 1) as u32;
            from.cast_signed() - (reach as u32).cast_signed()
        });
        let centre = 6.0 * 2048.0;
        let square = place.iter().map(|&x| (f64::from(x) - centre).powi(2)).sum::<f64>();
        let truth = square.sqrt() - 3.0 * 2048.0;
        let found = field.distance_in_units(place).expect("in the domain");
        let [lower, upper] = [found.lower, found.upper].map(f64::from);
        assert!(lower <= truth && truth <= upper, "{place:?} {found:?} {truth}");
        assert!(upper <= 2.0 * truth.abs() + 2e4 && lower >= 0.57 * truth - 2e4, "{place:?}");
    }
}

#[test]
fn gradients_are_those_of_the_trilinear_function() {
    for (bytes, seed) in lattices() {
        let (field, mut rng) = (Sdf::open(&bytes).expect("opens"), Rng::new(seed));
        let step = f64::from(field.header().step);
        for _ in 0..500 {
            let place = place(&mut rng, &field);
            let slopes = field.gradient_in_units(place.map(|x| x as i32)).expect("in the field");
            for k in 0..3 {
                // Trilinear along an axis: the difference of two places of one cell is exact.
                let [mut low, mut high] = [place; 2];
                low[k] -= low[k] % 2048;
                high[k] = low[k] + 2047;
                let rise = trilinear(&field, high).0 - trilinear(&field, low).0;
                let slope = rise as f64 / (2047.0 * (1u64 << 33) as f64) * step;
                let found = f64::from(slopes[k]) / 32_768.0;
                assert!((found - slope).abs() <= 1e-3 * step / 8.0 + 1e-4, "{slope} {found}");
            }
        }
    }
}

#[test]
fn gradients_of_a_ball_lead_away_from_it_within_the_field_and_outside() {
    let bytes = ball(0.5, [10.0; 3]);
    let (field, mut rng) = (Sdf::open(&bytes).expect("opens"), Rng::new(11));
    let header = field.header();
    for _ in 0..3000 {
        let reach = [6000.0, 30_000.0][rng.below(2)];
        let from: [f32; 3] = std::array::from_fn(|_| rng.range(-reach, reach));
        let point = from.map(|x| 10.0 + (x + 6.0 * 2048.0) * header.unit);
        let length = from.iter().map(|x| x * x).sum::<f32>().sqrt();
        if length < 4096.0 {
            continue;
        }
        let (found, gradient) = field.distance_and_gradient(point).expect("finite");
        assert_eq!(Ok(found), field.distance(point));
        let along: f32 = (0..3).map(|k| from[k] * gradient[k]).sum::<f32>() / length;
        assert!((0.75..=1.25).contains(&along), "{from:?} {gradient:?}");
    }
}

#[test]
fn questions_that_cannot_be_answered_are_typed_errors() {
    let bytes = ball(1.0, [0.0; 3]);
    let field = Sdf::open(&bytes).expect("opens");
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for axis in 0..3 {
            let mut point = [5.0; 3];
            point[axis] = bad;
            let refused = Some(QueryError::NotFinite);
            assert_eq!(field.distance(point).err(), refused);
            assert_eq!(field.units_of(point).err(), refused);
            assert_eq!(field.distance_and_gradient(point).err(), refused);
            assert_eq!(field.within(point, 1.0).err(), refused);
        }
    }
    assert_eq!(field.distance([1e30, 0.0, 0.0]).err(), Some(QueryError::OutOfDomain));
    assert_eq!(field.units_of([-1.0, 0.0, 0.0]).err(), Some(QueryError::OutOfDomain));
    for distance in [-1.0, f32::NAN, f32::INFINITY] {
        assert_eq!(field.within([5.0; 3], distance).err(), Some(QueryError::Tolerance));
    }
    let far = [1 << 29, 0, 0];
    assert_eq!(field.distance_in_units(far).err(), Some(QueryError::OutOfDomain));
    assert_eq!(field.distance_in_units([0, i32::MIN, 0]).err(), Some(QueryError::OutOfDomain));
    assert_eq!(field.gradient_in_units([-1, 0, 0]).err(), Some(QueryError::OutOfDomain));
}
