//! `meshsweep cull` against the normals of the mesh file.

use crate::support::{
    Point, Triangle, arg, ascent, blob, fixture, info, ok, parse_csv, run, scratch, triangles,
};
use std::fs;
use std::path::Path;

const EYES: [Point; 4] =
    [[100.0, -50.0, 30.0], [0.5, 0.25, 0.125], [-3.0, 0.0, 0.0], [1e6, 1e6, -1e6]];

/// The triangles that are listed, which must rise.
fn listed(blob: &Path, options: &[&str]) -> Vec<usize> {
    let rows = parse_csv(&ok([&["cull", arg(blob)], options].concat()), "triangle");
    let numbers: Vec<usize> = rows.iter().map(|row| row[0].parse().unwrap()).collect();
    assert!(numbers.is_sorted_by(|a, b| a < b), "each once, rising");
    numbers
}

fn text(point: Point) -> String {
    point.map(|x| x.to_string()).join(",")
}

/// Whether the triangle shows its front to a viewpoint.
fn faces(eye: Point, triangle: Triangle) -> bool {
    ascent(eye, triangle[0], triangle) < 0.0
}

#[test]
fn every_triangle_that_faces_the_viewpoint_is_listed_and_many_others_are_not() {
    let directory = scratch("cull");
    for name in ["bracket.stl", "torus.ply", "evil/open_box.stl", "evil/moebius.obj"] {
        let mesh = triangles(&fixture(name));
        let path = blob(&directory, name, &["--for", "cull", "--vertex-bits", "32"]);
        for eye in EYES {
            let listed = listed(&path, &[&text(eye)]);
            for (number, &triangle) in mesh.iter().enumerate() {
                let is_listed = listed.binary_search(&number).is_ok();
                assert!(is_listed || !faces(eye, triangle), "{name} {eye:?} {number}");
            }
            let fronts = mesh.iter().filter(|&&triangle| faces(eye, triangle)).count();
            assert!(fronts <= listed.len() && listed.len() <= mesh.len());
            if name == "torus.ply" && eye[0] > 50.0 {
                assert!(
                    listed.len() < mesh.len() * 3 / 4,
                    "{} of {}, {fronts}",
                    listed.len(),
                    mesh.len()
                );
            }
        }
    }
}

#[test]
fn within_a_room_whose_walls_face_inwards_every_wall_is_listed_and_met_from_its_front() {
    let directory = scratch("cull_room");
    for bits in ["16", "32"] {
        let options = ["--for", "closest,segment,cull", "--vertex-bits", bits];
        let path = blob(&directory, "evil/room.obj", &options);
        assert_eq!(listed(&path, &["5,5.5,5.2"]).len(), 12);
        let met = |facing| {
            let beam = "5,5.5,5.2,15,5.5,5.2";
            let text = ok(["segment", arg(&path), beam, "--facing", facing]);
            let rows = parse_csv(&text, "hit,t,px,py,pz,triangle,work");
            [0, 1, 5].map(|column| rows[0][column].clone())
        };
        assert_eq!(met("front"), ["yes", "0.5", "11"]);
        assert_eq!(met("back"), ["no", "", ""]);
        let side = ok(["signed", arg(&path), "5,5.5,5.2"]);
        assert!(side.contains(",inside,"), "{side}");
    }
}

#[test]
fn parallel_sight_is_that_of_an_eye_far_away() {
    let directory = scratch("cull_along");
    let mesh = triangles(&fixture("torus.ply"));
    let path = blob(&directory, "torus.ply", &["--for", "closest,cull", "--vertex-bits", "32"]);
    for along in [[0.0, 0.0, -1.0], [-3.0, 2.0, 0.5]] {
        let listed = listed(&path, &["--along", &text(along)]);
        for (number, &triangle) in mesh.iter().enumerate() {
            let faces = ascent([0.0; 3], along, triangle) < 0.0;
            assert!(listed.binary_search(&number).is_ok() || !faces, "{along:?} {number}");
        }
        assert!(listed.len() < mesh.len() * 3 / 4);
    }
    assert_eq!(run(["cull", arg(&path), "--along", "0,0,0"]).status.code(), Some(2));
}

#[test]
fn cones_are_written_only_for_culling_and_the_note_adds_up() {
    let directory = scratch("cull_note");
    let path = blob(&directory, "torus.ply", &["--for", "closest,segment,cull"]);
    let said = info(&path);
    assert!(said["serves"].as_array().unwrap().iter().any(|question| question == "cull"));
    let bounds = said["tree"]["bounds"].as_array().unwrap();
    assert!(bounds.iter().any(|bound| bound == "normal cones"), "{bounds:?}");
    let out = directory.join("out.csv");
    let output = run(["cull", arg(&path), "-10,0,3", "-o", arg(&out)]);
    assert!(output.status.success() && output.stdout.is_empty());
    let note = String::from_utf8(output.stderr).unwrap();
    let culled: usize = note.split(' ').next().unwrap().parse().unwrap();
    let listed = parse_csv(&fs::read_to_string(&out).unwrap(), "triangle").len();
    assert_eq!(culled + listed, triangles(&fixture("torus.ply")).len(), "{note}");
    let without = info(&blob(&directory, "torus.ply", &[]));
    assert!(!without["serves"].as_array().unwrap().iter().any(|question| question == "cull"));
}
