//! glTF and 3MF: copies in place, and what is refused by name.

use meshsweep::mesh::{MeshError, RawMesh, Unit, read, read_bytes};
use std::io::Write;
use std::path::Path;

fn parse(name: &str, bytes: impl Into<Vec<u8>>) -> Result<RawMesh, MeshError> {
    read_bytes(Path::new(name), bytes.into())
}

/// JSON of one mesh of one primitive in node 0, and its buffer. `more` are fields of the root; with
/// any, there are no nodes but those.
pub fn gltf_of(
    positions: &[[f32; 3]],
    corners: &[u32],
    mode: u32,
    more: &str,
) -> (String, Vec<u8>) {
    let mut buffer: Vec<u8> = positions.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    let begin = buffer.len();
    buffer.extend(corners.iter().flat_map(|v| (*v as u16).to_le_bytes()));
    buffer.resize(buffer.len().next_multiple_of(4), 0);
    let (vertices, count, bytes) = (positions.len(), corners.len(), buffer.len());
    let nodes =
        if more.is_empty() { r#","nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}]"# } else { more };
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":{bytes}}}],
        "bufferViews":[{{"buffer":0,"byteLength":{begin}}},
        {{"buffer":0,"byteOffset":{begin},"byteLength":{length}}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"type":"VEC3","count":{vertices}}},
        {{"bufferView":1,"componentType":5123,"type":"SCALAR","count":{count}}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1,"mode":{mode}}}]}}]
        {nodes}}}"#,
        length = 2 * count
    );
    (json, buffer)
}

pub fn glb(json: &str, binary: &[u8]) -> Vec<u8> {
    let json = format!("{json:<width$}", width = json.len().next_multiple_of(4));
    let chunk = |kind: &[u8; 4], content: &[u8]| {
        [&(content.len() as u32).to_le_bytes(), &kind[..], content].concat()
    };
    let chunks = [chunk(b"JSON", json.as_bytes()), chunk(b"BIN\0", binary)].concat();
    let length = 12 + chunks.len() as u32;
    [&b"glTF"[..], &2u32.to_le_bytes(), &length.to_le_bytes(), &chunks].concat()
}

const SPACE: &str = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";

/// A model in inches: object 1 is the mesh, and `build` lists items.
pub fn model_of(positions: &[[f32; 3]], triangles: &[[u32; 3]], build: &str) -> String {
    let vertices =
        positions.iter().map(|[x, y, z]| format!(r#"<vertex x="{x}" y="{y}" z="{z}"/>"#));
    let triangles =
        triangles.iter().map(|[a, b, c]| format!(r#"<triangle v1="{a}" v2="{b}" v3="{c}"/>"#));
    let (vertices, triangles) = (vertices.collect::<String>(), triangles.collect::<String>());
    format!(
        r#"<?xml version="1.0"?><model unit="inch" xmlns="{SPACE}"><resources>
        <object id="1"><mesh><vertices>{vertices}</vertices><triangles>{triangles}</triangles>
        </mesh></object></resources><build>{build}</build></model>"#
    )
}

/// An archive of one model.
pub fn threemf(model: &str) -> Vec<u8> {
    archive(&[("3D/3dmodel.model", model)])
}

/// An archive of models, the first being that of the package.
fn archive(models: &[(&str, &str)]) -> Vec<u8> {
    let models: Vec<_> = models.iter().map(|(name, text)| (*name, text.as_bytes())).collect();
    archive_of_bytes(&models)
}

/// As [`archive`], for models in any encoding.
pub fn archive_of_bytes(models: &[(&str, &[u8])]) -> Vec<u8> {
    let relationships = format!(
        r#"<Relationships><Relationship Id="r" Target="/{}"
        Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>"#,
        models[0].0
    );
    let mut bytes = Vec::new();
    let mut archive = rawzip::ZipArchiveWriter::new(&mut bytes);
    for (name, text) in [("_rels/.rels", relationships.as_bytes())].iter().chain(models) {
        let entry = archive.new_file(name);
        let (mut entry, config) =
            entry.compression_method(rawzip::CompressionMethod::DEFLATE).start().unwrap();
        let level = flate2::Compression::default();
        let mut writer = config.wrap(flate2::write::DeflateEncoder::new(&mut entry, level));
        writer.write_all(text).unwrap();
        let (encoder, descriptor) = writer.finish().unwrap();
        encoder.finish().unwrap();
        entry.finish(descriptor).unwrap();
    }
    archive.finish().unwrap();
    bytes
}

const TRIANGLE: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

/// Corners of all triangles, rounded to f32.
fn corners(raw: &RawMesh) -> Vec<[[f32; 3]; 3]> {
    let at = |v: u32| raw.positions[v as usize].map(|x| x as f32 + 0.0);
    raw.triangles.iter().map(|t| t.map(at)).collect()
}

#[test]
fn gltf_nodes_are_placed_by_their_ancestors_and_mirrors_keep_the_outside() {
    let half = 0.5f64.sqrt();
    // Node 1 turns by a quarter about z and doubles; its child steps along x. Node 2 mirrors x.
    let nodes = format!(
        r#","nodes":[{{"mesh":0,"translation":[3,0,0]}},
        {{"children":[0],"rotation":[0,0,{half},{half}],"scale":[2,2,2]}},
        {{"mesh":0,"matrix":[-1,0,0,0,0,1,0,0,0,0,1,0,0,0,5,1]}}],
        "scenes":[{{"nodes":[1]}},{{"nodes":[2,1]}}]"#
    );
    let (json, binary) = gltf_of(&TRIANGLE, &[0, 1, 2], 4, &nodes);
    let raw = parse("a.glb", glb(&json, &binary)).unwrap();
    let turned = [[0.0, 6.0, 0.0], [0.0, 8.0, 0.0], [-2.0, 6.0, 0.0]];
    let mirrored = [[0.0, 0.0, 5.0], [0.0, 1.0, 5.0], [-1.0, 0.0, 5.0]];
    let found = corners(&raw);
    let off = found[0].iter().flatten().zip(turned.iter().flatten());
    let off = off.map(|(a, b): (&f32, &f32)| f64::from((a - b).abs())).fold(0.0, f64::max);
    assert!(off <= 2.0 * raw.error && raw.error < 2e-13, "{found:?} {:e}", raw.error);
    assert_eq!((found[1], raw.unit, raw.decimal), (mirrored, Some(Unit::M), false));
}

#[test]
fn gltf_strips_fans_and_bare_vertices_are_read_and_lines_counted() {
    let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
    let of = |corners: &[u32], mode: u32| {
        let (json, binary) = gltf_of(&square, corners, mode, "");
        parse("a.glb", glb(&json, &binary))
    };
    let strip = of(&[0, 1, 2, 3, 3], 5).unwrap();
    assert_eq!((strip.triangles, strip.left_out.stitches), (vec![[0, 1, 2], [1, 3, 2]], 1));
    assert_eq!(of(&[0, 1, 3, 2], 6).unwrap().triangles, [[1, 3, 0], [3, 2, 0]]);
    assert!(matches!(of(&[0, 1], 1), Err(MeshError::NoTriangles { .. })));
    let (json, binary) = gltf_of(&TRIANGLE, &[], 4, "");
    let bare = json.replace(r#""indices":1,"#, "");
    assert_eq!(parse("a.glb", glb(&bare, &binary)).unwrap().triangles, [[0, 1, 2]]);
    let lines = json.replace(r#""indices":1,"mode":4"#, r#""mode":4},{"mode":1"#);
    let raw = parse("a.glb", glb(&lines, &binary)).unwrap();
    assert_eq!((raw.triangles.len(), raw.left_out.lines_and_points), (1, 1));
}

#[test]
fn gltf_numbers_are_the_nearest_to_their_decimals() {
    for k in 1..200 {
        let text = format!("0.{}", 9_876_543_210_987_654_u64 / 7 * k);
        let node = format!(r#","nodes":[{{"mesh":0,"translation":[{text},0,0]}}]"#);
        let (json, binary) = gltf_of(&TRIANGLE, &[0, 1, 2], 4, &node);
        let raw = parse("a.glb", glb(&json, &binary)).unwrap();
        assert_eq!(raw.positions[0][0], text.parse::<f64>().unwrap());
    }
}

#[test]
fn strips_without_triangles_count_in_the_size_of_a_scene() {
    let nodes = vec![r#"{"mesh":0}"#; 1 << 10].join(",");
    let more = format!(r#","nodes":[{nodes}]"#);
    let (json, binary) = gltf_of(&TRIANGLE, &[0; 1 << 16], 5, &more);
    let error = parse("a.glb", glb(&json, &binary)).unwrap_err().to_string();
    assert!(error.contains("corners; 50331648 are read"), "{error}");
}

#[test]
fn gltf_buffers_may_be_in_the_text_or_beside_it_but_nowhere_else() {
    let (json, binary) = gltf_of(&TRIANGLE, &[0, 1, 2], 4, "");
    let with =
        |uri: &str| json.replace(r#"[{"byteLength""#, &format!(r#"[{{"uri":"{uri}","byteLength""#));
    let code = base64::Engine::encode(&base64::engine::general_purpose::STANDARD, &binary);
    let inside = with(&format!("data:application/octet-stream;base64,{code}"));
    let wanted = parse("a.gltf", inside).unwrap();
    assert_eq!(wanted.triangles, [[0, 1, 2]]);
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join("gltf_buffers");
    std::fs::create_dir_all(&directory).unwrap();
    std::fs::write(directory.join("my part.bin"), &binary).unwrap();
    let file = directory.join("part.gltf");
    std::fs::write(&file, with("my%20part.bin")).unwrap();
    assert_eq!(read(&file).unwrap().positions, wanted.positions);
    std::fs::write(&file, with("./my%20part.bin")).unwrap();
    assert_eq!(read(&file).unwrap().positions, wanted.positions);
    for uri in [".", "/etc/passwd", "../part.bin", "http://a/b", "%2e%2e/part.bin", ""] {
        let error = parse("a.gltf", with(uri)).unwrap_err().to_string();
        assert!(error.contains("buffer 0: ") && error.contains("is no file beside it"), "{error}");
    }
    assert!(matches!(parse("a.gltf", with("gone.bin")), Err(MeshError::Unreadable { .. })));
}

#[test]
fn gltf_refusals_name_node_mesh_or_accessor() {
    let (json, binary) = gltf_of(&TRIANGLE, &[0, 1, 2], 4, "");
    let draco = r#""extensionsRequired":["KHR_draco_mesh_compression"],"buffers""#;
    for (from, to, wanted) in [
        (r#""buffers""#, draco, "a.glb: the extension KHR_draco_mesh_compression is not read"),
        (r#""mode":4"#, r#""extensions":{"KHR_draco_mesh_compression":{}}"#, "draco"),
        (
            r#"{"buffer":0,"byteO"#,
            r#"{"extensions":{"EXT_meshopt_compression":{}},"buffer":0,"byteO"#,
            "EXT_meshopt_compression is not read",
        ),
        (r#"{"mesh":0}"#, r#"{"mesh":0,"skin":0}"#, "the skin of node 0 is not read"),
        (r#"{"mesh":0}"#, r#"{"mesh":0,"weights":[0.5]}"#, "the morph of node 0 is not read"),
        (r#"{"mesh":0}"#, r#"{"mesh":7}"#, "node 0: it names 7 of 1 meshes"),
        (r#"{"mesh":0}"#, r#"{"children":[0]}"#, "node 0: it has two parents"),
        (r#"{"mesh":0}"#, r#"{"scale":[1,2]}"#, "node 0: scale has not 3 numbers"),
        (
            r#"{"mesh":0}"#,
            r#"{"rotation":[1,1,0,0]}"#,
            "node 0: its rotation is no unit quaternion, its length is 1.414214",
        ),
        (
            r#"{"mesh":0}"#,
            r#"{"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,2]}"#,
            "node 0: the last row of its matrix is not 0 0 0 1",
        ),
        (r#""count":3}"#, r#""count":4}"#, "accessor 0: 4 elements reach beyond its buffer"),
        (r#""count":3}"#, r#""count":18446744073709551615}"#, "accessor 0: "),
        (r#""count":3}"#, r#""count":2}"#, "mesh 0, primitive 0: its indices name vertex 2 of 2"),
        (r#""mode":4"#, r#""mode":7"#, "mesh 0, primitive 0: its mode is none of 0 to 6"),
        (r#"{"version":"2.0"}"#, r#"{"version":"1.0"}"#, "glTF 1.0 is not read"),
        (r#"{"asset""#, r#"{asset"#, "the JSON: key must be a string"),
    ] {
        let changed = json.replacen(from, to, 1);
        assert_ne!(changed, json);
        let error = parse("a.glb", glb(&changed, &binary)).unwrap_err().to_string();
        assert!(error.contains(wanted), "{error}");
    }
    let whole = glb(&json, &binary);
    let error = parse("a.glb", &whole[..whole.len() - 1]).unwrap_err();
    assert!(matches!(error, MeshError::Truncated { .. }), "{error}");
}

#[test]
fn quaternions_near_length_one_are_used_and_named_unless_they_are_rounded_only() {
    for (rotation, remarks) in
        [("0,0,0.70710677,0.70710677", 0), ("0,0,0.707,0.707", 1), ("0,0,0.71,0.71", 1)]
    {
        let nodes = format!(r#","nodes":[{{"mesh":0,"rotation":[{rotation}]}}]"#);
        let (json, binary) = gltf_of(&TRIANGLE, &[0, 1, 2], 4, &nodes);
        let raw = parse("a.glb", glb(&json, &binary)).unwrap();
        assert_eq!(raw.left_out.remarks.len(), remarks, "{rotation}");
        if let [remark] = &raw.left_out.remarks[..] {
            let said = remark.to_string();
            let wanted = "1 quaternion of a length other than 1, used as written: node 0, ";
            assert!(said.starts_with(wanted), "{said}");
        }
    }
}

/// A triangle whose accessors are sparse: corner 2 and index 0 are replaced.
fn sparse(more: &str) -> Result<RawMesh, MeshError> {
    let mut buffer: Vec<u8> = TRIANGLE.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    buffer.extend([9, 1, 2, 0]);
    buffer.extend([0.0f32, 5.0, 0.0].iter().flat_map(|x| x.to_le_bytes()));
    buffer.extend([2, 0, 0, 0]);
    let json = r#"{"asset":{"version":"2.0"},"buffers":[{"byteLength":56}],
        "bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":4},
        {"buffer":0,"byteOffset":40,"byteLength":12},{"buffer":0,"byteOffset":52,"byteLength":4}],
        "accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3,"sparse":{"count":1,
        "indices":{"bufferView":3,"componentType":5121},"values":{"bufferView":2}}},
        {"bufferView":1,"componentType":5121,"type":"SCALAR","count":3,"sparse":{"count":1,
        "indices":{"bufferView":3,"byteOffset":1,"componentType":5121},
        "values":{"bufferView":3,"byteOffset":1}}}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
        "nodes":[{"mesh":0}]}"#;
    let (from, to) = more.split_once('|').unwrap_or(("{\"asset\"", "{\"asset\""));
    assert!(json.contains(from), "{from}");
    parse("a.glb", glb(&json.replacen(from, to, 1), &buffer))
}

#[test]
fn sparse_accessors_are_read_and_their_defects_named() {
    let raw = sparse("").unwrap();
    let wanted = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 5.0, 0.0]];
    assert_eq!(corners(&raw), [wanted]);
    // Without a view the others are zeros.
    let raw = sparse(r#""bufferView":0,"componentType"|"componentType""#).unwrap();
    assert_eq!(corners(&raw), [[[0.0; 3], [0.0; 3], [0.0, 5.0, 0.0]]]);
    for (change, wanted) in [
        (r#""count":1,|"count":2,"#, "accessor 0, sparse: 2 elements reach beyond its buffer"),
        (
            r#""count":3,"sparse"|"count":2,"sparse""#,
            "accessor 0, sparse: its indices name element 2 of 2",
        ),
        (
            r#""componentType":5121},"values":{"bufferView":2|"componentType":5126},"values":{"bufferView":2"#,
            "accessor 0, sparse: its indices are of no whole type",
        ),
        (
            r#""bufferView":0,"componentType":5126,"type":"VEC3","count":3|"componentType":5126,"type":"VEC3","count":99999999999"#,
            "accessor 0: it has 99999999999 elements of a sparse accessor; 16777216 are read",
        ),
    ] {
        let error = sparse(change).unwrap_err().to_string();
        assert!(error.contains(wanted), "{error}");
    }
}

#[test]
fn chunks_of_glb_may_be_filled_with_zeros_or_not_at_all() {
    let (json, binary) = gltf_of(&TRIANGLE, &[0, 1, 2], 4, "");
    let whole = parse("a.glb", glb(&json, &binary)).unwrap();
    for (counted, filled) in [("\0", ""), ("\0\0\0", ""), ("", "\0\0"), ("", "   "), ("", "")] {
        let json = format!("{json}{counted}");
        let chunk = |kind: &[u8; 4], content: &[u8]| {
            [&(content.len() as u32).to_le_bytes(), &kind[..], content].concat()
        };
        let chunks =
            [&chunk(b"JSON", json.as_bytes())[..], filled.as_bytes(), &chunk(b"BIN\0", &binary)];
        let chunks = chunks.concat();
        let length = 12 + chunks.len() as u32;
        let file = [&b"glTF"[..], &2u32.to_le_bytes(), &length.to_le_bytes(), &chunks].concat();
        let raw =
            parse("a.glb", file.clone()).unwrap_or_else(|e| panic!("{e}: {counted:?} {filled:?}"));
        assert_eq!(raw.triangles, whole.triangles);
        let cut = file[..file.len() - binary.len() - 8].to_vec();
        assert!(matches!(parse("a.glb", cut), Err(MeshError::Truncated { .. })));
    }
}

#[test]
fn threemf_parts_that_cura_names_as_no_solid_are_left_out() {
    for (value, count) in [("True", 1), ("False", 2)] {
        let metadata = format!(
            r#"<metadatagroup><metadata name="cura:infill_mesh">{value}</metadata></metadatagroup>"#
        );
        let model =
            model_of(&TRIANGLE, &[[0, 1, 2]], r#"<item objectid="1"/><item objectid="2"/>"#);
        let begin = model.find("<object").unwrap();
        let end = model.find("</resources>").unwrap();
        let object = model[begin..end].replacen("<mesh>", &format!("{metadata}<mesh>"), 1);
        let other = object.replacen("id=\"1\"", "id=\"2\"", 1).replace(&metadata, "");
        let model = format!("{}{object}{other}{}", &model[..begin], &model[end..]);
        let raw = parse("a.3mf", threemf(&model)).unwrap();
        assert_eq!(
            (raw.triangles.len(), raw.left_out.remarks.len()),
            (count, 2 - count),
            "{value}"
        );
    }
}

#[test]
fn threemf_of_parts_that_are_left_out_only_says_so() {
    let model = model_of(&TRIANGLE, &[[0, 1, 2]], r#"<item objectid="1" printable="0"/>"#);
    let error = parse("a.3mf", threemf(&model)).unwrap_err().to_string();
    assert!(error.contains("(1 item not to be printed left out: item 0 of the build"), "{error}");
}

#[test]
fn threemf_items_and_components_are_placed_and_mirrors_keep_the_outside() {
    let components = format!(
        r#"</object><object id="2"><components><component objectid="1" transform="{}"/>
        </components></object></resources>"#,
        "2 0 0 0 2 0 0 0 2 3 0 0"
    );
    let build = r#"<item objectid="2" transform="0 1 0 -1 0 0 0 0 1 0 0 0"/>
        <item objectid="1" transform="-1 0 0 0 1 0 0 0 1 0 0 5"/>"#;
    let model =
        model_of(&TRIANGLE, &[[0, 1, 2]], build).replace("</object></resources>", &components);
    let raw = parse("a.3mf", threemf(&model)).unwrap();
    let turned = [[0.0, 3.0, 0.0], [0.0, 5.0, 0.0], [-2.0, 3.0, 0.0]];
    let mirrored = [[0.0, 0.0, 5.0], [0.0, 1.0, 5.0], [-1.0, 0.0, 5.0]];
    assert_eq!(corners(&raw), [turned, mirrored]);
    assert!(raw.decimal && raw.unit == Some(Unit::In) && raw.error < 1e-13);
    let unnamed = parse("a.3mf", threemf(&model.replacen(r#"unit="inch""#, "", 1))).unwrap();
    assert_eq!([&raw, &unnamed].map(|raw| raw.unit_by_default), [false, true]);
    assert_eq!(unnamed.unit, Some(Unit::Mm));
    let millimetres = raw.in_unit(Unit::Mm).unwrap();
    assert_eq!(corners(&millimetres)[0][1], [0.0, 127.0, 0.0]);
}

#[test]
fn threemf_components_in_other_parts_of_the_archive_are_followed() {
    let part = model_of(&TRIANGLE, &[[0, 1, 2]], "");
    let root = format!(
        r#"<model unit="inch" xmlns="{SPACE}" requiredextensions="p"
        xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/2015/06"><resources>
        <object id="1"><components><component p:path="/3D/Objects/a.model" objectid="1"/>
        </components></object></resources><build><item objectid="1"/></build></model>"#
    );
    let archive = archive(&[("3D/root.model", &root), ("3D/Objects/a.model", &part)]);
    assert_eq!(corners(&parse("a.3mf", archive).unwrap()), [TRIANGLE]);
}

#[test]
fn threemf_attributes_of_other_namespaces_move_no_vertex() {
    let model = model_of(&TRIANGLE, &[[0, 1, 2]], r#"<item objectid="1"/>"#)
        .replace("<vertex ", r#"<vertex b:x="9" xmlns:b="urn:b" "#);
    assert_eq!(corners(&parse("a.3mf", threemf(&model)).unwrap()), [TRIANGLE]);
}

#[test]
fn threemf_refusals_name_part_object_and_defect() {
    let model = model_of(&TRIANGLE, &[[0, 1, 2]], r#"<item objectid="1"/>"#);
    let own = r#"<components><component objectid="1"/></components></object>"#;
    for (from, to, wanted) in [
        (
            r#"v3="2""#,
            r#"v3="3""#,
            "3D/3dmodel.model, object 1 after 3 vertices and 0 triangles: \
            the triangle names vertex 3",
        ),
        (r#"y="1""#, r#"y="one""#, "after 2 vertices and 0 triangles: y \"one\" is no finite"),
        (r#" y="1""#, "", "after 2 vertices and 0 triangles: vertex has no y"),
        (r#"<item objectid="1""#, r#"<item objectid="9""#, "item 0 of the build: "),
        (r#"objectid="1""#, r#"objectid="1" transform="1 2""#, "has not 12 numbers"),
        ("</object>", own, "item 0 of the build: an object contains itself"),
        ("inch", "yard", "\"yard\" is no unit of 3MF"),
        ("core/2015/02", "core/2099/02", "it is not in the namespace of 3MF"),
        (
            r#"unit="inch""#,
            r#"xmlns:b="urn:beams" requiredextensions="b""#,
            "the extension urn:beams of 3D/3dmodel.model is not read",
        ),
        ("<triangles>", r#"<b:beamlattice xmlns:b="urn:b"/><triangles>"#, "the beam lattice of 3D"),
        ("</model>", "", "3D/3dmodel.model: the file ends within an element"),
        (r#"<item objectid="1"/>"#, "", "3D/3dmodel.model: the build lists no item"),
    ] {
        let changed = model.replacen(from, to, 1);
        assert_ne!(changed, model);
        let error = parse("a.3mf", threemf(&changed)).unwrap_err().to_string();
        assert!(error.starts_with("a.3mf: ") && error.contains(wanted), "{error}");
    }
    let error = parse("a.3mf", "no archive").unwrap_err().to_string();
    assert!(error.starts_with("a.3mf: the archive: "), "{error}");
}

#[test]
fn scenes_of_too_many_copies_and_archives_that_expand_too_far_are_refused() {
    let mut objects = String::from("</object>");
    for id in 2..40 {
        let inner = format!(r#"<component objectid="{}"/>"#, id - 1);
        objects +=
            &format!(r#"<object id="{id}"><components>{inner}{inner}</components></object>"#);
    }
    let model = model_of(&TRIANGLE, &[[0, 1, 2]], r#"<item objectid="39"/>"#);
    let model = model.replacen("</object>", &objects, 1);
    let error = parse("a.3mf", threemf(&model)).unwrap_err().to_string();
    assert!(error.contains("copies of meshes; 1048576 are read"), "{error}");
    let own = r#"</object><object id="2"><components>"#.to_owned();
    let many = own + &r#"<component objectid="1"/>"#.repeat(1 << 16) + "</components></object>";
    let model = model_of(&TRIANGLE, &[[0, 1, 2]], "").replacen("</object>", &many, 1);
    // So that the archive does not expand too far.
    let hash = |k: u32| k.wrapping_mul(2_654_435_761).rotate_left(k % 31).to_string();
    let noise: String = (0..1 << 12).map(hash).collect();
    let error = parse("a.3mf", archive(&[("3D/a.model", &model), ("noise", &noise)])).unwrap_err();
    assert!(error.to_string().contains("more objects, components and items"), "{error}");
    let blank = " ".repeat(1 << 20);
    let model = model_of(&TRIANGLE, &[[0, 1, 2]], "");
    let error = parse("a.3mf", threemf(&model.replacen("<build>", &blank, 1))).unwrap_err();
    assert!(error.to_string().contains("expands more than 128 times"), "{error}");
}
