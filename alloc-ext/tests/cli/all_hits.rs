//! `meshsweep segment --all`, and `--rays`, beside `meshsweep segment`.

use crate::support::{
    arg, blob, fixture, number, ok, parse_csv, refused, run, scratch, triangles, write_csv,
};

const SEGMENT: &str = "hit,t,px,py,pz,triangle,work";

/// Segments along a slant, through the corners and the middles of the mesh's triangles.
fn slanted(mesh: &[[[f64; 3]; 3]]) -> Vec<[f32; 6]> {
    let middles = mesh.iter().map(|t| std::array::from_fn(|k| (t[0][k] + t[1][k] + t[2][k]) / 3.0));
    let targets = mesh.iter().flatten().copied().chain(middles);
    let slant = [1.0, 0.5, -0.2];
    let ends = |p: [f64; 3]| {
        std::array::from_fn(|i| {
            let by = if i < 3 { -100.0 } else { 100.0 };
            (p[i % 3] + by * slant[i % 3]) as f32
        })
    };
    targets.map(ends).collect()
}

#[test]
fn each_hit_of_a_height_field_is_certain_by_itself() {
    let directory = scratch("all_hits_certain");
    let mesh = triangles(&fixture("reported/height_field.obj"));
    let rows = slanted(&mesh);
    let segments = directory.join("s.csv");
    write_csv(&segments, &rows);
    for bits in ["16", "32"] {
        let options = ["--for", "segment", "--vertex-bits", bits];
        let path = blob(&directory, "reported/height_field.obj", &options);
        let ask = ["segment", arg(&path), arg(&segments)];
        let first = parse_csv(&ok(ask), SEGMENT);
        let all = parse_csv(&ok([&ask[..], &["--all"]].concat()), &format!("query,{SEGMENT}"));
        let (mut mixed, mut agreed, mut may_lack) = (0, 0, 0);
        for (query, first) in first.iter().enumerate() {
            let listed = all.iter().filter(|row| row[0] == query.to_string());
            let listed: Vec<&[String]> = listed.map(|row| &row[1..]).collect();
            let is_yes = |row: &&[String]| row[0] == "yes";
            assert_eq!(first[0] == "yes", listed.iter().any(is_yes), "{first:?} {listed:?}");
            assert_eq!(first[0] == "no", listed[0][0] == "no", "{first:?} {listed:?}");
            if is_yes(&listed[0]) {
                assert_eq!(listed[0][..6], first[..6], "{bits}");
                agreed += 1;
            }
            let is_mixed = listed.iter().any(is_yes) && !listed.iter().all(is_yes);
            mixed += usize::from(is_mixed);
            // A row without a triangle comes after those of the hits, and says "undecided".
            let named = listed.iter().take_while(|row| !row[5].is_empty()).count();
            assert!(named + 1 >= listed.len(), "{listed:?}");
            if let Some(row) = listed.get(named).filter(|row| row[0] != "no") {
                assert!(row[0] == "undecided" && number(&row[1]) == 0.0, "{row:?}");
                may_lack += usize::from(named > 0);
            }
        }
        assert!(mixed > 100 && agreed > 200, "{bits}: {mixed} {agreed}");
        assert!(bits == "32" || may_lack > 20, "{may_lack}");
    }
}

#[test]
fn rays_meet_what_segments_along_them_meet() {
    let directory = scratch("rays");
    let path = blob(&directory, "reported/height_field.obj", &["--for", "segment"]);
    let (segments, rays) = (directory.join("s.csv"), directory.join("r.csv"));
    let mesh = triangles(&fixture("reported/height_field.obj"));
    // The same starts, and a 64th of the ways.
    let rows = slanted(&mesh);
    let way = |row: &[f32; 6]| {
        std::array::from_fn(|k| if k < 3 { row[k] } else { (row[k] - row[k - 3]) / 64.0 })
    };
    write_csv(&segments, &rows);
    write_csv(&rays, &rows.iter().map(way).collect::<Vec<[f32; 6]>>());
    let along_segments = parse_csv(&ok(["segment", arg(&path), arg(&segments)]), SEGMENT);
    let along_rays = parse_csv(&ok(["segment", arg(&path), "--rays", arg(&rays)]), SEGMENT);
    assert_eq!(along_segments.len(), along_rays.len());
    let mut both = 0;
    for (segment, ray) in along_segments.iter().zip(&along_rays) {
        // A ray's way is rounded otherwise, so it may pass an edge on the other side.
        if segment[0] == "yes" && ray[0] == "yes" {
            let (t, of_ray) = (number(&segment[1]), number(&ray[1]));
            assert!((of_ray - 64.0 * t).abs() <= 1e-4 * of_ray, "{segment:?} {ray:?}");
            both += 1;
        }
    }
    assert!(both > 200, "{both}");
    let told = refused(&run(["segment", arg(&path), "--rays", "0,0,9,0,0,0"]), 1, "");
    assert!(told.contains("the direction of a ray is zero"), "{told}");
}
