//! Mesh files of other kinds, and units.

use crate::support::{arg, ok, refused, run, scratch};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

const TRIANGLE: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [0.5, 0.0, 0.0], [0.0, 0.25, 0.0]];

/// A triangle in metres.
fn gltf(directory: &Path) -> PathBuf {
    let bytes: Vec<u8> = TRIANGLE.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    let text = format!(
        r#"{{"asset":{{"version":"2.0"}},"nodes":[{{"mesh":0}}],"scenes":[{{"nodes":[0]}}],
        "buffers":[{{"uri":"data:a/b;base64,{}","byteLength":36}}],
        "bufferViews":[{{"buffer":0,"byteLength":36}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"type":"VEC3","count":3}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}]}}"#,
        STANDARD.encode(bytes)
    );
    file(directory, "part.gltf", &text)
}

fn file(directory: &Path, name: &str, text: &str) -> PathBuf {
    let path = directory.join(name);
    fs::write(&path, text).unwrap();
    path
}

#[test]
fn a_unit_scales_what_knows_its_own_and_is_told() {
    let directory = scratch("units");
    let metres = gltf(&directory);
    let other = file(&directory, "a.off", "OFF\n3 1 0\n0 0 0\n500 0 0\n0 250 0\n3 0 1 2\n");
    let (first, second) = (directory.join("a.msw"), directory.join("b.msw"));
    let report = ok(["build", arg(&metres), "-o", arg(&first)]);
    assert!(report.contains("\n  unit: m (as the file tells)\n"), "{report}");
    assert!(!ok(["build", arg(&other), "-o", arg(&second)]).contains("unit:"));
    let plain = fs::read(&second).unwrap();
    let report = ok(["build", arg(&other), "-o", arg(&second), "--unit", "mm"]);
    assert!(report.contains("\n  unit: mm (by --unit)\n"), "{report}");
    assert_eq!(fs::read(&second).unwrap(), plain);
    let report = ok(["build", arg(&metres), "-o", arg(&first), "--unit", "mm"]);
    assert!(report.contains("\n  unit: mm (by --unit), scaled from m\n"), "{report}");
    let options = ["--unit", "mm", "--json", "--at-most", "1e-6"];
    let compared = ok([&["hausdorff", arg(&metres), arg(&other)][..], &options].concat());
    let value: serde_json::Value = serde_json::from_str(&compared).unwrap();
    assert_eq!((&value["unit"], &value["holds"]), (&"mm".into(), &true.into()), "{compared}");
    let bare = run(["hausdorff", arg(&metres), arg(&other)]);
    let said = String::from_utf8_lossy(&bare.stderr);
    assert!(bare.status.success() && said.contains("a.off names no unit; taken as m"), "{said}");
    // The blob is in millimetres, and the mesh is read in metres.
    let output = run(["verify", arg(&first), arg(&metres)]);
    refused(&output, 3, "; was it built with --unit?");
    ok(["verify", arg(&first), arg(&metres), "--unit", "mm"]);
    let wrong = run(["build", arg(&other), "-o", "x", "--unit", "ell"]);
    let line = String::from_utf8_lossy(&wrong.stderr);
    assert!(wrong.status.code() == Some(2) && line.contains("one of um, mm, cm"), "{line}");
}

/// A grid of strips, and the same triangles as faces.
#[test]
fn the_blob_of_strips_is_that_of_their_triangles() {
    let directory = scratch("strips");
    let (rows, columns) = (40, 30);
    let mut header = format!(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\n\
         property float z\n",
        (rows + 1) * columns
    );
    let mut points = String::new();
    for (row, column) in (0..=rows).flat_map(|row| (0..columns).map(move |column| (row, column))) {
        writeln!(points, "{row} {column} {}", (row * row + 3 * column) % 7).unwrap();
    }
    let (mut strip, mut faces) = (Vec::new(), String::new());
    for row in 0..rows {
        let at = |down: i32, column: i32| (row + down) * columns + column;
        for column in 0..columns {
            strip.extend([at(0, column), at(1, column)]);
            if column + 1 < columns {
                let [a, b, c, d] =
                    [at(0, column), at(1, column), at(0, column + 1), at(1, column + 1)];
                writeln!(faces, "3 {a} {b} {c}\n3 {b} {d} {c}").unwrap();
            }
        }
        strip.push(-1);
    }
    let words: Vec<String> = strip.iter().map(i32::to_string).collect();
    let list = "property list int int vertex_indices\nend_header\n";
    let text =
        format!("{header}element tristrips 1\n{list}{points}{} {}\n", strip.len(), words.join(" "));
    let strips = file(&directory, "strips.ply", &text);
    writeln!(header, "element face {}", 2 * rows * (columns - 1)).unwrap();
    let faces = file(&directory, "faces.ply", &format!("{header}{list}{points}{faces}"));
    let blob = |mesh: &Path, name: &str| {
        let out = directory.join(name);
        ok(["build", arg(mesh), "-o", arg(&out)]);
        fs::read(out).unwrap()
    };
    assert!(blob(&strips, "a.msw") == blob(&faces, "b.msw"));
}
