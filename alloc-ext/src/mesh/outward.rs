//! Closed components: their volumes, their nesting, and whether they are inside out.
//!
//! A component that lies inside no other must face outwards. It is inside out if its signed volume
//! is negative. Then it is turned together with all components inside it, for those were drawn
//! relative to it. A component inside another is never judged on its own: facing inwards it is a
//! cavity, facing outwards it is a solid within a solid, and both are valid. A component whose
//! volume may be zero within rounding is left unchanged. Components that are open, one-sided or on
//! a non-manifold edge have no inside and do not count.

use super::volume::SignedVolume;
use super::winding::Components;
use crate::geom::Enclosure;
use glam::Vec3;

/// A closed two-sided component.
pub(super) struct ClosedComponent {
    /// Its number in [`Components`].
    pub number: u32,
    /// Its first triangle.
    pub first: u32,
    pub volume: SignedVolume,
    /// It is inside out, or lies in an outermost component that is.
    pub inside_out: bool,
    /// It lies in another closed component.
    pub nested: bool,
}

/// All closed two-sided components of `triangles`, which must be wound consistently.
pub(super) fn closed_components(
    positions: &[[f32; 3]],
    triangles: &[[u32; 3]],
    parts: &Components,
) -> Vec<ClosedComponent> {
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
    let solids: Vec<(u32, Enclosure)> = gathered
        .into_iter()
        .enumerate()
        .filter(|(_, t)| !t.is_empty())
        .map(|(number, t)| (number as u32, Enclosure::new(t)))
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
            ClosedComponent {
                number,
                first: firsts[number as usize],
                volume: volumes[i],
                inside_out: containers[outermost].is_empty() && volumes[outermost].is_negative(),
                nested: !containers[i].is_empty(),
            }
        })
        .collect()
}
