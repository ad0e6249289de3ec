//! The committed fixtures: up to date, and each with the outcome that its README names.

use std::path::{Path, PathBuf};

use meshsweep::mesh::{MeshError, load_closed, read, read_bytes, repair};
use meshsweep_host_tests::generate::evil::{Outcome, evil};
use meshsweep_host_tests::generate::fixtures::files;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../fixtures")
}

#[test]
fn committed_fixtures_are_what_the_generators_make() {
    for (name, bytes) in files() {
        let committed = std::fs::read(folder().join(&name)).unwrap_or_default();
        assert!(committed == bytes, "fixtures/{name} is out of date: run `cargo xtask fixtures`");
    }
}

#[test]
fn every_evil_file_has_its_outcome() {
    for file in evil() {
        let result = read_bytes(Path::new(file.name), file.bytes).and_then(repair);
        let outcome = match result {
            Err(error) => Err((true, variant(&error))),
            Ok((mesh, report)) => meshsweep::mesh::require_closed_manifold(&mesh)
                .map_err(|error| (false, variant(&report.explain(error)))),
        };
        let wanted = match file.outcome {
            Outcome::Accepted => Ok(()),
            Outcome::Unreadable(name) => Err((true, name.to_owned())),
            Outcome::NoSolid(name) => Err((false, name.to_owned())),
        };
        assert_eq!(outcome, wanted, "{}", file.name);
    }
}

#[test]
fn every_message_names_the_file_and_ends_in_a_remedy() {
    for file in evil() {
        if let Err(error) = read_bytes(Path::new(file.name), file.bytes).and_then(repair) {
            let message = error.to_string();
            assert!(message.starts_with(file.name) && message.contains("; "), "{message}");
            assert!(!message.contains('\n'), "{message}");
        }
    }
}

#[test]
fn good_fixtures_are_closed_manifolds_of_their_genus() {
    for (name, genus) in [("bracket.stl", 2), ("torus.ply", 1), ("groove.obj", 0)] {
        let (mesh, report) = load_closed(&folder().join(name)).unwrap();
        let (v, f) = (mesh.positions.len(), mesh.triangles.len());
        assert_eq!(v + 2 * genus, f / 2 + 2, "{name}");
        assert!(report.is_clean() && report.rounding == 0.0, "{name}: {report}");
        assert_eq!(read(&folder().join(name)).unwrap().triangles.len(), mesh.triangles.len());
    }
}

fn variant(error: &MeshError) -> String {
    let text = format!("{error:?}");
    text.split([' ', '{']).next().unwrap_or_default().to_owned()
}
