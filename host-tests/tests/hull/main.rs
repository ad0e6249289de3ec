//! The hull hierarchy: its bytes, its proof and its questions.

mod bytes;
mod check;
mod closest;
mod deform;
mod deform_open;
mod deform_overlap;
mod deform_sweep;
mod edge_cases;
mod kept_sweep;
mod open;
mod outer_hits;
mod overlap;
mod rays;
mod refined;
mod scenes;
mod segments;
mod starts;
mod swept_mesh;
