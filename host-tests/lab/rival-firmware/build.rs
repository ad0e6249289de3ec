//! The images' linker script, and the folder with the mesh and the questions that they carry.

use std::env;
use std::path::PathBuf;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-env-changed=MESHSWEEP_RIVAL");
    let Some(memory) = env::var_os("DEP_MESHSWEEP_FIRMWARE_MEMORY").map(PathBuf::from) else {
        println!("cargo::error=the firmware names no memory layout");
        return;
    };
    println!("cargo::rustc-link-arg-bins=-L{}", memory.display());
    println!("cargo::rustc-link-arg-bins=-Tlink.x");
    if let Some(folder) = env::var_os("MESHSWEEP_RIVAL").map(PathBuf::from) {
        println!("cargo::rustc-env=MESHSWEEP_RIVAL={}", folder.display());
    }
}
