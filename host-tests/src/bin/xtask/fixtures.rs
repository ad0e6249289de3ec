//! `cargo xtask fixtures`: writes the committed fixtures anew.

use std::fs;

use meshsweep_host_tests::generate::fixtures::write_fixtures;
use meshsweep_host_tests::measure::Subject;

use meshsweep_alloc::hull::BuildOptions;

use crate::steps::Steps;
use crate::workspace;

/// Meshes by their generators, then the blob by the builder.
pub fn write(steps: &mut Steps) {
    let folder = workspace::root().join("fixtures");
    let meshes = steps.run("mesh fixtures", || {
        write_fixtures(&folder).map_err(|error| format!("cannot write {}: {error}", folder.display()))
    });
    if meshes.is_some() {
        steps.run("fixtures/bracket.msw", || {
            let built = Subject::load(&folder.join("bracket.stl"))?.build_with(&BuildOptions::default())?;
            let blob = folder.join("bracket.msw");
            fs::write(&blob, built.bytes).map_err(|error| format!("cannot write {}: {error}", blob.display()))
        });
    }
}
