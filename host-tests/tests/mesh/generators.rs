//! The generators keep what their documentation says, and writers and readers agree.

use std::path::Path;

use meshsweep::mesh::{Mesh, RawMesh, read_bytes, repair, require_closed_manifold};
use meshsweep_host_tests::generate::writers::{ascii_ply, ascii_stl, binary_ply, binary_stl, obj};
use meshsweep_host_tests::generate::{
    Rng, Triangles, bracket, cube, groove_block, icosphere, needle_comb, rough_sphere, scaled,
    torus, transformed, two_parts, uv_sphere,
};

/// Name, mesh, triangles, parts, sum of the parts' genera.
fn all() -> Vec<(&'static str, Triangles, usize, usize, usize)> {
    vec![
        ("torus", torus(2.0, 0.75, 48, 24), 2304, 1, 1),
        ("uv_sphere", uv_sphere(24, 12), 528, 1, 0),
        ("icosphere", icosphere(3), 1280, 1, 0),
        ("cube", cube(5), 300, 1, 0),
        ("bracket", bracket(), 1948, 1, 2),
        ("rough_sphere", rough_sphere(4, 0.2, 7), 5120, 1, 0),
        ("groove_block", groove_block(), 404, 1, 0),
        ("needle_comb", needle_comb(), 264, 1, 0),
        ("two_parts", two_parts(), 428, 2, 0),
    ]
}

#[test]
fn generated_meshes_are_clean_closed_manifolds_of_their_topology() {
    for (name, (positions, triangles), count, parts, genus) in all() {
        let (mesh, report) = repair(RawMesh::from_f32(&positions, &triangles)).unwrap();
        assert_eq!(mesh, Mesh::new(positions, triangles), "{name}: {report}");
        assert!(report.is_clean() && report.welded.count == 0, "{name}: {report}");
        assert_eq!(require_closed_manifold(&mesh), Ok(()), "{name}");
        assert_eq!(mesh.triangles.len(), count, "{name}");
        assert_eq!(
            (report.component_count, mesh.positions.len() + 2 * genus),
            (parts, count / 2 + 2 * parts),
            "{name}"
        );
    }
}

#[test]
fn every_format_gives_back_the_same_triangles() {
    for (name, mesh, ..) in all() {
        let corners = |positions: &[[f32; 3]], triangles: &[[u32; 3]]| -> Vec<[[f32; 3]; 3]> {
            triangles.iter().map(|t| t.map(|v| positions[v as usize])).collect()
        };
        let wanted = corners(&mesh.0, &mesh.1);
        let files = [
            ("a.stl", binary_stl(&mesh)),
            ("b.stl", ascii_stl(&mesh)),
            ("a.obj", obj(&mesh)),
            ("a.ply", binary_ply(&mesh)),
            ("b.ply", ascii_ply(&mesh)),
        ];
        for (file, bytes) in files {
            let (read, report) = repair(read_bytes(Path::new(file), bytes).unwrap()).unwrap();
            assert_eq!(corners(&read.positions, &read.triangles), wanted, "{name} {file}");
            assert!(read.rounding == 0.0 && report.is_clean(), "{name} {file}: {report}");
            assert_eq!(read.positions.len(), mesh.0.len(), "{name} {file}");
        }
    }
}

#[test]
fn obj_reader_agrees_with_tobj() {
    let text = "v 0 0 0\nv 1.25 0 1e-3\nv 1 1 0.1\nv 0 1 -7\nv .5 2 0\nvt 0 0\nvn 0 0 1\n\
                f 1//1 2//1 3//1 4//1 5//1\nf -1 -2 -3\nf 5/1/1 4/1/1 1/1/1\n";
    let raw = read_bytes(Path::new("a.obj"), text.into()).unwrap();
    let options = tobj::LoadOptions { triangulate: true, ..Default::default() };
    let (models, _) =
        tobj::load_obj_buf(&mut text.as_bytes(), &options, |_| Err(tobj::LoadError::ReadError))
            .unwrap();
    let mesh = &models[0].mesh;
    let theirs: Vec<f64> =
        mesh.indices.iter().flat_map(|&i| mesh.positions[3 * i as usize..][..3].to_vec()).collect();
    let ours: Vec<f64> =
        raw.triangles.iter().flatten().flat_map(|&v| raw.positions[v as usize]).collect();
    assert_eq!(ours, theirs);
}

#[test]
fn scaling_by_a_power_of_two_scales_exactly() {
    let mesh = rough_sphere(2, 0.3, 1);
    assert_eq!(scaled(&scaled(&mesh, 1.0 / 1_048_576.0), 1_048_576.0), mesh);
    let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    assert_eq!(transformed(&mesh, identity, [0.0; 3]), mesh);
}

#[test]
fn random_numbers_are_those_of_splitmix64() {
    let mut rng = Rng::new(1_234_567);
    assert_eq!(rng.next_u64(), 6_457_827_717_110_365_317);
    assert_eq!(rng.next_u64(), 3_203_168_211_198_807_973);
    for _ in 0..1000 {
        assert!((0.0..1.0).contains(&rng.unit_f64()) && (0.0..1.0).contains(&rng.unit_f32()));
        assert!(rng.below(7) < 7);
        let length_sq: f32 = rng.direction().iter().map(|x| x * x).sum();
        assert!((length_sq - 1.0).abs() < 1e-6);
    }
}

#[test]
fn rotated_and_distorted_soups_are_repaired_to_a_fixed_point() {
    let mut rng = Rng::new(5);
    for (name, (positions, mut triangles), ..) in all() {
        for t in &mut triangles {
            match rng.below(8) {
                0 => t.swap(0, 1),
                1 => t[2] = t[1],
                2 => *t = [rng.below(positions.len()) as u32, t[1], t[2]],
                _ => {}
            }
        }
        let (once, _) = repair(RawMesh::from_f32(&positions, &triangles)).unwrap();
        let (twice, report) = repair(RawMesh::from_f32(&once.positions, &once.triangles)).unwrap();
        // Welding and splitting again may number the copies of a vertex anew, nothing else.
        let corners =
            |m: &Mesh| -> Vec<_> { (0..m.triangles.len()).map(|t| m.corners(t)).collect() };
        assert_eq!(corners(&once), corners(&twice), "{name}: {report}");
        assert_eq!(once.positions.len(), twice.positions.len(), "{name}");
    }
}
