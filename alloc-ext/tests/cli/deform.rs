//! Meshes that deform: key frames built, asked, described, refused.

use crate::overlap::{meeting, poses};
use crate::support::{
    Triangle, arg, blob, coarse_torus, distance, info, number, ok, parse_csv, refused, run,
    scratch, triangles,
};
use std::fs;
use std::path::{Path, PathBuf};

/// A torus in OBJ, and the same bent.
fn frames(directory: &Path) -> [PathBuf; 2] {
    let rest = coarse_torus(directory);
    let text = fs::read_to_string(&rest).expect("just written");
    let bent = text.lines().map(|line| match line.strip_prefix("v ") {
        Some(place) => {
            let place: Vec<f64> = place.split(' ').map(|x| x.parse().expect("a number")).collect();
            let [x, y, z] = [place[0] as f32, place[1] as f32, place[2] as f32];
            format!("v {} {} {}\n", -x, 0.5 * y, z + 0.25 * x * x)
        }
        None => format!("{line}\n"),
    });
    let file = directory.join("bent.obj");
    fs::write(&file, bent.collect::<String>()).expect("it can be written");
    [rest, file]
}

fn build(directory: &Path, meshes: &[&Path]) -> std::process::Output {
    let output = directory.join("bend.msw");
    let meshes: Vec<&str> = meshes.iter().map(|mesh| arg(mesh)).collect();
    run([&["build"], meshes.as_slice(), &["-o", arg(&output), "--for", "deform"]].concat())
}

#[test]
fn frames_are_answered_as_the_files_say() {
    let directory = scratch("deform_frames");
    let [rest, bent] = frames(&directory);
    let built = build(&directory, &[&rest, &bent]);
    let report = String::from_utf8(built.stdout).expect("UTF-8");
    assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
    assert!(report.contains("closest --frame"), "{report}");
    assert!(report.contains("  key frames: 0 to 1\n"), "{report}");
    let output = directory.join("bend.msw");
    let told = info(&output);
    let deformation = &told["deformation"];
    assert_eq!(deformation["frames"], 2);
    let records = deformation["vertex_records"].as_u64().expect("a count");
    assert!(report.contains(&format!("{records} vertex records of 16 bytes")), "{report}");
    assert_eq!(deformation["vertex_record_bytes"], 16 * records);
    let (from, to) = (triangles(&rest), triangles(&bent));
    for (frame, part) in [("0", 0.0), ("0.25", 0.25), ("1", 1.0)] {
        let between = |(a, b): (&Triangle, &Triangle)| {
            std::array::from_fn(|i| std::array::from_fn(|k| a[i][k] + (b[i][k] - a[i][k]) * part))
        };
        let at: Vec<Triangle> = from.iter().zip(&to).map(between).collect();
        let answer = ok(["closest", arg(&output), "3,1,2", "-0.5,0.25,0", "--frame", frame]);
        let rows = parse_csv(&answer, "x,y,z,lower,upper,px,py,pz,triangle,work");
        assert_eq!(rows.len(), 2);
        for row in rows {
            let p = [0, 1, 2].map(|k| number(&row[k]));
            let truth = distance(p, &at);
            let (lower, upper) = (number(&row[3]), number(&row[4]));
            assert!(lower <= truth + 1e-12 && truth - 1e-12 <= upper, "{frame}: {row:?}: {truth}");
            assert!(upper - lower < 1e-5, "{row:?}");
        }
    }
    let output = arg(&output);
    let wrong = run(["closest", output, "1,2,3", "--frame", "x"]);
    let line = String::from_utf8_lossy(&wrong.stderr);
    assert!(wrong.status.code() == Some(2) && line.contains("a key frame from 0"), "{line}");
    for frame in ["-1", "1.5", "nan"] {
        let output = run(["closest", output, "1,2,3", &format!("--frame={frame}")]);
        let message = refused(&output, 1, "bend.msw");
        assert!(message.contains("key frames are 0 to 1"), "{message}");
    }
}

/// The torus without every seventh face.
fn holed(mesh: &Path, directory: &Path, name: &str) -> PathBuf {
    let text = fs::read_to_string(mesh).expect("just written");
    let mut face = 0;
    let kept = text.lines().filter(|line| {
        face += usize::from(line.starts_with("f "));
        !line.starts_with("f ") || face % 7 != 0
    });
    let file = directory.join(name);
    fs::write(&file, kept.flat_map(|line| [line, "\n"]).collect::<String>()).expect("written");
    file
}

#[test]
fn an_open_mesh_deforms_with_a_hierarchy_for_sweeps() {
    let directory = scratch("deform_open");
    let [rest, bent] = frames(&directory);
    let (rest, bent) = (holed(&rest, &directory, "o.obj"), holed(&bent, &directory, "b.obj"));
    let message = refused(&build(&directory, &[&rest, &bent]), 1, "o.obj");
    assert!(message.contains("--for sweep"), "{message}");
    let output = directory.join("open.msw");
    let meshes = [arg(&rest), arg(&bent)];
    ok([&["build"], &meshes[..], &["-o", arg(&output), "--for", "sweep,deform"]].concat());
    let (from, to) = (triangles(&rest), triangles(&bent));
    for (frame, part) in [("0", 0.0), ("0.5", 0.5), ("1", 1.0)] {
        let between = |(a, b): (&Triangle, &Triangle)| {
            std::array::from_fn(|i| std::array::from_fn(|k| a[i][k] + (b[i][k] - a[i][k]) * part))
        };
        let at: Vec<Triangle> = from.iter().zip(&to).map(between).collect();
        let answer = ok(["closest", arg(&output), "3,1,2", "-0.5,0.25,0", "--frame", frame]);
        for row in parse_csv(&answer, "x,y,z,lower,upper,px,py,pz,triangle,work") {
            let truth = distance([0, 1, 2].map(|k| number(&row[k])), &at);
            let (lower, upper) = (number(&row[3]), number(&row[4]));
            assert!(lower <= truth + 1e-12 && truth - 1e-12 <= upper, "{frame}: {row:?}: {truth}");
        }
        let rows = ok(["nearest", arg(&output), "3,1,2", "-n", "4", "--frame", frame]);
        let mut away: Vec<f64> = at.iter().map(|&t| distance([3.0, 1.0, 2.0], &[t])).collect();
        away.sort_by(f64::total_cmp);
        let rows = parse_csv(&rows, "query,rank,lower,upper,px,py,pz,triangle,work");
        assert_eq!(rows.len(), 4);
        for (row, truth) in rows.iter().zip(&away) {
            let own = distance([3.0, 1.0, 2.0], &[at[number(&row[7]) as usize]]);
            let (lower, upper) = (number(&row[2]), number(&row[3]));
            assert!(lower <= own + 1e-12 && own - 1e-12 <= upper, "{frame}: {row:?}: {own}");
            assert!((own - truth).abs() < 1e-5, "{frame}: {row:?}: {truth}");
        }
        let drawn = directory.join("swept.ply");
        let sweep = ["refine", arg(&output), "-o", arg(&drawn), "--sweep", "3,1,2"];
        let said = ok([&sweep[..], &["--frame", frame]].concat());
        assert!(said.contains("error left 0") && said.contains("  distance "), "{said}");
    }
    let proofs = ok([&["verify", arg(&output)], &meshes[..]].concat());
    assert!(proofs.contains("key frames") && !proofs.contains("not proved"), "{proofs}");
}

#[test]
fn a_blob_without_frames_names_what_it_lacks() {
    let directory = scratch("deform_not_served");
    let hull = blob(&directory, "torus.ply", &["--for", "hull"]);
    let message = refused(&run(["closest", arg(&hull), "1,2,3", "--frame", "0"]), 1, "torus.msw");
    assert!(message.contains("--for deform"), "{message}");
}

#[test]
fn frames_of_another_topology_are_refused_with_the_difference() {
    let directory = scratch("deform_refused");
    let [rest, bent] = frames(&directory);
    let text = fs::read_to_string(&bent).expect("there");
    let other = directory.join("other.obj");
    let put = |text: &str| fs::write(&other, text).expect("it can be written");
    let refuse = |with: &[&str]| {
        let message = refused(&build(&directory, &[&rest, &other]), 1, "other.obj");
        assert!(with.iter().all(|with| message.contains(with)), "{message}");
    };
    put(&text.replacen("v ", "v 1 2 3\nv ", 1));
    refuse(&["vertices, and the first mesh has"]);
    let faces: Vec<&str> = text.lines().filter(|line| line.starts_with("f ")).collect();
    put(&text.replacen(&format!("{}\n", faces[5]), "", 1));
    refuse(&["triangles, and the first mesh has"]);
    let corners: Vec<&str> = faces[5].split(' ').collect();
    let turned = format!("f {} {} {} {}", corners[2], corners[3], corners[4], corners[1]);
    put(&text.replacen(faces[5], &turned, 1));
    refuse(&["triangle ", " has the vertices "]);
    // A frame 64 times as large.
    let far = text.replacen("v ", "v 1000 1000 1000 #", 1);
    put(&far);
    let message = refused(&build(&directory, &[&rest, &other]), 1, "");
    assert!(
        message.contains("key frame 1") && message.contains("vertex 0 is 64 times"),
        "{message}"
    );
}

/// Each flaw is mended at rest, and may come back when the vertices move.
#[test]
fn repairs_that_hold_at_rest_only_are_refused() {
    let directory = scratch("deform_repairs");
    let rest = coarse_torus(&directory);
    let text = fs::read_to_string(&rest).expect("just written");
    let vertices = text.lines().filter(|line| line.starts_with("v ")).count();
    let flawed = directory.join("flawed.obj");
    // Far from the torus, three vertices in a line.
    fs::write(&flawed, format!("{text}v 9 9 9\nv 10 10 10\nv 11 11 11\nf -3 -2 -1\n")).unwrap();
    let message = refused(&build(&directory, &[&flawed]), 1, "flawed.obj");
    assert!(message.contains("may get an area"), "{message}");
    // A welded vertex that tears.
    let first = text.lines().find(|line| line.starts_with("v ")).expect("a vertex");
    let faces = text.replacen("f 1 ", &format!("f {} ", vertices + 1), 1);
    assert_ne!(faces, text, "a face that begins at the first vertex");
    let split = |place: &str| {
        let at = faces.find("f ").expect("faces");
        format!("{}{place}\n{}", &faces[..at], &faces[at..])
    };
    fs::write(&flawed, split(first)).unwrap();
    let torn = directory.join("torn.obj");
    fs::write(&torn, split("v 9 9 9")).unwrap();
    let message = refused(&build(&directory, &[&flawed, &torn]), 1, "torn.obj");
    assert!(message.contains("are apart"), "{message}");
    let built = build(&directory, &[&flawed, &flawed]);
    assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
}

#[test]
fn options_that_do_not_go_together_are_refused() {
    let directory = scratch("deform_usage");
    let [rest, bent] = frames(&directory);
    let output = directory.join("x.msw");
    let meshes = [arg(&rest), arg(&bent)];
    let usage = |options: &[&str]| {
        let output = run([&["build"], meshes.as_slice(), &["-o", arg(&output)], options].concat());
        assert_eq!(output.status.code(), Some(2), "{output:?}");
        String::from_utf8_lossy(&output.stderr).into_owned()
    };
    assert!(usage(&[]).contains("add --for deform"));
    assert!(usage(&["--for", "deform", "--vertex-bits", "16"]).contains("leave out --vertex-bits"));
}

#[test]
fn key_frames_stay_where_triboxes_or_tight_hulls_are_cut() {
    let directory = scratch("deform_cut");
    let [rest, bent] = frames(&directory);
    let output = directory.join("bend.msw");
    let serves = ["--for", "deform,triboxes,tight", "--triboxes", "8", "--tight", "200"];
    let build = ["build", arg(&rest), arg(&bent), "-o", arg(&output), "--effort", "0"];
    ok([&build[..], &serves].concat());
    let ask = |blob: &Path| ok(["closest", arg(blob), "3,1,2", "-1,0,0", "--frame", "0.25"]);
    let cut = directory.join("cut.msw");
    for (option, number) in [("--triboxes", "4"), ("--tight", "200")] {
        let said = ok(["cut", arg(&output), option, number, "-o", arg(&cut)]);
        assert!(!said.contains("left out"), "{said}");
        // All of the tight hulls are wanted.
        let is_same = fs::read(&cut).unwrap() == fs::read(&output).unwrap();
        assert_eq!(is_same, option == "--tight", "{option}");
        assert_eq!(info(&cut)["deformation"], info(&output)["deformation"], "{option}");
        assert_eq!(ask(&cut), ask(&output), "{option}");
    }
    let said = ok(["cut", arg(&output), "--level", "1", "-o", arg(&cut)]);
    assert!(
        said.contains("key frames and moving vertices cannot be cut and are left out"),
        "{said}"
    );
}

#[test]
fn contacts_at_a_frame_are_those_of_the_triangles_there() {
    let directory = scratch("deform_overlap");
    let [rest, bent] = frames(&directory);
    assert!(build(&directory, &[&rest, &bent]).status.success());
    let first = directory.join("bend.msw");
    let second = directory.join("rest.msw");
    ok(["build", arg(&rest), "-o", arg(&second), "--for", "hull"]);
    let (from, to) = (triangles(&rest), triangles(&bent));
    let poses = poses();
    let texts: Vec<&str> = poses.iter().map(|(text, _)| text.as_str()).collect();
    let mut counts = [0; 2];
    for (frame, part) in [("0.25", 0.25), ("1", 1.0)] {
        let between = |(a, b): (&Triangle, &Triangle)| {
            std::array::from_fn(|i| std::array::from_fn(|k| a[i][k] + (b[i][k] - a[i][k]) * part))
        };
        let at: Vec<Triangle> = from.iter().zip(&to).map(between).collect();
        let asked = ["overlap", arg(&first), arg(&second), "--frame", frame, "--pose"];
        let answers = ok([&asked[..], &texts[..]].concat());
        let rows = parse_csv(&answers, "pose,contact,first,second,work");
        assert_eq!(rows.len(), poses.len());
        for (row, (text, pose)) in rows.iter().zip(&poses) {
            let pairs = meeting(&at, &from, pose);
            match row[1].as_str() {
                "apart" => assert!(pairs.is_empty(), "{text} {row:?}"),
                "meets" => {
                    let pair = (row[2].parse().unwrap(), row[3].parse().unwrap());
                    assert!(pairs.contains(&pair), "{text} {row:?}");
                }
                contact => panic!("{text}: {contact}"),
            }
            counts[usize::from(row[1] == "meets")] += 1;
        }
    }
    assert!(counts.iter().all(|&count| count > 3), "{counts:?}");
    let wrong = run(["overlap", arg(&second), arg(&first), "--frame", "0", "--pose", texts[0]]);
    refused(&wrong, 1, "rest.msw");
}
