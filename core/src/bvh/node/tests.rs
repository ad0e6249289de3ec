//! Both forms of a node's test give the same children the same keys.

use super::box_entries::Slabs;
use super::frame::NodeFrame;
use super::keys::NO_CHILD;
use super::{box_distances, box_entries};
use crate::bvh::format::layout::{BOXES_BYTES, FRAME_BYTES};
use crate::geom::fan::WIDTH;
use glam::Vec3;

/// SplitMix64.
struct Noise(u64);

impl Noise {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ z >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ z >> 31
    }

    fn below(&mut self, count: u64) -> u64 {
        self.bits() % count
    }

    /// From −1 to 1; now and then a round number.
    fn unit(&mut self) -> f32 {
        match self.below(8) {
            0 => self.below(3) as f32 - 1.0,
            _ => (self.bits() >> 40) as f32 / (1u64 << 23) as f32 - 1.0,
        }
    }

    fn vector(&mut self, size: f32) -> [f32; 3] {
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

fn bits(keys: [f32; WIDTH]) -> [u32; WIDTH] {
    keys.map(f32::to_bits)
}

#[test]
fn distances_have_the_same_bits() {
    let mut noise = Noise(1);
    for _ in 0..100_000 {
        let count = 1 + noise.below(8) as usize;
        let mut record = [0u8; FRAME_BYTES];
        record[..48].copy_from_slice(noise.planes(count).as_flattened());
        let step = 2f32.powi(noise.below(12) as i32 - 4);
        let row = noise.vector(1.0 / step);
        let away = 2f32.powi(noise.below(40) as i32);
        let (origin, p) = (noise.vector(30_000.0), noise.vector(away));
        let mut rows = [0f32; 9];
        rows.iter_mut().for_each(|x| *x = row[noise.below(3) as usize]);
        put(&mut record, 48, &rows);
        put(&mut record, 84, &origin);
        put(&mut record, 96, &[step * step, step * step * 4.0, step * step * 0.25]);
        let near = Vec3::from_array(origin) + Vec3::from_array(noise.vector(200.0 * step));
        for p in [Vec3::from_array(p), near, Vec3::from_array(origin)] {
            let frame = NodeFrame::of(&record, p);
            for parent in [0.0, 1e3] {
                let wide = box_distances::wide(&record, &frame, count as u32, parent);
                let narrow = box_distances::narrow(&record, &frame, count as u32, parent);
                let used = |keys: [f32; WIDTH]| bits(keys).map(|key| key.min(NO_CHILD.to_bits()));
                assert_eq!(used(wide), used(narrow), "{frame:?}, {count} of {record:?}");
            }
        }
    }
}

#[test]
fn entries_have_the_same_bits() {
    let mut noise = Noise(2);
    let (mut entered, mut missed) = (0, 0);
    for _ in 0..100_000 {
        let count = 1 + noise.below(8) as usize;
        let mut record = [0u8; BOXES_BYTES];
        record[..48].copy_from_slice(noise.planes(count).as_flattened());
        let steps = [(); 3].map(|()| 2f32.powi(noise.below(12) as i32 - 4));
        let origin = noise.vector(100.0);
        put(&mut record, 48, &origin);
        put(&mut record, 60, &steps);
        let size = 2f32.powi(noise.below(16) as i32);
        let (from, direction) = (noise.vector(size), noise.vector(2.0 * size));
        let still = crate::num::tolerance::STILL;
        let inverse = direction.map(|d| 1.0 / if d.abs() > still { d } else { still.copysign(d) });
        let margin = [[1e-6; 3], [1.0; 3], [1e3; 3]][noise.below(3) as usize];
        let slabs = Slabs::new(from, inverse, margin);
        for (bound, limit) in [(0.0, 1.0), (0.25, 1.0), (0.0, 0.5), (0.5, 0.25), (1.0, 1.0)] {
            let sides = box_entries::SlabPlanes::of(&record, &slabs).expect("long enough");
            let wide = box_entries::wide(&sides, count as u32, bound, limit);
            let narrow = box_entries::narrow(&sides, count as u32, bound, limit);
            for (lane, (wide, narrow)) in wide.into_iter().zip(narrow).enumerate() {
                if narrow < NO_CHILD {
                    entered += 1;
                    assert_eq!(
                        wide.to_bits(),
                        narrow.to_bits(),
                        "{slabs:?}, {count} of {record:?}"
                    );
                    assert_eq!(narrow.to_bits() & 7, lane as u32);
                } else {
                    missed += 1;
                    // A key that is not a number would hide its siblings.
                    assert!(wide >= NO_CHILD, "{wide}: {slabs:?}, {record:?}");
                }
            }
        }
    }
    assert!(entered > 100_000 && missed > 100_000, "{entered} {missed}");
}
