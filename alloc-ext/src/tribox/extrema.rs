//! Local extrema of a mesh along the nine directions, as candidates for planes (Crosnier &
//! Rossignac 1999, section 4). Where a part ends or has a step, a plane just beyond its last
//! vertices cuts it off. A plane through them would leave the face there to both sides.

use super::span::projections;
use crate::mesh::Mesh;
use meshsweep_core::Tribox;
use meshsweep_core::internal::tribox::SLABS;

/// Most extrema of a cell and a direction that are tried: evenly among all.
const MOST: usize = 16;

/// Vertices that are least, or greatest, among their neighbours along a direction.
#[derive(Clone, Debug)]
pub(super) struct Extrema {
    /// For each direction, what the vertices are along all by rising value along this one, and the
    /// step to a plane beyond: −1 for one that is least, 1 for one that is greatest.
    along: [Vec<([f64; SLABS], f64)>; SLABS],
}

impl Extrema {
    pub fn of(mesh: &Mesh) -> Self {
        let along: Vec<[f64; SLABS]> =
            mesh.positions.iter().map(|p| projections(p.map(f64::from))).collect();
        // Whether a vertex is least, and greatest, among its neighbours along each direction.
        let mut ends = vec![[[true; SLABS]; 2]; along.len()];
        for corners in &mesh.triangles {
            let pairs = [[0, 1], [1, 2], [2, 0], [1, 0], [2, 1], [0, 2]];
            for [a, b] in pairs.map(|pair| pair.map(|corner| corners[corner] as usize)) {
                for slab in 0..SLABS {
                    ends[a][0][slab] &= along[a][slab] <= along[b][slab];
                    ends[a][1][slab] &= along[a][slab] >= along[b][slab];
                }
            }
        }
        let of = |slab: usize| {
            let mut found = Vec::new();
            for (side, beyond) in [-1.0, 1.0].into_iter().enumerate() {
                let ends = along.iter().zip(&ends).filter(|(_, ends)| ends[side][slab]);
                found.extend(ends.map(|(along, _)| (*along, beyond)));
            }
            let key = |a: &([f64; SLABS], f64)| (a.0[slab], a.1);
            found.sort_by(|a, b| {
                let ((x, by), (y, other)) = (key(a), key(b));
                x.total_cmp(&y).then(by.total_cmp(&other))
            });
            found.dedup_by(|a, b| key(a) == key(b));
            found
        };
        Self { along: std::array::from_fn(of) }
    }

    /// Planes of a slab just beyond extrema in a tribox, on multiples of `unit`.
    pub fn planes(&self, tribox: &Tribox, slab: usize, unit: f64) -> Vec<f64> {
        let is_in = |(along, _): &&([f64; SLABS], f64)| {
            let slabs = tribox.slabs().zip(along);
            slabs.into_iter().all(|((low, high), &x)| f64::from(low) <= x && x <= f64::from(high))
        };
        let beyond = |(along, by): &([f64; SLABS], f64)| {
            let units = along[slab] / unit;
            (if *by > 0.0 { units.floor() + 1.0 } else { units.ceil() - 1.0 }) * unit
        };
        let all: Vec<f64> = self.along[slab].iter().filter(is_in).map(beyond).collect();
        let step = all.len().div_ceil(MOST).max(1);
        all.into_iter().step_by(step).collect()
    }
}
