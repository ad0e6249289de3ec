//! `meshsweep clear` against brute force over the triangles of the mesh file.

use crate::support::{
    arg, blob, distance, fixture, ok, parse_csv, refused, run, scratch, to_triangle, triangles,
    write_csv,
};
use std::fs;

const HEADER: &str = "clear,t,px,py,pz,triangle,work";

fn number(field: &str) -> f64 {
    field.parse().unwrap()
}

const MOVES: [[f32; 6]; 5] = [
    [-5.0, 0.25, 3.0, 5.0, 0.25, 3.0],
    [-5.0, 0.25, 0.0, 5.0, 0.25, 0.0],
    [0.0, 0.0, -4.0, 0.0, 0.0, 4.0],
    [2.0, 0.0, 5.0, 2.0, 0.0, -5.0],
    [9.0, 9.0, 9.0, 9.0, 9.0, -9.0],
];

#[test]
fn a_ball_goes_on_until_its_radius_is_left_and_no_farther() {
    let directory = scratch("clear");
    let mesh = triangles(&fixture("torus.ply"));
    let torus = blob(&directory, "torus.ply", &["--for", "segment", "--vertex-bits", "32"]);
    let moves = directory.join("moves.csv");
    write_csv(&moves, &MOVES);
    let radius = 0.5;
    let rows = parse_csv(&ok(["clear", arg(&torus), arg(&moves), "--radius", "0.5"]), HEADER);
    let words: Vec<&str> = rows.iter().map(|row| row[0].as_str()).collect();
    assert_eq!(words, ["yes", "no", "yes", "no", "yes"]);
    for (row, ends) in rows.iter().zip(MOVES) {
        let until = if row[0] == "yes" { 1.0 } else { number(&row[1]) };
        let [ax, ay, az, bx, by, bz] = ends.map(f64::from);
        let at = |t: f64| [ax + (bx - ax) * t, ay + (by - ay) * t, az + (bz - az) * t];
        let nearest = |p| distance(p, &mesh);
        for step in 0..=200 {
            let p = at(until * f64::from(step) / 200.0);
            assert!(nearest(p) > radius - 1e-6, "{row:?} {p:?}");
        }
        if row[0] == "no" {
            assert!((nearest(at(until)) - radius).abs() < 1e-5, "{row:?}");
            let stop = [2, 3, 4].map(|k| number(&row[k]));
            let triangle = mesh[row[5].parse::<usize>().unwrap()];
            assert!(to_triangle(stop, triangle) < 1e-5, "{row:?}");
        }
    }
}

#[test]
fn a_point_without_radius_is_stopped_where_its_segment_is() {
    let directory = scratch("clear_point");
    let bracket = blob(&directory, "bracket.stl", &[]);
    let through = "10.2,4.6,90,10.2,4.6,-90";
    let found = ok(["clear", arg(&bracket), through]);
    let row = &parse_csv(&found, HEADER)[0];
    let hit = ok(["segment", arg(&bracket), through]);
    let hit = hit.lines().nth(1).unwrap().split(',').nth(1).unwrap();
    assert_eq!(row[0], "no", "{row:?}");
    assert!((number(&row[1]) - number(hit)).abs() < 1e-4, "{row:?} {hit}");
}

/// The place of a tool and its corner add up to a number that f32 has not.
#[test]
fn a_tool_whose_corners_are_rounded_is_no_smaller() {
    let directory = scratch("clear_rounded");
    let mesh = directory.join("far.obj");
    let z = 99_999_984;
    fs::write(&mesh, format!("v -1e8 -1e8 {z}\nv 1e8 -1e8 {z}\nv 0 1e8 {z}\nf 1 2 3\n")).unwrap();
    let far = directory.join("far.msw");
    ok(["build", arg(&mesh), "-o", arg(&far), "--for", "segment", "--vertex-bits", "32"]);
    // 5 and 13 above the plane: one touches it, one does not.
    for (tool, word) in [("0,0,-11", "no"), ("0,0,-3", "yes")] {
        let moved = "0,0,100000000,10,0,100000000";
        let found = ok(["clear", arg(&far), moved, "--tool", tool, "--radius", "6"]);
        let row = &parse_csv(&found, HEADER)[0];
        assert!(row[0] == word || row[0] == "undecided", "{tool}: {row:?}");
        assert!(row[0] != "yes" || word == "yes", "{tool}: {row:?}");
    }
}

#[test]
fn a_path_is_the_moves_from_place_to_place() {
    let directory = scratch("clear_path");
    let torus = blob(&directory, "torus.ply", &[]);
    let places = [[-5f32, 0.0, 3.0], [5.0, 0.0, 3.0], [2.0, 0.0, 3.0], [2.0, 0.0, -3.0]];
    let path = directory.join("places.csv");
    write_csv(&path, &places);
    let moves: Vec<String> = places
        .windows(2)
        .map(|ends| ends.iter().flatten().map(f32::to_string).collect::<Vec<_>>().join(","))
        .collect();
    let tool = ["--tool", "0,0,0,0,0,2", "--radius", "0.25"];
    let by_path = ok([&["clear", arg(&torus), "--path", arg(&path)], &tool[..]].concat());
    let moves: Vec<&str> = moves.iter().map(String::as_str).collect();
    let by_moves = ok([&["clear", arg(&torus)], &moves[..], &tool[..]].concat());
    assert_eq!(by_path, by_moves);
    let words: Vec<String> =
        parse_csv(&by_path, HEADER).into_iter().map(|row| row[0].clone()).collect();
    assert_eq!(words, ["yes", "yes", "no"]);
}

#[test]
fn a_move_that_ends_early_is_undecided_and_clear_before_its_t() {
    let directory = scratch("clear_steps");
    let torus = blob(&directory, "torus.ply", &[]);
    let found = ok(["clear", arg(&torus), "2,0,5,2,0,-5", "--radius", "0.1", "--steps", "1"]);
    let row = &parse_csv(&found, HEADER)[0];
    assert_eq!(row[0], "undecided");
    let whole = ok(["clear", arg(&torus), "2,0,5,2,0,-5", "--radius", "0.1"]);
    assert!(number(&row[1]) <= number(&parse_csv(&whole, HEADER)[0][1]), "{row:?}");
}

#[test]
fn what_is_no_tool_and_no_move_is_refused() {
    let directory = scratch("clear_refused");
    let torus = blob(&directory, "torus.ply", &[]);
    let wrong = |args: &[&str]| run([&["clear", arg(&torus)], args].concat());
    assert_eq!(wrong(&[]).status.code(), Some(2));
    assert_eq!(wrong(&["0,0,0,1,1,1", "--tool", "0,0"]).status.code(), Some(2));
    assert_eq!(wrong(&["0,0,0,1,1,1", "--radius", "-1"]).status.code(), Some(2));
    assert_eq!(wrong(&["0,0,0,1,1,1", "--path", "0,0,0"]).status.code(), Some(2));
    refused(&wrong(&["--path", "0,0,0"]), 2, "two places");
    refused(&wrong(&["0,0,0,1e30,0,0", "--radius", "1"]), 1, "corner of the tool");
    refused(&wrong(&["0,0,0,1,0,0", "--radius", "1e30"]), 2, "--radius 1e30");
    let closest = blob(&scratch("clear_closest"), "torus.ply", &["--for", "closest"]);
    refused(&run(["clear", arg(&closest), "0,0,0,1,1,1"]), 1, "--for closest,segment");
    let same = directory.join("same.csv");
    fs::write(&same, "0,0,0,1,1,1\n").unwrap();
    refused(&wrong(&[arg(&same), "-o", arg(&same)]), 1, "same.csv");
}
