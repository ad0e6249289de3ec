//! The images' linker script, and the folder with the mesh and the questions that they carry.

use std::path::PathBuf;
use std::{env, fs, io};

/// The files that an image carries.
const FILES: [&str; 7] = [
    "vertices.f32",
    "triangles.u32",
    "tree.msw",
    "far.f32",
    "near.f32",
    "path.f32",
    "segment.f32",
];

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-env-changed=MESHSWEEP_RIVAL");
    let Some(memory) = env::var_os("DEP_MESHSWEEP_FIRMWARE_MEMORY").map(PathBuf::from) else {
        println!("cargo::error=the firmware names no memory layout");
        return;
    };
    println!("cargo::rustc-link-arg-bins=-L{}", memory.display());
    println!("cargo::rustc-link-arg-bins=-Tlink.x");
    // Without a folder the images carry no bytes. They then show only that they build.
    let folder = env::var_os("MESHSWEEP_RIVAL").map(PathBuf::from);
    match folder.map_or_else(nothing, Ok) {
        Ok(folder) => println!("cargo::rustc-env=MESHSWEEP_RIVAL={}", folder.display()),
        Err(error) => println!("cargo::error=cannot write empty files to carry: {error}"),
    }
}

/// A folder with every file that `src/carried.rs` reads, each empty.
fn nothing() -> io::Result<PathBuf> {
    let folder = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    for name in FILES {
        fs::write(folder.join(name), [])?;
    }
    Ok(folder)
}
