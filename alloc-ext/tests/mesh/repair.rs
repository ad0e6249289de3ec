//! What repair mends, and that it mends nothing else.

use meshsweep::mesh::{Mesh, MeshError, RawMesh, RepairReport, repair, require_closed_manifold};

type Triangles = (Vec<[f32; 3]>, Vec<[u32; 3]>);

fn mend(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> (Mesh, RepairReport) {
    repair(RawMesh::from_f32(positions, triangles)).unwrap()
}

const TETRAHEDRON: [[f32; 3]; 4] =
    [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
const SIDES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];

fn tetrahedron_at(shift: f32, size: f32, inside_out: bool) -> Triangles {
    let positions = TETRAHEDRON.iter().map(|p| p.map(|x| x * size + shift)).collect();
    (
        positions,
        SIDES.iter().map(|&[a, b, c]| if inside_out { [a, c, b] } else { [a, b, c] }).collect(),
    )
}

fn join(parts: &[Triangles]) -> Triangles {
    let mut all = (Vec::new(), Vec::new());
    for (positions, triangles) in parts {
        let first = all.0.len() as u32;
        all.0.extend(positions);
        all.1.extend(triangles.iter().map(|t| t.map(|v| v + first)));
    }
    all
}

/// Six times the signed volume.
fn volume(mesh: &Mesh) -> f64 {
    let det = |t: usize| {
        let [a, b, c] = mesh.corners(t).unwrap().map(|p| p.map(f64::from));
        a[0] * (b[1] * c[2] - b[2] * c[1])
            + a[1] * (b[2] * c[0] - b[0] * c[2])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
    };
    (0..mesh.triangles.len()).map(det).sum()
}

#[test]
fn clean_mesh_is_returned_bit_for_bit() {
    let (mesh, report) = mend(&TETRAHEDRON, &SIDES);
    assert_eq!(mesh, Mesh::new(TETRAHEDRON.to_vec(), SIDES.to_vec()));
    assert!(report.is_clean());
    assert_eq!(
        report.to_string(),
        "4 vertices, 4 triangles read; 4 vertices, 4 triangles kept in 1 connected component"
    );
}

#[test]
fn weld_merges_negative_zero() {
    let mut positions = TETRAHEDRON.to_vec();
    positions.push([-0.0, 1.0, -0.0]);
    let mut triangles = SIDES;
    triangles[3] = [0, 3, 4];
    let (mesh, report) = mend(&positions, &triangles);
    assert_eq!(require_closed_manifold(&mesh), Ok(()));
    assert_eq!(report.welded.count, 1);
    assert_eq!(report.welded.places[0].vertex, Some(4));
    assert!(mesh.positions.iter().flatten().all(|x| x.to_bits() != (-0.0f32).to_bits()));
}

#[test]
fn triangle_with_repeated_corner_is_dropped_and_the_mesh_stays_closed() {
    let mut triangles = SIDES.to_vec();
    triangles.insert(1, [2, 3, 2]);
    let (mesh, report) = mend(&TETRAHEDRON, &triangles);
    assert_eq!(require_closed_manifold(&mesh), Ok(()));
    assert_eq!(report.repeated_corner.places[0].triangle, Some(1));
    assert_eq!(mesh.source, [0, 2, 3, 4]);
}

#[test]
fn duplicates_are_dropped_whatever_their_winding_and_told_apart() {
    let mut triangles = SIDES.to_vec();
    triangles.extend([[2, 1, 0], [0, 1, 2]]);
    let (mesh, report) = mend(&TETRAHEDRON, &triangles);
    assert_eq!(mesh.triangles, SIDES);
    assert_eq!((report.duplicate.count, report.opposite_duplicate.count), (1, 1));
}

#[test]
fn two_sided_sheet_keeps_its_surface() {
    let (mesh, _) = mend(&TETRAHEDRON, &[[0, 1, 2], [0, 2, 1]]);
    assert_eq!(mesh.triangles.len(), 1);
}

#[test]
fn unreferenced_vertices_are_dropped_and_counted() {
    let mut positions = vec![[9.0; 3]];
    positions.extend(TETRAHEDRON);
    let (mesh, report) = mend(&positions, &SIDES.map(|t| t.map(|v| v + 1)));
    assert_eq!(mesh.positions, TETRAHEDRON);
    assert_eq!(report.unreferenced.places[0].vertex, Some(0));
}

#[test]
fn cap_is_removed_by_an_edge_flip_and_the_mesh_stays_closed() {
    let mut positions = TETRAHEDRON.to_vec();
    positions.push([0.5, 0.0, 0.0]);
    let triangles = [[0, 2, 1], [0, 1, 4], [0, 4, 3], [4, 1, 3], [1, 2, 3], [0, 3, 2]];
    let (mesh, report) = mend(&positions, &triangles);
    assert_eq!(require_closed_manifold(&mesh), Ok(()));
    assert_eq!((report.flipped_caps.count, report.zero_area.count), (1, 0));
    assert_eq!(report.flipped_caps.places[0].triangle, Some(1));
    assert_eq!(volume(&mesh), 1.0);
    assert_eq!(mesh.source, [0, 0, 2, 3, 4, 5]);
}

#[test]
fn chain_of_caps_on_one_edge_is_removed_in_any_order() {
    // The edge 0–1 is divided at 1/8 … 7/8; the gap to the undivided side is filled by a fan of
    // caps.
    let mut positions = TETRAHEDRON.to_vec();
    positions.extend((1..8).map(|i| [i as f32 / 8.0, 0.0, 0.0]));
    let line = [0, 4, 5, 6, 7, 8, 9, 10, 1];
    let mut triangles: Vec<[u32; 3]> = line.windows(2).map(|p| [p[0], p[1], 3]).collect();
    // Fans about either end, and a fan that zigzags.
    let about_first: Vec<[u32; 3]> = line.windows(2).skip(1).map(|p| [p[1], p[0], 0]).collect();
    let about_last: Vec<[u32; 3]> = line.windows(2).take(7).map(|p| [p[1], p[0], 1]).collect();
    let zigzag =
        vec![[1, 10, 0], [10, 4, 0], [10, 9, 4], [9, 5, 4], [9, 8, 5], [8, 6, 5], [8, 7, 6]];
    triangles.extend([[0, 2, 1], [1, 2, 3], [0, 3, 2]]);
    for mut caps in [about_first, about_last, zigzag] {
        for _ in 0..caps.len() {
            caps.rotate_left(1);
            let all = [caps.clone(), triangles.clone()].concat();
            let (mesh, report) = mend(&positions, &all);
            assert_eq!(require_closed_manifold(&mesh), Ok(()), "{report}");
            assert_eq!((report.flipped_caps.count, report.zero_area.count), (7, 0));
            assert_eq!(volume(&mesh), 1.0);
        }
    }
}

#[test]
fn two_caps_back_to_back_are_removed() {
    // Both sides of the edge 0–1 are divided, at different places; two caps across 0–1 fill the
    // gap.
    let mut positions = TETRAHEDRON.to_vec();
    positions.extend([[0.25, 0.0, 0.0], [0.75, 0.0, 0.0]]);
    let triangles =
        [[0, 1, 4], [1, 0, 5], [0, 4, 3], [4, 1, 3], [0, 2, 5], [5, 2, 1], [1, 2, 3], [0, 3, 2]];
    let (mesh, report) = mend(&positions, &triangles);
    assert_eq!(require_closed_manifold(&mesh), Ok(()), "{report}");
    assert_eq!((report.flipped_caps.count, report.zero_area.count), (2, 0));
    assert_eq!(volume(&mesh), 1.0);
}

#[test]
fn hole_left_by_a_dropped_triangle_names_it() {
    let mut positions = TETRAHEDRON.to_vec();
    positions.push([0.5, 0.0, 0.0]);
    // The face across the cap's long edge is missing.
    let triangles = [[0, 4, 3], [4, 1, 3], [1, 2, 3], [0, 3, 2], [0, 1, 4]];
    let (mesh, report) = mend(&positions, &triangles);
    let error = report.explain(require_closed_manifold(&mesh).unwrap_err());
    assert!(matches!(error, MeshError::Open { dropped_triangle: Some(4), .. }), "{error}");
}

#[test]
fn thin_triangle_that_is_not_flat_is_kept() {
    let positions = [[0.0, 0.0, 0.0], [1.0, f32::from_bits(1), 0.0], [2.0, 0.0, 0.0]];
    assert_eq!(mend(&positions, &[[0, 1, 2]]).0.triangles.len(), 1);
    // On a line only in f32 arithmetic: the exact determinant is not zero.
    let positions = [[0.1, 0.1, 0.1], [0.2, 0.2, 0.2], [0.3, 0.3, 0.3f32.next_up()]];
    assert_eq!(mend(&positions, &[[0, 1, 2]]).0.triangles.len(), 1);
}

#[test]
fn mesh_without_area_is_kept_as_wires_and_refused_for_a_hull() {
    let positions = [[0.1, 0.1, 0.1], [0.2, 0.2, 0.2], [0.4, 0.4, 0.4]];
    for (positions, triangle, ends) in
        [(&positions[..], [0, 1, 2], [2, 0]), (&[[0.0; 3]], [0, 0, 0], [0, 0])]
    {
        let (mesh, report) = mend(positions, &[triangle]);
        assert_eq!((mesh.triangles.len(), report.wires.count), (0, 1));
        let at = |v: u32| mesh.positions[v as usize];
        assert_eq!(mesh.wires[0].ends.map(at), ends.map(|v: usize| positions[v]));
        assert_eq!(require_closed_manifold(&mesh), Err(MeshError::NoArea { count: 1 }));
    }
}

#[test]
fn bow_tie_vertex_is_split_into_one_copy_per_fan() {
    let mut positions = TETRAHEDRON.to_vec();
    positions.extend([[-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]]);
    let triangles = [SIDES.as_slice(), &[[0, 4, 5], [0, 5, 6], [5, 4, 6], [0, 6, 4]]].concat();
    assert!(matches!(
        require_closed_manifold(&Mesh::new(positions.clone(), triangles.clone())),
        Err(MeshError::NonManifoldVertices { count: 1, .. })
    ));
    let (mesh, report) = mend(&positions, &triangles);
    assert_eq!(require_closed_manifold(&mesh), Ok(()));
    assert_eq!(
        (report.split_vertices.count, report.component_count, mesh.positions.len()),
        (1, 2, 8)
    );
    assert_eq!(report.split_vertices.places[0].vertex, Some(0));
}

#[test]
fn minority_is_rewound_and_the_majority_stays() {
    let mut triangles = SIDES;
    triangles[2] = [1, 3, 2];
    let raw = Mesh::new(TETRAHEDRON.to_vec(), triangles.to_vec());
    assert!(matches!(
        require_closed_manifold(&raw),
        Err(MeshError::InconsistentWinding { edge_count: 3, .. })
    ));
    let (mesh, report) = mend(&TETRAHEDRON, &triangles);
    assert_eq!(require_closed_manifold(&mesh), Ok(()));
    assert_eq!((report.rewound.count, report.turned_components.count), (1, 0));
    assert_eq!(report.rewound.places[0].triangle, Some(2));
}

#[test]
fn inside_out_solid_is_turned() {
    let (positions, triangles) = tetrahedron_at(0.0, 1.0, true);
    let raw = Mesh::new(positions.clone(), triangles.clone());
    assert!(matches!(
        require_closed_manifold(&raw),
        Err(MeshError::InsideOut { component_count: 1, .. })
    ));
    let (mesh, report) = mend(&positions, &triangles);
    assert_eq!(volume(&mesh), 1.0);
    assert_eq!(report.turned_components.count, 1);
}

#[test]
fn cavity_is_kept_and_a_solid_in_a_solid_too() {
    let outer = tetrahedron_at(-1.0, 8.0, false);
    for inside_out in [false, true] {
        let (positions, triangles) = join(&[outer.clone(), tetrahedron_at(0.0, 1.0, inside_out)]);
        let (mesh, report) = mend(&positions, &triangles);
        assert_eq!(mesh.triangles, triangles);
        assert_eq!(report.cavities.count, usize::from(inside_out));
        assert_eq!(require_closed_manifold(&mesh), Ok(()));
    }
}

#[test]
fn inside_out_shell_is_turned_together_with_what_is_inside() {
    let (positions, triangles) = join(&[
        tetrahedron_at(-1.0, 8.0, true),
        tetrahedron_at(0.0, 1.0, false),
        tetrahedron_at(20.0, 1.0, true),
        tetrahedron_at(30.0, 1.0, false),
    ]);
    let (mesh, report) = mend(&positions, &triangles);
    assert_eq!((report.turned_components.count, report.cavities.count), (2, 1));
    assert!((volume(&mesh) - (512.0 - 1.0 + 1.0 + 1.0)).abs() < 1e-9);
}

#[test]
fn part_beside_another_inside_its_box_is_not_taken_for_nested() {
    // Inside the box of the large tetrahedron, but beyond its slanted face.
    let (positions, triangles) =
        join(&[tetrahedron_at(0.0, 8.0, false), tetrahedron_at(5.0, 1.0, true)]);
    let (mesh, report) = mend(&positions, &triangles);
    assert_eq!((report.turned_components.count, report.cavities.count), (1, 0));
    assert_eq!(require_closed_manifold(&mesh), Ok(()));
}

#[test]
fn nesting_is_decided_though_rays_meet_vertices_and_edges() {
    // The inner octahedron's vertices lie below the outer one's, on the same verticals.
    let octahedron = |r: f32, inside_out: bool| {
        let positions = vec![
            [r, 0.0, 0.0],
            [-r, 0.0, 0.0],
            [0.0, r, 0.0],
            [0.0, -r, 0.0],
            [0.0, 0.0, r],
            [0.0, 0.0, -r],
        ];
        let faces = [
            [0, 2, 4],
            [2, 1, 4],
            [1, 3, 4],
            [3, 0, 4],
            [2, 0, 5],
            [1, 2, 5],
            [3, 1, 5],
            [0, 3, 5],
        ];
        (positions, faces.map(|[a, b, c]| if inside_out { [a, c, b] } else { [a, b, c] }).to_vec())
    };
    let (positions, triangles) =
        join(&[octahedron(4.0, false), octahedron(1.0, true), octahedron(0.5, false)]);
    let (mesh, report) = mend(&positions, &triangles);
    assert_eq!(mesh.triangles, triangles);
    assert_eq!((report.cavities.count, report.turned_components.count), (1, 0));
}

#[test]
fn one_sided_part_is_recorded_and_left_alone() {
    // A Möbius strip of five triangles.
    let positions =
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.5, 1.0, 0.0], [0.5, 1.5, 0.5], [-0.5, 1.0, 1.0]];
    let triangles = [[0, 1, 2], [1, 2, 3], [2, 3, 4], [3, 4, 0], [4, 0, 1]];
    let (mesh, report) = mend(&positions, &triangles);
    assert_eq!(mesh.triangles, triangles);
    assert_eq!(report.non_orientable.count, 1);
}

#[test]
fn soup_is_accepted_with_all_its_holes() {
    let (mesh, report) = mend(&TETRAHEDRON, &[[0, 1, 2], [0, 1, 3]]);
    assert_eq!(mesh.triangles.len(), 2);
    assert_eq!(report.component_count, 1);
}

#[test]
fn invalid_arrays_are_refused_not_trusted() {
    let mut mesh = Mesh::new(TETRAHEDRON.to_vec(), SIDES.to_vec());
    mesh.triangles[0][0] = 7;
    assert!(matches!(require_closed_manifold(&mesh), Err(MeshError::Invalid { .. })));
    assert!(matches!(require_closed_manifold(&Mesh::default()), Err(MeshError::Invalid { .. })));
    assert!(matches!(
        repair(RawMesh::from_f32(&TETRAHEDRON, &[[0, 1, 4]])),
        Err(MeshError::IndexOutOfRange { index: 4, .. })
    ));
    let mut positions = TETRAHEDRON;
    positions[3][1] = f32::INFINITY;
    assert!(matches!(
        repair(RawMesh::from_f32(&positions, &SIDES)),
        Err(MeshError::NotFinite { vertex: 3, .. })
    ));
}

#[test]
fn holes_are_counted_and_one_edge_of_each_is_named() {
    let (positions, triangles) =
        join(&[tetrahedron_at(0.0, 1.0, false), tetrahedron_at(5.0, 1.0, false)]);
    // One triangle less in the first, two in the second.
    let (mesh, _) = mend(&positions, &[&triangles[1..5], &triangles[7..]].concat());
    match require_closed_manifold(&mesh) {
        Err(MeshError::Open {
            edge_count, hole_count, largest_hole, slit_count, places, ..
        }) => {
            assert_eq!(
                (edge_count, hole_count, largest_hole, slit_count, places.len()),
                (7, 2, 4, 0, 2)
            );
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn flat_closed_part_is_refused_for_want_of_volume() {
    let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
    let (mesh, _) = mend(&positions, &SIDES);
    assert!(matches!(require_closed_manifold(&mesh), Err(MeshError::ZeroVolume { .. })));
}

#[test]
fn caps_of_one_fan_are_flipped_without_trying_all_of_them_for_each() {
    // With a trial of all for each flip, this takes minutes.
    let count = 100_000u32;
    let mut positions: Vec<[f32; 3]> = (0..count).map(|k| [k as f32, 0.0, 0.0]).collect();
    positions.extend([[count as f32, 5.0, 0.0], [0.0, 5.0, 0.0]]);
    let fan: Vec<[u32; 3]> = (1..=count).map(|k| [0, k, k + 1]).collect();
    let (mesh, report) = repair(RawMesh::from_f32(&positions, &fan)).unwrap();
    assert_eq!(report.flipped_caps.count, count as usize - 2);
    assert_eq!((mesh.triangles.len(), mesh.wires.len()), (fan.len(), 0));
}
