//! The image's linker script, and the folder with the fans that it carries.

use std::path::PathBuf;
use std::{env, fs};

/// One fan and one question of each kind, for an image that only shows that it builds.
const ONE: &str = "\
pub static STARTS: [u16; 2] = [0, 2];
pub static CENTRES: [[f32; 3]; 1] = [[0.0; 3]];
pub static RIMS: [[f32; 3]; 2] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
pub static EDGES: [[f32; 3]; 2] = RIMS;
pub static LENGTHS: [f32; 2] = [1.0; 2];
pub static NORMALS: [[f32; 3]; 2] = [[0.0; 3], [0.0, 0.0, 1.0]];
pub static DISTANCES: [(u16, [f32; 3]); 1] = [(0, [0.0; 3])];
pub static HITS: [(u16, [f32; 3], [f32; 3]); 1] = [(0, [0.0; 3], [0.0; 3])];
";

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-env-changed=MESHSWEEP_FANS");
    let Some(memory) = env::var_os("DEP_MESHSWEEP_FIRMWARE_MEMORY").map(PathBuf::from) else {
        println!("cargo::error=the firmware names no memory layout");
        return;
    };
    println!("cargo::rustc-link-arg-bins=-L{}", memory.display());
    println!("cargo::rustc-link-arg-bins=-Tlink.x");
    let folder = env::var_os("MESHSWEEP_FANS").map(PathBuf::from);
    let folder = folder.map_or_else(
        || {
            let folder = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
            fs::write(folder.join("fans.rs"), ONE).map(|()| folder)
        },
        Ok,
    );
    match folder {
        Ok(folder) => {
            println!("cargo::rerun-if-changed={}", folder.join("fans.rs").display());
            println!("cargo::rustc-env=MESHSWEEP_FANS={}", folder.display());
        }
        Err(error) => println!("cargo::error=cannot write a fan to carry: {error}"),
    }
}
