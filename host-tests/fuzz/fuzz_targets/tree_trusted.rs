//! Runs `fuzz_targets::tree_trusted` of `meshsweep-host-tests`, which a stable test drives too.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| meshsweep_host_tests::fuzz_targets::tree_trusted(data));
