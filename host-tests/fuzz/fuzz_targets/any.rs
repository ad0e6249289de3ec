//! Runs the fuzz target that the environment variable `MESHSWEEP_FUZZ` names.
#![no_main]

use libfuzzer_sys::fuzz_target;
use meshsweep_host_tests::fuzz_targets::{Target, target};
use std::sync::LazyLock;

static TARGET: LazyLock<Target> = LazyLock::new(|| {
    let name = std::env::var("MESHSWEEP_FUZZ").unwrap_or_default();
    target(&name).unwrap_or_else(|reason| panic!("MESHSWEEP_FUZZ: {reason}"))
});

fuzz_target!(
    // Blobs that all inputs edit are built here, where no time is limited.
    init: (TARGET.run)(&[]),
    |data: &[u8]| (TARGET.run)(data)
);
