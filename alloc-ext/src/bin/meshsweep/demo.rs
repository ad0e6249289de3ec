//! `meshsweep` without a command: a demonstration on a built-in part.

use crate::describe;
use crate::failure::{Failure, Place};
use crate::output::Output;
use crate::side::name;
use meshsweep::BuildError;
use meshsweep::bvh::{self, TreeOptions};
use meshsweep::mesh;
use meshsweep::progress::Watch;
use meshsweep_core::{Budget, Bvh, Ended, Facing, Interval, ScratchEntry};
use std::path::Path;

/// A copy of `fixtures/bracket.stl`, because a package holds no file outside of its folder.
const BRACKET: &[u8] = include_bytes!("demo/bracket.stl");

pub fn run() -> Result<(), Failure> {
    let file = Path::new("(built-in) bracket.stl");
    let refuse = |error| {
        Failure::build(file, BuildError::Mesh { file: file.to_owned(), error: Box::new(error) })
    };
    let raw = mesh::read_bytes(file, BRACKET.to_vec()).map_err(refuse)?;
    let triangles = raw.triangles.len();
    let (mesh, _) = mesh::repair(raw).map_err(refuse)?;
    let (tables, _) = bvh::build(mesh.as_input(), &TreeOptions::default(), Watch::NONE)
        .map_err(|error| Failure::build(file, error))?;
    let bytes = tables.to_bytes();
    let tree = Bvh::open(&bytes).map_err(|error| Failure::open(file, error))?;
    let mut scratch = vec![ScratchEntry::EMPTY; tree.scratch_entries()];
    let place = |error| Failure::Query { place: Place::BuiltIn, error };
    let point = [10.0, 4.5, 7.0];
    let closest = tree.closest_point(point, Budget::EXACT, &mut scratch).map_err(place)?;
    let side = tree.signed_distance(point, Budget::EXACT, &mut scratch).map_err(place)?.side;
    let (from, to) = ([20.0, 10.0, 90.0], [20.0, 10.0, -90.0]);
    let segment =
        tree.first_hit(from, to, Facing::Both, Budget::EXACT, &mut scratch).map_err(place)?;
    let Interval { lower, upper } = closest.distance;
    Output::stdout().finish(|out| {
        writeln!(
            out,
            "meshsweep answers questions about triangle meshes: distances, hits, signs, \
            outer hulls."
        )?;
        writeln!(
            out,
            "Every answer is an interval that contains the truth; a blob is read in \
            place, without a heap."
        )?;
        writeln!(
            out,
            "Built in: a bracket of {triangles} triangles. Its box tree: a blob of {} bytes, \
             {:.1} a triangle; a query needs {} bytes of RAM.",
            bytes.len(),
            bytes.len() as f64 / triangles as f64,
            describe::tree::scratch_bytes(&tree)
        )?;
        writeln!(
            out,
            "Closest point to {point:?}, which is {}: distance {} to {}, at {:?}{}.",
            name(side),
            lower,
            upper,
            closest.point,
            in_triangle(closest.triangle)
        )?;
        match segment.hit {
            _ if segment.is_clear() => writeln!(out, "From {from:?} to {to:?}: clear.")?,
            Some(hit) if segment.ended == Ended::Exact => writeln!(
                out,
                "First hit from {from:?} to {to:?}: t = {}, at {:?}{}.",
                hit.t,
                hit.point,
                in_triangle(hit.triangle)
            )?,
            _ => writeln!(out, "From {from:?} to {to:?}: clear before t = {}.", segment.t.lower)?,
        }
        let program = program();
        writeln!(out, "Try:  {program} build part.stl -o part.msw")?;
        writeln!(out, "      {program} closest part.msw 10,4.5,7")?;
        writeln!(out, "      {program} field part.msw -o distances.npy")?;
        writeln!(out, "      {program} hull part.stl --faces 200 -o hull.ply")?;
        writeln!(out, "      {program} help")
    })
}

/// The words that call the program: `cargo run`, which sets a variable, or the program's name.
fn program() -> String {
    if std::env::var_os("CARGO_MANIFEST_DIR").is_some() {
        return "cargo run --release --".to_owned();
    }
    std::env::args().next().unwrap_or_else(|| "meshsweep".to_owned())
}

fn in_triangle(triangle: Option<u32>) -> String {
    triangle.map_or_else(String::new, |triangle| format!(" in triangle {triangle}"))
}
