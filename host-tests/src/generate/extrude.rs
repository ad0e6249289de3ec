//! Prisms over a polygon.

use super::builder::Builder;
use super::{Triangles, joined};

/// A block 40 × 40 × 30 with a slot 4 wide and 24 deep along y that widens to 16 at its bottom, a
/// T-slot: 404 triangles, genus 0. An outer hull soon bridges the slot, and then a segment inside
/// it, such as from (15, 20, 8) up to (15, 20, 14), meets the overhang at z = 12 though it lies
/// wholly below the hull.
#[must_use]
pub fn groove_block() -> Triangles {
    #[rustfmt::skip]
    let profile = [
        [0.0, 0.0], [40.0, 0.0], [40.0, 30.0], [22.0, 30.0], [22.0, 12.0], [28.0, 12.0],
        [28.0, 6.0], [12.0, 6.0], [12.0, 12.0], [18.0, 12.0], [18.0, 30.0], [0.0, 30.0],
    ];
    extrude(&profile, 40.0, 16)
}

/// A comb of 32 teeth, each 1 high and 2⁻¹⁰ wide at its foot, 64 long: slivers with aspect ratios
/// up to 65,536 and neighbours that almost touch. Closed, genus 0, 264 triangles.
#[must_use]
pub fn needle_comb() -> Triangles {
    let pitch = 1.0 / 1024.0;
    let mut profile = vec![[0.0, -1.0 / 64.0], [32.0 * pitch, -1.0 / 64.0]];
    for tooth in (0..32).rev() {
        let left = tooth as f32 * pitch;
        profile.extend([[left + pitch, 0.0], [left + 0.5 * pitch, 1.0]]);
    }
    profile.push([0.0, 0.0]);
    extrude(&profile, 64.0, 1)
}

/// Two clamps that reach over a table, at x from 0 to 30 and from 70 to 100. Each is a post 20 high
/// with a strap 8 thick on it, 16 wide along y. Closed, two components, 40 triangles.
#[must_use]
pub fn clamps() -> Triangles {
    let left = [[0.0, 0.0], [10.0, 0.0], [10.0, 20.0], [30.0, 20.0], [30.0, 28.0], [0.0, 28.0]];
    let mut right = left.map(|[x, z]| [100.0 - x, z]);
    right.reverse();
    joined(&extrude(&left, 16.0, 1), &extrude(&right, 16.0, 1))
}

/// A link of a robot: eyes of radius 6 around (0, z = 0) and (60, z = 0), a bar 6 high between
/// them, 8 thick along y. Closed, genus 0, 284 triangles.
#[must_use]
pub fn link() -> Triangles {
    #[rustfmt::skip]
    let outline = [
        [6.0, -3.0], [54.0, -3.0], [57.5, -6.0], [62.5, -6.0], [66.0, -2.5], [66.0, 2.5],
        [62.5, 6.0], [57.5, 6.0], [54.0, 3.0], [6.0, 3.0], [2.5, 6.0], [-2.5, 6.0],
        [-6.0, 2.5], [-6.0, -2.5], [-2.5, -6.0], [2.5, -6.0],
    ];
    extrude(&outline, 8.0, 8)
}

/// A table's plate, 600 × 200 × 20. Closed, genus 0, 12 triangles.
#[must_use]
pub fn table() -> Triangles {
    extrude(&[[0.0, 0.0], [600.0, 0.0], [600.0, 20.0], [0.0, 20.0]], 200.0, 1)
}

/// The prism over a simple polygon in x and z, counter-clockwise seen from −y, from y = 0 to
/// `length` in `steps` steps.
fn extrude(profile: &[[f32; 2]], length: f32, steps: usize) -> Triangles {
    let mut builder = Builder::default();
    let at = |[x, z]: [f32; 2], step: usize| [x, length * step as f32 / steps as f32, z];
    for [a, b, c] in ears(profile) {
        builder.triangle([at(a, 0), at(b, 0), at(c, 0)]);
        builder.triangle([at(a, steps), at(c, steps), at(b, steps)]);
    }
    for (i, &p) in profile.iter().enumerate() {
        let q = profile[(i + 1) % profile.len()];
        for step in 0..steps {
            builder.triangle([at(p, step), at(p, step + 1), at(q, step)]);
            builder.triangle([at(q, step), at(p, step + 1), at(q, step + 1)]);
        }
    }
    builder.finish()
}

/// Triangulates a simple counter-clockwise polygon by cutting ears. Coordinates are short enough
/// for f64 to be exact.
fn ears(profile: &[[f32; 2]]) -> Vec<[[f32; 2]; 3]> {
    let mut rest = profile.to_vec();
    let mut triangles = Vec::with_capacity(rest.len());
    while rest.len() > 3 {
        let n = rest.len();
        let corner = |i: usize| [rest[(i + n - 1) % n], rest[i], rest[(i + 1) % n]];
        let is_ear = |i: &usize| {
            let [a, b, c] = corner(*i);
            let inside =
                |p: [f32; 2]| turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
            turn(a, b, c) > 0.0 && !rest.iter().any(|&p| p != a && p != b && p != c && inside(p))
        };
        let Some(ear) = (0..n).find(is_ear) else { break };
        triangles.push(corner(ear));
        rest.remove(ear);
    }
    if let [a, b, c] = rest[..] {
        triangles.push([a, b, c]);
    }
    triangles
}

fn turn(a: [f32; 2], b: [f32; 2], c: [f32; 2]) -> f64 {
    let [[ax, ay], [bx, by], [cx, cy]] = [a, b, c].map(|p| p.map(f64::from));
    (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
}
