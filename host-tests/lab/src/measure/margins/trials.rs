//! One trial of each margin: a random input, the kernel, the truth.

use glam::{DVec3, Vec3};
use meshsweep_core::internal::geom::fan::{FanRay, PointFan, lower_bound, refined};
use meshsweep_core::internal::geom::{
    Aabb, CapsulePoint, SeenCorner, SolidAngles, SweptPoint, SweptSegment, convex_gap,
    point_segment, point_triangle, segment_triangle, triangle_distance,
};
use meshsweep_core::internal::num::sqrt_approx;
use meshsweep_core::internal::num::tolerance::{
    CERTIFIED_PART, CONVEX_GAP, FAN_DISTANCE, FAN_PARAMETER, FAN_RELATIVE, FAN_SHEAR,
    LEAST_DENOMINATOR, POINT_BOUND, POINT_INTERVAL, SEGMENT_BOUND, SEGMENT_DISTANCE, SOLID_ANGLE,
    STILL, TRIANGLE_DISTANCE, TRIPLE_PRODUCT, U32, U64, UNDERFLOW,
};
use meshsweep_host_tests::generate::Rng;
use meshsweep_host_tests::generate::corpus::IDENTITY;
use meshsweep_host_tests::oracle::{
    Bounded, contacts, distance_of_meshes, distance_to_segments, distance_to_triangle,
    gap_to_triangle, winding_number,
};

use super::place::{Point, SHAPES, Shape, halved, point};

/// A margin, and a trial of it.
pub struct Margin {
    pub name: &'static str,
    /// Of `core/docs/rounding.md`.
    pub section: u32,
    /// Roundings that the constant allows.
    pub units: f64,
    /// Roundings that are proved.
    pub proved: &'static str,
    /// The share that a random trial uses; `None` if the trial says nothing.
    pub share: fn(&mut Rng, Shape) -> Option<f64>,
}

/// All margins that are measured.
pub const MARGINS: [Margin; 12] = [
    Margin {
        name: "swept triangle and point, f32",
        section: 2,
        units: POINT_BOUND as f64,
        proved: "12.7",
        share: swept_point,
    },
    Margin {
        name: "swept triangle and segment, f32",
        section: 3,
        units: SEGMENT_BOUND as f64,
        proved: "31",
        share: swept_segment,
    },
    Margin {
        name: "point and triangle, f64",
        section: 4,
        units: POINT_INTERVAL,
        proved: "8.6",
        share: point_interval,
    },
    Margin {
        name: "parameter of a hit, f64",
        section: 5,
        units: TRIPLE_PRODUCT,
        proved: "9.1",
        share: triple_product,
    },
    Margin {
        name: "point and fan, upper end, f32",
        section: 8,
        units: FAN_DISTANCE as f64,
        proved: "12",
        share: fan_upper,
    },
    Margin {
        name: "point and fan, lower end, f32",
        section: 8,
        units: FAN_DISTANCE as f64,
        proved: "23",
        share: fan_lower,
    },
    Margin {
        name: "strip along an edge, f32",
        section: 9,
        units: FAN_SHEAR as f64,
        proved: "12.9",
        share: strip,
    },
    Margin {
        name: "parameter on a fan, f32",
        section: 9,
        units: FAN_PARAMETER as f64,
        proved: "21.6",
        share: parameter,
    },
    Margin {
        name: "point and segment, f64",
        section: 14,
        units: SEGMENT_DISTANCE as f64,
        proved: "19",
        share: segment_interval,
    },
    Margin {
        name: "point and capsule, f32",
        section: 14,
        units: SEGMENT_DISTANCE as f64,
        proved: "19",
        share: capsule,
    },
    Margin {
        name: "two triangles, f64",
        section: 18,
        units: TRIANGLE_DISTANCE,
        proved: "17.5",
        share: two_triangles,
    },
    Margin {
        name: "solid angle, f32",
        section: 20,
        units: SOLID_ANGLE as f64,
        proved: "57",
        share: solid_angle,
    },
];

fn vec3(p: Point) -> Vec3 {
    Vec3::from_array(p)
}

fn wide(p: Point) -> DVec3 {
    vec3(p).as_dvec3()
}

fn norm_1(p: Vec3) -> f32 {
    p.x.abs() + p.y.abs() + p.z.abs()
}

fn bounds_of(corners: &[Point]) -> Aabb {
    let all = || corners.iter().map(|&corner| vec3(corner));
    let least = all().fold(Vec3::INFINITY, Vec3::min);
    Aabb { min: least, max: all().fold(Vec3::NEG_INFINITY, Vec3::max) }
}

/// 1-norms of a box's edges, and of the way from a point to its farthest corner.
fn norms(p: Vec3, bounds: &Aabb) -> f32 {
    let farthest = (p - bounds.min).abs().max((bounds.max - p).abs());
    norm_1(farthest) + norm_1(bounds.max - bounds.min)
}

/// The error of an interval's ends, whose margin is part of them, over the margin.
fn interval(truth: Bounded, lower: f64, upper: f64, margin: f64) -> Option<f64> {
    let above = (truth.lower - (upper - margin)) / margin;
    let below = if lower > 0.0 { (lower + margin - truth.upper) / margin } else { above };
    (margin > 0.0).then_some(above.max(below))
}

fn swept_point(rng: &mut Rng, shape: Shape) -> Option<f64> {
    let corners = shape.triangle(rng);
    let p = point(rng, &corners, 4096.0);
    let bounds = bounds_of(&corners);
    let lower = SweptPoint::new(vec3(p), &bounds).lower(corners.map(vec3), 0.0, f32::INFINITY)?;
    let margin = f64::from(POINT_BOUND * U32 * norms(vec3(p), &bounds) + UNDERFLOW);
    let truth = distance_to_triangle(p, corners);
    (lower > 0.0).then(|| (f64::from(lower) + margin - truth.upper) / margin)
}

fn swept_segment(rng: &mut Rng, shape: Shape) -> Option<f64> {
    let corners = shape.triangle(rng);
    let [a, b] = [(); 2].map(|()| point(rng, &corners, 1.0).map(|x| x.clamp(-1.0, 1.0)));
    let bounds = Aabb { min: Vec3::splat(-1.0), max: Vec3::splat(1.0) };
    let segment = SweptSegment::new(&bounds.clip(wide(a), wide(b))?, &bounds);
    let is_beyond = |radius: f32| segment.enter(corners.map(vec3), radius).is_none();
    if !is_beyond(0.0) {
        return None;
    }
    // The greatest radius that is called clear.
    let (mut clear, mut met) = (0f32, 8f32);
    while met.to_bits() - clear.to_bits() > 1 {
        let middle = f32::from_bits(clear.to_bits() / 2 + met.to_bits() / 2);
        if middle <= clear {
            break;
        }
        if is_beyond(middle) { clear = middle } else { met = middle }
    }
    let ends = norm_1(vec3(a)) + norm_1(vec3(b));
    let margin = SEGMENT_BOUND * U32 * (2.0 * norms(vec3(a), &bounds) + ends) + UNDERFLOW;
    let (clear, margin) = (f64::from(clear), f64::from(margin));
    Some((clear + margin - gap_to_triangle(a, b, corners)) / margin)
}

fn point_interval(rng: &mut Rng, shape: Shape) -> Option<f64> {
    let corners = shape.triangle(rng);
    let p = point(rng, &corners, 1e6);
    let [a, b, c] = corners.map(wide);
    let found = point_triangle(wide(p), a, b, c);
    let norms: f64 = [wide(p) - a, b - a, c - a].map(|x| x.abs().element_sum()).iter().sum();
    let margin = POINT_INTERVAL * U64 * norms;
    interval(distance_to_triangle(p, corners), found.lower, found.upper, margin)
}

/// Segments that meet a triangle with an area, or pass by.
fn aimed(rng: &mut Rng, corners: &[Point; 3]) -> [Point; 2] {
    let from = rng.point_in([-1.0; 3], [1.0; 3]);
    let at = point(rng, corners, 1.0);
    let to = std::array::from_fn(|k| from[k] + (at[k] - from[k]) * 2.0);
    [from, to]
}

/// Where a segment crosses the plane of a triangle that it meets.
fn crossing([a, b]: [Point; 2], corners: &[Point; 3]) -> Option<f64> {
    let contact = contacts(a, b, corners, &[[0, 1, 2]]).into_iter().next()?;
    (!contact.coplanar && contact.t_upper - contact.t_lower < 1e-13)
        .then_some(0.5 * (contact.t_lower + contact.t_upper))
}

/// How far a number is from an interval's middle, over half of the interval.
fn off_middle(t: f64, lower: f64, upper: f64) -> Option<f64> {
    (lower > 0.0 && upper < 1.0 && upper > lower)
        .then(|| (t - 0.5 * (lower + upper)).abs() / (0.5 * (upper - lower)))
}

fn triple_product(rng: &mut Rng, shape: Shape) -> Option<f64> {
    let corners = shape.triangle(rng);
    let segment = aimed(rng, &corners);
    let t = crossing(segment, &corners)?;
    let [a, b] = segment.map(wide);
    // A miss where there is a hit is infinitely wrong.
    let Some(found) = segment_triangle(a, b, corners.map(wide)) else { return Some(f64::INFINITY) };
    off_middle(t, found.t_lower, found.t_upper)
}

/// The kernel of a fan: from the centre to the point, and both spokes.
fn seen(p: Point, [a, b, c]: [Point; 3]) -> [Vec3; 3] {
    [vec3(p) - vec3(a), vec3(b) - vec3(a), vec3(c) - vec3(a)]
}

fn fan_margin(distance: f32, [_, e, g]: [Vec3; 3]) -> f64 {
    let star = f64::from(norm_1(e)) + f64::from(norm_1(g));
    f64::from(U32)
        * (f64::from(FAN_RELATIVE) * f64::from(distance) + f64::from(FAN_DISTANCE) * star)
}

fn fan_upper(rng: &mut Rng, shape: Shape) -> Option<f64> {
    let corners = shape.triangle(rng);
    let p = point(rng, &corners, 4096.0);
    let seen @ [s, e, g] = seen(p, corners);
    let fan = PointFan::new(s);
    let distance = sqrt_approx(fan.triangle(&fan.spoke(e), &fan.spoke(g)).distance_sq);
    let margin = fan_margin(distance, seen);
    let truth = distance_to_triangle(p, corners);
    (margin > 0.0).then(|| (truth.lower - f64::from(distance)) / margin)
}

fn fan_lower(rng: &mut Rng, shape: Shape) -> Option<f64> {
    let corners = shape.triangle(rng);
    let p = point(rng, &corners, 4096.0);
    let seen @ [s, e, g] = seen(p, corners);
    let fan = PointFan::new(s);
    let near = fan.triangle(&fan.spoke(e), &fan.spoke(g));
    let least = near.distance_sq * CERTIFIED_PART;
    let is_certified = near.lower_bound_sq >= least;
    let lower =
        if is_certified { sqrt_approx(least) } else { lower_bound(&seen, &refined(&seen, &near)) };
    let margin = fan_margin(sqrt_approx(near.distance_sq), seen);
    let truth = distance_to_triangle(p, corners);
    (margin > 0.0).then(|| (f64::from(lower) - truth.upper) / margin)
}

fn inverse_of([a, b]: [Point; 2]) -> Point {
    std::array::from_fn(|k| {
        let along = b[k] - a[k];
        1.0 / if along.abs() < STILL { STILL.copysign(along) } else { along }
    })
}

/// A line as fans see it. `surface` may be negative here, which narrows the strip.
fn ray([a, b]: [Point; 2], corners: &[Point; 3], surface: f32) -> (FanRay, f32) {
    let direction: Point = std::array::from_fn(|k| b[k] - a[k]);
    let inverse = inverse_of([a, b]);
    let size = corners.iter().map(|&c| norm_1(vec3(c) - vec3(a))).fold(0.0, f32::max);
    (FanRay::new(a, direction, inverse, 1.0, surface, size), size)
}

fn parameter(rng: &mut Rng, shape: Shape) -> Option<f64> {
    let corners = shape.triangle(rng);
    let segment @ [origin, _] = aimed(rng, &corners);
    let t = crossing(segment, &corners)?;
    let (ray, size) = ray(segment, &corners, 0.0);
    let found = ray.crossing(corners.map(|corner| ray.shadow(vec3(corner))), 0.0);
    let Some(found) = found else { return Some(f64::INFINITY) };
    if found.lower <= 0.0 || found.upper >= 1.0 {
        return None;
    }
    // Parameters of the corners, as the kernel computes them.
    let [_, _, axis] = ray.axes();
    let inverse = inverse_of(segment)[axis];
    let corners = corners.map(|corner| (corner[axis] - origin[axis]) * inverse);
    let (first, last) =
        (corners.into_iter().fold(1f32, f32::min), corners.into_iter().fold(0f32, f32::max));
    let slack = (4.0 * U32 * size + LEAST_DENOMINATOR) * inverse.abs();
    let rounding = FAN_PARAMETER * U32 * last.abs().max(first.abs()) + slack;
    // An end is that of the corners less a margin, or that of the plane less half of the interval.
    let half = 0.5 * f64::from(found.upper - found.lower);
    let margin = |is_corner: bool| if is_corner { f64::from(rounding) } else { half };
    let below = 1.0 - (t - f64::from(found.lower)) / margin(found.lower == first - rounding);
    let above = 1.0 - (f64::from(found.upper) - t) / margin(found.upper == last + rounding);
    Some(below.max(above))
}

/// The part of the strip that suffices, in steps: the next narrower one decides wrongly.
fn strip(rng: &mut Rng, shape: Shape) -> Option<f64> {
    const PARTS: [f32; 8] = [1.0, 0.75, 0.5, 0.35, 0.25, 0.1, 0.05, 0.02];
    let corners @ [a, b, c] = shape.triangle(rng);
    let share = rng.unit_f32();
    let onto = |p: f32, q: f32| p + (q - p) * share;
    let edge: Point = std::array::from_fn(|k| onto(a[k], b[k]));
    let nudge = halved(rng, 12) / (1 << 20) as f32;
    let at: Point =
        std::array::from_fn(|k| edge[k] + (edge[k] - c[k]) * (nudge * (2.0 * share - 1.0)));
    let from = rng.point_in([-1.0; 3], [1.0; 3]);
    let segment = [from, std::array::from_fn(|k| from[k] + (at[k] - from[k]) * 2.0)];
    let normal = (vec3(b) - vec3(a)).cross(vec3(c) - vec3(a));
    if normal == Vec3::ZERO {
        return None;
    }
    let meets = !contacts(segment[0], segment[1], &corners, &[[0, 1, 2]]).is_empty();
    let (_, size) = ray(segment, &corners, 0.0);
    let is_wrong = |part: f32| {
        let surface = -(1.0 - part) * FAN_SHEAR * U32 * size / 1.7321;
        let (ray, _) = ray(segment, &corners, surface);
        let found = ray.crossing(corners.map(|corner| ray.shadow(vec3(corner))), 0.0);
        found.is_none_or(|found| found.certain) && found.is_some() != meets
    };
    match PARTS.into_iter().position(is_wrong) {
        Some(0) => Some(f64::INFINITY),
        // The step before was enough.
        Some(step) => PARTS.get(step - 1).map(|&part| f64::from(part)),
        None => Some(0.0),
    }
}

fn segment_interval(rng: &mut Rng, shape: Shape) -> Option<f64> {
    let corners @ [a, b, _] = shape.triangle(rng);
    let p = point(rng, &corners, 1e6);
    let found = point_segment(wide(p), wide(a), wide(b));
    let norms: f64 =
        [wide(p) - wide(a), wide(b) - wide(a)].map(|x| x.abs().element_sum()).iter().sum();
    let margin = f64::from(SEGMENT_DISTANCE) * U64 * norms;
    let truth = distance_to_segments(p, [[a, b].map(|end| end.map(f64::from))]);
    interval(truth, found.lower, found.upper, margin)
}

fn capsule(rng: &mut Rng, shape: Shape) -> Option<f64> {
    let corners @ [a, b, _] = shape.triangle(rng);
    let p = point(rng, &corners, 1e6);
    let bounds = bounds_of(&[a, b]);
    let lower = CapsulePoint::new(vec3(p), &bounds).lower(vec3(a), vec3(b), 0.0);
    let margin = f64::from(SEGMENT_DISTANCE * U32 * norms(vec3(p), &bounds));
    let truth = distance_to_segments(p, [[a, b].map(|end| end.map(f64::from))]);
    (lower > 0.0).then(|| (f64::from(lower) + margin - truth.upper) / margin)
}

fn two_triangles(rng: &mut Rng, shape: Shape) -> Option<f64> {
    let corners = shape.triangle(rng);
    let other = SHAPES[rng.below(SHAPES.len())].triangle(rng);
    let near = point(rng, &corners, 4.0);
    let by: Point = std::array::from_fn(|k| near[k] - other[0][k]);
    let other = other.map(|corner| std::array::from_fn(|k| corner[k] + by[k]));
    let farthest =
        |t: &[Point; 3]| t.iter().map(|&p| wide(p).abs().element_sum()).fold(0.0, f64::max);
    let margin = TRIANGLE_DISTANCE * U64 * (farthest(&corners) + farthest(&other));
    let [a, b] = [corners, other].map(|t| t.map(|p| p.map(f64::from)));
    // Corners are guessed too: what a right guess gives has the same margin.
    let guesses = [0; 2].map(|_: u32| [0; 2].map(|_: u32| rng.below(8) as u32));
    let found = triangle_distance(a, b, guesses);
    let one = [[0, 1, 2]];
    let truth = distance_of_meshes((&corners, &one), (&other, &one), &IDENTITY, [0.0; 3]);
    // The kernel's upper end is not that of triangles that pass through each other.
    if truth.lower == 0.0 {
        return None;
    }
    let by_corners = convex_gap(&a, &b);
    let convex = CONVEX_GAP * U64 * (farthest(&corners) + farthest(&other));
    let both = [
        interval(truth, found.lower, found.upper, margin)?,
        interval(truth, by_corners.lower, by_corners.upper, convex)?,
    ];
    Some(both[0].max(both[1]))
}

fn solid_angle(rng: &mut Rng, shape: Shape) -> Option<f64> {
    let corners = shape.triangle(rng);
    let p = point(rng, &corners, 64.0);
    let mut sum = SolidAngles::NONE;
    sum.add(corners.map(|corner| SeenCorner::new(vec3(corner) - vec3(p))), 0.0);
    let (angle, error) = sum.sum();
    let truth =
        winding_number(p.map(f64::from), &corners, &[[0, 1, 2]], 1.0) * std::f64::consts::TAU * 2.0;
    (error < 6.0).then(|| (f64::from(angle) - truth).abs() / f64::from(error))
}
