//! The size of an image that asks a hull hierarchy for closest points and nothing else.
#![no_std]
#![no_main]

#[macro_use]
#[path = "../bare.rs"]
mod bare;

use meshsweep_suite::ask::hull;

ask! {
    ask_closest: hull::Model<'t>,
        |model, input, scratch, fold| hull::closest(model, input.a, scratch, &mut (), fold);
}
