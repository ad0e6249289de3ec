//! `--triboxes` of the commands that ask: no answer denies what brute force finds.

use crate::support::{
    Triangle, arg, distance, first_crossing, fixture, info, number, ok, parse_csv, random_queries,
    refused, run, scratch, triangles, wide, write_csv,
};
use std::fs;
use std::path::{Path, PathBuf};

/// A block of 4 by 2 by 1 that lies askew, as OBJ: all its numbers are exact decimals.
pub fn askew(directory: &Path) -> PathBuf {
    let rotation = [[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]];
    let corner =
        |i: usize| [0, 1, 2].map(|k| if i >> k & 1 == 1 { [4.0, 2.0, 1.0][k] } else { 0.0 });
    let place = |i: usize| {
        rotation.map(|row: [f64; 3]| {
            let p: [f64; 3] = corner(i);
            row[0] * p[0] + row[1] * p[1] + row[2] * p[2]
        })
    };
    let mut text = String::new();
    for [x, y, z] in (0..8).map(place) {
        text += &format!("v {x:.2} {y:.2} {z:.2}\n");
    }
    for face in ["1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"] {
        text += &format!("f {face}\n");
    }
    let file = directory.join("askew.obj");
    fs::write(&file, text).unwrap();
    file
}

/// The block's blob, turned, and its triangles.
fn built(directory: &Path) -> (PathBuf, Vec<Triangle>) {
    let (mesh, blob) = (askew(directory), directory.join("askew.msw"));
    let options = ["--for", "triboxes", "--orient", "volume", "--tribox-error", "0.1"];
    let text = ok([&["build", arg(&mesh), "-o", arg(&blob)], options.as_slice()].concat());
    assert!(text.contains("turned by the rotation"), "{text}");
    assert!(text.contains("  gained by --orient volume: void "), "{text}");
    (blob, triangles(&mesh))
}

#[test]
fn a_block_that_lies_askew_is_one_turned_tribox_and_is_proved() {
    let directory = scratch("triboxes_askew");
    let (blob, _) = built(&directory);
    let stored = &info(&blob)["triboxes"];
    assert_eq!(stored["leaves"], 1);
    assert_eq!(stored["orientation"].as_array().map(Vec::len), Some(3));
    assert!(stored["levels"][0]["void_ratio"].as_f64().unwrap() < 0.01, "{stored}");
    assert!(stored["levels"][0]["hull_error"].as_f64().unwrap() <= 0.1, "{stored}");
    let text = ok(["verify", arg(&blob), arg(&directory.join("askew.obj"))]);
    assert!(text.contains("every level holds every triangle of the mesh"), "{text}");
    let copy = directory.join("cut.msw");
    ok(["cut", arg(&blob), "--triboxes", "1", "-o", arg(&copy)]);
    assert_eq!(info(&copy)["triboxes"]["orientation"], stored["orientation"]);
}

#[test]
fn build_says_what_extrema_gained_as_two_builds_differ() {
    let directory = scratch("triboxes_extrema");
    let mesh = fixture("groove.obj");
    let build = |name: &str, more: &[&str]| {
        let blob = directory.join(name);
        let options = ["build", arg(&mesh), "-o", arg(&blob), "--for", "triboxes"];
        let text = ok([&options[..], &["--triboxes", "8"], more].concat());
        let levels = info(&blob)["triboxes"]["levels"].as_array().unwrap().clone();
        (text, 100.0 * levels.last().unwrap()["void_ratio"].as_f64().unwrap())
    };
    let (plain, before) = build("plain.msw", &[]);
    let (tried, after) = build("tried.msw", &["--extrema"]);
    assert!(!plain.contains("--extrema"), "{plain}");
    let (_, told) = tried.split_once("  gained by --extrema: void ").expect("it says so");
    let told: Vec<f64> = told
        .split(" %")
        .take(2)
        .map(|part| part.trim_start_matches(" before, ").parse().unwrap())
        .collect();
    assert!(after < before, "{tried}");
    for (told, stored) in told.iter().zip([before, after]) {
        assert!((told - stored).abs() <= 0.01 * stored + 0.06, "{told} {stored}: {tried}");
    }
    assert_eq!(told.len(), 2);
}

#[test]
fn points_are_no_nearer_than_a_lower_bound() {
    let directory = scratch("triboxes_points");
    let (blob, triangles) = built(&directory);
    let points = directory.join("points.csv");
    write_csv(&points, &random_queries::<3>(&triangles, 200));
    let text = ok(["closest", arg(&blob), arg(&points), "--triboxes"]);
    let bounds = parse_csv(&text, "x,y,z,lower,tribox,work");
    let text = ok(["within", arg(&blob), arg(&points), "--distance", "0.5", "--triboxes"]);
    let verdicts = parse_csv(&text, "x,y,z,within,tribox,work");
    assert_eq!((bounds.len(), verdicts.len()), (200, 200));
    let (mut tight, mut farther) = (0, 0);
    for (row, verdict) in bounds.iter().zip(&verdicts) {
        let p = [0, 1, 2].map(|k| number(&row[k]));
        let (lower, truth) = (number(&row[3]), distance(p, &triangles));
        assert!(lower <= truth * (1.0 + 1e-6), "{row:?} {truth}");
        tight += usize::from(lower > 0.9 * truth && truth > 0.1);
        assert_eq!(verdict[3] == "no", lower > 0.5, "{verdict:?} {row:?}");
        assert_eq!(verdict[4].is_empty(), verdict[3] == "no", "{verdict:?}");
        farther += usize::from(verdict[3] == "no");
    }
    assert!(tight > 30 && farther > 20, "{tight} {farther}");
}

#[test]
fn segments_meet_nothing_before_they_may() {
    let directory = scratch("triboxes_segments");
    let (blob, triangles) = built(&directory);
    let file = directory.join("segments.csv");
    let segments = random_queries::<6>(&triangles, 200);
    write_csv(&file, &segments);
    let text = ok(["segment", arg(&blob), arg(&file), "--triboxes"]);
    let rows = parse_csv(&text, "hit,t,tribox,work");
    assert_eq!(rows.len(), segments.len());
    let (mut clear, mut sharp) = (0, 0);
    for (row, segment) in rows.iter().zip(&segments) {
        let truth = first_crossing(wide(&segment[..3]), wide(&segment[3..]), &triangles);
        match row[0].as_str() {
            "no" => {
                assert!(truth.is_none() && row[1].is_empty() && row[2].is_empty(), "{row:?}");
                clear += 1;
            }
            "undecided" => {
                let t = number(&row[1]);
                assert!(truth.is_none_or(|truth| t <= truth + 1e-6), "{row:?} {truth:?}");
                sharp += usize::from(truth.is_some_and(|truth| truth - t < 0.02));
            }
            _ => panic!("{row:?}"),
        }
    }
    assert!(clear > 20 && sharp > 20, "{clear} {sharp}");
}

#[test]
fn models_that_meet_are_never_apart_and_all_candidates_are_listed() {
    let directory = scratch("triboxes_overlap");
    let (blob, triangles) = built(&directory);
    let header = "pose,contact,first,second,work";
    // Translations in general position: no two faces are in one plane.
    let moves: Vec<[f64; 3]> = (0..60)
        .map(|i| {
            [f64::from(i % 6) - 2.37, f64::from(i / 6 % 5) - 1.91, 0.83 * f64::from(i % 4) + 0.07]
        })
        .collect();
    let poses: Vec<String> = moves.iter().map(|[x, y, z]| format!("{x},{y},{z},1,0,0,0")).collect();
    let mut words = vec!["overlap", arg(&blob), arg(&blob), "--triboxes", "--pose"];
    words.extend(poses.iter().map(String::as_str));
    let one = parse_csv(&ok(words.clone()), header);
    words.insert(3, "--all");
    let all = parse_csv(&ok(words), header);
    assert_eq!((one.len(), all.len()), (60, 60), "of one tribox there is one pair");
    let (mut apart, mut met) = (0, 0);
    for ((row, listed), by) in one.iter().zip(&all).zip(&moves) {
        let moved: Vec<Triangle> =
            triangles.iter().map(|t| t.map(|p| [0, 1, 2].map(|k| p[k] + by[k]))).collect();
        let crosses = |a: &[Triangle], b: &[Triangle]| {
            a.iter().any(|t| (0..3).any(|k| first_crossing(t[k], t[(k + 1) % 3], b).is_some()))
        };
        let meet = crosses(&triangles, &moved) || crosses(&moved, &triangles);
        assert!(["apart", "undecided"].contains(&row[1].as_str()), "{row:?}");
        assert!(!(meet && row[1] == "apart"), "{row:?} {by:?}");
        assert_eq!(row[1], listed[1]);
        apart += usize::from(row[1] == "apart");
        met += usize::from(meet);
    }
    assert!(apart > 10 && met > 10, "{apart} {met}");
}

#[test]
fn triboxes_do_not_go_with_other_structures() {
    let directory = scratch("triboxes_usage");
    let (blob, _) = built(&directory);
    for words in [
        ["closest", arg(&blob), "0,0,0", "--triboxes", "--precise"].as_slice(),
        &["within", arg(&blob), "0,0,0", "--distance", "1", "--triboxes", "--all"],
        &["segment", arg(&blob), "0,0,0,1,1,1", "--triboxes", "--all"],
        &["overlap", arg(&blob), arg(&blob), "--triboxes", "--engine", "hull"],
    ] {
        assert_eq!(run(words).status.code(), Some(2), "{words:?}");
    }
    let tree = crate::support::blob(&directory, "groove.obj", &["--for", "closest"]);
    refused(&run(["closest", arg(&tree), "0,0,0", "--triboxes"]), 1, "--for triboxes");
}
