//! Other points of the grid for vertices whose faces cross where rounding put them.
//!
//! A wall or a gap thinner than a step may be rounded so that its faces change places, and a sliver
//! so that it folds over its neighbour. A step or two to the side they do not. The search moves one
//! vertex at a time, to the grid point nearest to its place where fewer faces around it cross
//! others. It ends when none cross, or when a round over all vertices concerned moves none. Then
//! the surface is [proved as a whole](super::sides).

use super::sides::{Sided, Sides};
use super::store::OnGrid;
use crate::geom::{Bounds, Contact, Face, FaceTree, StaticTree, faces, is_degenerate};
use crate::mesh::Input;
use glam::{DVec3, IVec3};

/// Steps of the grid along an axis from where rounding put a vertex, at most.
const REACH: i32 = 2;

/// Times that all vertices concerned are visited, at most.
const ROUNDS: usize = 16;

/// Pairs of crossing faces from which on the grid is not tried: it is too coarse for the surface.
const MOST_CROSSINGS: usize = 4096;

/// The grid with some vertices on other points of it, where fewer triangles tell no side, and the
/// sides there. `None` if none were found.
///
/// Cost: a vertex concerned tries at most 124 points, each by queries of a static tree for the
/// faces around it.
pub(super) fn unfold(
    input: Input<'_>,
    sided: &Sided<'_>,
    grid: &OnGrid,
    sides: &Sides,
) -> Option<(OnGrid, Sides)> {
    let mesh = sided.mesh;
    let mut search = Search::new(&grid.positions, &mesh.triangles, grid);
    let places = grid.places(mesh);
    let crossing = FaceTree::new(&search.faces).contacts(MOST_CROSSINGS);
    let mut pairs: Vec<[u32; 2]> = crossing
        .into_iter()
        .filter(|(_, contact)| *contact == Contact::Crossing)
        .map(|(pair, _)| pair)
        .collect();
    if pairs.len() >= MOST_CROSSINGS {
        return None;
    }
    for _ in 0..ROUNDS {
        if pairs.is_empty() {
            break;
        }
        let mut vertices: Vec<u32> =
            pairs.iter().flatten().flat_map(|&face| mesh.triangles[face as usize]).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let mut concerned: Vec<u32> = pairs.into_iter().flatten().collect();
        let mut moves = false;
        for v in vertices {
            if search.improve(v, places[v as usize]) {
                concerned.extend(search.star(v));
                moves = true;
            }
        }
        concerned.sort_unstable();
        concerned.dedup();
        pairs = search.crossings_of(&concerned);
        if !moves {
            break;
        }
    }
    if search.positions == grid.positions {
        return None;
    }
    let unfolded = grid.with_positions(input, search.positions);
    let after = sided.sides(&unfolded);
    (after.count_sideless() < sides.count_sideless()).then_some((unfolded, after))
}

struct Search<'a> {
    triangles: &'a [[u32; 3]],
    faces: Vec<Face>,
    positions: Vec<DVec3>,
    rounded: &'a [DVec3],
    low: DVec3,
    /// The faces at each vertex, from `starts`.
    starts: Vec<u32>,
    around: Vec<u32>,
    /// Of boxes that hold their faces wherever vertices move.
    tree: StaticTree,
}

impl<'a> Search<'a> {
    fn new(rounded: &'a [DVec3], triangles: &'a [[u32; 3]], grid: &OnGrid) -> Self {
        let faces = faces(rounded, triangles);
        let reach = f64::from(REACH);
        let boxes: Vec<Bounds> =
            faces.iter().map(|face| Bounds::of(&face.at).grown(reach)).collect();
        let mut starts = vec![0u32; rounded.len() + 2];
        triangles.iter().flatten().for_each(|&v| starts[v as usize + 2] += 1);
        for v in 2..starts.len() {
            starts[v] += starts[v - 1];
        }
        let mut around = vec![0; 3 * triangles.len()];
        for (face, triangle) in (0u32..).zip(triangles) {
            for &v in triangle {
                let next = &mut starts[v as usize + 1];
                around[*next as usize] = face;
                *next += 1;
            }
        }
        Self {
            triangles,
            positions: rounded.to_vec(),
            rounded,
            low: DVec3::from(grid.origin.map(f64::from)),
            tree: StaticTree::new(&boxes),
            faces,
            starts,
            around,
        }
    }

    fn star(&self, v: u32) -> &[u32] {
        let v = v as usize;
        &self.around[self.starts[v] as usize..self.starts[v + 1] as usize]
    }

    /// Crossings of the faces at a vertex, if it were at a point; at least `most` if there are so
    /// many.
    fn crossings_at(&self, v: u32, at: DVec3, most: usize) -> usize {
        let moved = |face: u32| {
            let mut face = self.faces[face as usize];
            (0..3).filter(|&k| face.ids[k] == v).for_each(|k| face.at[k] = at);
            face
        };
        let mut count = 0;
        for &f in self.star(v) {
            let face = moved(f);
            self.visit_crossing(f, &face, |g| {
                let other = moved(g);
                // Pairs of two faces at the vertex are counted once.
                let is_first = !other.ids.contains(&v) || f < g;
                count += usize::from(is_first && crosses(&face, &other));
                count < most
            });
            if count >= most {
                break;
            }
        }
        count
    }

    /// Calls `visit` with the faces but `f` that may meet `face`, until it returns false.
    fn visit_crossing(&self, f: u32, face: &Face, mut visit: impl FnMut(u32) -> bool) {
        self.tree.visit_meeting(&Bounds::of(&face.at), |g| g as u32 == f || visit(g as u32));
    }

    /// Moves a vertex to the grid point nearest to its place of those where fewest faces around it
    /// cross others, if these are fewer than where it is. Whether it moved.
    fn improve(&mut self, v: u32, place: DVec3) -> bool {
        let mut best = self.positions[v as usize];
        let mut fewest = self.crossings_at(v, best, usize::MAX);
        if fewest == 0 {
            return false;
        }
        let before = best;
        let rounded = self.rounded[v as usize];
        let steps = -REACH..=REACH;
        let mut points: Vec<DVec3> = steps
            .clone()
            .flat_map(|x| steps.clone().map(move |y| (x, y)))
            .flat_map(|(x, y)| steps.clone().map(move |z| rounded + IVec3::new(x, y, z).as_dvec3()))
            .filter(|p| {
                let stored = *p - self.low;
                stored.min_element() >= 0.0 && stored.max_element() <= f64::from(u16::MAX)
            })
            .collect();
        points.sort_by(|a, b| {
            (*a - place).length_squared().total_cmp(&(*b - place).length_squared())
        });
        for at in points {
            let count = self.crossings_at(v, at, fewest);
            if count < fewest {
                (best, fewest) = (at, count);
                if count == 0 {
                    break;
                }
            }
        }
        self.positions[v as usize] = best;
        for i in self.starts[v as usize]..self.starts[v as usize + 1] {
            let face = &mut self.faces[self.around[i as usize] as usize];
            face.at = face.ids.map(|v| self.positions[v as usize]);
        }
        best != before
    }

    /// The crossing pairs that have one of some faces.
    fn crossings_of(&self, some: &[u32]) -> Vec<[u32; 2]> {
        let mut pairs = Vec::new();
        for &f in some {
            let face = &self.faces[f as usize];
            self.visit_crossing(f, face, |g| {
                if crosses(face, &self.faces[g as usize]) {
                    pairs.push([f.min(g), f.max(g)]);
                }
                true
            });
        }
        pairs.sort_unstable();
        pairs.dedup();
        pairs
    }
}

fn crosses(f: &Face, g: &Face) -> bool {
    Bounds::of(&f.at).meets(&Bounds::of(&g.at))
        && !is_degenerate(&f.at)
        && !is_degenerate(&g.at)
        && Contact::of(f, g) == Contact::Crossing
}
