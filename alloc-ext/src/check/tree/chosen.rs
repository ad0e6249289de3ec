//! Which triangles a box tree must hold, from the file's triangles and what repair made of them.

use super::parse::TreeBlob;
use crate::check::enclosure::area_free;
use crate::check::input::is_closed;
use crate::mesh::{Filed, Mesh, Wire};
use std::borrow::Cow;
use std::collections::{HashMap, HashSet};

/// The triangles of a box tree.
pub(super) struct Chosen<'a> {
    /// In the file's winding.
    pub(super) mesh: Cow<'a, Mesh>,
    /// Whether they run through every edge as often in one direction as in the other, turned ones
    /// against their winding.
    pub(super) closed: bool,
    /// The same triangles in the winding that tells sides, if some are turned for that.
    pub(super) turned: Option<&'a Mesh>,
    /// Whether they are those whose nearest one may tell sides.
    pub(super) has_sides: bool,
}

impl<'a> Chosen<'a> {
    pub(super) fn of(tree: &TreeBlob, mesh: &'a Mesh) -> Self {
        let closed = is_closed(mesh) && !mesh.has_merged_walls;
        let as_it_is = Self { mesh: Cow::Borrowed(mesh), closed, turned: None, has_sides: closed };
        let Some(filed) = &mesh.filed else { return as_it_is };
        let has_moments = !tree.moments.is_empty();
        let takes_all = has_moments && !(closed && is_turned_only(mesh, filed));
        if takes_all {
            let mesh = all(filed);
            return Self { closed: is_closed(&mesh), ..Self::without_sides(mesh) };
        }
        if !closed {
            let both_windings = !tree.slabs.is_empty() || !tree.cones.is_empty();
            return Self::without_sides(distinct(filed, mesh, both_windings));
        }
        let mut wound = mesh.clone();
        for (triangle, _) in wound.triangles.iter_mut().zip(&mesh.turned).filter(|(_, is)| **is) {
            *triangle = [triangle[0], triangle[2], triangle[1]];
        }
        let turned = mesh.turned.contains(&true).then_some(mesh);
        Self { mesh: Cow::Owned(wound), turned, ..as_it_is }
    }

    fn without_sides(mesh: Mesh) -> Self {
        Self { mesh: Cow::Owned(mesh), closed: false, turned: None, has_sides: false }
    }
}

/// Whether repair did no more than turn triangles.
fn is_turned_only(mesh: &Mesh, filed: &Filed) -> bool {
    let of_file: HashSet<[u32; 3]> =
        filed.positions.iter().map(|at| at.map(f32::to_bits)).collect();
    let has_each = (0..filed.triangles.len()).all(|t| mesh.source.get(t) == Some(&(t as u32)));
    let has_no_other = mesh.all_triangles().count() == filed.triangles.len();
    has_each && has_no_other && of_file.len() == filed.positions.len()
}

/// All triangles of the file. Those with a repeated vertex are the segment of its other two.
fn all(filed: &Filed) -> Mesh {
    let mut mesh = Mesh { positions: filed.positions.clone(), ..Mesh::default() };
    for (number, &corners) in (0..).zip(&filed.triangles) {
        let mut distinct = corners.to_vec();
        distinct.dedup();
        if distinct.len() > 1 && distinct.first() == distinct.last() {
            distinct.pop();
        }
        match distinct[..] {
            [_, _, _] => {
                mesh.triangles.push(corners);
                mesh.source.push(number);
            }
            [a, .., b] => mesh.wires.push(Wire { ends: [a, b], source: number }),
            _ => mesh.wires.push(Wire { ends: [corners[0]; 2], source: number }),
        }
    }
    mesh
}

/// The first of the file's triangles with an area on each three places, or on each three places in
/// each winding, and the segments and points that none of the mesh's triangles covers.
fn distinct(filed: &Filed, mesh: &Mesh, both_windings: bool) -> Mesh {
    let mut out = Mesh { positions: filed.positions.clone(), ..Mesh::default() };
    let mut places: HashMap<[u32; 3], u32> = HashMap::new();
    for (vertex, at) in (0..).zip(&filed.positions) {
        places.entry(at.map(f32::to_bits)).or_insert(vertex);
    }
    let mut seen = HashSet::new();
    for (number, &corners) in (0..).zip(&filed.triangles) {
        let at = corners.map(|v| filed.positions[v as usize]);
        let [a, b, c] = at.map(|p| places[&p.map(f32::to_bits)]);
        let mut turns = [[a, b, c], [b, c, a], [c, a, b], [c, b, a], [b, a, c], [a, c, b]];
        let alike = if both_windings { &mut turns[..3] } else { &mut turns[..] };
        alike.sort_unstable();
        if !area_free(&at.map(|p| p.map(f64::from))) && seen.insert(alike[0]) {
            out.triangles.push([a, b, c]);
            out.source.push(number);
        }
    }
    for wire in &mesh.wires {
        let ends = wire.ends.map(|v| {
            let at = mesh.positions[v as usize];
            *places.entry(at.map(f32::to_bits)).or_insert_with(|| {
                out.positions.push(at);
                out.positions.len() as u32 - 1
            })
        });
        out.wires.push(Wire { ends, ..*wire });
    }
    out
}
