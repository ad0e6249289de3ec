//! `meshsweep robot`: an arm of small meshes. The truth is a chain in f64, by another formula.

use crate::support::{arg, ok, refused, run, scratch};
use meshsweep::robot::{Robot, RobotOptions};
use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::process::Command;

/// Name, parent and child, origin as shift and angles, and kind.
type Joint = (&'static str, &'static str, &'static str, Point, Point, &'static str);

/// The arm's joints.
const JOINTS: [Joint; 9] = [
    ("mount", "world", "base_link", [0.0; 3], [0.0; 3], "fixed"),
    ("board", "world", "table", [0.0, 0.0, -0.05], [0.0; 3], "fixed"),
    ("pan", "base_link", "shoulder", [0.0, 0.0, 0.089159], [0.0; 3], "revolute"),
    ("lift", "shoulder", "upperarm", [0.0; 3], [1.57, 0.0, 0.0], "revolute"),
    ("elbow", "upperarm", "forearm", [-0.425, 0.0, 0.0], [0.0; 3], "revolute"),
    ("flange", "forearm", "bare", [-0.39225, 0.0, 0.10915], [0.1, -0.2, 0.3], "fixed"),
    ("roll", "bare", "wrist", [0.0, -0.09465, 0.0], [1.57, 0.0, 0.0], "continuous"),
    ("left", "wrist", "Finger", [0.0, 0.03, 0.1], [0.0; 3], "prismatic"),
    ("right", "wrist", "finger", [0.0, -0.03, 0.1], [0.0; 3], "prismatic"),
];

/// ASCII STL of a box between two corners.
fn stl(low: [f64; 3], high: [f64; 3]) -> String {
    let corner = |at: usize| [0, 1, 2].map(|k| if at >> k & 1 == 0 { low[k] } else { high[k] });
    let faces =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let mut text = "solid box\n".to_owned();
    for [a, b, c, d] in faces {
        for triangle in [[a, b, c], [a, c, d]] {
            text += "facet normal 0 0 0\nouter loop\n";
            for [x, y, z] in triangle.map(corner) {
                let _ = writeln!(text, "vertex {x} {y} {z}");
            }
            text += "endloop\nendfacet\n";
        }
    }
    text + "endsolid box\n"
}

fn triple(x: [f64; 3]) -> String {
    x.map(|x| x.to_string()).join(" ")
}

/// The arm's file, each part replaced that `change` names.
fn arm(directory: &Path, change: &[(&str, &str)]) -> std::path::PathBuf {
    let folder = directory.join("my_arm");
    fs::create_dir_all(folder.join("meshes")).unwrap();
    let long = stl([-0.4, -0.04, -0.04], [0.0, 0.04, 0.04]);
    fs::write(folder.join("meshes/long.stl"), &long).unwrap();
    // Millimetres.
    fs::write(folder.join("meshes/short.stl"), stl([-50.0; 3], [50.0; 3])).unwrap();
    let mut text = "<?xml version=\"1.0\"?>\n<robot name=\"small arm\">\n".to_owned();
    let shapes = [
        ("world", "", ""),
        ("base_link", "0 0 0", "<mesh filename=\"meshes/short.stl\" scale=\"0.001 0.001 0.001\"/>"),
        ("table", "0.2 0 -0.2", "<box size=\"1.5 1 0.1\"/>"),
        ("shoulder", "0 0 0", "<cylinder radius=\"0.05\" length=\"0.12\"/>"),
        ("upperarm", "0 0 0.09", "<mesh filename=\"package://my_arm/meshes/long.stl\"/>"),
        ("forearm", "0 0 0.01", "<mesh filename=\"package://my_arm/meshes/long.stl\"/>"),
        ("bare", "", ""),
        ("wrist", "0 0 0.02", "<sphere radius=\"0.05\"/>"),
        ("Finger", "0 0 0.05", "<box size=\"0.02 0.01 0.1\"/>"),
        ("finger", "0 0 0.05", "<box size=\"0.02 0.01 0.1\"/>"),
    ];
    for (name, shift, shape) in shapes {
        let _ = writeln!(text, "<link name=\"{name}\">");
        if !shape.is_empty() {
            let origin = format!("<origin xyz=\"{shift}\" rpy=\"0 0 0.5\"/>");
            let _ = writeln!(text, "<collision>{origin}<geometry>{shape}</geometry></collision>");
        }
        text += "</link>\n";
    }
    for (name, parent, child, shift, turns, kind) in JOINTS {
        let _ = writeln!(text, "<joint name=\"{name}\" type=\"{kind}\">");
        let _ = writeln!(text, "<parent link=\"{parent}\"/><child link=\"{child}\"/>");
        let _ = writeln!(text, "<origin xyz=\"{}\" rpy=\"{}\"/>", triple(shift), triple(turns));
        text += match name {
            "left" => "<axis xyz=\"0 1 0\"/><limit lower=\"0\" upper=\"0.04\"/>\n",
            "right" => {
                "<axis xyz=\"0 -1 0\"/><limit lower=\"0\" upper=\"0.04\"/>\n\
                 <mimic joint=\"left\" multiplier=\"0.9\" offset=\"0.001\"/>\n"
            }
            "mount" | "board" | "flange" => "",
            "elbow" => "<axis xyz=\"0.3 0 2\"/><limit lower=\"-2.5\" upper=\"2.5\"/>\n",
            _ => "<axis xyz=\"0 0 1\"/><limit lower=\"-3.14\" upper=\"3.14\"/>\n",
        };
        text += "</joint>\n";
    }
    text += "</robot>\n";
    for (from, to) in change {
        assert!(text.contains(from), "{from}");
        text = text.replacen(from, to, 1);
    }
    let file = folder.join("arm.urdf");
    fs::write(&file, text).unwrap();
    file
}

type Point = [f64; 3];

fn about(axis: Point, angle: f64, p: Point) -> Point {
    let length = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
    let [x, y, z] = axis.map(|x| x / length);
    let across = [y * p[2] - z * p[1], z * p[0] - x * p[2], x * p[1] - y * p[0]];
    let (along, (sin, cos)) = (x * p[0] + y * p[1] + z * p[2], angle.sin_cos());
    [0, 1, 2].map(|k: usize| p[k] * cos + across[k] * sin + [x, y, z][k] * along * (1.0 - cos))
}

/// A point of a link in the world, at places in the order pan, lift, elbow, roll, left.
fn truth(link: &str, places: [f64; 5], mut p: Point) -> Point {
    let mut at = link;
    while let Some((name, parent, _, shift, turns, _)) = JOINTS.iter().find(|joint| joint.2 == at) {
        p = match *name {
            "pan" => about([0.0, 0.0, 1.0], places[0], p),
            "lift" => about([0.0, 0.0, 1.0], places[1], p),
            "elbow" => about([0.3, 0.0, 2.0], places[2], p),
            "roll" => about([0.0, 0.0, 1.0], places[3], p),
            "left" => [p[0], p[1] + places[4], p[2]],
            "right" => [p[0], p[1] - (0.9 * places[4] + 0.001), p[2]],
            _ => p,
        };
        for (axis, turn) in turns.iter().enumerate() {
            let mut unit = [0.0; 3];
            unit[axis] = 1.0;
            p = about(unit, *turn, p);
        }
        p = [0, 1, 2].map(|k: usize| p[k] + shift[k]);
        at = parent;
    }
    p
}

/// Places from a counter.
fn places(number: u32) -> [f32; 5] {
    let part = |k: u32| ((number * 37 + k * 101) % 97) as f32 / 97.0;
    let turn = |k: u32| 6.0 * part(k) - 3.0;
    [turn(1), turn(2), 0.8 * turn(3), turn(4), 0.04 * part(5)]
}

fn options() -> RobotOptions {
    let mut options = RobotOptions::default();
    options.keep = 0.01;
    options.samples = 100;
    options
}

/// Runs the emitted module: lines that it prints.
fn emitted(directory: &Path, body: &str) -> String {
    let user = directory.join("user.rs");
    let head = "#![deny(warnings)]\nmod arm;\n\
        use meshsweep_core::{Budget, Bvh, CoherentScene, QueryError, Scratch};\n";
    fs::write(&user, format!("{head}fn main() -> Result<(), QueryError> {{\n{body}\nOk(())\n}}\n"))
        .unwrap();
    // The library that this test is linked with, or another build of it.
    let own = std::env::current_exe().unwrap();
    let built = own.parent().unwrap();
    let mut libraries: Vec<_> =
        fs::read_dir(built).unwrap().flatten().map(|entry| entry.path()).collect();
    libraries.retain(|path| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        name.starts_with("libmeshsweep_core-") && name.ends_with(".rlib")
    });
    libraries.sort_by_key(|path| fs::metadata(path).and_then(|of| of.modified()).ok());
    let mut said = "no library".to_owned();
    for library in libraries.iter().rev() {
        let program = directory.join("user");
        let mut rustc = Command::new("rustc");
        rustc.args(["--edition=2024", "-L", arg(built), "-o", arg(&program), arg(&user)]);
        rustc.arg("--extern").arg(format!("meshsweep_core={}", arg(library)));
        let output = rustc.output().expect("rustc");
        if output.status.success() {
            let output = Command::new(program).output().expect("it starts");
            assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
            return String::from_utf8(output.stdout).unwrap();
        }
        said = String::from_utf8_lossy(&output.stderr).into_owned();
    }
    panic!("{said}");
}

#[test]
fn links_are_no_farther_from_their_places_than_their_poses_say() {
    let file = arm(&scratch("robot_truth"), &[]);
    let robot = Robot::read(&file, &options()).unwrap();
    let names: Vec<&str> = robot.links.iter().map(|link| link.name.as_str()).collect();
    assert_eq!(
        names,
        ["base_link", "shoulder", "upperarm", "forearm", "wrist", "Finger", "finger", "table"]
    );
    assert_eq!(robot.without_geometry, ["world", "bare"]);
    let moved: Vec<&str> = robot.places.iter().map(|place| place.joint.as_str()).collect();
    assert_eq!(moved, ["pan", "lift", "elbow", "roll", "left"]);
    let still = meshsweep_core::RoundedPose::exact(meshsweep_core::Pose::IDENTITY);
    let mut poses = vec![still; robot.joints.len()];
    for number in 0..2_000 {
        let places = places(number);
        meshsweep_core::link_poses(&robot.joints, &places, &mut poses).unwrap();
        for link in &robot.links {
            let found = &poses[usize::from(link.joint)];
            for point in [[0.0; 3], [0.03, -0.02, 0.01], [0.0, 0.0, -0.05]] {
                let exact = truth(&link.name, places.map(f64::from), point);
                let at = [0, 1, 2].map(|k: usize| {
                    let row = found.pose.rotation[k].map(f64::from);
                    let turned = row[0] * point[0] + row[1] * point[1] + row[2] * point[2];
                    turned + f64::from(found.pose.translation[k]) - exact[k]
                });
                let off = at.iter().map(|x| x * x).sum::<f64>().sqrt();
                let most = f64::from(found.motion(0.06)) + 1e-14;
                assert!(off <= most && most < 5e-5, "{}: {off:e} {most:e}", link.name);
            }
            assert!(found.motion(link.radius) <= link.rounding, "{}", link.name);
        }
    }
}

#[test]
fn the_emitted_module_compiles_without_warnings_and_gives_the_poses_of_the_library() {
    let directory = scratch("robot_emitted");
    // A link that has the name of the crate, and one that follows another by a factor near 1.
    let change = [
        ("\"table\"", "\"meshsweep_core\""),
        ("\"table\"", "\"meshsweep_core\""),
        ("multiplier=\"0.9\" offset=\"0.001\"", "multiplier=\"1.00000005\""),
    ];
    let (file, out) = (arm(&directory, &change), directory.join("arm"));
    let text = ok(["robot", arg(&file), "-o", arg(&out), "--keep", "0.01", "--samples", "100"]);
    for part in
        ["forearm", "arm_finger_2.msw", "without collision geometry, not guarded: world, bare"]
    {
        assert!(text.contains(part), "{part} in {text}");
    }
    let robot = Robot::read(&file, &options()).unwrap();
    let still = meshsweep_core::RoundedPose::exact(meshsweep_core::Pose::IDENTITY);
    let mut poses = vec![still; robot.joints.len()];
    let module = fs::read_to_string(directory.join("arm.rs")).unwrap();
    for part in
        ["follows: Some([1.0, 0.0])", "// - bare: no col", "// - shoulder and upperarm: neighbours"]
    {
        assert!(module.contains(part), "{part} in {module}");
    }
    // The use that the module's first lines show.
    let shown = module.lines().skip_while(|line| !line.starts_with("// let mut scratch"));
    let shown = shown.take_while(|line| *line != "//");
    let shown: Vec<&str> = shown.map(|line| line.strip_prefix("// ").unwrap_or(line)).collect();
    let mut body = "let (places, stop) = ([0.0; 5], || println!(\"stop\"));\n".to_owned()
        + &shown.join("\n")
        + "\nassert_eq!(ask(&[f32::NAN; 5]).err(), Some(QueryError::NotFinite));\n\
        for (wide, pair) in arm::pairs(&[0.25, -0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]).iter().zip(arm::PAIRS) {\n\
        let more: f64 = pair.models.iter().map(|&of| [0.25, 0.5, 0.0][usize::from(of.min(2))]).sum();\n\
        let over = f64::from(wide.distance) - f64::from(pair.distance) - more;\n\
        assert!((0.0..1e-6).contains(&over));\n\
        }\n\
        let still = arm::links(&arm::poses(&[0.0; 5])?)?;\n\
        let mut scene = CoherentScene::new(still, arm::PAIRS)?;\n\
        assert_eq!((arm::LINKS[3], arm::PLACES[4], arm::LIMITS[4]), (\"forearm\", \"left\", [0.0, 0.04]));\n\
        let far = arm::poses(&[0.0, 0.0, 0.0, 0.0, 1e6]);\n\
        assert_eq!(far, Err(QueryError::OutOfDomain));\n";
    let mut wanted = String::new();
    for number in 0..40 {
        let places = places(number);
        let _ = writeln!(
            body,
            "let poses = arm::poses(&{places:?})?;\n\
             for (link, found) in poses.iter().enumerate() {{ scene.move_to(link, found.pose)?; }}\n\
             println!(\"{{poses:?}} {{}}\", scene.within(Budget::EXACT, &mut scratch)?.is_clear());"
        );
        meshsweep_core::link_poses(&robot.joints, &places, &mut poses).unwrap();
        let own: Vec<_> = robot.links.iter().map(|link| poses[usize::from(link.joint)]).collect();
        let blobs: Vec<_> = robot.links.iter().map(|link| link.built.blob()).collect();
        let mut entries = vec![meshsweep_core::ScratchEntry::EMPTY; 512];
        let is_clear = robot.pairs.iter().all(|pair| {
            let [a, b] = pair.links;
            let relative = own[b].pose.relative_to(&own[a].pose).unwrap().pose;
            let [one, other] = [a, b].map(|link| blobs[link].bvh().unwrap());
            let exact = meshsweep_core::Budget::EXACT;
            let found = one.within_of(&other, relative, pair.distance, exact, &mut entries);
            found.unwrap().is_clear()
        });
        let _ = writeln!(wanted, "{own:?} {is_clear}");
    }
    let said = emitted(&directory, &body);
    assert_eq!(said.trim_start_matches("stop\n"), wanted);
    assert!(said.contains(" true\n") && said.contains(" false\n"));
}

#[test]
fn collision_shapes_of_a_link_are_one_mesh_scaled_turned_and_shifted() {
    let second = "</collision><collision><origin xyz=\"0 0 1\" rpy=\"0.3 0.4 0.5\"/>\
        <geometry><box size=\"0.1 0.2 0.3\"/></geometry></collision>\n</link>";
    let change = [("0.001 0.001 0.001", "0.001 -0.002 0.003"), ("</collision>\n</link>", second)];
    let file = arm(&scratch("robot_shapes"), &change);
    let robot = Robot::read(&file, &options()).unwrap();
    let mesh = &robot.links[0].built.loaded.as_ref().unwrap().mesh;
    let corners = |half: Point, turns: Point, shift: Point| {
        (0..8).map(move |at| {
            let signed = |k: usize| if at >> k & 1 == 0 { -half[k] } else { half[k] };
            let turned = about([1.0, 0.0, 0.0], turns[0], [0, 1, 2].map(signed));
            let turned = about([0.0, 1.0, 0.0], turns[1], turned);
            let turned = about([0.0, 0.0, 1.0], turns[2], turned);
            [0, 1, 2].map(|k: usize| turned[k] + shift[k])
        })
    };
    let first = corners([0.05, 0.1, 0.15], [0.0, 0.0, 0.5], [0.0; 3]);
    let all = first.chain(corners([0.05, 0.1, 0.15], [0.3, 0.4, 0.5], [0.0, 0.0, 1.0]));
    let mut found = mesh.positions.clone();
    for corner in all {
        let off = |p: &[f32; 3]| (0..3).map(|k| (f64::from(p[k]) - corner[k]).abs()).sum::<f64>();
        let at = found.iter().position(|p| off(p) < 2e-7).expect("the corner");
        found.swap_remove(at);
        let far = corner.iter().map(|x| x * x).sum::<f64>().sqrt();
        assert!(far <= f64::from(robot.links[0].radius));
    }
    assert!(found.is_empty());
    // Outward, though the mesh is mirrored.
    let corner = |v: u32| mesh.positions[v as usize].map(f64::from);
    let volume = mesh.triangles.iter().map(|triangle| {
        let [a, b, c] = triangle.map(corner);
        crate::support::dot(a, crate::support::cross(b, c)) / 6.0
    });
    assert!((volume.sum::<f64>() - 0.012).abs() < 1e-6);
}

#[test]
fn every_pair_is_kept_or_has_a_reason() {
    let directory = scratch("robot_pairs");
    // The upper arm always sticks in the base.
    let file = arm(&directory, &[("0.001 0.001 0.001", "0.003 0.003 0.003")]);
    let srdf = directory.join("arm.srdf");
    let disable = |a: &str, b: &str, why: &str| {
        format!("<disable_collisions link1=\"{a}\" link2=\"{b}\" reason=\"{why}\"/>\n")
    };
    let all = disable("wrist", "base_link", "Never")
        + &disable("base_link", "forearm", " never ")
        + &disable("wrist", "Finger", "Never")
        + &disable("finger", "Finger", "User")
        + &disable("lost", "wrist", "Adjacent");
    fs::write(&srdf, format!("<robot name=\"small arm\">\n{all}</robot>\n")).unwrap();
    let names = |robot: &Robot, [a, b]: [usize; 2]| {
        format!("{} {}", robot.links[a].name, robot.links[b].name)
    };
    let mut options = options();
    options.keep = 0.05;
    options.srdf = Some(srdf);
    options.keep_pairs = vec![(["table".to_owned(), "base_link".to_owned()], 0.002)];
    let robot = Robot::read(&file, &options).unwrap();
    assert_eq!(robot.pairs.len() + robot.skipped.len(), 8 * 7 / 2);
    let skipped: Vec<String> = robot
        .skipped
        .iter()
        .map(|(pair, why)| format!("{}: {why}", names(&robot, *pair)))
        .collect();
    assert_eq!(
        skipped,
        [
            "base_link shoulder: neighbours",
            "base_link upperarm: meet at every place that was tried",
            "shoulder upperarm: neighbours",
            "upperarm forearm: neighbours",
            "forearm wrist: neighbours",
            "wrist Finger: neighbours",
            "wrist finger: neighbours",
            "Finger finger: disabled by the SRDF",
        ]
    );
    assert_eq!((robot.never, robot.unknown.as_slice()), (2, &["lost".to_owned()][..]));
    let of = |wanted: &str| robot.pairs.iter().find(|pair| names(&robot, pair.links) == wanted);
    // Kept though fixed to each other, by its name; and though an SRDF found it far by sampling.
    let kept = of("base_link table").unwrap();
    assert!(kept.keep == 0.002 && kept.distance > 0.002 && kept.distance < 0.0021);
    assert_eq!(of("base_link wrist").unwrap().keep, 0.05);
    options.keep_pairs.clear();
    options.samples = 0;
    let robot = Robot::read(&file, &options).unwrap();
    let rigid = robot.skipped.iter().find(|(pair, _)| names(&robot, *pair) == "base_link table");
    assert_eq!(rigid.unwrap().1.to_string(), "fixed to each other");
    assert!(robot.pairs.iter().any(|pair| names(&robot, pair.links) == "base_link upperarm"));
    // Always near, but without contact: no larger distance leaves a pair out.
    options.samples = 100;
    let file = arm(&directory, &[]);
    let error = Robot::read(&file, &options).unwrap_err().to_string();
    assert!(error.contains("base_link, upperarm at 0.05") && error.contains("--keep"), "{error}");
    options.keep = 0.01;
    let robot = Robot::read(&file, &options).unwrap();
    assert!(robot.pairs.iter().any(|pair| names(&robot, pair.links) == "base_link upperarm"));
}

#[test]
fn collision_meshes_are_converted_from_their_unit_and_found_in_their_folder() {
    let directory = scratch("robot_meshes");
    let text = "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">\n\
        <asset><unit meter=\"0.01\"/><up_axis>Z_UP</up_axis></asset><library_geometries>\
        <geometry id=\"g\"><mesh><source id=\"p\"><float_array id=\"a\" count=\"12\">\
        0 0 0 30 0 0 0 20 0 0 0 10</float_array><technique_common>\
        <accessor source=\"#a\" count=\"4\" stride=\"3\"><param name=\"X\" type=\"float\"/>\
        <param name=\"Y\" type=\"float\"/><param name=\"Z\" type=\"float\"/></accessor>\
        </technique_common></source><vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/>\
        </vertices><triangles count=\"4\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>\
        <p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles></mesh></geometry></library_geometries>\
        <library_visual_scenes><visual_scene id=\"s\"><node><instance_geometry url=\"#g\"/></node>\
        </visual_scene></library_visual_scenes><scene><instance_visual_scene url=\"#s\"/></scene>\
        </COLLADA>\n";
    let change = [
        ("meshes/short.stl\" scale=\"0.001 0.001 0.001\"", "file://meshes/tetra.dae\""),
        ("package://my_arm/meshes", "package://my_arm//meshes"),
        // A joint that follows another needs no limits.
        ("<axis xyz=\"0 -1 0\"/><limit lower=\"0\" upper=\"0.04\"/>", "<axis xyz=\"0 -1 0\"/>"),
    ];
    let file = arm(&directory, &change);
    fs::write(directory.join("my_arm/meshes/tetra.dae"), text).unwrap();
    let robot = Robot::read(&file, &options()).unwrap();
    let base = &robot.links[0];
    assert_eq!(base.built.loaded.as_ref().unwrap().input_triangles, 4);
    assert!((0.3..0.300001).contains(&base.radius), "{}", base.radius);
}

#[test]
fn faults_of_a_description_are_refused_with_their_line() {
    let directory = scratch("robot_faults");
    let limit = "<limit lower=\"-3.14\" upper=\"3.14\"/>";
    let factor = "multiplier=\"0.9\"";
    let faults: [(&str, &str, &str); 25] = [
        (factor, "multiplier=\"1e39\"", "it mimics by numbers beyond f32"),
        (factor, "multiplier=\"1e-39\"", "it mimics by numbers beyond f32"),
        ("limit lower=\"0\" upper", "limit upper", "it has no lower"),
        ("package://my_arm/", "package:///", "a package and a file in it are wanted"),
        (
            "package://my_arm/",
            "package://my_arm/../my_arm/",
            "a package and a file in it are wanted",
        ),
        ("<box size=\"1.5 1 0.1\"", "<capsule radius=\"1\" length=\"2\"", "this shape is not read"),
        ("1.5 1 0.1", "1.5 1", "size \"1.5 1\": 3 finite numbers wanted"),
        ("1.5 1 0.1", "1.5 0 0.1", "a size of 0"),
        ("radius=\"0.05\" length", "radius=\"-1\" length", "radius wants a number above 0"),
        ("xyz=\"0 0 0.09\"", "xyz=\"0 nan 0\"", "xyz \"0 nan 0\": 3 finite numbers wanted"),
        ("meshes/short.stl", "meshes/none.stl", "none.stl"),
        ("package://my_arm/", "package://your_arm/", "--package your_arm=DIR"),
        ("meshes/short.stl", "http://short.stl", "only files and packages are read"),
        ("type=\"continuous\"", "type=\"floating\"", "floating: it has no place of one number"),
        ("type=\"continuous\"", "type=\"screw\"", "the type \"screw\" is not known"),
        ("0.3 0 2", "0 0 0", "an axis without length"),
        (limit, "", "it has no limit"),
        ("lower=\"-2.5\"", "lower=\"3\"", "lower is above upper"),
        ("<mimic joint=\"left\"", "<mimic joint=\"right\"", "which it mimics"),
        ("<mimic joint=\"left\"", "<mimic joint=\"board\"", "there is no \"board\" that moves"),
        ("<child link=\"finger\"/>", "<child link=\"Finger\"/>", "is carried by \"left\" already"),
        ("<child link=\"finger\"/>", "<child link=\"none\"/>", "there is no link \"none\""),
        ("<link name=\"finger\">", "<link name=\"Finger\">", "a second link of this name"),
        ("<parent link=\"wrist\"/>", "<parent link=\"finger\"/>", "go round in a circle"),
        ("<link name=\"bare\">", "<macro name=\"bare\"/><link name=\"bare\">", "xacro"),
    ];
    for (from, to, why) in faults {
        let change: &[(&str, &str)] = match why {
            // Two joints that carry each other.
            "go round in a circle" => &[
                (from, to),
                (
                    "<parent link=\"wrist\"/><child link=\"finger\"/>",
                    "<parent link=\"Finger\"/><child link=\"finger\"/>",
                ),
            ],
            _ => &[(from, to)],
        };
        let file = arm(&directory, change);
        let out = directory.join("faulty");
        let output = run(["robot", arg(&file), "-o", arg(&out), "--keep", "0.01"]);
        let said = refused(&output, 1, "arm.urdf, line ");
        assert!(said.contains(why), "{why}: {said}");
        assert!(!out.with_extension("rs").exists());
    }
    let file = arm(&directory, &[("<child link=\"base_link\"/>", "<child link=\"table\"/>")]);
    let out = directory.join("faulty");
    let twice = run(["robot", arg(&file), "-o", arg(&out), "--keep", "0.01"]);
    assert!(refused(&twice, 1, "arm.urdf").contains("already"));
    let file = arm(&directory, &[]);
    for keep in [&["--keep", "base_link,wrist=1"][..], &["--keep", "1", "--keep", "2"]] {
        let output = run([&["robot", arg(&file), "-o", arg(&out)], keep].concat());
        refused(&output, 2, "--keep");
    }
    let keep = ["--keep", "1", "--keep", "bare,wrist=1"];
    let output = run([&["robot", arg(&file), "-o", arg(&out)], &keep[..]].concat());
    assert!(refused(&output, 1, "arm.urdf").contains("no link \"bare\" with collision geometry"));
}

#[test]
fn json_has_what_the_table_has() {
    let directory = scratch("robot_json");
    let (file, out) = (arm(&directory, &[]), directory.join("arm.rs"));
    let args =
        ["robot", arg(&file), "-o", arg(&out), "--keep", "0.01", "--samples", "100", "--json"];
    let found: serde_json::Value = serde_json::from_str(&ok(args)).unwrap();
    let links = found["links"].as_array().unwrap();
    assert_eq!((links.len(), links[0]["triangles"].as_u64()), (8, Some(12)));
    // Beyond a cylinder of 50 mm: 1 / cos(π / 32) less 1, of its radius.
    let beyond = links[1]["beyond"].as_f64().unwrap();
    assert!((beyond - 0.05 * (1.0 / (std::f64::consts::PI / 32.0).cos() - 1.0)).abs() < 1e-12);
    let bytes = fs::metadata(links[0]["blob"].as_str().unwrap()).unwrap().len();
    assert_eq!(links[0]["bytes"].as_u64(), Some(bytes));
    let count = |key: &str| found[key].as_array().unwrap().len();
    assert_eq!((count("pairs") + count("skipped"), count("places")), (28, 5));
    assert_eq!(count("too_large"), 0);
    // A mesh in millimetres, read in metres.
    let (file, out) =
        (arm(&directory, &[(" scale=\"0.001 0.001 0.001\"", "")]), arg(&out).to_owned());
    let text = ok(["robot", arg(&file), "-o", &out, "--keep", "0.01", "--samples", "100"]);
    assert!(text.contains("all joints are apart: base_link; meshes are read in metres"), "{text}");
}
