//! Random triangles, and places around them.

use meshsweep_host_tests::generate::Rng;

/// A point.
pub type Point = [f32; 3];

/// A kind of triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    Round,
    /// One edge is a hundred millionth of the others.
    Needle,
    /// The height is a hundred millionth of the longest edge.
    Sliver,
    /// Without area, but for rounding.
    Flat,
    /// Of whole numbers.
    Whole,
    /// Three equal corners.
    Dot,
}

/// All kinds.
pub const SHAPES: [Shape; 6] =
    [Shape::Round, Shape::Needle, Shape::Sliver, Shape::Flat, Shape::Whole, Shape::Dot];

impl Shape {
    /// For tables.
    pub const fn name(self) -> &'static str {
        match self {
            Shape::Round => "round",
            Shape::Needle => "needle",
            Shape::Sliver => "sliver",
            Shape::Flat => "flat",
            Shape::Whole => "whole numbers",
            Shape::Dot => "point",
        }
    }

    /// A triangle in the cube from -1 to 1, of any size.
    pub fn triangle(self, rng: &mut Rng) -> [Point; 3] {
        let size = halved(rng, 12);
        let a = rng.point_in([-0.5; 3], [0.5; 3]);
        let [e, g] = [(); 2].map(|()| scaled(rng.direction(), 0.5 * size * rng.unit_f32()));
        let [b, c] = match self {
            Shape::Round => [sum(a, e), sum(a, g)],
            Shape::Needle => [sum(a, e), sum(sum(a, e), scaled(g, 1e-8))],
            Shape::Sliver => {
                let along = scaled(e, rng.unit_f32());
                [sum(a, e), sum(a, sum(along, scaled(g, 1e-8)))]
            }
            Shape::Flat => [sum(a, e), sum(a, scaled(e, 2.0 * rng.unit_f32() - 0.5))],
            Shape::Whole => {
                let whole = |p: Point| p.map(|x| (x * 4096.0).round() / 4096.0);
                return [a, sum(a, e), sum(a, g)].map(whole);
            }
            Shape::Dot => [a, a],
        };
        [a, b, c]
    }
}

/// A point on a triangle, next to it, at a corner, beside an edge, or up to `far` away.
pub fn point(rng: &mut Rng, &[a, b, c]: &[Point; 3], far: f32) -> Point {
    let away = |rng: &mut Rng, most: f32| {
        let length = most * halved(rng, 40);
        scaled(rng.direction(), length * rng.unit_f32())
    };
    let (mut v, mut w) = (rng.unit_f32(), rng.unit_f32());
    if v + w > 1.0 {
        (v, w) = (1.0 - v, 1.0 - w);
    }
    let at = |v: f32, w: f32| sum(sum(scaled(a, 1.0 - v - w), scaled(b, v)), scaled(c, w));
    match rng.below(6) {
        0 => rng.point_in([-1.0; 3], [1.0; 3]),
        1 => scaled(rng.direction(), far * rng.unit_f32()),
        2 => at(v, w),
        3 => sum(at(v, w), away(rng, 1.0)),
        4 => sum(a, away(rng, far)),
        _ => sum(at(v, 1.0 - v), away(rng, 1.0)),
    }
}

/// A power of ½, the zeroth or a higher one below the given.
pub fn halved(rng: &mut Rng, below: usize) -> f32 {
    (0..rng.below(below)).fold(1.0, |size, _| 0.5 * size)
}

pub fn sum(a: Point, b: Point) -> Point {
    std::array::from_fn(|k| a[k] + b[k])
}

pub fn scaled(a: Point, by: f32) -> Point {
    a.map(|x| x * by)
}
