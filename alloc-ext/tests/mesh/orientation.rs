//! A component is turned only where that is proved right, and the mesh remembers what was turned.

use meshsweep::check::{Outcome, prove_repair, verify_repair};
use meshsweep::mesh::{Filed, Mesh, RawMesh, RepairReport, repair};
use proptest::prelude::*;

type Triangles = (Vec<[f32; 3]>, Vec<[u32; 3]>);

/// A cube of the given half side about a point.
fn cube(middle: [f32; 3], half: f32) -> Triangles {
    let corner = |i: u32| [0, 1, 2].map(|k| middle[k] + if i >> k & 1 == 1 { half } else { -half });
    let faces =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let split = |[a, b, c, d]: [u32; 4]| [[a, b, c], [a, c, d]];
    ((0..8).map(corner).collect(), faces.into_iter().flat_map(split).collect())
}

/// An octahedron whose corners lie on the axes through a point.
fn octahedron(middle: [f32; 3], radii: [f32; 6]) -> Triangles {
    let corner = |i: usize| {
        let mut p = middle;
        p[i / 2] += if i.is_multiple_of(2) { radii[i] } else { -radii[i] };
        p
    };
    let faces =
        [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
    ((0..6).map(corner).collect(), faces.to_vec())
}

fn inward((positions, triangles): Triangles) -> Triangles {
    (positions, triangles.into_iter().map(|[a, b, c]| [a, c, b]).collect())
}

fn joined(parts: &[Triangles]) -> Triangles {
    let mut all = (Vec::new(), Vec::new());
    for (positions, triangles) in parts {
        let first = all.0.len() as u32;
        all.0.extend(positions);
        all.1.extend(triangles.iter().map(|t| t.map(|v| v + first)));
    }
    all
}

fn mended((positions, triangles): &Triangles) -> (Mesh, RepairReport) {
    let raw = RawMesh::from_f32(positions, triangles);
    let (mesh, report) = repair(raw.clone()).unwrap();
    let finding = verify_repair(&raw, mesh.as_input());
    assert_eq!(finding.outcome, Outcome::Proved, "{}", finding.words);
    (mesh, report)
}

/// Turned, cavities, doubtful.
fn counts(parts: &[Triangles]) -> [usize; 3] {
    // The order of components must not matter.
    let reversed: Vec<Triangles> = parts.iter().rev().cloned().collect();
    let of = |parts: &[Triangles]| {
        let (_, report) = mended(&joined(parts));
        [report.turned_components.count, report.cavities.count, report.doubtful.count]
    };
    assert_eq!(of(parts), of(&reversed));
    of(parts)
}

#[test]
fn a_cavity_whose_corner_touches_the_skin_from_within_is_a_cavity_at_every_wall() {
    let skin = || cube([0.0; 3], 10.0);
    for axis in 0..3 {
        for sign in [1.0, -1.0] {
            // On a face, on its diagonal, on an edge of the cube, on a corner.
            for place in [[1.0, 2.0], [3.0, 3.0], [10.0, 3.0], [10.0, 10.0]] {
                let mut middle = [place[0] * 0.5; 3];
                middle[axis] = sign * 6.0;
                middle[(axis + 2) % 3] = place[1] * 0.5;
                let (mut positions, triangles) = octahedron(middle, [2.0; 6]);
                let tip = &mut positions[2 * axis + usize::from(sign < 0.0)];
                *tip = [place[0]; 3];
                tip[axis] = sign * 10.0;
                tip[(axis + 2) % 3] = place[1];
                let cavity = inward((positions, triangles));
                assert_eq!(counts(&[skin(), cavity]), [0, 1, 0], "{axis} {sign} {place:?}");
            }
        }
    }
}

#[test]
fn a_cavity_that_touches_all_six_walls_is_a_cavity() {
    let cavity = inward(octahedron([1.0, 2.0, 3.0], [9.0, 11.0, 8.0, 12.0, 7.0, 13.0]));
    assert_eq!(counts(&[cube([0.0; 3], 10.0), cavity]), [0, 1, 0]);
}

#[test]
fn a_whole_that_is_inside_out_is_turned_with_a_touching_cavity() {
    let cavity = octahedron([1.0, 2.0, 3.0], [9.0, 1.0, 1.0, 1.0, 1.0, 1.0]);
    let (mesh, report) = mended(&joined(&[inward(cube([0.0; 3], 10.0)), cavity]));
    assert_eq!((report.turned_components.count, report.cavities.count), (1, 1));
    assert!(mesh.turned.iter().all(|&turned| turned) && mesh.turned.len() == 20);
}

#[test]
fn a_part_is_turned_with_all_of_its_inside_or_not_at_all() {
    let (big, small) = (inward(cube([0.0; 3], 20.0)), inward(cube([0.0; 3], 5.0)));
    // Two nested parts that face inwards: the inner one is a solid in a solid, once turned.
    assert_eq!(counts(&[big.clone(), small.clone()]), [1, 0, 0]);
    // A third one that touches the inner one: what the inner one is, is in doubt.
    let third = cube([6.0; 3], 1.0);
    assert_eq!(counts(&[big, small, third]), [0, 0, 2]);
}

#[test]
fn a_closed_surface_in_an_open_skin_is_never_turned() {
    let (positions, mut triangles) = cube([0.0; 3], 10.0);
    for missing in 0..12 {
        let hole = triangles.remove(missing);
        let skin = (positions.clone(), triangles.clone());
        assert_eq!(counts(&[skin, inward(cube([0.0; 3], 8.0))]), [0, 0, 1]);
        triangles.insert(missing, hole);
    }
    // Beside the skin it is turned.
    let skin = (positions, triangles[1..].to_vec());
    assert_eq!(counts(&[skin, inward(cube([30.0, 0.0, 0.0], 8.0))]), [1, 0, 0]);
}

#[test]
fn what_crosses_or_touches_from_without_keeps_the_files_winding() {
    let other = || cube([0.0; 3], 10.0);
    let crossing = inward(cube([10.5, 1.0, 2.0], 8.0));
    assert_eq!(counts(&[other(), crossing]), [0, 0, 1]);
    let touching = inward(octahedron([13.0, 1.0, 2.0], [3.0; 6]));
    assert_eq!(counts(&[other(), touching]), [0, 0, 1]);
    let sheet = (vec![[20.0, -9.0, -9.0], [20.0, 9.0, -9.0], [20.0, 0.0, 9.0]], vec![[0, 1, 2]]);
    let pierced = inward(cube([20.0, 0.0, 0.0], 2.0));
    assert_eq!(counts(&[sheet, pierced]), [0, 0, 1]);
}

#[test]
fn a_wrong_repair_is_not_proved() {
    let (positions, mut triangles) =
        joined(&[inward(cube([0.0; 3], 2.0)), cube([9.0, 0.0, 0.0], 1.0)]);
    let [a, b, c] = triangles[14];
    triangles.extend([[b, c, a], [a, c, b], [a, a, b]]);
    let raw = RawMesh::from_f32(&positions, &triangles);
    let (mesh, _) = repair(raw.clone()).unwrap();
    let proof = prove_repair(&raw, mesh.as_input()).unwrap();
    assert_eq!((proof.kept, proof.turned, proof.copies, proof.flat), (24, 12, 2, 1));
    let refused = |words: &str, damage: &dyn Fn(&mut Mesh)| {
        let mut damaged = mesh.clone();
        damage(&mut damaged);
        let error = prove_repair(&raw, damaged.as_input()).unwrap_err();
        assert!(error.contains(words), "{error}");
    };
    refused("wound", &|mesh| mesh.turned[3] = false);
    refused("wound", &|mesh| mesh.triangles[20].swap(0, 1));
    refused("not in the mesh", &|mesh| {
        mesh.triangles.pop();
        mesh.source.pop();
        mesh.turned.pop();
    });
    refused("not told", &|mesh| mesh.has_merged_walls = false);
    refused("does not say so", &|mesh| mesh.filed = None);
    let in_file = |mesh: &mut Mesh, damage: &dyn Fn(&mut Filed)| {
        damage(mesh.filed.as_mut().expect("copies were dropped"));
    };
    refused("of the file's", &|mesh| in_file(mesh, &|file| file.triangles.truncate(20)));
    refused("stands for", &|mesh| in_file(mesh, &|file| file.triangles[3][0] ^= 1));
    refused("a corner", &|mesh| in_file(mesh, &|file| file.positions[0][0] += 0.5));
    refused("without area, are lost", &|mesh| {
        mesh.wires.push(meshsweep::mesh::Wire { ends: [0, 1], source: 26 })
    });
}

/// A coordinate near a lattice, sometimes beside it by less than an `f32` tells.
fn coordinate() -> impl Strategy<Value = f64> {
    (0..5u8, 0..3u8).prop_map(|(step, beside)| f64::from(step) * 1.1 + f64::from(beside) * 1e-9)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    #[test]
    fn the_repair_of_any_soup_is_proved_from_the_file(
        positions in prop::collection::vec([coordinate(), coordinate(), coordinate()], 3..14),
        corners in prop::collection::vec([0..99u32, 0..99, 0..99], 1..40),
    ) {
        let count = positions.len() as u32;
        let triangles = corners.into_iter().map(|t| t.map(|v| v % count)).collect();
        let raw = RawMesh::from_f64(positions, triangles);
        let (mesh, report) = repair(raw.clone()).unwrap();
        let proof = prove_repair(&raw, mesh.as_input());
        prop_assert!(proof.is_ok(), "{proof:?}\n{report}\n{raw:?}");
        // Facings and winding numbers are those of all triangles of the file.
        if let Some(filed) = &mesh.filed {
            prop_assert_eq!(filed.triangles.len(), raw.triangles.len());
        }
    }
}
