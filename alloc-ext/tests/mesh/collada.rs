//! COLLADA: nodes in place, and what is refused with its place.

use meshsweep::mesh::{MeshError, RawMesh, Unit, read_bytes, repair};
use std::path::Path;

fn parse(text: &str) -> Result<RawMesh, MeshError> {
    read_bytes(Path::new("a.dae"), text.into())
}

/// A file of one geometry of five points, (0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0) and (0, 0, 1),
/// with the faces given, and of the nodes given.
fn file(unit: &str, faces: &str, nodes: &str) -> String {
    format!(
        r##"<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset>{unit}</asset>
<library_geometries><geometry id="g" name="a part"><mesh>
<source id="p"><float_array id="a" count="17">9 0 0 0  1 0 0  1 1 0  0 1 0  0 0 1 9</float_array>
<technique_common><accessor source="#a" offset="1" count="5" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
</accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/><input semantic="NORMAL" source="#n"/></vertices>
{faces}
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s">{nodes}</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene>
</COLLADA>"##
    )
}

const INPUT: &str = r##"<input semantic="VERTEX" source="#v" offset="0"/>"##;
const NODE: &str = r##"<node><instance_geometry url="#g"/></node>"##;

fn triangle() -> String {
    format!(r#"<triangles count="1">{INPUT}<p>0 1 2</p></triangles>"#)
}

fn corners(raw: &RawMesh) -> Vec<[[f64; 3]; 3]> {
    raw.triangles.iter().map(|t| t.map(|v| raw.positions[v as usize])).collect()
}

#[test]
fn faces_of_all_kinds_are_read_in_the_file_s_order() {
    let shared = r##"<input semantic="NORMAL" source="#n" offset="1"/>
        <input semantic="TEXCOORD" source="#t" offset="1" set="0"/>"##;
    let faces = [
        format!(r#"<lines count="1">{INPUT}<p>0 1</p></lines>"#),
        format!(
            r#"<triangles count="2">{INPUT}{shared}<p>0 9 1 9 2 9 0 8 2 8 3 8</p></triangles>"#
        ),
        format!(
            r#"<polylist count="2">{INPUT}<vcount>3 4</vcount><p>0 1 4 0 1 2 3</p></polylist>"#
        ),
        format!(r#"<polygons count="2">{INPUT}<p>3 2 1 0</p><p>0 1</p></polygons>"#),
        format!(r#"<tristrips count="1">{INPUT}<p>0 1 3 2 2</p></tristrips>"#),
        format!(r#"<trifans count="1">{INPUT}<p>4 0 1 2</p></trifans>"#),
        format!(r#"<triangles count="0">{INPUT}</triangles>"#),
    ];
    let raw = parse(&file("", &faces.concat(), NODE)).unwrap();
    let wanted = [
        [0, 1, 2],
        [0, 2, 3],
        [0, 1, 4],
        [0, 1, 2],
        [0, 2, 3],
        [3, 2, 1],
        [3, 1, 0],
        [0, 1, 3],
        [1, 2, 3],
        [4, 0, 1],
        [4, 1, 2],
    ];
    assert_eq!(raw.triangles, wanted);
    assert_eq!(
        (raw.polygons.split, raw.left_out.lines_and_points, raw.left_out.stitches),
        (2, 1, 1)
    );
    let small = raw.left_out.small_faces;
    assert_eq!((small.count, small.first.unwrap().face), (1, 5));
    assert_eq!((raw.positions.len(), raw.error, raw.decimal), (5, 0.0, true));
    assert_eq!((raw.unit, raw.unit_by_default), (Some(Unit::M), true));
}

#[test]
fn nodes_are_placed_by_their_ancestors_and_mirrors_keep_the_outside() {
    let library = r##"<library_nodes><node id="n"><rotate>0 0 1 90</rotate>
        <instance_geometry url="#g"/></node></library_nodes><library_visual_scenes>"##;
    let nodes = r##"<node><translate>10 0 0</translate><scale>2 2 2</scale>
        <node><matrix>1 0 0 0 0 1 0 5 0 0 1 0 0 0 0 1</matrix><instance_geometry url="#g"/></node>
        <instance_node url="#n"/></node>
        <node><scale>-1 1 1</scale><instance_geometry url="#g"/></node>"##;
    let text = file("", &triangle(), nodes).replace("<library_visual_scenes>", library);
    let raw = parse(&text).unwrap();
    let wanted = [
        [[10.0, 10.0, 0.0], [12.0, 10.0, 0.0], [12.0, 12.0, 0.0]],
        [[10.0, 0.0, 0.0], [10.0, 2.0, 0.0], [8.0, 2.0, 0.0]],
        [[0.0, 0.0, 0.0], [-1.0, 1.0, 0.0], [-1.0, 0.0, 0.0]],
    ];
    assert_eq!(corners(&raw), wanted);
    assert!(raw.error > 0.0 && raw.error < 1e-13, "{}", raw.error);
}

#[test]
fn the_unit_is_that_of_the_file_and_others_are_scaled_to_metres() {
    for (unit, wanted, x, by_default) in [
        ("", Unit::M, 1.0, true),
        (r#"<unit meter="0.001" name="millimeter"/>"#, Unit::Mm, 1.0, false),
        (r#"<unit name="inch" meter="0.02539999969303608"/>"#, Unit::In, 1.0, false),
        (r#"<unit meter="1.0E-2"/>"#, Unit::Cm, 1.0, false),
        (r#"<unit name="decimeter" meter="0.1"/>"#, Unit::M, 0.1, false),
    ] {
        let raw = parse(&file(unit, &triangle(), NODE)).unwrap();
        assert_eq!((raw.unit, raw.positions[1]), (Some(wanted), [x, 0.0, 0.0]), "{unit}");
        assert_eq!((raw.unit_by_default, raw.error > 0.0), (by_default, x != 1.0), "{unit}");
    }
}

#[test]
fn an_axis_that_is_up_turns_nothing_and_is_named() {
    for (axis, remarks) in [("X_UP", 1), ("Y_UP", 1), ("Z_UP", 0)] {
        let text = file(&format!("<up_axis>{axis}</up_axis>"), &triangle(), NODE);
        let raw = parse(&text).unwrap();
        assert_eq!(raw.positions[4], [0.0, 0.0, 1.0], "{axis}");
        assert_eq!(raw.left_out.remarks.len(), remarks, "{axis}");
    }
}

#[test]
fn what_the_scene_does_not_show_is_counted_and_a_file_without_a_scene_is_read_whole() {
    let whole = file("", &triangle(), NODE);
    let other = r#"<visual_scene id="t"/></library_visual_scenes>"#;
    let hidden = r##"<geometry id="h"><mesh/></geometry></library_geometries>"##;
    let text =
        whole.replace("</library_visual_scenes>", other).replace("</library_geometries>", hidden);
    let (_, report) = repair(parse(&text).unwrap()).unwrap();
    let said = report.to_string();
    assert!(
        said.contains("1 visual scene that is not shown left out: visual_scene \"t\""),
        "{said}"
    );
    assert!(said.contains("1 geometry that no node places left out: geometry \"h\""), "{said}");
    let begin = whole.find("<scene>").unwrap();
    let scenes = whole.find("<library_visual_scenes>").unwrap();
    for end in [begin, scenes] {
        let text = format!("{}</COLLADA>", &whole[..end]);
        assert_eq!(parse(&text).unwrap().triangles, [[0, 1, 2]]);
    }
}

#[test]
fn references_entities_and_encodings_of_xml_are_read() {
    let whole = file("", &triangle(), NODE);
    let written = whole
        .replace(">0 1 2<", "><!-- three -->0&#32;<![CDATA[1]]> &#x32;<")
        .replace("\"g\"", "\"K&#246;rper\"")
        .replace("\"#g\"", "\"#K\u{F6}rper\"");
    assert_eq!(parse(&written).unwrap().triangles, [[0, 1, 2]]);
    let latin = written.replace("utf-8", "ISO-8859-1");
    let latin: Vec<u8> = latin.chars().map(|c| u8::try_from(u32::from(c)).unwrap()).collect();
    assert_eq!(read_bytes(Path::new("a.dae"), latin).unwrap().triangles, [[0, 1, 2]]);
    let error = parse(&whole.replace("utf-8", "klingon")).unwrap_err().to_string();
    assert!(error.contains("the encoding \"klingon\" is not read"), "{error}");
}

#[test]
fn refusals_name_line_element_and_defect() {
    let polygons = format!(r#"<polygons count="1">{INPUT}<ph><p>0 1 2</p></ph></polygons>"#);
    let whole = file("<unit meter=\"1\"/>", &(triangle() + "<q/>"), NODE).replace("<q/>", "");
    for (from, to, wanted) in [
        ("version=\"1.4.1\"", "version=\"1.3.0\"", "version \"1.3.0\" of COLLADA in line 2"),
        ("COLLADA", "collada", "line 2: collada: the root is not COLLADA"),
        ("meter=\"1\"", "meter=\"-1\"", "line 3: unit: meter \"-1\" is no length"),
        ("\"#g\"", "\"b.dae#g\"", "\"b.dae#g\", of another file, in line 12"),
        (
            "\"#g\"",
            "\"#h\"",
            "line 12: instance_geometry of visual_scene \"s\": there is no geometry",
        ),
        (
            "count=\"17\"",
            "count=\"18\"",
            "line 5: float_array \"a\": it announces 18 numbers, and 17",
        ),
        ("9 0 0 0", "9 0 0 O", "line 5: float_array \"a\": \"O\" is not a number"),
        ("9 0 0 0", "9 0 0 NaN", "line 5: vertex 0 is at [0.0, 0.0, NaN]"),
        (
            "count=\"5\"",
            "count=\"6\"",
            "line 6: accessor of source \"p\": 6 points reach beyond its 17",
        ),
        ("count=\"5\"", "count=\"99999999999999999999\"", "is no number"),
        ("stride=\"3\"", "stride=\"2\"", "stride 2 is less than a point"),
        (
            "name=\"Z\"",
            "name=\"W\"",
            "line 6: accessor of source \"p\": its params are not X, Y and Z",
        ),
        ("source=\"#a\"", "source=\"#p\"", "there is no float_array or int_array of id \"p\""),
        ("\"POSITION\"", "\"NORMAL\"", "line 9: vertices \"v\": it has no input POSITION"),
        (
            "\"VERTEX\"",
            "\"NORMAL\"",
            "line 10: triangles of geometry \"g\": it has no input VERTEX",
        ),
        ("offset=\"0\"", "offset=\"9\"", "line 10: input of geometry \"g\": offset 9 is too large"),
        (">0 1 2<", ">0 1 5<", "line 10: p of geometry \"g\": corner 2 names vertex 5 of 5"),
        (">0 1 2<", ">0 1 -1<", "corner 2 names vertex -1 of 5"),
        (">0 1 2<", ">0 1 x<", "\"x\" does not name a vertex"),
        (">0 1 2<", ">0 1 2 3<", "line 10: triangles of geometry \"g\": 4 corners are no multiple"),
        (
            "<triangles count=\"1\"",
            "<triangles count=\"2\"",
            "it announces 2 triangles, and 1 are there",
        ),
        ("</triangles>", "", "line 11: the XML: "),
        ("<node>", "<node><skew>1 2</skew>", "the transform skew in line 12"),
        ("<node>", "<node><lookat/>", "the transform lookat in line 12"),
        (
            "<node>",
            "<node><scale>1 2</scale>",
            "scale of visual_scene \"s\": 3 finite numbers are wanted",
        ),
        ("<node>", "<node><rotate>0 0 0 5</rotate>", "its axis has no length"),
        (
            "<node>",
            "<node><matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 2</matrix>",
            "last row is not 0 0 0 1",
        ),
        ("<node>", "<node id=\"n\"><instance_node url=\"#n\"/>", "node \"n\": it contains itself"),
        ("<mesh>", "<convex_mesh/><mesh>", "the convex_mesh in line 4"),
        ("</COLLADA>", "", "the XML: the file ends within an element"),
        ("id=\"p\"", "id=\"a\"", "there is no source of id \"p\""),
    ] {
        let changed = whole.replace(from, to);
        assert_ne!(changed, whole);
        let error = parse(&changed).unwrap_err().to_string();
        assert!(error.starts_with("a.dae") && error.contains(wanted), "{error}");
        assert!(error.contains("; "), "{error}");
    }
    let error = parse(&file("", &polygons, NODE)).unwrap_err().to_string();
    assert!(error.contains("a polygon with holes in line 10"), "{error}");
    let error = parse(&whole.replace('\n', "\r").replace(">0 1 2<", ">0 1 5<")).unwrap_err();
    assert!(error.to_string().starts_with("a.dae, line 10: "), "{error}");
    let polylist =
        format!(r#"<polylist count="1">{INPUT}<vcount>4</vcount><p>0 1 2</p></polylist>"#);
    let error = parse(&file("", &polylist, NODE)).unwrap_err().to_string();
    assert!(error.contains("its vcount wants 4 corners, and 3 are there"), "{error}");
}

#[test]
fn controllers_are_refused_by_name() {
    let nodes = r##"<node><instance_controller url="#c"/></node>"##;
    for (kind, wanted) in [("skin", "the skin in line"), ("morph", "the morph in line")] {
        let library = format!(
            r##"<library_controllers><controller id="c"><{kind} source="#g"/></controller>
            </library_controllers><library_visual_scenes>"##
        );
        let text = file("", &triangle(), nodes).replace("<library_visual_scenes>", &library);
        let error = parse(&text).unwrap_err().to_string();
        assert!(error.contains(wanted) && error.contains("controller \"c\""), "{error}");
        // One that no node shows does not matter.
        assert_eq!(parse(&text.replace(nodes, NODE)).unwrap().triangles.len(), 1);
    }
}

#[test]
fn a_concave_polygon_of_a_copy_keeps_its_fan_s_corners() {
    // The notch is at (0.5, 0.5): the fan about the first corner leaves the polygon.
    let faces = format!(r#"<polygons count="1">{INPUT}<p>1 2 3 4</p></polygons>"#);
    let text = file("", &faces, &NODE.repeat(2)).replace("0 0 1 9<", "0.9 0.5 0 9<");
    let raw = parse(&text).unwrap();
    assert_eq!((raw.polygons.split, raw.triangles.len()), (1, 4));
    let ears = raw.polygons.by_ears;
    assert_eq!(raw.fans.len(), 4 * ears);
    assert!(
        raw.fans.iter().all(|(_, fan)| fan.iter().all(|&v| (v as usize) < raw.positions.len()))
    );
}

#[test]
fn a_lookat_of_a_camera_places_nothing_and_refuses_nothing() {
    let camera = r##"<node id="c"><lookat>0 0 9 0 0 0 0 1 0</lookat>
        <node><instance_camera url="#x"/></node></node>"##;
    let raw = parse(&file("", &triangle(), &format!("{camera}{NODE}"))).unwrap();
    assert_eq!(raw.triangles, [[0, 1, 2]]);
    let over =
        camera.replace(r##"<instance_camera url="#x"/>"##, r##"<instance_geometry url="#g"/>"##);
    let error = parse(&file("", &triangle(), &over)).unwrap_err().to_string();
    assert!(error.contains("the transform lookat in line"), "{error}");
}

#[test]
fn points_without_params_are_x_y_z_if_they_have_three_numbers() {
    let whole = file("", &triangle(), NODE);
    let begin = whole.find("<param").unwrap();
    let end = whole.find("</accessor>").unwrap();
    let bare = format!("{}{}", &whole[..begin], &whole[end..]);
    assert_eq!(corners(&parse(&bare).unwrap()), corners(&parse(&whole).unwrap()));
    let error = parse(&bare.replacen(r#"stride="3""#, r#"stride="2""#, 1)).unwrap_err().to_string();
    assert!(error.contains("its params are not X, Y and Z"), "{error}");
}
