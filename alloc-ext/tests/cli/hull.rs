//! `meshsweep hull` and `cut`: what is written is a closed hull, a blob, and whole.

use crate::support::{
    arg, blob, coarse_torus, fixture, hull_blob, info, ok, refused, run, scratch, volume,
};
use meshsweep::mesh;
use std::fs;
use std::path::Path;

/// Faces and volume of a closed mesh file.
fn closed(path: &Path) -> (usize, f64) {
    let (mesh, _) = mesh::load_closed(path).expect("a hull is closed");
    let at = |v: u32| mesh.positions[v as usize].map(f64::from);
    let triangles: Vec<_> = mesh.triangles.iter().map(|t| t.map(at)).collect();
    (triangles.len(), volume(&triangles))
}

/// Two tetrahedra.
const SOLIDS: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\n\
    f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\nf 5 7 6\nf 5 6 8\nf 6 7 8\nf 7 5 8\n";

/// The percentage that a line of output names.
fn void_percent(text: &str) -> f64 {
    text.split(" % void").next().unwrap().rsplit(' ').next().unwrap().parse().unwrap()
}

#[test]
fn a_progressive_hull_has_the_faces_and_the_void_that_are_printed() {
    let directory = scratch("hull_of_mesh");
    let out = directory.join("hull.ply");
    for name in ["bracket.stl", "torus.ply", "groove.obj"] {
        let mesh = fixture(name);
        let text = ok(["hull", arg(&mesh), "--progressive", "--faces", "150", "-o", arg(&out)]);
        let (faces, volume) = closed(&out);
        assert!(text.contains(&format!(": {faces} faces, ")), "{text}");
        assert!(faces <= 150, "{text}");
        let (_, solid) = closed(&mesh);
        let void = (volume / solid - 1.0) * 100.0;
        assert!(void >= -1e-6 && (void - void_percent(&text)).abs() < 1e-2, "{void} {text}");
        let bytes = fs::read(&out).unwrap();
        assert!(bytes.starts_with(b"ply\nformat binary_little_endian 1.0\n"));
    }
}

#[test]
fn a_progressive_hull_that_stops_early_says_why() {
    let directory = scratch("hull_stuck");
    let (mesh, out) = (fixture("bracket.stl"), directory.join("hull.ply"));
    let text = ok(["hull", arg(&mesh), "--progressive", "--faces", "4", "-o", arg(&out)]);
    assert!(text.contains("stopped before 4 faces"), "{text}");
    closed(&out);
}

#[test]
fn a_tight_hull_has_the_faces_and_the_void_that_are_printed_and_hardly_more_than_a_progressive_one()
{
    let directory = scratch("tight_hull");
    let (tight, progressive) = (directory.join("tight.ply"), directory.join("progressive.ply"));
    for name in ["bracket.stl", "torus.ply", "groove.obj"] {
        let mesh = fixture(name);
        let text = ok(["hull", arg(&mesh), "--faces", "100", "--effort", "0.1", "-o", arg(&tight)]);
        let (faces, volume) = closed(&tight);
        assert!(text.contains(&format!(": {faces} faces, ")) && faces <= 100, "{text}");
        let (_, solid) = closed(&mesh);
        let void = (volume / solid - 1.0) * 100.0;
        assert!(void > 0.0 && (void - void_percent(&text)).abs() < 1e-2, "{void} {text}");
        ok(["hull", arg(&mesh), "--progressive", "--faces", "100", "-o", arg(&progressive)]);
        // A progressive hull may be the solid itself. A tight hull may not touch it.
        assert!(volume <= closed(&progressive).1 * (1.0 + 1e-3), "{name}");
    }
}

#[test]
fn a_slack_and_a_void_are_kept_and_printed() {
    let directory = scratch("hull_slack");
    let (mesh, out) = (coarse_torus(&directory), directory.join("hull.ply"));
    let text = ok(["hull", arg(&mesh), "--slack", "0.4", "--effort", "0", "-o", arg(&out)]);
    let most: f64 =
        text.split("at most ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap();
    assert!(most <= 0.4, "{text}");
    let text = ok(["hull", arg(&mesh), "--void", "30%", "--effort", "0", "-o", arg(&out)]);
    assert!(void_percent(&text) <= 30.0, "{text}");
}

#[test]
fn a_hull_that_is_looser_than_asked_for_is_not_written_and_the_tightest_is_named() {
    let directory = scratch("hull_unmet");
    let (mesh, out) = (fixture("groove.obj"), directory.join("hull.ply"));
    let refuse = |options: &[&str]| {
        let output =
            run([&["hull", arg(&mesh), "--effort", "0", "-o", arg(&out)], options].concat());
        let line = refused(&output, 1, "groove.obj");
        assert!(
            !out.exists() && line.contains(" faces; ") && line.contains("a number of faces"),
            "{line}"
        );
        line
    };
    let after = |line: &str, words: &str| -> f64 {
        line.split(words).nth(1).unwrap().split([' ', ',']).next().unwrap().parse().unwrap()
    };
    let line = refuse(&["--void", "0.000001"]);
    assert!(
        line.contains(" left 0.000001 % void space") || line.contains(" left 1e-6 % void space"),
        "{line}"
    );
    assert!(
        line.contains("ask for a larger void") && after(&line, "tightest leaves ") > 1e-6,
        "{line}"
    );
    let line = refuse(&["--slack", "1e-8"]);
    assert!(line.contains("within 1e-8 of the mesh") && line.contains("a larger slack"), "{line}");
    assert!(after(&line, "tightest is within ") > 1e-8, "{line}");
    let line = refuse(&["--slack", "1e-5", "--seconds", "1e-3"]);
    assert!(line.contains("the time was up") && line.contains("more --seconds"), "{line}");
    // Each part has a goal of its own.
    let two = directory.join("two.obj");
    fs::write(&two, SOLIDS).unwrap();
    let output =
        run(["hull", arg(&two), "--parts", "--slack", "1e-30", "--effort", "0", "-o", arg(&out)]);
    assert!(refused(&output, 1, "two.obj").contains("part 0: no hull"));
    assert!(!out.exists());
}

#[test]
fn lengths_that_were_measured_have_few_digits() {
    let directory = scratch("hull_digits");
    let out = directory.join("hull.ply");
    let text =
        ok(["hull", arg(&fixture("torus.ply")), "--faces", "80", "--effort", "0", "-o", arg(&out)]);
    for words in ["at most ", "at least "] {
        let length = text.split(words).nth(1).unwrap().split([' ', ',']).next().unwrap();
        assert!(length.parse::<f64>().unwrap() > 0.0 && length.len() <= 8, "{text}");
    }
    // Next to no volume, and next to nothing beyond it.
    let plate = directory.join("plate.obj");
    fs::write(
        &plate,
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1e-30\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n",
    )
    .unwrap();
    for (mesh, ratio) in [(plate, 1e15..1e40), (fixture("groove.obj"), 1e-9..1e-3)] {
        let text = ok(["hull", arg(&mesh), "--faces", "100", "--effort", "0", "-o", arg(&out)]);
        let void = text.split(" % void").next().unwrap().rsplit(' ').next().unwrap();
        assert!(ratio.contains(&void_percent(&text)) && void.len() <= 11, "{text}");
    }
}

#[test]
fn a_margin_is_printed_and_left_around_the_mesh() {
    let directory = scratch("hull_margin");
    let (mesh, out) = (directory.join("box.obj"), directory.join("hull.ply"));
    // A cube of edge 2, a segment that stands out of it as a triangle without area, and one that is
    // there twice.
    fs::write(
        &mesh,
        "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 0 0 2\nv 2 0 2\nv 2 2 2\nv 0 2 2\nv 4 2 2\n\
         f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nf 7 7 9\nf 4 3 2\n",
    )
    .unwrap();
    let reach = |path: &Path| {
        let (mesh, _) = mesh::load_closed(path).unwrap();
        mesh.positions.iter().map(|p| p[0]).fold(f32::NEG_INFINITY, f32::max)
    };
    let plain = directory.join("plain.ply");
    let text = ok(["hull", arg(&mesh), "--faces", "80", "--effort", "0", "-o", arg(&plain)]);
    assert!(!text.contains("points within") && reach(&plain) > 4.0, "{text}");
    ok(["hull", arg(&mesh), "--faces", "80", "--effort", "0", "--margin", "0", "-o", arg(&out)]);
    assert!(fs::read(&plain).unwrap() == fs::read(&out).unwrap(), "no margin is a margin of 0");
    let text = ok([
        "hull",
        arg(&mesh),
        "--faces",
        "100",
        "--effort",
        "0",
        "--margin",
        "0.5",
        "-o",
        arg(&out),
    ]);
    assert!(
        text.contains("all points within 0.5 of the mesh are inside") && reach(&out) > 4.5,
        "{text}"
    );
    for wrong in ["-1", "nan", "inf", "x"] {
        let output = run(["hull", arg(&mesh), "--margin", wrong, "-o", arg(&plain)]);
        assert_eq!(output.status.code(), Some(2));
        assert!(
            String::from_utf8_lossy(&output.stderr).contains("a finite number from 0"),
            "{wrong}"
        );
    }
    let output = run(["hull", arg(&mesh), "--margin", "1e39", "-o", arg(&out)]);
    assert!(refused(&output, 1, "box.obj").contains("range of single precision"));
    let output = run(["hull", arg(&mesh), "--margin", "1", "--slack", "1", "-o", arg(&out)]);
    assert!(refused(&output, 2, "--slack 1 ").contains("no more than the margin of 1 (--margin"));
}

#[test]
fn open_meshes_have_a_tight_hull_and_each_part_one_of_its_own() {
    let directory = scratch("hull_open");
    let (mesh, out) = (directory.join("two.obj"), directory.join("hull.ply"));
    fs::write(&mesh, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 0 0\nv 6 0 1\nv 5 1 0\nf 1 2 3\nf 4 5 6\n")
        .unwrap();
    let text = ok(["hull", arg(&mesh), "--faces", "70", "--effort", "0", "-o", arg(&out)]);
    assert!(text.contains("is not closed") && !text.contains("void space"), "{text}");
    let text =
        ok(["hull", arg(&mesh), "--faces", "70", "--effort", "0", "--parts", "-o", arg(&out)]);
    assert!(text.contains("2 hulls") && text.contains("part 1: "), "{text}");
    assert!(closed(&out).0 <= 140);
}

#[test]
fn what_keeps_a_mesh_from_having_a_void_is_named() {
    let directory = scratch("hull_no_void");
    let out = directory.join("hull.ply");
    for (name, why) in [
        ("open_box.stl", "the mesh is not closed: 8 boundary edges, as at triangle"),
        (
            "glued_cubes.stl",
            "the mesh is not manifold: 4 edges with up to 3 triangles, as at triangle",
        ),
        ("klein_bottle.obj", "the mesh has no outside: 1 one-sided component, as at triangle"),
        (
            "flat.obj",
            "that of triangle 0, has a volume that cannot be told from 0, as at [0.0, 0.0, 0.0]",
        ),
    ] {
        let mesh = fixture("evil").join(name);
        let line = refused(
            &run(["hull", arg(&mesh), "--void", "20", "--effort", "0", "-o", arg(&out)]),
            1,
            name,
        );
        assert!(line.contains(why) && line.contains("ask for faces or slack"), "{line}");
        assert!(!out.exists());
    }
    let flat = fixture("evil").join("flat.obj");
    let text = ok(["hull", arg(&flat), "--faces", "100", "--effort", "0", "-o", arg(&out)]);
    assert!(
        !text.contains("% void") && text.contains("has a volume that cannot be told from 0"),
        "{text}"
    );
    assert!(text.contains("; there is no volume to measure void against"), "{text}");
}

/// Cubes as OBJ, by the first and the last of each coordinate.
fn cubes(spans: &[[f64; 2]]) -> String {
    let mut text = String::new();
    for [low, high] in spans {
        for c in 0..8u32 {
            let at = [c & 1, c >> 1 & 1, c >> 2].map(|bit| if bit == 0 { low } else { high });
            text += &format!("v {} {} {}\n", at[0], at[1], at[2]);
        }
    }
    for cube in 0..spans.len() {
        for quad in
            [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
        {
            let [a, b, c, d] = quad.map(|corner: usize| corner + 1 + 8 * cube);
            text += &format!("f {a} {b} {c} {d}\n");
        }
    }
    text
}

#[test]
fn a_mesh_that_overlaps_itself_has_no_void_that_could_be_kept() {
    let directory = scratch("hull_overlap");
    let (mesh, out) = (directory.join("two.obj"), directory.join("hull.ply"));
    // One in the other, both facing outwards.
    fs::write(&mesh, cubes(&[[0.0, 2.0], [0.0625, 1.9375]])).unwrap();
    let why = "the mesh overlaps itself, so that its volume counts places more than once";
    let text = ok(["hull", arg(&mesh), "--faces", "100", "--effort", "0", "-o", arg(&out)]);
    assert!(closed(&out).1 < 14.0 && text.contains(why) && !text.contains("% void"), "{text}");
    fs::remove_file(&out).unwrap();
    let output = run(["hull", arg(&mesh), "--void", "60", "--effort", "0", "-o", arg(&out)]);
    let line = refused(&output, 1, "two.obj");
    assert!(line.contains(why) && !out.exists(), "{line}");
    let path = directory.join("two.msw");
    let build = ["build", arg(&mesh), "--for", "tight", "--tight", "100", "--effort", "0"];
    ok([&build[..], &["-o", arg(&path)]].concat());
    assert!(info(&path)["tight_hulls"]["hulls"][0]["void_ratio"].is_null());
    // Where no hull proves it, crossing is said; the box, of what is asked for, is had at once.
    for (spans, crosses) in [(&[[0.0, 2.0], [1.875, 4.0]][..], true), (&[[0.0, 2.0]], false)] {
        fs::write(&mesh, cubes(spans)).unwrap();
        let text = ok(["hull", arg(&mesh), "--void", "9000", "--seconds", "1e-3", "-o", arg(&out)]);
        assert_eq!(text.contains("the mesh crosses or touches itself"), crosses, "{text}");
        assert!(text.contains("% void"), "{text}");
    }
}

#[test]
fn parts_with_no_more_faces_than_asked_for_are_their_own_hulls() {
    let directory = scratch("hull_simple_parts");
    let (mesh, out) = (directory.join("boxes.obj"), directory.join("hull.ply"));
    // Where all starts are tried for each, which takes seconds, none has less void than rounding
    // leaves.
    let spans: Vec<[f64; 2]> = (0..200).map(|n| [f64::from(n), f64::from(n) + 0.5]).collect();
    fs::write(&mesh, cubes(&spans)).unwrap();
    let text = ok(["hull", arg(&mesh), "--parts", "--faces", "12", "-o", arg(&out)]);
    let parts: Vec<&str> = text.lines().filter(|line| line.starts_with("  part ")).collect();
    assert_eq!(parts.len(), 200);
    for part in parts {
        assert!(part.contains(": 12 faces, ") && void_percent(part) < 0.1, "{part}");
    }
    assert!(!text.contains("began as"), "{text}");
}

#[test]
fn every_level_of_a_blob_is_a_closed_hull_with_the_level_s_faces() {
    let directory = scratch("hull_of_blob");
    let path = hull_blob(&directory, "bracket.stl", &[]);
    let info = info(&path);
    let levels = info["hull"]["levels"].as_array().unwrap();
    let out = directory.join("level.ply");
    let mut last = f64::INFINITY;
    for (index, level) in levels.iter().enumerate() {
        ok(["hull", arg(&path), "--level", &index.to_string(), "-o", arg(&out)]);
        let (faces, volume) = closed(&out);
        assert_eq!(Some(faces as u64), level["faces"].as_u64());
        assert!(volume <= last * (1.0 + 1e-6), "finer hulls are tighter");
        last = volume;
    }
    let (_, solid) = closed(&fixture("bracket.stl"));
    assert!((last / solid - 1.0).abs() < 1e-6, "the last level is the surface");
}

#[test]
fn the_last_level_cuts_nothing_and_a_cut_can_be_cut_again() {
    let directory = scratch("cut_again");
    let path = hull_blob(&directory, "torus.ply", &[]);
    let info = info(&path);
    let last = info["hull"]["levels"].as_array().unwrap().len() - 1;
    let (one, two, direct) =
        (directory.join("1.msw"), directory.join("2.msw"), directory.join("d.msw"));
    ok(["cut", arg(&path), "--level", &last.to_string(), "-o", arg(&one)]);
    assert!(fs::read(&one).unwrap() == fs::read(&path).unwrap());
    ok(["cut", arg(&path), "--level", "2", "-o", arg(&one)]);
    ok(["cut", arg(&one), "--level", "1", "-o", arg(&two)]);
    ok(["cut", arg(&path), "--level", "1", "-o", arg(&direct)]);
    assert!(fs::read(&two).unwrap() == fs::read(&direct).unwrap());
    assert!(ok(["info", arg(&two)]).contains("cut: finer levels are not there"));
}

#[test]
fn hull_arguments_that_do_not_go_together_are_usage_errors() {
    let directory = scratch("hull_usage");
    let path = hull_blob(&directory, "torus.ply", &[]);
    let out = directory.join("hull.ply");
    refused(&run(["hull", arg(&path), "-o", arg(&out)]), 2, "torus.msw");
    refused(&run(["hull", arg(&path), "--faces", "9", "-o", arg(&out)]), 2, "torus.msw");
    let stl = directory.join("hull.stl");
    refused(&run(["hull", arg(&path), "--level", "0", "-o", arg(&stl)]), 2, "hull.stl");
    let mesh = fixture("bracket.stl");
    let line =
        refused(&run(["hull", arg(&mesh), "--level", "1", "-o", arg(&out)]), 2, "bracket.stl");
    assert!(line.contains("is a mesh") && line.contains("--for hull"), "{line}");
    let line = refused(
        &run(["hull", arg(&mesh), "--max-valence", "9", "-o", arg(&out)]),
        2,
        "--max-valence",
    );
    assert!(line.contains("--progressive"), "{line}");
    for pair in [["--progressive", "--parts"], ["--void=3", "--slack=2"], ["--faces=9", "--void=3"]]
    {
        let both = run(["hull", arg(&mesh), pair[0], pair[1], "-o", arg(&out)]);
        assert_eq!(both.status.code(), Some(2));
    }
    // No file is looked at before.
    for (slack, margin) in [("0.5", "2.25"), ("1e-9", "1e-9")] {
        let missing = directory.join("missing.stl");
        let output =
            run(["hull", arg(&missing), "--slack", slack, "--margin", margin, "-o", arg(&out)]);
        let line = refused(&output, 2, "--slack");
        assert!(line.contains(&format!("--slack {slack} ")), "{line}");
        assert!(line.contains(&format!("the margin of {margin} (--margin")), "{line}");
    }
    let output = run(["hull", arg(&mesh), "--slack", "inf", "-o", arg(&out)]);
    let text = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.code() == Some(2) && text.contains("a finite number above 0"), "{text}");
    let both = run(["hull", arg(&path), "--level", "0", "--faces", "9", "-o", arg(&out)]);
    assert_eq!(both.status.code(), Some(2));
    assert!(!out.exists() && !stl.exists());
}

#[test]
fn a_hull_on_a_grid_encloses_the_mesh_that_moved_there() {
    let directory = scratch("hull_bits");
    let (mesh, out) = (fixture("torus.ply"), directory.join("hull.ply"));
    for progressive in [true, false] {
        let mut arguments = vec!["hull", arg(&mesh), "--vertex-bits", "16", "-o", arg(&out)];
        arguments.extend(if progressive { &["--progressive"][..] } else { &["--effort", "0"] });
        let text = ok(arguments);
        assert!(text.contains("moved to the grid by up to "), "{text}");
        let (faces, volume) = closed(&out);
        let (_, solid) = closed(&mesh);
        assert!(faces <= 200 && volume > solid * (1.0 - 1e-4), "{faces} {volume} {solid}");
    }
}

#[test]
fn a_cut_leaves_the_box_tree_out_and_says_so() {
    let directory = scratch("cut_tree");
    let path = blob(&directory, "torus.ply", &["--for", "closest,hull"]);
    let out = directory.join("cut.msw");
    let text = ok(["cut", arg(&path), "--level", "1", "-o", arg(&out)]);
    assert!(text.contains("box tree"), "{text}");
    assert!(info(&out)["tree"].is_null());
}

#[test]
fn a_blob_without_hulls_has_no_levels() {
    let directory = scratch("no_levels");
    let path = blob(&directory, "torus.ply", &[]);
    let output = run(["cut", arg(&path), "-o", arg(&directory.join("out.msw"))]);
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    let options = ["--level", "--triboxes", "--tight"];
    assert!(
        output.status.code() == Some(2) && options.iter().all(|option| message.contains(option)),
        "{message}"
    );
    for (command, out) in [("hull", "out.ply"), ("cut", "out.msw")] {
        let out = directory.join(out);
        let output = run([command, arg(&path), "--level", "0", "-o", arg(&out)]);
        let line = refused(&output, 1, "torus.msw");
        assert!(line.contains("--for hull") && !out.exists(), "{line}");
    }
}
