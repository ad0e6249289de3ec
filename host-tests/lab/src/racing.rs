//! `cargo xtask race`: engines against each other on the same questions.

use std::path::{Path, PathBuf};

use meshsweep_lab::race::{Scale, hausdorff, pairs, race};
use meshsweep_xtask::say;
use meshsweep_xtask::steps::Steps;

use crate::measuring::or_fixtures;

/// Runs the race on each mesh, on the fixtures if none is named: `[--pairs] [--quick] [MESH…]`, or
/// `--hausdorff MESH MESH`. `None` if the words are others.
pub fn run(steps: &mut Steps, words: &[&str]) -> Option<()> {
    if let ["--hausdorff", meshes @ ..] = words {
        let &[first, second] = meshes else { return None };
        let name = format!("race {first} and {second}");
        let table = steps.run(&name, || hausdorff::race(Path::new(first), Path::new(second)));
        table.iter().for_each(|table| say::text(table.text()));
        return Some(());
    }
    let (mut is_quick, mut is_pairs, mut meshes) = (false, false, Vec::new());
    for &word in words {
        match word {
            "--quick" => is_quick = true,
            "--pairs" => is_pairs = true,
            flag if flag.starts_with("--") => return None,
            mesh => meshes.push(PathBuf::from(mesh)),
        }
    }
    for mesh in or_fixtures(meshes) {
        let tables = steps.run(&format!("race {}", mesh.display()), || {
            if is_pairs {
                return Ok(vec![pairs::race(&mesh, is_quick)?]);
            }
            race(&mesh, if is_quick { Scale::QUICK } else { Scale::FULL }).map(Vec::from)
        });
        tables.iter().flatten().for_each(|table| say::text(table.text()));
    }
    Some(())
}
