//! Split tables: the hull refined where a query needs it, and the faces of a whole level.

mod front;
mod hull_faces;

pub use front::{Face, Refined, RefinedHull};
pub use hull_faces::{HullFace, hull_faces};
