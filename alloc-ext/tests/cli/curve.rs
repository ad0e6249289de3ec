//! Curves from CSV: built, asked, described, refused.

use crate::support::{arg, blob, fixture, ok, refused, run, scratch};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

fn file(directory: &Path, name: &str, text: &str) -> PathBuf {
    let path = directory.join(name);
    fs::write(&path, text).expect("the file can be written");
    path
}

/// The fields of the only row.
fn row(text: &str) -> Vec<String> {
    let rows: Vec<&str> = text.lines().collect();
    assert_eq!(rows.len(), 2, "{text}");
    rows[1].split(',').map(str::to_owned).collect()
}

#[test]
fn the_fixtures_command_makes_the_fixture() {
    let directory = scratch("curve_fixture");
    let built = blob(&directory, "fence.csv", &["--closed"]);
    assert!(fs::read(built).unwrap() == fs::read(fixture("fence.msw")).unwrap());
}

#[test]
fn a_fence_is_asked_and_names_its_segments() {
    let directory = scratch("curve_fence");
    let fence = blob(&directory, "fence.csv", &["--closed", "--vertex-bits", "32"]);
    let near = row(&ok(["closest", arg(&fence), "50,-3,4"]));
    let number = |field: usize| near[field].parse::<f64>().expect("a number");
    let (lower, upper) = (number(3), number(4));
    assert!(lower <= 5.0 && 5.0 <= upper && upper - lower < 1e-5, "{near:?}");
    assert_eq!(near[5..9], ["50", "0", "0", "0"]);
    assert!(number(10) > 1.0, "{near:?}");
    // The post is the second polyline.
    let post = row(&ok(["closest", arg(&fence), "30,24,0"]));
    assert_eq!((post[8].as_str(), post[10].as_str()), ("1", "0"), "{post:?}");
    let ask = |distance: &str| {
        let answer = ok(["within", arg(&fence), "50,-3,4", "--distance", distance]);
        row(&answer)[3..6].join(",")
    };
    assert_eq!(ask("4.99"), "no,,");
    assert!(ask("5.01").starts_with("yes,0,"), "{}", ask("5.01"));
    assert_eq!(ask("5"), "undecided,,");
}

#[test]
fn info_and_build_tell_what_the_blob_holds() {
    let directory = scratch("curve_info");
    let path = file(&directory, "path.csv", "x,y,z\n0,0,1\n0,0,1\n5,0,2\n\n1,1,1\n2,2,2\n");
    let output = directory.join("path.msw");
    let report = ok(["build", arg(&path), "-o", arg(&output)]);
    assert!(report.contains("1 point repeated: kept"), "{report}");
    assert!(report.contains("serves closest, within without --all\n"), "{report}");
    assert!(report.contains("3 segments of 2 polylines, 0 closed\n"), "{report}");
    assert!(report.contains("open: nothing joins the last point with the first"), "{report}");
    let text = ok(["info", arg(&output)]);
    assert!(text.contains("bytes per segment") && !text.contains("triangle"), "{text}");
    let json: Value = serde_json::from_str(&ok(["info", arg(&output), "--json"])).expect("JSON");
    assert_eq!(json["curve"]["segments"], 3);
    assert_eq!(json["curve"]["is_planar"], false);
    assert_eq!(json["serves"], serde_json::json!(["closest", "within"]));
}

#[test]
fn the_name_or_for_chooses_a_curve() {
    let directory = scratch("curve_names");
    let path = file(&directory, "path.txt", "0,0\n1,0\n1,1\n");
    let output = directory.join("path.msw");
    ok(["build", arg(&path), "-o", arg(&output), "--for", "curve", "--closed"]);
    let info = ok(["info", arg(&output)]);
    assert!(info.contains("3 segments of 1 polyline, 1 closed, z = 0\n"), "{info}");
}

#[test]
fn bad_curves_and_wrong_options_are_refused() {
    let directory = scratch("curve_refused");
    let output = directory.join("out.msw");
    let build = |text: &str, options: &[&str]| {
        let path = file(&directory, "bad.csv", text);
        run([&["build", arg(&path), "-o", arg(&output)], options].concat())
    };
    for (text, why) in [
        ("0,0\n1,nan\n", "bad.csv, line 2, field 2: \"nan\" is no finite number"),
        ("0,0\n1,1,1\n", "bad.csv, line 2: 3 fields, and a point needs 2"),
        ("0,0\n1,1\n\n5,5\n", "bad.csv, line 4: a polyline of one point"),
        ("", "bad.csv: no points"),
    ] {
        let told = refused(&build(text, &[]), 1, "bad.csv");
        assert!(told.contains(why), "{told}");
    }
    let fine = "0,0\n1,1\n";
    let torus = run(["build", arg(&fixture("torus.ply")), "-o", "x.msw", "--for", "closest,curve"]);
    refused(&torus, 2, "--for curve needs a .csv");
    let told = refused(&build(fine, &["--for", "curve,hull"]), 2, "--for curve");
    assert!(told.contains("a mesh for anything else"), "{told}");
    assert!(!output.exists());
    let mesh = fixture("torus.ply");
    refused(&run(["build", arg(&mesh), "-o", arg(&output), "--closed"]), 2, "--closed");
    let fence = fixture("fence.msw");
    let told = refused(&run(["segment", arg(&fence), "0,0,0,1,1,1"]), 1, "fence.msw");
    assert!(told.contains("serves closest, within"), "{told}");
    refused(&run(["within", arg(&fence), "0,0,0", "-d", "1", "--all"]), 1, "fence.msw");
}
