//! Curves: a fence, tool paths, and shapes that are hard for a hierarchy of capsules.

use super::Rng;
use libm::{cos, sin};
use meshsweep::curve::{Polyline, Zone};
use std::f64::consts::PI;

/// An open polyline.
#[must_use]
pub fn open(points: Vec<[f64; 3]>) -> Polyline {
    Polyline { points, ..Polyline::default() }
}

/// A closed polyline.
#[must_use]
pub fn closed(points: Vec<[f64; 3]>) -> Polyline {
    Polyline { is_closed: true, ..open(points) }
}

/// The fence of the fixtures: a boundary of 100 by 60 with round corners, and a post in it.
/// Coordinates are multiples of a 64th.
#[must_use]
pub fn fence() -> Vec<Polyline> {
    vec![ring([50.0, 30.0], [50.0, 30.0], 12.0, 12), ring([30.0, 24.0], [5.0, 5.0], 5.0, 5)]
}

/// The geofence of the example `fence`, in metres: a field of 400 by 240 with round corners, in it
/// a house and a mast that are to be kept out of. Coordinates are multiples of a 64th.
#[must_use]
pub fn zones() -> Vec<Polyline> {
    let excluded = |polyline: Polyline| Polyline { zone: Zone::Exclusion, ..polyline };
    vec![
        ring([200.0, 120.0], [200.0, 120.0], 60.0, 20),
        excluded(ring([120.0, 80.0], [15.0, 10.0], 2.0, 2)),
        excluded(ring([300.0, 150.0], [25.0, 25.0], 25.0, 6)),
    ]
}

/// A rectangle with round corners, of so many segments each.
fn ring(centre: [f64; 2], half: [f64; 2], radius: f64, steps: usize) -> Polyline {
    let corners = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]];
    let arc = |(quarter, signs): (usize, [f64; 2])| {
        (0..=steps).map(move |step| {
            let angle = 0.5 * PI * (quarter as f64 + step as f64 / steps as f64);
            let way = [cos(angle), sin(angle)];
            let [x, y] = [0, 1].map(|axis| {
                let middle = centre[axis] + signs[axis] * (half[axis] - radius);
                ((middle + radius * way[axis]) * 64.0).round() / 64.0
            });
            [x, y, 0.0]
        })
    };
    let mut points: Vec<[f64; 3]> = corners.into_iter().enumerate().flat_map(arc).collect();
    points.dedup();
    points.pop_if(|last| *last == [centre[0] + half[0], centre[1], 0.0]);
    closed(points)
}

/// CSV of polylines: a header, then blank lines between them.
#[must_use]
pub fn csv(polylines: &[Polyline]) -> String {
    let line = |[x, y, z]: &[f64; 3]| format!("{x},{y},{z}\n");
    let text = |polyline: &Polyline| polyline.points.iter().map(line).collect::<String>();
    "x,y,z\n".to_owned() + &polylines.iter().map(text).collect::<Vec<_>>().join("\n")
}

/// CSV of zones in the plane, as autopilots list them: a header, then blank lines between zones.
#[must_use]
pub fn zones_csv(zones: &[Polyline]) -> String {
    let text = |zone: &Polyline| {
        let kind = if zone.zone == Zone::Exclusion { "exclusion" } else { "inclusion" };
        zone.points.iter().map(|[x, y, _]| format!("{x},{y},{kind}\n")).collect::<String>()
    };
    "x,y,zone\n".to_owned() + &zones.iter().map(text).collect::<Vec<_>>().join("\n")
}

/// A tool path of this many segments: rows over a wavy surface, there and back.
#[must_use]
pub fn tool_path(segments: usize) -> Polyline {
    let (rows, points) = (40, segments + 1);
    let row = points.div_ceil(rows);
    let point = |k: usize| {
        let (line, at) = (k / row, (k % row) as f64 / (row - 1) as f64);
        let x = if line % 2 == 0 { at } else { 1.0 - at };
        let y = line as f64 / rows as f64;
        [120.0 * x, 80.0 * y, 6.0 * sin(9.0 * x) * cos(7.0 * y)]
    };
    open((0..points).map(point).collect())
}

/// A flat spiral of this many segments.
#[must_use]
pub fn spiral(segments: usize) -> Polyline {
    let point = |k: usize| {
        let (angle, radius) = (0.11 * k as f64, k as f64 / segments as f64);
        [radius * cos(angle), radius * sin(angle), 0.0]
    };
    open((0..=segments).map(point).collect())
}

/// Long strokes side by side, there and back.
#[must_use]
pub fn zig_zag(segments: usize) -> Polyline {
    let point = |k: usize| [(k.div_ceil(2) % 2) as f64, (k / 2) as f64 / segments as f64, 0.25];
    open((0..=segments).map(point).collect())
}

/// A walk without a plan.
#[must_use]
pub fn walk(segments: usize, seed: u64) -> Polyline {
    let mut rng = Rng::new(seed);
    let mut at = [0f64; 3];
    let mut next = |_| {
        let before = at;
        at.iter_mut().for_each(|x| *x += 2.0 * rng.unit_f64() - 1.0);
        before
    };
    open((0..=segments).map(&mut next).collect())
}

/// A circle of this many segments, closed. Its centre is equally far from all of them.
#[must_use]
pub fn circle(segments: usize) -> Polyline {
    let point = |k: usize| {
        let angle = 2.0 * PI * k as f64 / segments as f64;
        [cos(angle), sin(angle), 0.0]
    };
    closed((0..segments).map(point).collect())
}
