//! Meshes in decimals and doubles: every command that reads one says what rounding to `f32` moved,
//! and hulls that are written are proved of the file.

use crate::support::{arg, fixture, ok, run, scratch};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

/// An octahedron around 0.1, 0.1, 0.1.
fn octahedron(directory: &Path) -> PathBuf {
    let text = "v 1.1 0.1 0.1\nv -0.9 0.1 0.1\nv 0.1 1.1 0.1\nv 0.1 -0.9 0.1\nv 0.1 0.1 1.1\n\
                v 0.1 0.1 -0.9\nf 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\n\
                f 1 4 6\n";
    let path = directory.join("octahedron.obj");
    fs::write(&path, text).expect("the file can be written");
    path
}

#[test]
fn every_command_that_reads_a_mesh_says_what_rounding_moved() {
    let directory = scratch("rounding_said");
    let mesh = octahedron(&directory);
    let (blob, ply) = (directory.join("o.msw"), directory.join("o.ply"));
    let (mesh, blob, ply) = (arg(&mesh), arg(&blob), arg(&ply));
    let rounding = |json: &str| -> Value {
        serde_json::from_str::<Value>(json).expect("it is JSON")["rounding"].clone()
    };
    let is_moved = |value: &Value| value.as_f64().is_some_and(|moved| moved > 1e-8);
    let of: [&[&str]; 8] = [
        &["build", mesh, "-o", blob, "--for", "hull,tight,triboxes", "--triboxes", "4"],
        &["build", mesh, "-o", blob, "--flash", "1M"],
        &["hull", mesh, "-o", ply],
        &["hull", mesh, "-o", ply, "--progressive", "--faces", "8"],
        &["tribox", mesh, "--levels", "2"],
        &["hausdorff", mesh, mesh],
        &["trade", mesh, "--points", "2"],
        &["verify", blob, mesh],
    ];
    for command in of {
        let said = ok(command);
        assert!(said.contains("rounding to f32 moved vertices by up to "), "{command:?}: {said}");
    }
    for command in [of[4], of[6], of[7]] {
        assert!(is_moved(&rounding(&ok([command, &["--json"]].concat()))), "{command:?}");
    }
    let both = rounding(&ok([of[5], &["--json"]].concat()));
    assert!(is_moved(&both[0]) && is_moved(&both[1]), "{both}");
}

#[test]
fn nothing_is_said_of_rounding_where_nothing_moved() {
    let directory = scratch("rounding_none");
    let ply = directory.join("hull.ply");
    let torus = fixture("torus.ply");
    for command in [
        &["tribox", arg(&torus), "--levels", "1"][..],
        &["hull", arg(&torus), "--progressive", "-o", arg(&ply)],
    ] {
        assert!(!ok(command).contains("rounding to f32"), "{command:?}");
    }
}

#[test]
fn verify_proves_hulls_and_triboxes_of_the_file_s_own_numbers() {
    let directory = scratch("rounding_verify");
    let mesh = fixture("evil/map_sphere.obj");
    let blob = directory.join("sphere.msw");
    ok(["build", arg(&mesh), "-o", arg(&blob), "--for", "tight,triboxes", "--effort", "0"]);
    let said = ok(["verify", arg(&blob), arg(&mesh)]);
    for of in ["tight hulls: every hull encloses", "triboxes: every level holds"] {
        let claim = format!("proved: {of} every triangle of the file, before rounding");
        assert!(said.contains(&claim), "{said}");
    }
}

#[test]
fn a_level_of_a_blob_encloses_the_file_or_says_by_how_much_it_does_not() {
    let directory = scratch("rounding_level");
    let mesh = octahedron(&directory);
    let (blob, ply) = (directory.join("o.msw"), directory.join("o.ply"));
    let built = ok(["build", arg(&mesh), "-o", arg(&blob), "--for", "hull"]);
    assert!(built.contains("the input may stick out by up to"), "{built}");
    let said = ok(["hull", arg(&blob), "--level", "0", "-o", arg(&ply)]);
    assert!(!said.contains("stick out"), "{said}");
    // The vertices of the stored level are those of the rounded mesh, and none is written.
    let hull = meshsweep::mesh::read(&ply).expect("it reads");
    let read = meshsweep::mesh::read(&mesh).expect("it reads");
    let rounded: Vec<[f32; 3]> = read.positions.iter().map(|p| p.map(|x| x as f32)).collect();
    let wide: Vec<[f64; 3]> = rounded.iter().map(|p| p.map(f64::from)).collect();
    assert!(hull.positions.iter().all(|p| !wide.contains(p)));
}

#[test]
fn a_progressive_hull_that_cannot_enclose_the_file_is_refused_with_a_remedy() {
    let directory = scratch("rounding_refused");
    let mesh = octahedron(&directory);
    // A second one that crosses the first.
    let text = fs::read_to_string(&mesh).expect("it reads");
    let (mut vertices, mut faces) = (String::new(), String::new());
    for line in text.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        if words[0] == "v" {
            let x: f64 = words[1].parse().expect("a number");
            vertices += &format!("v {} {} {}\n", x + 0.7, words[2], words[3]);
        } else {
            let numbers: Vec<String> = words[1..]
                .iter()
                .map(|word| (word.parse::<u32>().expect("a number") + 6).to_string())
                .collect();
            faces += &format!("f {}\n", numbers.join(" "));
        }
    }
    fs::write(&mesh, text + &vertices + &faces).expect("the file can be written");
    let ply = directory.join("hull.ply");
    let output = run(["hull", arg(&mesh), "--progressive", "-o", arg(&ply)]);
    let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1), "{stderr}");
    assert!(stderr.contains("leave out --progressive"), "{stderr}");
    assert!(!ply.exists());
    ok(["hull", arg(&mesh), "--effort", "0", "-o", arg(&ply)]);
}
