//! The volume that a mesh bounds, and the void of its hull.

use super::components::components;
use crate::geom::{Enclosures, crosses_itself};
use crate::mesh::{Mesh, NoVolume, SignedVolume, require_closed_manifold};
use glam::DVec3;

/// A mesh that bounds a volume.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Solid {
    /// In the mesh's unit, above 0. Where the mesh overlaps itself, places count more than once.
    pub volume: f64,
    /// The same less the most that rounding may have added.
    least: f64,
}

type Triangles = Vec<[[f32; 3]; 3]>;

fn signed_volume(triangles: &[[[f32; 3]; 3]]) -> SignedVolume {
    SignedVolume::of(triangles.iter().map(|t| t.map(|p| DVec3::from(p.map(f64::from)))))
}

impl Solid {
    pub fn of(mesh: &Mesh) -> Result<Self, NoVolume> {
        require_closed_manifold(mesh).map_err(|error| NoVolume::of(&error))?;
        let components: Vec<Triangles> = components(mesh.positions.len(), &mesh.triangles)
            .into_iter()
            .map(|triangles| {
                triangles.into_iter().filter_map(|t| mesh.corners(t as usize)).collect()
            })
            .collect();
        let (mut volume, mut bound) = (0.0, 0.0);
        let mut faces_out = Vec::new();
        for component in &components {
            let signed = signed_volume(component);
            volume += signed.value;
            // The sum adds one rounding for each component.
            let roundings = components.len() as f64 + 2.0;
            bound += signed.bound + roundings * f64::EPSILON * signed.value.abs();
            faces_out.push(signed.value > 0.0);
        }
        if volume <= -bound || winds_more_than_once(mesh, components, &faces_out) {
            return Err(NoVolume::Overlapping);
        }
        if volume <= bound {
            return Err(NoVolume::Indistinct);
        }
        Ok(Self { volume, least: volume - 2.0 * bound })
    }

    /// Whether the volume is certainly larger than that of a closed surface, by its triangles, that
    /// encloses the mesh. The mesh then overlaps itself.
    pub fn is_more_than(&self, hull: &[[[f32; 3]; 3]]) -> bool {
        let SignedVolume { value, bound } = signed_volume(hull);
        value + bound < self.least
    }

    /// Void of a hull: its volume beyond the mesh's, as a fraction of the mesh's volume.
    pub fn void(&self, hull: &Mesh, volume: f64) -> Result<f64, NoVolume> {
        let triangles: Triangles =
            (0..hull.triangles.len()).filter_map(|t| hull.corners(t)).collect();
        if self.is_more_than(&triangles) {
            return Err(NoVolume::Overlapping);
        }
        // A hull always leaves some void, even if rounding shows none.
        let rounding = (self.volume - self.least) / self.volume;
        Ok((volume / self.volume - 1.0).max(rounding))
    }
}

/// Whether components that do not meet lie in each other so that a place has a winding number other
/// than 0 or 1: solids in solids, cavities in cavities. False where components meet.
fn winds_more_than_once(mesh: &Mesh, components: Vec<Triangles>, faces_out: &[bool]) -> bool {
    if components.len() < 2 {
        return false;
    }
    let enclosures = Enclosures::new(components);
    let is_wrong = |i: usize| {
        let around = enclosures.around(enclosures.corner(i), Some(i));
        let winding: i32 = around.into_iter().map(|j| if faces_out[j] { 1 } else { -1 }).sum();
        winding != i32::from(!faces_out[i])
    };
    if !(0..faces_out.len()).any(is_wrong) {
        return false;
    }
    // Of components that touch, one may seem to be in the other.
    let positions: Vec<DVec3> =
        mesh.positions.iter().map(|p| DVec3::from(p.map(f64::from))).collect();
    !crosses_itself(&positions, &mesh.triangles)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A corner of a cube, counter-clockwise seen from outside.
    const CORNER: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

    fn volume(mesh: &Mesh) -> Result<f64, NoVolume> {
        Solid::of(mesh).map(|solid| solid.volume)
    }

    fn tetrahedron(size: f32, at: f32) -> Vec<[f32; 3]> {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0f32]];
        corners.map(|p| p.map(|x| x * size + at)).to_vec()
    }

    fn joined(parts: &[(Vec<[f32; 3]>, bool)]) -> Mesh {
        let (mut positions, mut triangles) = (Vec::new(), Vec::new());
        for (corners, inward) in parts {
            let first = positions.len() as u32;
            positions.extend(corners);
            let turned = |[a, b, c]: [u32; 3]| if *inward { [a, c, b] } else { [a, b, c] };
            triangles.extend(CORNER.map(|t| turned(t).map(|v| v + first)));
        }
        Mesh::new(positions, triangles)
    }

    #[test]
    fn solids_have_a_volume_and_cavities_take_from_it() {
        let solid = joined(&[(tetrahedron(6.0, 1e6), false)]);
        assert_eq!(volume(&solid), Ok(36.0));
        let hollow = joined(&[(tetrahedron(6.0, 0.0), false), (tetrahedron(3.0, 0.5), true)]);
        assert_eq!(volume(&hollow), Ok(36.0 - 4.5));
    }

    #[test]
    fn the_reason_is_the_mesh_s_own_defect() {
        let of = |positions: Vec<[f32; 3]>, triangles: &[[u32; 3]]| {
            volume(&Mesh::new(positions, triangles.to_vec())).unwrap_err()
        };
        let unit = || tetrahedron(1.0, 0.0);
        let said = |why: NoVolume, words: &str| {
            let text = why.to_string();
            assert!(text.contains(words), "{text}");
            why
        };
        let open = said(of(unit(), &CORNER[..3]), "not closed: 3 boundary edges, as at triangle");
        assert!(matches!(open, NoVolume::Open { edges: 3, .. }));
        let wall = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3], [0, 1, 4], [1, 2, 4], [2, 0, 4]];
        let five = [unit(), vec![[0.0, 0.0, -1.0]]].concat();
        let crowded = said(of(five, &wall), "not manifold: 3 edges with up to 3 triangles");
        assert!(matches!(crowded, NoVolume::NonManifold { edges: 3, most: 3, .. }));
        let mixed = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 2, 3]];
        let mixed = said(of(unit(), &mixed), "against each other at 3 edges");
        assert!(matches!(mixed, NoVolume::MixedWinding { edges: 3, .. }));
        let inverted = joined(&[(unit(), true)]);
        let inverted = said(
            volume(&inverted).unwrap_err(),
            "inside out: 1 outermost component, as at [0.0, 0.0, 0.0]",
        );
        assert_eq!(inverted, NoVolume::InsideOut { components: 1, at: [0.0; 3] });
        let flat = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0f32]];
        let flat = said(of(flat, &CORNER), "has a volume that cannot be told from 0");
        assert_eq!(flat, NoVolume::Flat { triangle: 0, at: [0.0; 3] });
        let two = [unit(), unit()[1..].iter().map(|p| p.map(|x| -x)).collect()].concat();
        let tips = [
            [0, 2, 1],
            [0, 1, 3],
            [1, 2, 3],
            [2, 0, 3],
            [0, 4, 5],
            [0, 6, 4],
            [4, 6, 5],
            [5, 6, 0],
        ];
        let pinched = said(of(two, &tips), "several fans meet in 1 vertex, as at [0.0, 0.0, 0.0]");
        assert_eq!(pinched, NoVolume::Pinched { vertices: 1, at: [0.0; 3] });
        assert_eq!(said(of(unit(), &[[0, 1, 9]]), "not a valid one"), NoVolume::Invalid);
    }

    #[test]
    fn a_strip_that_ends_where_its_other_side_begins_has_no_outside() {
        // Closed: the real projective plane of six vertices. Where they are does not matter.
        let six = (0..6u8).map(f32::from).map(|k| [k, k * k, k * k * k]).collect();
        let faces = [
            [0, 1, 2],
            [0, 2, 3],
            [0, 3, 4],
            [0, 4, 5],
            [0, 5, 1],
            [1, 2, 4],
            [2, 3, 5],
            [3, 4, 1],
            [4, 5, 2],
            [5, 1, 3],
        ];
        let why = volume(&Mesh::new(six, faces.to_vec())).unwrap_err();
        assert!(matches!(why, NoVolume::OneSided { components: 1, .. }), "{why:?}");
        assert!(
            why.to_string().contains("no outside: 1 one-sided component, as at triangle"),
            "{why}"
        );
    }

    #[test]
    fn cavities_that_take_away_more_than_there_is_overlap() {
        let cavity = |at: f32| (tetrahedron(9.0, at), true);
        let hollow = joined(&[(tetrahedron(10.0, 0.0), false), cavity(0.1), cavity(0.2)]);
        assert_eq!(volume(&hollow), Err(NoVolume::Overlapping));
    }

    #[test]
    fn solids_in_solids_and_cavities_in_cavities_overlap_and_solids_in_cavities_do_not() {
        let of = |parts: &[(f32, f32, bool)]| {
            volume(&joined(
                &parts
                    .iter()
                    .map(|&(size, at, inward)| (tetrahedron(size, at), inward))
                    .collect::<Vec<_>>(),
            ))
        };
        let solid = (20.0, 0.0, false);
        assert_eq!(of(&[solid, (2.0, 1.0, false)]), Err(NoVolume::Overlapping));
        assert_eq!(of(&[solid, (8.0, 1.0, true), (2.0, 2.0, true)]), Err(NoVolume::Overlapping));
        let full = 20f64.powi(3) / 6.0;
        let hollow = of(&[solid, (8.0, 1.0, true), (2.0, 2.0, false)]).unwrap();
        assert!((hollow - (full - 512.0 / 6.0 + 8.0 / 6.0)).abs() < 1e-9, "{hollow}");
        // Hidden from all sums: a solid in the solid, and a cavity with more volume.
        assert_eq!(of(&[solid, (8.0, 0.1, true), (1.0, 4.0, false)]), Err(NoVolume::Overlapping));
        // Touching, so that either may count as in the other.
        let twin = of(&[(2.0, 0.0, false), (2.0, 0.0, false)]);
        assert_eq!(twin, Ok(16.0 / 6.0));
    }

    #[test]
    fn small_parts_far_apart_have_their_volume() {
        let far = joined(&[(tetrahedron(1.0, 0.0), false), (tetrahedron(1.0, 131_072.0), false)]);
        assert_eq!(volume(&far), Ok(1.0 / 3.0));
    }

    #[test]
    fn a_mesh_that_is_more_than_its_hull_overlaps() {
        // Two halves over each other in a hull that is a tenth larger than one.
        let twice = joined(&[(tetrahedron(1.0, 0.0), false), (tetrahedron(1.0, 0.01), false)]);
        let hull = joined(&[(tetrahedron(1.1, -0.01), false)]);
        let solid = Solid::of(&twice).unwrap();
        assert_eq!(solid.void(&hull, 1.331 / 6.0), Err(NoVolume::Overlapping));
        // A hull of the same volume proves nothing, however it is rounded.
        let once = joined(&[(tetrahedron(1.1, -0.01), false)]);
        let volume = Solid::of(&once).unwrap().volume;
        let void = Solid::of(&once).unwrap().void(&hull, volume * (1.0 - 1e-12)).unwrap();
        assert!(void > 0.0 && void < 1e-9, "{void}");
    }

    #[test]
    fn crossing_and_touching_are_found_and_neighbours_are_not() {
        let crosses = |parts: &[(Vec<[f32; 3]>, bool)]| {
            let mesh = joined(parts);
            let positions: Vec<DVec3> =
                mesh.positions.iter().map(|p| DVec3::from(p.map(f64::from))).collect();
            crosses_itself(&positions, &mesh.triangles)
        };
        let one = || (tetrahedron(1.0, 0.0), false);
        assert!(!crosses(&[one()]));
        assert!(!crosses(&[one(), (tetrahedron(1.0, 2.0), false)]));
        assert!(!crosses(&[one(), (tetrahedron(0.1, 0.05), true)]), "a cavity");
        assert!(crosses(&[one(), (tetrahedron(1.0, 0.01), false)]));
        let touching = tetrahedron(1.0, 0.0).iter().map(|p| p.map(|x| -x)).collect();
        assert!(crosses(&[one(), (touching, true)]), "one corner for two");
    }
}
