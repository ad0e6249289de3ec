//! Linker scripts of the images, and the folder with the mesh and the questions that the racing
//! images carry.

use std::path::{Path, PathBuf};
use std::{env, fs};

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=src/bin");
    println!("cargo::rerun-if-env-changed=MESHSWEEP_RIVAL");

    let here = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default());
    // An image without a runtime is linked as the firmware's are; one that runs takes the
    // firmware's memory layout too.
    let bare = here.join("../../firmware/bare.x");
    println!("cargo::rerun-if-changed={}", bare.display());
    for image in images(&here.join("src/bin")) {
        match image.split_once('_') {
            Some(("race", _)) => println!("cargo::rustc-link-arg-bin={image}=-Tlink.x"),
            Some(("size", _)) => println!("cargo::rustc-link-arg-bin={image}=-T{}", bare.display()),
            _ => println!("cargo::error=`{image}` is neither a race_ nor a size_ image"),
        }
    }

    // Only the racing images read it: the others may be built without one.
    if let Some(folder) = env::var_os("MESHSWEEP_RIVAL").map(PathBuf::from) {
        println!("cargo::rustc-env=MESHSWEEP_RIVAL={}", folder.display());
    }
}

/// Names of the images, so that an engine comes with its files alone.
fn images(folder: &Path) -> Vec<String> {
    let files = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let mut names: Vec<String> = files
        .filter(|path| path.extension().is_some_and(|extension| extension == "rs"))
        .filter_map(|path| Some(path.file_stem()?.to_str()?.to_owned()))
        .collect();
    names.sort();
    names
}
