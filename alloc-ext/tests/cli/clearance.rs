//! `meshsweep clearance` against brute force over the triangles of the mesh files.

use crate::support::{
    Point, Triangle, arg, blob, dot, fixture, info, ok, parse_csv, refused, run, scratch, sub,
    to_triangle, triangles, write_csv,
};
use std::fs;

const HEADER: &str = "pose,lower,upper,ax,ay,az,bx,by,bz,first,second,work";
const WITHIN: &str = "pose,within,first,second,work";

fn part(from: Point, way: Point, t: f64) -> Point {
    [from[0] + way[0] * t, from[1] + way[1] * t, from[2] + way[2] * t]
}

/// The least value of a convex function on 0 to 1.
fn least(of: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let (p, q) = ((2.0 * low + high) / 3.0, (low + 2.0 * high) / 3.0);
        if of(p) < of(q) { high = q } else { low = p }
    }
    of(0.0).min(of(1.0)).min(of(low))
}

/// Distance of two triangles that do not meet: of the edges of each from the other.
fn distance(a: &Triangle, b: &Triangle) -> f64 {
    let edges = |t: &Triangle, other: Triangle| {
        let edge =
            |k: usize| least(|s| to_triangle(part(t[k], sub(t[(k + 1) % 3], t[k]), s), other));
        (0..3).map(edge).fold(f64::INFINITY, f64::min)
    };
    edges(a, *b).min(edges(b, *a))
}

fn number(field: &str) -> f64 {
    field.parse().unwrap()
}

#[test]
fn intervals_and_triangles_are_those_of_the_mesh_files() {
    let directory = scratch("clearance");
    let mesh = triangles(&fixture("torus.ply"));
    let torus = blob(&directory, "torus.ply", &["--for", "segment", "--vertex-bits", "32"]);
    let shifts = [[6.0, 0.5, 0.25], [0.125, -0.25, 3.0], [-5.0, 4.0, 2.0]];
    let texts: Vec<String> =
        shifts.iter().map(|[x, y, z]| format!("{x},{y},{z},1,0,0,0")).collect();
    let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
    let files = ["clearance", arg(&torus), arg(&torus), "--pose"];
    let rows = parse_csv(&ok([&files[..], &texts[..]].concat()), HEADER);
    assert_eq!(rows.len(), shifts.len());
    for (shift, row) in shifts.iter().zip(&rows) {
        let moved = |t: &Triangle| t.map(|p| part(p, *shift, 1.0));
        let (lower, upper) = (number(&row[1]), number(&row[2]));
        let (a, b) = (row[9].parse::<usize>().unwrap(), row[10].parse::<usize>().unwrap());
        let theirs = distance(&mesh[a], &moved(&mesh[b]));
        assert!((lower * 0.999_999..=upper * 1.000_001).contains(&theirs), "{row:?} {theirs}");
        // Nothing is nearer, as far as vertices tell.
        for t in &mesh {
            for p in mesh.iter().map(|other| moved(other)[0]) {
                let gap = sub(p, t[0]);
                assert!(dot(gap, gap).sqrt() >= lower * 0.999_999, "{row:?}");
            }
        }
        let place = |at: usize| [0, 1, 2].map(|k| number(&row[at + k]));
        let way = sub(place(6), place(3));
        assert!((dot(way, way).sqrt() - upper).abs() < 1e-5, "{row:?}");
        assert!(to_triangle(place(3), mesh[a]) < 1e-5, "{row:?}");
        assert!(to_triangle(place(6), moved(&mesh[b])) < 1e-5, "{row:?}");
    }
    for (part, word) in [(0.5, "no"), (2.0, "yes")] {
        for (text, row) in texts.iter().zip(&rows) {
            let distance = (part * number(&row[1])).to_string();
            let found = ok([&files[..], &[text, "--within", &distance][..]].concat());
            assert_eq!(parse_csv(&found, WITHIN)[0][1], word, "{row:?}");
        }
    }
}

#[test]
fn meshes_that_meet_have_no_distance_and_few_steps_widen_the_interval() {
    let directory = scratch("clearance_meets");
    let torus = blob(&directory, "torus.ply", &[]);
    let serves = info(&torus)["serves"].clone();
    assert!(serves.as_array().unwrap().iter().any(|question| question == "clearance"));
    let poses = directory.join("poses.csv");
    write_csv(
        &poses,
        &[[2.5f32, 0.1, 0.2, 1.0, 0.5, 0.25, 0.0], [9.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]],
    );
    let out = directory.join("clearance.csv");
    let files = ["clearance", arg(&torus), arg(&torus), "--pose", arg(&poses)];
    let output = run([&files[..], &["-o", arg(&out)]].concat());
    assert!(output.status.success() && output.stdout.is_empty());
    let rows = parse_csv(&fs::read_to_string(&out).unwrap(), HEADER);
    assert_eq!([&rows[0][1], &rows[0][2]], ["0", "0"]);
    let (lower, upper) = (number(&rows[1][1]), number(&rows[1][2]));
    assert!(0.0 < lower && lower <= upper);
    for more in [["--steps", "1"], ["--rel", "0.5"], ["--scratch", "1"]] {
        let rows = parse_csv(&ok([&files[..], &more].concat()), HEADER);
        assert!(number(&rows[1][1]) <= lower && upper <= number(&rows[1][2]), "{rows:?}");
    }
}

#[test]
fn solids_are_parted_by_the_translation_that_is_printed() {
    let directory = scratch("clearance_depth");
    let serves = ["--for", "closest,segment,winding"];
    let plain = blob(&directory, "torus.ply", &[]);
    let output = run(["clearance", arg(&plain), arg(&plain), "--depth"]);
    assert!(refused(&output, 1, "torus.msw").contains("closest,segment,winding"));
    let torus = blob(&directory, "torus.ply", &serves);
    let files = ["clearance", arg(&torus), arg(&torus), "--pose"];
    let poses = ["5,0.1,0.2,1,0.5,0.25,0", "0.1,0.2,0,1,0,0,0", "9,0,0,1,0,0,0"];
    let header = "pose,solids,lower,upper,x,y,z,px,py,pz,work";
    let rows = parse_csv(&ok([&files[..], &poses, &["--depth"]].concat()), header);
    for (pose, row) in poses.iter().zip(&rows).take(2) {
        assert_eq!(row[1], "overlap", "{row:?}");
        let (lower, upper) = (number(&row[2]), number(&row[3]));
        assert!(0.0 < lower && lower <= upper, "{row:?}");
        let (_, turn) =
            pose.match_indices(',').nth(2).map_or(("", ""), |(at, _)| pose.split_at(at));
        let parted = format!("{},{},{}{turn}", row[4], row[5], row[6]);
        let found = parse_csv(&ok([&files[..], &[parted.as_str()]].concat()), HEADER);
        assert!(number(&found[0][1]) > 0.0, "{row:?} {found:?}");
    }
    assert_eq!(rows[2][1..4], ["apart", "0", "0"], "{rows:?}");
    let open = blob(&directory, "evil/open_box.stl", &serves);
    let output = run(["clearance", arg(&torus), arg(&open), "--depth"]);
    assert!(refused(&output, 1, "open_box.msw").contains("closed"));
}

#[test]
fn what_cannot_be_asked_is_refused_by_name() {
    let directory = scratch("clearance_refused");
    let torus = blob(&directory, "torus.ply", &[]);
    let closest = blob(&directory, "bracket.stl", &["--for", "closest"]);
    let wrong = |args: &[&str]| run([&["clearance", arg(&torus)], args].concat());
    assert!(refused(&wrong(&[arg(&closest)]), 1, "bracket.msw").contains("--for closest,segment"));
    let none = wrong(&[arg(&torus), "--pose", "0,0,0,0,0,0,0"]);
    assert!(refused(&none, 2, "").contains("quaternion"));
    let both = wrong(&[arg(&torus), "--within", "1", "--rel", "0.1"]);
    assert_eq!(both.status.code(), Some(2));
    assert_eq!(wrong(&[arg(&torus), "--within", "-1"]).status.code(), Some(2));
    assert_eq!(wrong(&[arg(&torus), "-o", arg(&torus)]).status.code(), Some(1));
}

#[test]
fn moves_from_pose_to_pose_are_clear_or_name_where_they_stop() {
    let directory = scratch("clearance_moves");
    let part = blob(&directory, "torus.ply", &[]);
    // Through the hole of the torus there is no way; round it there is.
    let poses = [
        [-9.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
        [0.0, 9.0, 0.0, 1.0, 0.0, 0.0, -1.0],
        [9.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
        [-9.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
    ];
    let path = directory.join("path.csv");
    write_csv(&path, &poses);
    let header = "move,clear,t,ax,ay,az,bx,by,bz,first,second,work";
    for kind in ["straight", "screw"] {
        let asked = ["clearance", arg(&part), arg(&part), "--pose", arg(&path), "--moves", kind];
        let moves = parse_csv(&ok(asked), header);
        let told = String::from_utf8_lossy(&run(asked).stderr).into_owned();
        let warned = told.contains("3 moves between poses of different rotation");
        assert_eq!(warned, kind == "straight");
        let clear: Vec<&str> = moves.iter().map(|row| row[1].as_str()).collect();
        // Half a turn back about an axis leads round it.
        let last = if kind == "screw" { "yes" } else { "undecided" };
        assert_eq!(clear, ["yes", "yes", last], "{kind}");
        if last == "undecided" {
            let t = number(&moves[2][2]);
            assert!(0.05 < t && t < 0.5, "{t}");
        }
        let keep = parse_csv(&ok([&asked[..], &["--within", "6"]].concat()), header);
        assert_eq!(keep[0][1], "undecided", "{kind}");
    }
    let one = ["clearance", arg(&part), arg(&part), "--pose", "1,2,3,1,0,0,0", "--moves", "screw"];
    assert_eq!(run(one).status.code(), Some(2));
}

#[test]
fn triboxes_tell_no_distance_that_the_surfaces_do_not_keep() {
    let directory = scratch("clearance_triboxes");
    let options = ["--for", "segment,triboxes", "--triboxes", "16"];
    let torus = blob(&directory, "torus.ply", &options);
    let poses: Vec<String> = (0..40)
        .map(|i| {
            let (x, y, turn) = (0.4 * f64::from(i), 0.1 * f64::from(i % 7), f64::from(i % 5));
            format!("{x},{y},0.3,1,{turn},0.5,0")
        })
        .collect();
    let mut files = vec!["clearance", arg(&torus), arg(&torus), "--within", "1.5", "--pose"];
    files.extend(poses.iter().map(String::as_str));
    let by_trees = parse_csv(&ok(files.clone()), WITHIN);
    files.push("--triboxes");
    let by_triboxes = parse_csv(&ok(files), WITHIN);
    let mut farther = 0;
    for (theirs, row) in by_trees.iter().zip(&by_triboxes) {
        assert!(["no", "undecided"].contains(&row[1].as_str()), "{row:?}");
        assert!(row[1] == "undecided" || theirs[1] == "no", "{row:?} {theirs:?}");
        // It names triboxes that may be nearer.
        assert_eq!(row[1] == "no", row[2].is_empty() && row[3].is_empty(), "{row:?}");
        farther += usize::from(row[1] == "no");
    }
    assert_eq!(by_triboxes.len(), 40);
    assert!((5..40).contains(&farther), "{farther}");
    let files = ["clearance", arg(&torus), arg(&torus), "--triboxes"];
    assert_eq!(run(files).status.code(), Some(2), "it wants --within");
    let tree = blob(&directory, "groove.obj", &["--for", "segment"]);
    let files = ["clearance", arg(&tree), arg(&torus), "--within", "1", "--triboxes"];
    refused(&run(files), 1, "--for triboxes");
}
