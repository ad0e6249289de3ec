//! `meshsweep overlap` against brute force over the triangles of the mesh files.

use crate::support::{
    Triangle, arg, blob, first_crossing, fixture, info, ok, parse_csv, refused, run, scratch,
    triangles, write_csv,
};
use std::collections::BTreeSet;
use std::fs;

const HEADER: &str = "pose,contact,first,second,work";

/// p ↦ R p + t, as the program takes a pose of exact numbers.
pub type Rows = [[f64; 4]; 3];

fn moved(triangle: Triangle, rows: &Rows) -> Triangle {
    triangle.map(|p| rows.map(|[a, b, c, t]| a * p[0] + b * p[1] + c * p[2] + t))
}

/// Pairs of triangles in general position that meet: an edge of one crosses the other.
pub fn meeting(first: &[Triangle], second: &[Triangle], rows: &Rows) -> BTreeSet<(usize, usize)> {
    let bounds = |t: &Triangle| {
        let of = |pick: fn(f64, f64) -> f64| -> [f64; 3] {
            std::array::from_fn(|k| t.iter().map(|p| p[k]).reduce(pick).unwrap())
        };
        (of(f64::min), of(f64::max))
    };
    let crosses = |a: &Triangle, b: &Triangle| {
        (0..3).any(|k| first_crossing(a[k], a[(k + 1) % 3], std::slice::from_ref(b)).is_some())
    };
    let second: Vec<(Triangle, _)> =
        second.iter().map(|&t| moved(t, rows)).map(|t| (t, bounds(&t))).collect();
    let mut pairs = BTreeSet::new();
    for (i, a) in first.iter().enumerate() {
        let (low, high) = bounds(a);
        for (j, (b, (from, to))) in second.iter().enumerate() {
            // Written out: tests are not optimised, and most pairs end here.
            let apart = |k: usize| low[k] > to[k] || from[k] > high[k];
            if !(apart(0) || apart(1) || apart(2)) && (crosses(a, b) || crosses(b, a)) {
                pairs.insert((i, j));
            }
        }
    }
    pairs
}

/// Poses of which every number is exact, as text and as rows: rotations by quaternions of small
/// integers.
pub fn poses() -> Vec<(String, Rows)> {
    let translations = [
        [2.25, 0.125, 0.5],
        [-1.5, 2.0, -0.25],
        [4.5, 0.0, 0.0],
        [0.375, -0.75, 6.5],
        [0.25, 3.5, 0.5],
    ];
    // 90 degrees about x; 120 about the diagonal; half a turn about (0, 3, 4)/5.
    let turns: [([f64; 4], [[f64; 3]; 3]); 3] = [
        ([1.0, 1.0, 0.0, 0.0], [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]),
        ([-2.0, -2.0, -2.0, -2.0], [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]),
        ([1.0, 0.0, 0.0, 0.0], [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
    ];
    let mut poses = Vec::new();
    for t in translations {
        for (q, rows) in turns {
            let text: Vec<String> = t.iter().chain(&q).map(f64::to_string).collect();
            let rows = std::array::from_fn(|k| [rows[k][0], rows[k][1], rows[k][2], t[k]]);
            poses.push((text.join(","), rows));
        }
    }
    poses
}

#[test]
fn contacts_and_pairs_are_those_of_the_mesh_files() {
    let directory = scratch("overlap");
    let names = ["torus.ply", "evil/open_box.stl"];
    let meshes = names.map(|name| triangles(&fixture(name)));
    let blobs =
        names.map(|name| blob(&directory, name, &["--for", "segment", "--vertex-bits", "32"]));
    let poses = poses();
    let mut counts = [0usize; 2];
    for (other, path) in meshes.iter().zip(&blobs) {
        let texts: Vec<&str> = poses.iter().map(|(text, _)| text.as_str()).collect();
        let files = [arg(&blobs[0]), arg(path)];
        let first = ok([&["overlap"], &files[..], &["--pose"], &texts[..]].concat());
        let matrices: Vec<String> = poses
            .iter()
            .map(|(_, rows)| {
                rows.iter().flatten().map(f64::to_string).collect::<Vec<_>>().join(",")
            })
            .collect();
        let matrices: Vec<&str> = matrices.iter().map(String::as_str).collect();
        assert_eq!(first, ok([&["overlap"], &files[..], &["--matrix"], &matrices[..]].concat()));
        let all = ok([&["overlap"], &files[..], &["--all", "--pose"], &texts[..]].concat());
        let (first, all) = (parse_csv(&first, HEADER), parse_csv(&all, HEADER));
        assert_eq!(first.len(), poses.len());
        for (number, ((_, rows), row)) in poses.iter().zip(&first).enumerate() {
            let truth = meeting(&meshes[0], other, rows);
            let of_pose: Vec<_> = all.iter().filter(|row| row[0] == number.to_string()).collect();
            if truth.is_empty() {
                counts[0] += 1;
                assert_eq!(row[1], "apart", "{row:?}");
                assert!(of_pose.len() == 1 && of_pose[0][1] == "apart" && of_pose[0][2].is_empty());
                continue;
            }
            counts[1] += 1;
            assert_ne!(row[1], "apart", "{row:?}");
            let pairs = |certain: bool| -> BTreeSet<(usize, usize)> {
                let rows = of_pose.iter().filter(|row| !certain || row[1] == "meets");
                rows.map(|row| (row[2].parse().unwrap(), row[3].parse().unwrap())).collect()
            };
            assert!(pairs(true).is_subset(&truth), "{number}");
            assert!(truth.is_subset(&pairs(false)), "{number}");
        }
    }
    assert!(counts.iter().all(|&count| count >= 4), "{counts:?}");
}

#[test]
fn hull_hierarchies_give_the_contacts_of_the_box_trees() {
    let directory = scratch("overlap_hulls");
    let both = blob(&directory, "bracket.stl", &["--for", "segment,hull", "--vertex-bits", "32"]);
    let poses: Vec<String> = (0..24)
        .map(|i| format!("{},{},10,3,{},1,{}", 30 * (i % 6), 25 * (i / 6), i % 5, i % 3))
        .collect();
    let poses: Vec<&str> = poses.iter().map(String::as_str).collect();
    let ask = |options: &[&str]| {
        let files = ["overlap", arg(&both), arg(&both)];
        parse_csv(&ok([&files[..], options, &["--pose"], &poses[..]].concat()), HEADER)
    };
    let (trees, hulls) = (ask(&[]), ask(&["--engine", "hull"]));
    let contacts = |rows: &[Vec<String>]| rows.iter().map(|row| row[1].clone()).collect::<Vec<_>>();
    assert_eq!(contacts(&trees), contacts(&hulls));
    assert!(["apart", "meets"].iter().all(|&word| contacts(&hulls).iter().any(|is| is == word)));
    let pairs = |options: &[&str]| -> BTreeSet<Vec<String>> {
        ask(options).into_iter().map(|row| row[..4].to_vec()).collect()
    };
    assert_eq!(pairs(&["--all"]), pairs(&["--all", "--engine", "hull"]));
    // Without a box tree the hull hierarchies answer.
    let bare = blob(&scratch("overlap_bare"), "bracket.stl", &["--for", "hull"]);
    let rows = parse_csv(&ok(["overlap", arg(&bare), arg(&both), "--pose", poses[0]]), HEADER);
    assert_eq!(rows.len(), 1);
    let torus = blob(&directory, "torus.ply", &[]);
    let output = run(["overlap", arg(&bare), arg(&torus), "--engine", "hull"]);
    assert!(refused(&output, 1, "torus.msw").contains("--for hull"));
}

#[test]
fn all_pairs_of_a_cut_blob_leave_open_what_its_overlap_leaves_open() {
    let directory = scratch("overlap_cut");
    let hull = blob(&directory, "bracket.stl", &["--for", "hull"]);
    let cut = directory.join("cut.msw");
    ok(["cut", arg(&hull), "--level", "1", "-o", arg(&cut)]);
    let poses: Vec<String> = (0..12).map(|i| format!("{},3,10,1,0,0,0", 8 * i)).collect();
    let poses: Vec<&str> = poses.iter().map(String::as_str).collect();
    let ask = |options: &[&str]| -> Vec<Vec<String>> {
        let files = ["overlap", arg(&cut), arg(&hull)];
        let rows = parse_csv(&ok([&files[..], options, &["--pose"], &poses[..]].concat()), HEADER);
        rows.into_iter().map(|row| row[..4].to_vec()).collect()
    };
    let one = ask(&[]);
    assert_eq!(one, ask(&["--all"]));
    assert!(["apart", "undecided"].iter().all(|word| one.iter().any(|row| row[1] == *word)));
}

#[test]
fn without_a_pose_meshes_are_where_they_were_built_and_coincide_openly() {
    let directory = scratch("overlap_still");
    let torus = blob(&directory, "torus.ply", &[]);
    assert!(
        info(&torus)["serves"].as_array().unwrap().iter().any(|question| question == "overlap")
    );
    let rows = parse_csv(&ok(["overlap", arg(&torus), arg(&torus)]), HEADER);
    assert_eq!((rows.len(), rows[0][1].as_str()), (1, "undecided"));
    let out = directory.join("contacts.csv");
    let poses = directory.join("poses.csv");
    write_csv(
        &poses,
        &[[9f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0], [2.5, 0.1, 0.2, 1.0, 0.5, 0.25, 0.0]],
    );
    let output = run(["overlap", arg(&torus), arg(&torus), "--pose", arg(&poses), "-o", arg(&out)]);
    assert!(output.status.success() && output.stdout.is_empty());
    let rows = parse_csv(&fs::read_to_string(&out).unwrap(), HEADER);
    assert_eq!(rows.iter().map(|row| row[1].as_str()).collect::<Vec<_>>(), ["apart", "meets"]);
    let few =
        ok(["overlap", arg(&torus), arg(&torus), "--pose", arg(&poses), "--steps", "1", "--all"]);
    let last = parse_csv(&few, HEADER).pop().unwrap();
    assert_eq!((last[1].as_str(), last[2].as_str()), ("undecided", ""), "pairs may be missing");
}

#[test]
fn what_cannot_be_asked_is_refused_by_name() {
    let directory = scratch("overlap_refused");
    let torus = blob(&directory, "torus.ply", &[]);
    let closest = blob(&directory, "bracket.stl", &["--for", "closest"]);
    let wrong = |args: &[&str]| run([&["overlap", arg(&torus)], args].concat());
    assert!(refused(&wrong(&[arg(&closest)]), 1, "bracket.msw").contains("--for closest,segment"));
    assert!(
        refused(&wrong(&[arg(&torus), "--pose", "0,0,0,0,0,0,0"]), 2, "").contains("quaternion")
    );
    let poses = scratch("overlap_no_rotation").join("poses.csv");
    write_csv(
        &poses,
        &[[9f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0], [0.0; 7], [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]],
    );
    let output = wrong(&[arg(&torus), "--pose", arg(&poses)]);
    assert!(refused(&output, 1, "poses.csv, line 3").contains("quaternion"));
    let rows = parse_csv(&String::from_utf8(output.stdout).unwrap(), HEADER);
    assert_eq!(
        (rows.len(), rows[0][1].as_str()),
        (1, "apart"),
        "what stands before it is answered"
    );
    let stretched = wrong(&[arg(&torus), "--matrix", "3,0,0,0,0,1,0,0,0,0,1,0"]);
    let line = refused(&stretched, 1, "query 3,0,0");
    assert!(line.contains("entry 1 of row 1 is 3, beyond 2"), "{line}");
    assert_eq!(wrong(&[arg(&torus), "--pose", "1,2,3"]).status.code(), Some(2));
    let pose_first = run(["overlap", "--pose", "0,0,0,1,0,0,0", arg(&torus), arg(&torus)]);
    let stderr = String::from_utf8_lossy(&pose_first.stderr).into_owned();
    assert!(pose_first.status.code() == Some(2) && stderr.contains("name blobs first"), "{stderr}");
    assert_eq!(wrong(&[arg(&torus), "-o", arg(&torus)]).status.code(), Some(1));
}

#[test]
fn a_blob_after_poses_is_told_to_stand_before_them_whatever_its_name() {
    let directory = scratch("overlap_order");
    let first = blob(&directory, "torus.ply", &["--for", "segment"]);
    let pose = "1,0,0,1,0,0,0";
    for name in ["second.msw", "second.bin"] {
        let second = directory.join(name);
        fs::copy(&first, &second).unwrap();
        let output = run(["overlap", arg(&first), "--pose", pose, arg(&second)]);
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.code() == Some(2) && stderr.contains("name blobs first"), "{stderr}");
        ok(["overlap", arg(&first), arg(&second), "--pose", pose]);
    }
}
