//! The size of an image that asks a hull hierarchy for the first hit of a segment and nothing
//! else.
#![no_std]
#![no_main]

#[macro_use]
#[path = "../bare.rs"]
mod bare;

use meshsweep_suite::ask::hull;

ask! {
    ask_first_hit: hull::Model<'t>, |model, input, scratch, fold| {
        hull::first_hit(model, [input.a, input.b], scratch, &mut (), fold)
    };
}
