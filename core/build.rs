//! Tells the core what it is compiled for: vectors, floating point, size.
//!
//! The tests compile the core for this machine once more, with the settings of a board in place of
//! these: `host-tests/twins`.

use std::env;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let architecture = variable("CARGO_CFG_TARGET_ARCH");
    let features = variable("CARGO_CFG_TARGET_FEATURE");
    let is_wide = ["x86_64", "aarch64"].contains(&architecture.as_str());
    let has = |feature: &str| is_wide || features.split(',').any(|it| it == feature);
    let has_eabihf = variable("CARGO_CFG_TARGET_ABI") == "eabihf";

    // Kernels take eight triangles or boxes at once, in vector registers.
    set("meshsweep_wide", is_wide);
    // The core has kernels for AVX2 too. The caller asks the processor before it calls them.
    set("meshsweep_avx2", architecture == "x86_64");
    // The target is not known to have instructions for f32. Then integers decide first.
    let is_soft = !has("f") && !has_eabihf;
    set("meshsweep_soft_float", is_soft);
    // The target is not known to have instructions for f64. Then f32 decides first.
    set("meshsweep_soft_double", !has("d"));
    // The target is not known to have a product of two words, nor an instruction that counts bits.
    set("meshsweep_short_products", is_soft && architecture == "arm");
    // The level of the profile that this package is compiled with. It decides which functions are
    // copied into their callers and how much a search leaves out early, never an answer. Where
    // vectors are, a call would store them.
    let is_small = ["s", "z"].contains(&variable("OPT_LEVEL").as_str());
    set("meshsweep_small", is_small && !is_wide);
}

fn variable(name: &str) -> String {
    env::var(name).unwrap_or_default()
}

fn set(name: &str, is_set: bool) {
    println!("cargo::rustc-check-cfg=cfg({name})");
    if is_set {
        println!("cargo::rustc-cfg={name}");
    }
}
