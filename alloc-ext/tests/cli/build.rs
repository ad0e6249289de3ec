//! `meshsweep build` and `info`, and the program without a command.

use crate::support::{
    Triangle, arg, blob, distance, fixture, fresh_blob, hull_blob, info, number, ok, refused, run,
    scratch, triangles, write_csv,
};
use std::fs;
use std::path::Path;

#[test]
fn without_arguments_it_explains_itself_in_ten_lines_with_numbers() {
    let text = ok::<&str>([]);
    assert!(text.lines().count() <= 12, "{text}");
    assert!(text.contains("Closest point to") && text.contains("First hit"), "{text}");
    assert!(text.contains("cargo run --release -- build part.stl"), "{text}");
    let numbers = text.split("distance ").nth(1).unwrap().split([' ', ',']);
    let numbers: Vec<f64> = numbers.take(3).filter_map(|word| word.parse().ok()).collect();
    let exact = distance([10.0, 4.5, 7.0], &triangles(&fixture("bracket.stl")));
    assert!(numbers[0] <= exact && exact <= numbers[1], "{numbers:?} {exact}");
}

#[test]
fn the_built_in_bracket_is_the_fixture() {
    let copy =
        fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/../src/bin/meshsweep/demo/bracket.stl"))
            .unwrap();
    assert!(copy == fs::read(fixture("bracket.stl")).unwrap());
}

#[test]
fn build_is_deterministic() {
    let directory = scratch("build_is_deterministic");
    let options = ["--for", "closest,segment,hull"];
    let known = fs::read(blob(&directory, "bracket.stl", &options)).unwrap();
    let again = fs::read(fresh_blob(&scratch("build_again"), "bracket.stl", &options)).unwrap();
    assert!(known == again);
}

#[test]
fn build_reports_mesh_sections_memory_and_levels() {
    let directory = scratch("build_reports");
    let (mesh, out) = (fixture("bracket.stl"), directory.join("b.msw"));
    let text = ok(["build", arg(&mesh), "-o", arg(&out), "--for", "closest,segment,hull"]);
    for part in [
        "1948 triangles read",
        "serves closest, within, nearest, field, signed, segment, overlap, clear, clearance, \
         hull --level",
        "source starts",
        "tree fans",
        "total",
        "scratch: ",
        "void %",
        "surface error 0 ",
        "1948 triangles in ",
        "scratch: ",
        "closed: signed distance is that of the nearest surface",
        "half-width of an exact answer: about ",
        " fans of one triangle",
        "collapse",
    ] {
        assert!(text.contains(part), "{part} in {text}");
    }
    assert_eq!(fs::read_dir(&directory).unwrap().count(), 1, "nothing but the blob is left");
}

/// The numbers of `info`'s box: three low, three high.
fn printed_box(blob: &Path) -> [[f64; 3]; 2] {
    let said = ok(["info", arg(blob)]);
    let after = said.split("box ").nth(1).expect("a box");
    let line = after.lines().next().unwrap_or_default().replace(" to ", ", ");
    let numbers: Vec<f64> = line.split(", ").map(|x| x.parse().expect("a number")).collect();
    [0, 3].map(|at| [0, 1, 2].map(|k| numbers[at + k]))
}

#[test]
fn the_box_of_info_contains_the_mesh_as_it_was_read() {
    let directory = scratch("info_box");
    let groove = fixture("groove.obj");
    let moved = directory.join("tenths.obj");
    let text = fs::read_to_string(&groove).unwrap();
    let third = |line: &str| {
        let words = line.split(' ').skip(1).map(|x| x.parse::<f64>().unwrap() / 3.0);
        format!("v{}\n", words.map(|x| format!(" {x}")).collect::<String>())
    };
    let lines = text.lines().map(|line| match line.starts_with("v ") {
        true => third(line),
        false => format!("{line}\n"),
    });
    fs::write(&moved, lines.collect::<String>()).unwrap();
    let of_moved = ["--for", "closest,segment,hull", "--base", "60", "--vertex-bits", "16"];
    let path = directory.join("tenths.msw");
    ok([&["build", arg(&moved), "-o", arg(&path)], &of_moved[..]].concat());
    for (blob, mesh) in [
        (path, moved),
        (fixture("bracket.msw"), fixture("bracket.stl")),
        (fixture("torus.msw"), fixture("torus.ply")),
        (fixture("hulls.msw"), fixture("bracket.stl")),
    ] {
        let json = serde_json::from_value(info(&blob)["input_box"].clone()).expect("a box");
        let boxes: [[[f64; 3]; 2]; 2] = [printed_box(&blob), json];
        for ([low, high], k) in boxes.into_iter().flat_map(|found| [0, 1, 2].map(|k| (found, k))) {
            for x in triangles(&mesh).iter().flatten().map(|p| p[k]) {
                assert!(low[k] <= x && x <= high[k], "{blob:?}: {} {x} {}", low[k], high[k]);
            }
        }
    }
}

#[test]
fn a_blob_holds_what_was_asked_for_and_no_more() {
    let directory = scratch("asked_for");
    let links = ["tree header", "tree links", "tree fans", "tree source numbers"];
    for (questions, more, serves) in [
        (&[][..], &["tree boxes for distances", "tree boxes for segments"][..], "clearance"),
        (&["--for", "closest"], &["tree boxes for distances"], "signed"),
        (&["--for", "segment"], &["tree boxes for segments"], "clearance"),
    ] {
        let info = info(&blob(&directory, "torus.ply", questions));
        let mut wanted: Vec<&str> = links.iter().chain(more).copied().collect();
        let mut found: Vec<&str> = info["sections"]
            .as_array()
            .unwrap()
            .iter()
            .map(|s| s["name"].as_str().unwrap())
            .collect();
        wanted.sort_unstable();
        found.sort_unstable();
        assert_eq!(found, wanted, "{questions:?}");
        assert_eq!(info["serves"].as_array().unwrap().last().unwrap(), serves);
        assert!(info["hull"].is_null());
    }
    let info = info(&hull_blob(&directory, "torus.ply", &[]));
    assert!(info["tree"].is_null() && info["hull"]["levels"].is_array());
    assert!(info["sections"].as_array().unwrap().iter().all(|s| s["hierarchy"] == "hull"));
}

#[test]
fn an_open_mesh_is_built_and_its_report_says_that_it_is_open() {
    let directory = scratch("open_mesh");
    for name in ["evil/open_box.stl", "evil/moebius.obj", "evil/klein_bottle.obj", "evil/flat.obj"]
    {
        let (mesh, out) = (fixture(name), directory.join("out.msw"));
        let text = ok(["build", arg(&mesh), "-o", arg(&out)]);
        let is_open = text.contains("open: every side is undecided");
        // A tetrahedron squashed flat is closed all the same.
        assert_eq!(is_open, name != "evil/flat.obj", "{name} {text}");
        let info = info(&out);
        assert_eq!(info["tree"]["is_closed"], !is_open);
        assert_eq!(info["serves"].as_array().unwrap().iter().any(|s| s == "signed"), !is_open);
    }
}

#[test]
fn build_honours_its_options() {
    let directory = scratch("build_honours_its_options");
    let faces = |options: &[&str]| {
        let info = info(&hull_blob(&directory, "torus.ply", options));
        let hull = &info["hull"];
        (
            hull["base_triangles"].as_u64().unwrap(),
            hull["vertex_format"].as_str().unwrap().to_owned(),
        )
    };
    assert_eq!(faces(&["--base", "400"]).0, 400);
    assert_eq!(faces(&["--vertex-bits", "16"]).1, "16-bit grid");
    assert_eq!(faces(&["--vertex-bits", "24"]).1, "24-bit grid");
    assert_eq!(faces(&["--vertex-bits", "32"]).1, "f32");
    let strict = ["--max-valence", "6", "--compactness", "1", "--max-normal-deviation", "5"];
    assert!(faces(&strict).0 > 400, "strict conditions stop early");
    for (bits, format) in
        [("auto", "16-bit grid"), ("16", "16-bit grid"), ("24", "f32"), ("32", "f32")]
    {
        let info = info(&blob(&directory, "torus.ply", &["--vertex-bits", bits]));
        assert_eq!(info["tree"]["vertex_format"], format);
        assert_eq!(info["tree"]["surface_error"] == 0.0, format == "f32", "{bits}");
    }
}

#[test]
fn a_build_that_stops_early_says_why() {
    let directory = scratch("stops_early");
    let (mesh, out) = (fixture("torus.ply"), directory.join("t.msw"));
    let text = ok(["build", arg(&mesh), "-o", arg(&out), "--for", "hull", "--base", "4"]);
    assert!(text.contains("stopped before 4 faces"), "{text}");
    assert!(
        text.contains("--max-valence, --compactness and --max-normal-deviation relax"),
        "{text}"
    );
}

#[test]
fn json_parses_and_its_sections_fill_the_blob() {
    let directory = scratch("json_parses");
    let path = blob(&directory, "bracket.stl", &["--for", "closest,segment,hull"]);
    let info = info(&path);
    assert_eq!(info["bytes"].as_u64(), Some(fs::metadata(&path).unwrap().len()));
    let sections = info["sections"].as_array().unwrap();
    let end =
        sections.iter().map(|s| s["offset"].as_u64().unwrap() + s["bytes"].as_u64().unwrap()).max();
    assert_eq!(end, info["bytes"].as_u64());
    let (hull, tree) = (&info["hull"], &info["tree"]);
    assert_eq!(hull["surface_triangles"], 1948);
    let levels = hull["levels"].as_array().unwrap();
    assert_eq!(levels[0]["faces"], hull["base_triangles"]);
    assert_eq!(levels.last().unwrap()["faces"], 1948);
    assert_eq!(tree["triangles"], 1948);
    let leaves = tree["leaves"].as_f64().unwrap() * tree["triangles_per_leaf"].as_f64().unwrap();
    assert!((leaves - 1948.0).abs() < 1e-6);
    let sizes = tree["fans_by_size"].as_array().unwrap();
    let sizes: Vec<u64> = sizes.iter().map(|count| count.as_u64().unwrap()).collect();
    assert_eq!(sizes.len(), 8);
    assert_eq!((1..).zip(&sizes).map(|(size, count)| size * count).sum::<u64>(), 1948);
    let fans: u64 = sizes.iter().sum();
    assert_eq!(
        (tree["fans"].as_u64(), tree["single_triangle_fans"].as_u64()),
        (Some(fans), Some(sizes[0]))
    );
    assert!((tree["triangles_per_fan"].as_f64().unwrap() - 1948.0 / fans as f64).abs() < 1e-9);
    // A leaf is one or two fans.
    let leaf_count = tree["leaves"].as_u64().unwrap();
    assert!((leaf_count..=2 * leaf_count).contains(&fans));
    assert_eq!(tree["triangles_without_area"], 0);
    // Every node but the root is a child, and so is every leaf.
    let nodes = tree["nodes"].as_f64().unwrap();
    let children = nodes - 1.0 + tree["leaves"].as_f64().unwrap();
    assert!((nodes * tree["children_per_node"].as_f64().unwrap() - children).abs() < 1e-6);
}

#[test]
fn info_for_people_names_every_section() {
    let directory = scratch("info_for_people");
    let text = ok(["info", arg(&hull_blob(&directory, "groove.obj", &[]))]);
    for section in ["vertices", "splits", "source starts", "levels", "source numbers"] {
        assert!(text.contains(section), "{section} in {text}");
    }
    let text = ok(["info", arg(&blob(&directory, "groove.obj", &[]))]);
    for section in ["tree header", "tree links", "tree boxes for segments", "tree fans", "depth"] {
        assert!(text.contains(section), "{section} in {text}");
    }
    assert!(!text.contains("levels"), "{text}");
}

#[test]
fn every_evil_fixture_is_built_or_refused_in_one_line_and_leaves_nothing_behind() {
    let directory = scratch("every_evil_fixture");
    for entry in fs::read_dir(fixture("evil")).unwrap() {
        let mesh = entry.unwrap().path();
        let out = directory.join("out.msw");
        let by = |questions| {
            let output = run(["build", arg(&mesh), "-o", arg(&out), "--for", questions]);
            if output.status.success() {
                fs::remove_file(&out).unwrap();
            } else {
                refused(&output, 1, mesh.file_name().unwrap().to_str().unwrap());
            }
            assert_eq!(fs::read_dir(&directory).unwrap().count(), 0, "{}", mesh.display());
            output.status.success()
        };
        let (hull, tree) = (by("hull"), by("closest,segment"));
        assert!(tree || !hull, "{}: a tree is built of whatever a hull is", mesh.display());
    }
}

#[test]
fn the_half_width_that_is_promised_is_that_of_the_answers() {
    let directory = scratch("half_width");
    let mesh = triangles(&fixture("bracket.stl"));
    let middle = |t: &Triangle| -> [f64; 3] {
        core::array::from_fn(|k| (t[0][k] + t[1][k] + t[2][k]) / 3.0)
    };
    let points = directory.join("p.csv");
    for bits in ["16", "32"] {
        let path = blob(&directory, "bracket.stl", &["--vertex-bits", bits]);
        let tree = &info(&path)["tree"];
        let said = |key: &str| tree[key].as_f64().unwrap();
        let [near, far] = [said("half_width_near"), said("half_width_one_diagonal_away")];
        let low: [f64; 3] = core::array::from_fn(|k| {
            mesh.iter().flatten().map(|p| p[k]).fold(f64::INFINITY, f64::min)
        });
        let high: [f64; 3] = core::array::from_fn(|k| {
            mesh.iter().flatten().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max)
        });
        let diagonal = (0..3).map(|k| (high[k] - low[k]).powi(2)).sum::<f64>().sqrt();
        // Off the surface by a few of these widths, and a diagonal off the box.
        let at = |off: f64| {
            mesh.iter().step_by(10).map(|t| middle(t).map(|x| (x + off) as f32)).collect::<Vec<_>>()
        };
        let aside = [[high[0] + diagonal, low[1], low[2]], [low[0], high[1] + diagonal, high[2]]];
        let aside = aside.map(|p| p.map(|x| x as f32));
        for (rows, promised) in [(at(0.1), near), (aside.to_vec(), far)] {
            write_csv(&points, &rows);
            let text = ok(["closest", arg(&path), arg(&points)]);
            let mut widths: Vec<f64> = text
                .lines()
                .skip(1)
                .map(|line| line.split(',').map(number).collect::<Vec<_>>())
                .map(|row| (row[4] - row[3]) / 2.0)
                .collect();
            widths.sort_by(f64::total_cmp);
            let median = widths[widths.len() / 2];
            assert!((0.4..2.5).contains(&(median / promised)), "{bits} {median} {promised}");
        }
    }
}

#[test]
fn an_open_mesh_is_built_for_sweeps_and_its_levels_are_no_hulls() {
    let directory = scratch("build_for_sweep");
    let (mesh, out) = (directory.join("open.obj"), directory.join("open.msw"));
    let text = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 1 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\n";
    fs::write(&mesh, text).unwrap();
    let refusal = run(["build", arg(&mesh), "-o", arg(&out), "--for", "hull"]);
    let refusal = String::from_utf8(refusal.stderr).unwrap();
    assert!(refusal.contains("not closed") && refusal.contains("--for sweep"), "{refusal}");
    assert!(!out.exists());
    let report = ok(["build", arg(&mesh), "-o", arg(&out), "--for", "sweep", "--base", "4"]);
    for part in [
        "no hulls, distances and segments only: 1 hole, 0 copied vertices",
        "serves closest, segment, overlap, refine, cut",
        "hull hierarchy, for sweeps only: its levels enclose nothing",
    ] {
        assert!(report.contains(part), "{part} in {report}");
    }
    assert_eq!(info(&out)["hull"]["encloses"], false);
    let near = ok(["closest", arg(&out), "1,-3,0"]);
    let near: Vec<f64> = near.lines().nth(1).unwrap().split(',').map(number).collect();
    assert!(near[3] <= 3.0 && 3.0 <= near[4] && near[4] - near[3] < 1e-5, "{near:?}");
    let hits = ok(["segment", arg(&out), "1,0.5,2,1,0.5,-2", "0.5,1,2,0.5,1,-2"]);
    let hits: Vec<&str> = hits.lines().skip(1).map(|line| &line[..2]).collect();
    assert_eq!(hits, ["ye", "no"]);
    let drawn = directory.join("level.ply");
    let refused_level = run(["hull", arg(&out), "--level", "0", "-o", arg(&drawn)]);
    let line = refused(&refused_level, 1, "open.msw");
    assert!(line.contains("no hulls") && line.contains("closed mesh"), "{line}");
    let refined = ok(["refine", arg(&out), "-o", arg(&drawn), "--error", "1e-6"]);
    assert!(refined.contains("3 faces of 3"), "{refined}");
}

#[test]
fn a_mesh_too_far_from_its_origin_for_the_grid_is_stored_as_f32_and_the_report_says_so() {
    let directory = scratch("far");
    let (near, far) = (directory.join("near.obj"), directory.join("far.obj"));
    let tetrahedron = |x: f64| {
        let at = [[0.0, 0.0, 0.3], [1.0, 0.1, 0.0], [0.0, 1.0, 0.0], [0.2, 0.3, 0.9]];
        let vertices: Vec<_> =
            at.iter().map(|p| format!("v {} {} {}\n", p[0] + x, p[1], p[2])).collect();
        vertices.concat() + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"
    };
    fs::write(&near, tetrahedron(0.0)).expect("a file");
    fs::write(&far, tetrahedron(10_000.0)).expect("a file");
    let said = "too far from its origin for the box tree's grid";
    for (mesh, bits, is_said) in
        [(&near, "auto", false), (&far, "auto", true), (&far, "16", false), (&far, "32", false)]
    {
        let blob = directory.join("far.msw");
        let [mesh, blob] = [mesh, &blob].map(|path| path.to_str().expect("UTF-8"));
        let report = ok(["build", mesh, "-o", blob, "--vertex-bits", bits]);
        assert_eq!(report.contains(said), is_said, "{bits}: {report}");
        assert_eq!(report.contains("coordinates: f32"), is_said || bits == "32", "{report}");
    }
}
