#![no_std]
//! What the suite image needs of a board: a counter of instructions, its stack, and its flash.

pub mod board;
pub mod flash;
pub mod kept;
pub mod meter;
pub mod stack;
