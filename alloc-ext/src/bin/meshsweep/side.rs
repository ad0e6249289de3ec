//! On which side of a mesh a point is, by whatever the blob knows.

use meshsweep_core::{Bvh, Side, Undecided};

/// Whether some triangles tell no side.
pub fn has_sideless(tree: &Bvh<'_>) -> bool {
    (0..tree.triangle_count()).any(|triangle| tree.is_sideless(triangle))
}

/// The side in a word.
pub fn name(side: Side) -> &'static str {
    match side {
        Side::Outside => "outside",
        Side::Inside => "inside",
        _ => "undecided",
    }
}

/// Why a side is undecided, in a word or two; nothing if it is not.
pub fn reason(side: Side) -> &'static str {
    match side {
        Side::Outside | Side::Inside => "",
        Side::Undecided(Undecided::OpenMesh) => "open mesh",
        Side::Undecided(Undecided::Steps) => "out of steps",
        Side::Undecided(Undecided::Scratch) => "out of scratch memory",
        Side::Undecided(Undecided::OnSurface) => "at the surface",
        _ => "rounding",
    }
}
