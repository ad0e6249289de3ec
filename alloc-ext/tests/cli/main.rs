//! The command line, as users call it: one file for each kind of question.

mod all_hits;
mod arguments;
mod build;
mod builder;
mod clear;
mod clearance;
mod cull;
mod curve;
mod deform;
mod distances;
mod errors;
mod formats;
mod hausdorff;
mod hull;
mod info;
mod overlap;
mod queries;
mod refine;
mod rounding;
mod support;
mod tight;
mod trade;
mod tribox;
mod verify;
mod winding;
mod worst;
