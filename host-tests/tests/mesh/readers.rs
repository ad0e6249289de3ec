//! Random meshes in the styles of many programs: all say the same, and no cut file says less.

use std::fmt::Write as _;
use std::path::Path;

use meshsweep::mesh::{MeshError, RawMesh, read_bytes};
use meshsweep_host_tests::generate::Triangles;
use meshsweep_host_tests::generate::scenes::{glb, threemf};
use meshsweep_host_tests::generate::writers::{binary_ply, binary_stl};
use proptest::prelude::*;

fn parse(name: &str, bytes: Vec<u8>) -> Result<RawMesh, MeshError> {
    read_bytes(Path::new(name), bytes)
}

/// Corners of all triangles.
fn corners(raw: &RawMesh) -> Vec<[[f64; 3]; 3]> {
    raw.triangles.iter().map(|t| t.map(|v| raw.positions[v as usize])).collect()
}

fn wanted((positions, triangles): &Triangles) -> Vec<[[f64; 3]; 3]> {
    triangles.iter().map(|t| t.map(|v| positions[v as usize].map(f64::from))).collect()
}

fn meshes() -> impl Strategy<Value = Triangles> {
    let coordinate =
        prop_oneof![-1e3f32..1e3, Just(0.0), (-3i8..3).prop_map(f32::from), -1e-6f32..1e-6];
    (3usize..9).prop_flat_map(move |count| {
        let positions = prop::collection::vec(prop::array::uniform3(coordinate.clone()), count);
        let corner = 0..count as u32;
        let triangles = prop::collection::vec(prop::array::uniform3(corner), 1..12);
        (positions, triangles)
    })
}

/// What programs do with text.
#[derive(Clone, Debug)]
struct Style {
    end: &'static str,
    /// Between words.
    blank: &'static str,
    /// Before each line.
    indent: &'static str,
    is_upper: bool,
    encoding: u8,
    /// After the last line.
    padding: &'static str,
}

fn styles() -> impl Strategy<Value = Style> {
    let end = prop::sample::select(vec!["\n", "\r\n", "\r", " \n", "\n\n"]);
    let blank = prop::sample::select(vec![" ", "\t", "   "]);
    let indent = prop::sample::select(vec!["", "  ", "\t"]);
    let padding = prop::sample::select(vec!["", "\n\n", " ", "\0\0\0", "\x1A"]);
    (end, blank, indent, any::<bool>(), 0u8..5, padding).prop_map(
        |(end, blank, indent, is_upper, encoding, padding)| Style {
            end,
            blank,
            indent,
            is_upper,
            encoding,
            padding,
        },
    )
}

impl Style {
    /// Lines of words.
    fn text(&self, lines: &[String]) -> String {
        let mut text = String::new();
        for line in lines {
            let words: Vec<&str> = line.split(' ').collect();
            let _ = write!(text, "{}{}{}", self.indent, words.join(self.blank), self.end);
        }
        if self.is_upper { text.to_ascii_uppercase() } else { text }
    }

    fn encoded(&self, text: &str) -> Vec<u8> {
        let text = format!("{text}{}", self.padding);
        let marked = || format!("\u{FEFF}{text}");
        match self.encoding {
            0 => marked().into_bytes(),
            1 => marked().encode_utf16().flat_map(u16::to_le_bytes).collect(),
            2 => marked().encode_utf16().flat_map(u16::to_be_bytes).collect(),
            _ => text.into_bytes(),
        }
    }
}

fn point(p: [f32; 3]) -> String {
    let [x, y, z] = p.map(f64::from);
    format!("{x} {y} {z}")
}

/// ASCII STL in one of four layouts.
fn stl((positions, triangles): &Triangles, layout: u8) -> Vec<String> {
    let mut lines = vec!["solid a part".to_owned()];
    let close = [["endloop", "endfacet"], ["end loop", "end facet"]][usize::from(layout % 2)];
    for triangle in triangles {
        let mut facet = vec!["facet normal nan 0 -1.#IND".to_owned(), "outer loop".to_owned()];
        facet.extend(triangle.iter().map(|&v| format!("vertex {}", point(positions[v as usize]))));
        facet.extend(close.map(str::to_owned));
        match layout {
            0 | 1 => lines.extend(facet),
            _ => lines.push(facet.join(" ")),
        }
    }
    lines.push(
        ["endsolid a part", "end solid", "endsolidpart", "endsolid"][usize::from(layout % 4)]
            .into(),
    );
    lines
}

/// OBJ with one of three kinds of corners.
fn obj((positions, triangles): &Triangles, layout: u8) -> Vec<String> {
    let mut lines = vec!["# a part".to_owned(), "o part".to_owned(), "vn 0 0 1".to_owned()];
    lines.extend(positions.iter().map(|&p| format!("v {}", point(p))));
    let count = i64::try_from(positions.len()).expect("few");
    for triangle in triangles {
        let corners = triangle.map(|v| match layout % 4 {
            0 => format!("{}", v + 1),
            1 => format!("{}//1", v + 1),
            2 => format!("{}/1/1", v + 1),
            _ => format!("{}", i64::from(v) - count),
        });
        lines.push(format!("f {}", corners.join(" ")));
    }
    lines
}

/// OFF in one of four layouts.
fn off((positions, triangles): &Triangles, layout: u8) -> Vec<String> {
    let counts = format!("{} {} 0", positions.len(), triangles.len());
    let mut lines = match layout % 4 {
        0 => vec!["OFF".to_owned(), counts],
        1 => vec![format!("OFF{counts}")],
        2 => vec!["# a part".to_owned(), format!("OFF {counts}")],
        _ => vec!["OFF".to_owned(), counts.replace(' ', "\n")],
    };
    let points: Vec<String> = positions.iter().map(|&p| point(p)).collect();
    let faces: Vec<String> = triangles.iter().map(|[a, b, c]| format!("3 {a} {b} {c}")).collect();
    match layout % 4 {
        // Each number on a line, or all on one.
        3 => lines
            .extend([points, faces].concat().iter().flat_map(|l| l.split(' ')).map(str::to_owned)),
        2 => lines.push([points, faces].concat().join(" ")),
        _ => lines.extend([points, faces].concat()),
    }
    lines.iter().flat_map(|line| line.split('\n')).map(str::to_owned).collect()
}

/// ASCII PLY in one of four layouts, with properties that nobody wants.
fn ply((positions, triangles): &Triangles, layout: u8) -> Vec<String> {
    let mut lines: Vec<String> =
        ["ply", "comment a part", "format ascii 1.0", "obj_info of a program"]
            .map(str::to_owned)
            .to_vec();
    lines.push(format!("element vertex {}", positions.len()));
    lines.extend(["x", "nx", "y", "z"].map(|name| format!("property float64 {name}")));
    lines.push("comment more".into());
    lines.push(format!("element face {}", triangles.len()));
    lines.push("property list uchar float32 texcoord".into());
    lines.push(format!(
        "property list uint8 int32 vertex_ind{}",
        ["ex", "ices"][usize::from(layout % 2)]
    ));
    lines.push("end_header".into());
    let others = ["nan", "-inf", "1.#QNAN", "-1.#IND"];
    let points = positions.iter().enumerate().map(|(i, &p)| {
        let [x, y, z] = p.map(f64::from);
        format!("{x} {} {y} {z}", others[i % 4])
    });
    let faces = triangles.iter().map(|[a, b, c]| format!("2 0.5 nan 3 {a} {b} {c}"));
    let all: Vec<String> = points.chain(faces).collect();
    match layout % 4 {
        2 => lines.push(all.join(" ")),
        3 => lines.extend(all.iter().flat_map(|line| line.split(' ')).map(str::to_owned)),
        _ => lines.extend(all),
    }
    lines
}

/// COLLADA whose triangles are in one of four kinds of lists.
fn dae((positions, triangles): &Triangles, style: &Style, layout: u8) -> String {
    let points: Vec<String> = positions.iter().map(|&p| format!("{} 7", point(p))).collect();
    let lists: Vec<String> =
        triangles.iter().map(|t| t.map(|v| format!("9 {v}")).join(style.blank)).collect();
    let (begin, end) =
        [("triangles", ""), ("polylist", "vcount"), ("polygons", "p"), ("tristrips", "p")]
            [usize::from(layout % 4)];
    let mut primitive = format!(
        r##"<{begin} count="{}"><input semantic="NORMAL" source="#n" offset="0"/>
        <input semantic="VERTEX" source="#v" offset="1"/>"##,
        triangles.len()
    );
    match end {
        "p" => lists.iter().for_each(|list| primitive += &format!("<p>{list}</p>")),
        "vcount" => {
            let sizes = vec!["3"; triangles.len()].join(style.end);
            primitive += &format!("<vcount>{sizes}</vcount><p>{}</p>", lists.join(style.end));
        }
        _ => primitive += &format!("<p>{}</p>", lists.join(style.end)),
    }
    format!(
        r##"<?xml version="1.0"?><c:COLLADA version="1.4.1" xmlns:c="urn:c"><library_geometries>
        <geometry id="g"><mesh><source id="s"><float_array id="a" count="{}">
        {}</float_array><technique_common><accessor source="#a" count="{}" stride="4">
        <param name="X"/><param name="Y"/><param name="Z"/><param/></accessor></technique_common></source>
        <vertices id="v"><input semantic="POSITION" source="#s"/></vertices>{primitive}</{begin}>
        </mesh></geometry></library_geometries></c:COLLADA>"##,
        4 * positions.len(),
        points.join(style.end),
        positions.len()
    )
}

/// Bytes of a mesh in a format of text.
fn in_text(kind: &str, mesh: &Triangles, style: &Style, layout: u8) -> Vec<u8> {
    // The names of PLY and COLLADA are not the same in capitals.
    let plain = Style { is_upper: false, ..style.clone() };
    let lines = match kind {
        "stl" => stl(mesh, layout),
        "obj" => obj(mesh, layout),
        "off" => off(mesh, layout),
        "ply" => ply(mesh, layout),
        _ => return style.encoded(&dae(mesh, style, layout)),
    };
    let style = if kind == "ply" { &plain } else { style };
    style.encoded(&style.text(&lines))
}

const TEXTS: [&str; 5] = ["stl", "obj", "off", "ply", "dae"];

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_mesh_reads_the_same_in_all_styles_of_text(
        mesh in meshes(),
        style in styles(),
        layout in 0u8..4,
    ) {
        for kind in TEXTS {
            let bytes = in_text(kind, &mesh, &style, layout);
            // A strip leaves out triangles of two equal corners.
            let is_strip = kind == "dae" && layout == 3;
            let is_kept = |[a, b, c]: &[u32; 3]| !is_strip || (a != b && b != c && c != a);
            let all = mesh.1.iter().zip(wanted(&mesh)).filter(|(triangle, _)| is_kept(triangle));
            let all: Vec<_> = all.map(|(_, corners)| corners).collect();
            let raw = parse(&format!("a.{kind}"), bytes.clone());
            if let (Err(MeshError::NoTriangles { .. }), []) = (&raw, &all[..]) {
                continue;
            }
            let raw = raw.unwrap_or_else(|e| panic!("{e}\n{}", String::from_utf8_lossy(&bytes)));
            prop_assert_eq!(corners(&raw), all, "{}", String::from_utf8_lossy(&bytes));
        }
    }

    #[test]
    fn binary_files_read_the_same_with_any_ends_of_lines_and_attributes(
        mesh in meshes(),
        end in prop::sample::select(vec!["\n", "\r\n", "\r"]),
        attributes in prop::collection::vec(0u16..9, 12),
        begin in prop::sample::select(vec!["solid a\nb", "\u{FEFF}solid", "", "facet solid"]),
    ) {
        let bytes = binary_ply(&mesh);
        let header = bytes.windows(11).position(|at| at == b"end_header\n").unwrap() + 11;
        let text = String::from_utf8(bytes[..header].to_vec()).unwrap().replace('\n', end);
        let raw = parse("a.ply", [text.as_bytes(), &bytes[header..]].concat()).unwrap();
        prop_assert_eq!(corners(&raw), wanted(&mesh));

        let mut bytes = binary_stl(&mesh);
        bytes[..begin.len()].copy_from_slice(begin.as_bytes());
        prop_assert_eq!(corners(&parse("a.stl", bytes.clone()).unwrap()), wanted(&mesh));
        let mut with_attributes = bytes[..84].to_vec();
        for (triangle, count) in bytes[84..].chunks(50).zip(&attributes) {
            with_attributes.extend(&triangle[..48]);
            with_attributes.extend(count.to_le_bytes());
            with_attributes.extend(vec![0x42; usize::from(*count)]);
        }
        prop_assert_eq!(corners(&parse("a.stl", with_attributes).unwrap()), wanted(&mesh));
    }

    #[test]
    fn a_cut_file_has_all_triangles_or_is_refused(
        mesh in meshes(),
        style in styles(),
        layout in 0u8..4,
        at in 0.0f64..1.0,
    ) {
        // OBJ has neither counts nor an end.
        let texts = TEXTS.iter().filter(|kind| **kind != "obj");
        let texts = texts.map(|kind| (*kind, in_text(kind, &mesh, &style, layout)));
        let binary = [
            ("stl", binary_stl(&mesh)),
            ("ply", binary_ply(&mesh)),
            ("glb", glb(&mesh)),
            ("3mf", threemf(&mesh)),
        ];
        for (kind, bytes) in texts.chain(binary) {
            let name = format!("a.{kind}");
            let whole = parse(&name, bytes.clone()).map(|raw| raw.triangles.len());
            let cut = bytes[..(bytes.len() as f64 * at) as usize].to_vec();
            if let (Ok(whole), Ok(cut)) = (whole, parse(&name, cut)) {
                prop_assert_eq!(cut.triangles.len(), whole, "{}", kind);
            }
        }
    }
}
