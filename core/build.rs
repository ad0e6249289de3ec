//! Tells the core what it is compiled for: vectors, size.

use std::env;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-check-cfg=cfg(meshsweep_small, meshsweep_wide)");
    let is = |name: &str, wanted: [&str; 2]| {
        env::var(name).is_ok_and(|value| wanted.contains(&value.as_str()))
    };
    // Kernels take eight triangles or boxes at once, in vector registers.
    let is_wide = is("CARGO_CFG_TARGET_ARCH", ["x86_64", "aarch64"]);
    if is_wide {
        println!("cargo::rustc-cfg=meshsweep_wide");
    }
    // The level of the profile that this package is compiled with. It decides which functions are
    // copied into their callers, never an answer. Where vectors are, a call would store them.
    if is("OPT_LEVEL", ["s", "z"]) && !is_wide {
        println!("cargo::rustc-cfg=meshsweep_small");
    }
}
