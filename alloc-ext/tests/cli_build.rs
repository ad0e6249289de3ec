//! `meshsweep build` and `info`, and the program without a command.

mod cli_support;

use cli_support::{arg, blob, fixture, ok, run, scratch};
use std::fs;

#[test]
fn without_arguments_it_explains_itself_in_ten_lines_with_numbers() {
    let text = ok::<&str>([]);
    assert!(text.lines().count() <= 12, "{text}");
    assert!(text.contains("Closest point to") && text.contains("First hit"), "{text}");
    // Radii 2 and 0.75: the triangles lie inside the torus, by up to 0.013.
    let exact = (10f64.sqrt() - 2.0).hypot(0.5) - 0.75;
    let lower: f64 = text.split("distance ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap();
    assert!((0.0..0.013).contains(&(lower - exact)), "{lower} {exact}");
}

#[test]
fn the_built_in_torus_is_the_fixture() {
    let copy = fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/src/bin/meshsweep/demo/torus.ply")).unwrap();
    assert!(copy == fs::read(fixture("torus.ply")).unwrap());
}

#[test]
fn build_is_deterministic() {
    let directory = scratch("build_is_deterministic");
    let first = fs::read(blob(&directory, "bracket.stl", &[])).unwrap();
    let second = fs::read(blob(&directory, "bracket.stl", &[])).unwrap();
    assert!(first == second);
}

#[test]
fn build_reports_mesh_sections_memory_and_levels() {
    let directory = scratch("build_reports");
    let (mesh, out) = (fixture("bracket.stl"), directory.join("b.msw"));
    let text = ok(["build", arg(&mesh), "-o", arg(&out), "--for", "closest,segment,hull"]);
    for part in
        ["1948 triangles read", "cover tree", "total", "queue", "void %", "surface error 0 ", "collapse"]
    {
        assert!(text.contains(part), "{part} in {text}");
    }
    assert_eq!(fs::read_dir(&directory).unwrap().count(), 1, "nothing but the blob is left");
}

#[test]
fn build_honours_its_options() {
    let directory = scratch("build_honours_its_options");
    let faces = |options: &[&str]| {
        let path = blob(&directory, "torus.ply", options);
        let info: serde_json::Value = serde_json::from_str(&ok(["info", arg(&path), "--json"])).unwrap();
        (info["base_triangles"].as_u64().unwrap(), info["vertex_format"].as_str().unwrap().to_owned())
    };
    assert_eq!(faces(&["--base", "400"]).0, 400);
    assert_eq!(faces(&["--base", "400", "--priority", "span"]).0, 400);
    assert_eq!(faces(&["--vertex-bits", "16"]).1, "16-bit grid");
    assert_eq!(faces(&["--vertex-bits", "24"]).1, "24-bit grid");
    assert_eq!(faces(&["--vertex-bits", "32"]).1, "f32");
    let strict = ["--max-valence", "6", "--compactness", "1", "--max-normal-deviation", "5"];
    assert!(faces(&strict).0 > 400, "strict conditions stop early");
}

#[test]
fn a_build_that_stops_early_says_why() {
    let directory = scratch("stops_early");
    let (mesh, out) = (fixture("torus.ply"), directory.join("t.msw"));
    let text = ok(["build", arg(&mesh), "-o", arg(&out), "--base", "4"]);
    assert!(text.contains("stopped before 4 faces"), "{text}");
}

#[test]
fn json_parses_and_its_sections_fill_the_blob() {
    let directory = scratch("json_parses");
    let path = blob(&directory, "bracket.stl", &[]);
    let info: serde_json::Value = serde_json::from_str(&ok(["info", arg(&path), "--json"])).unwrap();
    assert_eq!(info["bytes"].as_u64(), Some(fs::metadata(&path).unwrap().len()));
    let sections = info["sections"].as_array().unwrap();
    let end = sections.iter().map(|s| s["offset"].as_u64().unwrap() + s["bytes"].as_u64().unwrap()).max();
    assert_eq!(end, info["bytes"].as_u64());
    assert_eq!(info["surface_triangles"], 1948);
    let levels = info["levels"].as_array().unwrap();
    assert_eq!(levels[0]["faces"], info["base_triangles"]);
    assert_eq!(levels.last().unwrap()["faces"], 1948);
}

#[test]
fn info_for_people_names_every_section() {
    let directory = scratch("info_for_people");
    let path = blob(&directory, "groove.obj", &[]);
    let text = ok(["info", arg(&path)]);
    for section in ["vertices", "splits", "cover tree", "levels", "source numbers"] {
        assert!(text.contains(section), "{section} in {text}");
    }
}

#[test]
fn every_evil_fixture_is_built_or_refused_in_one_line_and_leaves_nothing_behind() {
    let directory = scratch("every_evil_fixture");
    for entry in fs::read_dir(fixture("evil")).unwrap() {
        let mesh = entry.unwrap().path();
        let out = directory.join("out.msw");
        let output = run(["build", arg(&mesh), "-o", arg(&out)]);
        if output.status.success() {
            fs::remove_file(&out).unwrap();
        } else {
            cli_support::refused(&output, 1, mesh.file_name().unwrap().to_str().unwrap());
        }
        assert_eq!(fs::read_dir(&directory).unwrap().count(), 0, "{}", mesh.display());
    }
}
