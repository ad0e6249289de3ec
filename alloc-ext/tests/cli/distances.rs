//! `meshsweep within`, `nearest`, `signed` and `field` against brute force.

use crate::support::{
    Point, Triangle, arg, blob, distance, fixture, number, ok, parse_csv, random_queries, refused,
    run, scratch, to_triangle, triangles, wide, write_csv,
};
use std::fs;
use std::path::Path;

/// Relative error of the brute force.
const SLACK: f64 = 1e-12;

/// Distance to the torus of `fixtures/torus.ply` before it was made of triangles, negative inside.
fn to_torus([x, y, z]: Point) -> f64 {
    (x.hypot(y) - 2.0).hypot(z) - 0.75
}

const SIGNED: &str = "x,y,z,side,reason,lower,upper,px,py,pz,triangle,work";

/// No point of the triangles is farther than this from the torus.
const SAGITTA: f64 = 0.013;

fn ask(
    command: &str,
    blob: &Path,
    points: &Path,
    options: &[&str],
    header: &str,
) -> Vec<Vec<String>> {
    parse_csv(&ok([&[command, arg(blob), arg(points)], options].concat()), header)
}

fn holds(lower: &str, upper: &str, truth: f64) -> bool {
    number(lower) <= truth * (1.0 + SLACK) && truth * (1.0 - SLACK) <= number(upper)
}

#[test]
fn within_says_yes_and_no_rightly_and_unknown_only_near_the_limit() {
    const WITHIN: &str = "x,y,z,within,triangle,work";
    let directory = scratch("within");
    let points = directory.join("p.csv");
    for (name, limit) in [("bracket.stl", 6.0), ("torus.ply", 0.3), ("evil/open_box.stl", 0.4)] {
        let mesh = triangles(&fixture(name));
        let rows = random_queries::<3>(&mesh, 200);
        write_csv(&points, &rows);
        let path = blob(&directory, name, &[]);
        let answers = ask("within", &path, &points, &["--distance", &limit.to_string()], WITHIN);
        let limit = f64::from(limit as f32);
        for (answer, row) in answers.iter().zip(&rows) {
            let truth = distance(wide(row), &mesh);
            match answer[3].as_str() {
                "yes" => {
                    let named = mesh[answer[4].parse::<usize>().unwrap()];
                    assert!(to_triangle(wide(row), named) <= limit * (1.0 + SLACK), "{answer:?}");
                }
                "no" => assert!(
                    truth * (1.0 + SLACK) > limit && answer[4].is_empty(),
                    "{answer:?} {truth}"
                ),
                _ => assert!(
                    (truth - limit).abs() < 1e-2 && answer[4].is_empty(),
                    "{answer:?} {truth}"
                ),
            }
        }
        let count = |what: &str| answers.iter().filter(|answer| answer[3] == what).count();
        assert!(count("yes") > 20 && count("no") > 20, "{name}");
    }
}

#[test]
fn within_all_lists_every_triangle_that_is_near_enough() {
    const ALL: &str = "query,within,lower,upper,px,py,pz,triangle,work";
    let directory = scratch("within_all");
    let points = directory.join("p.csv");
    let mesh = triangles(&fixture("torus.ply"));
    let rows = random_queries::<3>(&mesh, 30);
    write_csv(&points, &rows);
    let path = blob(&directory, "torus.ply", &["--vertex-bits", "32"]);
    let answers = ask("within", &path, &points, &["--distance", "0.75", "--all"], ALL);
    for (query, row) in rows.iter().enumerate() {
        let mine = || answers.iter().filter(|answer| answer[0] == query.to_string());
        let mut listed: Vec<usize> = mine().filter_map(|answer| answer[7].parse().ok()).collect();
        listed.sort_unstable();
        let truly = (0..mesh.len()).filter(|&t| to_triangle(wide(row), mesh[t]) <= 0.75);
        assert_eq!(listed, truly.collect::<Vec<_>>(), "{row:?}");
        assert_eq!(listed.is_empty(), mine().any(|answer| answer[1] == "no"));
        assert!(
            mine().filter(|answer| answer[1] == "yes").all(|answer| number(&answer[3]) <= 0.75)
        );
    }
    assert!(answers.iter().filter(|answer| answer[0] == "0").count() > 0);
}

#[test]
fn nearest_ranks_triangles_with_intervals_that_hold() {
    const NEAREST: &str = "query,rank,lower,upper,px,py,pz,triangle,work";
    let directory = scratch("nearest");
    let points = directory.join("p.csv");
    let mesh = triangles(&fixture("bracket.stl"));
    let rows = random_queries::<3>(&mesh, 50);
    write_csv(&points, &rows);
    let path = blob(&directory, "bracket.stl", &[]);
    let answers = ask("nearest", &path, &points, &["-n", "10"], NEAREST);
    assert_eq!(answers.len(), 10 * rows.len());
    for (row, ranked) in rows.iter().zip(answers.chunks(10)) {
        let mut all: Vec<f64> = mesh.iter().map(|&t| to_triangle(wide(row), t)).collect();
        for (rank, answer) in ranked.iter().enumerate() {
            assert_eq!(answer[1], (rank + 1).to_string());
            let truth = all[answer[7].parse::<usize>().unwrap()];
            assert!(holds(&answer[2], &answer[3], truth), "{answer:?} {truth}");
        }
        all.sort_unstable_by(f64::total_cmp);
        assert!(number(&ranked[9][2]) <= all[9] * (1.0 + SLACK), "{row:?}");
    }
    // No more than there are.
    fs::write(&points, "1 2 3\n").unwrap();
    let path = blob(&directory, "evil/open_box.stl", &[]);
    assert_eq!(ask("nearest", &path, &points, &["-n", "1000"], NEAREST).len(), 40);
}

#[test]
fn signed_names_the_side_and_the_interval_holds() {
    let directory = scratch("signed");
    let points = directory.join("p.csv");
    let mesh = triangles(&fixture("torus.ply"));
    let rows = random_queries::<3>(&mesh, 200);
    write_csv(&points, &rows);
    let path = blob(&directory, "torus.ply", &[]);
    let answers = ask("signed", &path, &points, &[], SIGNED);
    for (answer, row) in answers.iter().zip(&rows) {
        let truth = to_torus(wide(row));
        let side = if truth < 0.0 { "inside" } else { "outside" };
        let is_clear = truth.abs() > 2.0 * SAGITTA;
        assert!(answer[3] == side || !is_clear, "{answer:?} {truth}");
        let truth = distance(wide(row), &mesh).copysign(truth);
        let margin = SLACK * truth.abs();
        let holds = number(&answer[5]) <= truth + margin && truth - margin <= number(&answer[6]);
        assert!(holds || !is_clear, "{answer:?} {truth}");
    }
    let inside = answers.iter().filter(|answer| answer[3] == "inside").count();
    assert!((10..190).contains(&inside));
    assert!(answers.iter().all(|answer| answer[4].is_empty() == (answer[3] != "undecided")));
}

#[test]
fn an_undefined_side_has_a_reason_and_an_interval_all_the_same() {
    let directory = scratch("undecided");
    let (open, closed) =
        (blob(&directory, "evil/open_box.stl", &[]), blob(&directory, "torus.ply", &[]));
    let mesh = triangles(&fixture("torus.ply"));
    let vertex = mesh[0][0].map(|x| x.to_string()).join(",");
    for (blob, point, options, reason) in [
        (&open, "3,3,3", &[][..], "open mesh"),
        (&closed, &vertex, &[], "at the surface"),
        (&closed, "0.5,0,0", &["--steps", "1"], "out of steps"),
        (&closed, "0.5,0,0", &["--scratch", "1"], "out of scratch memory"),
    ] {
        let output = run([&["signed", arg(blob), point], options].concat());
        let answers = parse_csv(&String::from_utf8(output.stdout).unwrap(), SIGNED);
        let answer = &answers[0];
        assert_eq!(answer[3..5], ["undecided", reason]);
        assert_eq!(number(&answer[5]), -number(&answer[6]));
        let note = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(
            note.contains("open_box.msw: the mesh is not closed, so every side is undecided"),
            reason == "open mesh"
        );
    }
}

/// Numbers of a raw file.
fn raw(path: &Path) -> Vec<f32> {
    fs::read(path)
        .unwrap()
        .as_chunks::<4>()
        .0
        .iter()
        .map(|&bytes| f32::from_le_bytes(bytes))
        .collect()
}

/// Sample `index` of a grid of 9 by 8 by 7 around a box, x fastest.
fn sample(mesh: &[Triangle], index: usize) -> Point {
    let at = [index % 9, index / 9 % 8, index / 72];
    let low = |k: usize| mesh.iter().flatten().map(|p| p[k]).fold(f64::INFINITY, f64::min) - 1.0;
    let high =
        |k: usize| mesh.iter().flatten().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max) + 1.0;
    core::array::from_fn(|k| low(k) + at[k] as f64 * (high(k) - low(k)) / ([9, 8, 7][k] - 1) as f64)
}

#[test]
fn a_field_s_intervals_hold_wherever_a_sample_is() {
    let directory = scratch("field");
    let mesh = triangles(&fixture("bracket.stl"));
    let path = blob(&directory, "bracket.stl", &["--vertex-bits", "32"]);
    let out = directory.join("f.f32");
    let grid = ["--size", "9,8,7", "--margin", "1"];
    let text = ok([&["field", arg(&path), "-o", arg(&out), "--interval"], &grid[..]].concat());
    assert!(text.contains("1008 values of f32, shape (7, 8, 9, 2), x fastest"), "{text}");
    let values = raw(&out);
    assert_eq!(values.len(), 2 * 9 * 8 * 7);
    for (index, [lower, upper]) in values.as_chunks::<2>().0.iter().enumerate() {
        // The sample is rounded to f32, and so is the box, outward.
        let truth = distance(sample(&mesh, index), &mesh);
        assert!(f64::from(*lower) <= truth + 1e-4 && truth - 1e-4 <= f64::from(*upper), "{index}");
    }
    let middles = directory.join("m.raw");
    ok([&["field", arg(&path), "-o", arg(&middles)], &grid[..]].concat());
    for (middle, [lower, upper]) in raw(&middles).iter().zip(values.as_chunks::<2>().0) {
        assert!(lower <= middle && middle <= upper);
    }
}

#[test]
fn a_field_has_the_same_bytes_for_any_number_of_threads_and_numpy_s_header() {
    let directory = scratch("field_threads");
    let path = blob(&directory, "torus.ply", &[]);
    let (one, many, npy) =
        (directory.join("1.f32"), directory.join("5.f32"), directory.join("a.npy"));
    ok(["field", arg(&path), "-o", arg(&one), "--size", "20", "--threads", "1"]);
    ok(["field", arg(&path), "-o", arg(&many), "--size", "20", "--threads", "5"]);
    ok(["field", arg(&path), "-o", arg(&npy), "--size", "20"]);
    let bytes = fs::read(&one).unwrap();
    assert_eq!(bytes.len(), 4 * 20 * 20 * 20);
    assert!(bytes == fs::read(&many).unwrap());
    let npy = fs::read(&npy).unwrap();
    assert!(npy.starts_with(b"\x93NUMPY\x01\x00") && npy.ends_with(&bytes));
    assert!(String::from_utf8_lossy(&npy[..128]).contains("'shape': (20, 20, 20,)"));
}

#[test]
fn a_signed_field_is_negative_inside_and_needs_a_closed_mesh() {
    let directory = scratch("field_signed");
    let mesh = triangles(&fixture("torus.ply"));
    let path = blob(&directory, "torus.ply", &[]);
    let out = directory.join("f.f32");
    ok(["field", arg(&path), "-o", arg(&out), "--size", "9,8,7", "--margin", "1", "--signed"]);
    for (index, &value) in raw(&out).iter().enumerate() {
        let truth = to_torus(sample(&mesh, index));
        assert!((f64::from(value) - truth).abs() <= SAGITTA + 1e-3, "{index} {value} {truth}");
    }
    let open = blob(&directory, "evil/open_box.stl", &[]);
    let line = refused(&run(["field", arg(&open), "-o", arg(&out), "--signed"]), 1, "open_box.msw");
    assert!(line.contains("not closed"), "{line}");
}

#[test]
fn samples_without_a_sign_are_quiet_nans_and_counted() {
    let directory = scratch("field_nan");
    // The middle of a face of the box, and of an edge, are on the surface.
    let path = blob(&directory, "evil/cavity.stl", &[]);
    let (one, many, wide) =
        (directory.join("1.f32"), directory.join("7.f32"), directory.join("i.f32"));
    let field = |out: &Path, options: &[&str]| {
        run([
            &["field", arg(&path), "-o", arg(out), "--size", "9", "--margin", "0", "--signed"],
            options,
        ]
        .concat())
    };
    let output = field(&one, &["--threads", "1"]);
    assert!(output.status.success());
    let values = raw(&one);
    let nans = values.iter().filter(|x| x.to_bits() == 0x7FC0_0000).count();
    // All but the inner samples are on the outer faces.
    assert!(nans >= 9 * 9 * 9 - 7 * 7 * 7 && nans < values.len(), "{nans}");
    assert!(values.iter().all(|x| !x.is_nan() || x.to_bits() == 0x7FC0_0000));
    let note = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        note.contains(&format!("{nans} of 729 samples have no sign: {nans} at the surface; ")),
        "{note}"
    );
    assert!(field(&many, &["--threads", "7"]).stderr.len() == note.len());
    assert!(fs::read(&one).unwrap() == fs::read(&many).unwrap());
    let note = String::from_utf8_lossy(&field(&wide, &["--interval"]).stderr).into_owned();
    assert!(note.contains("from -upper to upper"), "{note}");
    for (value, [lower, upper]) in values.iter().zip(raw(&wide).as_chunks::<2>().0) {
        assert_eq!(value.is_nan(), *lower == -upper, "{value} {lower} {upper}");
    }
}
