//! Points of triangles without area are points of the mesh: no structure's answer forgets them.

mod distances;
mod meetings;
mod structures;
