//! The committed blob: what the builder makes of the committed mesh, and a model.

use std::path::{Path, PathBuf};

use meshsweep_core::Model;
use meshsweep_host_tests::golden::bracket_model;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../fixtures")
}

#[test]
fn committed_blob_is_what_the_builder_makes() {
    let built = bracket_model(&folder()).expect("the fixture is a closed mesh");
    let committed = std::fs::read(folder().join("bracket.msw")).unwrap_or_default();
    assert!(committed == built, "fixtures/bracket.msw is out of date: run `cargo xtask fixtures`");
}

#[test]
fn committed_blob_opens_with_every_triangle() {
    let committed = std::fs::read(folder().join("bracket.msw")).expect("the fixture is there");
    let model = Model::open(&committed).expect("opens");
    assert_eq!(model.header().surface_triangles, 1948);
    assert_eq!(model.header().surface_error, 0.0);
}
