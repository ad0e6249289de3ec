//! Which questions a blob answers, and by which of its structures.

use crate::failure::Failure;
use meshsweep::distances::{Distances, has_sides};
use meshsweep_core::{
    AllOverlaps, Blob, Budget, BuildFor, Bvh, BvhWithSdf, Decided, FrameHull, Hull, Pose,
    QueryError, ScratchEntry, Sdf, SdfKind, TightHull, TrianglePair, Triboxes,
};
use std::path::Path;

/// Whether a blob serves a question.
type Serves = fn(&Blob<'_>) -> bool;

/// The questions, by the names of the commands.
const QUESTIONS: [(&str, Serves); 24] = [
    ("closest", |blob| has_distances(blob) || blob.hull().is_ok() || blob.curve().is_ok()),
    ("closest --frame", |blob| blob.deformable_hull().is_ok()),
    ("within", |blob| has_distances(blob) || blob.curve().is_ok() || blob.sdf().is_ok()),
    ("nearest", |blob| knows_triangles(blob) || blob.curve().is_ok()),
    ("nearest --frame", |blob| blob.deformable_hull().is_ok()),
    ("field", knows_triangles),
    ("signed", |blob| {
        tree(blob, BuildFor::Closest).is_some_and(|tree| has_sides(&tree))
            || is_fence(blob)
            || blob.sdf().is_ok_and(|field| field.kind() != SdfKind::Surface)
    }),
    ("winding", |blob| tree(blob, BuildFor::Winding).is_some()),
    ("segment", |blob| tree(blob, BuildFor::Segment).is_some() || blob.hull().is_ok()),
    ("segment --frame", |blob| blob.deformable_hull().is_ok()),
    ("overlap", |blob| tree(blob, BuildFor::Segment).is_some() || blob.hull().is_ok()),
    ("overlap --frame", |blob| blob.deformable_hull().is_ok()),
    ("clear", |blob| tree(blob, BuildFor::Segment).is_some()),
    ("clearance", |blob| tree(blob, BuildFor::Segment).is_some()),
    ("cull", |blob| tree(blob, BuildFor::Cull).is_some()),
    ("hull --level", |blob| blob.hull().is_ok_and(|hull| hull.encloses())),
    ("refine", |blob| blob.hull().is_ok()),
    ("hull --tight", |blob| blob.tight_hulls().is_ok()),
    ("closest --triboxes", |blob| blob.triboxes().is_ok()),
    ("within --triboxes", |blob| blob.triboxes().is_ok()),
    ("segment --triboxes", |blob| blob.triboxes().is_ok()),
    ("overlap --triboxes", |blob| blob.triboxes().is_ok()),
    ("clearance --triboxes", |blob| blob.triboxes().is_ok()),
    ("cut", |blob| blob.hull().is_ok() || blob.triboxes().is_ok() || blob.tight_hulls().is_ok()),
];

/// The questions that a blob serves, by the names of the commands.
pub fn questions(blob: &Blob<'_>) -> Vec<&'static str> {
    let served = QUESTIONS.into_iter().filter(|(_, serves)| serves(blob));
    served.map(|(question, _)| question).collect()
}

/// Whether the blob has curves that bound an area.
fn is_fence(blob: &Blob<'_>) -> bool {
    blob.curve().is_ok_and(|curve| curve.check_fence().is_ok())
}

/// Whether the blob knows the distances of the mesh's own triangles.
fn knows_triangles(blob: &Blob<'_>) -> bool {
    tree(blob, BuildFor::Closest).is_some()
}

/// Whether the blob knows distances, of the mesh's own triangles or by a tight hull.
fn has_distances(blob: &Blob<'_>) -> bool {
    knows_triangles(blob) || finest_tight(blob).is_some_and(|hull| hull.bvh().serves_distances())
}

/// The same for people. A question that is served without all of its options is marked.
pub fn listed(blob: &Blob<'_>) -> String {
    let said = |question| match question {
        "within" if !knows_triangles(blob) && blob.curve().is_err() => "within without --all",
        other => other,
    };
    questions(blob).into_iter().map(said).collect::<Vec<_>>().join(", ")
}

/// The blob's box tree, if it was built for these questions.
fn tree<'a>(blob: &Blob<'a>, build_for: BuildFor) -> Option<Bvh<'a>> {
    blob.bvh().ok().filter(|tree| match build_for {
        BuildFor::Closest => tree.serves_distances(),
        BuildFor::Segment => tree.serves_segments(),
        BuildFor::Cull => tree.serves_culling(),
        BuildFor::Winding => tree.serves_winding(),
        _ => false,
    })
}

fn finest_tight<'a>(blob: &Blob<'a>) -> Option<TightHull<'a>> {
    blob.tight_hulls().ok()?.finest()
}

/// The refusal of a question that the blob does not serve. It lists the served ones.
fn not_served(
    file: &Path,
    blob: &Blob<'_>,
    build_for: BuildFor,
    other: Option<&'static str>,
) -> Failure {
    let structure = match build_for {
        BuildFor::Closest => "box tree for distances",
        BuildFor::Segment => "box tree for segments",
        BuildFor::Cull => "box tree with normal cones",
        BuildFor::Winding => "box tree with moments",
        BuildFor::Hull => "hull hierarchy",
        BuildFor::Triboxes => "triboxes",
        BuildFor::Tight => "tight hulls",
        BuildFor::Curve => "curves",
        BuildFor::Deform => "hull that deforms",
        BuildFor::Sdf => "distance field",
        _ => "such structure",
    };
    // With what the blob has already, so that a blob built so serves all of it.
    let of_tree = [BuildFor::Closest, BuildFor::Segment, BuildFor::Cull, BuildFor::Winding];
    let wanted = |other: &BuildFor| *other == build_for || tree(blob, *other).is_some();
    let build_for = if of_tree.contains(&build_for) {
        let all: Vec<_> =
            of_tree.iter().filter(|other| wanted(other)).map(ToString::to_string).collect();
        all.join(",")
    } else {
        build_for.to_string()
    };
    let file = file.to_owned();
    Failure::NotServed { file, structure, build_for, other, served: listed(blob) }
}

/// The blob's box tree for these questions.
pub fn require_tree<'a>(
    file: &Path,
    blob: &Blob<'a>,
    build_for: BuildFor,
) -> Result<Bvh<'a>, Failure> {
    tree(blob, build_for).ok_or_else(|| not_served(file, blob, build_for, None))
}

/// The blob's distance field, if no other structure of it knows distances: a box tree's interval is
/// narrower.
pub fn field<'a>(blob: &Blob<'a>) -> Option<Sdf<'a>> {
    let others = has_distances(blob) || blob.curve().is_ok();
    blob.sdf().ok().filter(|_| !others)
}

/// The blob's box tree for distances with its distance field, if it has both.
pub fn tree_with_field<'a>(blob: &Blob<'a>) -> Option<BvhWithSdf<'a>> {
    blob.bvh_with_sdf().ok().filter(|both| both.tree().serves_distances())
}

/// How far from a distance field a query may be.
pub const FIELD_LIMIT: &str = "2^60 units of the field from it";

/// The blob's hull hierarchy, if its levels are hulls.
pub fn require_hulls<'a>(file: &Path, blob: &Blob<'a>) -> Result<Hull<'a>, Failure> {
    let hull = require_hull(file, blob)?;
    if hull.encloses() { Ok(hull) } else { Err(Failure::NotEnclosing { file: file.to_owned() }) }
}

/// The blob's hull hierarchy.
pub fn require_hull<'a>(file: &Path, blob: &Blob<'a>) -> Result<Hull<'a>, Failure> {
    blob.hull().map_err(|_| not_served(file, blob, BuildFor::Hull, None))
}

/// The blob's triboxes.
pub fn require_triboxes<'a>(file: &Path, blob: &Blob<'a>) -> Result<Triboxes<'a>, Failure> {
    blob.triboxes().map_err(|_| not_served(file, blob, BuildFor::Triboxes, None))
}

/// The blob's hull hierarchy at a key frame, and the scratch entries to ask it with.
pub fn require_frame<'a>(
    file: &Path,
    blob: &Blob<'a>,
    frame: f32,
) -> Result<(FrameHull<'a>, usize), Failure> {
    let hull =
        blob.deformable_hull().map_err(|_| not_served(file, blob, BuildFor::Deform, None))?;
    let last = hull.frames().saturating_sub(1);
    let refuse = |_| Failure::NoFrame { file: file.to_owned(), frame, last };
    Ok((hull.at_frame(frame).map_err(refuse)?, Engine::Hull(hull.rest()).scratch_entries()))
}

/// The finest tight hull of at most so many faces.
pub fn require_tight<'a>(
    file: &Path,
    blob: &Blob<'a>,
    faces: u32,
) -> Result<TightHull<'a>, Failure> {
    let refuse = || not_served(file, blob, BuildFor::Tight, None);
    let hulls = blob.tight_hulls().map_err(|_| refuse())?;
    let count = hulls.records().take_while(|record| record.faces <= faces).count();
    let Some(index) = count.checked_sub(1) else {
        let least = hulls.records().next().map_or(0, |record| record.faces);
        return Err(Failure::NoTightHull { file: file.to_owned(), faces, least });
    };
    hulls.get(index as u32).ok_or_else(refuse)
}

/// The finest tight hull of at most so many faces. Without a number of faces: the finest of all, if
/// no other structure of the blob knows distances.
pub fn tight_hull<'a>(
    file: &Path,
    blob: &Blob<'a>,
    faces: Option<u32>,
) -> Result<Option<TightHull<'a>>, Failure> {
    let hull = match faces {
        Some(faces) => require_tight(file, blob, faces)?,
        None if blob.hull().is_ok() || knows_triangles(blob) => return Ok(None),
        None => match finest_tight(blob) {
            Some(hull) => hull,
            None => return Ok(None),
        },
    };
    if hull.bvh().serves_distances() {
        return Ok(Some(hull));
    }
    Err(Failure::NotServed {
        file: file.to_owned(),
        structure: "tight hull for distances",
        build_for: "tight --tight-for closest".to_owned(),
        other: None,
        served: listed(blob),
    })
}

/// A structure that answers both distances and segments.
#[derive(Clone, Copy)]
pub enum Engine<'a> {
    Tree(Bvh<'a>),
    Hull(Hull<'a>),
}

impl Engine<'_> {
    /// Scratch entries with which no query ends for want of memory.
    pub fn scratch_entries(&self) -> usize {
        match self {
            Engine::Tree(tree) => tree.scratch_entries(),
            Engine::Hull(hull) => hull.scratch_entries() + COMFORTABLE_SCRATCH,
        }
    }
}

/// More scratch entries of a hull hierarchy than it needs: enough to search best first, and small
/// beside a cache.
const COMFORTABLE_SCRATCH: usize = 4096;

/// More scratch entries of a curve than it needs: with these, searches go best first.
pub const BEST_FIRST: usize = 256;

/// Scratch entries to ask a structure about points with, unless `--scratch` says otherwise.
pub fn entries(structure: &Distances<'_>) -> usize {
    structure.scratch_entries()
        + match structure {
            Distances::Tree(_) | Distances::TreeWithField(_) | Distances::Tight(_) => 0,
            Distances::Hull(_) => COMFORTABLE_SCRATCH,
            Distances::Curve(_) => BEST_FIRST,
        }
}

/// The engine that `--engine` chooses; or else the box tree, if the blob has one.
pub fn choose<'a>(
    file: &Path,
    blob: &Blob<'a>,
    build_for: BuildFor,
    tree_chosen: Option<bool>,
) -> Result<Engine<'a>, Failure> {
    let refuse = |build_for, other| Err(not_served(file, blob, build_for, other));
    match (tree_chosen, tree(blob, build_for), blob.hull()) {
        (Some(true) | None, Some(tree), _) => Ok(Engine::Tree(tree)),
        (Some(false) | None, _, Ok(hull)) => Ok(Engine::Hull(hull)),
        (Some(false), tree, Err(_)) => refuse(BuildFor::Hull, tree.map(|_| "tree")),
        (Some(true), None, hull) => refuse(build_for, hull.ok().map(|_| "hull")),
        (None, None, Err(_)) => refuse(build_for, None),
    }
}

/// Structures of the same kind of two blobs.
#[derive(Clone, Copy)]
pub enum Both<'a> {
    Trees([Bvh<'a>; 2]),
    Hulls([Hull<'a>; 2]),
}

impl Both<'_> {
    /// Scratch entries with which no overlap ends for want of memory.
    pub fn entries(&self) -> usize {
        match self {
            Both::Trees(_) => Bvh::OVERLAP_ENTRIES,
            Both::Hulls([first, second]) => first.overlap_entries(second),
        }
    }

    pub fn overlap(
        &self,
        pose: Pose,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<Decided<[u32; 2]>, QueryError> {
        match self {
            Both::Trees([first, second]) => first.overlap(second, pose, budget, scratch),
            Both::Hulls([first, second]) => first.overlap(second, pose, budget, scratch),
        }
    }

    pub fn all_overlaps(
        &self,
        pose: Pose,
        pairs: &mut [TrianglePair],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<AllOverlaps, QueryError> {
        match self {
            Both::Trees([first, second]) => {
                first.all_overlaps(second, pose, pairs, budget, scratch)
            }
            Both::Hulls([first, second]) => {
                first.all_overlaps(second, pose, pairs, budget, scratch)
            }
        }
    }
}

/// The engine that `--engine` chooses for both blobs; or else the box trees, unless one is missing
/// and both blobs have a hull hierarchy.
pub fn choose_both<'a>(
    files: [&Path; 2],
    blobs: &[Blob<'a>; 2],
    tree_chosen: Option<bool>,
) -> Result<Both<'a>, Failure> {
    let has_tree = |blob: &Blob<'_>| tree(blob, BuildFor::Segment).is_some();
    let is_tree = tree_chosen.unwrap_or_else(|| {
        blobs.iter().all(has_tree) || !blobs.iter().all(|blob| blob.hull().is_ok())
    });
    let [file, other] = files;
    let [first, second] = blobs;
    if is_tree {
        let tree = |file, blob| require_tree(file, blob, BuildFor::Segment);
        Ok(Both::Trees([tree(file, first)?, tree(other, second)?]))
    } else {
        Ok(Both::Hulls([require_hull(file, first)?, require_hull(other, second)?]))
    }
}

#[cfg(test)]
mod tests {
    use super::QUESTIONS;
    use crate::args;

    /// Commands that take a mesh, or tell what a blob holds, or ask all that it serves.
    const OTHERS: [&str; 8] =
        ["build", "hausdorff", "info", "robot", "trade", "tribox", "verify", "worst"];

    #[test]
    fn every_command_that_asks_a_blob_has_a_row() {
        let command = args::command();
        let names = command.get_subcommands().map(|command| command.get_name());
        for name in names.filter(|name| !OTHERS.contains(name)) {
            let is_asked = |(question, _): &(&str, _)| question.split(' ').next() == Some(name);
            assert!(QUESTIONS.iter().any(is_asked), "{name} has no row");
        }
    }
}
