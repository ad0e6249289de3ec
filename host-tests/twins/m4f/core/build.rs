//! The settings of a Cortex-M4F: see `core/build.rs`.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-check-cfg=cfg(feature, values(\"defmt\"))");
    println!("cargo::rustc-check-cfg=cfg(meshsweep_wide, meshsweep_avx2, meshsweep_small)");
    println!("cargo::rustc-check-cfg=cfg(meshsweep_soft_float, meshsweep_short_products)");
    println!("cargo::rustc-check-cfg=cfg(meshsweep_soft_double)");
    println!("cargo::rustc-cfg=meshsweep_soft_double");
}
