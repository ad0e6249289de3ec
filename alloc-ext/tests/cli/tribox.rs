//! `meshsweep tribox`: what is printed is true of what is written, and what is written holds the
//! mesh.

use crate::support::{
    Point, Triangle, arg, cross, distance, dot, fixture, info, ok, refused, run, scratch,
    triangles, volume,
};
use serde_json::Value;
use std::fs;
use std::path::Path;

fn json(mesh: &Path, options: &[&str]) -> Value {
    let text = ok([&["tribox", arg(mesh), "--json"], options].concat());
    serde_json::from_str(&text).expect("it is JSON")
}

fn numbers(levels: &Value, key: &str) -> Vec<f64> {
    let levels = levels["levels"].as_array().expect("there are levels");
    levels.iter().map(|level| level[key].as_f64().expect("a number")).collect()
}

/// Winding number, by solid angles.
fn winding(p: Point, triangles: &[Triangle]) -> f64 {
    let angle = |corners: &Triangle| {
        let [a, b, c]: Triangle = corners.map(|v| core::array::from_fn(|k| v[k] - p[k]));
        let [la, lb, lc] = [a, b, c].map(|v| dot(v, v).sqrt());
        2.0 * dot(a, cross(b, c))
            .atan2(la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb)
    };
    triangles.iter().map(angle).sum::<f64>() / (4.0 * std::f64::consts::PI)
}

#[test]
fn levels_double_and_hold_ever_less_void() {
    // The large one to fewer levels, which take most of the time.
    for (name, levels) in [("bracket.stl", "3"), ("torus.ply", "5"), ("groove.obj", "6")] {
        let report = json(&fixture(name), &["--levels", levels]);
        assert_eq!(report["is_closed"], true);
        let solid = report["volume"].as_f64().unwrap();
        let (counts, volumes) = (numbers(&report, "triboxes"), numbers(&report, "volume"));
        let doubled = [1.0, 2.0, 4.0, 8.0, 16.0];
        let whole = counts.len().min(doubled.len());
        assert_eq!(counts[..whole], doubled[..whole], "{name}");
        assert!(whole >= 3, "{name}");
        assert!(volumes.windows(2).all(|w| w[1] <= w[0] * (1.0 + 1e-5)), "{name}: {volumes:?}");
        assert!(volumes.iter().all(|&volume| volume >= solid * (1.0 - 1e-9)));
        for (void, volume) in numbers(&report, "void_ratio").iter().zip(&volumes) {
            assert!((void - (volume / solid - 1.0)).abs() < 1e-9);
        }
        let mesh = report["triangles"].as_f64().unwrap();
        for (compression, faces) in
            numbers(&report, "compression").iter().zip(numbers(&report, "faces"))
        {
            assert!((compression - mesh / faces).abs() < 1e-9);
        }
    }
}

#[test]
fn what_is_written_holds_the_mesh_and_has_the_volume_that_is_printed() {
    let directory = scratch("tribox_written");
    let out = directory.join("proxy.ply");
    for (name, levels, simplify) in
        [("bracket.stl", "3", "0"), ("torus.ply", "4", "0.05"), ("groove.obj", "4", "0")]
    {
        let mesh = fixture(name);
        let report = json(&mesh, &["--levels", levels, "--simplify", simplify, "-o", arg(&out)]);
        let written = triangles(&out);
        let last = *numbers(&report, "volume").last().unwrap();
        assert!((volume(&written) / last - 1.0).abs() < 1e-6, "{name}");
        assert!(fs::read(&out).unwrap().starts_with(b"ply\nformat binary_little_endian 1.0\n"));
        for corners in triangles(&mesh).iter().step_by(7) {
            let centre: Point =
                core::array::from_fn(|k| corners.iter().map(|p| p[k]).sum::<f64>() / 3.0);
            let is_held = winding(centre, &written) > 0.9 || distance(centre, &written) < 1e-5;
            assert!(is_held, "{name}: {centre:?}");
        }
    }
}

#[test]
fn the_largest_distance_is_that_of_the_sampled_boundary() {
    let directory = scratch("tribox_distance");
    let out = directory.join("proxy.ply");
    let mesh = fixture("torus.ply");
    let report = json(&mesh, &["--levels", "1", "-o", arg(&out)]);
    let surface = triangles(&mesh);
    let sampled =
        triangles(&out).iter().flatten().map(|&p| distance(p, &surface)).fold(0.0, f64::max);
    let bounds = &report["levels"][0]["distance"];
    let (lower, upper) = (bounds["lower"].as_f64().unwrap(), bounds["upper"].as_f64().unwrap());
    assert!(
        lower <= upper && upper <= 1.06 * lower && sampled <= upper,
        "{lower} {sampled} {upper}"
    );
}

#[test]
fn the_table_has_a_row_for_each_level() {
    let text = ok(["tribox", arg(&fixture("torus.ply")), "--levels", "3"]);
    let rows = || text.lines().filter(|line| line.starts_with(' '));
    assert_eq!(rows().count(), 3, "{text}");
    assert!(text.contains("2304 triangles, closed, volume 21.89"), "{text}");
    assert!(text.contains("triboxes") && text.contains("void %"), "{text}");
}

#[test]
fn an_open_mesh_says_so_and_has_no_void() {
    let directory = scratch("tribox_open");
    let mesh = directory.join("open.obj");
    fs::write(&mesh, "v 0 0 0\nv 3 0 0\nv 0 2 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n").unwrap();
    let text = ok(["tribox", arg(&mesh), "--levels", "3"]);
    assert!(text.contains("not closed") && text.contains("surface"), "{text}");
    let report = json(&mesh, &["--levels", "3"]);
    assert_eq!(report["is_closed"], false);
    assert!(report["volume"].is_null() && report["levels"][0]["void_ratio"].is_null());
}

#[test]
fn a_mesh_without_area_has_no_compression() {
    let mesh = scratch("tribox_line").join("line.obj");
    fs::write(&mesh, "v 0 0 0\nv 1 0 0\nf 1 2 2\n").unwrap();
    let text = ok(["tribox", arg(&mesh)]);
    assert!(!text.contains("NaN"), "{text}");
    assert!(json(&mesh, &[])["levels"][0]["compression"].is_null());
}

#[test]
fn splitting_ends_where_it_saves_nothing_and_says_so() {
    let directory = scratch("tribox_exhausted");
    let mesh = directory.join("flat.obj");
    fs::write(&mesh, "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n").unwrap();
    let text = ok(["tribox", arg(&mesh)]);
    assert!(text.contains("no further split saves enough area"), "{text}");
    let report = json(&mesh, &[]);
    assert_eq!(
        (numbers(&report, "triboxes"), &report["is_exhausted"]),
        (vec![1.0], &Value::Bool(true))
    );
}

/// What an option gained: number of triboxes, faces, area and void before and after.
fn gained(report: &Value, option: &str) -> (bool, [[f64; 4]; 2]) {
    let gains = report["gains"].as_array().expect("there are gains");
    let gain = gains.iter().find(|gain| gain["option"] == option).expect("the option's");
    let keys = ["triboxes", "faces", "area", "void_ratio"];
    let total = |of: &str| keys.map(|key| gain[of][key].as_f64().expect("a number"));
    (gain["is_gain"].as_bool().unwrap(), ["before", "after"].map(total))
}

/// Faces and void of the finest level.
fn finest(report: &Value) -> [f64; 2] {
    ["faces", "void_ratio"].map(|key| *numbers(report, key).last().unwrap())
}

#[test]
fn turned_triboxes_enclose_the_mesh_where_it_lies_and_the_report_says_what_turning_gained() {
    let directory = scratch("tribox_turned");
    let (mesh, out) = (crate::triboxes::askew(&directory), directory.join("proxy.ply"));
    let plain = json(&mesh, &["--levels", "1"]);
    let turned = json(&mesh, &["--levels", "1", "--orient", "volume", "-o", arg(&out)]);
    assert!(plain["orientation"].is_null() && plain["gains"].as_array().unwrap().is_empty());
    assert_eq!(turned["orientation"].as_array().map(Vec::len), Some(3));
    let (is_gain, [before, after]) = gained(&turned, "--orient volume");
    assert!(is_gain && after[3] < 0.01 && before[3] > 0.1, "{before:?} {after:?}");
    assert_eq!([before[1], before[3]], finest(&plain));
    assert_eq!([after[1], after[3]], finest(&turned));
    let written = triangles(&out);
    // Each corner of the mesh is inside, not on the surface: there the number is a half.
    for p in triangles(&mesh).into_iter().flatten() {
        assert!((winding(p, &written) - 1.0).abs() < 1e-6, "{p:?}: {}", winding(p, &written));
    }
    assert!((volume(&written) / 8.0 - 1.0).abs() < 0.01);
    let bounds = &turned["levels"][0]["distance"];
    let surface = triangles(&mesh);
    let sampled = written.iter().flatten().map(|&p| distance(p, &surface)).fold(0.0, f64::max);
    assert!(sampled <= bounds["upper"].as_f64().unwrap(), "{sampled} {bounds}");
    assert!(bounds["lower"].as_f64().unwrap() <= bounds["upper"].as_f64().unwrap());
    let text = ok(["tribox", arg(&mesh), "--levels", "1", "--orient", "volume"]);
    assert!(text.contains("gained by --orient volume: void "), "{text}");
    assert!(text.contains("turned by the rotation"), "{text}");
}

#[test]
fn what_extrema_gain_is_the_difference_of_two_runs() {
    let mesh = fixture("groove.obj");
    let [plain, tried] =
        [&[][..], &["--extrema"]].map(|more| json(&mesh, &[&["--levels", "4"], more].concat()));
    let (is_gain, [before, after]) = gained(&tried, "--extrema");
    assert!(is_gain && after[3] < before[3], "{before:?} {after:?}");
    assert_eq!([before[1], before[3]], finest(&plain));
    assert_eq!([after[1], after[3]], finest(&tried));
    let both = json(&mesh, &["--levels", "4", "--extrema", "--orient", "area"]);
    assert_eq!(gained(&both, "--extrema"), (is_gain, [before, after]));
}

#[test]
fn an_option_that_gains_nothing_says_so() {
    let mesh = scratch("tribox_no_gain").join("cube.obj");
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n\
                f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
    fs::write(&mesh, text).unwrap();
    let text = ok(["tribox", arg(&mesh), "--orient", "volume", "--extrema"]);
    assert!(text.contains("nothing gained by --extrema: void 0.000 % before, 0.000 %"), "{text}");
    assert!(text.contains("nothing gained by --orient volume: no turn was found"), "{text}");
    assert!(!text.contains("turned by the rotation"), "{text}");
    let report = json(&mesh, &["--orient", "volume"]);
    assert_eq!(report["gains"][0]["is_gain"], false);
    assert!(report["gains"][0]["after"].is_null() && report["orientation"].is_null());
}

#[test]
fn triboxes_are_split_until_the_error_is_reached_or_the_report_says_that_it_is_not() {
    let mesh = fixture("torus.ply");
    let report = json(&mesh, &["--tribox-error", "0.8"]);
    let errors = numbers(&report, "hull_error");
    let (last, coarser) = errors.split_last().unwrap();
    assert!(*last <= 0.8 && coarser.iter().all(|&error| error > 0.8), "{errors:?}");
    let reached = "each tribox is within 0.8 of the convex hull of what it holds";
    assert!(ok(["tribox", arg(&mesh), "--tribox-error", "0.8"]).contains(reached));
    let text = ok(["tribox", arg(&mesh), "--tribox-error", "0.01", "--levels", "2"]);
    assert!(text.contains("more than 0.01: more --levels may come nearer"), "{text}");
}

#[test]
fn answers_do_not_change() {
    let directory = scratch("tribox_same");
    let (one, two) = (directory.join("1.ply"), directory.join("2.ply"));
    let mesh = fixture("groove.obj");
    for out in [&one, &two] {
        ok(["tribox", arg(&mesh), "--levels", "4", "-o", arg(out)]);
    }
    assert!(fs::read(&one).unwrap() == fs::read(&two).unwrap());
}

#[test]
fn wrong_usage_is_refused_before_anything_is_written() {
    let directory = scratch("tribox_usage");
    let mesh = fixture("torus.ply");
    let stl = directory.join("proxy.stl");
    refused(&run(["tribox", arg(&mesh), "-o", arg(&stl)]), 2, "proxy.stl");
    for wrong in [["--levels", "0"], ["--levels", "13"], ["--simplify", "-1"]] {
        assert_eq!(
            run([&["tribox", arg(&mesh)], &wrong[..]].concat()).status.code(),
            Some(2),
            "{wrong:?}"
        );
    }
    let copy = directory.join("same.ply");
    fs::copy(&mesh, &copy).unwrap();
    refused(&run(["tribox", arg(&copy), "-o", arg(&copy)]), 1, "same.ply");
    assert!(!stl.exists());
}

#[test]
fn coordinates_beyond_what_triboxes_hold_are_refused_by_name() {
    let directory = scratch("tribox_huge");
    let mesh = directory.join("huge.obj");
    fs::write(&mesh, "v 0 0 0\nv 2e37 0 0\nv 0 2e37 0\nf 1 2 3\n").unwrap();
    let line = refused(&run(["tribox", arg(&mesh)]), 1, "huge.obj");
    assert!(line.contains("2^120") && line.contains("unit"), "{line}");
    for scale in ["e-30", "e30"] {
        let mesh = directory.join(format!("scaled{scale}.obj"));
        let text = "v 1 1 1\nv 2 1 1\nv 1 2 1\nv 1 1 2\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
        let text = text.replace("1 1 1\n", "1# 1# 1#\n").replace('#', scale);
        let text = text.replace("v 2 1 1", &format!("v 2{scale} 1{scale} 1{scale}"));
        let text = text.replace("v 1 2 1", &format!("v 1{scale} 2{scale} 1{scale}"));
        let text = text.replace("v 1 1 2", &format!("v 1{scale} 1{scale} 2{scale}"));
        fs::write(&mesh, text).unwrap();
        assert_eq!(json(&mesh, &["--levels", "3"])["is_closed"], true);
    }
}

#[test]
fn a_blob_of_triboxes_holds_what_the_command_prints() {
    let directory = scratch("tribox_blob");
    let blob = directory.join("torus.msw");
    let text = ok([
        "build",
        arg(&fixture("torus.ply")),
        "--for",
        "triboxes",
        "--triboxes",
        "16",
        "-o",
        arg(&blob),
    ]);
    assert!(
        text.contains(
            "serves closest --triboxes, within --triboxes, segment --triboxes, \
             overlap --triboxes, clearance --triboxes, cut"
        ) && text.contains("31 nodes of 16 leaves"),
        "{text}"
    );
    let stored = info(&blob);
    assert_eq!((&stored["hull"], &stored["tree"]), (&Value::Null, &Value::Null));
    let stored = &stored["triboxes"];
    assert_eq!((&stored["is_solid"], &stored["leaves"]), (&Value::Bool(true), &Value::from(16)));
    assert_eq!(numbers(stored, "triboxes"), [1.0, 2.0, 4.0, 8.0, 16.0]);
    // On a coarser grid than what the command writes, so a little larger.
    let printed = json(&fixture("torus.ply"), &["--levels", "5"]);
    for (there, here) in numbers(stored, "void_ratio").iter().zip(numbers(&printed, "void_ratio")) {
        assert!((there - here).abs() < 3e-3, "{there} {here}");
    }
    for (there, levels) in
        numbers(stored, "distance").iter().zip(printed["levels"].as_array().unwrap())
    {
        let lower = levels["distance"]["lower"].as_f64().unwrap();
        assert!(*there >= lower && *there < lower * 1.07, "{there} {lower}");
    }
}

#[test]
fn triboxes_are_cut_alone_or_with_the_hull_and_stay_else() {
    let directory = scratch("tribox_cut");
    let [blob, cut] = ["all.msw", "cut.msw"].map(|name| directory.join(name));
    let questions = ["--for", "closest,hull,triboxes", "--triboxes", "8", "--base", "60"];
    ok([&["build", arg(&fixture("groove.obj")), "-o", arg(&blob)], questions.as_slice()].concat());
    let whole = info(&blob);
    let leaves = |blob: &Value| blob["triboxes"]["leaves"].as_u64().expect("there are some");
    let count = leaves(&whole);
    assert!(count > 2 && whole["tree"].is_object());
    let text = ok(["cut", arg(&blob), "--triboxes", "2", "-o", arg(&cut)]);
    assert!(text.contains("2 triboxes"), "{text}");
    let left = info(&cut);
    assert_eq!((leaves(&left), &left["tree"], &left["hull"]), (2, &whole["tree"], &whole["hull"]));
    ok(["cut", arg(&blob), "--level", "0", "-o", arg(&cut)]);
    assert_eq!((leaves(&info(&cut)), &info(&cut)["tree"]), (count, &Value::Null));
    ok(["cut", arg(&blob), "--level", "0", "--triboxes", "1", "-o", arg(&cut)]);
    assert_eq!(leaves(&info(&cut)), 1);
    assert_eq!(
        run(["cut", arg(&blob), "-o", arg(&cut)]).status.code(),
        Some(2),
        "nothing to cut is named"
    );
    let plain = directory.join("plain.msw");
    ok(["build", arg(&fixture("groove.obj")), "-o", arg(&plain)]);
    refused(&run(["cut", arg(&plain), "--triboxes", "2", "-o", arg(&cut)]), 1, "--for triboxes");
    let mesh = fixture("groove.obj");
    let stray = ["build", arg(&mesh), "--triboxes", "2", "-o", arg(&plain)];
    refused(&run(stray), 2, "add triboxes to --for");
    for (option, wanted) in
        [("--levels", "a whole number from 1 to 12"), ("--simplify", "a number from 0")]
    {
        let output = run(["tribox", arg(&mesh), option, "-1"]);
        let text = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.code() == Some(2) && text.contains(wanted), "{text}");
    }
}
