//! The committed fixtures: up to date, and each with the outcome that its README names.

use std::path::{Path, PathBuf};

use meshsweep::mesh::{MeshError, load_closed, read, read_bytes, repair};
use meshsweep_host_tests::generate::evil::{Outcome, evil};
use meshsweep_host_tests::generate::fixtures::files;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../fixtures")
}

#[test]
fn committed_fixtures_are_what_the_generators_make() {
    for (name, bytes) in files() {
        let committed = std::fs::read(folder().join(&name)).unwrap_or_default();
        assert!(committed == bytes, "fixtures/{name} is out of date: run `cargo xtask fixtures`");
    }
}

#[test]
fn every_evil_file_has_its_outcome() {
    for file in evil() {
        let result = read_bytes(Path::new(file.name), file.bytes).and_then(repair);
        let outcome = match result {
            Err(error) => Err((true, variant(&error))),
            Ok((mesh, report)) => meshsweep::mesh::require_closed_manifold(&mesh)
                .map_err(|error| (false, variant(&report.explain(error)))),
        };
        let wanted = match file.outcome {
            Outcome::Accepted => Ok(()),
            Outcome::Unreadable(name) => Err((true, name.to_owned())),
            Outcome::NoSolid(name) => Err((false, name.to_owned())),
        };
        assert_eq!(outcome, wanted, "{}", file.name);
    }
}

#[test]
fn every_message_names_the_file_and_ends_in_a_remedy() {
    for file in evil() {
        if let Err(error) = read_bytes(Path::new(file.name), file.bytes).and_then(repair) {
            let message = error.to_string();
            assert!(message.starts_with(file.name) && message.contains("; "), "{message}");
            assert!(!message.contains('\n'), "{message}");
        }
    }
}

/// What is said of files that programs write against the letter of their format.
const SAID: [(&str, &str); 31] = [
    ("cut_facet.stl", "facet 11: the file ends without endsolid"),
    ("several_loops.stl", "facet 0: a facet of several loops, or of a hole"),
    ("decimal_comma.stl", "\"1,0\" has a comma; numbers are written with a point"),
    ("lying_attributes.stl", "the attributes that they announce do not have the 732 bytes"),
    ("more_triangles.stl", "the count: it is 5, and the file has 12 triangles"),
    ("solid_short.stl", "the file ends at triangle 11 of 12"),
    ("two_files.stl", "another binary STL file follows after triangle 12"),
    ("zero_count.stl", "the count: it is 0, and 600 bytes follow, as of 12 triangles"),
    ("attributes.stl", "12 triangles with attributes, which are left out: triangle 0, 4 bytes …"),
    ("solid_trailing.stl", "2 bytes after the announced end of the file left out"),
    ("other_lists.ply", "element cell, which has lists of vertices, is not read"),
    ("statement.ply", "line 4: the header: \"propertie float w\" is no statement of PLY"),
    ("binary.off", "the binary form of OFF is not read"),
    ("call.obj", "1 statement call (another file) left out: line 21"),
    ("call.obj", "1 statement csh (a command) left out: line 22"),
    ("call.obj", "1 statement curv (a free-form curve) left out: line 23"),
    ("call.obj", "1 statement of unknown name left out: line 24, \"quux\""),
    ("fo.obj", "12 statements fo read as f: line 9 …"),
    ("surf.obj", "1 statement surf (a free-form surface) left out: line 23"),
    ("misspelt.obj", "line 1: statement \"vv\": OBJ has none of this name; correct or remove it"),
    (
        "only_surf.obj",
        "no triangles that are read (1 statement surf (a free-form surface) left out",
    ),
    ("antenna.obj", "1 concave polygon split by ears"),
    ("support.3mf", "1 object of type \"support\" left out: item 1 of the build"),
    ("not_printed.3mf", "1 item not to be printed left out: item 1 of the build, object 2"),
    ("negative_range.3mf", "1 part of type \"NegativeVolume\" left out: item 0 of the build"),
    ("negative_part.3mf", "1 part of type \"negative_part\" left out: item 0 of the build"),
    ("quaternion.gltf", "node 0: its rotation is no unit quaternion, its length is 1.414214"),
    ("y_up.dae", "1 up_axis that turns nothing, coordinates stay as written: Y_UP"),
    ("skin.dae", "the skin in line 13, controller \"c\", is not read"),
    ("holes.dae", "a polygon with holes in line 11, ph of geometry \"g\", is not read"),
    ("lookat.dae", "the transform lookat in line 13, lookat of node \"m\", is not read"),
];

#[test]
fn parts_that_are_left_out_and_defects_are_named_with_their_place() {
    let mut others = Vec::new();
    for (name, wanted) in SAID {
        let file = evil().into_iter().find(|file| file.name == name).expect(name);
        let said = match read_bytes(Path::new(name), file.bytes).and_then(repair) {
            Ok((_, report)) => report.to_string(),
            Err(error) => error.to_string(),
        };
        if !said.contains(wanted) {
            others.push(said);
        }
    }
    assert!(others.is_empty(), "{}", others.join("\n"));
}

#[test]
fn files_that_programs_write_against_the_letter_have_all_triangles_of_the_mesh() {
    for file in evil().iter().filter(|file| file.outcome == Outcome::Accepted) {
        let wanted = match file.name {
            "scene.dae" | "utf_16.dae" | "y_up.dae" | "zeros.glb" => 24,
            "sparse.gltf" => 4,
            "bom.stl" | "color.stl" | "comment.stl" | "cr.stl" | "end_loop.stl"
            | "end_solid.stl" | "endsolid_name.stl" | "facet_a_line.stl" | "nul_padded.stl"
            | "utf_16.stl" | "attributes.stl" | "colors.stl" | "solid_trailing.stl" | "cr.ply"
            | "cr_binary.ply" | "ind.ply" | "nan.ply" | "one_line.ply" | "strings.ply"
            | "glued.off" | "many_lines.off" | "one_line.off" | "call.obj" | "cr.obj"
            | "fo.obj" | "surf.obj" | "utf_16.obj" | "support.3mf" | "not_printed.3mf"
            | "negative_range.3mf" | "negative_part.3mf" => 12,
            _ => continue,
        };
        let (mesh, _) =
            read_bytes(Path::new(file.name), file.bytes.clone()).and_then(repair).unwrap();
        assert_eq!(mesh.triangles.len(), wanted, "{}", file.name);
        let corners = mesh.positions.iter().flatten();
        // Cubes, moved aside in scenes.
        assert!(corners.clone().all(|x| x.abs() <= 20.0), "{}: {:?}", file.name, mesh.positions);
        assert!(corners.into_iter().any(|x| x.abs() >= 1.0), "{}", file.name);
    }
}

#[test]
fn good_fixtures_are_closed_manifolds_of_their_genus() {
    for (name, genus) in [("bracket.stl", 2), ("torus.ply", 1), ("groove.obj", 0)] {
        let (mesh, report) = load_closed(&folder().join(name)).unwrap();
        let (v, f) = (mesh.positions.len(), mesh.triangles.len());
        assert_eq!(v + 2 * genus, f / 2 + 2, "{name}");
        assert!(report.is_clean() && report.rounding == 0.0, "{name}: {report}");
        assert_eq!(read(&folder().join(name)).unwrap().triangles.len(), mesh.triangles.len());
    }
}

fn variant(error: &MeshError) -> String {
    let text = format!("{error:?}");
    text.split([' ', '{']).next().unwrap_or_default().to_owned()
}
