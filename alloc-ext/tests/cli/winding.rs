//! `meshsweep winding`, and `signed` and `field --signed` of meshes that are not closed.

use crate::support::{
    arg, blob, fixture, number, ok, parse_csv, random_queries, run, scratch, triangles, wide,
    write_csv,
};
use std::fmt::Write;
use std::fs;
use std::path::PathBuf;

/// The torus of the fixtures without every ninth triangle, as a mesh and as a blob with moments.
fn sieve(directory: &std::path::Path) -> [PathBuf; 2] {
    let mut text = String::new();
    let kept = triangles(&fixture("torus.ply")).into_iter().enumerate();
    for (number, corners) in kept.filter(|(number, _)| number % 9 != 4).map(|(_, t)| t).enumerate()
    {
        for [x, y, z] in corners {
            writeln!(text, "v {x} {y} {z}").unwrap();
        }
        let first = 3 * number + 1;
        writeln!(text, "f {first} {} {}", first + 1, first + 2).unwrap();
    }
    let (mesh, blob) = (directory.join("sieve.obj"), directory.join("sieve.msw"));
    fs::write(&mesh, text).unwrap();
    let said = ok(["build", arg(&mesh), "-o", arg(&blob), "--for", "closest,winding"]);
    assert!(said.contains("open: sides are those of the winding number"), "{said}");
    [mesh, blob]
}

/// How far inside of the torus a point is.
fn depth([x, y, z]: [f64; 3]) -> f64 {
    0.75 - (x.hypot(y) - 2.0).hypot(z)
}

#[test]
fn solids_that_share_walls_are_one_solid_and_have_a_depth() {
    let directory = scratch("winding_glued");
    for bits in ["16", "32"] {
        let options = ["--for", "closest,segment,winding", "--vertex-bits", bits];
        let path = blob(&directory, "evil/glued_blocks.obj", &options);
        let text = ok(["winding", arg(&path), "11.1,5,5", "10.5,5,5", "21.1,5,5", "--abs", "0.01"]);
        let rows = parse_csv(&text, "x,y,z,side,reason,lower,upper,work");
        let sides: Vec<&str> = rows.iter().map(|row| row[3].as_str()).collect();
        assert_eq!(sides, ["inside", "inside", "outside"]);
        assert!(rows[..2].iter().all(|row| number(&row[5]) <= 1.0 && 1.0 <= number(&row[6])));
        let files = [arg(&path), arg(&path)];
        let text =
            ok([&["clearance"], &files[..], &["--depth", "--pose", "20.5,0,0,1,0,0,0"]].concat());
        assert!(text.contains("overlap"), "{text}");
    }
}

#[test]
fn winding_and_signed_know_the_inside_of_a_mesh_with_holes() {
    let directory = scratch("winding");
    let [mesh, blob] = sieve(&directory);
    let points = directory.join("p.csv");
    let rows = random_queries::<3>(&triangles(&mesh), 300);
    write_csv(&points, &rows);
    let text = ok(["winding", arg(&blob), arg(&points), "--abs", "0.1"]);
    let answers = parse_csv(&text, "x,y,z,side,reason,lower,upper,work");
    let text = ok(["signed", arg(&blob), arg(&points)]);
    let signed = parse_csv(&text, "x,y,z,side,reason,lower,upper,px,py,pz,triangle,work");
    let mut inside = 0;
    for ((answer, signed), row) in answers.iter().zip(&signed).zip(&rows) {
        let depth = depth(wide(row));
        if depth.abs() < 0.25 {
            continue;
        }
        let side = if depth > 0.0 { "inside" } else { "outside" };
        assert_eq!((&*answer[3], &*answer[4]), (side, ""), "{answer:?}");
        assert_eq!((&*signed[3], &*signed[4]), (side, ""), "{signed:?}");
        assert!(number(&answer[6]) - number(&answer[5]) <= 0.1);
        assert_eq!(number(&signed[5]) < 0.0, depth > 0.0, "{signed:?}");
        inside += usize::from(depth > 0.0);
    }
    assert!(inside > 10, "{inside}");
}

#[test]
fn a_signed_field_of_a_mesh_with_holes_is_negative_inside() {
    let directory = scratch("winding_field");
    let [_, blob] = sieve(&directory);
    let out = directory.join("f.f32");
    ok(["field", arg(&blob), "-o", arg(&out), "--size", "9", "--margin", "0", "--signed"]);
    let bytes = fs::read(&out).unwrap();
    let values = bytes.as_chunks::<4>().0.iter().map(|&bytes| f32::from_le_bytes(bytes));
    let negative = values.filter(|value| *value < 0.0).count();
    assert!((50..500).contains(&negative), "{negative}");
}

#[test]
fn a_blob_without_moments_names_the_value_that_writes_them() {
    let directory = scratch("winding_refused");
    let blob = blob(&directory, "evil/open_box.stl", &[]);
    let refused = run(["winding", arg(&blob), "1,2,3"]);
    assert_eq!(refused.status.code(), Some(1));
    let said = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(said.contains("--for closest,segment,winding"), "{said}");
}

#[test]
fn an_open_part_that_faces_inwards_and_loose_triangles_are_said() {
    let directory = scratch("winding_said");
    let [mesh, blob] = sieve(&directory);
    let said = |mesh: &std::path::Path| {
        let asked = ["build", arg(mesh), "-o", arg(&blob), "--for", "winding"];
        String::from_utf8_lossy(&run(asked).stderr).into_owned()
    };
    assert!(!said(&mesh).contains("winding numbers"), "{}", said(&mesh));
    let text = fs::read_to_string(&mesh).unwrap();
    let reversed = directory.join("reversed.obj");
    let turned = text.lines().map(|line| match line.split(' ').collect::<Vec<_>>()[..] {
        ["f", a, b, c] => format!("f {c} {b} {a}\n"),
        _ => format!("{line}\n"),
    });
    fs::write(&reversed, turned.collect::<String>()).unwrap();
    assert!(said(&reversed).contains("the mesh faces inwards"), "{}", said(&reversed));
    let loose = directory.join("loose.obj");
    let mut number = 0.0;
    let apart = text.lines().map(|line| match line.split(' ').collect::<Vec<_>>()[..] {
        ["v", x, y, z] => {
            number += 1e-4;
            format!("v {} {y} {z}\n", x.parse::<f64>().unwrap() + number)
        }
        _ => format!("{line}\n"),
    });
    fs::write(&loose, apart.collect::<String>()).unwrap();
    assert!(said(&loose).contains("weld the vertices first"), "{}", said(&loose));
}

#[test]
fn a_blob_with_moments_unites_parts_that_overlap() {
    let directory = scratch("winding_united");
    let mut text = String::new();
    for (part, shift) in [0.0, 1.0].into_iter().enumerate() {
        for corners in triangles(&fixture("torus.ply")) {
            for [x, y, z] in corners {
                writeln!(text, "v {} {y} {z}", x + shift).unwrap();
            }
        }
        let each = triangles(&fixture("torus.ply")).len();
        for t in 0..each {
            let first = 3 * (part * each + t) + 1;
            writeln!(text, "f {first} {} {}", first + 1, first + 2).unwrap();
        }
    }
    let (mesh, blob) = (directory.join("two.obj"), directory.join("two.msw"));
    fs::write(&mesh, text).unwrap();
    let side = |serves: &str| {
        ok(["build", arg(&mesh), "-o", arg(&blob), "--for", serves]);
        let text = ok(["signed", arg(&blob), "2,0,0"]);
        text.lines().nth(1).unwrap().split(',').nth(3).unwrap().to_owned()
    };
    // The decimals are rounded to f32, where the two parts cross: the nearest triangle proves no
    // side.
    assert_eq!([side("closest"), side("closest,winding")], ["undecided", "inside"]);
}
