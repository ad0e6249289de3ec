//! The triangles that a tree stores. They have the winding of the file, because facings and winding
//! numbers are questions about the file. Where repair turned triangles, a bit for each says so, and
//! sides are those of the turned ones.
//!
//! | repair | moments | the tree stores |
//! | --- | --- | --- |
//! | changed nothing | any | the mesh |
//! | only turned triangles, mesh closed | any | the mesh in the file's winding |
//! | anything else, mesh closed | no | the mesh in the file's winding |
//! | anything else | yes | all triangles of the file, copies too |
//! | anything else, mesh not closed | no | distinct triangles of the file, and wires |
//!
//! A mesh with merged walls does not count as closed.
//!
//! *Triangles without area in a tree with winding numbers* stay triangles if their vertices differ.
//! A grid may give them an area, and their edges close the surface of their neighbours. So sums and
//! boundaries of nodes are those of the file's surface with its vertices moved.

use crate::error::BuildError;
use crate::mesh::{Filed, Mesh, Wire, collinear};
use crate::surface::{EdgeTable, compact_in_order, ends, require_valid};
use rustc_hash::{FxHashMap, FxHashSet};
use std::borrow::Cow;

/// Which copies of the file's triangles a tree stores, where repair changed some.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Copies {
    /// All: each counts for winding numbers.
    All,
    /// One in each winding, for facings.
    EachWinding,
    /// One.
    First,
}

/// The triangles that a tree stores.
pub(super) struct StoredTriangles<'a> {
    /// Triangles and wires as stored, with their numbers in the file.
    pub(super) mesh: Cow<'a, Mesh>,
    /// The edges of its triangles.
    pub(super) edges: EdgeTable,
    /// Whether triangles run through every edge as often in one direction as in the other, turned
    /// ones against their winding.
    pub(super) is_closed: bool,
    /// The same triangles in the winding that tells inside from outside. `None`: none does.
    pub(super) sided: Option<&'a Mesh>,
    /// Per triangle whether `sided` has it turned; empty if none is.
    pub(super) turned: &'a [bool],
}

impl<'a> StoredTriangles<'a> {
    /// The triangles of a mesh for a tree, `most` of them and of wires at most.
    ///
    /// # Errors
    /// [`BuildError`] of a mesh that [`repair`](crate::mesh::repair) did not make.
    pub(super) fn of(mesh: &'a Mesh, copies: Copies, most: usize) -> Result<Self, BuildError> {
        require_valid(mesh, most)?;
        let Some(filed) = &mesh.filed else { return Ok(Self::of_repaired(mesh)) };
        let repaired = Self::of_repaired(mesh);
        if repaired.is_closed && (copies != Copies::All || has_all(mesh, filed)) {
            return Ok(repaired.wound_as_filed());
        }
        let all = of_file(filed, mesh.rounding);
        require_valid(&all, most)?;
        if copies == Copies::All {
            return Ok(Self::without_sides(with_repeats_as_wires(all)));
        }
        let stored = Self::without_sides(distinct(&all, mesh, copies == Copies::EachWinding));
        Ok(Self { is_closed: false, ..stored })
    }

    /// The mesh as it is.
    fn of_repaired(mesh: &'a Mesh) -> Self {
        let edges = EdgeTable::new(mesh.positions.len(), &mesh.triangles);
        let is_closed = !mesh.has_merged_walls && is_closed(&mesh.triangles, &edges);
        let sided = is_closed.then_some(mesh);
        Self { mesh: Cow::Borrowed(mesh), edges, is_closed, sided, turned: &[] }
    }

    /// The same triangles, each wound as in the file.
    fn wound_as_filed(self) -> Self {
        let Some(mesh) = self.sided else { return self };
        if !mesh.turned.contains(&true) {
            return self;
        }
        let mut stored = Mesh {
            positions: mesh.positions.clone(),
            triangles: mesh.triangles.clone(),
            source: mesh.source.clone(),
            wires: mesh.wires.clone(),
            rounding: mesh.rounding,
            ..Mesh::default()
        };
        for (triangle, &is_turned) in stored.triangles.iter_mut().zip(&mesh.turned) {
            if is_turned {
                triangle.swap(1, 2);
            }
        }
        let edges = EdgeTable::new(stored.positions.len(), &stored.triangles);
        Self { mesh: Cow::Owned(stored), edges, turned: &mesh.turned, ..self }
    }

    /// Triangles whose nearest one need not tell the side.
    fn without_sides(mesh: Mesh) -> Self {
        let edges = EdgeTable::new(mesh.positions.len(), &mesh.triangles);
        let is_closed = is_closed(&mesh.triangles, &edges);
        Self { mesh: Cow::Owned(mesh), edges, is_closed, sided: None, turned: &[] }
    }
}

/// Whether triangles run through every edge as often in one direction as in the other. Then the
/// surface bounds a volume. Wires bound none.
fn is_closed(triangles: &[[u32; 3]], edges: &EdgeTable) -> bool {
    if triangles.is_empty() {
        return false;
    }
    let is_up = |&&(_, half_edge): &&(u32, u32)| {
        let [from, to] = ends(triangles, half_edge);
        from < to
    };
    edges.edges().all(|edge| 2 * edge.iter().filter(is_up).count() == edge.len())
}

/// Whether a mesh has all triangles of its file, turned ones too, and no vertex stands for two
/// places of the file.
fn has_all(mesh: &Mesh, filed: &Filed) -> bool {
    let is_in_order = (0..).zip(&mesh.source).all(|(t, &number)| t == number);
    let mut places = FxHashSet::default();
    mesh.source.len() == filed.triangles.len()
        && is_in_order
        && mesh.wires.is_empty()
        && filed.positions.iter().all(|at| places.insert(at.map(f32::to_bits)))
}

/// All triangles of a file, as a mesh.
fn of_file(filed: &Filed, rounding: f64) -> Mesh {
    let mesh = Mesh::new(filed.positions.clone(), filed.triangles.clone());
    Mesh { rounding, ..mesh }
}

/// A valid mesh whose triangles with a repeated vertex are wires. They have no solid angle,
/// wherever their vertices are.
fn with_repeats_as_wires(mesh: Mesh) -> Mesh {
    let repeats = |&[a, b, c]: &[u32; 3]| a == b || b == c || c == a;
    let (mut stored, mut wires) = (Vec::new(), Vec::new());
    for (number, triangle) in (0..).zip(mesh.triangles) {
        if repeats(&triangle) {
            wires.push(Wire::of(&mesh.positions, triangle, number));
        } else {
            stored.push((number, triangle));
        }
    }
    of_parts(&mesh.positions, stored, wires, mesh.rounding)
}

/// Of a file's triangles those with an area, without copies of the same winding, and the wires of
/// the repaired mesh. A copy of the opposite winding is another triangle if `in_each_winding`.
fn distinct(filed: &Mesh, repaired: &Mesh, in_each_winding: bool) -> Mesh {
    let mut places = Places::default();
    let mut triangles = Vec::new();
    let mut seen = FxHashSet::default();
    for (number, triangle) in (0..).zip(&filed.triangles) {
        let [a, b, c] = triangle.map(|v| filed.positions[v as usize]);
        if collinear(a, b, c) {
            continue;
        }
        let triangle = [a, b, c].map(|at| places.number(at));
        let mut key = triangle;
        if in_each_winding {
            let least = (0..3).min_by_key(|&k| key[k]).unwrap_or(0);
            key.rotate_left(least);
        } else {
            key.sort_unstable();
        }
        if seen.insert(key) {
            triangles.push((number, triangle));
        }
    }
    let mut placed = |v: u32| places.number(repaired.positions[v as usize]);
    let wires =
        repaired.wires.iter().map(|wire| Wire { ends: wire.ends.map(&mut placed), ..*wire });
    let wires = wires.collect();
    of_parts(&places.positions, triangles, wires, filed.rounding)
}

/// Places, each of them once.
#[derive(Default)]
struct Places {
    numbers: FxHashMap<[u32; 3], u32>,
    positions: Vec<[f32; 3]>,
}

impl Places {
    fn number(&mut self, at: [f32; 3]) -> u32 {
        *self.numbers.entry(at.map(f32::to_bits)).or_insert_with(|| {
            self.positions.push(at);
            self.positions.len() as u32 - 1
        })
    }
}

/// A mesh of numbered triangles and wires, without vertices that none of them has.
fn of_parts(
    positions: &[[f32; 3]],
    numbered: Vec<(u32, [u32; 3])>,
    wires: Vec<Wire>,
    rounding: f64,
) -> Mesh {
    let (source, mut triangles): (Vec<u32>, Vec<[u32; 3]>) = numbered.into_iter().unzip();
    let count = triangles.len();
    triangles.extend(wires.iter().map(Wire::triangle));
    let (positions, mut triangles) = compact_in_order(positions, triangles);
    let of_wires = triangles.split_off(count);
    let ends = |(wire, [a, b, _]): (Wire, [u32; 3])| Wire { ends: [a, b], ..wire };
    let wires = wires.into_iter().zip(of_wires).map(ends).collect();
    Mesh { positions, triangles, source, wires, rounding, ..Mesh::default() }
}
