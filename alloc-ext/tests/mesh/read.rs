//! Reading mesh files: what is understood, and what is refused with which place.

use std::path::Path;

use meshsweep::mesh::{MeshError, RawMesh, read, read_bytes, repair};

fn parse(name: &str, bytes: impl Into<Vec<u8>>) -> Result<RawMesh, MeshError> {
    read_bytes(Path::new(name), bytes.into())
}

fn ply(format: &str, scalar: &str, list: &str, body: &[u8]) -> Vec<u8> {
    let header = format!(
        "ply\nformat {format} 1.0\ncomment made by hand\nelement vertex 4\nproperty {scalar} x\n\
         property {scalar} y\n\
         property {scalar} z\nelement face 1\nproperty list {list} vertex_indices\nend_header\n"
    );
    [header.as_bytes(), body].concat()
}

const SQUARE: [[f64; 3]; 4] = [[0.0, 0.0, 0.5], [1.0, 0.0, 0.5], [1.0, 1.0, 0.5], [0.0, 1.0, 0.5]];

#[test]
fn ascii_ply_with_polygons_is_fan_triangulated_in_file_order() {
    let body = b"0 0 0.5\n1 0 0.5\n\n1 1 0.5\n0 1 0.5\n4 0 1 2 3";
    let raw = parse("a.ply", ply("ascii", "double", "uchar int", body)).unwrap();
    assert_eq!(raw.positions, SQUARE);
    assert_eq!(raw.triangles, [[0, 1, 2], [0, 2, 3]]);
}

#[test]
fn binary_ply_of_both_byte_orders_and_all_index_types_reads_the_same() {
    let mut little = Vec::new();
    let mut big = Vec::new();
    for x in SQUARE.iter().flatten() {
        little.extend(x.to_le_bytes());
        big.extend((*x as f32).to_be_bytes());
    }
    little.extend([4, 0, 0, 1, 0, 2, 0, 3, 0]);
    let mut little = ply("binary_little_endian", "double", "uchar ushort", &little);
    big.extend([0, 4, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3]);
    let big = ply("binary_big_endian", "float", "ushort uint", &big);
    for bytes in [little.clone(), big] {
        let raw = parse("a.PLY", bytes).unwrap();
        assert_eq!((raw.positions, raw.triangles), (SQUARE.to_vec(), vec![[0, 1, 2], [0, 2, 3]]));
    }
    little.truncate(little.len() - 3);
    assert!(matches!(
        parse("a.ply", little),
        Err(MeshError::Truncated { found: 0, wanted: 1, .. })
    ));
}

#[test]
fn truncated_ply_is_refused_with_place() {
    let body = b"0 0 0\n1 0 0\n1 1 0\n";
    let error = parse("cut.ply", ply("ascii", "float", "uchar int", body)).unwrap_err();
    assert_eq!(
        error.to_string(),
        "cut.ply: the file ends at vertex 3 of 4; copy or export it again"
    );
}

#[test]
fn header_announcing_more_than_the_file_can_hold_is_refused_before_reading() {
    let header = "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\n\
        property float x\n\
        property float y\nproperty float z\nend_header\n0123456789ab0123456789ab";
    let error = parse("lie.ply", header).unwrap_err();
    assert!(
        matches!(error, MeshError::Truncated { wanted: 4_000_000_000, found: 2, .. }),
        "{error}"
    );
}

#[test]
fn no_line_of_an_obj_hides_another() {
    let body = "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\np 1\nf 1 2\nf 1 \\\n2 3\nf 1 2 3 \\";
    for begin in ["", "# C:\\parts\\\n", "\u{FEFF}", "vt 0 0 # 1 \\\n"] {
        let raw = parse("a.obj", format!("{begin}{body}")).unwrap();
        assert_eq!((raw.positions.len(), raw.triangles.len()), (3, 2), "{begin}");
        let left_out = raw.left_out;
        assert_eq!((left_out.lines_and_points, left_out.small_faces.count), (2, 1));
    }
}

#[test]
fn bytes_after_the_announced_end_are_counted() {
    let text = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\nthe end\n\n";
    let mut stl = [vec![0; 80], 1u32.to_le_bytes().to_vec(), vec![0; 50]].concat();
    stl[96..100].copy_from_slice(&1f32.to_le_bytes());
    stl.extend([7; 9]);
    let off = format!("OFF\n4 1 0\n{text}");
    for (name, bytes, left) in [
        ("a.ply", ply("ascii", "float", "uchar int", text.as_bytes()), 7),
        ("a.off", off.into_bytes(), 7),
        ("a.stl", stl, 9),
    ] {
        let raw = parse(name, bytes).unwrap();
        assert_eq!((raw.triangles.len(), raw.left_out.bytes_after_end), (1, left), "{name}");
    }
}

#[test]
fn names_that_are_there_twice_in_a_ply_are_refused() {
    let whole = ply("ascii", "float", "uchar int", b"0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n");
    let whole = String::from_utf8(whole).unwrap();
    let list = "property list uchar int vertex_indices\n";
    let another = list.replace("indices", "index");
    for (line, twice, why) in [
        ("property float y\n", "property float y\nproperty float x\n", "x is there twice"),
        (list, &format!("{list}element face 0\n{list}"), "face is there twice"),
        (list, &format!("{list}{another}"), "face needs one list vertex_indices"),
    ] {
        let error = parse("a.ply", whole.replacen(line, twice, 1)).unwrap_err().to_string();
        assert!(error.contains(why), "{error}");
    }
}

#[test]
fn unknown_ply_elements_and_properties_are_skipped() {
    let text = "ply\nformat ascii 1.0\nelement camera 1\nproperty list uchar float pose\n\
        element vertex 3\n\
        property uchar red\nproperty float x\nproperty float y\nproperty float z\n\
        element face 1\n\
        property float quality\nproperty list uchar int vertex_index\nelement edge 1\n\
        property int a\n\
        end_header\n2 0.5 0.5\n9 0 0 0\n9 1 0 0\n9 0 1 0\n0.25 3 2 1 0\n7\n";
    let raw = parse("a.ply", text).unwrap();
    assert_eq!(raw.triangles, [[2, 1, 0]]);
    assert_eq!(raw.positions[1], [1.0, 0.0, 0.0]);
}

#[test]
fn ply_face_with_negative_index_is_refused_with_line() {
    let error = parse(
        "n.ply",
        ply("ascii", "float", "uchar int", b"0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 -2\n"),
    )
    .unwrap_err();
    let wanted = MeshError::IndexOutOfRange {
        file: "n.ply".into(),
        line: Some(15),
        face: 0,
        index: -2,
        vertex_count: 4,
    };
    assert_eq!(error, wanted);
}

#[test]
fn ply_without_z_is_refused() {
    let text = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n\
        end_header\n0 0\n";
    assert!(matches!(parse("a.ply", text), Err(MeshError::Malformed { .. })));
}

#[test]
fn obj_reads_relative_indices_slashes_comments_and_continued_lines() {
    let text = "# a square\nmtllib none.mtl\nv 0 0 0.5 # first\nv 1 0 0.5 1.0\nv 1 1 0.5\n\
        vn 0 0 1\no part\n\
        v 0 1 0.5\ng top\nf -4/1/1 -3//1 \\\n  3/2 4\nl 1 2\np 1\r\n";
    let raw = parse("a.obj", text).unwrap();
    assert_eq!(raw.positions, SQUARE);
    assert_eq!(raw.triangles, [[0, 1, 2], [0, 2, 3]]);
}

#[test]
fn obj_index_beyond_the_vertices_is_refused_with_line_and_number_as_written() {
    let error = parse("a.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n").unwrap_err();
    assert_eq!(
        error.to_string(),
        "a.obj, line 3: face 1 names vertex 3, but there are 2 vertices; remove or renumber the \
         face"
    );
    assert!(matches!(
        parse("a.obj", "v 0 0 0\nf 0 1 1\n"),
        Err(MeshError::IndexOutOfRange { index: 0, .. })
    ));
    assert!(matches!(
        parse("a.obj", "v 0 0 0\nf -2 1 1\n"),
        Err(MeshError::IndexOutOfRange { index: -2, .. })
    ));
}

#[test]
fn obj_face_may_name_vertices_that_follow_it() {
    assert!(parse("a.obj", "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n").is_ok());
}

#[test]
fn nan_is_refused_with_line_and_vertex() {
    let error = parse("a.obj", "v 0 0 0\nv 1 NaN 0\nv 0 1 0\nf 1 2 3\n").unwrap_err();
    assert!(matches!(error, MeshError::NotFinite { line: Some(2), vertex: 2, .. }), "{error}");
}

const FACET: &str =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";

#[test]
fn ascii_stl_with_several_solids_is_read_whole() {
    let text = format!("solid one\n{FACET}endsolid one\nsolid\n{FACET}{FACET}endsolid\n");
    assert_eq!(parse("a.stl", text).unwrap().triangles.len(), 3);
}

#[test]
fn ascii_stl_in_upper_case_and_indented_is_read() {
    let text = format!("  SOLID X\n{}ENDSOLID X\n", FACET.to_uppercase());
    assert_eq!(parse("a.STL", text).unwrap().triangles.len(), 1);
}

#[test]
fn ascii_stl_that_ends_inside_a_facet_is_refused_with_place() {
    let text = format!("solid\n{FACET}facet normal 0 0 1\nouter loop\nvertex 0 0 0\n");
    let error = parse("a.stl", text).unwrap_err();
    assert!(matches!(&error, MeshError::Malformed { place, .. } if place == "facet 1"), "{error}");
}

#[test]
fn binary_stl_whose_header_starts_with_solid_is_taken_for_binary() {
    let mut bytes = vec![b' '; 80];
    bytes[..10].copy_from_slice(b"solid part");
    bytes.extend(1u32.to_le_bytes());
    for x in [0.0f32, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0] {
        bytes.extend(x.to_le_bytes());
    }
    bytes.extend([0; 2]);
    let raw = parse("a.stl", bytes).unwrap();
    assert_eq!(raw.positions, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
}

#[test]
fn unknown_extension_and_missing_file_are_refused_by_name() {
    assert!(matches!(parse("mesh.step", ""), Err(MeshError::UnknownExtension { .. })));
    assert!(matches!(parse("mesh", ""), Err(MeshError::UnknownExtension { .. })));
    let error = read(Path::new("no/such/file.ply")).unwrap_err();
    assert!(error.to_string().starts_with("no/such/file.ply: "), "{error}");
}

#[test]
fn rounding_is_zero_for_exact_coordinates_and_bounds_the_move_of_others() {
    let exact =
        RawMesh::from_f32(&[[0.1, 0.2, 0.3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], &[[0, 1, 2]]);
    assert_eq!(repair(exact).unwrap().0.rounding, 0.0);

    let positions = [[0.1, 0.2, 0.3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let rounding =
        repair(RawMesh::from_f64(positions.to_vec(), vec![[0, 1, 2]])).unwrap().0.rounding;
    let moved: f64 =
        positions[0].iter().map(|x| (x - f64::from(*x as f32)).powi(2)).sum::<f64>().sqrt();
    assert!(rounding >= moved && rounding <= moved * (1.0 + 1e-12), "{rounding:e} {moved:e}");
}

#[test]
fn rounding_of_decimal_text_includes_the_step_to_f64() {
    let text = "v 0.1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let rounding = repair(parse("a.obj", text).unwrap()).unwrap().0.rounding;
    // 0.1 − fl32(0.1), from the decimal expansion 0.100000001490116119384765625.
    assert!(rounding >= 1.490_116_119_384_765_6e-9, "{rounding:e}");
}

#[test]
fn rounding_survives_underflow_of_squares() {
    let tiny = 1e-200;
    let positions = vec![[0.0, 0.0, tiny], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let rounding = repair(RawMesh::from_f64(positions, vec![[0, 1, 2]])).unwrap().0.rounding;
    assert!(rounding >= tiny && rounding < 1.01 * tiny);
}

#[test]
fn coordinates_beyond_f32_or_wholly_below_its_normal_range_are_refused_by_name() {
    let scaled = |s: f64| {
        let positions = vec![[0.0; 3], [s, 0.0, 0.0], [0.0, s, 0.0]];
        repair(RawMesh::from_f64(positions, vec![[0, 1, 2]])).map(|(mesh, _)| mesh.positions.len())
    };
    assert!(matches!(scaled(3.5e38), Err(MeshError::TooLarge { vertex: 1, .. })));
    assert!(matches!(scaled(1e-38), Err(MeshError::TooSmall { .. })));
    assert_eq!(scaled(3.4e38), Ok(3));
    assert_eq!(scaled(1.2e-38), Ok(3));
}

#[test]
fn faces_of_more_than_three_corners_are_counted() {
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    let raw = parse("a.obj", format!("{square}f 1 2 3 4\nf 1 2 3\nf 1 2\n")).unwrap();
    assert_eq!((raw.polygons.split, raw.triangles.len()), (1, 3));
    let raw = parse(
        "a.ply",
        ply("ascii", "float", "uchar int", b"0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"),
    )
    .unwrap();
    assert_eq!(raw.polygons.split, 1);
    let facet = FACET.replace("endloop", "vertex -1 1 0\nendloop");
    let raw = parse("a.stl", format!("solid\n{FACET}{facet}endsolid\n")).unwrap();
    assert_eq!((raw.polygons.split, raw.triangles.len()), (1, 3));
}
