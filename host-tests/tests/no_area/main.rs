//! Points of triangles without area are points of the mesh: no answer forgets them, whatever
//! structure gives it.

mod distances;
mod exact;
mod meetings;
mod scene;
mod structures;
