//! Distance questions to the box tree against brute force.

mod all_within;
mod closest;
mod nearest;
mod precise;
pub mod scenes;
mod side;
mod thin_walls;
mod within;
