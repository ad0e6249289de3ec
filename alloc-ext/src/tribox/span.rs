//! Bounds along the nine directions in f64, and the polytope between them.

use meshsweep_core::Tribox;
use meshsweep_core::internal::tribox::{BoundaryOf, FACES, SLABS, Scalar, boundary};
use std::ops::{Add, Neg, Sub};

/// An f64 that a tribox's boundary can be computed in.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub(super) struct Wide(pub f64);

impl Add for Wide {
    type Output = Wide;

    fn add(self, other: Wide) -> Wide {
        Wide(self.0 + other.0)
    }
}

impl Sub for Wide {
    type Output = Wide;

    fn sub(self, other: Wide) -> Wide {
        Wide(self.0 - other.0)
    }
}

impl Neg for Wide {
    type Output = Wide;

    fn neg(self) -> Wide {
        Wide(-self.0)
    }
}

impl Scalar for Wide {
    const ZERO: Wide = Wide(0.0);

    fn half(self) -> Wide {
        Wide(0.5 * self.0)
    }
}

/// Parameters of a point along the directions, each sum rounded once.
#[inline(always)]
pub(super) fn projections([x, y, z]: [f64; 3]) -> [f64; SLABS] {
    [x, y, z, x + y, x - y, y + z, y - z, z + x, z - x]
}

/// Nine slabs in f64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Span {
    pub low: [f64; SLABS],
    pub high: [f64; SLABS],
}

impl Span {
    pub const EMPTY: Span = Span { low: [f64::INFINITY; SLABS], high: [f64::NEG_INFINITY; SLABS] };

    #[inline(always)]
    pub fn add(&mut self, along: &[f64; SLABS]) {
        for (low, x) in self.low.iter_mut().zip(along) {
            *low = if *x < *low { *x } else { *low };
        }
        for (high, x) in self.high.iter_mut().zip(along) {
            *high = if *x > *high { *x } else { *high };
        }
    }

    pub fn unite(&mut self, other: &Span) {
        self.low.iter_mut().zip(other.low).for_each(|(low, other)| *low = low.min(other));
        self.high.iter_mut().zip(other.high).for_each(|(high, other)| *high = high.max(other));
    }

    pub fn is_empty(&self) -> bool {
        self.low[0] > self.high[0]
    }

    pub fn holds(&self, along: &[f64; SLABS]) -> bool {
        let slabs = self.low.iter().zip(&self.high).zip(along);
        slabs.into_iter().all(|((low, high), x)| low <= x && x <= high)
    }

    /// The same slabs with every plane moved inward until it touches, up to 2^-49 of the greatest
    /// parameter.
    ///
    /// A tribox in f32 is tight up to f32's rounding; here its vertices are wanted to f64's. The
    /// steps are those of [`Tribox::tightened`].
    pub fn tight(tribox: &Tribox) -> Span {
        let mut span = Span { low: tribox.low.map(f64::from), high: tribox.high.map(f64::from) };
        // Number 2k is coordinate k, 2k + 1 its negative; entry [i][j] bounds number j less number
        // i.
        let mut most = [[f64::INFINITY; 6]; 6];
        for axis in 0..3 {
            most[2 * axis + 1][2 * axis] = 2.0 * span.high[axis];
            most[2 * axis][2 * axis + 1] = -2.0 * span.low[axis];
        }
        let diagonals = [(0, 2), (0, 3), (2, 4), (2, 5), (4, 0), (4, 1)];
        for (slab, (a, b)) in (3..SLABS).zip(diagonals) {
            for (i, j) in [(b ^ 1, a), (a ^ 1, b)] {
                most[i][j] = span.high[slab];
                most[j][i] = -span.low[slab];
            }
        }
        for via in 0..6 {
            for i in 0..6 {
                for j in 0..6 {
                    most[i][j] = most[i][j].min(most[i][via] + most[via][j]);
                }
            }
        }
        let paths = most;
        for (i, row) in most.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                *entry = entry.min(0.5 * (paths[i][i ^ 1] + paths[j ^ 1][j]));
            }
        }
        for axis in 0..3 {
            span.high[axis] = span.high[axis].min(0.5 * most[2 * axis + 1][2 * axis]);
            span.low[axis] = span.low[axis].max(-0.5 * most[2 * axis][2 * axis + 1]);
        }
        for (slab, (a, b)) in (3..SLABS).zip(diagonals) {
            span.high[slab] = span.high[slab].min(most[b ^ 1][a]);
            span.low[slab] = span.low[slab].max(-most[a][b ^ 1]);
        }
        span
    }

    /// Vertices and faces, if the slabs are tight: vertices within 2^-47 of the greatest parameter.
    pub fn boundary(&self) -> BoundaryOf<Wide> {
        boundary(&self.low.map(Wide), &self.high.map(Wide))
    }
}

/// Vertices and edges of a tight polytope; vertices may coincide.
pub(super) struct Frame {
    pub vertices: Vec<[f64; 3]>,
    pub edges: Vec<(usize, usize)>,
}

impl Frame {
    pub fn of(tribox: &Tribox) -> Frame {
        let boundary = Span::tight(tribox).boundary();
        let mut edges = Vec::with_capacity(48);
        for face in 0..FACES {
            let vertices = boundary.face(face);
            let next = vertices.iter().cycle().skip(1);
            // Every edge is run through once in each direction.
            edges.extend(
                vertices
                    .iter()
                    .zip(next)
                    .filter(|(i, j)| i < j)
                    .map(|(&i, &j)| (i as usize, j as usize)),
            );
        }
        Frame { vertices: boundary.vertices.iter().map(|v| v.map(|x| x.0)).collect(), edges }
    }
}
