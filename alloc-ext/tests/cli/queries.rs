//! `meshsweep closest` and `segment` against brute force.

use crate::support::{
    arg, ascent, blob, distance, first_crossing, fixture, hull_blob, meshsweep, number, ok,
    parse_csv, random_queries, run, scratch, to_triangle, triangles, wide, write_csv, write_raw,
};
use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::Stdio;

const CLOSEST: &str = "x,y,z,lower,upper,px,py,pz,triangle,work";
const SEGMENT: &str = "hit,t,px,py,pz,triangle,work";

/// Relative error of the brute force.
const SLACK: f64 = 1e-12;

fn contains(row: &[String], truth: f64) -> bool {
    number(&row[3]) <= truth * (1.0 + SLACK) && truth * (1.0 - SLACK) <= number(&row[4])
}

/// Asks for the closest points of `rows`.
fn closest(blob: &Path, points: &Path, options: &[&str]) -> Vec<Vec<String>> {
    parse_csv(&ok([&["closest", arg(blob), arg(points)], options].concat()), CLOSEST)
}

#[test]
fn precise_intervals_contain_the_distance_to_the_file_and_are_as_narrow_as_f32() {
    let directory = scratch("precise");
    let (points, mesh) = (directory.join("points.csv"), triangles(&fixture("bracket.stl")));
    let rows = random_queries::<3>(&mesh, 100);
    write_csv(&points, &rows);
    let path = blob(&directory, "bracket.stl", &["--vertex-bits", "32"]);
    for (answer, point) in closest(&path, &points, &["--precise"]).iter().zip(&rows) {
        let truth = distance(wide(point), &mesh);
        assert!(contains(answer, truth), "{answer:?} {truth}");
        assert!(number(&answer[4]) - number(&answer[3]) <= 3e-7 * truth, "{answer:?}");
    }
}

#[test]
fn the_interval_contains_the_distance_to_the_file() {
    let directory = scratch("interval_contains");
    for (name, options) in [
        ("bracket.stl", &["--for", "closest,hull"][..]),
        ("torus.ply", &["--for", "closest,hull"]),
        ("groove.obj", &["--for", "closest,hull"]),
        ("torus.ply", &["--for", "closest,hull", "--vertex-bits", "16"]),
        ("groove.obj", &["--for", "closest,hull", "--vertex-bits", "16"]),
        ("bracket.stl", &["--for", "closest,hull", "--vertex-bits", "32"]),
        ("torus.ply", &["--for", "closest,hull", "--vertex-bits", "24"]),
        ("evil/open_box.stl", &["--for", "closest"]),
        ("evil/klein_bottle.obj", &["--for", "closest"]),
    ] {
        let mesh = triangles(&fixture(name));
        let points = directory.join("points.csv");
        let rows = random_queries::<3>(&mesh, 60);
        write_csv(&points, &rows);
        let path = blob(&directory, name, options);
        let engines = if options[1].contains("hull") { &["tree", "hull"][..] } else { &["tree"] };
        for engine in engines {
            for (answer, point) in closest(&path, &points, &["--engine", engine]).iter().zip(&rows)
            {
                let truth = distance(wide(point), &mesh);
                assert!(contains(answer, truth), "{name} {options:?} {engine} {answer:?} {truth}");
                // The witness is in the triangle that is named, and at most `upper` away.
                let witness = [5, 6, 7].map(|k| number(&answer[k]));
                let named = mesh[answer[8].parse::<usize>().unwrap()];
                assert!(to_triangle(witness, named) <= 1e-3, "{engine} {answer:?}");
            }
        }
    }
}

#[test]
fn the_box_tree_answers_unless_told_otherwise() {
    let directory = scratch("engines");
    let path = blob(&directory, "bracket.stl", &["--for", "closest,hull"]);
    let points = directory.join("p.csv");
    write_csv(&points, &random_queries::<3>(&triangles(&fixture("bracket.stl")), 20));
    let by = |options: &[&str]| closest(&path, &points, options);
    assert_eq!(by(&[]), by(&["--engine", "tree"]));
    assert_ne!(by(&[]), by(&["--engine", "hull"]));
}

#[test]
fn queries_that_stop_early_still_contain_the_distance_and_say_so() {
    let directory = scratch("stop_early");
    let mesh = triangles(&fixture("bracket.stl"));
    let rows = random_queries::<3>(&mesh, 50);
    let points = directory.join("points.csv");
    write_csv(&points, &rows);
    let path = blob(&directory, "bracket.stl", &["--for", "closest,hull"]);
    for engine in ["tree", "hull"] {
        for (options, reason) in [
            (["--steps", "3"], "out of steps"),
            (["--rel", "0.5"], "within tolerance"),
            (["--abs", "10"], "within tolerance"),
            (["--scratch", "1"], "out of scratch memory"),
            (["--steps", "0"], "out of steps"),
        ] {
            let output =
                run([&["closest", arg(&path), arg(&points), "--engine", engine], &options[..]]
                    .concat());
            let note = String::from_utf8_lossy(&output.stderr).into_owned();
            assert!(
                note.starts_with("ended: ") && note.contains(reason),
                "{engine} {options:?} {note}"
            );
            let answers = parse_csv(&String::from_utf8(output.stdout).unwrap(), CLOSEST);
            for (answer, point) in answers.iter().zip(&rows) {
                let truth = distance(wide(point), &mesh);
                assert!(contains(answer, truth), "{engine} {options:?} {answer:?} {truth}");
            }
        }
    }
}

#[test]
fn raw_numbers_csv_and_standard_input_give_the_same_answers() {
    let directory = scratch("raw_and_csv");
    let path = blob(&directory, "torus.ply", &[]);
    let mesh = triangles(&fixture("torus.ply"));
    let (csv, raw) = (directory.join("q.csv"), directory.join("q.f32"));
    let points = random_queries::<3>(&mesh, 40);
    write_csv(&csv, &points);
    write_raw(&raw, &points);
    let by_csv = ok(["closest", arg(&path), arg(&csv)]);
    assert_eq!(by_csv, ok(["closest", arg(&path), arg(&raw)]));
    // Into a file, and from the standard input.
    let out = directory.join("out.csv");
    let mut child = meshsweep()
        .args(["closest", arg(&path), "-", "-o", arg(&out)])
        .stdin(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(&fs::read(&csv).unwrap()).unwrap();
    assert!(child.wait().unwrap().success());
    assert_eq!(by_csv, fs::read_to_string(out).unwrap());
    let segments = random_queries::<6>(&mesh, 40);
    write_csv(&csv, &segments);
    write_raw(&raw, &segments);
    assert_eq!(ok(["segment", arg(&path), arg(&csv)]), ok(["segment", arg(&path), arg(&raw)]));
}

#[test]
fn printed_numbers_round_trip() {
    let directory = scratch("round_trip");
    let path = blob(&directory, "torus.ply", &[]);
    let points = directory.join("p.csv");
    let rows = random_queries::<3>(&triangles(&fixture("torus.ply")), 20);
    write_csv(&points, &rows);
    for (answer, row) in closest(&path, &points, &[]).iter().zip(&rows) {
        let printed: Vec<f32> = answer[..3].iter().map(|field| field.parse().unwrap()).collect();
        assert_eq!(printed, row);
    }
}

#[test]
fn time_is_told_on_the_standard_error_only() {
    let directory = scratch("time");
    let path = blob(&directory, "torus.ply", &[]);
    let points = directory.join("p.csv");
    write_csv(&points, &[[1f32, 2.0, 3.0]; 5]);
    let output = run(["closest", arg(&path), arg(&points), "--time"]);
    assert!(String::from_utf8_lossy(&output.stderr).contains("ns and"));
    assert_eq!(parse_csv(&String::from_utf8(output.stdout).unwrap(), CLOSEST).len(), 5);
    // No query at all is no error.
    fs::write(&points, "x y z\n").unwrap();
    assert!(ok(["closest", arg(&path), arg(&points), "--time"]).lines().count() == 1);
}

#[test]
fn first_hits_are_those_of_brute_force_for_all_engines() {
    let directory = scratch("first_hits");
    let mesh = triangles(&fixture("bracket.stl"));
    let rows = random_queries::<6>(&mesh, 200);
    let segments = directory.join("s.csv");
    write_csv(&segments, &rows);
    let path = blob(&directory, "bracket.stl", &["--for", "segment,hull", "--vertex-bits", "32"]);
    for engine in ["tree", "hull"] {
        let answers =
            parse_csv(&ok(["segment", arg(&path), arg(&segments), "--engine", engine]), SEGMENT);
        assert_eq!(answers.len(), rows.len());
        for (answer, row) in answers.iter().zip(&rows) {
            match first_crossing(wide(&row[..3]), wide(&row[3..]), &mesh) {
                None => assert_eq!(answer[..6], ["no", "", "", "", "", ""], "{engine} {row:?}"),
                Some(t) => {
                    assert_eq!(answer[0], "yes", "{engine} {row:?}");
                    assert!((number(&answer[1]) - t).abs() < 1e-5, "{engine} {answer:?} {t}");
                    assert!(distance([2, 3, 4].map(|k| number(&answer[k])), &mesh) < 1e-3);
                }
            }
        }
    }
}

#[test]
fn on_a_grid_yes_and_no_are_still_those_of_brute_force() {
    let directory = scratch("grid_hits");
    let segments = directory.join("s.csv");
    for name in ["bracket.stl", "torus.ply", "evil/open_box.stl"] {
        let mesh = triangles(&fixture(name));
        let rows = random_queries::<6>(&mesh, 300);
        write_csv(&segments, &rows);
        let path = blob(&directory, name, &[]);
        let answers = parse_csv(&ok(["segment", arg(&path), arg(&segments)]), SEGMENT);
        for (answer, row) in answers.iter().zip(&rows) {
            let truth = first_crossing(wide(&row[..3]), wide(&row[3..]), &mesh);
            match (answer[0].as_str(), truth) {
                ("undecided", None) => {}
                ("undecided", Some(t)) => assert!(number(&answer[1]) <= t, "{answer:?} {t}"),
                (verdict, _) => {
                    assert_eq!(verdict == "yes", truth.is_some(), "{name} {row:?} {answer:?}")
                }
            }
        }
        assert!(answers.iter().filter(|answer| answer[0] == "undecided").count() < 10, "{name}");
    }
}

#[test]
fn facing_culls_the_other_side() {
    let directory = scratch("facing");
    let mesh = triangles(&fixture("torus.ply"));
    let rows = random_queries::<6>(&mesh, 200);
    let segments = directory.join("s.csv");
    write_csv(&segments, &rows);
    let path = blob(&directory, "torus.ply", &["--vertex-bits", "32"]);
    for (facing, sign) in [("front", -1.0), ("back", 1.0)] {
        let text = ok(["segment", arg(&path), arg(&segments), "--facing", facing]);
        let mut hits = 0;
        for (answer, row) in parse_csv(&text, SEGMENT).iter().zip(&rows) {
            let (a, b) = (wide(&row[..3]), wide(&row[3..]));
            let along: Vec<_> =
                mesh.iter().filter(|&&t| sign * ascent(a, b, t) > 0.0).copied().collect();
            let truth = first_crossing(a, b, &along);
            assert_eq!(answer[0] == "yes", truth.is_some(), "{facing} {row:?} {answer:?}");
            assert!(
                truth.is_none_or(|t| (number(&answer[1]) - t).abs() < 1e-5),
                "{facing} {row:?} {answer:?}"
            );
            hits += usize::from(truth.is_some());
        }
        assert!((20..180).contains(&hits), "{facing}");
    }
}

#[test]
fn every_soup_that_is_built_is_answered_rightly() {
    let directory = scratch("soups");
    let (points, segments) = (directory.join("p.csv"), directory.join("s.csv"));
    let mut built = 0;
    for entry in fs::read_dir(fixture("evil")).unwrap() {
        let file = entry.unwrap().path();
        let path = directory.join("soup.msw");
        if !run(["build", arg(&file), "-o", arg(&path)]).status.success() {
            continue;
        }
        built += 1;
        let mesh = triangles(&file);
        let rows = random_queries::<3>(&mesh, 40);
        write_csv(&points, &rows);
        for (answer, point) in closest(&path, &points, &[]).iter().zip(&rows) {
            let truth = distance(wide(point), &mesh);
            assert!(contains(answer, truth), "{} {answer:?} {truth}", file.display());
        }
        let rows = random_queries::<6>(&mesh, 40);
        write_csv(&segments, &rows);
        let answers = parse_csv(&ok(["segment", arg(&path), arg(&segments)]), SEGMENT);
        for (answer, row) in answers.iter().zip(&rows) {
            let truth = first_crossing(wide(&row[..3]), wide(&row[3..]), &mesh);
            let is_right = answer[0] == "undecided" || (answer[0] == "yes") == truth.is_some();
            assert!(is_right, "{} {row:?} {answer:?} {truth:?}", file.display());
        }
    }
    assert!(built > 10, "{built}");
}

#[test]
fn all_hits_begin_with_the_first_and_number_their_query() {
    let directory = scratch("all_hits");
    let mesh = triangles(&fixture("bracket.stl"));
    let rows = random_queries::<6>(&mesh, 100);
    let segments = directory.join("s.csv");
    write_csv(&segments, &rows);
    let path = blob(&directory, "bracket.stl", &["--for", "segment,hull", "--vertex-bits", "32"]);
    for engine in ["tree", "hull"] {
        let ask = ["segment", arg(&path), arg(&segments), "--engine", engine];
        let first = parse_csv(&ok(ask), SEGMENT);
        let all = parse_csv(&ok([&ask[..], &["--all"]].concat()), &format!("query,{SEGMENT}"));
        assert!(all.len() > rows.len());
        for (query, first) in first.iter().enumerate() {
            let hits: Vec<_> = all.iter().filter(|hit| hit[0] == query.to_string()).collect();
            assert_eq!(hits[0][1..7], first[..6], "{engine}");
            assert!(hits.windows(2).all(|pair| number(&pair[0][2]) <= number(&pair[1][2])));
        }
    }
}

#[test]
fn a_segment_with_more_hits_than_the_buffer_gets_them_all() {
    let directory = scratch("many_hits");
    let path = blob(&directory, "bracket.stl", &["--for", "segment,hull", "--vertex-bits", "32"]);
    let segments = directory.join("s.csv");
    // Through a vertex in which some hundred triangles meet.
    fs::write(&segments, "10,10,10,-10,-10,-10\n").unwrap();
    for engine in ["tree", "hull"] {
        let text = ok(["segment", arg(&path), arg(&segments), "--all", "--engine", engine]);
        let all = parse_csv(&text, &format!("query,{SEGMENT}"));
        assert!(all.len() > 64, "{engine} {}", all.len());
    }
}

#[test]
fn a_segment_query_that_ends_early_is_undecided_and_clear_before_its_parameter() {
    let directory = scratch("undecided");
    let mesh = triangles(&fixture("bracket.stl"));
    let rows = random_queries::<6>(&mesh, 100);
    let segments = directory.join("s.csv");
    write_csv(&segments, &rows);
    let path = blob(&directory, "bracket.stl", &["--for", "segment,hull", "--vertex-bits", "32"]);
    for engine in ["tree", "hull"] {
        let ask = ["segment", arg(&path), arg(&segments), "--engine", engine, "--steps", "1"];
        let answers = parse_csv(&ok(ask), SEGMENT);
        let all = parse_csv(&ok([&ask[..], &["--all"]].concat()), &format!("query,{SEGMENT}"));
        let is_undecided = |row: &[String]| row[0] == "undecided";
        assert!(answers.iter().any(|answer| is_undecided(answer)), "{engine}");
        for (query, (answer, row)) in answers.iter().zip(&rows).enumerate() {
            if !is_undecided(answer) {
                continue;
            }
            let truth =
                first_crossing(wide(&row[..3]), wide(&row[3..]), &mesh).unwrap_or(f64::INFINITY);
            let is_clear_before = number(&answer[1]) <= truth * (1.0 + SLACK);
            assert!(is_clear_before && answer[5].is_empty(), "{engine} {answer:?} {truth}");
            // Among all hits a last row says that some may be missing.
            let last = all.iter().rfind(|hit| hit[0] == query.to_string()).unwrap();
            assert!(is_undecided(&last[1..]) && last[6].is_empty(), "{engine} {last:?}");
        }
    }
}

#[test]
fn answers_of_a_cut_blob_contain_those_of_the_whole() {
    let directory = scratch("cut_contains");
    let mesh = triangles(&fixture("torus.ply"));
    let (points, segments) = (directory.join("p.csv"), directory.join("s.csv"));
    write_csv(&points, &random_queries::<3>(&mesh, 60));
    write_csv(&segments, &random_queries::<6>(&mesh, 60));
    let path = hull_blob(&directory, "torus.ply", &[]);
    let cut = directory.join("cut.msw");
    for level in ["0", "1", "2"] {
        ok(["cut", arg(&path), "--level", level, "-o", arg(&cut)]);
        assert!(fs::metadata(&cut).unwrap().len() < fs::metadata(&path).unwrap().len());
        for (coarse, fine) in closest(&cut, &points, &[]).iter().zip(closest(&path, &points, &[])) {
            assert!(number(&coarse[3]) <= number(&fine[3]), "{coarse:?} {fine:?}");
            assert!(number(&fine[4]) <= number(&coarse[4]), "{coarse:?} {fine:?}");
            assert!(coarse[8].is_empty(), "a cut blob names no triangle");
        }
        let coarse = parse_csv(&ok(["segment", arg(&cut), arg(&segments)]), SEGMENT);
        let fine = parse_csv(&ok(["segment", arg(&path), arg(&segments)]), SEGMENT);
        for (coarse, fine) in coarse.iter().zip(fine) {
            match coarse[0].as_str() {
                "no" => assert_eq!(fine[0], "no"),
                "undecided" => assert!(fine[0] == "no" || number(&coarse[1]) <= number(&fine[1])),
                other => panic!("{other}"),
            }
        }
    }
}

#[test]
fn large_and_small_numbers_are_printed_with_exponents() {
    let directory = scratch("short");
    let path = blob(&directory, "torus.ply", &[]);
    let text = ok(["closest", arg(&path), "1e38,-3.4028235e38,1e-40", "20,0.5,-16777216"]);
    let rows = parse_csv(&text, CLOSEST);
    assert_eq!(rows[0][..3], ["1e38", "-3.4028235e38", "1e-40"]);
    assert_eq!(rows[1][..3], ["20", "0.5", "-16777216"]);
    assert!(rows.iter().flatten().all(|field| field.len() <= 18), "{text}");
}

#[test]
fn places_that_are_left_open_among_all_hits_name_their_triangles() {
    let directory = scratch("open_places");
    let path = blob(&directory, "bracket.stl", &[]);
    // Along the diagonal through a vertex in which some hundred triangles meet.
    let text = ok(["segment", arg(&path), "10,10,10,-10,-10,-10", "--all"]);
    let rows = parse_csv(&text, &format!("query,{SEGMENT}"));
    assert!(rows.len() > 10 && rows.iter().all(|row| row[1] == "undecided"), "{text}");
    let mut named: Vec<&str> = rows.iter().map(|row| row[6].as_str()).collect();
    named.sort_unstable();
    named.dedup();
    assert!(named.len() == rows.len() && !named.contains(&""), "each row its own triangle: {text}");
}
