//! How often a closed surface winds around a point: signed crossings of a ray, in exact arithmetic.

use super::meeting::{misses, turn};
use super::surface::{Corners, Surface};
use crate::check::exact::side;

/// Faces by the strips of y that they reach into.
#[derive(Debug)]
pub struct Winding {
    faces: Vec<Corners>,
    low: f64,
    high: f64,
    strips: Vec<Vec<u32>>,
}

const STRIPS: usize = 256;

/// Axes that are left when one looks along x.
const YZ: [usize; 2] = [1, 2];

impl Winding {
    /// Of a closed surface.
    #[must_use]
    pub fn new(hull: &Surface) -> Self {
        let faces: Vec<Corners> = hull.triangles.iter().map(|&t| hull.corners(t)).collect();
        let ys = || faces.iter().flatten().map(|p| p[1]);
        let (low, high) =
            (ys().fold(f64::INFINITY, f64::min), ys().fold(f64::NEG_INFINITY, f64::max));
        let mut winding = Self { faces, low, high, strips: vec![Vec::new(); STRIPS] };
        for (number, face) in winding.faces.iter().enumerate() {
            let from = winding.strip(face.iter().map(|p| p[1]).fold(f64::INFINITY, f64::min));
            let to = winding.strip(face.iter().map(|p| p[1]).fold(f64::NEG_INFINITY, f64::max));
            winding.strips[from..=to].iter_mut().for_each(|strip| strip.push(number as u32));
        }
        winding
    }

    /// Rounding keeps the order, so a face is in the strip of every y that it reaches.
    fn strip(&self, y: f64) -> usize {
        ((((y - self.low) / (self.high - self.low)) * STRIPS as f64) as usize).min(STRIPS - 1)
    }

    /// The faces with area that a segment meets, ascending.
    pub(super) fn met_by(&self, [p, q]: [[f64; 3]; 2]) -> Vec<usize> {
        let (low, high) = (p[1].min(q[1]), p[1].max(q[1]));
        let beside = |face: &Corners| {
            (0..3).any(|k| {
                face.iter().all(|c| c[k] < p[k].min(q[k]))
                    || face.iter().all(|c| c[k] > p[k].max(q[k]))
            })
        };
        let mut met: Vec<usize> = self.strips[self.strip(low)..=self.strip(high)]
            .iter()
            .flatten()
            .map(|&number| number as usize)
            .filter(|&number| !beside(&self.faces[number]) && !misses(p, q, &self.faces[number]))
            .collect();
        met.sort_unstable();
        met.dedup();
        met
    }

    /// Crossings of the ray along +x from `p`, which is thought to be moved by an infinitesimal
    /// step along y and one infinitely smaller along z, so that it meets no edge: outwards
    /// count 1, inwards −1.
    ///
    /// # Errors
    /// The point is on a face.
    pub fn around(&self, p: [f64; 3]) -> Result<i64, String> {
        if !(self.low <= p[1] && p[1] <= self.high) {
            return Ok(0);
        }
        let mut turns = 0;
        for &number in &self.strips[self.strip(p[1])] {
            let face = self.faces[number as usize];
            if face.iter().all(|q| q[0] < p[0]) || face.iter().all(|q| q[2] < p[2]) {
                continue;
            }
            let above = (0..3).filter(|&i| passes_above(face[i], face[(i + 1) % 3], p)).count();
            if above % 2 == 0 {
                continue;
            }
            let outwards = turn(YZ, face[0], face[1], face[2]);
            match side(face, p).0 {
                0 => return Err(format!("{p:?} is on face {number} of the hull")),
                front if front == -outwards => turns += i64::from(outwards),
                _ => {}
            }
        }
        Ok(turns)
    }
}

/// Whether an edge, seen along x, crosses the parallel to z through the moved `p` above it.
fn passes_above(u: [f64; 3], v: [f64; 3], p: [f64; 3]) -> bool {
    let (right, left) = match (u[1] > p[1], v[1] > p[1]) {
        (true, false) => (u, v),
        (false, true) => (v, u),
        _ => return false,
    };
    // Left to right, a point below the edge makes a turn to the right.
    match turn(YZ, left, right, p) {
        0 if left[2] == right[2] => false,
        // Moved along +y: below a rising edge.
        0 => right[2] > left[2],
        turn => turn < 0,
    }
}
