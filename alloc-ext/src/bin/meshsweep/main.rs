//! The `meshsweep` program.
fn main() {}
