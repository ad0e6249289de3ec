//! Cones of normals for all leaves.

use super::fans::FanLeaf;
use super::nodes::order::Topology;
use glam::DVec3;
use meshsweep_core::internal::geom::fan::NormalCone;
use rayon::prelude::*;

/// Squared sine of the angle between two edges below which a normal's direction is not used. f64
/// gives the normal to 1e-15 of the edges' lengths, a millionth of this sine. On the grid only
/// needles of almost no area are left out.
const FLAT: f64 = 1e-18;

/// Room in the sine for all rounding here.
const ROUNDING: f64 = 1e-8;

/// The section's bytes, in leaf order; `positions` in grid units, as stored.
pub(super) fn cones(topology: &Topology, leaves: &[FanLeaf], positions: &[DVec3]) -> Vec<u8> {
    let of_leaf = |&item: &u32| cone(&leaves[item as usize], positions);
    let cones: Vec<[u8; 4]> = topology.leaf_order.par_iter().map(of_leaf).collect();
    cones.into_flattened()
}

/// The cone of a leaf. Triangles without area have no normal and do not count.
fn cone(leaf: &FanLeaf, positions: &[DVec3]) -> [u8; 4] {
    let mut normals = Vec::new();
    for fan in leaf.fans() {
        let centre = positions[fan.centre as usize];
        for pair in fan.ring.windows(2) {
            let [e, g] = [pair[0], pair[1]].map(|v| positions[v as usize] - centre);
            let normal = if fan.reversed { g.cross(e) } else { e.cross(g) };
            if normal == DVec3::ZERO && [e, g, e - g].contains(&DVec3::ZERO) {
                continue;
            }
            if normal.length_squared() <= FLAT * e.length_squared() * g.length_squared() {
                return NormalCone::UNKNOWN;
            }
            normals.push(normal.normalize());
        }
    }
    let Some(axis) = axes(&normals)
        .into_iter()
        .map(on_bytes)
        .filter(|&axis| axis != [0; 3])
        .map(|axis| (axis, half_angle(axis, &normals)))
        .min_by(|a, b| a.1.total_cmp(&b.1))
    else {
        return NormalCone::UNKNOWN;
    };
    let (axis, sine) = axis;
    let steps = ((sine + ROUNDING) * 254.0).ceil();
    if steps <= 254.0 { NormalCone::write(axis, steps as u8) } else { NormalCone::UNKNOWN }
}

/// Directions, among them the axis of the narrowest cone: those of one, two or three normals, and
/// the mean of all.
fn axes(normals: &[DVec3]) -> Vec<DVec3> {
    let mut axes = vec![normals.iter().sum()];
    for (i, &a) in normals.iter().enumerate() {
        axes.push(a);
        for (j, &b) in normals.iter().enumerate().skip(i + 1) {
            axes.push(a + b);
            for &c in &normals[j + 1..] {
                let across = (b - a).cross(c - a);
                axes.push(if across.dot(a) < 0.0 { -across } else { across });
            }
        }
    }
    axes
}

/// The nearest direction whose largest component is 127; 0 if there is none.
fn on_bytes(axis: DVec3) -> [i8; 3] {
    let largest = axis.abs().max_element();
    if largest > 0.0 {
        (axis * (127.0 / largest)).to_array().map(|x| x.round() as i8)
    } else {
        [0; 3]
    }
}

/// The sine of the largest angle between an axis and the normals; infinite from a right angle on.
fn half_angle(axis: [i8; 3], normals: &[DVec3]) -> f64 {
    let axis = DVec3::from(axis.map(f64::from)).normalize();
    normals.iter().fold(0.0, |most: f64, normal| {
        let sine =
            if axis.dot(*normal) > ROUNDING { axis.cross(*normal).length() } else { f64::INFINITY };
        most.max(sine)
    })
}
