//! `build --for sdf`: kinds, bytes, and what the report says.

use crate::support::{arg, ok, refused, run, scratch};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

/// A block of 3 by 2 by 1 as OBJ; open without its last face.
fn block(directory: &Path, is_open: bool) -> PathBuf {
    let mut text = String::new();
    for i in 0..8 {
        text += &format!("v {} {} {}\n", 3 * (i & 1), 2 * (i >> 1 & 1), i >> 2);
    }
    let faces = ["1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"];
    for face in &faces[..if is_open { 5 } else { 6 }] {
        text += &format!("f {face}\n");
    }
    let file = directory.join(if is_open { "open.obj" } else { "block.obj" });
    fs::write(&file, text).unwrap();
    file
}

fn build(mesh: &Path, options: &[&str]) -> String {
    let blob = mesh.with_extension("msw");
    ok([&["build", arg(mesh), "-o", arg(&blob), "--for", "sdf", "--sdf", "1K"], options].concat())
}

#[test]
fn a_field_is_reported_with_its_kind_and_its_widths_and_there_is_no_tree() {
    let directory = scratch("sdf_report");
    let mesh = block(&directory, false);
    let options = ["--sdf-kind", "solid", "--sdf-margin", "0.5", "--sdf-layout", "lattice"];
    let text = build(&mesh, &options);
    for wanted in [
        "distances to the solid, 0 inside",
        "cells of 2048 units",
        "up to a tenth of the diagonal from the surface",
        "proved by",
        "distance field",
    ] {
        assert!(text.contains(wanted), "{wanted}: {text}");
    }
    assert!(!text.contains("box tree"), "{text}");
    let json: Value = serde_json::from_str(&build(&mesh, &["--json"])).unwrap();
    let field = &json["contents"]["sdf"];
    assert_eq!(field["kind"], "signed");
    assert!(field["widest_cell"].as_f64().unwrap() > 0.0);
    assert_eq!(json["options"], "--for sdf --sdf 1024");
}

#[test]
fn a_width_that_is_asked_for_is_printed_or_refused_with_one_that_there_is() {
    let directory = scratch("sdf_error");
    let mesh = block(&directory, false);
    let text = build(&mesh, &["--sdf-error", "0.4"]);
    assert!(text.contains("no interval in the field is wider than 0.3"), "{text}");
    assert!(text.contains("--sdf-error 0.4 allows no more"), "{text}");
    let options = ["--sdf-error", "0.3", "--sdf-rel", "0.1", "--json"];
    let json: Value = serde_json::from_str(&build(&mesh, &options)).unwrap();
    assert_eq!(json["options"], "--for sdf --sdf 1024 --sdf-error 0.3 --sdf-rel 0.1");
    let blob = mesh.with_extension("msw");
    let options = ["--for", "sdf", "--sdf-error", "0.0001"];
    let given = ["build", arg(&mesh), "-o", arg(&blob)];
    let told = refused(&run([given.as_slice(), options.as_slice()].concat()), 1, "block.obj");
    assert!(told.contains("needs an --sdf-error of about"), "{told}");
}

#[test]
fn the_narrower_layout_is_kept_and_the_other_is_named() {
    let directory = scratch("sdf_layouts");
    let mesh = block(&directory, false);
    let field = |options: &[&str]| -> Value {
        serde_json::from_str(&build(&mesh, &[options, &["--json"]].concat())).unwrap()
    };
    let best = build(&mesh, &["--sdf-kind", "solid"]);
    let best_layout = &field(&["--sdf-kind", "solid"])["contents"]["sdf"]["layout"];
    assert_eq!(best_layout, "tree");
    assert!(best.contains("tree kept: its mean width before the proof was"), "{best}");
    assert!(best.contains("steps at most") && best.contains("root cells of 65536"), "{best}");
    for layout in ["lattice", "tree"] {
        let one = field(&["--sdf-layout", layout]);
        assert_eq!(one["contents"]["sdf"]["layout"], layout);
        assert_eq!(one["options"], format!("--for sdf --sdf 1024 --sdf-layout {layout}"));
        let is_constant = one["contents"]["sdf"]["steps"] == 1;
        assert_eq!(is_constant, layout == "lattice");
    }
    let blob = mesh.with_extension("msw");
    let told = ok(["verify", arg(&blob), arg(&mesh)]);
    assert!(told.contains("proved: distance field"), "{told}");
}

#[test]
fn files_with_a_copy_or_a_turned_triangle_have_sides_that_are_proved_and_are_asked() {
    let directory = scratch("sdf_repaired");
    let mesh = block(&directory, false);
    let text = fs::read_to_string(&mesh).unwrap();
    for (name, edit) in [
        ("copy", text.clone() + "f 2 4 8\n"),
        ("turned", text.replace("f 2 4 8 6", "f 2 4 8\nf 2 6 8")),
        ("inside_out", text.replace("f 1 3 4 2", "f 2 4 3 1")),
    ] {
        let file = directory.join(name).with_extension("obj");
        fs::write(&file, edit).unwrap();
        build(&file, &["--sdf-kind", "signed"]);
        let blob = file.with_extension("msw");
        let told = ok(["verify", arg(&blob), arg(&file)]);
        assert!(told.contains("proved: distance field"), "{told}");
        let sides = ok(["signed", arg(&blob), "1.5,1,0.5", "5,1,0.5"]);
        assert!(sides.contains("1.5,1,0.5,inside") && sides.contains("5,1,0.5,outside"), "{sides}");
        let within = ok(["within", arg(&blob), "1.5,1,3", "--distance", "1"]);
        assert!(within.contains("1.5,1,3,no,"), "{within}");
    }
}

#[test]
fn an_open_mesh_gets_distances_without_a_sign_and_no_others() {
    let directory = scratch("sdf_open");
    let mesh = block(&directory, true);
    let text = build(&mesh, &[]);
    assert!(text.contains("the mesh is not closed"), "{text}");
    assert!(text.contains("distances to the surface, without a side"), "{text}");
    let blob = directory.join("open.msw");
    let kind = ["--for", "sdf", "--sdf-kind", "signed"];
    let given = ["build", arg(&mesh), "-o", arg(&blob)];
    let message = refused(&run([given.as_slice(), kind.as_slice()].concat()), 1, "open.obj");
    assert!(message.contains("--sdf-kind surface"), "{message}");
}
