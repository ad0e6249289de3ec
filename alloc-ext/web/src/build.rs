//! Builds a blob from a file, and reports it. Leaves the surfaces that the page draws.

use crate::border::{Part, leave, leave_json};
use crate::report_progress;
use meshsweep::builder::{Built, For};
use meshsweep::mesh::Mesh;
use meshsweep::tight::hull_mesh;
use meshsweep::{BuildError, Builder};
use meshsweep_core::{Blob, ScratchEntry, Section, TightHull};
use serde_json::{Value, json};

/// The name of the file that a request holds.
pub fn name(options: &Value) -> &str {
    options["name"].as_str().unwrap_or_default()
}

/// The message of a refusal. It begins with the name of the file.
pub fn refusal(name: &str, error: &BuildError) -> String {
    let text = error.to_string();
    // Some errors name the file.
    let is_named = text.strip_prefix(name).is_some_and(|rest| rest.starts_with([':', ',']));
    if is_named { text } else { format!("{name}: {text}") }
}

pub fn run(options: &Value, file: Vec<u8>) -> Result<(), String> {
    let name = name(options);
    let words = |key: &str| options[key].as_array().into_iter().flatten();
    let mut builder = Builder::new();
    for word in words("serve").filter_map(Value::as_str) {
        let question = For::ALL.into_iter().find(|question| question.name() == word);
        builder = builder.serve(question.ok_or_else(|| format!("no question is called {word}"))?);
    }
    let faces = words("faces").map(|count| count.as_u64().and_then(|count| count.try_into().ok()));
    let faces: Option<Vec<u32>> = faces.collect();
    builder = builder.tight_faces(&faces.ok_or("faces of the hull: a whole number is wanted")?);
    let words_of_program = builder.to_string();
    let built = builder
        .on_progress(|stage, fraction| report_progress(stage.name(), fraction))
        .build_bytes(name, file)
        .map_err(|error| refusal(name, &error))?;
    leave_json(&report(&built, &words_of_program));
    if let Some(loaded) = &built.loaded {
        draw(&loaded.mesh, Part::MeshVertices, Part::MeshTriangles);
    }
    if let Some(hull) = built.blob().tight_hulls().ok().and_then(|hulls| hulls.finest()) {
        draw(&hull_mesh(&hull), Part::HullVertices, Part::HullTriangles);
    }
    leave(Part::Blob, built.into_bytes());
    Ok(())
}

/// Leaves a mesh to be drawn.
fn draw(mesh: &Mesh, vertices: Part, triangles: Part) {
    let bytes = mesh.positions.iter().flatten().flat_map(|x| x.to_le_bytes());
    leave(vertices, bytes.collect());
    let bytes = mesh.triangles.iter().flatten().flat_map(|v| v.to_le_bytes());
    leave(triangles, bytes.collect());
}

fn report(built: &Built, options: &str) -> Value {
    let blob = built.blob();
    let unit = built.loaded.as_ref().and_then(|loaded| loaded.unit).map(|unit| unit.symbol());
    let section = |section: Section| {
        let (name, bytes) = (section.kind.name(), section.bytes);
        json!({ "name": name, "bytes": bytes })
    };
    json!({
        "options": options,
        "notes": built.report().map(|note| note.text.as_str()).collect::<Vec<_>>(),
        "unit": unit,
        "bytes": blob.bytes().len(),
        "sections": blob.sections().map(section).collect::<Vec<_>>(),
        "tree": tree(&blob),
        "hulls": hulls(&blob),
    })
}

fn tree(blob: &Blob<'_>) -> Option<Value> {
    let tree = blob.bvh().ok()?;
    Some(json!({
        "triangles": tree.triangle_count(),
        "surface_error": tree.surface_error(),
        "is_closed": tree.is_closed(),
        "has_sides": tree.has_sides(),
        "scratch_bytes": tree.scratch_entries() * size_of::<ScratchEntry>(),
        "bounds": tree.bounds(),
    }))
}

fn hulls(blob: &Blob<'_>) -> Vec<Value> {
    let Ok(hulls) = blob.tight_hulls() else { return Vec::new() };
    let all = (0..hulls.count()).filter_map(|index| hulls.get(index));
    let row = all.map(|hull| {
        let record = hull.record();
        let void = (record.void_ratio != 0.0).then(|| 100.0 * f64::from(record.void_ratio));
        json!({
            "faces": record.faces,
            "void_percent": void,
            "hull_to_mesh": to_file(&hull, record.slack),
            "mesh_to_hull": to_file(&hull, record.depth),
            // Each face has two bytes of its distance to the mesh.
            "bytes": hull.bytes().len() + 2 * record.faces as usize,
        })
    });
    row.collect()
}

/// A bound of the distance between the hull and the mesh of the file. The record's bound is of the
/// mesh whose vertices had moved before the hull was made. The hull's surface error says how far.
fn to_file(hull: &TightHull<'_>, distance: f32) -> f64 {
    let moved = hull.bvh().surface_error();
    let sum = f64::from(distance) + f64::from(moved);
    // The sum may be rounded down.
    if moved == 0.0 { sum } else { sum.next_up() }
}
