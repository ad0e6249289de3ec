//! `meshsweep refine`: the hull is closed, holds the mesh, and is fine where it is wanted.

use crate::support::{
    Point, arg, fixture, hull_blob, number, ok, parse_csv, refused, run, scratch, triangles, volume,
};
use meshsweep::mesh;
use meshsweep_core::{Budget, Bvh, Scratch};
use std::path::Path;

/// Triangles of a closed mesh file.
fn closed(path: &Path) -> Vec<[Point; 3]> {
    let (mesh, _) = mesh::load_closed(path).expect("a hull is closed");
    let at = |v: u32| mesh.positions[v as usize].map(f64::from);
    mesh.triangles.iter().map(|t| t.map(at)).collect()
}

/// The number before a word of the output.
fn number_before(text: &str, word: &str) -> usize {
    text.split(word).next().unwrap().trim().rsplit(' ').next().unwrap().parse().unwrap()
}

/// Faces that are written, after a check of what is said of them.
fn refined(blob: &Path, out: &Path, options: &[&str]) -> Vec<[Point; 3]> {
    let text = ok([&["refine", arg(blob), "-o", arg(out)], options].concat());
    let faces = closed(out);
    assert_eq!(number_before(&text, " faces of "), faces.len(), "{text}");
    assert!(text.trim_end().ends_with("error left 0"), "{text}");
    faces
}

#[test]
fn the_hull_is_the_mesh_where_no_error_is_allowed_and_the_base_where_all_is() {
    let directory = scratch("refine_ends");
    let out = directory.join("hull.ply");
    for name in ["torus.ply", "groove.obj"] {
        let (blob, solid) =
            (hull_blob(&directory, name, &["--base", "60"]), triangles(&fixture(name)));
        let all = refined(&blob, &out, &["--error", "0"]);
        assert_eq!(all.len(), solid.len());
        assert!((volume(&all) / volume(&solid) - 1.0).abs() < 1e-6);
        let base = refined(&blob, &out, &["--error", "1000"]);
        assert!(base.len() < 100, "{name}: {}", base.len());
        assert!(volume(&base) > volume(&solid) * (1.0 - 1e-6), "{name}");
    }
}

#[test]
fn every_focus_refines_a_part_that_holds_the_mesh_s_own_vertices() {
    let directory = scratch("refine_focus");
    let (blob, out) =
        (hull_blob(&directory, "torus.ply", &["--base", "60"]), directory.join("h.ply"));
    let solid = triangles(&fixture("torus.ply"));
    let mesh = mesh::Mesh::new(
        solid.iter().flatten().map(|p| p.map(|x| x as f32)).collect(),
        (0..solid.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect(),
    );
    let bytes = meshsweep::bvh::exact_blob(&mesh).unwrap();
    let tree = Bvh::open(&bytes).unwrap();
    let near_mesh = |faces: &[[Point; 3]], centre: Point, radius: f64| {
        let mut farthest = 0f32;
        for p in faces.iter().flatten() {
            let away: f64 = (0..3).map(|k| (p[k] - centre[k]).powi(2)).sum();
            if away.sqrt() < radius {
                let p = p.map(|x| x as f32);
                let found = tree.closest_point(p, Budget::EXACT, &mut Scratch::<64>::new());
                farthest = farthest.max(found.unwrap().distance.upper);
            }
        }
        farthest
    };
    for (focus, centre) in [
        (&["--near", "2.75,0,0", "--within", "0.5", "--error", "0"][..], [2.75, 0.0, 0.0]),
        (&["--box", "2.2,-0.6,-0.6,3.2,0.6,0.6", "--error", "0"], [2.75, 0.0, 0.0]),
        (&["--segment", "2,-3,0,2,3,0", "--within", "0.5", "--error", "0"], [2.0, 1.5, 0.0]),
        (
            &["--eye", "2.75,0,3", "--look", "0,0,-1", "--fov", "20", "--pixels", "100000"],
            [2.75, 0.0, 0.0],
        ),
    ] {
        let faces = refined(&blob, &out, focus);
        assert!((150..solid.len()).contains(&faces.len()), "{focus:?}: {}", faces.len());
        assert!(volume(&faces) > volume(&solid), "{focus:?}");
        assert!(near_mesh(&faces, centre, 0.4) < 1e-3, "{focus:?}");
    }
}

#[test]
fn the_mesh_of_a_sweep_holds_the_closest_triangle_and_is_coarser_than_the_part() {
    let directory = scratch("refine_sweep");
    let (blob, out) =
        (hull_blob(&directory, "torus.ply", &["--base", "60"]), directory.join("h.ply"));
    let solid = triangles(&fixture("torus.ply"));
    for point in ["4,0.1,0.2", "0,2.5,1.5", "-2.2,-2.1,0.4"] {
        let text = ok(["refine", arg(&blob), "-o", arg(&out), "--sweep", point]);
        let faces = closed(&out);
        assert!(text.contains("error left 0\n"), "{text}");
        assert!((60..solid.len() * 4 / 5).contains(&faces.len()), "{point}: {}", faces.len());
        assert!(volume(&faces) > volume(&solid), "{point}");
        let answer = ok(["closest", arg(&blob), point]);
        let row = &parse_csv(&answer, "x,y,z,lower,upper,px,py,pz,triangle,work")[0];
        let nearest = solid[number(&row[8]) as usize];
        let is_it =
            |face: &[Point; 3]| (0..3).any(|k| nearest == [0, 1, 2].map(|i| face[(i + k) % 3]));
        assert!(faces.iter().any(is_it), "{point}");
        assert!(text.contains("  distance "), "{text}");
    }
}

#[test]
fn a_focus_that_is_half_given_or_given_twice_is_wrong_usage() {
    let directory = scratch("refine_usage");
    let (blob, out) = (hull_blob(&directory, "torus.ply", &[]), directory.join("h.ply"));
    for options in [
        &[][..],
        &["--near", "1,2,3"],
        &["--near", "1,2", "--error", "1"],
        &["--near", "1,2,3", "--box", "1,2,3,4,5,6", "--error", "1"],
        &["--box", "1,2,3,4,5,6", "--within", "1", "--error", "1"],
        &["--eye", "1,2,3", "--look", "0,0,1", "--fov", "20"],
        &["--look", "0,0,1", "--error", "1"],
        &["--error", "-1"],
        &["--sweep", "1,2,3", "--error", "1"],
        &["--near", "1,2,3", "--error", "1", "--frame", "0"],
    ] {
        let all = [&["refine", arg(&blob), "-o", arg(&out)], options].concat();
        assert_eq!(run(all).status.code(), Some(2), "{options:?}");
    }
    assert!(!out.exists());
    let tree = crate::support::blob(&directory, "torus.ply", &[]);
    let line =
        refused(&run(["refine", arg(&tree), "-o", arg(&out), "--error", "1"]), 1, "torus.msw");
    assert!(line.contains("--for hull"), "{line}");
}
