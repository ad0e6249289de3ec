//! Measures of a fixture: bounds are right, and their plot says all that it should.

use std::path::PathBuf;

use meshsweep_lab::measure::bounds::cost::Cost;
use meshsweep_lab::measure::measure_bounds;
use meshsweep_lab::measure::plot::{Measured, svg};
use roxmltree::Document;

/// Bounds, in the order of their rows; those that are taken about two sets of vertices, twice.
const ROWS: usize = 15;

#[test]
fn bounds_miss_no_pair_that_meets_and_each_is_named_in_the_plot() {
    let torus = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/torus.ply");
    let costs: Vec<Cost> =
        (1..=ROWS).map(|k| Cost { update: 100.0 * k as f64, test: 10.0 }).collect();
    let tables = measure_bounds(&torus, Some(&costs)).expect("measured");
    for table in &tables {
        // A hair may decide one of 2,000 verdicts.
        for (name, most) in [("missed", 0.0), ("differ", 1.0)] {
            let Some(at) = table.columns.iter().position(|column| *column == name) else {
                continue;
            };
            assert_eq!(table.rows.len(), ROWS);
            for row in &table.rows {
                assert!(row[at].number().is_some_and(|count| count <= most), "{name}: {row:?}");
            }
        }
    }
    assert!(tables.iter().any(|table| table.columns.contains(&"differ")));
    let plotted = svg(&[Measured { mesh: "torus".to_owned(), tables }]).expect("plotted");
    let document = Document::parse(&plotted).expect("well-formed");
    assert!(!plotted.contains("NaN") && !plotted.contains("inf"));
    let texts: Vec<&str> = document
        .descendants()
        .filter(|node| node.has_tag_name("text"))
        .filter_map(|node| node.text().map(str::trim))
        .collect();
    for bound in ["box", "14-DOP", "tribox", "24-DOP", "26-DOP", "tribox rounded outward"]
        .into_iter()
        .chain(["sphere", "oriented box, on a face", "convex hull"])
    {
        assert_eq!(texts.iter().filter(|text| **text == bound).count(), 2, "{bound}: {texts:?}");
    }
}

#[test]
fn tables_without_a_trade_are_no_plot() {
    assert!(svg(&[]).is_err());
    assert!(svg(&[Measured { mesh: "torus".to_owned(), tables: Vec::new() }]).is_err());
}
