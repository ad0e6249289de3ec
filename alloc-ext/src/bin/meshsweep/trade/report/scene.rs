//! The mesh, its hulls and its triboxes, coloured by their errors; the worst queries.

use super::super::measured::Measured;
use super::drawn::Drawn;
use super::path::intervals;
use super::{floats, indices};
use meshsweep::builder::{Built, Recipe};
use meshsweep::counted::Counted;
use meshsweep::distances::Distances;
use meshsweep::hull::mesh_of;
use meshsweep::load::Loaded;
use meshsweep::mesh::Mesh;
use meshsweep::surface::VertexBits;
use meshsweep::tight::hull_mesh;
use meshsweep::trade::Setting;
use meshsweep::worst::{Climb, Goal, Question, Subject};
use meshsweep_core::{Blob, Budget, QueryError, ScratchEntry, Triboxes};
use serde_json::{Value, json};

/// The setting whose upper ends measure how far hulls are from the mesh.
const RULER: Setting = Setting::new(Recipe::Tree(VertexBits::Grid16));

/// Bodies and worst queries.
pub fn as_json(
    loaded: &Loaded,
    measured: &Measured,
    asked: &[Setting],
) -> Result<Value, QueryError> {
    let mesh = Drawn::of(&loaded.mesh, measured.diagonal);
    let middles = mesh.middles();
    let mut colours = Vec::new();
    for setting in asked {
        let widths = intervals(measured, setting, &middles)?;
        let widths = widths.iter().map(|[lower, upper]| upper - lower);
        colours.push(json!({
            "name": format!("mesh, by the interval's width of {setting}"),
            "values": floats(widths),
        }));
    }
    let name = Counted(loaded.mesh.triangles.len(), "triangle");
    let mut bodies = vec![body("mesh", &format!("the mesh, {name}"), &mesh, &colours)];
    for (recipe, built) in &measured.trade.blobs {
        // Of the tight hulls and cut levels, those whose intervals are shown.
        let is_shown = asked.iter().any(|setting| setting.recipe == *recipe);
        let is_hull = matches!(recipe, Recipe::Tight(_) | Recipe::CutLevel(_));
        let is_tribox = matches!(recipe, Recipe::Triboxes(64));
        if let Some((key, name, surface)) =
            (is_shown && is_hull || is_tribox).then(|| surface(*recipe, built)).flatten()
        {
            let drawn = Drawn::of(&surface, measured.diagonal);
            let distances = intervals(measured, &RULER, &drawn.middles())?;
            let colour = json!({
                "name": format!("{name}, by its distance from the mesh"),
                "values": floats(distances.iter().map(|[_, upper]| *upper)),
            });
            bodies.push(body(key, &name, &drawn, &[colour]));
        }
    }
    Ok(json!({ "bodies": bodies, "worst": worst(measured)? }))
}

fn body(key: &str, name: &str, drawn: &Drawn, colours: &[Value]) -> Value {
    json!({
        "key": key,
        "name": name,
        "is_coarse": drawn.is_coarse,
        "positions": floats(drawn.positions.iter().flatten().copied()),
        "triangles": indices(drawn.triangles.iter().flatten().copied()),
        "colours": colours,
    })
}

/// The key, name and surface of what was built.
fn surface(recipe: Recipe, built: &Built) -> Option<(&'static str, String, Mesh)> {
    let blob = built.blob();
    match recipe {
        Recipe::Tight(_) => {
            let mesh = hull_mesh(&blob.tight_hulls().ok()?.finest()?);
            let faces = Counted(mesh.triangles.len(), "face");
            Some(("tight", format!("the tight hull, {faces}"), mesh))
        }
        Recipe::CutLevel(error) => {
            let hull = blob.hull().ok()?;
            let mesh = mesh_of(&hull, hull.faces(&hull.levels().last()?));
            let faces = Counted(mesh.triangles.len(), "face");
            Some(("level", format!("the level cut at an error of {error}, {faces}"), mesh))
        }
        Recipe::Triboxes(_) => {
            let triboxes = blob.triboxes().ok()?;
            let name = format!("{} triboxes", triboxes.leaf_count());
            Some(("triboxes", name, walls(triboxes)))
        }
        _ => None,
    }
}

/// The faces of triboxes, as fans.
fn walls(triboxes: Triboxes<'_>) -> Mesh {
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for (_, tribox) in triboxes.leaves() {
        let boundary = tribox.boundary();
        // An empty one has no numbers.
        if !boundary.vertices.iter().flatten().all(|x| x.is_finite()) {
            continue;
        }
        let first = positions.len() as u32;
        positions.extend(boundary.vertices);
        for face in 0..18 {
            let corners = boundary.face(face);
            let fan = corners.windows(2).skip(1).map(|pair| [corners[0], pair[0], pair[1]]);
            triangles.extend(fan.map(|fan| fan.map(|v| first + u32::from(v))));
        }
    }
    Mesh::new(positions, triangles)
}

/// The costliest exact query, and the queries with the widest intervals after eight steps and by
/// the tight hull. Each with the closest point of the mesh.
fn worst(measured: &Measured) -> Result<Vec<Value>, QueryError> {
    let trade = &measured.trade;
    let Some(bytes) = trade.blob(RULER.recipe) else { return Ok(Vec::new()) };
    let tree = Blob::open(bytes).map_err(|_| QueryError::Unchecked)?.bvh()?;
    let of_tree = Distances::Tree(tree);
    let after = Budget::EXACT.with_steps(8);
    let mut searched = vec![
        ("costliest", "the costliest exact query", of_tree, Goal::Work, Budget::EXACT),
        ("widest", "the widest interval after 8 steps", of_tree, Goal::Width, after),
    ];
    let tight = trade.blobs.iter().rfind(|(of, _)| matches!(of, Recipe::Tight(n) if *n <= 200));
    let tight = tight.and_then(|(_, built)| built.blob().tight_hulls().ok()?.finest());
    if let Some(hull) = tight {
        let by_hull = Distances::Tight(hull);
        let name = "the widest interval of the tight hull";
        searched.push(("tight", name, by_hull, Goal::Width, Budget::EXACT));
    }
    let mut scratch = vec![ScratchEntry::EMPTY; tree.scratch_entries()];
    let mut found = Vec::new();
    for (key, name, structure, goal, budget) in searched {
        let subject = Subject { question: Question::Closest, structure };
        let starts = Climb::default().starts;
        let Some(row) = subject.worst_of(goal, budget, starts) else { continue };
        let Ok(query) = <[f32; 3]>::try_from(row.query.as_slice()) else { continue };
        let near = tree.closest_point(query, Budget::EXACT, &mut scratch)?;
        found.push(json!({
            "key": key,
            "name": name,
            "query": query,
            "point": near.point,
            "width": row.found.width,
            "instructions": row.found.instructions.map(|[on_m4f, _]| on_m4f),
            "times": row.times(),
        }));
    }
    Ok(found)
}
