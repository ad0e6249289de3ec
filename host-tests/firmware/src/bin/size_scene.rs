//! The size of an image that guards an arm of box trees that are open already, as those of
//! `meshsweep robot` are, and nothing else.
#![no_std]
#![no_main]

#[path = "../bare.rs"]
mod bare;

use meshsweep_suite::ask::robot::{self, Laid, Memory, Row};
use meshsweep_suite::fold::Fold;

#[unsafe(no_mangle)]
extern "C" fn ask_scene(arm: &Laid<'_>, row: &Row, memory: &mut Memory, fold: &mut Fold) {
    robot::guard_once(arm, row, memory, fold);
}
