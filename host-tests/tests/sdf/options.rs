//! Options of a field, and meshes that it is refused for.

use meshsweep::builder::{For, SdfKind, SdfLayout, Stage, Topic};
use meshsweep::mesh::{Mesh, RawMesh};
use meshsweep::progress::Watch;
use meshsweep::sdf::{self, SdfOptions};
use meshsweep::{BuildError, Builder, Built};
use meshsweep_host_tests::generate::{Triangles, block, scaled};
use meshsweep_host_tests::oracle::field::Field;
use std::ops::ControlFlow;

fn build(mesh: &Triangles, builder: Builder<'_>) -> Result<Built, BuildError> {
    builder.serve(For::Sdf).sdf_bytes(512).build(RawMesh::from_f32(&mesh.0, &mesh.1))
}

fn open_box() -> Triangles {
    let (positions, triangles) = block([0.0; 3], [3.0, 2.0, 1.0]);
    (positions, triangles[..10].to_vec())
}

#[test]
fn a_closed_mesh_is_signed_and_an_open_one_is_not_and_says_so() {
    let closed = build(&block([0.0; 3], [1.0; 3]), Builder::new()).expect("builds");
    assert_eq!(closed.blob().sdf().expect("a field").kind(), SdfKind::Signed);
    let open = build(&open_box(), Builder::new()).expect("builds");
    assert_eq!(open.blob().sdf().expect("a field").kind(), SdfKind::Surface);
    let says = |built: &Built| {
        built.report_on(Topic::Sdf).any(|note| note.text.contains("the mesh is not closed"))
    };
    assert!(says(&open) && !says(&closed));
}

#[test]
fn an_open_mesh_has_no_field_with_sides() {
    for kind in [SdfKind::Signed, SdfKind::Solid] {
        let refused = build(&open_box(), Builder::new().sdf_kind(kind)).expect_err("refused");
        assert_eq!(refused, BuildError::NoSides { kind: kind.name() });
    }
}

#[test]
fn a_field_without_a_normal_unit_is_refused() {
    let tiny = scaled(&block([0.0; 3], [1.0; 3]), 1e-36);
    let refused = build(&tiny, Builder::new()).expect_err("refused");
    assert!(matches!(refused, BuildError::FieldUnit { .. }), "{refused}");
    let huge = build(&block([0.0; 3], [1e38; 3]), Builder::new().sdf_margin(3.3e38));
    assert_eq!(huge.expect_err("refused"), BuildError::MarginTooLarge);
}

#[test]
fn a_tree_of_fewer_bytes_than_a_leaf_takes_is_refused_and_a_lattice_is_not() {
    let (positions, triangles) = block([0.0; 3], [1.0; 3]);
    let mesh = Mesh::new(positions, triangles);
    let of = |bytes: u32, layout: SdfLayout| {
        let options = SdfOptions::default().with_bytes(bytes).with_layout(Some(layout));
        sdf::build(mesh.as_input(), &options, Watch::NONE).map(|(_, report)| report.bytes)
    };
    let refused = of(100, SdfLayout::Tree).expect_err("refused");
    assert_eq!(refused, BuildError::FieldTooSmall { bytes: 100, least: 101 });
    assert!(refused.to_string().contains("101 bytes at least, not 100"), "{refused}");
    assert_eq!(of(0, SdfLayout::Lattice), Ok(105));
    assert_eq!(of(105, SdfLayout::Lattice), Ok(105));
}

#[test]
fn a_tree_that_is_too_wide_is_told_to_take_more_bytes_or_a_lattice() {
    let refused = BuildError::FieldTooWide { kind: "signed", layout: Some("tree"), bytes: 2048 };
    let told = refused.to_string();
    assert!(told.contains("more --sdf bytes") && told.contains("--sdf-layout"), "{told}");
    assert!(!told.contains("inside"), "its sides are certain: {told}");
    let refused = BuildError::FieldTooWide { kind: "signed", layout: None, bytes: 2048 };
    assert!(refused.to_string().contains("unite the mesh's parts"), "{refused}");
}

#[test]
fn a_margin_is_covered() {
    let built = build(&block([0.0; 3], [1.0; 3]), Builder::new().sdf_margin(7.0)).expect("builds");
    let [low, high] = Field::of(built.bytes()).bounds();
    assert!(low.iter().all(|&x| x <= -7.0) && high.iter().all(|&x| x >= 8.0), "{low:?} {high:?}");
}

#[test]
fn options_of_a_field_need_it() {
    let (positions, triangles) = block([0.0; 3], [1.0; 3]);
    let raw = RawMesh::from_f32(&positions, &triangles);
    let refused = Builder::new().sdf_bytes(512).build(raw).expect_err("refused");
    assert!(matches!(refused, BuildError::Option { option: "--sdf", .. }), "{refused}");
}

#[test]
fn a_build_ends_when_it_is_told_to() {
    let mut calls = 0;
    let stop = |stage: Stage, _: f64| {
        calls += usize::from(stage == Stage::Sdf);
        if calls > 2 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let refused = build(&block([0.0; 3], [1.0; 3]), Builder::new().on_progress(stop));
    assert_eq!(refused.expect_err("cancelled"), BuildError::Cancelled);
}
