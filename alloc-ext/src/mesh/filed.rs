//! The file's triangles as they are wound there, where repair made other ones of them.
//!
//! [`repair`](super::repair) winds, drops and flips triangles, so that a mesh may bound a solid. A
//! question is about the file's triangles all the same. Facings and winding numbers are those of
//! the triangles here.

use super::RawMesh;
use rustc_hash::FxHashMap;

/// The triangles of a file, all of them, in their order and winding.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Filed {
    /// Positions rounded to `f32`, without −0.0. Positions that differ in the file are different
    /// vertices, also if they are rounded to one place: a gap between them stays a gap.
    pub positions: Vec<[f32; 3]>,
    /// Three vertices for each triangle of the file. They may be one vertex twice, or at one place.
    pub triangles: Vec<[u32; 3]>,
}

impl Filed {
    /// The file's triangles. `rounded` are its positions in `f32`.
    pub(super) fn new(raw: &RawMesh, rounded: &[[f32; 3]]) -> Self {
        let mut numbers: FxHashMap<[u64; 3], u32> = FxHashMap::default();
        let mut positions = Vec::new();
        let number_of = |(at, &rounded): (&[f64; 3], &[f32; 3])| {
            // Both zeros are one place.
            *numbers.entry(at.map(|x| (x + 0.0).to_bits())).or_insert_with(|| {
                positions.push(rounded);
                positions.len() as u32 - 1
            })
        };
        let number: Vec<u32> = raw.positions.iter().zip(rounded).map(number_of).collect();
        let corners = |t: &[u32; 3]| t.map(|v| number[v as usize]);
        Self { positions, triangles: raw.triangles.iter().map(corners).collect() }
    }

    /// Corners of a triangle. Its number must be one of the file's.
    pub(crate) fn corners(&self, triangle: usize) -> [[f32; 3]; 3] {
        self.triangles[triangle].map(|v| self.positions[v as usize])
    }
}
