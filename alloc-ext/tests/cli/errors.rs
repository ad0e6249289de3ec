//! What is refused: with which exit status, in one line, leaving what was there.

use crate::support::{
    arg, blob, fixture, hull_blob, meshsweep, ok, refused, run, scratch, write_raw,
};
use std::fs;
use std::path::Path;
use std::process::Stdio;

/// A file with this content.
fn file(directory: &Path, name: &str, content: impl AsRef<[u8]>) -> std::path::PathBuf {
    let path = directory.join(name);
    fs::write(&path, content).unwrap();
    path
}

#[test]
fn wrong_usage_is_status_2() {
    for args in [
        &["fly"][..],
        &["build", "a.stl"],
        &["build", "a.stl", "-o", "b", "--for", "hull", "--base", "3"],
        &["build", "a.stl", "-o", "b", "--vertex-bits", "17"],
        &["build", "a.stl", "-o", "b", "--compactness", "nan"],
        &["build", "a.stl", "-o", "b", "--max-normal-deviation", "181"],
        &["closest", "a.msw", "p.csv", "--rel=-1"],
        &["closest", "a.msw", "p.csv", "--abs", "inf"],
        &["closest", "a.msw", "p.csv", "--scratch", "0"],
        &["build", "a.stl", "-o", "-"],
        &["build", "a.stl", "-o", "b", "--base", "100"],
        &["build", "a.stl", "-o", "b", "--for", "closest", "--max-valence", "9"],
        &["build", "a.stl", "-o", "b", "--for", "flying"],
        &["within", "a.msw", "p.csv"],
        &["within", "a.msw", "p.csv", "--distance=-1"],
        &["nearest", "a.msw", "p.csv", "-n", "0"],
        &["field", "a.msw", "-o", "f.txt"],
        &["field", "a.msw", "-o", "f.npy", "--size", "4,4"],
        &["field", "a.msw", "-o", "f.npy", "--margin=-1"],
        &["field", "a.msw", "-o", "f.npy", "--threads", "0"],
        &["cull", "a.msw", "1,2"],
        &["cull", "a.msw"],
        &["cull", "a.msw", "1,2,3", "--along", "1,2,3"],
        &["closest", "a.msw"],
        &["closest", "a.msw", "1,2"],
        &["closest", "a.msw", "1,2,nan"],
        &["closest", "a.msw", "1,2,1e39"],
        &["closest", "a.msw", "1,2,3", "--threads", "0"],
        &["closest", "a.msw", "1,2,3", "--engine", "fast"],
        &["segment", "a.msw", "1,2,3"],
        &["segment", "a.msw", "s.csv", "--engine", "hull", "--facing", "back"],
        &["segment", "a.msw", "s.csv", "--facing", "left"],
    ] {
        assert_eq!(run(args).status.code(), Some(2), "{args:?}");
    }
    for (args, wanted) in [
        (&["closest", "a.msw", "1,2,3", "--threads", "0"][..], "from 1 to 256"),
        (&["closest", "a.msw", "1,2,3", "--threads", "-1"], "from 1 to 256"),
        (&["nearest", "a.msw", "1,2,3", "-n", "-1"], "from 1 to 1048576"),
        (&["closest", "a.msw", "1,2,3", "--steps", "-1"], "at least 0"),
        (&["closest", "a.msw", "1,2,3", "--scratch", "-1"], "from 1 to 16777216"),
        (&["hull", "a.stl", "-o", "a.ply", "--faces", "-3"], "at least 4"),
        (&["build", "a.stl", "-o", "b", "--base", "-3"], "at least 4"),
        (&["build", "a.stl", "-o", "b", "--max-valence", "-3"], "from 3 to 255"),
        (&["build", "a.stl", "-o", "b", "--compactness", "-1"], "from 0 to 1"),
        (&["build", "a.stl", "-o", "b", "--max-normal-deviation", "-1"], "from 0 to 180"),
        (&["field", "a.msw", "-o", "f.npy", "--size", "-4"], "from 1 to 65536"),
        (&["cut", "a.msw", "-o", "b.msw", "--level", "-1"], "at least 0"),
        (&["closest", "a.msw", ""], "no query; write 3: x, y, z with commas, or name a file"),
        (&["segment", "a.msw", ""], "no query; write 6: ax, ay, az, bx, by, bz with commas"),
    ] {
        let output = run(args);
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.code() == Some(2) && stderr.contains(wanted), "{args:?} {stderr}");
    }
    assert!(run(["help"]).status.success() && run(["--version"]).status.success());
}

#[test]
fn files_that_cannot_be_read_are_named() {
    let directory = scratch("unreadable");
    let out = directory.join("out.msw");
    refused(&run(["build", "no/such.stl", "-o", arg(&out)]), 1, "no/such.stl");
    refused(&run(["build", arg(&directory), "-o", arg(&out)]), 1, "unreadable");
    refused(&run(["info", "no/such.msw"]), 1, "no/such.msw");
    refused(&run(["info", arg(&directory)]), 1, "unreadable");
    refused(&run(["closest", "no/such.msw", "p.csv"]), 1, "no/such.msw");
    let path = blob(&directory, "torus.ply", &[]);
    let line = refused(&run(["closest", arg(&path), "no/such.csv"]), 1, "no/such.csv");
    assert!(line.contains("or write the query with commas (3: x, y, z)"), "{line}");
    refused(&run(["closest", arg(&path), "no/such.f32"]), 1, "no/such.f32");
    refused(&run(["closest", arg(&path), "-", "1,2,3", "-"]), 2, "read only once");
    assert!(!out.exists());
}

#[test]
fn a_mesh_file_without_triangles_is_named() {
    let directory = scratch("no_triangles");
    for (name, content, wanted) in [
        ("zero.ply", "", "the file is empty; "),
        ("zero.stl", "", "the file is empty; "),
        ("blank.obj", " \n", "the file is empty; "),
        ("empty.stl", "solid a\nendsolid a\n", "holds no triangles; export the surface"),
        ("points.obj", "v 0 0 0\n", "holds no triangles; export the surface"),
    ] {
        let mesh = file(&directory, name, content);
        let line = refused(&run(["build", arg(&mesh), "-o", "x.msw"]), 1, name);
        assert!(line.contains(wanted), "{line}");
    }
}

#[test]
fn what_is_no_whole_blob_is_refused_with_a_remedy() {
    let directory = scratch("no_blob");
    let mesh = fixture("torus.ply");
    let line = refused(&run(["info", arg(&mesh)]), 1, "torus.ply");
    assert!(line.contains("meshsweep build"), "{line}");
    refused(&run(["info", arg(&file(&directory, "empty.msw", ""))]), 1, "empty.msw");
    let bytes = fs::read(blob(&directory, "torus.ply", &[])).unwrap();
    for length in [8, 100, 1000, bytes.len() - 1] {
        refused(
            &run(["info", arg(&file(&directory, "short.msw", &bytes[..length]))]),
            1,
            "short.msw",
        );
    }
    let mut damaged = bytes.clone();
    damaged[5000] ^= 4;
    let line = refused(&run(["info", arg(&file(&directory, "bad.msw", &damaged))]), 1, "bad.msw");
    assert!(line.contains("damaged"), "{line}");
    let whole = file(&directory, "whole.msw", &bytes);
    refused(&run(["build", arg(&whole), "-o", "x.msw"]), 1, "whole.msw: is a blob already");
}

#[test]
fn a_hull_of_a_mesh_with_holes_is_refused_in_one_line_with_places_and_a_way_out() {
    let directory = scratch("holes");
    let (mesh, out) = (fixture("evil/open_box.stl"), directory.join("out.msw"));
    for questions in ["hull", "closest,hull"] {
        let line = refused(
            &run(["build", arg(&mesh), "-o", arg(&out), "--for", questions]),
            1,
            "open_box.stl",
        );
        assert!(line.contains("not closed") && line.contains("edge ["), "{line}");
        assert!(
            line.contains("--for closest,segment and --for sweep need no closed mesh"),
            "{line}"
        );
    }
    let (mesh, ply) = (fixture("evil/stuck_cap.obj"), directory.join("out.ply"));
    let line =
        refused(&run(["hull", arg(&mesh), "--progressive", "-o", arg(&ply)]), 1, "stuck_cap.obj");
    assert!(line.contains("zero-area triangle") && !line.contains("--for"), "{line}");
}

#[test]
fn a_mesh_under_a_name_of_another_kind_is_refused_with_its_kind() {
    let directory = scratch("misnamed");
    let out = directory.join("out.msw");
    for (from, name, kind) in [
        ("torus.ply", "a.stl", "PLY"),
        ("torus.ply", "a.obj", "PLY"),
        ("torus.ply", "noname", "PLY"),
        ("groove.obj", "b.ply", "OBJ"),
        ("groove.obj", "b.STL", "OBJ"),
        ("bracket.stl", "b.obj", "binary STL"),
    ] {
        let mesh = file(&directory, name, fs::read(fixture(from)).unwrap());
        let line = refused(&run(["build", arg(&mesh), "-o", arg(&out)]), 1, name);
        assert!(line.contains(&format!("looks like {kind}; rename")), "{line}");
    }
    let text = "solid x\nfacet normal 0 0 1\nouter loop\n";
    let mesh = file(&directory, "c.ply", text);
    let line = refused(&run(["build", arg(&mesh), "-o", arg(&out)]), 1, "c.ply");
    assert!(line.contains("looks like STL"), "{line}");
    // Its own kind, but broken: no word of another name.
    let mesh = file(&directory, "d.stl", text);
    let line = refused(&run(["build", arg(&mesh), "-o", arg(&out)]), 1, "d.stl");
    assert!(!line.contains("looks like"), "{line}");
}

#[test]
fn what_a_blob_was_not_built_for_is_refused_with_what_to_build() {
    let directory = scratch("not_served");
    let (tree, hull) = (directory.join("tree.msw"), directory.join("hull.msw"));
    let mesh = fixture("torus.ply");
    ok(["build", arg(&mesh), "-o", arg(&tree), "--for", "closest"]);
    ok(["build", arg(&mesh), "-o", arg(&hull), "--for", "hull"]);
    let (points, segments) =
        (file(&directory, "p.csv", "1 2 3\n"), file(&directory, "s.csv", "9 9 9 0 0 0\n"));
    let field = directory.join("f.npy");
    for (args, wanted) in [
        (&["segment", arg(&tree), arg(&segments)][..], "--for closest,segment"),
        (&["segment", arg(&tree), arg(&segments), "--engine", "hull"], "--for hull"),
        (&["closest", arg(&tree), arg(&points), "--engine", "hull"], "or use --engine tree"),
        (&["closest", arg(&hull), arg(&points), "--engine", "tree"], "or use --engine hull"),
        (&["segment", arg(&hull), arg(&segments), "--engine", "tree"], "--for segment"),
        (&["within", arg(&hull), arg(&points), "-d", "1"], "--for closest"),
        (&["nearest", arg(&hull), arg(&points), "-n", "1"], "--for closest"),
        (&["signed", arg(&hull), arg(&points)], "--for closest"),
        (&["field", arg(&hull), "-o", arg(&field)], "--for closest"),
        (&["cull", arg(&tree), "1,2,3"], "--for closest,cull"),
        (&["segment", arg(&hull), arg(&segments), "--facing", "front"], "--for segment"),
    ] {
        let line = refused(&run(args), 1, ".msw: has no ");
        assert!(line.contains(wanted), "{args:?} {line}");
    }
    assert!(!field.exists());
}

#[test]
fn an_error_leaves_the_old_output_alone() {
    let directory = scratch("old_output");
    let out = file(&directory, "out.msw", "precious");
    let mesh = fixture("evil/nan.stl");
    refused(&run(["build", arg(&mesh), "-o", arg(&out)]), 1, "nan.stl");
    let path = hull_blob(&directory, "torus.ply", &[]);
    refused(
        &run(["cut", arg(&path), "--level", "99", "-o", arg(&out)]),
        1,
        "level 99 does not exist",
    );
    let points = file(&directory, "p.csv", "1,2,3\n1,2\n");
    refused(&run(["closest", arg(&path), arg(&points), "-o", arg(&out)]), 1, "line 2");
    assert_eq!(fs::read_to_string(&out).unwrap(), "precious");
    assert_eq!(fs::read_dir(&directory).unwrap().count(), 3, "no temporary file is left");
}

#[test]
fn outputs_that_cannot_be_written_are_named_before_the_work() {
    let directory = scratch("unwritable");
    let mesh = fixture("torus.ply");
    refused(&run(["build", arg(&mesh), "-o", arg(&directory)]), 1, "unwritable");
    let missing = directory.join("missing/out.msw");
    let line = refused(
        &run(["build", arg(&mesh), "-o", arg(&missing)]),
        1,
        "missing/out.msw: cannot be written",
    );
    assert!(line.contains("there is no directory"), "{line}");
    let path = hull_blob(&directory, "torus.ply", &[]);
    let line = refused(&run(["cut", arg(&path), "--level", "1", "-o", arg(&path)]), 1, "torus.msw");
    assert!(line.contains("both input and output"), "{line}");
}

#[test]
fn malformed_queries_are_named_by_line_and_field() {
    let directory = scratch("malformed");
    let path = blob(&directory, "torus.ply", &[]);
    for (text, place) in [
        ("x,y,z\n1,2,3\n1,2,three\n", "p.csv, line 3, field 3: \"three\""),
        ("1;2\n", "p.csv, line 1: 2 fields"),
        ("1\n", "p.csv, line 1: 1 field,"),
        ("# three\n\n1 2 3 4\n", "p.csv, line 3: 4 fields"),
        ("1,2,nan\n", "p.csv, line 1, field 3: \"nan\" is not finite"),
        ("1,2,-inf\n", "p.csv, line 1, field 3: \"-inf\" is not finite"),
        ("1,2,1e39\n", "p.csv, line 1, field 3: \"1e39\" is beyond f32"),
        ("1,2,\u{fffd}\n", "p.csv, line 1, field 3"),
    ] {
        let points = file(&directory, "p.csv", text);
        refused(&run(["closest", arg(&path), arg(&points)]), 1, place);
    }
    let binary = file(&directory, "p.csv", [0xFFu8, 0xFE, b'\n', b'1', 0, 0xFF]);
    refused(&run(["closest", arg(&path), arg(&binary)]), 1, "p.csv, line 1");
    let far = file(&directory, "s.csv", "0 0 0 1 1 1\n0 0 0 1e38 0 0\n");
    let line = refused(&run(["segment", arg(&path), arg(&far)]), 1, "s.csv, line 2");
    assert!(line.contains("clip the segment"), "{line}");
    // The first one that is refused is named, whichever thread comes first.
    let many: String = (0..5000)
        .map(|i| format!("0 0 {} 1 1 1\n", if i >= 1200 { "1e38" } else { "0" }))
        .collect();
    let far = file(&directory, "s.csv", many);
    refused(&run(["segment", arg(&path), arg(&far), "--threads", "4"]), 1, "s.csv, line 1201:");
    let line =
        refused(&run(["segment", arg(&path), "1,2,3,4,5,6", "0,0,0,1e38,0,0"]), 1, "query 0,0,0,1");
    assert!(line.contains("clip the segment"), "{line}");
}

#[test]
fn answers_before_a_query_that_is_refused_are_printed_but_make_no_file() {
    let directory = scratch("before_refused");
    let (tree, hull) = (blob(&directory, "torus.ply", &[]), directory.join("hull.msw"));
    ok(["build", arg(&fixture("torus.ply")), "-o", arg(&hull), "--for", "hull"]);
    let (good, bad) = (directory.join("good.csv"), directory.join("bad.csv"));
    let points: String = (0..1500).map(|i| format!("{} 0.5 1\n", i % 7)).collect();
    let segments: String = (0..1500).map(|i| format!("{} 0.5 9 1 0.5 -9\n", i % 7)).collect();
    for (command, blob, queries, refused_one, options) in [
        ("closest", &tree, &points, "1 2", &[][..]),
        ("closest", &hull, &points, "1 2 nan", &[]),
        ("within", &tree, &points, "1 2 three", &["-d", "1"]),
        ("nearest", &tree, &points, "1 2", &["-n", "2"]),
        ("signed", &tree, &points, "1 2 3 4", &[]),
        ("segment", &tree, &segments, "0 0 0 1e38 0 0", &[]),
        ("segment", &tree, &segments, "0 0 0 1e38 0 0", &["--all", "--threads", "3"]),
        ("segment", &hull, &segments, "0 0 0 1e38 0 0", &[]),
        ("segment", &tree, &segments, "0 0 0 1", &[]),
    ] {
        fs::write(&good, queries).unwrap();
        fs::write(&bad, format!("{queries}{refused_one}\n{queries}")).unwrap();
        let ask = |file: &Path, more: &[&str]| {
            run([&[command, arg(blob), arg(file)], options, more].concat())
        };
        let broken = ask(&bad, &[]);
        refused(&broken, 1, "bad.csv, line 1501");
        assert!(broken.stdout == ask(&good, &[]).stdout, "{command} {options:?}");
        let out = directory.join("out.csv");
        let line = refused(&ask(&bad, &["-o", arg(&out)]), 1, "bad.csv, line 1501");
        assert!(line.contains("out.csv is not written") && !out.exists(), "{line}");
    }
    // Raw numbers, too; and nothing is printed if there is no answer.
    let raw = directory.join("p.f32");
    write_raw(&raw, &[[1f32, 2.0, 3.0], [1.0, f32::NAN, 3.0], [4.0, 5.0, 6.0]]);
    assert_eq!(
        run(["closest", arg(&tree), arg(&raw)]).stdout,
        ok(["closest", arg(&tree), "1,2,3"]).as_bytes()
    );
    fs::write(&bad, "1 2\n1 2 3\n").unwrap();
    assert!(run(["closest", arg(&tree), arg(&bad)]).stdout.is_empty());
}

#[test]
fn a_segment_that_is_too_long_is_told_a_limit_that_holds() {
    let directory = scratch("too_far");
    let path = blob(&directory, "torus.ply", &["--for", "segment,hull"]);
    for engine in ["tree", "hull"] {
        let line = refused(
            &run(["segment", arg(&path), "0,0,0,1e38,0,0", "--engine", engine]),
            1,
            "too far",
        );
        let limit: f32 =
            line.split("about ").nth(1).unwrap().split([';', ' ']).next().unwrap().parse().unwrap();
        let to = |factor: f32| {
            let query = format!("0,0,0,{},0,0", limit * factor);
            run(["segment", arg(&path), &query, "--engine", engine]).status.success()
        };
        assert!(to(0.9) && !to(1.1), "{engine} {limit}");
    }
}

#[test]
fn a_file_without_queries_is_named_and_no_error() {
    let directory = scratch("no_queries");
    let path = blob(&directory, "torus.ply", &[]);
    let (empty, raw) =
        (file(&directory, "empty.csv", "x,y,z\n# none\n"), file(&directory, "empty.f32", ""));
    let output = run(["closest", arg(&path), arg(&empty), "1,2,3", arg(&raw)]);
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && stderr.lines().count() == 2, "{stderr}");
    assert!(stderr.starts_with("no queries in ") && stderr.contains("empty.csv\n"), "{stderr}");
}

#[cfg(target_os = "linux")]
#[test]
fn a_field_beyond_the_file_system_is_refused_before_the_work() {
    let directory = scratch("field_size");
    let path = blob(&directory, "torus.ply", &[]);
    let out = directory.join("f.f32");
    let output = run(["field", arg(&path), "-o", arg(&out), "--size", "65536", "--interval"]);
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(stderr.contains("f.f32: will be a file of 2097152.0 GiB"), "{stderr}");
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(fs::read_dir(&directory).unwrap().count(), 1, "nothing is left");
}

#[test]
fn malformed_raw_queries_are_named_by_number() {
    let directory = scratch("malformed_raw");
    let path = blob(&directory, "torus.ply", &[]);
    let raw = directory.join("p.f32");
    write_raw(&raw, &[[1f32, 2.0, 3.0], [1.0, f32::NAN, 3.0]]);
    refused(&run(["closest", arg(&path), arg(&raw)]), 1, "p.f32, query 1 at byte 12");
    fs::write(&raw, [0; 25]).unwrap();
    refused(&run(["closest", arg(&path), arg(&raw)]), 1, "p.f32: 25 bytes");
    fs::write(&raw, [0; 36]).unwrap();
    refused(&run(["segment", arg(&path), arg(&raw)]), 1, "p.f32: 36 bytes");
}

#[test]
fn a_reader_that_leaves_early_is_no_error() {
    let directory = scratch("broken_pipe");
    let path = blob(&directory, "torus.ply", &[]);
    let points = file(&directory, "p.csv", "3 3 3\n".repeat(20_000));
    let mut child = meshsweep()
        .args(["closest", arg(&path), arg(&points)])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert!(
        output.status.success() && output.stderr.is_empty(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_standard_output_is_an_error_and_a_device_is_not_replaced() {
    let directory = scratch("full");
    let path = hull_blob(&directory, "torus.ply", &[]);
    let full = || fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    for args in [&["info", arg(&path)][..], &[]] {
        let output = meshsweep().args(args).stdout(full()).output().unwrap();
        refused(&output, 1, "standard output: cannot be written");
    }
    let cut = run(["cut", arg(&path), "--level", "0", "-o", "/dev/full"]);
    refused(&cut, 1, "/dev/full: cannot be written");
    assert!(!fs::metadata("/dev/full").unwrap().is_file());
}
