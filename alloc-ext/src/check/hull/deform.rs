//! Whether a hull hierarchy that deforms keeps its claims: numbers of vertices in range, and radii
//! of key frames that may be interpolated.
//!
//! The claim of the radii: for each triangle and each vertex of its part of the surface there is
//! one point of the triangle, by its barycentric coordinates, that is within the radius of the
//! vertex in every key. The blob does not store the point. The nearest at rest is tried first. If
//! it fails, the point is searched whose largest excess over the radii is least: a convex function
//! of two coordinates.

use super::forest::Forest;
use super::parse::{Blob, small_radius};
use super::report::CheckReport;
use crate::check::bytes::{Cursor, section, width};
use crate::check::distance::{ABSOLUTE, ROUNDING};
use glam::DVec3;

/// Steps of a search along one coordinate: each leaves two thirds.
const STEPS: usize = 60;

/// What a coordinate of a key frame may be off for the rounding of the builder's f64.
const KEY_ABSOLUTE: f64 = 64.0 * ABSOLUTE;

/// A key frame: places of the vertices, and radii.
pub(super) struct Key<'a> {
    pub(super) vertices: Vec<DVec3>,
    /// Claimed greatest distance of a vertex from the input's.
    pub(super) error: f64,
    radii: &'a [u8],
}

/// Numbers of the surface's vertices, in their order; all are below their claimed limit.
pub(super) fn numbers(bytes: &[u8], blob: &Blob) -> Result<Vec<u32>, String> {
    let body = section(bytes, 22, "vertex numbers")?;
    if body.is_empty() {
        return Ok(Vec::new());
    }
    let mut cursor = Cursor(body, "vertex numbers");
    let limit = cursor.uint(4)?;
    let mut numbers = Vec::new();
    for _ in blob.splits_with.iter().filter(|split| split.is_none()) {
        let number = cursor.uint(width(limit))?;
        if number >= limit {
            return Err(format!("vertex number {number} of {limit}"));
        }
        numbers.push(number);
    }
    cursor.end()?;
    Ok(numbers)
}

/// The blob's key frames but the first.
pub(super) fn frames<'a>(bytes: &'a [u8], blob: &Blob) -> Result<Vec<Key<'a>>, String> {
    let body = section(bytes, 23, "key frames")?;
    if body.is_empty() { Ok(Vec::new()) } else { read(body, blob) }
}

/// Radii of key frames cover, and boxes are those of the vertices.
pub(super) fn keys(
    bytes: &[u8],
    blob: &Blob,
    forest: &Forest,
    report: &mut CheckReport,
) -> Result<(), String> {
    let frames = frames(bytes, blob)?;
    if frames.is_empty() {
        return Ok(());
    }
    for (index, has_part) in forest.has_part.iter().enumerate() {
        let denies = |key: &Key<'_>| small_radius(key.radii[index]).is_finite() != *has_part;
        if !blob.encloses && frames.iter().any(denies) {
            return Err(format!("triangle {index}: its radius at a key denies its part"));
        }
    }
    let rest = blob.vertices.iter().map(|&p| DVec3::from(p)).collect();
    let mut keys = vec![Key { vertices: rest, error: 0.0, radii: &blob.radii }];
    keys.extend(frames);
    for (index, (&triangle, below)) in forest.triangles.iter().zip(&forest.below).enumerate() {
        let radius = |key: &Key<'_>| small_radius(key.radii[index]) * ROUNDING + KEY_ABSOLUTE;
        for &v in below.iter().filter(|v| !triangle.contains(v)) {
            report.key_pairs += 1;
            let excess = |key: &Key<'_>, [s, t]: [f64; 2]| {
                let at = |v: u32| key.vertices[v as usize];
                let [a, b, c] = triangle.map(at);
                (at(v) - a - (b - a) * s - (c - a) * t).length() - radius(key)
            };
            let most =
                |point: [f64; 2]| keys.iter().map(|key| excess(key, point)).fold(-1.0, f64::max);
            let at = |v: u32| keys[0].vertices[v as usize];
            if most(nearest(at(v), triangle.map(at))) <= 0.0 || least(most) <= 0.0 {
                continue;
            }
            let alone = |key: &Key<'_>| least(|point| excess(key, point)) > 0.0;
            let key = keys
                .iter()
                .position(alone)
                .map_or("keys together".to_owned(), |key| format!("key {key}"));
            return Err(format!("{key}: triangle {index} leaves out vertex {v}"));
        }
    }
    Ok(())
}

fn read<'a>(body: &'a [u8], blob: &Blob) -> Result<Vec<Key<'a>>, String> {
    let mut cursor = Cursor(body, "key frames");
    let count = cursor.uint(4)?;
    let mut boxes = Vec::new();
    for _ in 0..count {
        let error = cursor.float()?;
        if !(error >= 0.0 && error.is_finite()) {
            return Err(format!("a key frame has the error {error}"));
        }
        boxes.push((error, [corner(&mut cursor)?, corner(&mut cursor)?]));
    }
    let mut keys = Vec::new();
    for (error, [low, high]) in boxes {
        let vertices = blob.vertices.iter().map(|_| corner(&mut cursor));
        let vertices = vertices.collect::<Result<Vec<DVec3>, _>>()?;
        let least = vertices.iter().fold(DVec3::INFINITY, |low, &p| low.min(p));
        let most = vertices.iter().fold(DVec3::NEG_INFINITY, |high, &p| high.max(p));
        if [least, most] != [low, high] {
            return Err("a key frame's box is not that of its vertices".into());
        }
        let split = cursor.0.split_at_checked(blob.radii.len());
        let (radii, rest) = split.ok_or("section key frames ends early")?;
        cursor.0 = rest;
        keys.push(Key { vertices, error: f64::from(error), radii });
    }
    cursor.end()?;
    Ok(keys)
}

fn corner(cursor: &mut Cursor<'_>) -> Result<DVec3, String> {
    let mut coordinate = || cursor.float().map(f64::from);
    Ok(DVec3::new(coordinate()?, coordinate()?, coordinate()?))
}

/// Coordinates of the point of a triangle that is nearest to `p`: the nearest of those on its edges
/// and the foot on its plane.
fn nearest(p: DVec3, [a, b, c]: [DVec3; 3]) -> [f64; 2] {
    let along = |from: DVec3, to: DVec3| {
        let d = to - from;
        if d == DVec3::ZERO { 0.0 } else { (d.dot(p - from) / d.length_squared()).clamp(0.0, 1.0) }
    };
    let (s, t, w) = (along(a, b), along(a, c), along(b, c));
    let normal = (b - a).cross(c - a);
    let area = normal.length_squared();
    let foot = [(p - a).cross(c - a).dot(normal) / area, (b - a).cross(p - a).dot(normal) / area];
    let inside = area > 0.0 && foot[0] >= 0.0 && foot[1] >= 0.0 && foot[0] + foot[1] <= 1.0;
    let mut points = vec![[s, 0.0], [0.0, t], [1.0 - w, w]];
    points.extend(inside.then_some(foot));
    let distance = |&[s, t]: &[f64; 2]| (p - a - (b - a) * s - (c - a) * t).length_squared();
    points.into_iter().min_by(|x, y| distance(x).total_cmp(&distance(y))).unwrap_or([0.0; 2])
}

/// The least value of a convex function over s, t ≥ 0, s + t ≤ 1, by thirds.
fn least(f: impl Fn([f64; 2]) -> f64) -> f64 {
    let along = |s: f64| thirds(1.0 - s, |t| f([s, t]));
    thirds(1.0, along)
}

fn thirds(most: f64, f: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, most);
    for _ in 0..STEPS {
        let third = (high - low) / 3.0;
        if f(low + third) <= f(high - third) { high -= third } else { low += third }
    }
    f(0.5 * (low + high)).min(f(0.0)).min(f(most))
}
