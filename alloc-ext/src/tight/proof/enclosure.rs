//! Whether a closed surface is an outer hull of the mesh, tested as a whole and exactly.

use super::obstacle::Obstacle;
use crate::geom::{Enclosure, Enclosures, Face, is_degenerate, is_embedded};
use crate::surface::components;
use glam::DVec3;

/// Whether the faces of a closed manifold surface satisfy the whole invariant: the surface is
/// embedded, does not meet the mesh, and encloses every connected component of the mesh. Exact.
pub(crate) fn is_outer_hull(faces: &[Face], obstacle: &Obstacle) -> bool {
    !faces.iter().any(|face| is_degenerate(&face.at) || obstacle.meets(&face.at))
        && is_embedded(faces)
        && holds_witnesses(faces, obstacle)
}

/// Whether a closed surface, which may cross itself, does not meet the mesh and encloses every
/// connected component of it. Exact; where the surface overlaps itself, an even number of times is
/// outside.
pub(crate) fn holds(faces: &[Face], obstacle: &Obstacle) -> bool {
    !faces.iter().any(|face| obstacle.meets(&face.at)) && holds_witnesses(faces, obstacle)
}

fn holds_witnesses(faces: &[Face], obstacle: &Obstacle) -> bool {
    let hull = Enclosure::new(faces.iter().map(|face| face.at.map(to_f32)).collect());
    obstacle.witnesses().iter().all(|p| hull.holds(p.to_array()))
}

/// The triangles of the connected components of a closed embedded surface that lie inside no other
/// component, and the number of the others: cavities, and solids inside solids. `None` if there is
/// only one component.
///
/// Both surfaces have the same outside. The triangles are grouped by component.
pub(crate) fn outermost(
    positions: &[DVec3],
    triangles: &[[u32; 3]],
) -> Option<(Vec<[u32; 3]>, usize)> {
    let all = components(positions.len(), triangles);
    if all.len() < 2 {
        return None;
    }
    let corners = |&t: &u32| triangles[t as usize].map(|v| to_f32(positions[v as usize]));
    let enclosures = Enclosures::new(all.iter().map(|part| part.iter().map(corners).collect()));
    let is_enclosed = |i: usize| !enclosures.around(enclosures.corner(i), Some(i)).is_empty();
    let kept: Vec<usize> = (0..all.len()).filter(|&i| !is_enclosed(i)).collect();
    let dropped = all.len() - kept.len();
    let triangles = kept.into_iter().flat_map(|i| &all[i]).map(|&t| triangles[t as usize]);
    Some((triangles.collect(), dropped))
}

/// Coordinates that are `f32` numbers.
fn to_f32(p: DVec3) -> [f32; 3] {
    p.as_vec3().to_array()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::SplitMix;

    type Surface = (Vec<DVec3>, Vec<[u32; 3]>);

    /// Tetrahedra at the points of a lattice, every third with another in it, and every sixth with
    /// one in that.
    fn tetrahedra(side: usize) -> (Surface, usize) {
        let (mut positions, mut triangles) = (Vec::new(), Vec::new());
        let mut add = |at: DVec3, size: f64| {
            let first = positions.len() as u32;
            let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
            positions.extend(corners.map(|p| (at + p * size).as_vec3().as_dvec3()));
            triangles.extend(
                [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3u32]].map(|t| t.map(|v| v + first)),
            );
        };
        let mut dice = SplitMix::new(3);
        let mut within = 0;
        for n in 0..side.pow(3) {
            let at = [n % side, n / side % side, n / side / side].map(|x| 2.0 * x as f64);
            let at = DVec3::from(at) + DVec3::new(dice.roll(), dice.roll(), dice.roll());
            add(at, 1.0);
            for (size, every) in [(0.5, 3), (0.25, 6)] {
                if n % every == 0 {
                    add(at + 0.1, size);
                    within += 1;
                }
            }
        }
        ((positions, triangles), within)
    }

    #[test]
    fn components_inside_others_are_dropped() {
        for side in [1, 2, 6] {
            let ((positions, triangles), within) = tetrahedra(side);
            let (left, dropped) = outermost(&positions, &triangles).unwrap();
            assert_eq!((dropped, left.len()), (within, triangles.len() - 4 * within));
            let volume = |t: [u32; 3]| {
                let [a, b, c] = t.map(|v| positions[v as usize]);
                a.dot(b.cross(c)) / 6.0
            };
            assert!(left.iter().map(|&t| volume(t)).sum::<f64>() > left.len() as f64 / 4.0 / 6.001);
        }
    }
}
