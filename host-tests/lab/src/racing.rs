//! `cargo xtask race`: engines against each other, in nanoseconds.

use std::path::PathBuf;

use meshsweep_lab::race::{Scale, race};
use meshsweep_xtask::say;
use meshsweep_xtask::steps::Steps;

use crate::measuring::or_fixtures;

/// Runs the race on each mesh, on the fixtures if none is named: `[--quick] [MESH…]`. `None` if
/// that is not what the words are.
pub fn run(steps: &mut Steps, words: &[&str]) -> Option<()> {
    let (mut scale, mut meshes) = (Scale::FULL, Vec::new());
    for &word in words {
        match word {
            "--quick" => scale = Scale::QUICK,
            flag if flag.starts_with("--") => return None,
            mesh => meshes.push(PathBuf::from(mesh)),
        }
    }
    for mesh in or_fixtures(meshes) {
        let tables = steps.run(&format!("race {}", mesh.display()), || race(&mesh, scale));
        tables.iter().flatten().for_each(|table| say::text(table.text()));
    }
    Some(())
}
