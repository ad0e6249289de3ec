//! `meshsweep hausdorff` on files.

use crate::support::{arg, fixture, ok, refused, run, scratch};
use std::fs;
use std::path::{Path, PathBuf};

/// A square plate at a height, of two triangles.
fn plate(directory: &Path, name: &str, size: f64, height: f64) -> PathBuf {
    let corners = [[0.0, 0.0], [size, 0.0], [size, size], [0.0, size]];
    let vertices = corners.map(|[x, y]| format!("v {x} {y} {height}\n")).concat();
    let path = directory.join(name);
    fs::write(&path, vertices + "f 1 2 3\nf 1 3 4\n").expect("the file can be written");
    path
}

fn json(arguments: &[&str]) -> serde_json::Value {
    serde_json::from_str(&ok([&["hausdorff", "--json"], arguments].concat())).expect("it is JSON")
}

#[test]
fn bounds_and_points_are_those_of_two_plates() {
    let directory = scratch("hausdorff");
    let (small, large) =
        (plate(&directory, "small.obj", 1.0, 0.0), plate(&directory, "large.obj", 5.0, 3.0));
    // The large plate's corner is 4 and 4 beyond the small one's, and 3 above it.
    for (files, distance) in [([&small, &large], 3.0), ([&large, &small], 41f64.sqrt())]
        .map(|(f, d)| (f.map(|f| arg(f)), d))
    {
        let found = json(&[&files[..], &["--one-sided", "--rel", "1e-9"]].concat());
        let [lower, upper] = ["lower", "upper"].map(|key| found[key].as_f64().expect("a number"));
        assert!(lower <= distance && distance <= upper && upper - lower < 1e-8, "{found}");
        let end = |key: &str| -> Vec<f64> {
            serde_json::from_value(found[key].clone()).expect("three numbers")
        };
        let way: f64 = end("a").iter().zip(end("b")).map(|(a, b)| (a - b).powi(2)).sum();
        assert!((way.sqrt() - distance).abs() < 1e-8, "{found}");
    }
    let both = json(&[arg(&small), arg(&large)]);
    assert!((both["lower"].as_f64().unwrap() - 41f64.sqrt()).abs() < 1e-3, "{both}");
    let z = |key: &str| both[key][2].as_f64().unwrap();
    assert_eq!((z("a"), z("b")), (0.0, 3.0), "a is on the first mesh: {both}");
}

#[test]
fn a_limit_is_the_exit_status() {
    let directory = scratch("hausdorff_gate");
    let (low, high) =
        (plate(&directory, "low.obj", 1.0, 0.0), plate(&directory, "high.obj", 1.0, 0.25));
    let ask = |most: &str| run(["hausdorff", arg(&low), arg(&high), "--at-most", most]);
    assert!(ask("0.26").status.success());
    let line = refused(&ask("0.24"), 3, "low.obj");
    assert!(line.contains("at least 0.249") && line.contains("0.24 was asked"), "{line}");
    let line = refused(&ask("0.25"), 3, "low.obj");
    assert!(line.contains("to be decided"), "{line}");
    let broken = run(["hausdorff", arg(&low), "absent.stl", "--at-most", "1"]);
    refused(&broken, 1, "absent.stl");
}

#[test]
fn a_mesh_is_as_far_from_itself_as_rounding() {
    let torus = fixture("torus.ply");
    let found = json(&[arg(&torus), arg(&torus)]);
    assert_eq!(found["lower"].as_f64(), Some(0.0));
    assert!(found["upper"].as_f64().unwrap() < 1e-9, "{found}");
    assert!(found["a"].is_null(), "{found}");
}

#[test]
fn text_names_both_files() {
    let directory = scratch("hausdorff_text");
    let (low, high) =
        (plate(&directory, "low.obj", 1.0, 0.0), plate(&directory, "high.obj", 1.0, 0.25));
    let text = ok(["hausdorff", arg(&low), arg(&high)]);
    assert!(text.starts_with("distance  0.2"), "{text}");
    assert!(text.contains("low.obj") && text.contains("high.obj"), "{text}");
}

#[test]
fn the_profile_and_the_heat_map_are_those_of_two_plates() {
    let directory = scratch("hausdorff_profile");
    let [low, high] = [("low.obj", 0.0), ("high.obj", 2.0)]
        .map(|(name, height)| plate(&directory, name, 1.0, height));
    let heat = directory.join("heat.ply");
    let found = json(&[arg(&high), arg(&low), "--profile", "--heat", arg(&heat)]);
    let bounds = |value: &serde_json::Value| [0, 1].map(|k| value[k].as_f64().unwrap());
    let [lower, upper] = bounds(&found["mean"]);
    assert!(lower <= 2.0 && 2.0 <= upper && upper - lower <= 0.2, "{found}");
    assert_eq!(found["quantiles"].as_array().unwrap().len(), 4);
    for quantile in found["quantiles"].as_array().unwrap() {
        let [lower, upper] = bounds(&quantile["bounds"]);
        assert!(lower <= 2.0 && 2.0 <= upper, "{found}");
    }
    let bytes = fs::read(&heat).unwrap();
    let header = String::from_utf8_lossy(&bytes[..300]).into_owned();
    assert!(header.contains("property float quality\nproperty uchar red"), "{header}");
    // Everywhere equally far: all red.
    let start = header.find("end_header\n").unwrap() + 11;
    let vertex = &bytes[start..start + 19];
    let quality = f32::from_le_bytes([vertex[12], vertex[13], vertex[14], vertex[15]]);
    assert!((quality - 2.0).abs() < 1e-5, "{quality}");
    assert_eq!(vertex[16..], [255, 0, 0]);
    let text = ok(["hausdorff", arg(&high), arg(&low), "--profile"]);
    assert!(text.contains("mean") && text.contains("99 %"), "{text}");
}
