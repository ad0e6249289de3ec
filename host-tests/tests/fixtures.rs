//! The committed blobs are the builder's, and the committed answers are this machine's.

use std::path::{Path, PathBuf};

use meshsweep::curve::{CurveOptions, build, read_csv};
use meshsweep::progress::Watch;
use meshsweep_core::{
    Blob, Budget, Bvh, BvhWithSdf, Curve, DeformableHull, Hull, Sdf, SdfKind, SectionKind,
    TightHulls, Triboxes,
};
use meshsweep_counted::answers::{of_fixtures, of_kept};
use meshsweep_host_tests::golden::{
    bending_torus, bracket_hulls, bracket_model, fence_curves, groove_both, groove_field,
    groove_tree, sources, torus_sieve, torus_triboxes,
};
use meshsweep_host_tests::picture;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../fixtures")
}

fn read(name: &str) -> Vec<u8> {
    std::fs::read(folder().join(name)).expect("the fixture is there")
}

#[test]
fn committed_picture_is_what_the_command_draws() {
    let drawn = picture::part(&folder()).expect("drawn");
    assert!(
        read("part.svg") == drawn.as_bytes(),
        "fixtures/part.svg is out of date: run `cargo xtask picture`"
    );
}

#[test]
fn committed_tree_is_what_the_builder_makes() {
    assert!(
        read("groove.msw") == groove_tree(),
        "fixtures/groove.msw is out of date: run `cargo xtask fixtures`"
    );
}

#[test]
fn committed_tree_opens_with_every_triangle_and_every_section() {
    let bytes = read("groove.msw");
    let tree = Bvh::open(&bytes).expect("opens");
    assert_eq!(tree.header().triangles, tree.input_triangles());
    assert!(tree.serves_distances() && tree.serves_segments() && tree.serves_culling());
    assert!(tree.header().is_closed());
}

/// Compiled from what the builder wrote.
#[path = "../../core/fixtures/groove.rs"]
mod groove;

#[test]
fn committed_sources_and_models_of_examples_are_what_the_builder_writes() {
    for (file, made) in sources() {
        let committed = Path::new(env!("CARGO_MANIFEST_DIR")).join("../core").join(&file);
        let committed = std::fs::read(&committed).expect("the fixture is there");
        assert!(committed == made, "core/{file} is out of date: run `cargo xtask fixtures`");
    }
}

#[test]
fn a_tree_that_the_compiler_opened_is_the_one_that_open_gives() {
    let bytes = read("groove.msw");
    let opened = Bvh::open(&bytes).expect("opens");
    assert_eq!(format!("{:?}", groove::TREE), format!("{opened:?}"));
    assert_eq!(groove::SCRATCH_ENTRIES, opened.scratch_entries());
    assert_eq!(Blob::checksum(&groove::BYTES.0), Blob::checksum(&bytes));
    assert_eq!(std::ptr::from_ref(&groove::BYTES).addr() % 4, 0);
    let mut scratch = groove::scratch::<{ groove::SCRATCH_ENTRIES }>();
    let near = groove::TREE.closest_point([3.0, 0.0, 4.0], Budget::EXACT, &mut scratch);
    assert_eq!(near, opened.closest_point([3.0, 0.0, 4.0], Budget::EXACT, &mut scratch));
}

#[test]
fn committed_triboxes_are_what_the_builder_makes() {
    let bytes = read("torus.msw");
    assert!(
        bytes == torus_triboxes(),
        "fixtures/torus.msw is out of date: run `cargo xtask fixtures`"
    );
    let triboxes = Triboxes::open(&bytes).expect("opens");
    assert!(triboxes.is_solid() && triboxes.leaf_count() == 64);
}

#[test]
fn committed_hulls_are_what_the_builder_makes() {
    let bytes = read("hulls.msw");
    assert!(
        bytes == bracket_hulls(),
        "fixtures/hulls.msw is out of date: run `cargo xtask fixtures`"
    );
    let hulls = TightHulls::open(&bytes).expect("opens");
    assert!(hulls.records().map(|record| record.faces).eq([64, 160]));
}

#[test]
fn committed_fence_is_what_the_builder_makes_of_its_file() {
    let bytes = read("fence.msw");
    assert!(
        bytes == fence_curves(),
        "fixtures/fence.msw is out of date: run `cargo xtask fixtures`"
    );
    let polylines = read_csv(&read("fence.csv"), true).expect("CSV");
    let built = build(&polylines, &CurveOptions::default(), Watch::NONE).expect("finite");
    assert!(bytes == built.0.to_bytes());
    let curve = Curve::open(&bytes).expect("opens");
    assert_eq!((curve.segment_count(), curve.is_closed(1)), (72, Some(true)));
}

#[test]
fn committed_field_is_what_the_builder_makes() {
    let bytes = read("field.msw");
    assert!(
        bytes == groove_field(),
        "fixtures/field.msw is out of date: run `cargo xtask fixtures`"
    );
    let field = Sdf::open(&bytes).expect("opens");
    assert!(field.kind() == SdfKind::Signed && bytes.len() <= 160 + 16 + (8 << 10));
}

#[test]
fn committed_tree_with_a_field_is_what_the_builder_makes() {
    let bytes = read("both.msw");
    assert!(bytes == groove_both(), "fixtures/both.msw is out of date: run `cargo xtask fixtures`");
    let both = BvhWithSdf::open(&bytes).expect("opens");
    assert!(both.tree().serves_distances() && both.tree().serves_segments());
    assert_eq!(both.field().kind(), SdfKind::Signed);
}

#[test]
fn the_fence_of_the_example_is_what_the_builder_makes_of_its_csv() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../core/examples/fence/src");
    let read = |name: &str| std::fs::read(folder.join(name)).expect("the example has it");
    let zones = read_csv(&read("zones.csv"), false).expect("CSV");
    let built = build(&zones, &CurveOptions::default(), Watch::NONE).expect("finite");
    assert!(read("zones.msw") == built.0.to_bytes());
}

#[test]
fn committed_hierarchy_of_an_open_mesh_is_what_the_builder_makes() {
    let bytes = read("sieve.msw");
    assert!(
        bytes == torus_sieve(),
        "fixtures/sieve.msw is out of date: run `cargo xtask fixtures`"
    );
    let hull = Hull::open(&bytes).expect("opens");
    assert!(!hull.encloses() && hull.triangle_count() == 384);
}

#[test]
fn committed_bend_is_what_the_builder_makes() {
    let bytes = read("bend.msw");
    assert!(
        bytes == bending_torus(),
        "fixtures/bend.msw is out of date: run `cargo xtask fixtures`"
    );
    let hull = DeformableHull::open(&bytes).expect("opens");
    assert_eq!((hull.frames(), hull.input_vertices()), (2, 128));
}

#[test]
fn the_core_packs_the_same_blobs() {
    for name in [
        "bend.msw",
        "both.msw",
        "bracket.msw",
        "fence.msw",
        "field.msw",
        "groove.msw",
        "hulls.msw",
        "torus.msw",
    ] {
        let packed = read(&format!("../core/fixtures/{name}"));
        assert!(
            packed == read(name),
            "core/fixtures/{name} is out of date: run `cargo xtask fixtures`"
        );
    }
}

#[test]
fn answers_have_the_committed_bits() {
    let here = of_fixtures(&folder()).expect("all open");
    let committed = String::from_utf8(read("answers.txt")).expect("text");
    for (here, committed) in here.lines().zip(committed.lines()) {
        assert_eq!(
            here, committed,
            "other bits; if they are meant to be, run `cargo xtask fixtures`"
        );
    }
    assert_eq!(here.lines().count(), committed.lines().count());
}

#[test]
fn answers_about_kept_blobs_keep_their_bits() {
    let here = of_kept(&folder().join("kept")).expect("all open");
    let committed = String::from_utf8(read("kept/answers.txt")).expect("text");
    for (here, committed) in here.lines().zip(committed.lines()) {
        assert_eq!(here, committed, "a kernel computes something else than before");
    }
    assert_eq!(here.lines().count(), committed.lines().count());
}

#[test]
fn every_kind_of_section_is_in_a_kept_blob_that_is_asked() {
    let asked = String::from_utf8(read("kept/answers.txt")).expect("text");
    let mut kinds = Vec::new();
    for entry in std::fs::read_dir(folder().join("kept")).expect("a folder") {
        let name = entry.expect("listed").file_name().into_string().expect("a name");
        if name.ends_with(".msw") {
            assert!(asked.contains(&format!("{name} ")), "{name} is not asked");
            let bytes = read(&format!("kept/{name}"));
            kinds.extend(Blob::open(&bytes).expect("opens").sections().map(|section| section.kind));
        }
    }
    for kind in SectionKind::ALL {
        assert!(kinds.contains(&kind), "no kept blob has {}", kind.name());
    }
}

#[test]
fn committed_blob_is_what_the_builder_makes() {
    let built = bracket_model(&folder()).expect("the fixture is a closed mesh");
    let committed = read("bracket.msw");
    assert!(committed == built, "fixtures/bracket.msw is out of date: run `cargo xtask fixtures`");
}

#[test]
fn committed_blob_opens_with_every_triangle() {
    let committed = read("bracket.msw");
    let model = Hull::open(&committed).expect("opens");
    assert_eq!(model.header().surface_triangles, 1948);
    assert_eq!(model.header().surface_error, 0.0);
}
