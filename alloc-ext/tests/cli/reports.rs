//! Reports as text and as JSON, meshes from the standard input, and threads of a build.

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
    assert_eq!(told["options"], "--unit mm");
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
    assert!(told["options"].as_str().unwrap().starts_with("--for "), "{told}");
    let curve = fixture("fence.csv");
    let fence = ["build", arg(&curve), "-o", arg(&out), "--json", "--flash", "1M"];
    let told = json(&[&fence[..], &["--closed"]].concat());
    assert_eq!(told["chosen"]["first"]["structure"], "curve, 16 bits");
    assert_eq!(told["options"], "--for curve --vertex-bits 16 --closed");
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
        // Of few faces all ways to begin compete, as above; of more the search has most to do.
        let of = ["--faces", "200", "--effort", "0.01", "--threads", threads];
        ok([&["hull", arg(&mesh), "-o", arg(&hull)], &of[..]].concat());
        let told = json(&["tribox", arg(&mesh), "--levels", "2", "--json", "--threads", threads]);
        (fs::read(out).unwrap(), fs::read(hull).unwrap(), told)
    });
    assert!(one == more);
}

/// Builds a mesh written by hand; the report.
fn report(directory: &Path, name: &str, content: &str) -> String {
    let (mesh, out) = (directory.join(name), directory.join("out.msw"));
    fs::write(&mesh, content).unwrap();
    ok(["build", arg(&mesh), "-o", arg(&out)])
}

#[test]
fn polygons_that_were_split_are_reported() {
    let directory = scratch("polygons");
    let corners = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n";
    let obj: String = corners.lines().map(|corner| format!("v {corner}\n")).collect();
    let text = report(&directory, "a.obj", &(obj.clone() + "f 1 2 3 4\nf 1 2 5\nf 5 4 3 2\n"));
    assert!(
        text.contains("5 vertices, 5 triangles read") && text.contains("\n  2 polygons split: "),
        "{text}"
    );
    let ply = "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n\
        property float z\n\
        element face 2\nproperty list uchar int vertex_indices\nend_header\n";
    let text = report(&directory, "a.ply", &(ply.to_owned() + corners + "4 0 1 2 3\n3 0 1 4\n"));
    assert!(text.contains("\n  1 polygon split: numbers of triangles count"), "{text}");
    assert!(!report(&directory, "b.obj", &(obj + "f 1 2 3\n")).contains(" split: "));
}

/// Closed tetrahedra with their right angles at `places` on the x axis, as OBJ.
fn tetrahedra(places: &[f32]) -> String {
    let corners = |x: &f32| format!("v {x} 0 0\nv {} 0 0\nv {x} 2 0\nv {x} 0 2\n", x + 2.0);
    let faces = |t: usize| {
        let [a, b, c, d] = [1, 2, 3, 4].map(|k| 4 * t + k);
        format!("f {a} {c} {b}\nf {a} {b} {d}\nf {a} {d} {c}\nf {b} {c} {d}\n")
    };
    places.iter().map(corners).chain((0..places.len()).map(faces)).collect()
}

#[test]
fn triangles_that_cross_are_named_where_sides_are_promised() {
    let directory = scratch("crossing_components");
    let note =
        "triangles: the surface crosses, overlaps or touches itself, as triangles 0 and 8 do";
    let apart = report(&directory, "apart.obj", &tetrahedra(&[0.0, 3.0]));
    assert!(!apart.contains("undecided"), "{apart}");
    let text = report(&directory, "overlap.obj", &tetrahedra(&[0.0, 9.0, 1.0]));
    assert!(text.contains(note) && text.contains("--for closest,winding decides"), "{text}");
    // Inside one component, beside the front of another one; and next to the one that crosses none.
    let answers = ok(["signed", arg(&directory.join("out.msw")), "0.95,0.1,0.1", "9.2,0.1,0.1"]);
    assert!(answers.contains(",undecided,rounding,") && answers.contains(",inside,"), "{answers}");
    let mesh = directory.join("overlap.obj");
    let out = directory.join("segments.msw");
    assert!(!ok(["build", arg(&mesh), "-o", arg(&out), "--for", "segment"]).contains(note));
}

#[test]
fn one_of_a_thing_is_in_the_singular() {
    let directory = scratch("singular");
    let text = report(
        &directory,
        "a.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv 0 0 1\nv 0 3 0\n\
         f 1 2 3\nf 1 2 4\nf 2 4 5\nf 1 1 2\nf 6 6 6\n",
    );
    for part in [
        "1 triangle without area kept",
        "1 zero-area triangle dropped",
        "1 triangle with a repeated corner",
        "3 fans of one",
    ] {
        assert!(text.contains(part), "{part} in {text}");
    }
    assert!(
        !["1 triangles", "1 vertices", "1 fans", "1 copies"]
            .iter()
            .any(|wrong| text.contains(&format!(" {wrong}")))
    );
}
