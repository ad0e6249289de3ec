//! From a file to a blob, its report, and what the page draws.

use crate::border::{Part, answer};
use crate::{say, tell};
use meshsweep::builder::{Built, For, Note};
use meshsweep::mesh::Mesh;
use meshsweep::tight::hull_mesh;
use meshsweep::{BuildError, Builder};
use meshsweep_core::{Blob, ScratchEntry, Section};
use serde_json::{Value, json};

/// The name of the file of a request.
pub fn name(options: &Value) -> &str {
    options["name"].as_str().unwrap_or_default()
}

/// A refusal, with the file that it is about.
pub fn refusal(name: &str, error: &BuildError) -> String {
    let text = error.to_string();
    if text.contains(name) { text } else { format!("{name}: {text}") }
}

pub fn run(options: &Value, file: Vec<u8>) -> Result<(), String> {
    let name = name(options);
    let words = |key: &str| options[key].as_array().into_iter().flatten();
    let mut builder = Builder::new();
    for word in words("serve").filter_map(Value::as_str) {
        let question = For::ALL.into_iter().find(|question| question.name() == word);
        builder = builder.serve(question.ok_or_else(|| format!("no question is called {word}"))?);
    }
    let faces: Vec<u32> =
        words("faces").filter_map(Value::as_u64).map(|count| count as u32).collect();
    builder = builder.tight_faces(&faces);
    let given = builder.to_string();
    let built = builder
        .on_progress(|stage, part| tell(stage.name(), part))
        .build_bytes(name, file)
        .map_err(|error| refusal(name, &error))?;
    say(&report(&built, &given));
    if let Some(loaded) = &built.loaded {
        draw(&loaded.mesh, Part::MeshVertices, Part::MeshTriangles);
    }
    if let Some(hull) = built.blob().tight_hulls().ok().and_then(|hulls| hulls.finest()) {
        draw(&hull_mesh(&hull), Part::HullVertices, Part::HullTriangles);
    }
    answer(Part::Blob, built.into_bytes());
    Ok(())
}

/// Leaves a mesh to be drawn.
fn draw(mesh: &Mesh, vertices: Part, triangles: Part) {
    let bytes = mesh.positions.iter().flatten().flat_map(|x| x.to_le_bytes());
    answer(vertices, bytes.collect());
    let bytes = mesh.triangles.iter().flatten().flat_map(|v| v.to_le_bytes());
    answer(triangles, bytes.collect());
}

fn report(built: &Built, options: &str) -> Value {
    let blob = built.blob();
    let note = |note: &Note| json!({ "topic": note.topic.name(), "text": note.text });
    let unit = built.loaded.as_ref().and_then(|loaded| loaded.unit).map(|unit| unit.symbol());
    let section = |section: Section| {
        let (name, bytes) = (section.kind.name(), section.bytes);
        json!({ "name": name, "bytes": bytes })
    };
    json!({
        "options": options,
        "notes": built.report().map(note).collect::<Vec<_>>(),
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
            "hull_to_mesh": record.slack,
            "mesh_to_hull": record.depth,
            "bytes": hull.bytes().len() + 2 * record.faces as usize,
        })
    });
    row.collect()
}
