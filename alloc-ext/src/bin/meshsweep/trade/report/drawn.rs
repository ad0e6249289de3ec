//! Triangles of about one size, as many as a browser turns at ease.
//!
//! Colour tells one number a triangle, so large triangles are split, and of very many some are
//! left out.

use glam::Vec3;
use meshsweep::mesh::Mesh;
use rustc_hash::{FxHashMap, FxHashSet};

/// Most triangles of a body.
const MOST: usize = 50_000;

/// Longest edge, as a part of the diagonal of the mesh, unless there are too many triangles then.
const LONGEST: f64 = 1.0 / 25.0;

/// A surface to draw.
pub struct Drawn {
    pub positions: Vec<[f32; 3]>,
    pub triangles: Vec<[u32; 3]>,
    /// Whether vertices were merged: the surface is not quite the one given.
    pub is_coarse: bool,
}

impl Drawn {
    /// A surface as it is drawn beside a mesh of this diagonal.
    pub fn of(mesh: &Mesh, diagonal: f64) -> Self {
        if mesh.triangles.len() > MOST {
            return merged(mesh, diagonal);
        }
        let mut longest = LONGEST * diagonal;
        loop {
            match split(mesh, longest) {
                Some(drawn) => return drawn,
                None => longest *= 1.5,
            }
        }
    }

    /// The middle of each triangle.
    pub fn middles(&self) -> Vec<[f32; 3]> {
        let at = |v: u32| Vec3::from(self.positions[v as usize]) / 3.0;
        let middle = |&[a, b, c]: &[u32; 3]| (at(a) + at(b) + at(c)).to_array();
        self.triangles.iter().map(middle).collect()
    }
}

/// Halves each edge that is longer than `longest`. Both triangles of an edge use the same middle,
/// so no gap opens. `None` if there are too many triangles then.
fn split(mesh: &Mesh, longest: f64) -> Option<Drawn> {
    let mut positions = mesh.positions.clone();
    let mut middles: FxHashMap<[u32; 2], u32> = FxHashMap::default();
    let (mut triangles, mut open) = (Vec::new(), mesh.triangles.clone());
    while let Some([a, b, c]) = open.pop() {
        let at = |v: u32| Vec3::from(positions[v as usize]).as_dvec3();
        let long = |[a, b, _]: [u32; 3]| at(a).distance(at(b));
        // The longest edge first: its ends, then the corner opposite.
        let turns = [[a, b, c], [b, c, a], [c, a, b]];
        let turned = turns.into_iter().max_by(|&s, &t| long(s).total_cmp(&long(t)))?;
        let [a, b, c] = turned;
        // An edge of one step of f32 has no middle.
        let middle = ((at(a) + at(b)) * 0.5).as_vec3().to_array();
        if long(turned) <= longest || middle == positions[a as usize] {
            triangles.push(turned);
        } else {
            let halfway = *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                positions.push(middle);
                positions.len() as u32 - 1
            });
            open.extend([[a, halfway, c], [halfway, b, c]]);
        }
        if triangles.len() + open.len() > MOST {
            return None;
        }
    }
    Some(Drawn { positions, triangles, is_coarse: false })
}

/// One vertex for all that lie in a cell of a grid; the cells get larger until the triangles that
/// are left are few enough.
fn merged(mesh: &Mesh, diagonal: f64) -> Drawn {
    let mut cells = (MOST as f64).sqrt() * 2.0;
    loop {
        let cell = |p: [f32; 3]| p.map(|x| (f64::from(x) * cells / diagonal).floor() as i64);
        let mut first: FxHashMap<[i64; 3], u32> = FxHashMap::default();
        let mut positions = Vec::new();
        let number: Vec<u32> = mesh
            .positions
            .iter()
            .map(|&p| {
                *first.entry(cell(p)).or_insert_with(|| {
                    positions.push(p);
                    positions.len() as u32 - 1
                })
            })
            .collect();
        let mut seen = FxHashSet::default();
        let triangles = mesh.triangles.iter().map(|t| t.map(|v| number[v as usize]));
        let triangles: Vec<[u32; 3]> = triangles
            .filter(|&[a, b, c]| {
                let mut corners = [a, b, c];
                corners.sort_unstable();
                a != b && b != c && c != a && seen.insert(corners)
            })
            .collect();
        if triangles.len() <= MOST {
            return Drawn { positions, triangles, is_coarse: true };
        }
        cells *= 0.9;
    }
}

#[cfg(test)]
mod tests {
    use super::{Drawn, MOST};
    use meshsweep::mesh::Mesh;

    #[test]
    fn a_triangle_is_split_without_gaps_and_keeps_its_area() {
        let corners = vec![[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0]];
        let drawn = Drawn::of(&Mesh::new(corners, vec![[0, 1, 2]]), 10.0);
        assert!(drawn.triangles.len() > 100 && !drawn.is_coarse);
        let at = |v: u32| glam::Vec3::from(drawn.positions[v as usize]);
        let area = |&[a, b, c]: &[u32; 3]| (at(b) - at(a)).cross(at(c) - at(a)).z / 2.0;
        assert!((drawn.triangles.iter().map(area).sum::<f32>() - 6.0).abs() < 1e-4);
        assert!(drawn.triangles.iter().all(|t| area(t) > 0.0));
        // Euler: vertices - edges + faces of a disc is 1.
        let edges: std::collections::HashSet<_> = drawn
            .triangles
            .iter()
            .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]].map(|[s, t]| [s.min(t), s.max(t)]))
            .collect();
        assert_eq!(drawn.positions.len() + drawn.triangles.len() - edges.len(), 1);
    }

    #[test]
    fn of_very_many_triangles_some_are_left_out() {
        let side = 200u32;
        let at = |v: u32| [(v % side) as f32, (v / side) as f32, 0.0];
        let quads = (0..(side - 1) * (side - 1)).map(|q| q / (side - 1) * side + q % (side - 1));
        let triangles = quads.flat_map(|q| [[q, q + 1, q + side], [q + 1, q + 1 + side, q + side]]);
        let mesh = Mesh::new((0..side * side).map(at).collect(), triangles.collect());
        let drawn = Drawn::of(&mesh, 281.0);
        assert!(drawn.is_coarse && (MOST / 4..=MOST).contains(&drawn.triangles.len()));
    }
}
