//! Strips, OFF and units; and one mesh in all formats.

use crate::scenes::{glb, gltf_of, model_of, threemf};
use meshsweep::mesh::{LeftOut, MeshError, RawMesh, Unit, read_bytes, repair};
use std::path::Path;

fn parse(name: &str, bytes: impl Into<Vec<u8>>) -> Result<RawMesh, MeshError> {
    read_bytes(Path::new(name), bytes.into())
}

/// A tetrahedron.
const POSITIONS: [[f32; 3]; 4] =
    [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
const TRIANGLES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

#[test]
fn one_mesh_in_all_formats_has_the_same_triangles() {
    let lines = |begin: &str, from: u32| {
        let at = POSITIONS.map(|[x, y, z]| format!("{x} {y} {z}\n")).concat();
        let faces = TRIANGLES.map(|t| {
            let [a, b, c] = t.map(|v| v + from);
            format!("{begin} {a} {b} {c}\n")
        });
        (at, faces.concat())
    };
    let (at, faces) = lines("3", 0);
    let header = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
    let ply = format!(
        "ply\nformat ascii 1.0\n{header}element face 4\nproperty list uchar int vertex_indices\n\
         end_header\n{at}{faces}"
    );
    let strip = format!(
        "ply\nformat ascii 1.0\n{header}element tristrips 1\n\
         property list int int vertex_indices\nend_header\n{at}\
         15 0 2 1 -1 0 1 3 -1 1 2 3 -1 2 0 3\n"
    );
    let obj = POSITIONS.map(|[x, y, z]| format!("v {x} {y} {z}\n")).concat() + &lines("f", 1).1;
    let corners = |[x, y, z]: [f32; 3]| format!("vertex {x} {y} {z}\n");
    let facet = |t: [u32; 3]| {
        let corners = t.map(|v| corners(POSITIONS[v as usize])).concat();
        format!("facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n")
    };
    let stl = format!("solid\n{}endsolid\n", TRIANGLES.map(facet).concat());
    let (json, binary) = gltf_of(&POSITIONS, &TRIANGLES.concat(), 4, "");
    let model = model_of(&POSITIONS, &TRIANGLES, r#"<item objectid="1"/>"#);
    let all: [(&str, Vec<u8>); 7] = [
        ("a.ply", ply.into()),
        ("b.ply", strip.into()),
        ("a.obj", obj.into()),
        ("a.stl", stl.into()),
        ("a.off", format!("OFF\n4 4 0\n{at}{faces}").into()),
        ("a.glb", glb(&json, &binary)),
        ("a.3mf", threemf(&model)),
    ];
    for (name, bytes) in all {
        let (mesh, report) = repair(parse(name, bytes).unwrap_or_else(|e| panic!("{e}"))).unwrap();
        assert!(report.is_clean() && mesh.rounding == 0.0, "{name} {report}");
        let found: Vec<_> = (0..4).filter_map(|t| mesh.corners(t)).collect();
        assert_eq!(found, TRIANGLES.map(|t| t.map(|v| POSITIONS[v as usize])), "{name}");
    }
}

/// Five vertices and a list of strips, in one of PLY's encodings.
fn strips(format: &str, lists: &[&[i32]]) -> Vec<u8> {
    let count = lists.len();
    let mut file = format!(
        "ply\nformat {format} 1.0\nelement vertex 5\nproperty float x\nproperty float y\n\
         property float z\nelement tristrips {count}\n\
         property list int int vertex_indices\nend_header\n"
    )
    .into_bytes();
    let at: Vec<[f32; 3]> = (0..5u8).map(|i| [i.into(), (i % 2).into(), 0.0]).collect();
    match format {
        "ascii" => {
            at.iter().for_each(|[x, y, z]| file.extend(format!("{x} {y} {z}\n").bytes()));
            for list in lists {
                let words: Vec<String> = list.iter().map(i32::to_string).collect();
                file.extend(format!("{} {}\n", list.len(), words.join(" ")).bytes());
            }
        }
        _ => {
            let big = format == "binary_big_endian";
            let turn = |bytes: [u8; 4]| if big { bytes } else { [3, 2, 1, 0].map(|i| bytes[i]) };
            at.iter().flatten().for_each(|x| file.extend(turn(x.to_be_bytes())));
            for list in lists {
                file.extend(turn((list.len() as u32).to_be_bytes()));
                list.iter().for_each(|v| file.extend(turn(v.to_be_bytes())));
            }
        }
    }
    file
}

#[test]
fn strips_of_all_encodings_turn_every_second_triangle_and_begin_anew_after_minus_one() {
    for format in ["ascii", "binary_little_endian", "binary_big_endian"] {
        let raw =
            parse("a.ply", strips(format, &[&[0, 1, 2, 3, -1, 2, 3, 4], &[4, 3, 2]])).unwrap();
        assert_eq!(raw.triangles, [[0, 1, 2], [1, 3, 2], [2, 3, 4], [4, 3, 2]], "{format}");
        assert_eq!(raw.left_out, LeftOut::default());
    }
}

#[test]
fn stitches_of_strips_are_counted_and_keep_the_winding() {
    // 0 1 2, then 2 2, which turns the winding, to 4 3 2.
    let raw = parse("a.ply", strips("ascii", &[&[0, 1, 2, 2, 4, 4, 3, 2]])).unwrap();
    assert_eq!((raw.triangles.clone(), raw.left_out.stitches), (vec![[0, 1, 2], [4, 2, 3]], 4));
    let (mesh, report) = repair(raw).unwrap();
    assert!(mesh.wires.is_empty() && !report.is_clean());
    assert!(report.to_string().contains("4 triangles with a repeated corner left out of strips"));
}

#[test]
fn strips_name_what_is_wrong_with_them() {
    let error = parse("a.ply", strips("ascii", &[&[0, 1, 2], &[0, 1, -2]])).unwrap_err();
    assert!(
        matches!(error, MeshError::IndexOutOfRange { line: Some(16), face: 1, index: -2, .. }),
        "{error}"
    );
    let mut bytes = strips("binary_little_endian", &[&[0, 1, 2]]);
    bytes.truncate(bytes.len() - 1);
    let error = parse("a.ply", bytes).unwrap_err().to_string();
    assert_eq!(error, "a.ply: the file ends at tristrips 0 of 1; copy or export it again");
}

#[test]
fn off_reads_variants_comments_polygons_and_colours() {
    let square = "0 0 0 9 9\n1 0 0 9 9 # corner\n1 1 0 9 9\n\n0 1 0 9 9\n";
    for head in ["OFF\n4 3 0\n", "# made\nCOFF 4 3 0\n", "STCNOFF\n\n4 3 4\n", "NOFF #\n4 3 1\n"] {
        let text = format!("{head}{square}4 0 1 2 3 255 0 0\n2 0 1\n3 2 1 0 0.5 0.5 0.5 1\n");
        let raw = parse("a.off", text).unwrap();
        assert_eq!(raw.triangles, [[0, 1, 2], [0, 2, 3], [2, 1, 0]], "{head}");
        assert_eq!((raw.polygons.split, raw.positions.len(), raw.decimal), (1, 4, true));
    }
}

#[test]
fn off_refusals_name_line_and_defect() {
    for (text, wanted) in [
        ("OFF BINARY\n", "a.off: the binary form of OFF is not read"),
        ("4OFF\n1 1 1\n", "a.off: 4OFF, of other than three dimensions, is not read"),
        ("4 3 0\n", "a.off, line 1: the header: no keyword OFF"),
        ("OFF\nfour\n", "a.off, line 2: the header: numbers of vertices and faces are wanted"),
        ("OFF\n2 0 0\n1 2 3\n", "a.off: the file ends at vertex 1 of 2"),
        ("OFF\n1 0 0\n1 2\n", "a.off, line 3: vertex 0: fewer than three coordinates"),
        ("OFF\n1 1 0\n1 2 3\n3 0 0 7\n", "a.off, line 4: face 0 names vertex 7, but there is 1"),
        ("OFF\n1 1 0\n1 2 3\n3 0 0\n", "a.off, line 4: face 0: 2 of 3 corners are there"),
        ("OFF\n1 2 0\n1 2 3\n3 0 0 0\n", "a.off: the file ends at face 1 of 2"),
        ("OFF\n99999999999 1 0\n1 2 3\n", "a.off: the file ends at vertex 1 of 99999999999"),
        ("OFF\n", "a.off, line 1: the header: it ends early"),
    ] {
        let error = parse("a.off", text).unwrap_err().to_string();
        assert!(error.starts_with(wanted), "{error}");
    }
}

#[test]
fn a_unit_scales_files_that_tell_theirs_and_the_error_bounds_what_moved() {
    let text = "v 0.1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let plain = parse("a.obj", text).unwrap();
    let named = plain.clone().in_unit(Unit::In).unwrap();
    assert_eq!(
        (&named.positions, named.unit, named.error),
        (&plain.positions, Some(Unit::In), 0.0)
    );
    let scaled = named.in_unit(Unit::Mm).unwrap();
    assert_eq!((scaled.unit, scaled.positions[1]), (Some(Unit::Mm), [25.4, 0.0, 0.0]));
    let rounding = repair(scaled).unwrap().0.rounding;
    // fl32(25.4) − 25.4, from its decimal expansion 25.3999996185302734375.
    assert!((3.814_697_265_625e-7..3.8148e-7).contains(&rounding), "{rounding:e}");
    let huge = RawMesh { unit: Some(Unit::M), ..RawMesh::from_f64(vec![[1e305; 3]], vec![]) };
    assert!(matches!(huge.in_unit(Unit::Um), Err(MeshError::TooLarge { vertex: 0, .. })));
}
