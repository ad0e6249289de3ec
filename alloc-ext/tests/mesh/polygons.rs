//! Polygons as triangles: concave ones are split as they are, and those that cannot be are named.

use std::path::Path;

use glam::{DVec3, I64Vec2, dvec3};
use meshsweep::mesh::{MeshError, RawMesh, key_frame, read_bytes, repair, require_closed_manifold};

/// The faces of a prism, 1 high, over an L: corners 0 to 5 below, 6 to 11 above. The corner (2, 0),
/// at which the caps begin, does not see all of the L.
const PROFILE: [[i64; 2]; 6] = [[2, 0], [2, 1], [1, 1], [1, 2], [0, 2], [0, 0]];

fn l_prism() -> (Vec<[i64; 3]>, Vec<Vec<usize>>) {
    let positions = [0, 1].iter().flat_map(|&z| PROFILE.map(|[x, y]| [x, y, z])).collect();
    let walls = (0..6).map(|k| vec![k, (k + 1) % 6, (k + 1) % 6 + 6, k + 6]);
    let caps = [vec![0, 5, 4, 3, 2, 1], (6..12).collect()];
    (positions, caps.into_iter().chain(walls).collect())
}

/// The same faces in each format that has polygons.
fn in_all_formats(positions: &[[i64; 3]], faces: &[Vec<usize>]) -> Vec<RawMesh> {
    let words = |list: &mut dyn Iterator<Item = i64>| {
        list.map(|x| x.to_string()).collect::<Vec<_>>().join(" ")
    };
    let lines = |head: &str, lists: &[Vec<i64>]| -> String {
        lists.iter().map(|list| format!("{head}{}\n", words(&mut list.iter().copied()))).collect()
    };
    let at: Vec<Vec<i64>> = positions.iter().map(|p| p.to_vec()).collect();
    let from = |first: i64, with_size: bool| -> Vec<Vec<i64>> {
        let size = |face: &Vec<usize>| with_size.then(|| face.len().cast_signed() as i64);
        let named = |face: &Vec<usize>| {
            face.iter().map(|&v| v.cast_signed() as i64 + first).collect::<Vec<_>>()
        };
        faces.iter().map(|face| size(face).into_iter().chain(named(face)).collect()).collect()
    };
    let counted = lines("", &from(0, true));
    let (vertices, count) = (lines("", &at), faces.len());
    // Faces first: then their vertices are not known when they are read.
    let obj = lines("f ", &from(1, false)) + &lines("v ", &at);
    let off = format!("OFF\n{} {count} 0\n{vertices}{counted}", at.len());
    let ply = format!(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\n\
         property double z\nelement face {count}\nproperty list uchar int vertex_indices\n\
         end_header\n{vertices}{counted}",
        at.len()
    );
    let facets: String = faces
        .iter()
        .map(|face| {
            let corners: Vec<Vec<i64>> = face.iter().map(|&v| at[v].clone()).collect();
            let vertices = lines("vertex ", &corners);
            format!("facet normal 0 0 0\nouter loop\n{vertices}endloop\nendfacet\n")
        })
        .collect();
    let stl = format!("solid\n{facets}endsolid\n");
    let parse = |(name, text): (&str, String)| read_bytes(Path::new(name), text.into()).unwrap();
    [("a.obj", obj), ("a.off", off), ("a.ply", ply), ("a.stl", stl)].map(parse).into()
}

fn corners(raw: &RawMesh) -> Vec<[DVec3; 3]> {
    raw.triangles.iter().map(|t| t.map(|v| DVec3::from(raw.positions[v as usize]))).collect()
}

/// By the plane and, if the foot is outside, the three sides.
fn distance([a, b, c]: [DVec3; 3], p: DVec3) -> f64 {
    let normal = (b - a).cross(c - a).normalize();
    let foot = p - normal * (p - a).dot(normal);
    let sides = [[a, b], [b, c], [c, a]];
    if sides.iter().all(|&[u, v]| (v - u).cross(foot - u).dot(normal) >= 0.0) {
        return (p - foot).length();
    }
    let to_side = |[u, v]: [DVec3; 2]| {
        let t = ((p - u).dot(v - u) / (v - u).length_squared()).clamp(0.0, 1.0);
        (p - u - (v - u) * t).length()
    };
    sides.map(to_side).into_iter().fold(f64::INFINITY, f64::min)
}

#[test]
fn concave_caps_are_split_as_they_are_in_every_format() {
    let (positions, faces) = l_prism();
    for raw in in_all_formats(&positions, &faces) {
        let name = raw.file.display().to_string();
        let triangles = corners(&raw);
        assert_eq!((raw.polygons.split, raw.polygons.by_ears), (8, 2), "{name}");
        assert_eq!((raw.polygons.unsound.count, triangles.len()), (0, 2 * 4 + 6 * 2), "{name}");
        // Numbers of triangles count through the faces, so the caps are the first four and the
        // next. Small integers: all sums are exact.
        let area_vector = |t: &[[DVec3; 3]]| -> Vec<DVec3> {
            t.iter().map(|[a, b, c]| (b - a).cross(c - a)).collect()
        };
        let [below, above] = [&triangles[..4], &triangles[4..8]].map(area_vector);
        assert!(below.iter().all(|n| n.x == 0.0 && n.y == 0.0 && n.z < 0.0), "{name}: {below:?}");
        assert!(above.iter().all(|n| n.x == 0.0 && n.y == 0.0 && n.z > 0.0), "{name}: {above:?}");
        assert_eq!((below.iter().sum(), above.iter().sum()), (-6.0 * DVec3::Z, 6.0 * DVec3::Z));
        let volume: f64 = triangles.iter().map(|[a, b, c]| a.dot(b.cross(*c))).sum();
        assert_eq!(volume, 18.0, "{name}");

        let in_notch = dvec3(1.4, 1.4, 1.05);
        let nearest = triangles.iter().map(|&t| distance(t, in_notch)).fold(9.0, f64::min);
        assert!((nearest - 0.4f64.hypot(0.05)).abs() < 1e-12, "{name}: {nearest}");

        let (mesh, report) = repair(raw).unwrap();
        require_closed_manifold(&mesh).unwrap();
        assert!(report.is_clean(), "{name}: {report}");
        let said = report.to_string();
        assert!(said.contains("\n  8 polygons split: "), "{said}");
        assert!(said.contains("\n  2 concave polygons split by ears\n") || said.ends_with("ears"));
    }
}

#[test]
fn polygons_that_their_first_corner_sees_keep_the_fan_about_it() {
    let outlines: [&[[i64; 2]]; 6] = [
        &[[0, 0], [3, 0], [3, 2], [0, 2]],
        // Corners on straight sides.
        &[[0, 0], [1, 0], [2, 0], [2, 2], [0, 2], [0, 1]],
        // Concave, first at the reflex corner and then opposite to it.
        &[[1, 1], [0, 3], [0, 0], [3, 0]],
        &[[0, 0], [3, 0], [1, 1], [0, 3]],
        // A corner given twice.
        &[[0, 0], [3, 0], [3, 0], [0, 2]],
        // On one line.
        &[[0, 0], [2, 2], [1, 1], [3, 3]],
    ];
    for outline in outlines {
        let positions: Vec<[i64; 3]> = outline.iter().map(|&[x, y]| [x, 5, y]).collect();
        for raw in in_all_formats(&positions, &[(0..outline.len()).collect()]) {
            assert_eq!((raw.polygons.by_ears, raw.polygons.unsound.count), (0, 0), "{outline:?}");
            if raw.positions.len() == outline.len() {
                let fan: Vec<_> = (1..outline.len() as u32 - 1).map(|k| [0, k, k + 1]).collect();
                assert_eq!(raw.triangles, fan, "{outline:?}");
            }
        }
    }
}

/// A sequence without a source of chance.
struct Sequence(u64);

impl Sequence {
    fn below(&mut self, end: i64) -> i64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (self.0 >> 33).cast_signed() % end
    }
}

fn twice_area([a, b, c]: [I64Vec2; 3]) -> i64 {
    (b - a).perp_dot(c - a)
}

/// A polygon that is star-shaped about the origin, from any of its corners on, counter-clockwise.
fn star(sequence: &mut Sequence) -> Vec<I64Vec2> {
    let count = 4 + sequence.below(24);
    let start = sequence.below(count);
    let corner = |k: i64| {
        let angle = ((k + start) % count) as f64 * std::f64::consts::TAU / count as f64;
        let radius = 100 + sequence.below(1000);
        let at = glam::DVec2::from_angle(angle) * radius as f64;
        at.round().as_i64vec2()
    };
    (0..count).map(corner).collect()
}

#[test]
fn no_triangle_of_a_star_polygon_in_any_plane_is_turned_over_and_none_is_missing() {
    let sequence = &mut Sequence(1);
    let mut by_ears = 0;
    for _ in 0..300 {
        let mut outline = star(sequence);
        // Seen from the other side, the polygon runs clockwise.
        let is_turned = sequence.below(2) == 1;
        if is_turned {
            outline.reverse();
        }
        // Whole numbers: the corners lie in one plane exactly.
        let axes: [[i64; 3]; 2] = [(); 2].map(|()| [(); 3].map(|()| sequence.below(19) - 9));
        let normal = glam::I64Vec3::from(axes[0]).cross(axes[1].into());
        if normal == glam::I64Vec3::ZERO {
            continue;
        }
        let place = |p: &I64Vec2| [0, 1, 2].map(|k| axes[0][k] * p.x + axes[1][k] * p.y + 7);
        let positions: Vec<[i64; 3]> = outline.iter().map(place).collect();
        let raw = &in_all_formats(&positions, &[(0..outline.len()).collect()])[0];
        assert_eq!(raw.polygons.unsound.count, 0, "{outline:?}");
        assert_eq!(raw.triangles.len(), outline.len() - 2, "{outline:?}");
        let areas: Vec<i64> = raw
            .triangles
            .iter()
            .map(|t| twice_area(t.map(|v| outline[v as usize])) * if is_turned { -1 } else { 1 })
            .collect();
        assert!(areas.iter().all(|&area| area >= 0), "{outline:?}: {areas:?}");
        let edges = outline.iter().zip(outline.iter().cycle().skip(1));
        let whole: i64 = edges.map(|(p, q)| p.perp_dot(*q)).sum();
        assert_eq!(areas.iter().sum::<i64>(), whole.abs(), "{outline:?}");
        by_ears += raw.polygons.by_ears;
    }
    assert!(by_ears > 150, "{by_ears}");
}

#[test]
fn antennas_of_a_polygon_keep_to_its_outline() {
    let sequence = &mut Sequence(7);
    for _ in 0..300 {
        let plain = star(sequence);
        let mut outline = plain.clone();
        for _ in 0..=sequence.below(3) {
            let foot = sequence.below(outline.len().cast_signed() as i64) as usize;
            let far = |sequence: &mut Sequence| {
                I64Vec2::new(sequence.below(4001) - 2000, sequence.below(4001) - 2000)
            };
            let (tip, bend) = (far(sequence), far(sequence));
            let at = outline[foot];
            let antenna = match sequence.below(3) {
                0 => vec![tip, at],
                1 => vec![bend, tip, bend, at],
                // Along the next side, and back over it.
                _ => {
                    let side = outline[(foot + 1) % outline.len()] - at;
                    vec![at + side * 2]
                }
            };
            outline.splice(foot + 1..foot + 1, antenna);
        }
        let positions: Vec<[i64; 3]> = outline.iter().map(|p| [p.x, p.y, 0]).collect();
        let raw = &in_all_formats(&positions, &[(0..outline.len()).collect()])[0];
        assert_eq!(raw.polygons.unsound.count, 0, "{outline:?}");
        let at = |v: u32| outline[v as usize];
        let areas: Vec<i64> = raw.triangles.iter().map(|t| twice_area(t.map(at))).collect();
        let edges = plain.iter().zip(plain.iter().cycle().skip(1));
        let whole: i64 = edges.map(|(p, q)| p.perp_dot(*q)).sum();
        assert!(areas.iter().all(|&area| area >= 0), "{outline:?}: {areas:?}");
        assert_eq!((areas.len(), areas.iter().sum::<i64>()), (outline.len() - 2, whole));
    }
}

#[test]
fn a_bridge_to_a_hole_and_corners_on_straight_sides_are_split_by_ears() {
    // A square with a square hole, and a comb with corners on its straight back.
    let holed: &[[i64; 2]] =
        &[[0, 0], [9, 0], [9, 9], [0, 9], [0, 0], [3, 3], [3, 6], [6, 6], [6, 3], [3, 3]];
    let comb: &[[i64; 2]] =
        &[[6, 0], [6, 9], [5, 1], [4, 9], [3, 1], [2, 9], [0, 0], [1, 0], [2, 0], [4, 0]];
    for (outline, twice) in [(holed, 2 * (81 - 9)), (comb, 58)] {
        let positions: Vec<[i64; 3]> = outline.iter().map(|&[x, y]| [x, y, 0]).collect();
        let raw = &in_all_formats(&positions, &[(0..outline.len()).collect()])[0];
        assert_eq!((raw.polygons.by_ears, raw.polygons.unsound.count), (1, 0), "{outline:?}");
        let at = |v: u32| I64Vec2::from(outline[v as usize]);
        let areas: Vec<i64> = raw.triangles.iter().map(|t| twice_area(t.map(at))).collect();
        assert!(areas.iter().all(|&area| area > 0), "{areas:?}");
        assert_eq!((areas.len(), areas.iter().sum::<i64>()), (outline.len() - 2, twice));
    }
}

#[test]
fn polygons_that_cross_themselves_keep_the_fan_and_are_named() {
    let outlines: [&[[i64; 2]]; 4] = [
        // A bow tie.
        &[[0, 0], [2, 2], [2, 0], [0, 3]],
        // A pentagram: it turns left everywhere, and twice around.
        &[[0, 0], [6, 4], [-2, 4], [4, 0], [2, 7]],
        // Twice around a square.
        &[[0, 0], [2, 0], [2, 2], [0, 2], [0, 0], [2, 0], [2, 2], [0, 2]],
        // A small loop inside a large one.
        &[[0, 0], [9, 0], [9, 9], [0, 9], [0, 0], [4, 2], [3, 4]],
    ];
    for outline in outlines {
        let mut positions: Vec<[i64; 3]> = outline.iter().map(|&[x, y]| [x, y, 0]).collect();
        positions.extend([[20, 0, 0], [21, 0, 0], [20, 1, 0]]);
        let count = outline.len();
        let faces = [(count..count + 3).collect(), (0..count).collect()];
        for raw in in_all_formats(&positions, &faces) {
            let name = raw.file.display().to_string();
            let (split, unsound) = (raw.polygons.split, raw.polygons.unsound);
            assert_eq!((split, unsound.count), (1, 1), "{name}: {outline:?}");
            assert_eq!(raw.triangles.len(), count - 1, "{name}: {outline:?}");
            let place = unsound.first.unwrap();
            // OBJ counts from 1, as its errors do.
            assert_eq!(place.face, 1 + usize::from(name == "a.obj"));
            let said = repair(raw).unwrap().1;
            assert!(!said.is_clean());
            let wanted = format!(
                "1 polygon too warped or crossing itself, split about its first corner: face {}, \
                 line {}",
                place.face,
                place.line.unwrap()
            );
            assert!(said.to_string().contains(&wanted), "{said}");
        }
    }
}

#[test]
fn faces_of_fewer_than_three_corners_are_counted_and_the_first_is_named() {
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2\nf 3\nl 1 2\np 1\n";
    let off = "OFF\n3 3 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n2 0 1\n1 2\n";
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
        property float z\nelement face 3\nproperty list uchar int vertex_indices\nend_header\n\
        0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n2 0 1\n0\n";
    for (name, text, place, others) in [
        ("a.obj", obj, "face 2, line 5", 2),
        ("a.off", off, "face 1, line 7", 0),
        ("a.ply", ply, "face 1, line 14", 0),
    ] {
        let raw = read_bytes(Path::new(name), text.into()).unwrap();
        assert_eq!((raw.triangles.len(), raw.left_out.small_faces.count), (1, 2), "{name}");
        assert_eq!(raw.left_out.lines_and_points, others, "{name}");
        let (_, report) = repair(raw).unwrap();
        assert!(!report.is_clean());
        let wanted = format!("\n  2 faces of fewer than three corners left out: {place} …");
        assert!(report.to_string().contains(&wanted), "{report}");
    }
}

#[test]
fn a_polygon_before_its_vertices_that_names_none_is_refused() {
    let ply = "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\n\
        element vertex 3\nproperty float x\nproperty float y\nproperty float z\nend_header\n\
        4 0 1 2 3\n0 0 0\n1 0 0\n0 1 0\n";
    let error = read_bytes(Path::new("a.ply"), ply.into()).unwrap_err();
    assert!(matches!(error, MeshError::IndexOutOfRange { index: 3, .. }), "{error}");
}

#[test]
fn a_frame_in_which_another_polygon_is_concave_keeps_the_triangles_of_the_first_mesh() {
    let (positions, faces) = l_prism();
    // The corner at the bottom of the notch moves until the caps are convex.
    let mut filled = positions.clone();
    for corner in [2, 8] {
        filled[corner] = [2, 2, filled[corner][2]];
    }
    let meshes = [&positions, &filled].map(|positions| in_all_formats(positions, &faces));
    let [concave, convex] = &meshes;
    for (first, frame) in concave.iter().zip(convex).chain(convex.iter().zip(concave)) {
        assert_ne!(first.polygons.by_ears, frame.polygons.by_ears);
        let (mesh, _) = repair(first.clone()).unwrap();
        let found = key_frame(first, &mesh, frame);
        if first.file.ends_with("a.stl") {
            // Its vertices have no numbers.
            assert!(matches!(found, Err(MeshError::FrameTriangle { .. })), "{found:?}");
            continue;
        }
        let places = mesh.vertex_source.iter().map(|&v| frame.positions[v as usize]);
        let places: Vec<[f32; 3]> = places.map(|p| p.map(|x| x as f32)).collect();
        assert_eq!(found.unwrap().positions, places);
    }
}
