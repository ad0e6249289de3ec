//! Chains: hulls of falling numbers of faces.

use super::{mesh, of, options};
use meshsweep::check::{Surface, check_enclosure};
use meshsweep::cut::{Keep, cut_blob};
use meshsweep::mesh::Mesh;
use meshsweep::surface::VertexBits;
use meshsweep::tight::{Goal, cut, hull_mesh};
use meshsweep::tribox::volume;
use meshsweep_core::{Blob, TightHulls};
use meshsweep_host_tests::generate::{bracket, icosphere, rough_sphere, torus};

fn encloses(outer: &Mesh, inner: &Mesh) {
    let surface = |mesh: &Mesh| Surface::new(&mesh.positions, &mesh.triangles);
    let proof =
        check_enclosure(&surface(inner), &surface(outer)).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!((proof.inside, proof.faces), (inner.positions.len(), outer.triangles.len()));
}

/// The stored hulls, coarse to fine, as meshes.
fn stored(bytes: &[u8]) -> Vec<Mesh> {
    let hulls = TightHulls::open(bytes).expect("opens");
    (0..hulls.count()).map(|index| hull_mesh(&hulls.get(index).expect("a hull"))).collect()
}

#[test]
fn every_stored_hull_encloses_the_mesh_by_the_checker() {
    for shape in [torus(2.0, 0.75, 16, 10), bracket(), rough_sphere(3, 0.3, 1)] {
        let mesh = mesh(&shape);
        for bits in [VertexBits::Auto, VertexBits::Grid24, VertexBits::F32] {
            let options = options(&[150, 70]).with_vertex_bits(bits);
            let (bytes, reports) = of(&mesh, 0.0, &options);
            let hulls = stored(&bytes);
            assert_eq!(hulls.len(), 2);
            assert!(hulls[0].triangles.len() < hulls[1].triangles.len());
            hulls.iter().for_each(|hull| encloses(hull, &mesh));
            let faces: Vec<usize> = reports.iter().map(|report| report.wrapped.faces).collect();
            assert_eq!(faces, [hulls[0].triangles.len(), hulls[1].triangles.len()]);
            assert!(reports.iter().all(
                |report| matches!(report.asked, Goal::Faces(most) if report.wrapped.faces <= most)
            ));
        }
    }
}

#[test]
fn reports_and_records_tell_the_void_of_each_hull() {
    let mesh = mesh(&rough_sphere(3, 0.3, 1));
    let (bytes, reports) = of(&mesh, 0.0, &options(&[64, 120, 300]));
    let hulls = TightHulls::open(&bytes).expect("opens");
    for ((hull, report), record) in stored(&bytes).iter().zip(&reports).zip(hulls.records()) {
        let void = volume(hull) / volume(&mesh) - 1.0;
        assert!((report.void.expect("a solid") - void).abs() < 1e-9, "{void}");
        assert!((f64::from(record.void_ratio) - void).abs() < 1e-6);
    }
}

#[test]
fn the_same_mesh_makes_the_same_bytes_and_doubles_are_left_out() {
    let mesh = mesh(&icosphere(2));
    let (bytes, _) = of(&mesh, 0.0, &options(&[80, 64]));
    assert!(bytes == of(&mesh, 0.0, &options(&[64, 80, 64, 80])).0);
    // More faces than the mesh's hull needs come to no hull of their own.
    let hulls = stored(&of(&mesh, 0.0, &options(&[61, 62, 63, 64])).0);
    assert!(hulls.windows(2).all(|pair| pair[0].triangles.len() < pair[1].triangles.len()));
}

#[test]
fn a_cut_keeps_the_coarse_hulls_as_they_are() {
    let mesh = mesh(&torus(2.0, 0.75, 16, 10));
    let (bytes, _) = of(&mesh, 0.0, &options(&[64, 80, 120]));
    let blob = Blob::open(&bytes).expect("opens");
    let all: Vec<_> = blob.tight_hulls().expect("there").records().collect();
    for (kept, record) in (1..).zip(&all) {
        let tables = cut(&blob, record.faces).expect("hulls");
        let cut = tables.to_bytes();
        let left = TightHulls::open(&cut).expect("opens");
        assert!(left.records().eq(all[..kept].iter().copied()));
        for index in 0..left.count() {
            let (hull, whole) = (
                left.get(index).expect("a hull"),
                blob.tight_hulls().ok().and_then(|all| all.get(index)),
            );
            let whole = whole.expect("a hull");
            assert!(hull.bytes() == whole.bytes());
            assert!((0..record.faces).all(|face| hull.slack(face) == whole.slack(face)));
        }
        assert_eq!(
            Blob::open(&cut).expect("opens").header().surface_box,
            blob.header().surface_box
        );
    }
    // All of it, and no less than the coarsest.
    assert!(cut_blob(&blob, &Keep::default()).expect("a blob") == bytes);
    let mut coarsest = Keep::default();
    coarsest.tight = Some(4);
    let least = cut_blob(&blob, &coarsest).expect("a blob");
    assert_eq!(TightHulls::open(&least).expect("opens").count(), 1);
}
