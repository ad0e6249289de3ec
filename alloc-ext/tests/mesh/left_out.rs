//! Parts of files that are left out or doubtful are named, and harmless ones are not refused.

use crate::scenes::{archive_of_bytes, glb, gltf_of, model_of, threemf};
use meshsweep::mesh::{MeshError, RawMesh, read_bytes};
use std::path::Path;

fn parse(name: &str, bytes: impl Into<Vec<u8>>) -> Result<RawMesh, MeshError> {
    read_bytes(Path::new(name), bytes.into())
}

fn said(raw: &RawMesh) -> Vec<String> {
    raw.left_out.remarks.iter().map(ToString::to_string).collect()
}

const TRIANGLE: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

fn gltf(more: &str) -> Result<RawMesh, MeshError> {
    let (json, binary) = gltf_of(&TRIANGLE, &[0, 1, 2], 4, more);
    parse("a.glb", glb(&json, &binary))
}

#[test]
fn gltf_nodes_and_meshes_that_no_scene_reaches_are_named() {
    let raw = gltf(r#","nodes":[{"mesh":0},{"mesh":0},{}],"scenes":[{"nodes":[0]}]"#).unwrap();
    let wanted = ["1 node with a mesh that no scene reaches left out: node 1, mesh 0"];
    assert_eq!((said(&raw), raw.triangles.len()), (wanted.map(str::to_owned).to_vec(), 1));
    let error = gltf(r#","nodes":[{"mesh":0}],"scenes":[{}]"#).unwrap_err().to_string();
    assert!(
        error.contains("(1 node with a mesh that no scene reaches left out: node 0"),
        "{error}"
    );
    let error = gltf(r#","nodes":[{}],"scenes":[{"nodes":[0]}]"#).unwrap_err().to_string();
    assert!(error.contains("(1 mesh that no node places left out: mesh 0)"), "{error}");
}

#[test]
fn gltf_without_scenes_is_its_nodes_or_its_meshes() {
    for more in [r#","nodes":[{"mesh":0}]"#, r#","nodes":[]"#, r#","scenes":[]"#] {
        let raw = gltf(more).unwrap();
        assert_eq!((raw.triangles.len(), said(&raw).len()), (1, 0), "{more}");
    }
    let cycle = r#","nodes":[{"mesh":0,"children":[1]},{"children":[0]}]"#;
    let error = gltf(cycle).unwrap_err().to_string();
    assert!(error.contains("node 0: it is its own ancestor"), "{error}");
}

#[test]
fn gltf_accessors_without_count_are_named() {
    let (json, binary) = gltf_of(&TRIANGLE, &[0, 1, 2], 4, "");
    let json = json.replacen(r#""type":"SCALAR","count":3"#, r#""type":"SCALAR""#, 1);
    let error = parse("a.glb", glb(&json, &binary)).unwrap_err().to_string();
    assert!(error.contains("accessor 1: it has no count"), "{error}");
}

#[test]
fn glb_bytes_after_its_length_and_wrong_lengths_are_named() {
    let (json, binary) = gltf_of(&TRIANGLE, &[0, 1, 2], 4, "");
    let whole = glb(&json, &binary);
    let raw = parse("a.glb", [&whole[..], &[7; 5]].concat()).unwrap();
    assert_eq!((raw.left_out.bytes_after_end, said(&raw).len()), (5, 0));
    for length in [13u32, whole.len() as u32 + 9] {
        let mut wrong = whole.clone();
        wrong[8..12].copy_from_slice(&length.to_le_bytes());
        let raw = parse("a.glb", wrong).unwrap();
        let wanted = format!(
            "1 length in the header that is not the file's: {length}, and the file has {} bytes",
            whole.len()
        );
        assert_eq!((said(&raw), raw.left_out.bytes_after_end), (vec![wanted], 0));
    }
}

#[test]
fn cut_gltf_and_other_texts_say_so_with_the_line_once() {
    let (json, _) = gltf_of(&TRIANGLE, &[0, 1, 2], 4, "");
    let error = parse("a.gltf", &json[..json.len() - 9]).unwrap_err().to_string();
    assert_eq!(error, "a.gltf, line 7: the JSON: it ends early; export the mesh again");
    let error = parse("a.gltf", "<html></html>").unwrap_err().to_string();
    assert_eq!(error, "a.gltf, line 1: the JSON: it is no object of JSON; export the mesh again");
    let error = parse("a.gltf", "{\"asset\": {\n1}}").unwrap_err().to_string();
    assert_eq!(
        error,
        "a.gltf, line 2: the JSON: key must be a string, column 1; export the mesh again"
    );
}

#[test]
fn threemf_objects_that_no_item_builds_are_named() {
    let model = model_of(&TRIANGLE, &[[0, 1, 2]], r#"<item objectid="1"/>"#);
    let other = r#"</object><object id="7"><components><component objectid="1"/></components>
        </object></resources>"#;
    let model = model.replacen("</object></resources>", other, 1);
    let raw = parse("a.3mf", threemf(&model)).unwrap();
    let wanted = "1 object that no item builds left out: 3D/3dmodel.model, object 7";
    assert_eq!(said(&raw), [wanted]);
}

#[test]
fn threemf_models_in_utf_16_are_read() {
    let model = model_of(&TRIANGLE, &[[0, 1, 2]], r#"<item objectid="1"/>"#);
    let model = format!("\u{FEFF}{model}").replacen("?>", " encoding=\"UTF-16\"?>", 1);
    for bytes in [u16::to_le_bytes, u16::to_be_bytes] {
        let text: Vec<u8> = model.encode_utf16().flat_map(bytes).collect();
        let raw = parse("a.3mf", archive_of_bytes(&[("3D/a.model", &text)])).unwrap();
        assert_eq!(raw.triangles, [[0, 1, 2]]);
    }
}

#[test]
fn texts_that_are_no_archive_or_cut_xml_say_so() {
    let error = parse("a.3mf", "<html></html>").unwrap_err().to_string();
    assert!(error.contains("the archive: it is no ZIP archive"), "{error}");
    let model = model_of(&TRIANGLE, &[[0, 1, 2]], r#"<item objectid="1"/>"#);
    for (at, after, wanted) in
        [(" unit=", 1, "a tag"), ("\"inch\"", 1, "a tag"), ("<build>", 0, "an element")]
    {
        let cut = &model[..model.find(at).unwrap() + after];
        let error = parse("a.3mf", threemf(cut)).unwrap_err().to_string();
        let wanted = format!("the file ends within {wanted}");
        assert!(error.contains(&wanted), "{error}");
    }
}

#[test]
fn a_binary_stl_of_more_triangles_and_a_byte_is_refused_as_without_it() {
    let mut bytes = [vec![0; 80], 1u32.to_le_bytes().to_vec(), vec![0; 150]].concat();
    for triangle in 0..3 {
        let corner = 84 + 50 * triangle + 12;
        bytes[corner..corner + 4].copy_from_slice(&1f32.to_le_bytes());
    }
    for padding in 0..4 {
        let error = parse("a.stl", [&bytes[..], &vec![0; padding]].concat()).unwrap_err();
        let error = error.to_string();
        assert!(error.contains("the count: it is 1, and the file has 3 triangles"), "{error}");
    }
}

#[test]
fn an_stl_normal_with_a_decimal_comma_is_named() {
    let text = "solid\nfacet normal 0,000 0,000 1,000\nouter loop\nvertex 0 0 0\n";
    let error = parse("a.stl", text).unwrap_err().to_string();
    assert!(error.contains("line 2: facet 0: \"0,000\" has a comma"), "{error}");
}

#[test]
fn a_name_of_an_obj_that_ends_with_a_backslash_hides_no_geometry() {
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    for name in ["usemtl steel \\", "g \\", "o part\\", "mtllib C:\\parts\\", "s 1 \\"] {
        let raw = parse("a.obj", format!("{name}\n{square}{name}\nf 1 2 3\nf 1 3 4\n")).unwrap();
        assert_eq!((raw.positions.len(), raw.triangles.len()), (4, 2), "{name}");
        let wanted = "2 lines with a \\ at the end not continued, for geometry follows: line 1 …";
        assert_eq!(said(&raw), [wanted]);
    }
    // Names may be continued.
    let raw = parse("a.obj", format!("{square}g one \\\ntwo\nf 1 2 \\\n3\n")).unwrap();
    assert_eq!((raw.triangles.len(), said(&raw).len()), (1, 0));
}

#[test]
fn weights_and_materials_in_an_obj_are_counted() {
    let text = "newmtl a\nKa 1 1 1\nKd 0.5 0.5 0.5\nKs 0 0 0\nNs 10 1\nNi 1.5\nd 1\nTr 0\nillum 2\n\
        map_Kd a.png\nvw 1 2\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let raw = parse("a.obj", text).unwrap();
    let wanted = [
        "10 statements of a material left out: line 1 …",
        "1 statement vw (a weight) left out: line 11",
    ];
    assert_eq!((said(&raw), raw.triangles.len()), (wanted.map(str::to_owned).to_vec(), 1));
}

#[test]
fn a_polygon_of_too_many_corners_is_called_so() {
    let count = 10_002;
    // A comb: every second corner is in.
    let at = |k: usize| {
        let angle = k as f64 * std::f64::consts::TAU / count as f64;
        let radius = if k.is_multiple_of(2) { 1.0 } else { 0.9 };
        format!("v {} {} 0\n", radius * angle.cos(), radius * angle.sin())
    };
    let corners: String = (1..=count).map(|k| format!(" {k}")).collect();
    let raw = parse("a.obj", (0..count).map(at).collect::<String>() + "f" + &corners).unwrap();
    assert_eq!((raw.polygons.too_large.count, raw.polygons.unsound.count), (1, 0));
    let (_, report) = meshsweep::mesh::repair(raw).unwrap();
    let wanted =
        "1 polygon not convex and of more than 10000 corners, split about its first corner";
    assert!(report.to_string().contains(wanted) && !report.is_clean(), "{report}");
}
