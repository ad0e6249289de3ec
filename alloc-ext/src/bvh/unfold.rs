//! Other points of the grid for vertices whose faces cross where rounding put them.
//!
//! A wall or a gap thinner than a step may be rounded so that its faces change places, and a sliver
//! so that it folds over its neighbour. A step or two to the side they do not. The search begins
//! with all pairs of faces that cross, and has two means:
//! - *Push.* Where the input has a pair on two sides of the plane of one of them, their vertices
//!   are rounded from places pushed apart along its normal, farther from round to round. So both
//!   sheets of a wall move as a whole.
//! - *Try.* One vertex at a time moves to the grid point nearest to its place where fewer faces
//!   around it cross others.
//!
//! It ends when no faces cross, or when nothing helps. Then the sides are [proved
//! again](super::sides), and the points are taken if clearly more triangles tell sides.

use super::sides::{Sided, Sides};
use super::store::OnGrid;
use crate::geom::{Bounds, Face, StaticTree, crosses, faces, side};
use crate::mesh::{Input, Mesh};
use crate::surface::most_crossings;
use glam::{DVec3, IVec3};
use rustc_hash::FxHashMap;

/// Steps of the grid along an axis from where rounding put a vertex, at most.
const REACH: i32 = 2;

/// Distances by which both faces of a pair are pushed, in steps, round by round.
const PUSHES: [f64; 4] = [0.5, 0.75, 1.0, 1.25];

/// Rounds in which all vertices concerned try other points, at most.
const TRIES: usize = 8;

/// Pairs of faces that are tested against each other while points are tried, at most: about a tenth
/// of a second.
const MOST_TESTS: usize = 1_000_000;

/// Pairs that cross in the input too, from which on nothing is tried if they are most: the surface
/// crosses itself, by more than rounding.
const MOST_FILED: usize = 256;

/// The grid with some vertices on other points of it, where at most half as many triangles tell no
/// side, and the sides there. `None` if none were found.
///
/// Cost: a static tree of the faces, and some queries of it for each face that crosses
/// another; a vertex of theirs tries at most 124 points.
pub(super) fn unfold(
    input: Input<'_>,
    sided: &Sided<'_>,
    grid: &OnGrid,
    sides: &Sides,
) -> Option<(OnGrid, Sides)> {
    let mut pairs = sides.crossings.clone();
    if pairs.len() >= most_crossings(sided.mesh.triangles.len()) {
        // The grid is too coarse for the surface, or the surface crosses itself.
        return None;
    }
    let mut search = Search::new(grid, sided.mesh);
    let filed = pairs.iter().filter(|pair| search.crosses_in_input(pair)).count();
    if filed > MOST_FILED && 2 * filed > pairs.len() {
        return None;
    }
    for distance in PUSHES {
        pairs = search.push(pairs, distance);
    }
    for _ in 0..TRIES {
        let before = pairs.len();
        pairs = search.try_points(pairs);
        if pairs.len() >= before || search.tests >= MOST_TESTS {
            break;
        }
    }
    if pairs.len() >= sides.crossings.len() {
        return None;
    }
    let unfolded = grid.with_positions(input, search.positions);
    let after = sided.sides(&unfolded);
    (2 * after.count_sideless() <= sides.count_sideless()).then_some((unfolded, after))
}

struct Search<'a> {
    faces: Vec<Face>,
    positions: Vec<DVec3>,
    /// Where rounding put the vertices.
    rounded: &'a [DVec3],
    /// Their places before.
    places: Vec<DVec3>,
    /// Directions in which pairs push the vertices.
    pushes: FxHashMap<u32, DVec3>,
    low: DVec3,
    /// The faces at each vertex, from `starts`.
    starts: Vec<u32>,
    around: Vec<u32>,
    /// Of boxes that hold their faces wherever vertices move.
    tree: StaticTree,
    /// Pairs of faces that were tested while points were tried.
    tests: usize,
}

impl<'a> Search<'a> {
    fn new(grid: &'a OnGrid, mesh: &Mesh) -> Self {
        let (rounded, triangles) = (&grid.positions, &mesh.triangles);
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
            positions: rounded.clone(),
            rounded,
            places: grid.places(mesh),
            pushes: FxHashMap::default(),
            low: DVec3::from(grid.origin.map(f64::from)),
            tree: StaticTree::new(&boxes),
            faces,
            starts,
            around,
            tests: 0,
        }
    }

    fn crosses_in_input(&self, pair: &[u32; 2]) -> bool {
        let [f, g] = pair.map(|face| {
            let ids = self.faces[face as usize].ids;
            Face { ids, at: ids.map(|v| self.places[v as usize]) }
        });
        crosses(&f, &g)
    }

    /// Pushes the faces of pairs apart, and rounds their vertices again. Returns the pairs that
    /// cross then.
    fn push(&mut self, pairs: Vec<[u32; 2]>, distance: f64) -> Vec<[u32; 2]> {
        for [f, g] in &pairs {
            let (f, g) = (self.faces[*f as usize].ids, self.faces[*g as usize].ids);
            if f.iter().any(|v| g.contains(v)) {
                continue;
            }
            let Some(apart) = self.apart(f, g).or_else(|| self.apart(g, f).map(|d| -d)) else {
                continue;
            };
            f.iter().for_each(|&v| *self.pushes.entry(v).or_default() -= apart);
            g.iter().for_each(|&v| *self.pushes.entry(v).or_default() += apart);
        }
        let mut vertices: Vec<u32> = corners_of(&self.faces, &pairs);
        vertices.retain(|v| self.pushes.contains_key(v));
        let mut concerned: Vec<u32> = pairs.into_iter().flatten().collect();
        for v in vertices {
            let push = self.pushes[&v].normalize_or_zero() * distance;
            let rounded = self.rounded[v as usize];
            let steps = ((self.places[v as usize] + push).round() - rounded)
                .clamp(DVec3::splat(-f64::from(REACH)), DVec3::splat(f64::from(REACH)));
            if self.is_on_grid(rounded + steps) {
                self.place(v, rounded + steps);
                concerned.extend(self.star(v));
            }
        }
        self.crossings_of(concerned)
    }

    /// The unit normal of the face `f` in the input that points to its side on which the corners of
    /// `g` lie; `None` if they lie on both.
    fn apart(&self, f: [u32; 3], g: [u32; 3]) -> Option<DVec3> {
        let [f, g] = [f, g].map(|of| of.map(|v| self.places[v as usize]));
        let normal = (f[1] - f[0]).cross(f[2] - f[0]).normalize_or_zero();
        let heights = g.map(|p| side(&f, p));
        if heights.iter().all(|&height| height >= 0.0) {
            Some(normal)
        } else if heights.iter().all(|&height| height <= 0.0) {
            Some(-normal)
        } else {
            None
        }
    }

    /// Lets the vertices of pairs try other points. Returns the pairs that cross then.
    fn try_points(&mut self, pairs: Vec<[u32; 2]>) -> Vec<[u32; 2]> {
        let vertices = corners_of(&self.faces, &pairs);
        let mut concerned: Vec<u32> = pairs.into_iter().flatten().collect();
        for v in vertices {
            if self.tests >= MOST_TESTS {
                break;
            }
            if self.improve(v) {
                concerned.extend(self.star(v));
            }
        }
        self.crossings_of(concerned)
    }

    fn is_on_grid(&self, p: DVec3) -> bool {
        let stored = p - self.low;
        stored.min_element() >= 0.0 && stored.max_element() <= f64::from(u16::MAX)
    }

    fn place(&mut self, v: u32, at: DVec3) {
        self.positions[v as usize] = at;
        for i in self.starts[v as usize]..self.starts[v as usize + 1] {
            let face = &mut self.faces[self.around[i as usize] as usize];
            face.at = face.ids.map(|v| self.positions[v as usize]);
        }
    }

    fn star(&self, v: u32) -> &[u32] {
        let v = v as usize;
        &self.around[self.starts[v] as usize..self.starts[v + 1] as usize]
    }

    /// Crossings of the faces at a vertex, if it were at a point; at least `most` if there are so
    /// many.
    fn crossings_at(&mut self, v: u32, at: DVec3, most: usize) -> usize {
        let mut tests = 0;
        let moved = |face: u32| {
            let mut face = self.faces[face as usize];
            (0..3).filter(|&k| face.ids[k] == v).for_each(|k| face.at[k] = at);
            face
        };
        let mut count = 0;
        for &f in self.star(v) {
            let face = moved(f);
            self.visit_near(f, &face, |g| {
                let other = moved(g);
                // Pairs of two faces at the vertex are counted once.
                let is_first = !other.ids.contains(&v) || f < g;
                tests += 1;
                count += usize::from(is_first && crosses(&face, &other));
                count < most
            });
            if count >= most {
                break;
            }
        }
        self.tests += tests;
        count
    }

    /// Calls `visit` with the faces but `f` that may meet `face`, until it returns false.
    fn visit_near(&self, f: u32, face: &Face, mut visit: impl FnMut(u32) -> bool) {
        self.tree.visit_meeting(&Bounds::of(&face.at), |g| g as u32 == f || visit(g as u32));
    }

    /// Moves a vertex to the grid point nearest to its place of those where fewest faces around it
    /// cross others, if these are fewer than where it is. Whether it moved.
    fn improve(&mut self, v: u32) -> bool {
        let before = self.positions[v as usize];
        let (mut best, mut fewest) = (before, self.crossings_at(v, before, usize::MAX));
        if fewest == 0 {
            return false;
        }
        let (rounded, place) = (self.rounded[v as usize], self.places[v as usize]);
        let steps = -REACH..=REACH;
        let mut points: Vec<DVec3> = steps
            .clone()
            .flat_map(|x| steps.clone().map(move |y| (x, y)))
            .flat_map(|(x, y)| steps.clone().map(move |z| rounded + IVec3::new(x, y, z).as_dvec3()))
            .filter(|&p| self.is_on_grid(p))
            .collect();
        points.sort_by(|a, b| a.distance_squared(place).total_cmp(&b.distance_squared(place)));
        for at in points {
            let count = self.crossings_at(v, at, fewest);
            if count < fewest {
                (best, fewest) = (at, count);
                if count == 0 {
                    break;
                }
            }
        }
        self.place(v, best);
        best != before
    }

    /// The crossing pairs that have one of some faces.
    fn crossings_of(&self, mut some: Vec<u32>) -> Vec<[u32; 2]> {
        some.sort_unstable();
        some.dedup();
        let mut pairs = Vec::new();
        for f in some {
            let face = &self.faces[f as usize];
            self.visit_near(f, face, |g| {
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

/// The corners of all faces of pairs, ascending.
fn corners_of(faces: &[Face], pairs: &[[u32; 2]]) -> Vec<u32> {
    let mut corners: Vec<u32> =
        pairs.iter().flatten().flat_map(|&face| faces[face as usize].ids).collect();
    corners.sort_unstable();
    corners.dedup();
    corners
}
