//! The look-up in a tree, beside its stored numbers in exact arithmetic.

use meshsweep_core::internal::sdf::format::layout::tree;
use meshsweep_core::{QueryError, Sdf, SdfKind, SdfLayout, Side};
use meshsweep_host_tests::generate::{Rng, fields};

/// A leaf: its box, and its 40 bits.
struct Leaf {
    low: [i64; 3],
    side: [i64; 3],
    bits: u64,
    /// Entries from the root to it.
    steps: u32,
}

impl Leaf {
    /// The leaf at a place, by halving boxes.
    fn at(field: &Sdf<'_>, place: [i64; 3]) -> Self {
        let [nx, ny, _] = field.cells().map(i64::from);
        let root = place.map(|x| x / 65_536);
        let mut number = (root[0] + nx * (root[1] + ny * root[2])) as usize;
        let (mut low, mut side) = (root.map(|x| x * 65_536), [65_536; 3]);
        let mut steps = 1;
        loop {
            let [a, b, c, kind, e] = field.entries()[number];
            if kind >= 128 {
                let bits = u64::from_le_bytes([a, b, c, kind, e, 0, 0, 0]);
                return Self { low, side, bits, steps };
            }
            let (mut child, mut bit) = (0, 1);
            for axis in 0..3 {
                if kind >> axis & 1 == 1 {
                    side[axis] /= 2;
                    if place[axis] >= low[axis] + side[axis] {
                        low[axis] += side[axis];
                        child += bit;
                    }
                    bit *= 2;
                }
            }
            number += 1 + usize::from(a) + 256 * usize::from(b) + child;
            steps += 1;
        }
    }

    fn signed(&self, at: u32) -> i128 {
        let bits = (self.bits >> at & 63) as i128;
        if bits < 32 { bits } else { bits - 64 }
    }

    fn gradient(&self) -> [i128; 3] {
        [self.signed(0), self.signed(6), self.signed(12)]
    }

    fn width(&self, field: &Sdf<'_>) -> i32 {
        let header = field.header();
        let number = (self.bits >> 24 & 31) as usize;
        i32::from(if number < 16 { header.low[number] } else { header.high[number - 16] })
    }

    /// Twice the way from the centre.
    fn twice_way(&self, place: [i64; 3]) -> [i128; 3] {
        std::array::from_fn(|k| i128::from(2 * (place[k] - self.low[k]) - self.side[k]))
    }

    fn largest(&self) -> i128 {
        i128::from(*self.side.iter().max().expect("three")) / 2
    }

    /// The function above the base, times 2^26 and the largest half side.
    fn value(&self, field: &Sdf<'_>, place: [i64; 3]) -> i128 {
        let (twice, g, m) = (self.twice_way(place), self.gradient(), self.largest());
        let code = i128::from((self.bits >> 29 & 3) | (self.bits >> 32 & 255) << 2);
        let along: i128 = (0..3).map(|k| g[k] * twice[k]).sum();
        let square: i128 = twice.iter().map(|x| x * x).sum();
        // Times 2048 m.
        let plane = 2048 * m * code * i128::from(field.header().step) + 1024 * m * along;
        let bend = self.signed(18) * (1024 * square - along * along) / 4;
        (plane + bend) * 1057
    }
}

pub fn trees() -> impl Iterator<Item = (Vec<u8>, u64)> {
    let shapes = [([1, 1, 1], 0), ([1, 2, 3], 30), ([4, 3, 2], 800), ([7, 1, 7], 5000)];
    (0..).zip(shapes).flat_map(|(k, (roots, leaves))| {
        SdfKind::ALL.into_iter().map(move |kind| {
            let seed = 8 * k + kind as u64;
            (fields::any_tree(seed, kind, roots, leaves, 0.001 * (k + 1) as f32), seed)
        })
    })
}

fn place(rng: &mut Rng, field: &Sdf<'_>) -> [i64; 3] {
    field.cells().map(|cells| {
        let size = 65_536 * i64::from(cells);
        // Sides of boxes too.
        match rng.below(4) {
            0 => 512 * (rng.below(size as usize / 512) as u64).cast_signed(),
            1 => 512 * (1 + rng.below(size as usize / 512) as u64).cast_signed() - 1,
            _ => (rng.below(size as usize) as u64).cast_signed(),
        }
    })
}

#[test]
fn bounds_in_units_are_those_of_the_stored_leaf_but_for_the_loss_that_is_said() {
    for (bytes, seed) in trees() {
        let (field, mut rng) = (Sdf::open(&bytes).expect("opens"), Rng::new(seed));
        let mut deepest = 0;
        for _ in 0..3000 {
            let place = place(&mut rng, &field);
            let leaf = Leaf::at(&field, place);
            deepest = deepest.max(leaf.steps);
            let one = leaf.largest() << 26;
            let exact = leaf.value(&field, place) + i128::from(field.header().base) * one;
            let level = (65_536 / leaf.side.iter().max().expect("three")).ilog2();
            let [below, above] = tree::loss(leaf.signed(18) as i32, level)
                .map(|loss| i128::from(loss) * (leaf.largest() << 16));
            let found = field.distance_in_units(place.map(|x| x as i32)).expect("in the field");
            let is_cut = field.kind() != SdfKind::Signed;
            let cut = |x: i128| if is_cut { x.max(0) } else { x };
            let [lower, upper] = [found.lower, found.upper].map(|x| i128::from(x) * one);
            assert!(lower <= cut(exact + above), "{place:?} {found:?} {exact} {above}");
            assert!(lower >= cut(exact - below), "{place:?} {found:?} {exact} {below}");
            let width = i128::from(leaf.width(&field)) * one;
            assert!(upper <= cut(exact + above + width) && upper >= cut(exact - below + width));
            if lower > 0 {
                assert_eq!(found.upper - found.lower, leaf.width(&field));
            }
        }
        assert!(deepest <= field.steps(), "{deepest}");
        assert_eq!(field.layout(), SdfLayout::Tree);
    }
}

#[test]
fn steps_are_those_of_the_deepest_leaf() {
    for (bytes, _) in trees() {
        let field = Sdf::open(&bytes).expect("opens");
        // A node stands before its children.
        let mut depth = vec![1; field.entries().len()];
        for (number, &[a, b, _, kind, _]) in field.entries().iter().enumerate() {
            let first = number + 1 + usize::from(a) + 256 * usize::from(b);
            let count = if kind < 128 { 1 << kind.count_ones() } else { 0 };
            for child in first..first + count {
                depth[child] = depth[number] + 1;
            }
        }
        assert_eq!(Some(field.steps()), depth.into_iter().max());
    }
    let lattice = fields::any(1, SdfKind::Signed, [2, 3, 4], 1.0);
    assert_eq!(Sdf::open(&lattice).expect("opens").steps(), 1);
}

#[test]
fn the_interval_of_a_point_contains_that_of_its_place() {
    for (bytes, seed) in trees() {
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
            let (found, gradient) = field.distance_and_gradient(point).expect("finite");
            assert_eq!(Ok(found), field.distance(point));
            let slopes = field.gradient_in_units(whole).expect("in the field");
            assert_eq!(gradient, slopes.map(|slope| slope as f32 / 32_768.0));
            let unit = 1.0 / f64::from(header.per_unit);
            let [lower, upper] = [found.distance.lower, found.distance.upper].map(f64::from);
            let [below, above] = [units.lower - 1, units.upper + 1].map(|x| f64::from(x) * unit);
            let slack = 1e-6 * (below.abs() + above.abs());
            let least = if field.kind() == SdfKind::Signed { below } else { below.max(0.0) };
            assert!(lower <= least && lower >= least - slack, "{point:?} {found:?}");
            assert!(upper >= above && upper <= above + slack, "{point:?} {found:?}");
        }
    }
}

#[test]
fn gradients_are_those_of_the_leaf() {
    for (bytes, seed) in trees() {
        let (field, mut rng) = (Sdf::open(&bytes).expect("opens"), Rng::new(seed));
        for _ in 0..1000 {
            let place = place(&mut rng, &field);
            let leaf = Leaf::at(&field, place);
            let slopes = field.gradient_in_units(place.map(|x| x as i32)).expect("in the field");
            for k in 0..3 {
                // A function of the second order: the difference of both neighbours is exact.
                let [mut low, mut high] = [place; 2];
                (low[k], high[k]) = (low[k] - 4, high[k] + 4);
                let rise = leaf.value(&field, high) - leaf.value(&field, low);
                let slope = rise as f64 / (leaf.largest() << 26) as f64 / 8.0;
                let found = f64::from(slopes[k]) / 32_768.0;
                assert!((found - slope).abs() <= 0.01 * (1.0 + slope.abs()), "{slope} {found}");
            }
        }
    }
}

/// A tree of one leaf: the distance above a plane at half the height of the field, and up to
/// 8192 units more.
fn above_a_plane(kind: SdfKind) -> Vec<u8> {
    let mut header = fields::header(&mut Rng::new(1), kind, [1; 3], 0.5);
    (header.layout, header.steps, header.origin) = (SdfLayout::Tree, 1, [10.0; 3]);
    (header.base, header.step, header.low) = (-100, 1, [8192; 16]);
    let mut section = header.write().to_vec();
    let word = 31u32 << 12 | 1 << 31;
    section.extend(word.to_le_bytes());
    section.push(0);
    fields::blob(section)
}

#[test]
fn a_place_outside_of_a_tree_is_as_far_as_its_nearest_place_and_the_way_to_it_allow() {
    for kind in SdfKind::ALL {
        let bytes = above_a_plane(kind);
        let field = Sdf::open(&bytes).expect("opens");
        let mut rng = Rng::new(4);
        for _ in 0..3000 {
            let place = [0; 3].map(|_| (rng.below(400_000) as u32).cast_signed() - 200_000);
            let near = place.map(|x| x.clamp(0, 65_535));
            let beyond: Vec<i32> = (0..3).map(|k| (place[k] - near[k]).abs()).collect();
            let [most, sum] = [*beyond.iter().max().expect("three"), beyond.iter().sum()];
            let (found, at) = (field.distance_in_units(place), field.distance_in_units(near));
            let (found, at) = (found.expect("in the domain"), at.expect("in the field"));
            if sum == 0 {
                continue;
            }
            assert_eq!(found.lower, (at.lower - 2).max(most - 1));
            assert_eq!(found.upper, at.upper.max(0) + sum);
            assert_eq!(field.gradient_in_units(place), Err(QueryError::OutOfDomain));
            let point = place.map(|x| 10.0 + 0.5 * x as f32);
            let (told, gradient) = field.distance_and_gradient(point).expect("finite");
            assert_eq!(Ok(told), field.distance(point));
            assert!(told.distance.lower <= told.distance.upper);
            assert!(told.distance.upper >= 0.5 * (at.upper.max(0) + most) as f32);
            let length: f32 = gradient.iter().map(|x| x * x).sum();
            assert!(length <= 1.001, "{gradient:?}");
        }
        let up = field.distance([26_394.0, 26_394.0, 40_000.0]).expect("finite");
        assert!(kind == SdfKind::Surface || up.side == Side::Outside, "{up:?}");
    }
}
