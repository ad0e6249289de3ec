//! The size of an image that asks for a segment's hits on the refined hull and nothing else.
#![no_std]
#![no_main]

#[macro_use]
#[path = "../bare.rs"]
mod bare;

use meshsweep_suite::ask::hull;

ask! {
    ask_outer_hits: hull::Model<'t>, |model, input, scratch, fold| {
        hull::outer_hits(model, [input.a, input.b], scratch, &mut (), fold)
    };
}
