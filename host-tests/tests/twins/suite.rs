//! The suite's questions, every one, about blobs that no board has in its flash.

use super::scenes;
use meshsweep::hull::BuildOptions;
use meshsweep_host_tests::generate::corpus::solids;
use meshsweep_host_tests::golden::{
    bending_torus, bracket_hulls, fence_curves, groove_both, tool_path_curve, torus_triboxes,
};
use meshsweep_host_tests::scene::Scene;

/// The hash of each block, by its kind's name.
type Blocks = Vec<(&'static str, u64)>;

/// What a suite records of a blob that its subject suits.
macro_rules! blocks_of {
    ($name:ident, $suite:ident) => {
        mod $name {
            use super::Blocks;
            use $suite::ask::{
                apart, both, curve, deform, hull, hull_moving, tight, tree, triboxes,
            };
            use $suite::{Kind, Observer, Plan, Recorder, Subject, run};

            #[derive(Default)]
            struct Recorded(Blocks);

            impl Observer for Recorded {}

            impl Recorder for Recorded {
                fn block(&mut self, kind: Kind, _: u32, hash: u64) {
                    self.0.push((kind.name(), hash));
                }
            }

            fn asked<'t, S: Subject<'t>>(
                blob: &'t [u8],
                scratch: &mut S::Scratch,
                to: &mut Blocks,
            ) {
                let plan = Plan { tabled_blocks: 2, blocks: 1, queries: 8 };
                let mut recorded = Recorded::default();
                if let Err(refused) = run::<S>(blob, plan, scratch, &mut recorded) {
                    recorded.0.push(("refused", u64::from(refused.0)));
                }
                to.append(&mut recorded.0);
            }

            pub fn blocks(blob: &[u8]) -> Blocks {
                let mut blocks = Vec::new();
                let to = &mut blocks;
                asked::<tree::Bvh<'_>>(blob, &mut tree::Scratch::new(), to);
                asked::<apart::Apart<'_>>(blob, &mut apart::Scratch::new(), to);
                asked::<hull::Model<'_>>(blob, &mut hull::Scratch::new(), to);
                asked::<hull_moving::Moving<'_>>(blob, &mut hull_moving::Scratch::new(), to);
                asked::<deform::DeformableHull<'_>>(blob, &mut deform::Scratch::new(), to);
                asked::<triboxes::Triboxes<'_>>(blob, &mut triboxes::Scratch::new(), to);
                asked::<tight::Hulls<'_>>(blob, &mut tight::Scratch::new(), to);
                asked::<curve::Curve<'_>>(blob, &mut curve::Scratch::new(), to);
                asked::<both::BvhWithSdf<'_>>(blob, &mut both::Scratch::new(), to);
                blocks
            }
        }
    };
}

blocks_of!(this_machine, meshsweep_suite);
blocks_of!(m0, meshsweep_suite_m0);
blocks_of!(m4f, meshsweep_suite_m4f);

/// How many kinds were asked.
fn assert_equal(name: &str, blob: &[u8]) -> usize {
    let here = this_machine::blocks(blob);
    assert_eq!(here, m0::blocks(blob), "{name} on m0");
    assert_eq!(here, m4f::blocks(blob), "{name} on m4f");
    here.iter().filter(|(kind, _)| *kind != "refused").count()
}

#[test]
fn box_trees_answer_the_suite_as_on_boards() {
    let mut asked = 0;
    for scene in scenes() {
        asked += assert_equal(&scene.name, &scene.bytes);
        asked += assert_equal(&scene.name, &scene.f32_bytes);
    }
    assert!(asked > 1000, "{asked} blocks");
}

#[test]
fn hulls_answer_the_suite_as_on_boards() {
    let mut asked = 0;
    for (name, mesh) in solids() {
        let options = BuildOptions::default();
        let sweep = Scene::sweep(name, mesh.clone(), &options);
        asked += assert_equal(name, &sweep.bytes);
        // Some solids touch themselves: no hull hierarchy encloses them.
        if ["torus", "rough sphere", "groove block"].contains(&name) {
            asked += assert_equal(name, &Scene::hull(name, mesh, &options).bytes);
        }
    }
    assert!(asked > 100, "{asked} blocks");
}

#[test]
fn all_other_structures_answer_the_suite_as_on_boards() {
    let blobs = [
        ("bend", bending_torus()),
        ("tight", bracket_hulls()),
        ("fence", fence_curves()),
        ("tool path", tool_path_curve()),
        ("triboxes", torus_triboxes()),
        ("both", groove_both()),
    ];
    for (name, blob) in blobs {
        assert!(assert_equal(name, &blob) > 4, "{name}");
    }
}
