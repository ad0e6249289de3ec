//! Reports as JSON, meshes from the standard input, and threads of a build.

use crate::support::{arg, fixture, info, meshsweep, ok, refused, run, scratch};
use serde_json::Value;
use std::fs::{self, File};
use std::path::Path;
use std::process::Output;

fn json(args: &[&str]) -> Value {
    serde_json::from_str(&ok(args)).expect("it is JSON")
}

/// What the program does with a file as its standard input.
fn piped(args: &[&str], input: &Path) -> Output {
    meshsweep().args(args).stdin(File::open(input).unwrap()).output().unwrap()
}

#[test]
fn build_as_json_tells_the_mesh_its_repairs_and_the_contents_that_info_tells() {
    let directory = scratch("build_json");
    let (mesh, out) = (fixture("bracket.stl"), directory.join("b.msw"));
    let told = json(&["build", arg(&mesh), "-o", arg(&out), "--json", "--unit", "mm"]);
    assert_eq!(told["contents"], info(&out));
    assert_eq!(told["blob"], arg(&out));
    assert_eq!(told["mesh"], arg(&mesh));
    assert_eq!((&told["triangles"], &told["unit"]), (&1948.into(), &"mm".into()));
    let welded = &told["repairs"]["findings"]["welded"];
    let kept = told["repairs"]["vertices"].as_u64().unwrap();
    assert_eq!(welded["count"].as_u64(), Some(3 * 1948 - kept));
    assert_eq!(welded["places"].as_array().unwrap().len(), 5);
    assert!(told["seconds"]["box_tree"].as_f64().is_some(), "{told}");
    // The notes are the sentences of the text.
    let text = ok(["build", arg(&mesh), "-o", arg(&out), "--unit", "mm"]);
    let notes = told["notes"].as_array().unwrap();
    assert!(notes.iter().all(|note| text.contains(note["text"].as_str().unwrap())), "{text}");
    assert!(notes.iter().any(|note| note["topic"] == "input"));
}

#[test]
fn build_as_json_tells_curves_and_what_limits_chose() {
    let directory = scratch("build_json_others");
    let out = directory.join("b.msw");
    let told = json(&["build", arg(&fixture("fence.csv")), "-o", arg(&out), "--json"]);
    assert_eq!(told["curves"], arg(&fixture("fence.csv")));
    assert!(told.get("triangles").is_none() && told["seconds"]["hierarchy"].is_number());
    let mesh = fixture("groove.obj");
    let told = json(&["build", arg(&mesh), "-o", arg(&out), "--json", "--flash", "1M"]);
    let chosen = &told["chosen"]["first"];
    assert_eq!(chosen["flash"].as_u64(), Some(fs::metadata(&out).unwrap().len()));
    assert_eq!(told["contents"], info(&out));
    assert!(told["triangles"].as_u64() > Some(0) && chosen["structure"].is_string());
}

#[test]
fn hull_as_json_tells_the_numbers_of_its_text() {
    let directory = scratch("hull_json");
    let (mesh, out) = (fixture("groove.obj"), directory.join("h.ply"));
    let blob = directory.join("b.msw");
    let build = ["build", arg(&mesh), "-o", arg(&blob), "--effort", "0"];
    ok([&build[..], &["--for", "tight,hull", "--tight", "100"]].concat());
    for (input, options) in [
        (&mesh, &["--faces", "100", "--effort", "0"][..]),
        (&mesh, &["--progressive", "--faces", "30"]),
        (&mesh, &["--parts", "--faces", "100", "--effort", "0"]),
        (&blob, &["--tight", "100"]),
        (&blob, &["--level", "0"]),
    ] {
        let args = [&["hull", arg(input), "-o", arg(&out)], options].concat();
        let (text, told) = (ok(&args), json(&[&args[..], &["--json"]].concat()));
        let hulls = told["hulls"].as_array().unwrap();
        assert_eq!(told["output"], arg(&out));
        for hull in hulls {
            let faces = hull["faces"].as_u64().unwrap();
            assert!(text.contains(&format!("{faces} faces")), "{text} {told}");
            let [lower, upper] = ["lower", "upper"].map(|end| hull["hull_to_mesh"][end].as_f64());
            assert_eq!(upper.is_some(), text.contains("at most"), "{text} {told}");
            assert!(lower.is_none() || lower <= upper);
        }
        assert_eq!(told["mesh"].is_string(), input == &mesh);
        assert_eq!(told["blob"].is_string(), input == &blob);
    }
}

#[test]
fn a_mesh_from_the_standard_input_is_the_file_s() {
    let directory = scratch("stdin_mesh");
    let (mesh, curve) = (fixture("bracket.stl"), fixture("fence.csv"));
    for (input, format) in [(&mesh, "stl"), (&curve, "csv")] {
        let [a, b] = ["a.msw", "b.msw"].map(|name| directory.join(name));
        ok(["build", arg(input), "-o", arg(&a)]);
        let output = piped(&["build", "-", "--format", format, "-o", arg(&b)], input);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let said = String::from_utf8(output.stdout).unwrap();
        assert!(said.starts_with(&format!("stdin.{format}\n")), "{said}");
        assert!(fs::read(&a).unwrap() == fs::read(&b).unwrap());
        let output = piped(&["verify", arg(&a), "-", "--format", format], input);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
    let (mesh, hull) = (fixture("groove.obj"), directory.join("h.ply"));
    for args in [
        &["hull", "-", "--format", "obj", "--faces", "60", "--effort", "0", "-o", arg(&hull)][..],
        &["tribox", "-", "--format", "obj", "--levels", "1"],
        &["hausdorff", arg(&mesh), "-", "--format", "obj"],
    ] {
        let output = piped(args, &mesh);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        assert!(!output.stdout.is_empty());
    }
}

#[test]
fn the_standard_input_needs_a_format_and_only_it_takes_one() {
    let directory = scratch("stdin_refused");
    let out = directory.join("o.msw");
    let mesh = fixture("groove.obj");
    for (args, wanted) in [
        (&["build", "-", "-o", arg(&out)][..], "--format stl"),
        (&["build", arg(&mesh), "-o", arg(&out), "--format", "stl"], "is named -"),
        (&["hausdorff", "-", "-", "--format", "stl"], "the standard input is one mesh"),
        (&["hull", arg(&mesh), "-o", "h.ply", "--format", "obj"], "is named -"),
    ] {
        assert!(refused(&run(args), 2, "").contains(wanted), "{args:?}");
    }
    // The text is no STL, and the message names the standard input.
    refused(&piped(&["build", "-", "--format", "stl", "-o", arg(&out)], &mesh), 1, "stdin.stl");
    assert!(!out.exists());
}

#[test]
fn what_is_written_does_not_depend_on_threads() {
    let directory = scratch("threads_of_builds");
    let mesh = fixture("bracket.stl");
    let [one, more] = ["1", "3"].map(|threads| {
        let (out, hull) = (directory.join("b.msw"), directory.join("h.ply"));
        let questions = ["--for", "closest,segment,hull,tight,triboxes", "--effort", "0"];
        let of = ["--tight", "60", "--triboxes", "4", "--threads", threads];
        ok([&["build", arg(&mesh), "-o", arg(&out)], &questions[..], &of].concat());
        ok(["hull", arg(&mesh), "-o", arg(&hull), "--faces", "60", "--threads", threads]);
        let told = json(&["tribox", arg(&mesh), "--levels", "2", "--json", "--threads", threads]);
        (fs::read(out).unwrap(), fs::read(hull).unwrap(), told)
    });
    assert!(one == more);
}
