//! Closed parts: their volume, which lie inside which, and which are inside out.
//!
//! The rule. A part that lies inside no other must face outwards, so it is inside out if its signed
//! volume is negative; then it is turned, and all parts inside it with it, because they were drawn
//! relative to it. Parts inside another are never judged on their own: facing inwards they are
//! cavities, facing outwards they are solids within a solid, and both are legitimate. A volume that
//! rounding cannot tell from zero is left alone. Parts that are open, one-sided or
//! on a non-manifold edge have no inside and are not looked at.

use super::nesting::Part;
use super::volume::SignedVolume;
use super::winding::Parts;
use glam::Vec3;

/// One closed two-sided part.
pub(super) struct ClosedPart {
    /// Its number in [`Parts`].
    pub number: u32,
    /// Its first triangle.
    pub first: u32,
    pub volume: SignedVolume,
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
    let wide = |triangle: &[[f32; 3]; 3]| triangle.map(|p| Vec3::from(p).as_dvec3());
    let volumes: Vec<SignedVolume> =
        solids.iter().map(|(_, part)| SignedVolume::of(part.triangles.iter().map(wide))).collect();
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
