//! The fuzz targets on a stable compiler: their committed corpora, seeded bytes, and inputs at the
//! edge.

use meshsweep_host_tests::fuzz_targets::{Target, corpus, of_hex, random_input, target};
use meshsweep_host_tests::generate::Rng;

/// Runs a target; names the input that it panics at.
fn run(target: Target, data: &[u8]) {
    if let Err(panic) = std::panic::catch_unwind(|| (target.run)(data)) {
        eprintln!("target {} on {data:?}", target.name);
        std::panic::resume_unwind(panic);
    }
}

fn named(name: &str) -> Target {
    target(name).expect("it is in the list")
}

fn survives_its_corpus(name: &str) {
    let inputs = corpus(name).expect("`cargo xtask fuzz` wrote it");
    assert!(!inputs.is_empty());
    inputs.iter().for_each(|input| run(named(name), input));
}

fn survives_seeded_bytes(name: &str, runs: u64) {
    let seed = name.bytes().fold(0, |seed: u64, byte| seed.wrapping_mul(31) + u64::from(byte));
    for number in 0..runs {
        run(named(name), &random_input(&mut Rng::new(seed << 32 | number)));
    }
}

/// No bytes. Then each seed of blobs without an edit: 0 edits, and 200 begins the question.
fn survives_no_bytes_and_few_bytes(name: &str) {
    run(named(name), &[]);
    (0..8).for_each(|kind| run(named(name), &[kind, 0, 200]));
}

/// A fuzzer found it: the checker gave up after too few pieces of the boundary.
#[test]
fn the_distance_of_the_boundary_of_triboxes_in_a_groove_is_proved() {
    run(named("build"), &[5, 3, 0, 0, 0, 31]);
}

/// Seeded bytes found it: a corner at 1e36 gives a grid whose origin absorbs the other coordinates,
/// and the tree's box left them out.
#[test]
fn a_mesh_with_one_corner_far_away_builds_a_blob_that_opens() {
    let input =
        of_hex("a501a53951a7d2d34e35e986a2d0a64b46e09d29ab638e54193476acacb04f8b697b99de4007b8");
    run(named("build"), &input.expect("digits"));
}

/// A fuzzer found it: on a torus with an edited vertex, fourteen descents look for a side.
#[test]
fn a_side_takes_no_more_descents_than_documented() {
    let input = of_hex(
        "160100ff40ffffff0b05002d0000000000000000000024f60084ae2ba900ffffffff490100000000000084ae\
        2b49ae2bae2b8e00f594fdff00ff00000000000000000000720000d21dd87bcc43bf328000000000002d0000\
        000000000000000024f6ff00ff000000010900000000007200000000ffffffffffffffdf0838",
    );
    run(named("tree_closest"), &input.expect("digits"));
}

macro_rules! tests {
    ($($name:ident: $runs:literal;)*) => {
        $(mod $name {
            #[test]
            fn survives_its_corpus() {
                super::survives_its_corpus(stringify!($name));
            }

            #[test]
            fn survives_seeded_bytes() {
                super::survives_seeded_bytes(stringify!($name), $runs);
            }

            #[test]
            fn survives_no_bytes_and_few_bytes() {
                super::survives_no_bytes_and_few_bytes(stringify!($name));
            }
        })*

        #[test]
        fn every_target_is_tested() {
            let listed = meshsweep_host_tests::fuzz_targets::TARGETS.iter().map(|it| it.name);
            assert!(listed.eq([$(stringify!($name)),*]));
        }
    };
}

// Fewer where a run is costly.
tests! {
    open: 5000;
    closest: 5000;
    segment: 5000;
    outer: 5000;
    overlap: 5000;
    refine: 5000;
    tree_open: 5000;
    tree_closest: 5000;
    tree_segment: 5000;
    tree_coherent: 5000;
    tree_overlap: 5000;
    tree_trusted: 1500;
    tight_trusted: 1500;
    tribox: 5000;
    triboxes: 5000;
    tight: 5000;
    curves: 5000;
    deform: 5000;
    sdf: 5000;
    both: 5000;
    mesh: 5000;
    build: 40;
}
