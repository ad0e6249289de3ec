//! Inputs by name: the edges of what a fuzz target takes. An input with which a fuzzer breaks
//! something belongs here. So far there is none.

use meshsweep_host_tests::fuzz_targets::{
    closest, open, outer, segment, tree_closest, tree_coherent, tree_open, tree_segment,
};

/// Every target on the same bytes.
fn all_targets(data: &[u8]) {
    open(data);
    closest(data);
    segment(data);
    outer(data);
    tree_open(data);
    tree_closest(data);
    tree_segment(data);
    tree_coherent(data);
}

#[test]
fn no_bytes_at_all_are_an_input() {
    all_targets(&[]);
}

#[test]
fn an_unchanged_blob_of_every_kind_is_an_input() {
    for seed in 0..7 {
        all_targets(&[seed, 0, 200]);
    }
}
