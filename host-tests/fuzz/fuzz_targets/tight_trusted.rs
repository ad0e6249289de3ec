//! Runs `fuzz_targets::tight_trusted` of `meshsweep-host-tests`, which a stable test drives too.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| meshsweep_host_tests::fuzz_targets::tight_trusted(data));
