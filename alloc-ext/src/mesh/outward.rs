//! Closed parts: their volume, which lie inside which, and which are inside out.
//!
//! The rule. A part that lies inside no other must face outwards, so it is inside out if its signed
//! volume is negative; then it is turned, and all parts inside it with it, because they were drawn
//! relative to it. Parts inside another are never judged on their own: facing inwards they are
//! cavities, facing outwards they are solids within a solid, and both are legitimate. A volume that
//! rounding cannot tell from zero is left alone. Parts that are open, one-sided or
//! on a non-manifold edge have no inside and are not looked at.

use super::nesting::Part;
use super::winding::Parts;

/// A signed volume and the bound of its rounding error.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Volume {
    pub value: f64,
    pub bound: f64,
}

impl Volume {
    pub(super) fn is_negative(self) -> bool {
        self.value < -self.bound
    }

    pub(super) fn is_zero(self) -> bool {
        self.value.abs() <= self.bound
    }
}

/// One closed two-sided part.
pub(super) struct ClosedPart {
    /// Its number in [`Parts`].
    pub number: u32,
    /// Its first triangle.
    pub first: u32,
    pub volume: Volume,
    /// It, or an outermost part that it lies in, is inside out.
    pub inside_out: bool,
    /// It lies in another closed part.
    pub nested: bool,
}

/// Judges all closed two-sided parts of `triangles`, which must be wound consistently.
pub(super) fn closed_parts(
    positions: &[[f32; 3]],
    triangles: &[[u32; 3]],
    parts: &Parts,
) -> Vec<ClosedPart> {
    let mut firsts = vec![u32::MAX; parts.kinds.len()];
    let wanted = |part: u32| {
        let kind = &parts.kinds[part as usize];
        kind.closed && kind.conflict.is_none()
    };
    let mut gathered: Vec<Vec<[[f32; 3]; 3]>> = (0..parts.kinds.len())
        .map(|part| {
            Vec::with_capacity(if wanted(part as u32) {
                parts.kinds[part].triangle_count
            } else {
                0
            })
        })
        .collect();
    for (t, (triangle, &part)) in triangles.iter().zip(&parts.part).enumerate() {
        if wanted(part) {
            let first = &mut firsts[part as usize];
            *first = (*first).min(t as u32);
            gathered[part as usize].push(triangle.map(|v| positions[v as usize]));
        }
    }
    let solids: Vec<(u32, Part)> = gathered
        .into_iter()
        .enumerate()
        .filter(|(_, t)| !t.is_empty())
        .map(|(number, t)| (number as u32, Part::new(t)))
        .collect();
    let volumes: Vec<Volume> = solids.iter().map(|(_, part)| volume(&part.triangles)).collect();
    let containers: Vec<Vec<usize>> = solids
        .iter()
        .enumerate()
        .map(|(i, (_, inner))| {
            (0..solids.len()).filter(|&j| j != i && solids[j].1.contains(inner)).collect()
        })
        .collect();
    solids
        .iter()
        .enumerate()
        .map(|(i, &(number, _))| {
            let outermost =
                containers[i].iter().copied().find(|&j| containers[j].is_empty()).unwrap_or(i);
            ClosedPart {
                number,
                first: firsts[number as usize],
                volume: volumes[i],
                inside_out: containers[outermost].is_empty() && volumes[outermost].is_negative(),
                nested: !containers[i].is_empty(),
            }
        })
        .collect()
}

/// The signed volume of a closed surface in f64, relative to its first corner.
///
/// Each of the six products of a determinant carries at most 5 roundings (three differences, two
/// products) and 5 additions, and the sum over n triangles n more, each relative to the sum of
/// absolute products: (n + 11) u of it, which (n + 16) ε covers with its own rounding. Coordinates
/// are f32, so nothing over- or underflows.
pub(crate) fn volume(triangles: &[[[f32; 3]; 3]]) -> Volume {
    let origin = triangles.first().map_or([0.0; 3], |t| t[0].map(f64::from));
    let (mut sum, mut absolute) = (0.0, 0.0);
    for triangle in triangles {
        let [a, b, c] = triangle.map(|p| {
            let p = p.map(f64::from);
            [p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]]
        });
        for (i, j, k) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
            let (plus, minus) = (a[i] * b[j] * c[k], a[i] * b[k] * c[j]);
            sum += plus - minus;
            absolute += plus.abs() + minus.abs();
        }
    }
    let roundings = 3.0 * triangles.len() as f64 + 16.0;
    Volume { value: sum / 6.0, bound: roundings * f64::EPSILON * absolute / 6.0 }
}
