//! On which side of a mesh a point is, by whatever the blob knows.

use meshsweep_core::{Budget, Bvh, QueryError, ScratchEntry, Side, SignedDistance, Undecided};

/// Whether sides are defined: by the nearest triangle of a closed mesh, or by winding numbers.
pub fn has_sides(tree: &Bvh<'_>) -> bool {
    tree.has_sides() || tree.serves_winding()
}

/// Whether some triangles tell no side.
pub fn has_sideless(tree: &Bvh<'_>) -> bool {
    (0..tree.triangle_count()).any(|triangle| tree.is_sideless(triangle))
}

/// Signed distance. The side is that of the nearest triangle, if it tells one, else that of the
/// winding number, if the blob has moments.
pub fn signed_distance(
    tree: &Bvh<'_>,
    point: [f32; 3],
    budget: Budget,
    scratch: &mut [ScratchEntry],
) -> Result<SignedDistance, QueryError> {
    if !tree.serves_winding() {
        return tree.signed_distance(point, budget, scratch);
    }
    if tree.has_sides() {
        let found = tree.signed_distance(point, budget, scratch)?;
        if !matches!(found.side, Side::Undecided(_)) {
            return Ok(found);
        }
    }
    tree.signed_by_winding(point, budget, scratch)
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
