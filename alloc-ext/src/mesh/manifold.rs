//! What an outer hull needs of a mesh.

use super::boundary::boundary;
use super::edges::{EdgeTable, NON_MANIFOLD, ends};
use super::outward::{ClosedComponent, Standing, closed_components};
use super::report::PLACES_KEPT;
use super::vertex_fans::fans;
use super::winding::propagate;
use super::{EdgePlace, Mesh, MeshError};

/// Checks that a mesh is the boundary of a solid: each edge has exactly two triangles, wound
/// against each other, each vertex one fan, each component a volume, and outermost components face
/// outwards.
/// Cavities and several parts are welcome.
///
/// That triangles do not cross each other is not checked.
///
/// # Errors
/// In this order: an array that breaks [`Mesh`]'s promise, no triangle with an area, boundary edges
/// (as holes), non-manifold edges, non-manifold vertices, one-sided components, inconsistent
/// winding, a component without volume, inside-out ones. The last four kinds but one-sided ones and
/// zero volume cannot occur after [`repair`](super::repair()).
pub fn require_closed_manifold(mesh: &Mesh) -> Result<(), MeshError> {
    check_arrays(mesh)?;
    let triangles = &mesh.triangles;
    let edges = EdgeTable::new(mesh.positions.len(), triangles);
    let twins = edges.twins();

    let open = boundary(&mesh.positions, triangles, &twins);
    if open.edge_count > 0 {
        return Err(MeshError::Open {
            edge_count: open.edge_count,
            hole_count: open.of_holes.len(),
            largest_hole: open.largest,
            slit_count: open.slit_count,
            places: places(mesh, open.of_holes.iter().copied()),
            dropped_triangle: None,
        });
    }
    if twins.contains(&NON_MANIFOLD) {
        let crowded = || edges.edges().filter(|edge| edge.len() > 2);
        return Err(MeshError::NonManifoldEdges {
            count: crowded().count(),
            most: crowded().map(<[_]>::len).max().unwrap_or(0),
            places: places(mesh, crowded().map(|edge| edge[0].1)),
        });
    }
    check_vertices(mesh, &edges)?;

    let parts = propagate(triangles, &twins);
    let conflicts: Vec<u32> = parts.kinds.iter().filter_map(|kind| kind.conflict).collect();
    if !conflicts.is_empty() {
        return Err(MeshError::NonOrientable {
            component_count: conflicts.len(),
            places: places(mesh, conflicts.into_iter()),
        });
    }
    let against = |&h: &u32| {
        h < twins[h as usize] && ends(triangles, h)[0] == ends(triangles, twins[h as usize])[0]
    };
    let edge_count = (0..twins.len() as u32).filter(against).count();
    if edge_count > 0 {
        let places = places(mesh, (0..twins.len() as u32).filter(against));
        return Err(MeshError::InconsistentWinding { edge_count, places });
    }

    let solids = closed_components(&mesh.positions, triangles, &parts);
    let first_corner = |t: u32| mesh.positions[triangles[t as usize][0] as usize];
    if let Some(part) = solids.iter().find(|part| part.volume.is_zero()) {
        return Err(MeshError::ZeroVolume {
            triangle: mesh.source[part.first as usize],
            at: first_corner(part.first),
            volume: part.volume.value,
            bound: part.volume.bound,
        });
    }
    let is_inverted = |part: &&ClosedComponent| {
        matches!(part.standing, Standing::InsideOut | Standing::Doubt { may_be_cavity: false })
    };
    let inverted = || solids.iter().filter(is_inverted);
    match inverted().count() {
        0 => Ok(()),
        component_count => Err(MeshError::InsideOut {
            component_count,
            places: inverted().take(PLACES_KEPT).map(|part| first_corner(part.first)).collect(),
        }),
    }
}

fn check_arrays(mesh: &Mesh) -> Result<(), MeshError> {
    let invalid = |reason: String| Err(MeshError::Invalid { reason });
    let vertex_count = mesh.positions.len();
    let repeats = |&[a, b, c]: &[u32; 3]| a == b || b == c || c == a;
    let count = mesh.triangles.len() + mesh.wires.len();
    if count > 0 && mesh.triangles.iter().all(repeats) {
        return Err(MeshError::NoArea { count });
    }
    if mesh.triangles.is_empty() {
        return invalid("no triangles".into());
    }
    if mesh.source.len() != mesh.triangles.len() {
        return invalid(format!(
            "{} source numbers for {} triangles",
            mesh.source.len(),
            mesh.triangles.len()
        ));
    }
    if vertex_count.max(mesh.triangles.len()) >= (u32::MAX / 3) as usize {
        return invalid("more vertices or triangles than 32-bit numbers can name".into());
    }
    if let Some(v) = mesh.positions.iter().position(|p| !p.iter().all(|x| x.is_finite())) {
        return invalid(format!("vertex {v} is at {:?}", mesh.positions[v]));
    }
    for (t, &[a, b, c]) in mesh.triangles.iter().enumerate() {
        if a.max(b).max(c) as usize >= vertex_count {
            return invalid(format!(
                "triangle {t} names a vertex beyond the {vertex_count} there are"
            ));
        }
        if repeats(&[a, b, c]) {
            return invalid(format!("triangle {t} has a vertex twice"));
        }
    }
    Ok(())
}

fn check_vertices(mesh: &Mesh, edges: &EdgeTable) -> Result<(), MeshError> {
    const NONE: u32 = u32::MAX;
    let mut first_fan = vec![NONE; mesh.positions.len()];
    let mut crowded = Vec::new();
    for (corner, fan) in fans(&mesh.triangles, edges).into_iter().enumerate() {
        let vertex = mesh.triangles[corner / 3][corner % 3];
        let first = &mut first_fan[vertex as usize];
        if *first == NONE {
            *first = fan;
        } else if *first != fan {
            crowded.push(vertex);
        }
    }
    crowded.sort_unstable();
    crowded.dedup();
    if crowded.is_empty() {
        return Ok(());
    }
    let places = crowded.iter().take(PLACES_KEPT).map(|&v| mesh.positions[v as usize]).collect();
    Err(MeshError::NonManifoldVertices { count: crowded.len(), places })
}

fn places(mesh: &Mesh, half_edges: impl Iterator<Item = u32>) -> Vec<EdgePlace> {
    half_edges
        .take(PLACES_KEPT)
        .map(|h| {
            let [from, to] = ends(&mesh.triangles, h).map(|v| mesh.positions[v as usize]);
            EdgePlace { triangle: mesh.source[h as usize / 3], from, to }
        })
        .collect()
}
