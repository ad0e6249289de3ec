//! `within`, `closest` and `signed` of a blob with a box tree and a distance field.

use crate::support::{
    arg, distance, fixture, number, ok, parse_csv, random_queries, scratch, triangles, wide,
    write_csv,
};
use std::path::{Path, PathBuf};

/// The same part with a box tree, and with a field too.
fn blobs(directory: &Path) -> [PathBuf; 2] {
    [
        ("tree.msw", &["--for", "closest"][..]),
        ("both.msw", &["--for", "closest,sdf", "--sdf", "2K"]),
    ]
    .map(|(name, options)| {
        let blob = directory.join(name);
        ok([&["build", arg(&fixture("groove.obj")), "-o", arg(&blob)], options].concat());
        blob
    })
}

#[test]
fn the_field_answers_first_with_the_columns_and_the_verdicts_of_the_tree() {
    let directory = scratch("field_first");
    let ([tree, both], points) = (blobs(&directory), directory.join("points.csv"));
    write_csv(&points, &random_queries::<3>(&triangles(&fixture("groove.obj")), 200));
    let ask = |blob: &Path, distance: &str| {
        let text = ok(["within", arg(blob), arg(&points), "--distance", distance]);
        parse_csv(&text, "x,y,z,within,triangle,work")
    };
    let mut alone = 0;
    for distance in ["2", "10"] {
        for (by_tree, by_both) in ask(&tree, distance).iter().zip(&ask(&both, distance)) {
            assert_eq!(by_tree[..4], by_both[..4]);
            // A yes of the field names no triangle.
            let is_by_field = by_both[5] == "0" && by_both[4].is_empty();
            assert!(is_by_field || by_tree[4..] == by_both[4..], "{by_tree:?} {by_both:?}");
            alone += u32::from(is_by_field);
        }
    }
    assert!(alone > 200, "{alone}");
}

#[test]
fn a_tolerance_is_met_sooner_and_the_interval_contains_the_distance() {
    let directory = scratch("field_tolerance");
    let ([tree, both], points) = (blobs(&directory), directory.join("points.csv"));
    let mesh = triangles(&fixture("groove.obj"));
    let rows = random_queries::<3>(&mesh, 200);
    write_csv(&points, &rows);
    let ask = |blob: &Path, options: &[&str]| {
        let text = ok([&["closest", arg(blob), arg(&points)], options].concat());
        parse_csv(&text, "x,y,z,lower,upper,px,py,pz,triangle,work")
    };
    assert_eq!(ask(&tree, &[]), ask(&both, &[]));
    let work = |answers: &[Vec<String>]| answers.iter().map(|row| number(&row[9])).sum::<f64>();
    for options in [["--rel", "0.3"], ["--abs", "3"]] {
        let (by_tree, by_both) = (ask(&tree, &options), ask(&both, &options));
        for (answer, point) in by_both.iter().zip(&rows) {
            let truth = distance(wide(point), &mesh);
            let [lower, upper] = [number(&answer[3]), number(&answer[4])];
            assert!(lower <= truth * (1.0 + 1e-12) && truth * (1.0 - 1e-12) <= upper, "{answer:?}");
        }
        assert!(work(&by_both) < work(&by_tree), "{options:?}");
    }
}

#[test]
fn the_field_tells_the_sides_that_the_tree_tells() {
    let directory = scratch("field_sides");
    let ([tree, both], points) = (blobs(&directory), directory.join("points.csv"));
    write_csv(&points, &random_queries::<3>(&triangles(&fixture("groove.obj")), 200));
    let ask = |blob: &Path| {
        let text = ok(["signed", arg(blob), arg(&points)]);
        parse_csv(&text, "x,y,z,side,reason,lower,upper,px,py,pz,triangle,work")
    };
    for (by_tree, by_both) in ask(&tree).iter().zip(&ask(&both)) {
        if by_tree[3] != "undecided" {
            assert_eq!(by_tree[3], by_both[3]);
            assert_eq!(by_tree[7..11], by_both[7..11]);
        }
    }
}
