//! The stack of a main thread on the host, in place of the 1 MiB that the linker gives.

fn main() {
    println!("cargo::rustc-link-arg-cdylib=-zstack-size=8388608");
    println!("cargo::rerun-if-changed=build.rs");
}
