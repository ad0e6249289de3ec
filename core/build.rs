//! Tells the core whether it is compiled for size.

use std::env;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-check-cfg=cfg(meshsweep_small)");
    let is = |name: &str, wanted: [&str; 2]| {
        env::var(name).is_ok_and(|value| wanted.contains(&value.as_str()))
    };
    // The level of the profile that this package is compiled with. It decides which functions are
    // copied into their callers, never an answer. Where vectors are, a call would store them.
    if is("OPT_LEVEL", ["s", "z"]) && !is("CARGO_CFG_TARGET_ARCH", ["x86_64", "aarch64"]) {
        println!("cargo::rustc-cfg=meshsweep_small");
    }
}
