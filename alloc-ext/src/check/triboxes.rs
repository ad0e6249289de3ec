//! Proof of triboxes from the blob's bytes and the mesh: every level holds the mesh, and the inside
//! of a solid.
//!
//! A triangle is cut by the planes of the triboxes that it meets; nothing may be left. Children are
//! within their parents, so the finest level decides for all. If the union holds the mesh, the
//! winding number is the same at all points of a connected component of the union's complement.
//! Each component lies before a part of the union's boundary. So one point before each part tells
//! that the winding number is 0 in all of the complement.
//!
//! A node's hull error is proved of the part of the mesh in the node's tribox, by the nearest point
//! of that part's convex hull to each corner.

mod boundary;
mod excess;
mod parse;
mod plane;
mod shape;
mod turn;

use super::distance::ABSOLUTE;
use super::enclosure::{Surface, Winding};
use super::file::FileSurface;
use super::finding::Finding;
use super::input::{Given, is_closed};
use super::near::{Near, Verdict};
use super::planar::Polygon;
use crate::mesh::{Input, RawMesh};
use boundary::{Exposed, exposed};
use excess::{Content, Reach};
use glam::DVec3;
use parse::{NORMALS, Slabs, Triboxes};
use plane::lines;
use shape::Shape;

const TRIBOXES: &str = "triboxes";

/// What a distance from a convex hull may be off, local frame: corners of parts are rounded in grid
/// units, whose origin may be sixteen meshes away.
const DOUBT: f64 = 16.0 * ABSOLUTE;

/// Largest relative error of a stored void: it is an f32, of volumes that a turn changes by a part
/// of 2^-19.
const VOID: f64 = 1e-5;

/// The vertices of a mesh in the frame of the triboxes, grid units, and how far they may be off.
fn placed(triboxes: &Triboxes, given: &Given<'_>, unit: f64) -> (Vec<[f64; 3]>, f64) {
    let place = |v: u32| given.place(v).map(|x| x / unit);
    let mut places: Vec<_> = (0..given.mesh.positions.len() as u32).map(place).collect();
    let mut moved = given.moved() / unit;
    if let Some(turn) = &triboxes.turn {
        turn.apply(&mut places, &mut moved);
    }
    (places, moved)
}

/// Whether a tribox certainly holds all of a triangle and `moved` around it.
fn holds_alone(slabs: &Slabs, triangle: &[[f64; 3]; 3], moved: f64) -> bool {
    triangle.iter().all(|p| {
        NORMALS.iter().zip(slabs).enumerate().all(|(slab, (normal, [low, high]))| {
            let terms = [0, 1, 2].map(|k| normal[k] * p[k]);
            let product: f64 = terms.iter().sum();
            let size: f64 = terms.iter().map(|term| term.abs()).sum();
            // Coordinates alone are exact. A sum rounds, and so does what is added to it.
            let is_exact = slab < 3 && moved == 0.0;
            let doubt = if is_exact { 0.0 } else { 8.0 * f64::EPSILON * (size + moved) };
            let room = 1.5 * moved + doubt;
            product - room >= *low && product + room <= *high
        })
    })
}

/// Every triangle, and all points within `moved` of it, are in the union. Returns how many had to
/// be cut.
fn holds(
    union: &[(usize, Slabs)],
    triangles: &[[[f64; 3]; 3]],
    numbers: impl Iterator<Item = u32>,
    moved: f64,
) -> Result<usize, String> {
    let mut cut = 0;
    for (triangle, number) in triangles.iter().zip(numbers) {
        if union.iter().any(|(_, slabs)| holds_alone(slabs, triangle, moved)) {
            continue;
        }
        let mut rest = vec![Polygon::triangle()];
        let is_near = |slabs: &Slabs| {
            (0..3).all(|k| {
                triangle.iter().any(|p| p[k] >= slabs[k][0])
                    && triangle.iter().any(|p| p[k] <= slabs[k][1])
            })
        };
        for (_, slabs) in union.iter().filter(|(_, slabs)| is_near(slabs)) {
            let Some(lines) = lines(triangle, slabs, moved) else { continue };
            rest = rest.into_iter().flat_map(|part| part.minus(&lines)).collect();
            if rest.is_empty() {
                break;
            }
        }
        cut += 1;
        if let Some(at) = rest.first().and_then(|part| part.corners().next()) {
            return Err(format!(
                "triangle {number} of the mesh is not held at its barycentric {:?}",
                [1.0 - at[0] - at[1], at[0], at[1]]
            ));
        }
    }
    Ok(cut)
}

/// The winding number is 0 before all parts of the boundary. Returns how many parts there are, and
/// how many are undecided.
fn inside(parts: &[Exposed], mesh: &Surface) -> Result<[usize; 2], String> {
    let winding = Winding::new(mesh);
    let mut undecided = 0;
    for part in parts {
        let Some(p) = part.before() else {
            undecided += 1;
            continue;
        };
        let turns = winding.around(p)?;
        if turns != 0 {
            return Err(format!(
                "a point of winding number {turns} lies before a face of node {}, at {p:?} in \
                 grid units",
                part.node
            ));
        }
    }
    Ok([parts.len(), undecided])
}

/// No part of the boundary is farther from the mesh than `limit`, local frame; whether that could
/// be decided.
fn is_close(parts: &[Exposed], mesh: &Near, unit: f64, limit: f64) -> Result<bool, String> {
    for part in parts {
        for triangle in part.triangles() {
            match mesh.within(triangle.map(|p| p * unit), limit) {
                Verdict::Within => {}
                Verdict::Undecided => return Ok(false),
                Verdict::Beyond(p, d) => {
                    return Err(format!(
                        "{p} on node {} is {d:e} from the mesh, {limit:e} is stated, local frame",
                        part.node
                    ));
                }
            }
        }
    }
    Ok(true)
}

/// What a distance of the mesh's frame is in that of the triboxes, at least.
fn shortest(triboxes: &Triboxes, distance: f64) -> f64 {
    triboxes.turn.as_ref().map_or(distance, |turn| turn.shortest(distance))
}

/// No tribox reaches farther beyond the convex hull of what it holds than its node and its levels
/// say. `mesh` is in grid units, `solid` what bounds the inside.
fn hull_errors(
    triboxes: &Triboxes,
    mesh: &[[[f64; 3]; 3]],
    solid: Option<&Surface>,
    unit: f64,
) -> Result<Finding, String> {
    let mesh: Vec<[DVec3; 3]> = mesh.iter().map(|corners| corners.map(DVec3::from)).collect();
    let winding = solid.map(Winding::new);
    let content = Content { mesh: &mesh, winding: winding.as_ref(), doubt: DOUBT / unit };
    let claims = triboxes.claims();
    let mut held: Vec<Vec<u32>> = Vec::with_capacity(claims.len());
    let all: Vec<u32> = (0..mesh.len() as u32).collect();
    let mut undecided = 0;
    for (node, (slabs, parent, error)) in claims.iter().enumerate() {
        let near = content.near(slabs, parent.map_or(&all, |parent| &held[parent]));
        match content.reach(slabs, &near, shortest(triboxes, *error) / unit) {
            Reach::Within => {}
            Reach::Undecided => undecided += 1,
            Reach::Beyond(p, d) => {
                return Err(format!(
                    "node {node} reaches {:e} beyond the convex hull of what it holds, at {}, \
                     {error:e} is stated, local frame",
                    d * unit,
                    p * unit
                ));
            }
        }
        held.push(near);
    }
    Ok(match undecided {
        0 => Finding::proved(
            TRIBOXES,
            "no tribox reaches farther beyond the convex hull of what it holds than stated",
            &[("node", claims.len())],
        ),
        _ => Finding::not_proved(TRIBOXES, format!("the hull errors of {undecided} nodes")),
    })
}

/// Void ratios are those of the triboxes and of the solid that these triangles bound.
fn voids(triboxes: &Triboxes, mesh: &[[[f64; 3]; 3]]) -> Result<(), String> {
    let corners = mesh.iter().map(|corners| corners.map(DVec3::from));
    let origin = mesh.first().map_or(DVec3::ZERO, |corners| DVec3::from(corners[0]));
    let six = corners.map(|t| t.map(|p| p - origin)).map(|[a, b, c]| a.dot(b.cross(c)));
    let solid = six.sum::<f64>().abs() / 6.0;
    let box_of = |k: usize| {
        let along = || mesh.iter().flatten().map(|p| p[k]);
        along().fold(f64::MIN, f64::max) - along().fold(f64::MAX, f64::min)
    };
    // Large terms cancel to a thin solid's volume.
    let doubt = VOID + 1e-12 * box_of(0) * box_of(1) * box_of(2) / solid;
    for (index, level) in triboxes.levels.iter().enumerate() {
        if level.void_ratio == 0.0 {
            continue;
        }
        if !triboxes.is_solid {
            return Err(format!("level {index}: a void beside no solid"));
        }
        let union = triboxes.union(level.triboxes);
        let volume: f64 = union.iter().map(|(_, slabs)| Shape::of(slabs).volume).sum();
        let void = (volume / solid - 1.0).min(f64::from(f32::MAX));
        if (void - level.void_ratio).abs() > doubt * (1.0 + void.abs()) {
            return Err(format!(
                "level {index}: its void is {void:e}, the table says {:e}",
                level.void_ratio
            ));
        }
    }
    Ok(())
}

/// Proves a blob's triboxes.
pub(crate) fn verify(bytes: &[u8], input: Input<'_>, out: &mut Vec<Finding>) {
    if let Err(error) = findings(bytes, input, out) {
        out.push(Finding::failed(TRIBOXES, error));
    }
}

/// Proves that every level holds the file's triangles.
pub(super) fn verify_file(bytes: &[u8], raw: &RawMesh) -> Finding {
    let prove = || -> Result<[usize; 4], String> {
        let triboxes = Triboxes::parse(bytes)?;
        triboxes.tree()?;
        let mut file = FileSurface::new(raw, triboxes.scale_exponent + triboxes.grid_exponent);
        if let Some(turn) = &triboxes.turn {
            turn.apply(&mut file.surface.positions, &mut file.error);
        }
        let Surface { positions, triangles } = &file.surface;
        let corners: Vec<_> = triangles.iter().map(|t| t.map(|v| positions[v as usize])).collect();
        let union = triboxes.union(triboxes.levels.last().map_or(0, |last| last.triboxes));
        let cut = holds(&union, &corners, 0.., file.error)
            .map_err(|error| format!("{error}, in the file"))?;
        Ok([triboxes.levels.len(), union.len(), corners.len(), cut])
    };
    match prove() {
        Ok([levels, triboxes, triangles, cut]) => Finding::proved(
            TRIBOXES,
            "every level holds every triangle of the file, before rounding",
            &[
                ("level", levels),
                ("tribox", triboxes),
                ("triangle", triangles),
                ("cut triangle", cut),
            ],
        ),
        Err(error) => Finding::failed(TRIBOXES, error),
    }
}

fn findings(bytes: &[u8], input: Input<'_>, out: &mut Vec<Finding>) -> Result<(), String> {
    let triboxes = Triboxes::parse(bytes)?;
    triboxes.tree()?;
    let given = Given::new(input, triboxes.scale_exponent);
    let unit = 2f64.powi(triboxes.grid_exponent);
    let (positions, moved) = placed(&triboxes, &given, unit);
    let mesh: Vec<[[f64; 3]; 3]> =
        given.mesh.all_triangles().map(|t| t.map(|v| positions[v as usize])).collect();
    let finest = triboxes.levels.last().map_or(0, |last| last.triboxes);
    let union = triboxes.union(finest);
    let cut = holds(&union, &mesh, given.mesh.all_sources(), moved)?;
    out.push(Finding::proved(
        TRIBOXES,
        "every level holds every triangle of the mesh, and what moved when it was read",
        &[
            ("level", triboxes.levels.len()),
            ("tribox", union.len()),
            ("triangle", mesh.len()),
            ("cut triangle", cut),
        ],
    ));
    let mut surface = None;
    if triboxes.is_solid {
        if !is_closed(given.mesh) {
            return Err("they claim to hold the inside of a mesh that is not closed".into());
        }
        // A point outside of the union is farther from the mesh than its vertices may be off, so
        // the winding number there is the same.
        let solid = surface.insert(Surface { positions, triangles: given.mesh.triangles.clone() });
        let [parts, undecided] = inside(&exposed(&union), solid)?;
        out.push(match undecided {
            0 => Finding::proved(
                TRIBOXES,
                "every level holds all points of winding number other than 0",
                &[("exposed face", parts)],
            ),
            _ => Finding::not_proved(TRIBOXES, "that they hold the inside".to_owned()),
        });
    }
    out.push(hull_errors(&triboxes, &mesh, surface.as_ref(), unit)?);
    voids(&triboxes, &mesh[..given.mesh.triangles.len()])?;
    let near =
        Near::new(mesh.iter().map(|corners| corners.map(|p| DVec3::from(p) * unit)).collect());
    let mut undecided = Vec::new();
    for (index, level) in triboxes.levels.iter().enumerate() {
        let parts = exposed(&triboxes.union(level.triboxes));
        let most = shortest(&triboxes, level.distance);
        let is_decided = is_close(&parts, &near, unit, most)
            .map_err(|error| format!("level {index}: {error}"))?;
        if !is_decided {
            undecided.push(index.to_string());
        }
    }
    out.push(if undecided.is_empty() {
        let words = "no boundary of a level is farther from the mesh than stated";
        Finding::proved(TRIBOXES, words, &[("level", triboxes.levels.len())])
    } else {
        let which = undecided.join(", ");
        Finding::not_proved(TRIBOXES, format!("how far the boundary of level {which} is"))
    });
    Ok(())
}
