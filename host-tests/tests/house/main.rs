//! Which folder may use which, and no files that use each other in a circle. Both are read from the
//! paths of the source files, from `use` lines and from inline paths.

mod arrows;
mod defmt;
mod papers;
mod source;

use std::fs;

use arrows::House;
use source::{collect, root, without_comments};

/// The folders of `core/src`, each with the folders that it may use.
const CORE: [(&str, &[&str]); 12] = [
    ("num", &[]),
    ("geom", &["num"]),
    ("format", &["num", "geom"]),
    ("query", &["num", "geom", "format"]),
    ("bvh", &["num", "geom", "format", "query"]),
    ("hull", &["num", "geom", "format", "query"]),
    ("tribox", &["num", "geom", "format", "query"]),
    ("curve", &["num", "geom", "format", "query"]),
    ("sdf", &["num", "format", "query"]),
    ("tight", &["num", "geom", "format", "query", "bvh"]),
    ("bvh_with_sdf", &["num", "format", "query", "bvh", "sdf"]),
    (
        "blob",
        &[
            "num",
            "geom",
            "format",
            "query",
            "bvh",
            "bvh_with_sdf",
            "hull",
            "tribox",
            "curve",
            "sdf",
            "tight",
        ],
    ),
];

/// Folders that all structures of the builder may use.
const BENEATH: &[&str] = &[
    "clock",
    "counted",
    "number",
    "emit",
    "error",
    "progress",
    "random",
    "geom",
    "lp",
    "mesh",
    "surface",
    "collapse",
    "bvh",
    "hausdorff",
];

/// The same of `alloc-ext/src`. `emit` is beneath: it knows sections and no builder. `counted` and
/// `number` print numbers, `error` says why there is no blob, `progress` tells how much is done and
/// asks whether to go on, `pose` makes matrices of quaternions, `random` gives the same numbers in
/// every run, `clock` tells the time. `cut`, `trade` and `builder` are above: they know all
/// structures. `load` makes a clean mesh of a file for them. `check` proves the others' work and
/// shares nothing with them but meshes. `trade` measures distances by it.
const BUILDER: [(&str, &[&str]); 28] = [
    ("clock", &[]),
    ("counted", &[]),
    ("number", &[]),
    ("emit", &[]),
    ("pose", &[]),
    ("random", &[]),
    ("lp", &["random"]),
    ("geom", &[]),
    ("mesh", &["counted", "geom"]),
    ("check", &["mesh"]),
    ("error", &["counted", "mesh", "number"]),
    ("distances", &[]),
    ("progress", &["error"]),
    ("surface", &["counted", "error", "geom", "lp", "mesh"]),
    ("load", &["clock", "error", "mesh", "surface"]),
    ("collapse", &["counted", "geom", "lp", "mesh", "progress", "surface"]),
    ("bvh", &["clock", "counted", "emit", "error", "geom", "lp", "mesh", "progress", "surface"]),
    ("hausdorff", &["bvh", "error", "mesh"]),
    ("tight", BENEATH),
    (
        "hull",
        &[
            "clock",
            "counted",
            "number",
            "emit",
            "error",
            "progress",
            "mesh",
            "surface",
            "collapse",
            "bvh",
            "hausdorff",
            "tight",
        ],
    ),
    ("tribox", BENEATH),
    ("curve", BENEATH),
    ("sdf", BENEATH),
    (
        "cut",
        &["counted", "emit", "error", "lp", "mesh", "surface", "bvh", "hull", "tight", "tribox"],
    ),
    (
        "builder",
        &[
            "counted", "number", "emit", "error", "progress", "mesh", "surface", "load",
            "collapse", "bvh", "hull", "tight", "tribox", "curve", "sdf",
        ],
    ),
    (
        "trade",
        &[
            "check",
            "clock",
            "distances",
            "number",
            "emit",
            "error",
            "geom",
            "random",
            "mesh",
            "surface",
            "load",
            "hull",
            "curve",
            "builder",
        ],
    ),
    ("worst", &["distances", "pose", "random", "trade"]),
    ("robot", &["builder", "emit", "error", "load", "mesh", "number", "random"]),
];

fn none(found: &[String]) {
    assert!(found.is_empty(), "\n{}", found.join("\n"));
}

#[test]
fn folders_of_the_core_use_only_folders_beneath() {
    none(&House::read("core/src", None).strays(&CORE));
}

#[test]
fn folders_of_the_builder_use_only_folders_beneath() {
    none(&House::read("alloc-ext/src", Some("bin")).strays(&BUILDER));
}

#[test]
fn the_checker_uses_no_code_of_the_reader() {
    let mut files = Vec::new();
    collect(&root().join("alloc-ext/src/check"), &mut files);
    assert!(files.len() > 20);
    for file in files {
        let text = without_comments(&fs::read_to_string(&file).expect("readable"));
        assert!(!text.contains("meshsweep_core"), "{}", file.display());
    }
}

#[test]
fn no_files_use_each_other_in_a_circle() {
    for (folder, but) in [
        ("core/src", None),
        ("core/c-api/src", None),
        ("alloc-ext/src", Some("bin")),
        ("alloc-ext/src/bin/meshsweep", None),
        ("alloc-ext/tests/cli", None),
        ("alloc-ext/tests/mesh", None),
        ("host-tests/src", Some("bin")),
        ("host-tests/suite/src", None),
        ("host-tests/counted/src", Some("bin")),
        ("host-tests/lab/src", None),
        ("host-tests/xtask/src", None),
    ] {
        none(&House::read(folder, but).circles());
    }
    let tests = fs::read_dir(root().join("host-tests/tests")).expect("a folder").flatten();
    for folder in tests.filter(|entry| entry.path().is_dir()) {
        let folder = format!("host-tests/tests/{}", folder.file_name().to_string_lossy());
        none(&House::read(&folder, None).circles());
    }
}
