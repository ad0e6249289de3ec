//! `meshsweep` without a command: what it does, shown on a torus that is built in.

use super::failure::{Failure, Place};
use super::output::Output;
use super::{blob_file, describe};
use meshsweep_alloc::hull::{self, BuildOptions};
use meshsweep_alloc::mesh;
use meshsweep_core::QueueEntry;
use meshsweep_core::query::{Stop, closest_point, first_hit};
use std::path::Path;

/// A copy of `fixtures/torus.ply`, which a package would not contain: radii 2 and 0.75 around the z axis.
const TORUS: &[u8] = include_bytes!("demo/torus.ply");

pub fn run() -> Result<(), Failure> {
    let file = Path::new("(built-in) torus.ply");
    let refuse = |error| Failure::mesh(file, error);
    let raw = mesh::read_bytes(file, TORUS.to_vec()).map_err(refuse)?;
    let input_triangles = raw.triangles.len();
    let (mesh, _) = mesh::repair(raw).map_err(refuse)?;
    mesh::require_closed_manifold(&mesh).map_err(refuse)?;
    let built = hull::build(&mesh, 0.0, input_triangles, &BuildOptions::default(), |_| {})
        .map_err(|error| Failure::Build { file: file.to_owned(), error })?;
    let model = blob_file::open(file, &built.bytes)?;
    let mut queue = vec![QueueEntry::EMPTY; model.capacities().queue];
    let place = |error| Failure::Query { file: file.to_owned(), place: Place::BuiltIn, error };
    let point = [3.0, 1.0, 0.5];
    let closest = closest_point(&model, point, &Stop::EXACT, &mut queue).map_err(place)?;
    let (from, to) = ([4.0, 0.25, 0.1], [-4.0, 0.25, 0.1]);
    let segment = first_hit(&model, from, to, &Stop::EXACT, &mut queue).map_err(place)?;
    let bytes = built.bytes.len();
    Output::stdout().finish(|out| {
        writeln!(out, "meshsweep answers closest-point, first-hit and outer-hull questions about closed triangle meshes.")?;
        writeln!(out, "Every answer is an interval that contains the truth; a blob is read in place, without a heap.")?;
        writeln!(
            out,
            "Built in: a torus of {input_triangles} triangles. Its blob: {bytes} bytes, {:.1} per triangle; \
             RAM of a query: {} bytes.",
            bytes as f64 / input_triangles as f64,
            describe::queue_bytes(&model)
        )?;
        writeln!(
            out,
            "Closest point to {point:?}: distance {} to {}, at {:?}{}, work {}.",
            closest.lower,
            closest.upper,
            closest.point,
            in_triangle(closest.triangle),
            closest.work.total()
        )?;
        match segment.hit {
            Some(hit) => writeln!(
                out,
                "First hit from {from:?} to {to:?}: t = {}, at {:?}{}, work {}.",
                hit.t,
                hit.point,
                in_triangle(hit.triangle),
                segment.work.total()
            )?,
            None => writeln!(out, "From {from:?} to {to:?}: clear, work {}.", segment.work.total())?,
        }
        writeln!(out, "Try:  meshsweep build part.stl -o part.msw")?;
        writeln!(out, "      meshsweep closest part.msw points.csv")?;
        writeln!(out, "      meshsweep hull part.stl --faces 200 -o hull.ply")?;
        writeln!(out, "      meshsweep help")
    })
}

fn in_triangle(triangle: Option<u32>) -> String {
    triangle.map_or_else(String::new, |triangle| format!(" in triangle {triangle}"))
}
