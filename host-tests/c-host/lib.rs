//! The functions of `meshsweep-c`, with std's panic handler.
pub use meshsweep_c::*;
