//! `meshsweep info --json`: names and units of its numbers.

use crate::support::{arg, fixture, info, ok, scratch};
use serde_json::Value;
use std::collections::BTreeSet;

/// All names in a value that contain a word.
fn names(value: &Value, word: &str, found: &mut BTreeSet<String>) {
    if let Some(object) = value.as_object() {
        found.extend(object.keys().filter(|name| name.contains(word)).cloned());
        object.values().for_each(|value| names(value, word, found));
    }
    value.as_array().into_iter().flatten().for_each(|value| names(value, word, found));
}

#[test]
fn scratch_has_the_same_two_names_of_every_structure() {
    for name in ["groove.msw", "bracket.msw", "hulls.msw", "fence.msw"] {
        let (told, mut found) = (info(&fixture(name)), BTreeSet::new());
        names(&told, "scratch", &mut found);
        let all: Vec<&str> = found.iter().map(String::as_str).collect();
        assert_eq!(all, ["scratch_bytes", "scratch_entries"], "{name}");
        names(&told, "stack", &mut found);
        assert_eq!(found.len(), 2, "{name}: {found:?}");
    }
}

#[test]
fn sections_of_curves_tell_their_bytes_a_segment() {
    let output = scratch("info_curves").join("fence.msw");
    ok(["build", arg(&fixture("fence.csv")), "-o", arg(&output), "--closed"]);
    let told = info(&output);
    let section = &told["sections"][0];
    let each = section["bytes"].as_f64().unwrap() / told["curve"]["segments"].as_f64().unwrap();
    assert_eq!(section["bytes_per_segment"].as_f64(), Some(each));
    assert_eq!(section.get("bytes_per_triangle"), None);
}

#[test]
fn info_and_emitted_source_tell_the_same_entries_of_a_kept_sweep() {
    let directory = scratch("info_sweep");
    let output = directory.join("part.msw");
    let mesh = fixture("bracket.stl");
    ok(["build", arg(&mesh), "-o", arg(&output), "--for", "sweep", "--emit", "rust"]);
    let kept = &info(&output)["hull"]["capacities"]["kept_sweep"];
    assert_eq!(kept["scratch_entries"], 1948);
    assert_eq!(kept["scratch_bytes"], 8 * 1948);
    let source = std::fs::read_to_string(directory.join("part.rs")).unwrap();
    assert!(source.contains("pub const SWEEP_ENTRIES: usize = 1948;"), "{source}");
    let said = ok(["info", arg(&output)]);
    assert!(said.contains("  kept sweep: 1948 entries, 15584 bytes of RAM"), "{said}");
}
