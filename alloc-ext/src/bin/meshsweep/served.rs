//! Which questions a blob answers, and by which of its structures.

use crate::failure::Failure;
use crate::need::Need;
use meshsweep_core::{Bvh, Model, TightHull};
use std::path::Path;

/// The questions that `model` serves, by the names of the commands.
pub fn questions(model: &Model<'_>) -> Vec<&'static str> {
    let tree = model.tree();
    let tree = tree.as_ref();
    let distances = tree.is_some_and(Bvh::serves_distances);
    let hull = model.has_hull();
    let tight = finest_tight(model).is_some_and(|hull| hull.tree().serves_distances());
    [
        ("closest", distances || hull || tight),
        ("within", distances || tight),
        ("nearest", distances),
        ("field", distances),
        ("signed", distances && tree.is_some_and(|tree| tree.header().is_closed())),
        ("segment", tree.is_some_and(Bvh::serves_segments) || hull),
        ("overlap", tree.is_some_and(Bvh::serves_segments)),
        ("cull", tree.is_some_and(Bvh::serves_culling)),
        ("hull --level", hull),
        ("hull --tight", model.tight_hulls().is_some()),
        ("triboxes", model.triboxes().is_some()),
        ("cut", hull || model.triboxes().is_some() || model.tight_hulls().is_some()),
    ]
    .into_iter()
    .filter_map(|(question, serves)| serves.then_some(question))
    .collect()
}

/// The same for people. A question that `model` serves in part is marked.
pub fn listed(model: &Model<'_>) -> String {
    let knows_triangles = tree(model, Need::Distances).is_some();
    let said = |question| match question {
        "within" if !knows_triangles => "within without --all",
        other => other,
    };
    questions(model).into_iter().map(said).collect::<Vec<_>>().join(", ")
}

/// The refusal of a question that `model` does not serve. It lists the served ones.
fn not_served(file: &Path, model: &Model<'_>, need: Need, other: Option<&'static str>) -> Failure {
    Failure::NotServed { file: file.to_owned(), need, other, served: listed(model) }
}

/// The blob's tree, if it serves `need`.
pub fn tree<'a>(model: &Model<'a>, need: Need) -> Option<Bvh<'a>> {
    model.tree().filter(|tree| match need {
        Need::Distances => tree.serves_distances(),
        Need::Segments => tree.serves_segments(),
        Need::Culling => tree.serves_culling(),
        Need::Hull | Need::Tight | Need::TightDistances => false,
    })
}

/// The blob's tree for `need`.
pub fn require_tree<'a>(file: &Path, model: &Model<'a>, need: Need) -> Result<Bvh<'a>, Failure> {
    tree(model, need).ok_or_else(|| not_served(file, model, need, None))
}

fn finest_tight<'a>(model: &Model<'a>) -> Option<TightHull<'a>> {
    model.tight_hulls()?.finest()
}

/// The finest tight hull of at most so many faces. Without a number of faces: the finest of all, if
/// no other structure of the blob knows distances.
pub fn tight_hull<'a>(
    file: &Path,
    model: &Model<'a>,
    faces: Option<u32>,
) -> Result<Option<TightHull<'a>>, Failure> {
    let Some(faces) = faces else {
        let others = model.has_hull() || tree(model, Need::Distances).is_some();
        let finest = finest_tight(model).filter(|_| !others);
        return finest.map(|hull| for_distances(file, model, hull)).transpose();
    };
    require_tight(file, model, faces).and_then(|hull| for_distances(file, model, hull)).map(Some)
}

fn for_distances<'a>(
    file: &Path,
    model: &Model<'_>,
    hull: TightHull<'a>,
) -> Result<TightHull<'a>, Failure> {
    if hull.tree().serves_distances() {
        Ok(hull)
    } else {
        Err(not_served(file, model, Need::TightDistances, None))
    }
}

/// The finest tight hull of at most so many faces.
pub fn require_tight<'a>(
    file: &Path,
    model: &Model<'a>,
    faces: u32,
) -> Result<TightHull<'a>, Failure> {
    let refuse = || not_served(file, model, Need::Tight, None);
    let hulls = model.tight_hulls().ok_or_else(refuse)?;
    let count = hulls.records().take_while(|record| record.faces <= faces).count();
    let Some(index) = count.checked_sub(1) else {
        let least = hulls.records().next().map_or(0, |record| record.faces);
        return Err(Failure::NoTightHull { file: file.to_owned(), faces, least });
    };
    hulls.get(index as u32).ok_or_else(refuse)
}

/// Refuses a blob without a hull hierarchy.
pub fn require_hull(file: &Path, model: &Model<'_>) -> Result<(), Failure> {
    if model.has_hull() { Ok(()) } else { Err(not_served(file, model, Need::Hull, None)) }
}

/// The tree, or `None` for the hull hierarchy: the choice of `--engine`, or else the tree if the
/// blob has one.
pub fn choose<'a>(
    file: &Path,
    model: &Model<'a>,
    need: Need,
    tree_chosen: Option<bool>,
) -> Result<Option<Bvh<'a>>, Failure> {
    let tree = tree(model, need);
    let refuse = |need, other| Err(not_served(file, model, need, other));
    match (tree_chosen, tree) {
        (Some(true) | None, Some(tree)) => Ok(Some(tree)),
        (Some(false) | None, _) if model.has_hull() => Ok(None),
        (Some(false), tree) => refuse(Need::Hull, tree.map(|_| "tree")),
        (Some(true), None) => refuse(need, model.has_hull().then_some("cover")),
        (None, None) => refuse(need, None),
    }
}
