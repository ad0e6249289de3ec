//! Distance questions to the box tree against brute force.

mod all_within;
mod closest;
mod nearest;
mod scene;
mod side;
mod soup;
mod winding;
mod within;
