//! Meshes from corner positions: equal positions become one vertex.

use std::collections::HashMap;

use super::Triangles;

/// Collects triangles by their corners' positions.
#[derive(Default)]
pub(super) struct Builder {
    positions: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
    vertex_at: HashMap<[u32; 3], u32>,
}

impl Builder {
    /// The vertex at exactly this position.
    pub(super) fn vertex(&mut self, at: [f32; 3]) -> u32 {
        // −0.0 + 0.0 is 0.0.
        let at = at.map(|x| x + 0.0);
        *self.vertex_at.entry(at.map(f32::to_bits)).or_insert_with(|| {
            self.positions.push(at);
            self.positions.len() as u32 - 1
        })
    }

    /// Adds a triangle, counter-clockwise as given.
    pub(super) fn triangle(&mut self, corners: [[f32; 3]; 3]) {
        let triangle = corners.map(|p| self.vertex(p));
        self.triangles.push(triangle);
    }

    /// Adds a triangle, wound so that its normal points along `outward`.
    pub(super) fn facing(&mut self, corners: [[f32; 3]; 3], outward: [f32; 3]) {
        let [a, b, c] = corners.map(|p| p.map(f64::from));
        let sub = |p: [f64; 3]| [p[0] - a[0], p[1] - a[1], p[2] - a[2]];
        let (u, v) = (sub(b), sub(c));
        let normal =
            [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        let along: f64 = normal.iter().zip(outward).map(|(n, o)| n * f64::from(o)).sum();
        let [a, b, c] = corners;
        self.triangle(if along < 0.0 { [a, c, b] } else { [a, b, c] });
    }

    /// Adds a quadrilateral given in order around, as two triangles facing `outward`.
    pub(super) fn quad(&mut self, [a, b, c, d]: [[f32; 3]; 4], outward: [f32; 3]) {
        self.facing([a, b, c], outward);
        self.facing([a, c, d], outward);
    }

    pub(super) fn finish(self) -> Triangles {
        (self.positions, self.triangles)
    }
}
