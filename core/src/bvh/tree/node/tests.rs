//! Both forms of a node's test give the same children the same keys.

use super::frame::KeyPoint;
use super::keys::{CHILD_MASK, NO_CHILD, TakenLeast, least_key, take_least};
use super::opened_node::OpenedNode;
use super::slab_planes::SlabPlanes;
use super::slab_ray::SlabRay;
use super::{box_lanes, entry_lanes, integer_entries, two_in_word};
use crate::bvh::tree::format::layout::{BOXES_BYTES, FRAME_BYTES, ROW_BITS, boxes};
use crate::geom::fan::WIDTH;
use crate::query::ScratchEntry;
use glam::Vec3;
use heapless::Vec;

/// SplitMix64.
pub(super) struct Noise(pub(super) u64);

impl Noise {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ z >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ z >> 31
    }

    pub(super) fn below(&mut self, count: u64) -> u64 {
        self.bits() % count
    }

    /// From −1 to 1; now and then a round number.
    fn unit(&mut self) -> f32 {
        match self.below(8) {
            0 => self.below(3) as f32 - 1.0,
            _ => (self.bits() >> 40) as f32 / (1u64 << 23) as f32 - 1.0,
        }
    }

    pub(super) fn vector(&mut self, size: f32) -> [f32; 3] {
        [(); 3].map(|()| size * self.unit())
    }

    /// Boxes of `count` children, the other lanes as the builder leaves them.
    fn planes(&mut self, count: usize) -> [[u8; WIDTH]; 6] {
        let mut rows =
            [[255, 0], [255, 0], [255, 0]].map(|[low, high]| [[low; WIDTH], [high; WIDTH]]);
        for [low, high] in &mut rows {
            for lane in 0..count {
                let (a, b) = (self.below(256) as u8, self.below(256) as u8);
                (low[lane], high[lane]) =
                    if self.below(9) == 0 { (a, a) } else { (a.min(b), a.max(b)) };
            }
        }
        let [[a, b], [c, d], [e, f]] = rows;
        [a, b, c, d, e, f]
    }
}

fn put(record: &mut [u8], at: usize, words: &[f32]) {
    for (slot, word) in record[at..].chunks_mut(4).zip(words) {
        slot.copy_from_slice(&word.to_le_bytes());
    }
}

/// A node's record: boxes of `count` children, an arbitrary matrix, origin and exponents.
fn random_frame(noise: &mut Noise, count: usize) -> [u8; FRAME_BYTES] {
    let mut record = [0u8; FRAME_BYTES];
    let mut planes = noise.planes(count);
    // High planes are counted down.
    planes.iter_mut().skip(1).step_by(2).flatten().for_each(|byte| *byte = 255 - *byte);
    record[..boxes::FRAME_ROWS].copy_from_slice(planes.as_flattened());
    for entry in record[boxes::FRAME_ROWS..boxes::FRAME_ORIGIN].chunks_mut(2) {
        let whole = noise.unit() * 4_700.0;
        entry.copy_from_slice(&(whole as i16).to_le_bytes());
    }
    for x in record[boxes::FRAME_ORIGIN..boxes::FRAME_EXPONENTS].chunks_mut(2) {
        x.copy_from_slice(&(noise.below(65_536) as u16).to_le_bytes());
    }
    record[boxes::FRAME_EXPONENTS..][..3].fill_with(|| noise.below(10) as u8);
    record
}

#[test]
fn distances_have_the_same_bits() {
    let mut noise = Noise(1);
    for _ in 0..100_000 {
        let count = 1 + noise.below(8) as usize;
        let mut record = random_frame(&mut noise, count);
        if noise.below(4) == 0 {
            // Planes out of order, as no builder writes them.
            record[..boxes::FRAME_ROWS].fill_with(|| noise.bits() as u8);
        }
        let away = 2f32.powi(noise.below(30) as i32);
        for size in [away, 30_000.0, 1e-3] {
            let p = Vec3::from_array(noise.vector(size)) + Vec3::splat(30_000.0);
            let farthest = (p.abs().max_element() + 65_536.0).max(65_535.0);
            let point = KeyPoint::new(p, farthest);
            for parent in [0, 1 << noise.below(31)] {
                let [mut wide, mut narrow] = [[0; WIDTH]; 2];
                box_lanes::keys(&record, &point, count as u32, parent, &mut wide);
                two_in_word::keys(&record, &point, count as u32, parent, &mut narrow);
                let used = |keys: [u32; WIDTH]| keys.map(|key| key.min(NO_CHILD));
                assert_eq!(used(wide), used(narrow), "{point:?}, {count} of {record:?}");
            }
        }
    }
}

#[test]
fn exactly_the_children_within_the_limit_are_pushed_in_order() {
    let mut noise = Noise(4);
    let (mut wanted, mut unwanted) = (0, 0);
    for _ in 0..100_000 {
        let count = 1 + noise.below(8) as u32;
        let record = random_frame(&mut noise, count as usize);
        let size = 2f32.powi(noise.below(24) as i32);
        let p = Vec3::from_array(noise.vector(size)) + Vec3::splat(30_000.0);
        let point = KeyPoint::new(p, (p.abs().max_element() + 65_536.0).max(65_535.0));
        let mut keys = [0; WIDTH];
        box_lanes::keys(&record, &point, count, 0, &mut keys);
        let middle = keys[noise.below(u64::from(count)) as usize];
        for bound in [0, middle & !CHILD_MASK] {
            box_lanes::keys(&record, &point, count, bound, &mut keys);
            for limit in [bound, middle, middle + 64, NO_CHILD - 1] {
                let limit = limit | CHILD_MASK;
                let opened = OpenedNode { node: 5, count, bound, limit };
                let mut slots = [ScratchEntry::EMPTY; WIDTH];
                let pushed = two_in_word::push(&record, &point, &opened, &mut slots);
                let mut within: Vec<u32, WIDTH> =
                    keys.into_iter().filter(|&key| key <= limit).collect();
                unwanted += count as usize - within.len();
                wanted += within.len();
                let nearest = within.iter().copied().min();
                within.retain(|&key| Some(key) != nearest);
                assert_eq!(pushed.nearest, nearest.unwrap_or(NO_CHILD), "{point:?}, {record:?}");
                let entries = &slots[..pushed.count];
                assert!(entries.iter().all(|entry| entry.node() == 5));
                let entries: Vec<u32, WIDTH> =
                    entries.iter().map(|entry| entry.key_bits()).collect();
                assert_eq!(entries, within, "{point:?}, {count} of {record:?}");
            }
        }
    }
    assert!(wanted > 100_000 && unwanted > 100_000, "{wanted} {unwanted}");
}

#[test]
fn the_least_key_is_taken_whatever_stands_where_there_is_no_child() {
    let mut noise = Noise(4);
    for _ in 0..100_000 {
        let mut keys = [(); WIDTH].map(|()| noise.bits() as u32 >> 1 >> noise.below(31));
        let count = noise.below(9) as usize;
        for (child, key) in keys.iter_mut().enumerate() {
            // Bits of NaN among them: the kernels leave any bound in a lane without a child.
            *key = *key & !7 | child as u32 | if child < count { 0 } else { NO_CHILD };
        }
        let limit = noise.bits() as u32 >> 1 >> noise.below(31);
        let least = keys.into_iter().min().expect("eight");
        let rest = keys.map(|key| if key == least { NO_CHILD } else { key });
        let has_more = rest.iter().any(|&key| key <= limit);
        assert_eq!(least_key(&keys), least, "{keys:x?}");
        let taken = take_least(&keys, limit);
        assert_eq!(taken, TakenLeast { least, rest, has_more }, "{keys:x?}, {limit:x}");
    }
}

/// The distance of a point from a child's box along one axis, in key units, as the proof has it.
fn exact_distance(
    record: &[u8; FRAME_BYTES],
    p: [f64; 3],
    unit_exponent: u32,
    axis: usize,
    lane: usize,
) -> f64 {
    let entry = |k: usize| {
        let at = boxes::FRAME_ROWS + 2 * (3 * axis + k);
        f64::from(i16::from_le_bytes([record[at], record[at + 1]])) / f64::from(1 << ROW_BITS)
    };
    let origin = |k: usize| {
        let at = boxes::FRAME_ORIGIN + 2 * k;
        f64::from(u16::from_le_bytes([record[at], record[at + 1]]))
    };
    let at: f64 = (0..3).map(|k| entry(k) * (p[k] - origin(k))).sum();
    let step = 2f64.powi(i32::from(record[boxes::FRAME_EXPONENTS + axis]));
    let low = (f64::from(record[16 * axis + lane]) - 128.0) * step;
    let high = (127.0 - f64::from(record[16 * axis + 8 + lane])) * step;
    (low - at).max(at - high).max(0.0) / 2f64.powi(unit_exponent.cast_signed())
}

#[test]
fn no_key_is_above_the_exact_distance_and_few_are_far_below() {
    let mut noise = Noise(3);
    let mut short = 0f64;
    for _ in 0..100_000 {
        let record = random_frame(&mut noise, 8);
        let away = 2f32.powi(noise.below(24) as i32);
        let p = Vec3::from_array(noise.vector(away)) + Vec3::splat(30_000.0);
        let farthest = p.abs().max_element().max(65_535.0 - p.min_element()).max(65_535.0);
        let point = KeyPoint::new(p, farthest);
        let mut keys = [0; WIDTH];
        box_lanes::keys(&record, &point, 8, 0, &mut keys);
        for (lane, key) in keys.into_iter().enumerate() {
            let exact: [f64; 3] = core::array::from_fn(|axis| {
                exact_distance(
                    &record,
                    p.to_array().map(f64::from),
                    point.unit_exponent(),
                    axis,
                    lane,
                )
            });
            let square: f64 = exact.iter().map(|x| x * x).sum();
            assert!(f64::from(key & !7) <= square / 2.0, "{key} {square}: {p}, {record:?}");
            if exact.iter().all(|&x| x < 32_000.0) {
                // Three units an axis, and the low bits of the key.
                let root = libm::sqrt(2.0 * f64::from(key & !7) + 16.0);
                short = short.max(libm::sqrt(square) - root);
            }
        }
    }
    assert!(short < 6.0, "{short}");
}

#[test]
fn entries_have_the_same_bits() {
    let mut noise = Noise(2);
    let (mut entered, mut missed) = (0, 0);
    for _ in 0..100_000 {
        let count = 1 + noise.below(8) as usize;
        let mut record = [0u8; BOXES_BYTES];
        record[..boxes::ORIGIN].copy_from_slice(noise.planes(count).as_flattened());
        let steps = [(); 3].map(|()| 2f32.powi(noise.below(12) as i32 - 4));
        let origin = noise.vector(100.0);
        put(&mut record, boxes::ORIGIN, &origin);
        put(&mut record, boxes::STEPS, &steps);
        let size = 2f32.powi(noise.below(16) as i32);
        let (from, mut direction) = (noise.vector(size), noise.vector(2.0 * size));
        // Some are steep along an axis.
        if noise.below(4) == 0 {
            direction[noise.below(3) as usize] *= [0.0, 1e-5, 1e-3][noise.below(3) as usize];
        }
        let still = crate::num::tolerance::STILL;
        let inverse = direction.map(|d| 1.0 / if d.abs() > still { d } else { still.copysign(d) });
        let margin = [[1e-6; 3], [1.0; 3], [1e3; 3]][noise.below(3) as usize];
        let ray = SlabRay::new(from, inverse, margin, from.map(|x| x.abs() + 600.0));
        for (bound, limit) in [(0.0, 1.0), (0.25, 1.0), (0.0, 0.5), (0.5, 0.25), (1.0, 1.0)] {
            let planes = SlabPlanes::of(&record, &ray).expect("long enough");
            let wide =
                entry_lanes::keys(&record, &ray, count as u32, bound, limit).expect("eight rows");
            let [bound, limit] = [bound, limit].map(f32::to_bits);
            let narrow = planes.keys(count as u32, [bound, limit]);
            for (lane, (wide, narrow)) in wide.into_iter().zip(narrow).enumerate() {
                if narrow < NO_CHILD {
                    entered += 1;
                    assert_eq!(wide, narrow, "{ray:?}, {count} of {record:?}");
                    assert_eq!(narrow & 7, lane as u32);
                } else {
                    missed += 1;
                    // A key that is not a number would hide its siblings.
                    assert!(wide >= NO_CHILD, "{wide}: {ray:?}, {record:?}");
                }
            }
            let opened = OpenedNode { node: 3, count: count as u32, bound, limit };
            let mut slots = [ScratchEntry::EMPTY; WIDTH];
            let pushed = integer_entries::push(&planes, &ray, &opened, &mut slots);
            let nearest = narrow.into_iter().min().unwrap_or(NO_CHILD);
            assert_eq!(pushed.nearest, nearest, "{ray:?}, {count} of {record:?}");
            let others = narrow.into_iter().filter(|&key| key < NO_CHILD && key != nearest);
            let entries = slots[..pushed.count].iter().map(|entry| entry.key_bits());
            assert!(others.eq(entries), "{ray:?}, {count} of {record:?}");
        }
    }
    assert!(entered > 100_000 && missed > 100_000, "{entered} {missed}");
}
