//! Files of scenes as bytes.

use std::fmt::Write as _;
use std::io::Write as _;

use super::Triangles;

/// Binary glTF: a node that turns and one that mirrors the mesh.
#[must_use]
pub fn glb((positions, triangles): &Triangles) -> Vec<u8> {
    let mut buffer: Vec<u8> = positions.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    let begin = buffer.len();
    buffer.extend(triangles.iter().flatten().flat_map(|v| v.to_le_bytes()));
    let (vertices, corners) = (positions.len(), 3 * triangles.len());
    let (bytes, length) = (buffer.len(), buffer.len() - begin);
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[
        {{"mesh":0,"rotation":[0,0.6,0,0.8],"children":[1]}},{{"mesh":0,"scale":[-1,1,2]}}],
        "buffers":[{{"byteLength":{bytes}}}],"bufferViews":[{{"buffer":0,"byteLength":{begin}}},
        {{"buffer":0,"byteOffset":{begin},"byteLength":{length}}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"type":"VEC3","count":{vertices}}},
        {{"bufferView":1,"componentType":5125,"type":"SCALAR","count":{corners}}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1,"mode":4}}]}}]}}"#
    );
    let mut bytes = Vec::from(*b"glTF");
    bytes.extend(2u32.to_le_bytes());
    bytes.extend((28 + json.len() as u32 + buffer.len() as u32).to_le_bytes());
    for (kind, content) in [(b"JSON", json.as_bytes()), (b"BIN\0", &buffer)] {
        bytes.extend((content.len() as u32).to_le_bytes());
        bytes.extend(kind);
        bytes.extend(content);
    }
    bytes
}

/// 3MF, not compressed: an item that turns the mesh.
///
/// # Panics
/// Never: writing to memory does not fail.
#[must_use]
pub fn threemf(mesh: &Triangles) -> Vec<u8> {
    let model = threemf_model(
        &[(1, "", mesh)],
        r#"<object id="2"><components><component objectid="1"/></components></object>"#,
        r#"<item objectid="2" transform="0 1 0 -1 0 0 0 0 1 2 3 4"/>"#,
    );
    threemf_archive(&model, &[])
}

/// A model of 3MF in inches: objects of meshes, each with its number and further attributes, other
/// objects and items as XML.
#[must_use]
pub fn threemf_model(meshes: &[(u32, &str, &Triangles)], objects: &str, items: &str) -> String {
    let mut model = String::from(
        r#"<model unit="inch" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
        <resources>"#,
    );
    for (id, attributes, (positions, triangles)) in meshes {
        let _ = write!(model, r#"<object id="{id}" {attributes}><mesh><vertices>"#);
        for [x, y, z] in positions.iter().map(|p| p.map(f64::from)) {
            let _ = write!(model, r#"<vertex x="{x}" y="{y}" z="{z}"/>"#);
        }
        model.push_str("</vertices><triangles>");
        for [a, b, c] in triangles {
            let _ = write!(model, r#"<triangle v1="{a}" v2="{b}" v3="{c}"/>"#);
        }
        model.push_str("</triangles></mesh></object>");
    }
    let _ = write!(model, "{objects}</resources><build>{items}</build></model>");
    model
}

/// An archive of a model and further files.
///
/// # Panics
/// Never: writing to memory does not fail.
#[must_use]
pub fn threemf_archive(model: &str, files: &[(&str, &str)]) -> Vec<u8> {
    let relationships = r#"<Relationships><Relationship Target="/3D/3dmodel.model"
        Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>"#;
    let mut bytes = Vec::new();
    let mut archive = rawzip::ZipArchiveWriter::new(&mut bytes);
    let first = [("_rels/.rels", relationships), ("3D/3dmodel.model", model)];
    for (name, text) in first.iter().chain(files) {
        let (mut entry, config) = archive.new_file(name).start().expect("a name");
        let mut writer = config.wrap(&mut entry);
        writer.write_all(text.as_bytes()).expect("memory");
        let (_, descriptor) = writer.finish().expect("memory");
        entry.finish(descriptor).expect("memory");
    }
    archive.finish().expect("memory");
    bytes
}

/// COLLADA: a node that turns and one that mirrors the mesh. The corners of half of the triangles
/// are in a list with normals, those of the others are polygons.
#[must_use]
pub fn dae((positions, triangles): &Triangles) -> Vec<u8> {
    let numbers: Vec<String> =
        positions.iter().flatten().map(|&x| f64::from(x).to_string()).collect();
    let (count, points) = (numbers.len(), positions.len());
    let (listed, others) = triangles.split_at(triangles.len() / 2);
    let corners = |triangle: &[u32; 3]| triangle.map(|v| v.to_string()).join(" ");
    let with_normals: String =
        listed.iter().flatten().map(|corner| format!("{corner} 0 ")).collect();
    let polygons: String = others.iter().map(|t| format!("<p>{}</p>", corners(t))).collect();
    let text = format!(
        r##"<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="inch" meter="0.0254"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh><source id="p">
<float_array id="a" count="{count}">{}</float_array><technique_common>
<accessor source="#a" count="{points}" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="{}"><input semantic="VERTEX" source="#v" offset="0"/>
<input semantic="NORMAL" source="#n" offset="1"/><p>{with_normals}</p></triangles>
<polygons count="{}"><input semantic="VERTEX" source="#v" offset="0"/>{polygons}</polygons>
</mesh></geometry></library_geometries>
<library_nodes><node id="m"><scale>-1 1 2</scale><instance_geometry url="#g"/></node></library_nodes>
<library_visual_scenes><visual_scene id="s"><node><translate>1 2 3</translate>
<rotate>0 0 1 30</rotate><instance_geometry url="#g"/><instance_node url="#m"/></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>
"##,
        numbers.join(" "),
        listed.len(),
        others.len()
    );
    text.into_bytes()
}
