//! Gives the module a stack of 8 MiB, as a main thread on Linux has. The linker's default is 1 MiB.

fn main() {
    println!("cargo::rustc-link-arg-cdylib=-zstack-size=8388608");
    println!("cargo::rerun-if-changed=build.rs");
}
