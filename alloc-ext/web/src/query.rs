//! The open blob: closest points, and its source text.

use crate::border::{Part, leave, leave_json};
use meshsweep::distances::{Distances, has_sides, signed_distance};
use meshsweep::emit::source::{SourceNames, c_header, c_source, rust_module};
use meshsweep_core::{Blob, Budget, Ended, ScratchEntry, Side};
use serde_json::{Value, json};
use std::cell::OnceCell;

thread_local! {
    /// Its bytes are leaked: the blob lives as long as the instance.
    static BLOB: OnceCell<Blob<'static>> = const { OnceCell::new() };
}

pub fn open(bytes: Vec<u8>) -> Result<(), String> {
    let blob = Blob::open(bytes.leak()).map_err(|error| error.to_string())?;
    let is_first = BLOB.with(|open| open.set(blob).is_ok());
    is_first.then_some(()).ok_or_else(|| "a blob is open already".to_owned())
}

fn blob() -> Result<Blob<'static>, String> {
    BLOB.with(|open| open.get().copied()).ok_or_else(|| "no blob is open".to_owned())
}

pub fn closest(of_hull: bool, point: [f32; 3], relative: f32, steps: u32) -> Result<(), String> {
    let blob = blob()?;
    let structure = if of_hull {
        let hulls = blob.tight_hulls().map_err(|error| error.to_string())?;
        Distances::Tight(hulls.finest().ok_or("the blob has no tight hull")?)
    } else {
        Distances::Tree(blob.bvh().map_err(|error| error.to_string())?)
    };
    let budget = Budget::EXACT.with_relative(relative).with_steps(steps);
    let mut scratch = vec![ScratchEntry::EMPTY; structure.scratch_entries()];
    let found =
        structure.closest_point(point, budget, &mut scratch).map_err(|error| error.to_string())?;
    // A tight hull does not tell the side of the mesh.
    let side = match structure {
        Distances::Tree(tree) if has_sides(&tree) => {
            let found = signed_distance(&tree, point, Budget::EXACT, &mut scratch);
            found.ok().map(|found| match found.side {
                Side::Inside => "inside",
                Side::Outside => "outside",
                _ => "undecided",
            })
        }
        _ => None,
    };
    let triangle = match found.element {
        Some(meshsweep::distances::Element::Triangle(triangle)) => Some(triangle),
        _ => None,
    };
    let [x, y, z] = found.point;
    let ends = [found.distance.lower, found.distance.upper, x, y, z];
    leave_json(&json!({
        "lower": found.distance.lower,
        "upper": found.distance.upper,
        "point": found.point,
        "triangle": triangle,
        "side": side,
        "ended": match found.ended {
            Ended::Exact => "complete",
            Ended::Tolerance => "tolerance met",
            Ended::Steps => "steps used up",
            Ended::Scratch => "scratch full",
            _ => "stored precision",
        },
        "steps": found.work.opened,
        // `cargo xtask web` compares these bits with those of the program.
        "bits": ends.map(|x| format!("{:08x}", x.to_bits())).join(" "),
    }));
    Ok(())
}

pub fn source(language: u32, names: &Value) -> Result<(), String> {
    let blob = blob()?;
    let name = |index: usize| names[index].as_str().unwrap_or_default();
    let names = SourceNames { mesh: name(0), blob: name(1) };
    let text = match language {
        0 => rust_module(&blob, names),
        1 => c_header(&blob, names),
        _ => c_source(&blob, names),
    };
    leave(Part::Text, text.into_bytes());
    Ok(())
}
