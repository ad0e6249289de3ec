//! The bytes of a field: as many as were asked for, the same on any number of threads.

use super::decoded::Field;
use meshsweep::Builder;
use meshsweep::builder::{For, SdfKind, SdfLayout};
use meshsweep::mesh::RawMesh;
use meshsweep_host_tests::generate::{block, bracket, rough_sphere};

#[test]
fn a_field_takes_most_of_its_bytes_and_no_more() {
    let (positions, triangles) = block([0.0; 3], [3.0, 2.0, 1.0]);
    for (bytes, layout) in
        [256, 1000, 4096].into_iter().flat_map(|bytes| SdfLayout::ALL.map(|of| (bytes, of)))
    {
        let raw = RawMesh::from_f32(&positions, &triangles);
        let builder = Builder::new().serve(For::Sdf).sdf_bytes(bytes).sdf_kind(SdfKind::Surface);
        let builder = builder.sdf_layout(layout);
        let built = builder.build(raw).expect("builds");
        let report = built.sdf.expect("a report");
        let field = Field::of(built.bytes());
        assert_eq!(report.cells, field.cells);
        assert_eq!(report.layout, layout);
        assert_eq!(report.other_width, None);
        assert!(report.bytes <= bytes as usize, "{} of {bytes}", report.bytes);
        assert!(4 * report.bytes + 800 > 3 * bytes as usize, "{} of {bytes}", report.bytes);
        assert!(built.blob().bvh().is_err(), "no tree was asked for");
    }
}

#[test]
fn a_field_has_the_same_bytes_on_one_thread_and_on_many() {
    let (positions, triangles) = rough_sphere(2, 0.3, 5);
    let of = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| {
            let raw = RawMesh::from_f32(&positions, &triangles);
            let builder = Builder::new().serve(For::Sdf).sdf_bytes(1024);
            builder.build(raw).expect("builds").into_bytes()
        })
    };
    assert_eq!(of(1), of(5));
}

#[test]
fn widths_of_a_solid_bracket_are_narrow() {
    let (positions, triangles) = bracket();
    let raw = RawMesh::from_f32(&positions, &triangles);
    let builder = Builder::new().serve(For::Sdf).sdf_kind(SdfKind::Solid);
    let report = builder.build(raw).expect("builds").sdf.expect("a report");
    let [low, high] = [f32::min, f32::max].map(|pick| {
        [0, 1, 2].map(|k| positions.iter().map(|p| p[k]).reduce(pick).expect("positions"))
    });
    let diagonal = (0..3).map(|k| f64::from(high[k] - low[k]).powi(2)).sum::<f64>().sqrt();
    let percent = |width: f64| 100.0 * width / diagonal;
    // The tree is kept, for the lattice is wider.
    assert_eq!(report.layout, SdfLayout::Tree);
    let [tree, lattice] = [report.mean_width, report.other_width.expect("both")].map(percent);
    assert!(tree < 0.22 && lattice < 0.45, "{tree} % {lattice} %");
}
