//! Every input that a fuzzer found to break something, by name, reduced to what mattered.

use meshsweep_host_tests::fuzz_targets::{closest, open, outer, segment};

/// Every target on the same bytes.
fn all_targets(data: &[u8]) {
    open(data);
    closest(data);
    segment(data);
    outer(data);
}

#[test]
fn no_bytes_at_all_are_an_input() {
    all_targets(&[]);
}

#[test]
fn an_unchanged_blob_of_every_kind_is_an_input() {
    for seed in 0..6 {
        all_targets(&[seed, 0, 200]);
    }
}
