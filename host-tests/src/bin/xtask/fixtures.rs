//! `cargo xtask fixtures`: writes the committed fixtures anew.

use std::fs;

use meshsweep_host_tests::generate::fixtures::write_fixtures;
use meshsweep_host_tests::golden::{
    bracket_hulls, groove_tree, hull_answers, tight_answers, torus_triboxes, tree_answers,
    tribox_answers,
};
use meshsweep_host_tests::measure::Subject;

use meshsweep::hull::BuildOptions;

use crate::steps::Steps;
use crate::workspace;

/// Meshes by their generators, then blobs by the builder, then their answers.
pub fn write(steps: &mut Steps) {
    let folder = workspace::root().join("fixtures");
    let put = |name: &str, bytes: &[u8]| {
        let file = folder.join(name);
        fs::write(&file, bytes).map_err(|error| format!("cannot write {}: {error}", file.display()))
    };
    let meshes = steps.run("mesh fixtures", || {
        write_fixtures(&folder)
            .map_err(|error| format!("cannot write {}: {error}", folder.display()))
    });
    let hull = meshes.and_then(|()| {
        steps.run("fixtures/bracket.msw", || {
            let bytes = Subject::load(&folder.join("bracket.stl"))?
                .build_with(&BuildOptions::default())?
                .bytes;
            put("bracket.msw", &bytes).map(|()| bytes)
        })
    });
    let tree = steps.run("fixtures/groove.msw", || {
        let bytes = groove_tree();
        put("groove.msw", &bytes).map(|()| bytes)
    });
    let triboxes = steps.run("fixtures/torus.msw", || {
        let bytes = torus_triboxes();
        put("torus.msw", &bytes).map(|()| bytes)
    });
    let tight = steps.run("fixtures/hulls.msw", || {
        let bytes = bracket_hulls();
        put("hulls.msw", &bytes).map(|()| bytes)
    });
    if let (Some(hull), Some(tree), Some(triboxes), Some(tight)) = (hull, tree, triboxes, tight) {
        steps.run("fixtures/answers.txt", || {
            let refused = |refused| format!("the core refuses the blob: {refused:?}");
            let answers = hull_answers("bracket.msw", &hull).map_err(refused)?
                + &tree_answers("groove.msw", &tree).map_err(refused)?
                + &tribox_answers("torus.msw", &triboxes).map_err(refused)?
                + &tight_answers("hulls.msw", &tight).map_err(refused)?;
            put("answers.txt", answers.as_bytes())
        });
    }
}
