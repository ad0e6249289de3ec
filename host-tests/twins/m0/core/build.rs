//! The settings of a Cortex-M0: see `core/build.rs`.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-check-cfg=cfg(feature, values(\"defmt\"))");
    println!("cargo::rustc-check-cfg=cfg(meshsweep_wide, meshsweep_avx2, meshsweep_small)");
    for name in ["meshsweep_soft_float", "meshsweep_soft_double", "meshsweep_short_products"] {
        println!("cargo::rustc-check-cfg=cfg({name})");
        println!("cargo::rustc-cfg={name}");
    }
}
