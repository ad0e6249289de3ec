//! Whether the surface is within a distance, as a field tells it: beside the interval of the same
//! point.

use super::kernel::lattices;
use super::tree::trees;
use meshsweep_core::internal::sdf::format::layout::field;
use meshsweep_core::{Sdf, SectionKind, Verdict};
use meshsweep_host_tests::corrupt::edited;
use meshsweep_host_tests::generate::Rng;

/// Units on each side of a length within which a verdict may be open.
const OPEN: f64 = 3.0;

/// A point of the field, or of the doubled box, of which seven in eight are outside.
fn place(rng: &mut Rng, field: &Sdf<'_>) -> [f32; 3] {
    let [least, greatest] = field.bounds();
    let reach = if rng.below(2) == 0 { 0.0 } else { 0.5 };
    std::array::from_fn(|k| {
        let beyond = reach * (greatest[k] - least[k]);
        rng.range(least[k] - beyond, greatest[k] + beyond)
    })
}

/// Fields, each also with distances that are few units: those of the others are so many that a
/// distance asked about is rounded by more than a unit.
fn all() -> impl Iterator<Item = (Vec<u8>, u64)> {
    lattices().chain(trees()).flat_map(|(bytes, seed)| {
        let mut small = None;
        let base = |section: &mut [u8]| {
            let base = (Rng::new(seed).range(-2048.0, 2048.0) as i32).to_le_bytes();
            section[field::BASE..][..4].copy_from_slice(&base);
        };
        let kept: Result<(), ()> = edited(bytes.clone(), SectionKind::Sdf, base, |bytes| {
            small = Some(bytes.to_vec());
            Ok(())
        });
        assert_eq!(kept, Ok(()));
        [(bytes, seed), (small.expect("edited"), seed)]
    })
}

#[test]
fn a_verdict_is_that_of_the_interval_and_open_only_near_its_ends() {
    let (mut told, mut open) = ([0; 2], 0);
    for (bytes, seed) in all() {
        let (field, mut rng) = (Sdf::open(&bytes).expect("opens"), Rng::new(seed));
        let unit = f64::from(field.unit());
        for _ in 0..500 {
            let point = place(&mut rng, &field);
            let found = field.distance(point).expect("finite").distance;
            let [lower, upper] = [found.lower, found.upper].map(f64::from);
            // Lengths, whatever the sign.
            let (least, most) = (lower.max(-upper).max(0.0), upper.abs().max(lower.abs()));
            let near_an_end = unit * (rng.below(9) as f64 - 4.0);
            let distance = match rng.below(4) {
                0 => least + near_an_end,
                1 => most + near_an_end,
                // Of very many units.
                2 => unit * f64::from(rng.range(18.0, 33.0).exp2()),
                _ => f64::from(rng.range(0.0, 2.0)) * most,
            };
            let asked = distance.max(0.0) as f32;
            let distance = f64::from(asked);
            match field.within(point, asked).expect("finite") {
                Verdict::Yes => {
                    assert!(most <= distance, "{point:?} {asked} {found:?}");
                    told[1] += 1;
                }
                Verdict::No => {
                    assert!(least > distance, "{point:?} {asked} {found:?}");
                    told[0] += 1;
                }
                Verdict::Undecided(_) => {
                    // A long distance is rounded.
                    let room = OPEN * unit + distance / f64::from(1 << 18);
                    let (least, most) = (least - room, most + room);
                    assert!(least <= distance && most >= distance, "{point:?} {asked} {found:?}");
                    open += 1;
                }
                _ => unreachable!("a verdict"),
            }
        }
    }
    assert!(told[0] > 500 && told[1] > 500 && open > 500, "{told:?} {open}");
}
