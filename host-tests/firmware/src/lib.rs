#![no_std]
//! What the suite image needs of a board: a counter of instructions, and its stack.

pub mod board;
pub mod meter;
pub mod stack;
