//! The fuzz targets on seeded bytes, so that a stable compiler runs them too.

use meshsweep_host_tests::fuzz_targets::{
    closest, curves, deform, mesh, open, outer, overlap, random_input, refine, segment, tight,
    tight_trusted, tree_closest, tree_coherent, tree_open, tree_overlap, tree_segment,
    tree_trusted, tribox, triboxes,
};
use meshsweep_host_tests::generate::Rng;

const RUNS: u64 = 5_000;
/// Nearly every blob is asked, and every question of it.
const TRUSTED_RUNS: u64 = 1_500;

fn drive(seed: u64, target: fn(&[u8])) {
    drive_runs(RUNS, seed, target);
}

fn drive_runs(runs: u64, seed: u64, target: fn(&[u8])) {
    for run in 0..runs {
        let mut rng = Rng::new(seed << 32 | run);
        let data = random_input(&mut rng);
        if let Err(panic) = std::panic::catch_unwind(|| target(&data)) {
            eprintln!("run {run} of seed {seed}: {data:?}");
            std::panic::resume_unwind(panic);
        }
    }
}

#[test]
fn open_survives_seeded_edits() {
    drive(1, open);
}

#[test]
fn closest_survives_seeded_edits() {
    drive(2, closest);
}

#[test]
fn segment_survives_seeded_edits() {
    drive(3, segment);
}

#[test]
fn outer_survives_seeded_edits() {
    drive(4, outer);
}

#[test]
fn overlap_survives_seeded_edits() {
    drive(14, overlap);
}

#[test]
fn refine_survives_seeded_edits() {
    drive(13, refine);
}

#[test]
fn tree_open_survives_seeded_edits() {
    drive(5, tree_open);
}

#[test]
fn tree_closest_survives_seeded_edits() {
    drive(6, tree_closest);
}

#[test]
fn tree_segment_survives_seeded_edits() {
    drive(7, tree_segment);
}

#[test]
fn tree_coherent_survives_seeded_edits() {
    drive(8, tree_coherent);
}

#[test]
fn trees_of_unchecked_records_end_every_question() {
    drive_runs(TRUSTED_RUNS, 16, tree_trusted);
}

#[test]
fn tight_hulls_of_unchecked_records_end_every_question() {
    drive_runs(TRUSTED_RUNS, 17, tight_trusted);
}

#[test]
fn tribox_survives_any_floats() {
    drive(9, tribox);
}

#[test]
fn tree_overlap_survives_seeded_edits() {
    drive(10, tree_overlap);
}

#[test]
fn triboxes_survive_seeded_edits() {
    drive(11, triboxes);
}

#[test]
fn tight_hulls_survive_seeded_edits() {
    drive(12, tight);
}

#[test]
fn curves_survive_seeded_edits() {
    drive(13, curves);
}

#[test]
fn deform_survives_seeded_edits() {
    drive(14, deform);
}

#[test]
fn mesh_files_of_any_bytes_are_digested() {
    drive(15, mesh);
}
