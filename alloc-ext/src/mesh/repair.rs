//! The stages of repair, in order. Each establishes one invariant of [`Mesh`].

use super::caps::remove_caps;
use super::duplicate::{drop_duplicates, retain};
use super::edges::EdgeTable;
use super::filed::Filed;
use super::outward::{ClosedComponent, Standing, closed_components};
use super::read::check;
use super::report::RepairReport;
use super::round::round;
use super::vertex_fans::{fans, split};
use super::weld::weld;
use super::winding::{Components, propagate};
use super::wire::{TakenOut, Wire, uncovered};
use super::{Mesh, MeshError, RawMesh};

/// A clean mesh of a raw one, and a report. The surface does not move beyond the rounding to `f32`.
///
/// The stages, in this order:
/// - round to `f32`, and weld equal positions;
/// - take out triangles with a repeated corner;
/// - drop duplicates; the first of each stays, also if their windings differ;
/// - remove zero-area triangles, by an edge flip where that keeps the mesh closed;
/// - keep [`Wire`]s: segments and points of removed triangles that no edge covers;
/// - split vertices in which several fans meet;
/// - wind each component consistently, as most of its triangles are;
/// - turn closed outermost components that are proved to be inside out, with all components inside
///   them ([`Mesh::turned`] remembers which triangles);
/// - drop unreferenced vertices.
///
/// Any triangle soup is accepted. Holes, non-manifold edges and one-sided components stay, for
/// [`require_closed_manifold`](super::require_closed_manifold) to refuse. A second repair changes
/// nothing but, perhaps, the order of the copies of split vertices.
///
/// Cost: linear in the triangles. If a closed component faces inwards, a search for the contacts of
/// all faces too, n log n.
///
/// # Errors
/// A coordinate that is not finite or beyond `f32`, a mesh wholly below `f32`'s normal range, an
/// index out of range, or no triangles.
pub fn repair(raw: RawMesh) -> Result<(Mesh, RepairReport), MeshError> {
    repair_moved(&raw, None)
}

/// The same of a mesh whose vertices were moved to other places, as to a grid.
pub(crate) fn repair_moved(
    raw: &RawMesh,
    places: Option<&[[f64; 3]]>,
) -> Result<(Mesh, RepairReport), MeshError> {
    check(raw)?;
    let (mut positions, rounding) = round(raw, places.unwrap_or(&raw.positions))?;
    let mut triangles = raw.triangles.clone();
    let mut report = RepairReport {
        vertices_read: positions.len(),
        triangles_read: triangles.len(),
        polygons: raw.polygons,
        left_out: raw.left_out.clone(),
        rounding,
        ..RepairReport::default()
    };
    let mut source: Vec<u32> = (0..triangles.len() as u32).collect();

    let first_at = weld(&positions, &mut report.welded);
    let mut differs_from_file = merges_places(raw, &first_at);
    let rounded = positions.clone();
    triangles.iter_mut().flatten().for_each(|v| *v = first_at[*v as usize]);
    let mut taken_out = take_out_repeated_corners(&positions, &mut triangles, &mut source);
    drop_duplicates(&positions, &mut triangles, &mut source, &mut report);
    remove_caps(&positions, &mut triangles, &mut source, &mut taken_out, &mut report);
    let mut wires = uncovered(&positions, &triangles, &taken_out, &mut report);

    differs_from_file |= triangles.len() < raw.triangles.len() || report.flipped_caps.count > 0;

    let edges = EdgeTable::new(positions.len(), &triangles);
    // Splitting moves no corner to another edge: half-edges keep their twins, and twins their
    // common vertices.
    let (fans, components) =
        rayon::join(|| fans(&triangles, &edges), || propagate(&triangles, &edges.twins()));
    let mut vertex_source: Vec<u32> = (0..positions.len() as u32).collect();
    for original in split(positions.len(), &mut triangles, &fans) {
        let at = positions[original as usize];
        report.split_vertices.vertex(original, at);
        positions.push(at);
        vertex_source.push(original);
    }
    let mut turned = wind(&positions, &mut triangles, &source, &components, &mut report);
    turn_outwards(&positions, &mut triangles, &mut turned, &source, &components, &mut report);
    if !turned.contains(&true) {
        turned = Vec::new();
    }
    differs_from_file |= !turned.is_empty();
    let kept = drop_unreferenced(&positions, &mut triangles, &mut wires, &first_at, &mut report);
    let positions: Vec<[f32; 3]> = kept.iter().map(|&v| positions[v as usize]).collect();
    let vertex_source = kept.iter().map(|&v| vertex_source[v as usize]).collect();

    report.component_count = components.kinds.len();
    report.vertices_kept = positions.len();
    report.triangles_kept = triangles.len();
    let has_merged_walls = report.opposite_duplicate.count > 0;
    let filed = differs_from_file.then(|| Box::new(Filed::new(raw, &rounded)));
    let mesh = Mesh {
        positions,
        triangles,
        source,
        vertex_source,
        wires,
        rounding,
        has_merged_walls,
        turned,
        filed,
    };
    Ok((mesh, report))
}

/// Whether vertices were welded that the file has at different places.
fn merges_places(raw: &RawMesh, first_at: &[u32]) -> bool {
    (raw.positions.iter().zip(first_at)).any(|(at, &first)| *at != raw.positions[first as usize])
}

fn take_out_repeated_corners(
    positions: &[[f32; 3]],
    triangles: &mut Vec<[u32; 3]>,
    source: &mut Vec<u32>,
) -> Vec<TakenOut> {
    let repeats = |&[a, b, c]: &[u32; 3]| a == b || b == c || c == a;
    let taken_out = triangles
        .iter()
        .zip(source.iter())
        .filter(|(triangle, _)| repeats(triangle))
        .map(|(&triangle, &number)| TakenOut {
            wire: Wire::of(positions, triangle, number),
            first: triangle[0],
            repeats_corner: true,
        })
        .collect();
    let keep: Vec<bool> = triangles.iter().map(|triangle| !repeats(triangle)).collect();
    retain(triangles, &keep);
    retain(source, &keep);
    taken_out
}

/// Winds components consistently. Returns which triangles are wound against the file.
fn wind(
    positions: &[[f32; 3]],
    triangles: &mut [[u32; 3]],
    source: &[u32],
    components: &Components,
    report: &mut RepairReport,
) -> Vec<bool> {
    for (t, triangle) in triangles.iter_mut().enumerate() {
        if components.rewind[t] {
            report.rewound.triangle(source[t], positions[triangle[0] as usize]);
            triangle.swap(1, 2);
        }
    }
    for half_edge in components.kinds.iter().filter_map(|kind| kind.conflict) {
        let t = half_edge as usize / 3;
        report
            .non_orientable
            .triangle(source[t], positions[triangles[t][half_edge as usize % 3] as usize]);
    }
    components.rewind.clone()
}

/// Turns components that are inside out, and flips what `turned` says of their triangles.
fn turn_outwards(
    positions: &[[f32; 3]],
    triangles: &mut [[u32; 3]],
    turned: &mut [bool],
    source: &[u32],
    components: &Components,
    report: &mut RepairReport,
) {
    let mut turn = vec![false; components.kinds.len()];
    for ClosedComponent { number, first, volume, standing } in
        closed_components(positions, triangles, components)
    {
        turn[number as usize] = standing.is_turned();
        let finding = match standing {
            Standing::InsideOut => &mut report.turned_components,
            Standing::Cavity => &mut report.cavities,
            // It faces outwards in a component that is inside out. Turned with it, it is a cavity.
            Standing::InInsideOut if !volume.is_negative() && !volume.is_zero() => {
                &mut report.cavities
            }
            Standing::Doubt { .. } => &mut report.doubtful,
            Standing::Kept | Standing::InInsideOut => continue,
        };
        let first = first as usize;
        finding.triangle(source[first], positions[triangles[first][0] as usize]);
    }
    for ((triangle, turned), &part) in triangles.iter_mut().zip(turned).zip(&components.part) {
        if turn[part as usize] {
            triangle.swap(1, 2);
            *turned = !*turned;
        }
    }
}

/// Vertices welded into another are counted as welded, not here. Those that only wires use go to
/// the end. Returns the vertices in their new order.
fn drop_unreferenced(
    positions: &[[f32; 3]],
    triangles: &mut [[u32; 3]],
    wires: &mut [Wire],
    first_at: &[u32],
    report: &mut RepairReport,
) -> Vec<u32> {
    let mut used = vec![false; positions.len()];
    triangles.iter().flatten().for_each(|&v| used[v as usize] = true);
    let mut of_wires: Vec<u32> =
        wires.iter().flat_map(|wire| wire.ends).filter(|&v| !used[v as usize]).collect();
    of_wires.sort_unstable();
    of_wires.dedup();
    for (v, &first) in first_at.iter().enumerate() {
        if !used[v] && first as usize == v && of_wires.binary_search(&(v as u32)).is_err() {
            report.unreferenced.vertex(v as u32, positions[v]);
        }
    }
    let mut next = 0;
    let mut renumbered: Vec<u32> = used
        .iter()
        .map(|&used| {
            let number = next;
            next += u32::from(used);
            number
        })
        .collect();
    for &v in &of_wires {
        renumbered[v as usize] = next;
        next += 1;
    }
    wires.iter_mut().flat_map(|wire| &mut wire.ends).for_each(|v| *v = renumbered[*v as usize]);
    triangles.iter_mut().flatten().for_each(|v| *v = renumbered[*v as usize]);
    let of_triangles = (0..positions.len() as u32).filter(|&v| used[v as usize]);
    of_triangles.chain(of_wires).collect()
}
