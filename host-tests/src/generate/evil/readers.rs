//! Files as programs write them against the letter of their format, or with parts that are no
//! triangles. What is right is read, and what cannot be right is refused.

use super::super::scenes::{dae, glb, threemf_archive, threemf_model};
use super::super::writers::{ascii_ply, ascii_stl, binary_ply, binary_stl, obj, off};
use super::super::{Triangles, cube, inverted, scaled};
use super::{Evil, Outcome};

pub(super) fn files() -> Vec<Evil> {
    let all = [stl(), binary(), ply(), plain(), scenes(), collada()];
    all.into_iter().flatten().collect()
}

fn accepted(name: &'static str, bytes: Vec<u8>, flaw: &'static str) -> Evil {
    Evil { name, bytes, outcome: Outcome::Accepted, flaw }
}

fn refused(name: &'static str, bytes: Vec<u8>, variant: &'static str, flaw: &'static str) -> Evil {
    Evil { name, bytes, outcome: Outcome::Unreadable(variant), flaw }
}

fn text(bytes: Vec<u8>) -> String {
    String::from_utf8(bytes).unwrap_or_default()
}

/// In two bytes a character, with a mark.
fn utf_16(text: &str, with: fn(u16) -> [u8; 2]) -> Vec<u8> {
    format!("\u{FEFF}{text}").encode_utf16().flat_map(with).collect()
}

fn stl() -> Vec<Evil> {
    let whole = text(ascii_stl(&cube(1)));
    let with = |from: &str, to: &str| whole.replace(from, to).into_bytes();
    let without_end = whole.replace("endsolid part\n", "");
    let cut = without_end.rfind("facet normal").unwrap_or_default();
    let loops = whole.replacen("endloop\n", "endloop\nouter loop\nvertex 0 0 0\nendloop\n", 1);
    let lines = whole
        .replace('\n', " ")
        .replace("facet normal", "\nfacet normal")
        .replace(" endsolid", "\nendsolid");
    vec![
        accepted("bom.stl", [b"\xEF\xBB\xBF", whole.as_bytes()].concat(), "a byte order mark"),
        accepted("color.stl", with("facet n", "color 0.1 0.2 0.3\nfacet n"), "lines of colours"),
        accepted(
            "comment.stl",
            [b"; made by hand\n# and more\n", whole.as_bytes()].concat(),
            "comments before solid",
        ),
        accepted("cr.stl", with("\n", "\r"), "lines end with CR"),
        accepted("end_loop.stl", with("endloop", "end loop"), "two words for endloop"),
        accepted("end_solid.stl", with("endsolid", "end solid"), "two words for endsolid"),
        accepted("endsolid_name.stl", with("endsolid ", "endsolid"), "the name without a blank"),
        accepted("facet_a_line.stl", lines.into_bytes(), "a facet on each line"),
        accepted("nul_padded.stl", with("solid part\n", "solid part\0\0\0\n"), "zeros in the name"),
        accepted("utf_16.stl", utf_16(&whole, u16::to_le_bytes), "UTF-16"),
        refused("cut_facet.stl", without_end[..cut].into(), "Malformed", "ends between facets"),
        refused("several_loops.stl", loops.into_bytes(), "Malformed", "a facet of two loops"),
        refused(
            "decimal_comma.stl",
            with("vertex 1 ", "vertex 1,0 "),
            "Malformed",
            "a decimal comma",
        ),
    ]
}

fn binary() -> Vec<Evil> {
    let plain = binary_stl(&cube(1));
    let (header, body) = plain.split_at(84);
    let named = |begin: &[u8]| {
        let mut bytes = plain.clone();
        bytes[..begin.len()].copy_from_slice(begin);
        bytes
    };
    let solid = named(b"solid part\nof a program ");
    let attributes = |announced: u16, bytes: &[u8]| {
        let mut all = header.to_vec();
        for triangle in body.chunks(50) {
            all.extend(&triangle[..48]);
            all.extend(announced.to_le_bytes());
            all.extend(bytes);
        }
        all
    };
    let count = |count: u32| [&header[..80], &count.to_le_bytes(), body].concat();
    vec![
        accepted("attributes.stl", attributes(4, b"abcd"), "attributes after each triangle"),
        accepted("colors.stl", attributes(0x801F, b""), "colours in place of attributes' lengths"),
        accepted(
            "solid_trailing.stl",
            [&solid[..], b"\0\0"].concat(),
            "binary, begins with solid, two bytes too many",
        ),
        refused(
            "lying_attributes.stl",
            attributes(5, b"abcd"),
            "Malformed",
            "attributes of another length than announced",
        ),
        refused("more_triangles.stl", count(5), "Malformed", "12 triangles, announces 5"),
        refused(
            "solid_short.stl",
            solid[..solid.len() - 2].to_vec(),
            "Truncated",
            "binary, begins with solid, two bytes too few",
        ),
        refused("two_files.stl", [&plain[..], &plain].concat(), "Malformed", "two files in one"),
        refused("zero_count.stl", count(0), "Malformed", "12 triangles, announces 0"),
    ]
}

fn ply() -> Vec<Evil> {
    let whole = text(ascii_ply(&cube(1)));
    let (header, body) = whole.split_once("end_header\n").unwrap_or_default();
    let (x, z) = ("property double x\n", "property double z\n");
    let normals = header.replace(z, &format!("{z}property float nx\nproperty float ny\n"));
    let count = cube(1).0.len();
    let with = |header: &str, vertex: &str, face: &str| {
        let mut text = format!("{header}end_header\n");
        for (i, line) in body.lines().enumerate() {
            text += &format!("{line} {}\n", if i < count { vertex } else { face });
        }
        text.into_bytes()
    };
    let list = "property list uchar int vertex_indices\n";
    let strings = header
        .replace(z, &format!("{z}property string label\n"))
        .replace(list, &format!("{list}property list uchar float texcoord\n"));
    let binary = binary_ply(&cube(1));
    let end = binary.windows(11).position(|at| at == b"end_header\n").unwrap_or_default() + 11;
    let binary_cr =
        [text(binary[..end].into()).replace('\n', "\r").as_bytes(), &binary[end..]].concat();
    let one_line = format!("{header}end_header\n{}", body.replace('\n', " "));
    vec![
        accepted("cr.ply", whole.replace('\n', "\r").into_bytes(), "lines end with CR"),
        accepted("cr_binary.ply", binary_cr, "binary, lines of the header end with CR"),
        accepted("ind.ply", with(&normals, "-1.#IND 1.#QNAN", ""), "normals that are no numbers"),
        accepted("nan.ply", with(&normals, "nan -inf", ""), "normals that are not finite"),
        accepted("one_line.ply", one_line.into_bytes(), "all numbers on one line"),
        accepted(
            "strings.ply",
            with(&strings, "\"a label\"", "2 0.5 nan"),
            "strings and a second list",
        ),
        refused(
            "nan_vertex.ply",
            whole.replacen("end_header\n -1 ", "end_header\n nan ", 1).into_bytes(),
            "NotFinite",
            "a coordinate is NaN",
        ),
        refused(
            "other_lists.ply",
            whole.replace("element face", "element cell").into_bytes(),
            "Unsupported",
            "lists of vertices that are no faces",
        ),
        refused(
            "statement.ply",
            whole.replace(x, &format!("propertie float w\n{x}")).into_bytes(),
            "Malformed",
            "a misspelt statement in the header",
        ),
    ]
}

/// OFF and OBJ.
fn plain() -> Vec<Evil> {
    let off = text(off(&cube(1)));
    let rest = off.strip_prefix("OFF\n").unwrap_or_default();
    let many = off.split_once('\n').map_or(String::new(), |(keyword, rest)| {
        format!("{keyword}\n{}", rest.replace([' ', '\n'], "\n"))
    });
    let obj = text(obj(&cube(1)));
    let surface = "cstype bspline\ndeg 1 1\nsurf 0 1 0 1 1 2 3 4\nparm u 0 0 1 1\nend\n";
    let old = "call part.obj\ncsh -rm\ncurv 0 1 1 2\nquux a b\n";
    let only = obj.split("f ").next().unwrap_or_default();
    vec![
        accepted("glued.off", format!("OFF{rest}").into_bytes(), "the keyword without a blank"),
        accepted("many_lines.off", many.into_bytes(), "each number on a line of its own"),
        accepted("one_line.off", off.replace('\n', " ").into_bytes(), "all on one line"),
        refused("binary.off", b"OFF BINARY\n\0\0\0\x04".to_vec(), "Unsupported", "binary OFF"),
        accepted(
            "call.obj",
            (obj.clone() + old).into_bytes(),
            "calls, a curve, an unknown statement",
        ),
        accepted("cr.obj", obj.replace('\n', "\r").into_bytes(), "lines end with CR"),
        accepted("fo.obj", obj.replace("f ", "fo ").into_bytes(), "faces by their old name"),
        accepted("surf.obj", (obj.clone() + surface).into_bytes(), "a free-form surface"),
        accepted("utf_16.obj", utf_16(&obj, u16::to_be_bytes), "UTF-16"),
        refused(
            "misspelt.obj",
            obj.replacen("v ", "vv ", 1).into_bytes(),
            "Malformed",
            "a misspelt vertex",
        ),
        refused(
            "only_surf.obj",
            (only.to_owned() + surface).into_bytes(),
            "NoTriangles",
            "a free-form surface only",
        ),
        Evil {
            name: "antenna.obj",
            bytes: ANTENNA.into(),
            outcome: Outcome::NoSolid("Open"),
            flaw: "a polygon with an antenna",
        },
    ]
}

const ANTENNA: &str =
    "v 0 0 0\nv 4 0 0\nv 4 2 0\nv 7 2 0\nv 4 2 0\nv 4 4 0\nv 0 4 0\nf 1 2 3 4 5 6 7\n";

/// glTF and 3MF.
fn scenes() -> Vec<Evil> {
    let far = |mesh: Triangles| -> Triangles {
        (mesh.0.iter().map(|p| [p[0] + 9.0, p[1], p[2]]).collect(), mesh.1)
    };
    let (solid, other) = (cube(1), far(cube(1)));
    let items =
        |attributes: &str| format!(r#"<item objectid="1"/><item objectid="2" {attributes}/>"#);
    let support =
        threemf_model(&[(1, "", &solid), (2, r#"type="support""#, &other)], "", &items(""));
    let unprinted =
        threemf_model(&[(1, "", &solid), (2, "", &other)], "", &items(r#"printable="0""#));
    // A cavity that only the slicer knows of.
    let inner = scaled(&cube(1), 0.5);
    let both = super::joined(&solid, &inner);
    let count = solid.1.len();
    let prusa = format!(
        r#"<config><object id="1"><volume firstid="0" lastid="{}">
        <metadata type="volume" key="volume_type" value="ModelPart"/></volume>
        <volume firstid="{count}" lastid="{}">
        <metadata type="volume" key="volume_type" value="NegativeVolume"/></volume></object></config>"#,
        count - 1,
        both.1.len() - 1
    );
    let one = threemf_model(&[(1, "", &both)], "", r#"<item objectid="1"/>"#);
    let parts = threemf_model(
        &[(1, "", &solid), (2, "", &inverted(&inner))],
        r#"<object id="3"><components><component objectid="1"/><component objectid="2"/>
        </components></object>"#,
        r#"<item objectid="3"/>"#,
    );
    let bambu = r#"<config><object id="3"><part id="1" subtype="normal_part"/>
        <part id="2" subtype="negative_part"/></object></config>"#;
    vec![
        accepted("support.3mf", threemf_archive(&support, &[]), "an object of supports"),
        accepted(
            "not_printed.3mf",
            threemf_archive(&unprinted, &[]),
            "an item that is not printed",
        ),
        accepted(
            "negative_range.3mf",
            threemf_archive(&one, &[("Metadata/Slic3r_PE_model.config", &prusa)]),
            "a negative part, as PrusaSlicer writes it",
        ),
        accepted(
            "negative_part.3mf",
            threemf_archive(&parts, &[("Metadata/model_settings.config", bambu)]),
            "a negative part, as Bambu Studio writes it",
        ),
        accepted("zeros.glb", zero_padded(glb(&apart(cube(1)))), "its JSON is filled with zeros"),
        accepted("sparse.gltf", SPARSE.into(), "a sparse accessor"),
        refused(
            "quaternion.gltf",
            SPARSE.replace(r#""mesh":0}"#, r#""mesh":0,"rotation":[0,0,1,1]}"#).into_bytes(),
            "Malformed",
            "a quaternion of length 1.41",
        ),
    ]
}

/// Away from the planes about which `glb` and `dae` mirror a copy.
fn apart(mesh: Triangles) -> Triangles {
    (mesh.0.iter().map(|p| [p[0] + 9.0, p[1], p[2]]).collect(), mesh.1)
}

/// A binary glTF whose JSON ends with eight zeros.
fn zero_padded(bytes: Vec<u8>) -> Vec<u8> {
    let length = |at: usize| {
        bytes
            .get(at..at + 4)
            .map_or(0, |of| of.iter().rev().fold(0u32, |sum, &b| sum << 8 | u32::from(b)))
    };
    let (total, json) = (length(8) + 8, length(12) + 8);
    let end = 20 + length(12) as usize;
    let mut all = bytes[..8].to_vec();
    all.extend(total.to_le_bytes());
    all.extend(json.to_le_bytes());
    all.extend(&bytes[16..end]);
    all.extend([0; 8]);
    all.extend(&bytes[end..]);
    all
}

/// A tetrahedron whose fourth corner, (0, 0, 1), is in the sparse part.
const SPARSE: &str = r#"{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3",
"sparse":{"count":1,"indices":{"bufferView":2,"componentType":5121},"values":{"bufferView":3}}},
{"bufferView":1,"componentType":5121,"count":12,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12},
{"buffer":0,"byteOffset":60,"byteLength":1},{"buffer":0,"byteOffset":64,"byteLength":12}],
"buffers":[{"byteLength":76,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAAAAAAIBAAEDAQIDAgADAwAAAAAAAAAAAAAAAACAPw=="}]}
"#;

fn collada() -> Vec<Evil> {
    let whole = text(dae(&apart(cube(1))));
    let with = |from: &str, to: &str| whole.replacen(from, to, 1).into_bytes();
    let node = r##"<instance_geometry url="#g"/><instance_node"##;
    vec![
        accepted(
            "scene.dae",
            whole.clone().into_bytes(),
            "nothing: copies, polygons and triangles",
        ),
        accepted(
            "utf_16.dae",
            utf_16(&whole.replace("utf-8", "utf-16"), u16::to_le_bytes),
            "UTF-16",
        ),
        accepted("y_up.dae", with("Z_UP", "Y_UP"), "its y axis is up"),
        refused(
            "controller.dae",
            with(node, r##"<instance_controller url="#c"/><instance_node"##),
            "Malformed",
            "a node names no controller",
        ),
        refused(
            "count.dae",
            with(r#"<polygons count=""#, r#"<polygons count="1"#),
            "Malformed",
            "counts disagree",
        ),
        refused(
            "cycle.dae",
            with("<scale>", r##"<instance_node url="#m"/><scale>"##),
            "Malformed",
            "a node contains itself",
        ),
        refused(
            "cut.dae",
            whole.as_bytes()[..whole.len() - 20].to_vec(),
            "Malformed",
            "ends early",
        ),
        refused(
            "holes.dae",
            with("</polygons>", "<ph><p>0 1 2</p><h>3 4 5</h></ph></polygons>"),
            "Unsupported",
            "a polygon with a hole",
        ),
        refused("index.dae", with("<p>0 0 ", "<p>99 0 "), "Malformed", "a face names vertex 99"),
        refused(
            "lookat.dae",
            with("<scale>-1 1 2</scale>", "<lookat>0 0 0 1 0 0 0 0 1</lookat>"),
            "Unsupported",
            "a transform lookat",
        ),
        refused(
            "no_geometry.dae",
            with(r##"url="#g""##, r##"url="#h""##),
            "Malformed",
            "a node names no geometry",
        ),
        refused(
            "skin.dae",
            whole
                .replacen(node, r##"<instance_controller url="#c"/><instance_node"##, 1)
                .replacen("<library_nodes>", SKIN, 1)
                .into_bytes(),
            "Unsupported",
            "a skin",
        ),
    ]
}

const SKIN: &str = r##"<library_controllers><controller id="c"><skin source="#g"/></controller>
</library_controllers><library_nodes>"##;
