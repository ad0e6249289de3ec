//! Plots of a fixture's measures are SVG that a parser takes, and say all that they should.

use std::path::PathBuf;
use std::sync::LazyLock;

use meshsweep_lab::measure::plot::{Measured, svg};
use meshsweep_lab::measure::{measure, measure_bounds};
use meshsweep_xtask::table::Table;
use roxmltree::Document;

fn torus() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/torus.ply")
}

static BOUNDS: LazyLock<Vec<Table>> =
    LazyLock::new(|| measure_bounds(&torus(), None).expect("measured"));

/// All texts, each within the figure; and no attribute that is no number where one was to be.
fn texts(svg: &str) -> Vec<String> {
    let document = Document::parse(svg).expect("well-formed");
    let root = document.root_element();
    assert_eq!(root.tag_name().name(), "svg");
    let number = |node: roxmltree::Node<'_, '_>, name: &str| -> f64 {
        node.attribute(name).and_then(|value| value.parse().ok()).expect("a number")
    };
    let (width, height) = (number(root, "width"), number(root, "height"));
    for attribute in root.descendants().flat_map(|node| node.attributes()) {
        assert!(
            !attribute.value().contains("NaN") && !attribute.value().contains("inf"),
            "{attribute:?}"
        );
    }
    let nodes: Vec<_> = root.descendants().filter(|node| node.has_tag_name("text")).collect();
    for &node in &nodes {
        let (x, y) = (number(node, "x"), number(node, "y"));
        assert!((0.0..width).contains(&x) && (0.0..height).contains(&y), "{node:?}");
    }
    nodes.iter().filter_map(|node| node.text()).map(|text| text.trim().to_owned()).collect()
}

fn times(texts: &[String], wanted: &str) -> usize {
    texts.iter().filter(|text| *text == wanted).count()
}

#[test]
fn every_bound_is_named_in_both_panels() {
    let tables = BOUNDS.clone();
    let texts = texts(&svg(&[Measured { mesh: "torus".to_owned(), tables }]).expect("plotted"));
    // Bounded anew about the hull's vertices and about its own, in two panels.
    for slabs in ["box", "14-DOP", "tribox", "20-DOP", "24-DOP", "26-DOP", "tribox rounded outward"]
    {
        assert_eq!(times(&texts, slabs), 4, "{slabs}: {texts:?}");
    }
    for rigid in
        ["sphere", "oriented box, principal axes", "oriented box, on a face", "convex hull"]
    {
        assert_eq!(times(&texts, rigid), 2, "{rigid}: {texts:?}");
    }
    for once in [
        "torus: false positives of bounds against their cost",
        "torus: volume of bounds against their cost",
        "pairs reported that do not meet, %",
        "volume over the convex hull's (log)",
    ] {
        assert_eq!(times(&texts, once), 1, "{once}: {texts:?}");
    }
    assert_eq!(times(&texts, "to move it and test it once, ns (log)"), 2);
}

#[test]
fn bounds_miss_no_pair_that_meets_and_f32_verdicts_are_the_f64_ones() {
    // Of 2,000 verdicts a hair may decide one.
    for table in &*BOUNDS {
        for (column, most) in [("missed", 0), ("differ", 1)] {
            let Some(rows) = table.json()["rows"].as_array().cloned() else { panic!("no rows") };
            for row in rows.iter().filter(|row| row.get(column).is_some()) {
                assert!(row[column].as_u64().is_some_and(|count| count <= most), "{row}");
            }
        }
    }
}

#[test]
fn every_trade_of_speed_for_accuracy_has_a_panel() {
    let tables = measure(&torus()).expect("measured");
    let texts = texts(&svg(&[Measured { mesh: "torus".to_owned(), tables }]).expect("plotted"));
    for title in [
        "torus: hull hierarchy, closest point within a tolerance",
        "torus: hull hierarchy, closest point after so many nodes",
        "torus: hull hierarchy, closest point on blobs cut after a level",
        "torus: box tree, closest point within a tolerance",
        "torus: box tree, closest point after so many nodes",
    ] {
        assert_eq!(times(&texts, title), 1, "{title}: {texts:?}");
    }
    assert_eq!(times(&texts, "far"), 5);
    assert_eq!(times(&texts, "near"), 5);
    assert!(times(&texts, "10.0 %") == 2 && times(&texts, "256") == 2, "{texts:?}");
}

#[test]
fn tables_without_a_trade_are_no_plot() {
    assert!(svg(&[]).is_err());
    assert!(svg(&[Measured { mesh: "torus".to_owned(), tables: Vec::new() }]).is_err());
}
