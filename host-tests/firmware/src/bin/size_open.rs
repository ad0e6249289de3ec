//! The size of an image that opens a hull hierarchy and asks nothing of it.
#![no_std]
#![no_main]

#[macro_use]
#[path = "../bare.rs"]
mod bare;

use meshsweep_suite::ask::hull;

ask! {
    ask_open: hull::Model<'t>, |model, input, _scratch, fold| fold.point(hull::bounds(model)[0]);
}
