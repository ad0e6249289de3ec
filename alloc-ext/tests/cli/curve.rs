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
    assert!(report.contains("serves closest, within, nearest\n"), "{report}");
    assert!(report.contains("3 segments of 2 polylines, 0 closed\n"), "{report}");
    assert!(report.contains("open: nothing joins the last point with the first"), "{report}");
    let text = ok(["info", arg(&output)]);
    assert!(text.contains("bytes per segment") && !text.contains("triangle"), "{text}");
    let json: Value = serde_json::from_str(&ok(["info", arg(&output), "--json"])).expect("JSON");
    assert_eq!(json["curve"]["segments"], 3);
    assert_eq!(json["curve"]["is_planar"], false);
    assert_eq!(json["serves"], serde_json::json!(["closest", "within", "nearest"]));
}

#[test]
fn the_nearest_segments_and_all_within_are_listed() {
    let directory = scratch("curve_nearest");
    let path = file(&directory, "path.csv", "0,0\n4,0\n4,4\n\n0,9\n4,9\n");
    let output = directory.join("path.msw");
    ok(["build", arg(&path), "-o", arg(&output)]);
    let places = |text: &str| -> Vec<String> {
        let rows = text.lines().skip(1).map(|line| line.split(',').collect::<Vec<_>>());
        rows.map(|row| [row[0], row[1], row[7], row[8]].join(",")).collect()
    };
    let near = ok(["nearest", arg(&output), "1,1,0", "4,7,0", "-n", "2"]);
    assert_eq!(places(&near), ["0,1,0,0", "0,2,0,1", "1,1,1,0", "1,2,0,1"], "{near}");
    let all = ok(["nearest", arg(&output), "1,1,0", "-n", "9"]);
    assert_eq!(all.lines().count(), 4, "{all}");
    let ask =
        |point: &str| places(&ok(["within", arg(&output), point, "--distance", "2.5", "--all"]));
    assert_eq!(ask("2,1,0"), ["0,yes,0,0", "0,yes,0,1"]);
    assert_eq!(ask("-9,-9,0"), ["0,no,,"]);
}

/// A field of 10 by 10, and a square in it that is excluded.
const ZONES: &str = "x,y,zone\n0,0,inclusion\n10,0,inclusion\n10,10,inclusion\n0,10,inclusion\n\
                     4,4,exclusion\n6,4,exclusion\n6,6,exclusion\n4,6,exclusion\n";

#[test]
fn a_fence_says_what_it_allows_and_how_far_its_line_is() {
    let directory = scratch("curve_signed");
    let zones = file(&directory, "zones.csv", ZONES);
    let fence = directory.join("zones.msw");
    let report = ok(["build", arg(&zones), "-o", arg(&fence)]);
    let told = "fence: inside of 1 inclusion zone and outside of 1 exclusion zone\n";
    assert!(report.contains(told) && report.contains(", signed\n"), "{report}");
    let json: Value = serde_json::from_str(&ok(["info", arg(&fence), "--json"])).expect("JSON");
    assert_eq!(json["curve"]["exclusion_zones"], 1);
    assert_eq!(json["curve"]["is_fence"], true);
    let points = file(&directory, "points.csv", "x,y,z\n5,5,99\n-3,14,0\n0,2.5,1\n");
    let answers = ok(["signed", arg(&fence), "2,5", arg(&points)]);
    let rows: Vec<Vec<&str>> =
        answers.lines().skip(1).map(|line| line.split(',').collect()).collect();
    let sides: Vec<[&str; 2]> = rows.iter().map(|row| [row[2], row[3]]).collect();
    let undecided = ["undecided", "at the line"];
    assert_eq!(sides, [["inside", ""], ["outside", ""], ["outside", ""], undecided], "{answers}");
    for (row, distance) in rows.iter().zip([-2.0, 1.0, 5.0, 0.0]) {
        let [lower, upper] =
            [4, 5].map(|field: usize| row[field].parse::<f64>().expect("a number"));
        assert!(lower <= distance && distance <= upper && upper - lower < 1e-3, "{row:?}");
    }
    // The nearest line of the second point is that of the hole.
    assert_eq!((rows[1][8], rows[0][8]), ("1", "0"), "{answers}");
    let proofs = ok(["verify", arg(&fence), arg(&zones)]);
    assert!(proofs.contains("1 exclusion zone"), "{proofs}");
    let turned = file(&directory, "turned.csv", &ZONES.replace("exclusion", "Inclusion"));
    let told = refused(&run(["verify", arg(&fence), arg(&turned)]), 3, "zones.msw");
    assert!(told.contains("failed: curve"), "{told}");
    // A blob without the side that a zone closes is not the file's.
    let plain = file(&directory, "plain.csv", "x,y\n0,0\n9,0\n9,9\n0,9\n");
    let open = directory.join("open.msw");
    ok(["build", arg(&plain), "-o", arg(&open)]);
    ok(["verify", arg(&open), arg(&plain)]);
    let zoned = "x,y,zone\n0,0,inclusion\n9,0,inclusion\n9,9,inclusion\n0,9,inclusion\n";
    let zoned = file(&directory, "zoned.csv", zoned);
    let told = refused(&run(["verify", arg(&open), arg(&zoned)]), 3, "open.msw");
    assert!(told.contains("failed: curve"), "{told}");
}

#[test]
fn curves_that_bound_no_area_and_points_of_the_wrong_kind_are_refused() {
    let directory = scratch("curve_no_fence");
    let ask = |name: &str, text: &str, options: &[&str]| {
        let (path, output) = (file(&directory, name, text), directory.join("out.msw"));
        ok([&["build", arg(&path), "-o", arg(&output)], options].concat());
        refused(&run(["signed", arg(&output), "1,1"]), 1, "out.msw")
    };
    let open = ask("open.csv", "0,0\n5,0\n5,5\n", &[]);
    assert!(open.contains("polyline 0 is not closed") && open.contains("--closed"), "{open}");
    let tilted = ask("tilted.csv", "0,0,0\n5,0,0\n5,5,1\n", &["--closed"]);
    assert!(tilted.contains("differ in z"), "{tilted}");
    let bad = file(&directory, "bad.csv", &ZONES.replace("4,4,exclusion", "4,4,keep out"));
    let told = refused(&run(["build", arg(&bad), "-o", "x.msw"]), 1, "bad.csv");
    assert!(told.contains("line 6: \"keep out\" is no zone"), "{told}");
    let told = refused(&run(["signed", arg(&fixture("groove.msw")), "1,2"]), 2, "1,2");
    assert!(told.contains("needs 3: x, y, z"), "{told}");
}

#[test]
fn the_c_source_of_a_fence_is_written() {
    let directory = scratch("curve_c");
    let output = directory.join("zones.msw");
    let zones = file(&directory, "zones.csv", ZONES);
    ok(["build", arg(&zones), "-o", arg(&output), "--emit", "c"]);
    let header = fs::read_to_string(directory.join("zones.h")).expect("written");
    assert!(header.contains("extern const uint8_t zones_bytes[ZONES_BYTES];"), "{header}");
    assert!(header.contains("#define ZONES_IS_FENCE 1 "), "{header}");
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
    assert!(told.contains("serves closest, within, nearest, signed"), "{told}");
}
