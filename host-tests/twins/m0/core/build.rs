//! The settings of a Cortex-M0, compiled for size: see `core/build.rs`.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-check-cfg=cfg(feature, values(\"defmt\"))");
    println!("cargo::rustc-check-cfg=cfg(meshsweep_wide, meshsweep_avx2)");
    for name in ["soft_float", "soft_double", "short_products", "small"] {
        println!("cargo::rustc-check-cfg=cfg(meshsweep_{name})");
        println!("cargo::rustc-cfg=meshsweep_{name}");
    }
}
