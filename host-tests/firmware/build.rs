//! Memory layouts and linker scripts of each image.

use std::path::PathBuf;
use std::{env, fs};

/// Images without a runtime: linked by `bare.x`, never started.
const BARE: [&str; 19] = [
    "proof",
    "size_empty",
    "size_open",
    "size_closest",
    "size_segment",
    "size_outer",
    "size_tree_open",
    "size_tree_closest",
    "size_tree_alone",
    "size_tree_alone_two",
    "size_tree_alone_four",
    "size_tree_segment",
    "size_tree_coherent",
    "size_tree_four",
    "size_scene",
    "size_triboxes",
    "size_tight",
    "size_curve",
    "size_sdf",
];

/// Images that run.
const RUNNING: [&str; 12] = [
    "ask",
    "robot",
    "suite_hull",
    "suite_apart",
    "suite_both",
    "suite_moving",
    "suite_tree",
    "suite_triboxes",
    "suite_tight",
    "suite_curve",
    "suite_sdf",
    "suite_deform",
];

/// RAM is kept at what such parts have, not at what the emulated board has, so that an image that
/// needs more fails.
fn memory(target: &str) -> Option<&'static str> {
    Some(match target {
        // mps2-an386.
        "thumbv7em-none-eabihf" => {
            "MEMORY { FLASH : ORIGIN = 0x00000000, LENGTH = 2M  RAM : ORIGIN = 0x20000000, LENGTH = 64K }"
        }
        // microbit (nRF51822): the part's own sizes.
        "thumbv6m-none-eabi" => {
            "MEMORY { FLASH : ORIGIN = 0x00000000, LENGTH = 256K  RAM : ORIGIN = 0x20000000, LENGTH = 16K }"
        }
        // mps2-an505 starts in the secure state, which sees the memories at their secure aliases.
        "thumbv8m.main-none-eabihf" => {
            "MEMORY { FLASH : ORIGIN = 0x10000000, LENGTH = 2M  RAM : ORIGIN = 0x38000000, LENGTH = 64K }"
        }
        // virt has one big RAM; its first part plays the flash.
        "riscv32imac-unknown-none-elf" => {
            "MEMORY { FLASH : ORIGIN = 0x80000000, LENGTH = 2M  RAM : ORIGIN = 0x80200000, LENGTH = 64K }
             REGION_ALIAS(\"REGION_TEXT\", FLASH);
             REGION_ALIAS(\"REGION_RODATA\", FLASH);
             REGION_ALIAS(\"REGION_DATA\", RAM);
             REGION_ALIAS(\"REGION_BSS\", RAM);
             REGION_ALIAS(\"REGION_HEAP\", RAM);
             REGION_ALIAS(\"REGION_STACK\", RAM);"
        }
        _ => return None,
    })
}

/// `ask` has all questions in one image, and finds its blob in external RAM, as `robot` does. So
/// for a Cortex-M0 they run on mps2-an385, which has more of both memories.
fn of_ask<'t>(target: &str, memory: &'t str) -> &'t str {
    match target {
        "thumbv6m-none-eabi" => {
            "MEMORY { FLASH : ORIGIN = 0x00000000, LENGTH = 2M  RAM : ORIGIN = 0x20000000, LENGTH = 64K }"
        }
        _ => memory,
    }
}

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=bare.x");
    // The call graph is read from them.
    println!("cargo::rustc-link-arg-bins=--emit-relocs");

    let target = env::var("TARGET").unwrap_or_default();
    let Some(memory) = memory(&target) else {
        println!(
            "cargo::error=no memory layout for `{target}`; build the images with `cargo xtask firmware`"
        );
        return;
    };
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    for image in RUNNING {
        let memory =
            if ["ask", "robot"].contains(&image) { of_ask(&target, memory) } else { memory };
        let folder = out.join(image);
        let memory = format!("{memory}\nmeshsweep_flash_end = ORIGIN(FLASH) + LENGTH(FLASH);\n");
        let written =
            fs::create_dir_all(&folder).and_then(|()| fs::write(folder.join("memory.x"), memory));
        if let Err(error) = written {
            println!("cargo::error=cannot write memory.x: {error}");
        }
        println!("cargo::rustc-link-arg-bin={image}=-L{}", folder.display());
        if target.starts_with("riscv") {
            println!("cargo::rustc-link-arg-bin={image}=-Tmemory.x");
        }
        println!("cargo::rustc-link-arg-bin={image}=-Tlink.x");
    }
    // Packages that depend on this one link with the layout of the suite's images.
    println!("cargo::metadata=memory={}", out.join("suite_tree").display());
    let here = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default());
    for image in BARE {
        println!("cargo::rustc-link-arg-bin={image}=-T{}", here.join("bare.x").display());
    }
}
