//! `build --for tight` and who asks it: what is said of the mesh by a hull alone is true of the
//! mesh.

use crate::support::{
    Triangle, arg, blob, coarse_torus, distance, fixture, info, number, ok, parse_csv,
    random_queries, refused, run, scratch, triangles, volume, wide, write_csv,
};
use serde_json::Value;
use std::fs;
use std::path::Path;

/// Little polish, faces enough for a quick start.
const TIGHT: [&str; 6] = ["--for", "tight", "--tight", "150,70", "--effort", "0.02"];

fn hulls(info: &Value) -> &Vec<Value> {
    info["tight_hulls"]["hulls"].as_array().expect("there are hulls")
}

#[test]
fn intervals_and_verdicts_by_a_hull_hold_for_the_mesh() {
    let directory = scratch("tight_queries");
    let path = blob(&directory, "torus.ply", &TIGHT);
    let surface = triangles(&fixture("torus.ply"));
    let points: Vec<[f32; 3]> = random_queries(&surface, 300);
    let choices = [&["--tight", "70"][..], &["--tight", "149"], &["--tight", "150"], &[]];
    let widths = choices.map(|choice| {
        let ([yes, no], width) = checked(&path, choice, &surface, &points, 0.5);
        assert!(yes > 10 && no > 10, "{yes} {no}");
        width
    });
    // 149 faces are too few for the finer hull, and it is what is asked unless told otherwise.
    assert!(
        widths[0] == widths[1] && widths[2] == widths[3] && widths[2] < 0.9 * widths[0],
        "{widths:?}"
    );
}

/// Whether lower and upper ends of closest points, and verdicts for a distance, are true of a
/// surface; how many are yes and no, and the sum of the intervals' widths. `choice` names a hull.
fn checked(
    path: &Path,
    choice: &[&str],
    surface: &[Triangle],
    points: &[[f32; 3]],
    distance_of: f64,
) -> ([usize; 2], f64) {
    let file = path.with_extension("csv");
    write_csv(&file, points);
    let rows = parse_csv(
        &ok([&["closest", arg(path), arg(&file)], choice].concat()),
        "x,y,z,lower,upper,px,py,pz,triangle,work",
    );
    let within = ["within", arg(path), arg(&file), "--distance", &distance_of.to_string()];
    let verdicts = parse_csv(&ok([&within, choice].concat()), "x,y,z,within,triangle,work");
    assert_eq!((rows.len(), verdicts.len()), (points.len(), points.len()));
    let (mut counts, mut width) = ([0; 2], 0.0);
    for ((row, verdict), point) in rows.iter().zip(&verdicts).zip(points) {
        let real = distance(wide(point), surface);
        let (lower, upper) = (number(&row[3]), number(&row[4]));
        assert!(
            lower <= real * (1.0 + 1e-6) + 1e-9 && upper >= real * (1.0 - 1e-6) - 1e-9,
            "{row:?} {real}"
        );
        assert!(row[8].is_empty(), "a hull knows no triangles: {row:?}");
        match verdict[3].as_str() {
            "yes" => assert!(real <= distance_of + 1e-6, "{verdict:?} {real}"),
            "no" => assert!(real >= distance_of - 1e-6, "{verdict:?} {real}"),
            other => assert_eq!(other, "undecided"),
        }
        counts[0] += usize::from(verdict[3] == "yes");
        counts[1] += usize::from(verdict[3] == "no");
        width += upper - lower;
    }
    (counts, width)
}

#[test]
fn hulls_of_a_margin_a_slack_and_a_void_tell_the_truth_about_the_mesh() {
    let directory = scratch("tight_goals");
    let mesh = coarse_torus(&directory);
    let surface = triangles(&mesh);
    let solid = volume(&surface);
    let points: Vec<[f32; 3]> = random_queries(&surface, 200);
    let goals: [(&str, &[&str]); 4] = [
        // A margin that is a fraction of the tube's radius is found soon.
        ("margin", &["--margin", "0.05", "--tight", "100,150"]),
        ("slack", &["--slack", "0.4"]),
        ("both", &["--slack", "0.6", "--margin", "0.05"]),
        ("void", &["--void", "30"]),
    ];
    for (name, options) in goals {
        let path = directory.join(format!("{name}.msw"));
        let build = ["build", arg(&mesh), "-o", arg(&path), "--for", "tight", "--effort", "0"];
        let text = ok([&build[..], options].concat());
        let ([yes, no], _) = checked(&path, &[], &surface, &points, 0.75);
        assert!(yes > 5 && no > 5, "{name}: {yes} {no}");
        let blob = info(&path);
        assert_eq!(hulls(&blob).len(), if options.contains(&"--tight") { 2 } else { 1 });
        let keeps = options.contains(&"--margin");
        assert_eq!(text.contains("all points within 0.05 of the mesh are inside"), keeps, "{text}");
        for hull in hulls(&blob) {
            let (slack, out) = (hull["hull_to_mesh"].as_f64().unwrap(), directory.join("hull.ply"));
            ok(["hull", arg(&path), "--tight", &hull["faces"].to_string(), "-o", arg(&out)]);
            let hull_surface = triangles(&out);
            if keeps {
                // From the mesh's side: no vertex of it is nearer to the hull.
                let near = surface.iter().flatten().map(|&p| distance(p, &hull_surface));
                assert!(near.fold(f64::INFINITY, f64::min) >= 0.05, "{name}");
            }
            let far =
                hull_surface.iter().flatten().map(|&p| distance(p, &surface)).fold(0.0, f64::max);
            assert!(far <= slack * (1.0 + 1e-6), "{name}: {far} {slack}");
            if let Some(at) = options.iter().position(|&option| option == "--slack") {
                // Single precision rounds the number up.
                assert!(
                    slack <= options[at + 1].parse::<f64>().unwrap() * (1.0 + 1e-7),
                    "{name}: {slack}"
                );
            }
            if name == "void" {
                assert!(volume(&hull_surface) <= 1.3 * solid);
            }
        }
    }
    let out = directory.join("none.msw");
    let refuse = |options: &[&str], status: i32, named: &str| {
        let build = ["build", arg(&mesh), "-o", arg(&out), "--for", "tight", "--effort", "0"];
        let line = refused(&run([&build[..], options].concat()), status, named);
        assert!(!out.exists());
        line
    };
    assert!(
        refuse(&["--slack", "0.2", "--margin", "0.25"], 2, "--slack 0.2")
            .contains("the margin of 0.25 (")
    );
    // Less than rounding moved the vertices.
    assert!(refuse(&["--slack", "1e-9"], 2, "--slack 1e-9").contains("what rounding may add"));
    let line = refuse(&["--slack", "3e-7"], 1, "coarse.obj");
    assert!(line.contains("a larger slack, or for a number of faces; nothing"), "{line}");
    for pair in [["--slack=1", "--tight=70"], ["--void=9", "--tight=70"], ["--slack=1", "--void=9"]]
    {
        let build = ["build", arg(&mesh), "-o", arg(&out), "--for", "tight"];
        assert_eq!(run([&build[..], &pair].concat()).status.code(), Some(2), "{pair:?}");
    }
}

#[test]
fn a_blob_tells_its_hulls_and_gives_them_back() {
    let directory = scratch("tight_info");
    let path = blob(&directory, "torus.ply", &TIGHT);
    let served = "  serves closest, within without --all, hull --tight, cut\n";
    assert!(ok(["info", arg(&path)]).contains(served));
    let before = info(&path);
    assert_eq!(before["serves"], serde_json::json!(["closest", "within", "hull --tight", "cut"]));
    let faces: Vec<u64> =
        hulls(&before).iter().map(|hull| hull["faces"].as_u64().unwrap()).collect();
    assert_eq!(faces, [70, 150]);
    let solid: f64 = volume(&triangles(&fixture("torus.ply")));
    for hull in hulls(&before) {
        let faces = hull["faces"].as_u64().unwrap().to_string();
        let out = directory.join("hull.ply");
        let text = ok(["hull", arg(&path), "--tight", &faces, "-o", arg(&out)]);
        assert!(text.contains(&format!("{faces} faces")), "{text}");
        let void = volume(&triangles(&out)) / solid - 1.0;
        let printed: f64 =
            text.split(" % void").next().unwrap().rsplit(' ').next().unwrap().parse().unwrap();
        assert!((printed - 100.0 * void).abs() < 1e-2, "{text}");
        assert!((void - hull["void_ratio"].as_f64().unwrap()).abs() < 1e-4, "{void}");
        let slack = hull["hull_to_mesh"].as_f64().unwrap();
        let surface = triangles(&fixture("torus.ply"));
        for corner in triangles(&out).iter().flatten() {
            assert!(distance(*corner, &surface) <= slack * (1.0 + 1e-6));
        }
    }
    let small = directory.join("small.msw");
    let text = ok(["cut", arg(&path), "--tight", "100", "-o", arg(&small)]);
    assert!(text.contains("1 tight hull"), "{text}");
    assert_eq!(hulls(&info(&small)), &hulls(&before)[..1]);
    assert!(fs::metadata(&small).unwrap().len() < fs::metadata(&path).unwrap().len() / 2);
}

#[test]
fn questions_decide_what_is_stored() {
    let directory = scratch("tight_for");
    let (mesh, out) = (fixture("torus.ply"), directory.join("served.msw"));
    let mut arguments =
        [&["build", arg(&mesh), "-o", arg(&out), "--tight-for", "closest"], &TIGHT[..]];
    ok(arguments.concat());
    assert!(hulls(&info(&out)).iter().all(|hull| hull["serves_segments"] == false));
    let segments = ["build", arg(&mesh), "-o", arg(&out), "--tight-for", "segment"];
    arguments[0] = &segments;
    ok(arguments.concat());
    assert!(hulls(&info(&out)).iter().all(|hull| hull["serves_distances"] == false));
    let line = refused(&run(["closest", arg(&out), "1,2,3"]), 1, "served.msw");
    assert!(line.contains("--for"), "{line}");
}

#[test]
fn a_box_tree_is_asked_unless_a_hull_is_named() {
    let directory = scratch("tight_beside");
    let beside = ["--for", "closest,tight", "--tight", "70", "--effort", "0"];
    let path = blob(&directory, "torus.ply", &beside);
    let row = |text: String| parse_csv(&text, "x,y,z,lower,upper,px,py,pz,triangle,work").remove(0);
    let exact = row(ok(["closest", arg(&path), "3,1,2"]));
    assert!(!exact[8].is_empty());
    let by_hull = row(ok(["closest", arg(&path), "3,1,2", "--tight", "70"]));
    assert!(by_hull[8].is_empty() && number(&by_hull[3]) <= number(&exact[4]));
    assert!(number(&by_hull[4]) >= number(&exact[3]));
}

#[test]
fn hulls_that_come_to_no_fewer_faces_are_named() {
    let directory = scratch("tight_left_out");
    let out = directory.join("out.msw");
    // A closed hull has an even number of faces: at most 67 are 66.
    let asked = ["--for", "tight", "--tight", "66,67", "--effort", "0"];
    let text = ok([&["build", arg(&fixture("torus.ply")), "-o", arg(&out)], &asked[..]].concat());
    assert!(text.contains("no tight hull of 66 faces"), "{text}");
    assert_eq!(hulls(&info(&out)).len(), 1);
}

#[test]
fn an_answer_that_a_hull_leaves_open_is_said_to_be_all_that_it_tells() {
    let directory = scratch("tight_note");
    let path = blob(&directory, "torus.ply", &["--for", "tight", "--tight", "70", "--effort", "0"]);
    let note = |arguments: &[&str]| {
        let output = run(arguments);
        assert!(output.status.success());
        String::from_utf8(output.stderr).unwrap()
    };
    let told = note(&["closest", arg(&path), "1,2,3", "4,5,6"]);
    assert!(
        told.starts_with("ended: 2 answered as far as the hull tells") && told.contains("finer"),
        "{told}"
    );
    assert_eq!(note(&["within", arg(&path), "40,5,6", "--distance", "1"]), "");
}

#[test]
fn tables_of_hulls_say_what_is_not_there_and_count_as_people_do() {
    let directory = scratch("tight_tables");
    let (mesh, out) = (directory.join("open.obj"), directory.join("open.msw"));
    fs::write(&mesh, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\n").unwrap();
    let build =
        ["build", arg(&mesh), "-o", arg(&out), "--for", "tight", "--tight", "12", "--effort", "0"];
    let text = ok(build);
    let ply = directory.join("hull.ply");
    let hull = ok(["hull", arg(&out), "--tight", "12", "-o", arg(&ply)]);
    assert!(hull.contains(" faces, at most ") && !hull.contains("void"), "{hull}");
    assert!(text.contains("  the mesh is not closed: 4 boundary edges, as at triangle "), "{text}");
    assert!(text.contains("1 hull: it encloses the mesh"), "{text}");
    assert!(text.contains("hull to mesh, at most  mesh to hull, at most"), "{text}");
    let row = text.lines().skip_while(|line| !line.contains("void %")).nth(1).unwrap();
    assert_eq!(row.split_whitespace().nth(1), Some("-"), "{text}");
    assert!(hulls(&info(&out))[0]["void_ratio"].is_null());
}

#[test]
fn arguments_that_do_not_go_together_are_refused_and_name_the_remedy() {
    let directory = scratch("tight_usage");
    let (mesh, out) = (fixture("torus.ply"), directory.join("out.msw"));
    for option in [
        &["--tight", "50"][..],
        &["--slack", "1"],
        &["--void", "1"],
        &["--margin", "1"],
        &["--effort", "1"],
        &["--tight-for", "closest"],
    ] {
        let output = run([&["build", arg(&mesh), "-o", arg(&out)], option].concat());
        let line = refused(&output, 2, option[0]);
        assert!(line.contains("add tight to --for"), "{line}");
    }
    let many: Vec<String> = (100..133).map(|faces: u32| faces.to_string()).collect();
    let output =
        run(["build", arg(&mesh), "-o", arg(&out), "--for", "tight", "--tight", &many.join(",")]);
    assert!(refused(&output, 2, "--tight").contains("at most 32"));
    assert!(!out.exists());
    let path = blob(&directory, "torus.ply", &["--for", "tight", "--tight", "70", "--effort", "0"]);
    for command in ["closest", "within"] {
        let mut arguments = vec![command, arg(&path), "1,2,3", "--tight", "69"];
        arguments.extend((command == "within").then_some("--distance=1"));
        let line = refused(&run(arguments), 1, "torus.msw");
        assert!(line.contains("the coarsest has 70"), "{line}");
    }
    let ply = directory.join("hull.ply");
    refused(&run(["hull", arg(&path), "-o", arg(&ply)]), 2, "--tight");
    refused(&run(["hull", arg(&mesh), "--tight", "70", "-o", arg(&ply)]), 2, "torus.ply");
    refused(&run(["hull", arg(&path), "--tight", "20", "-o", arg(&ply)]), 1, "torus.msw");
    let questions: [(&[&str], &str); 5] = [
        (&["segment", arg(&path), "0,0,9,0,0,-9"], "segment"),
        (&["signed", arg(&path), "1,2,3"], "closest"),
        (&["nearest", arg(&path), "1,2,3", "-n", "2"], "closest"),
        (&["within", arg(&path), "1,2,3", "--distance=1", "--all"], "closest"),
        (&["overlap", arg(&path), arg(&path)], "segment"),
    ];
    for (arguments, option) in questions {
        let line = refused(&run(arguments), 1, "torus.msw");
        assert!(
            line.contains("serves closest, within without --all, hull --tight, cut; "),
            "{line}"
        );
        assert!(line.contains(&format!("meshsweep build MESH -o BLOB --for {option}")), "{line}");
    }
    let plain = blob(&directory, "groove.obj", &["--for", "closest"]);
    refused(&run(["closest", arg(&plain), "1,2,3", "--tight", "70"]), 1, "groove.msw");
    refused(&run(["cut", arg(&plain), "--tight", "70", "-o", arg(&out)]), 1, "groove.msw");
}
