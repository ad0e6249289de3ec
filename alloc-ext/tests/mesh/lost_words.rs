//! OFF and PLY of which a word or a line is lost, or whose counts are wrong: all that follows would
//! shift.

use meshsweep::mesh::{MeshError, RawMesh, read_bytes};
use std::path::Path;

fn parse(name: &str, text: &str) -> Result<RawMesh, MeshError> {
    read_bytes(Path::new(name), text.into())
}

const VERTICES: [&str; 8] =
    ["0 0 0", "2 0 0", "2 1 0", "0 1 0", "0 0 3", "2 0 3", "2 1 3", "0 1 3"];
const QUADS: [&str; 6] =
    ["4 0 3 2 1", "4 4 5 6 7", "4 0 1 5 4", "4 1 2 6 5", "4 2 3 7 6", "4 3 0 4 7"];
const TRIANGLES: [&str; 12] = [
    "3 0 3 2", "3 0 2 1", "3 4 5 6", "3 4 6 7", "3 0 1 5", "3 0 5 4", "3 1 2 6", "3 1 6 5",
    "3 2 3 7", "3 2 7 6", "3 3 0 4", "3 3 4 7",
];

/// A cuboid of so many announced vertices and faces, with the lines given.
fn file(kind: &str, [vertices, faces]: [usize; 2], body: &[String]) -> String {
    let body = body.join("\n");
    match kind {
        "off" => format!("OFF\n{vertices} {faces} 0\n{body}\n"),
        _ => format!(
            "ply\nformat ascii 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\n\
             property float z\nelement face {faces}\nproperty list uchar int vertex_indices\n\
             end_header\n{body}\n"
        ),
    }
}

/// Whether the lines are those of a file without a flaw, perhaps with a face of two corners, which
/// the report names: then nothing tells that a word is lost.
fn is_right(lines: &[String]) -> bool {
    let (vertices, faces) = lines.split_at(8);
    let faces = faces.iter().map(|face| face.split(' ').collect::<Vec<_>>());
    vertices.iter().all(|line| line.split(' ').count() == 3)
        && faces.into_iter().all(|words| {
            words.len() > 2 && words[0].parse::<usize>().is_ok_and(|size| size + 1 == words.len())
        })
}

#[test]
fn a_cuboid_with_a_word_or_a_line_lost_or_doubled_or_wrong_counts_is_refused_with_the_place() {
    let mut mutations = 0;
    for kind in ["off", "ply"] {
        for faces in [&QUADS[..], &TRIANGLES] {
            let lines: Vec<String> =
                VERTICES.iter().chain(faces).map(|line| (*line).to_owned()).collect();
            let counts = [8, faces.len()];
            let name = format!("a.{kind}");
            assert!(parse(&name, &file(kind, counts, &lines)).is_ok());
            let mut refused = |counts: [usize; 2], lines: &[String]| {
                mutations += 1;
                let text = file(kind, counts, lines);
                let error = parse(&name, &text).map(|raw| raw.left_out).expect_err(&text);
                let said = error.to_string();
                let names_the_end = said.contains("the file ends at ");
                assert!(said.contains(", line ") || names_the_end, "{said}\n{text}");
            };
            for (i, line) in lines.iter().enumerate() {
                let mut other = lines.clone();
                other.remove(i);
                refused(counts, &other);
                other.insert(i, line.clone());
                other.insert(i, line.clone());
                refused(counts, &other);
                let words: Vec<&str> = line.split(' ').collect();
                for k in 0..words.len() {
                    let mut left = words.clone();
                    left.remove(k);
                    let mut other = lines.clone();
                    other[i] = left.join(" ");
                    if !is_right(&other) {
                        refused(counts, &other);
                    }
                }
            }
            let [vertices, faces] = counts;
            for off in [1, 2] {
                for counts in [
                    [vertices - off, faces],
                    [vertices + off, faces],
                    [vertices, faces - off],
                    [vertices, faces + off],
                ] {
                    refused(counts, &lines);
                }
            }
        }
    }
    assert!(mutations >= 400, "{mutations}");
}

#[test]
fn lost_words_are_named_where_they_are() {
    let with = |counts, from: &str, to: &str| {
        let lines: Vec<String> =
            VERTICES.iter().chain(&QUADS).map(|l| l.replace(from, to)).collect();
        parse("a.off", &file("off", counts, &lines)).unwrap_err().to_string()
    };
    for (counts, from, to, wanted) in [
        ([8, 6], "4 2 3 7 6", "4 2 3 7", "line 15: face 4: 3 of 4 corners are there"),
        ([8, 6], "2 0 0", "2 0", "line 4: vertex 1: fewer than three coordinates"),
        (
            [8, 6],
            "4 0 3 2 1",
            "0 3 2 1",
            "line 11: face 0: fewer than three corners, and 3 numbers after",
        ),
        (
            [10, 6],
            "",
            "",
            "line 11: vertex 8: 2 numbers after its place, and 0 after that of vertex 0",
        ),
        ([8, 6], "1 3", "1 1 3", "line 9: vertex 6: 1 number after its place, and 0 after"),
        ([8, 5], "", "", "line 16: the header: numbers follow its last element"),
        ([7, 6], "", "", "line 10: face 0: fewer than three corners"),
    ] {
        let error = with(counts, from, to);
        assert!(error.contains(wanted), "{error}");
    }
}

#[test]
fn layouts_without_lines_and_faces_of_several_lines_are_read() {
    let lines: Vec<String> = VERTICES.iter().chain(&QUADS).map(|line| (*line).to_owned()).collect();
    let words: Vec<String> = lines.join(" ").split(' ').map(str::to_owned).collect();
    let wrapped = |most: usize| words.chunks(most).map(|words| words.join(" ")).collect();
    let broken = lines.iter().map(|line| line.replace("4 2 3 7 6", "4 2 3\n7 6")).collect();
    let blocks = vec![lines[..8].join("\n"), lines[8..].join(" ")];
    let layouts: [Vec<String>; 6] =
        [wrapped(1), wrapped(8), wrapped(19), wrapped(1000), broken, blocks];
    for kind in ["off", "ply"] {
        let name = format!("a.{kind}");
        let whole = parse(&name, &file(kind, [8, 6], &lines)).unwrap();
        for layout in &layouts {
            let raw = parse(&name, &file(kind, [8, 6], layout)).unwrap_or_else(|e| panic!("{e}"));
            assert_eq!(raw, whole);
        }
    }
}

#[test]
fn numbers_that_no_keyword_announces_are_named() {
    let lines: Vec<String> = VERTICES
        .iter()
        .map(|line| format!("{line} 9 9"))
        .chain(QUADS.iter().map(|line| (*line).to_owned()))
        .collect();
    let text = file("off", [8, 6], &lines);
    let raw = parse("a.off", &text).unwrap();
    let said = raw.left_out.remarks[0].to_string();
    let wanted = "8 lines with more values than the keyword says, which are left out: line 3 …";
    assert_eq!((said.as_str(), raw.left_out.remarks.len()), (wanted, 1));
    assert!(parse("a.off", &text.replace("OFF", "COFF")).unwrap().left_out.remarks.is_empty());
}

#[test]
fn numbers_beyond_f64_are_called_too_large() {
    let facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 1e400\n";
    for (name, text) in [
        ("a.obj", "v 0 0 1e400\n".to_owned()),
        ("a.off", "OFF\n1 1 0\n0 0 1e400\n".to_owned()),
        ("a.ply", file("ply", [1, 0], &["0 0 1e400".to_owned()])),
        ("a.stl", format!("solid\n{facet}")),
    ] {
        let error = parse(name, &text).unwrap_err().to_string();
        assert!(error.contains("\"1e400\" is too large a number"), "{error}");
    }
}

#[test]
fn a_bad_value_of_a_binary_ply_is_no_cut_file() {
    let mut bytes = b"ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\n\
        property float y\nproperty float z\nelement face 1\n\
        property list int int vertex_indices\nend_header\n"
        .to_vec();
    bytes.extend([0; 12]);
    bytes.extend((-5i32).to_le_bytes());
    let error = read_bytes(Path::new("a.ply"), bytes).unwrap_err().to_string();
    assert!(error.contains("face 0: a list cannot have -5 values"), "{error}");
}
