//! Where the queries are put: points and segments around a model's bounding box.
//!
//! Coordinates come from the integers of [`Rng`] through one addition and one multiplication an
//! axis. Rust never contracts these to a fused multiply-add, so the query's bits are the same
//! everywhere too.

use crate::rng::Rng;

/// An axis-aligned box: least corner, greatest corner.
pub type Bounds = [[f32; 3]; 2];

/// A point, or a direction.
pub type Point = [f32; 3];

/// A segment's ends.
pub type Ends = [Point; 2];

/// A rotation matrix, by rows and up to rounding, and what is added after it.
pub type Motion = ([[f32; 3]; 3], [f32; 3]);

/// Where queries are put.
pub trait Place {
    /// A point anywhere.
    fn far(&mut self) -> Point;

    /// A point near another.
    fn near(&mut self, base: Point) -> Point;

    /// The next point of a path.
    fn step(&mut self) -> Point;

    /// The next point of a path that seldom jumps.
    fn step_or_jump(&mut self) -> Point;

    /// A segment.
    fn segment(&mut self) -> Ends;

    /// A motion.
    fn motion(&mut self) -> Motion;

    /// A distance.
    fn distance(&mut self) -> f32;

    /// A number from -1 to 1.
    fn share(&mut self) -> f32;

    /// Any number.
    fn word(&mut self) -> u32;
}

/// Places around a box, from a stream of numbers.
#[derive(Clone, Debug)]
pub struct Placer {
    rng: Rng,
    bounds: Bounds,
    /// Where the path is.
    here: Point,
}

impl Placer {
    /// A placer around a box.
    #[must_use]
    pub fn new(seed: u64, bounds: Bounds) -> Self {
        let mut rng = Rng::new(seed);
        let here = far_point(&mut rng, &bounds);
        Self { rng, bounds, here }
    }

    /// The stream of numbers.
    pub const fn rng(&mut self) -> &mut Rng {
        &mut self.rng
    }
}

impl Place for Placer {
    /// See [`far_point`].
    fn far(&mut self) -> Point {
        far_point(&mut self.rng, &self.bounds)
    }

    /// See [`near_point`].
    fn near(&mut self, base: Point) -> Point {
        near_point(&mut self.rng, &self.bounds, base)
    }

    /// See [`path_point`].
    fn step(&mut self) -> Point {
        self.here = path_point(&mut self.rng, &self.bounds, self.here);
        self.here
    }

    /// A step, one time in 128 anywhere.
    fn step_or_jump(&mut self) -> Point {
        if self.rng.next_u32() & 0x7F == 0 {
            self.here = self.far();
            return self.here;
        }
        self.step()
    }

    /// See [`segment`].
    fn segment(&mut self) -> Ends {
        segment(&mut self.rng, &self.bounds)
    }

    /// See [`motion`].
    fn motion(&mut self) -> Motion {
        motion(&mut self.rng, &self.bounds)
    }

    /// See [`distance`].
    fn distance(&mut self) -> f32 {
        distance(&mut self.rng, &self.bounds)
    }

    fn share(&mut self) -> f32 {
        self.rng.signed_unit()
    }

    fn word(&mut self) -> u32 {
        self.rng.next_u32()
    }
}

/// A point in the box, inflated to twice its size about its centre: seven eighths of them are
/// outside.
pub fn far_point(rng: &mut Rng, bounds: &Bounds) -> [f32; 3] {
    core::array::from_fn(|axis| {
        let (centre, half) = centre_and_half(bounds, axis);
        centre + 2.0 * half * rng.signed_unit()
    })
}

/// A point at most 1/64 of the box's half size from `base` on each axis: near the surface where
/// `base` is on it.
pub fn near_point(rng: &mut Rng, bounds: &Bounds, base: [f32; 3]) -> [f32; 3] {
    offset(rng, bounds, base, 1.0 / 64.0)
}

/// The next point of a path: a step of at most 1/4096 of the half size on each axis.
pub fn path_point(rng: &mut Rng, bounds: &Bounds, previous: [f32; 3]) -> [f32; 3] {
    offset(rng, bounds, previous, 1.0 / 4096.0)
}

/// A segment with both ends on the surface of the box of twice the size.
pub fn segment(rng: &mut Rng, bounds: &Bounds) -> [[f32; 3]; 2] {
    let start = surface_point(rng, bounds);
    [start, surface_point(rng, bounds)]
}

/// A distance of at most half the box's half size along x.
pub fn distance(rng: &mut Rng, bounds: &Bounds) -> f32 {
    let (_, half) = centre_and_half(bounds, 0);
    0.5 * half * rng.unit()
}

/// A rotation about the box's centre, then the centre is put anywhere in the doubled box.
pub fn motion(rng: &mut Rng, bounds: &Bounds) -> Motion {
    // A quaternion of any length but 0; no root is needed.
    let [x, y, z] = [(); 3].map(|()| rng.signed_unit());
    let w = 0.25 + rng.unit();
    let s = 2.0 / (((w * w + x * x) + y * y) + z * z);
    let rotation = [
        [1.0 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)],
        [s * (x * y + w * z), 1.0 - s * (x * x + z * z), s * (y * z - w * x)],
        [s * (x * z - w * y), s * (y * z + w * x), 1.0 - s * (x * x + y * y)],
    ];
    let centre: [f32; 3] = core::array::from_fn(|axis| centre_and_half(bounds, axis).0);
    let to = far_point(rng, bounds);
    let mut translation = [0.0; 3];
    for ((slot, [a, b, c]), to) in translation.iter_mut().zip(rotation).zip(to) {
        let [x, y, z] = centre;
        *slot = to - ((a * x + b * y) + c * z);
    }
    (rotation, translation)
}

fn surface_point(rng: &mut Rng, bounds: &Bounds) -> [f32; 3] {
    let face = rng.next_u32();
    let mut point = far_point(rng, bounds);
    let axis = [0, 1, 2, 0, 1, 2, 0, 1][(face & 7) as usize];
    let (centre, half) = centre_and_half(bounds, axis);
    point[axis] = if face & 8 == 0 { centre - 2.0 * half } else { centre + 2.0 * half };
    point
}

fn offset(rng: &mut Rng, bounds: &Bounds, base: [f32; 3], scale: f32) -> [f32; 3] {
    core::array::from_fn(|axis| {
        let (_, half) = centre_and_half(bounds, axis);
        base[axis] + scale * half * rng.signed_unit()
    })
}

fn centre_and_half(bounds: &Bounds, axis: usize) -> (f32, f32) {
    // Halved before the sum: the domain reaches so far that a sum of two corners could overflow.
    let (least, greatest) = (0.5 * bounds[0][axis], 0.5 * bounds[1][axis]);
    (least + greatest, greatest - least)
}

#[cfg(test)]
mod tests {
    use super::{Bounds, far_point, near_point, segment};
    use crate::rng::Rng;

    const BOUNDS: Bounds = [[-1.0, 2.0, -3.0], [1.0, 6.0, 5.0]];
    const DOUBLED: Bounds = [[-2.0, 0.0, -7.0], [2.0, 8.0, 9.0]];

    fn inside(point: [f32; 3], bounds: &Bounds) -> bool {
        (0..3).all(|axis| (bounds[0][axis]..=bounds[1][axis]).contains(&point[axis]))
    }

    #[test]
    fn far_points_fill_the_doubled_box() {
        let mut rng = Rng::new(7);
        let outside = (0..1000)
            .filter(|_| {
                let point = far_point(&mut rng, &BOUNDS);
                assert!(inside(point, &DOUBLED));
                !inside(point, &BOUNDS)
            })
            .count();
        assert!((825..925).contains(&outside), "{outside} of 1000 outside, where 875 are expected");
    }

    #[test]
    fn segments_end_on_the_doubled_box() {
        let mut rng = Rng::new(8);
        for _ in 0..1000 {
            let [a, b] = segment(&mut rng, &BOUNDS);
            for end in [a, b] {
                assert!(
                    (0..3)
                        .any(|axis| end[axis] == DOUBLED[0][axis] || end[axis] == DOUBLED[1][axis])
                );
                assert!(inside(end, &DOUBLED));
            }
        }
    }

    #[test]
    fn near_points_stay_near() {
        let mut rng = Rng::new(9);
        for _ in 0..1000 {
            let point = near_point(&mut rng, &BOUNDS, [0.0, 4.0, 1.0]);
            assert!((point[2] - 1.0).abs() <= 4.0 / 64.0);
        }
    }
}
