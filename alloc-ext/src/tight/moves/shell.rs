//! The surface of a hull under edit: connectivity, positions, and boxes of its faces.

use super::star::StarFace;
use crate::collapse::Connectivity;
use crate::geom::{Bounds, Face, Triangle};
use crate::surface::{SignedVolume, compact};
use crate::tight::proof::outermost;
use glam::DVec3;

/// A closed manifold surface whose positions are `f32` numbers.
#[derive(Clone, Debug)]
pub(crate) struct Shell {
    pub mesh: Connectivity,
    at: Vec<DVec3>,
    boxes: FaceBoxes,
}

/// Boxes of the faces, one array per axis. A scan of thousands costs less than a tree that every
/// edit changes. `f32` holds the boxes exactly.
#[derive(Clone, Debug, Default)]
struct FaceBoxes {
    low: [Vec<f32>; 3],
    high: [Vec<f32>; 3],
}

/// Boxes that are compared at once.
const LANES: usize = 16;

impl FaceBoxes {
    fn set(&mut self, face: usize, bounds: Option<Bounds>) {
        let bounds = bounds.unwrap_or(Bounds::EMPTY);
        for axis in 0..3 {
            if self.low[axis].len() <= face {
                self.low[axis].resize(face + 1, f32::INFINITY);
                self.high[axis].resize(face + 1, f32::NEG_INFINITY);
            }
            self.low[axis][face] = bounds.low[axis] as f32;
            self.high[axis][face] = bounds.high[axis] as f32;
        }
    }

    fn visit(&self, bounds: &Bounds, mut visit: impl FnMut(u32) -> bool) -> bool {
        let (low, high) = (bounds.low.as_vec3(), bounds.high.as_vec3());
        let [lx, ly, lz] = &self.low;
        let [hx, hy, hz] = &self.high;
        let mut from = 0;
        while from < lx.len() {
            let to = (from + LANES).min(lx.len());
            let lanes = |of: &'_ [f32]| -> [f32; LANES] {
                let mut all = [f32::NAN; LANES];
                all[..to - from].copy_from_slice(&of[from..to]);
                all
            };
            let (lx, ly, lz) = (lanes(lx), lanes(ly), lanes(lz));
            let (hx, hy, hz) = (lanes(hx), lanes(hy), lanes(hz));
            let mut hits = [false; LANES];
            for k in 0..LANES {
                hits[k] = (lx[k] <= high.x)
                    & (ly[k] <= high.y)
                    & (lz[k] <= high.z)
                    & (hx[k] >= low.x)
                    & (hy[k] >= low.y)
                    & (hz[k] >= low.z);
            }
            if hits.iter().any(|&h| h) {
                for (k, _) in hits.iter().enumerate().filter(|(_, hit)| **hit) {
                    if !visit((from + k) as u32) {
                        return false;
                    }
                }
            }
            from = to;
        }
        true
    }
}

impl Shell {
    /// Of a closed manifold surface.
    pub fn new(at: Vec<DVec3>, triangles: &[[u32; 3]]) -> Self {
        let mesh = Connectivity::new(at.len(), triangles);
        let mut shell = Self { mesh, at, boxes: FaceBoxes::default() };
        (0..triangles.len() as u32).for_each(|f| shell.rebox(f));
        shell
    }

    pub fn face_count(&self) -> usize {
        self.mesh.alive_count()
    }

    /// Number of vertices, of which those without faces are gone.
    pub fn vertex_slots(&self) -> u32 {
        self.at.len() as u32
    }

    pub fn position(&self, v: u32) -> DVec3 {
        self.at[v as usize]
    }

    /// Numbers of the faces.
    pub fn alive(&self) -> impl Iterator<Item = u32> + '_ {
        (0..self.mesh.corners.len() as u32).filter(|&f| self.mesh.is_alive(f))
    }

    pub fn triangle(&self, f: u32) -> Triangle {
        self.mesh.corners[f as usize].map(|v| self.at[v as usize])
    }

    pub fn face(&self, f: u32) -> Face {
        Face { ids: self.mesh.corners[f as usize], at: self.triangle(f) }
    }

    /// Calls `visit` with every face whose box meets `bounds`, until it returns false; whether it
    /// never did.
    pub fn near(&self, bounds: &Bounds, visit: impl FnMut(u32) -> bool) -> bool {
        self.boxes.visit(bounds, visit)
    }

    fn rebox(&mut self, f: u32) {
        let bounds = self.mesh.is_alive(f).then(|| Bounds::of(&self.triangle(f)));
        self.boxes.set(f as usize, bounds);
    }

    fn rebox_at(&mut self, v: u32) {
        for i in 0..self.mesh.at(v).len() {
            self.rebox(self.mesh.at(v)[i]);
        }
    }

    /// The faces at a vertex, as a star of it.
    pub fn vertex_star(&self, v: u32, star: &mut Vec<StarFace>) {
        star.clear();
        star.extend(self.mesh.at(v).iter().map(|&f| self.star_face(f, [v, v])));
    }

    /// A face as one of the star of an edge, or of a vertex that is given twice.
    pub fn star_face(&self, f: u32, [a, b]: [u32; 2]) -> StarFace {
        let ids = self.mesh.corners[f as usize];
        let corners = self.triangle(f);
        let moving = ids.map(|v| v == a || v == b);
        let ring = match moving {
            [true, false, false] => Some([corners[1], corners[2]]),
            [false, true, false] => Some([corners[2], corners[0]]),
            [false, false, true] => Some([corners[0], corners[1]]),
            _ => None,
        };
        StarFace::new(corners, ring)
    }

    /// The face `f` after a collapse of `a` and `b` into `a` at `x`; `None` if it vanishes.
    pub fn face_after(&self, f: u32, [a, b]: [u32; 2], x: DVec3) -> Option<Face> {
        let Face { mut ids, mut at } = self.face(f);
        let mut moved = 0;
        for (id, p) in ids.iter_mut().zip(&mut at) {
            if *id == a || *id == b {
                (*id, *p) = (a, x);
                moved += 1;
            }
        }
        (moved < 2).then_some(Face { ids, at })
    }

    pub fn move_vertex(&mut self, v: u32, x: DVec3) {
        self.at[v as usize] = x;
        self.rebox_at(v);
    }

    /// Collapses an edge into `a`, at `x`.
    pub fn collapse(&mut self, a: u32, b: u32, x: DVec3) {
        let gone: Vec<u32> = self.mesh.at(b).to_vec();
        self.mesh.collapse(a, b);
        self.at[a as usize] = x;
        gone.into_iter().for_each(|f| self.rebox(f));
        self.rebox_at(a);
    }

    /// See [`Connectivity::flip`]; whether it was flipped.
    pub fn flip(&mut self, a: u32, b: u32) -> bool {
        let Some(wings) = self.mesh.flip(a, b) else { return false };
        wings.triangles.into_iter().for_each(|f| self.rebox(f));
        true
    }

    /// Splits an edge at `x`; the new vertex.
    pub fn split(&mut self, a: u32, b: u32, x: DVec3) -> Option<u32> {
        let v = self.mesh.split(a, b)?;
        self.at.push(x);
        self.rebox_at(v);
        Some(v)
    }

    /// Signed volume.
    pub fn volume(&self) -> f64 {
        SignedVolume::of(self.alive().map(|f| self.triangle(f))).value
    }

    /// Corners of the faces.
    fn corners(&self) -> impl Iterator<Item = [u32; 3]> + '_ {
        self.alive().map(|f| self.mesh.corners[f as usize])
    }

    /// The shell without the connected components that lie inside others, and their number; `None`
    /// if it has one component only. For a shell that does not meet itself.
    pub fn outermost(&self) -> Option<(Self, usize)> {
        let (kept, dropped) = outermost(&self.at, &self.corners().collect::<Vec<_>>())?;
        let (positions, triangles) = compact(&self.at, kept);
        Some((Self::new(positions, &triangles), dropped))
    }

    /// Gives up the places of faces and vertices that are gone.
    pub fn drop_dead(&mut self) {
        let (positions, triangles) = self.compact();
        *self = Self::new(positions, &triangles);
    }

    /// Positions and triangles without gaps, in the order of the faces.
    pub fn compact(&self) -> (Vec<DVec3>, Vec<[u32; 3]>) {
        compact(&self.at, self.corners())
    }
}
