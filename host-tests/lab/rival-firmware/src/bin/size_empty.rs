//! The size of an image that asks nothing: what the others are compared with.
#![no_std]
#![no_main]

#[path = "../bare.rs"]
mod bare;
