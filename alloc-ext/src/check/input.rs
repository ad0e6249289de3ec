//! The mesh that a blob is proved of, and whether stored corners are those of its triangles.

use super::dyadic::Dyadic;
use crate::mesh::{Input, Mesh};

/// A stored triangle: its number in the input file, and corners in the local frame.
pub(crate) type Stored = (u32, [[f64; 3]; 3]);

/// A mesh in a blob's local frame, and how near its vertices a blob's must be.
pub(crate) struct Given<'a> {
    pub(crate) mesh: &'a Mesh,
    /// Local coordinate = input coordinate times this.
    pub(crate) scale: f64,
    /// What vertices moved before the blob was built, local frame.
    moved: Vec<f64>,
}

/// Whether triangles run through every edge as often in one direction as in the other.
pub(crate) fn is_closed(mesh: &Mesh) -> bool {
    let mut edges: Vec<(u32, u32, i32)> = Vec::with_capacity(3 * mesh.triangles.len());
    for corners in &mesh.triangles {
        for k in 0..3 {
            let (from, to) = (corners[k], corners[(k + 1) % 3]);
            edges.push((from.min(to), from.max(to), if from < to { 1 } else { -1 }));
        }
    }
    edges.sort_unstable();
    let balanced = |edge: &[(u32, u32, i32)]| edge.iter().map(|(_, _, way)| way).sum::<i32>() == 0;
    !edges.is_empty() && edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)).all(balanced)
}

/// How often `f64` could not tell whether a corner is near.
pub(crate) type ByIntegers = usize;

impl<'a> Given<'a> {
    /// `scale_exponent` is that of the blob's header.
    pub(crate) fn new(input: Input<'a>, scale_exponent: i32) -> Self {
        Self::of(input.mesh, [input.mesh.rounding, input.moved], scale_exponent)
    }

    /// A mesh whose vertices were moved by no more than the sum of `moved`, input units.
    pub(crate) fn of(mesh: &'a Mesh, moved: [f64; 2], scale_exponent: i32) -> Self {
        let scale = 2f64.powi(-scale_exponent);
        Self { mesh, scale, moved: moved.map(|moved| moved * scale).to_vec() }
    }

    /// Place of a vertex, local frame: exact.
    pub(crate) fn place(&self, vertex: u32) -> [f64; 3] {
        self.mesh.positions[vertex as usize].map(|x| f64::from(x) * self.scale)
    }

    /// Upper bound of the distance that any vertex moved before.
    pub(crate) fn moved(&self) -> f64 {
        let moved: f64 = self.moved.iter().sum();
        if moved > 0.0 { moved.next_up() } else { 0.0 }
    }

    /// The mesh's triangles in the order of `stored`, each from the corner with which the stored
    /// one begins. Each is found by its number and by its corners within `error` of the input's,
    /// beginning with any of them, in the input's winding or in any. Where the error does not tell
    /// corners apart, each is the nearest. A repaired mesh may have
    /// triangles that share a number. Their corners tell them apart.
    ///
    /// # Errors
    /// A stored triangle is none of the mesh, or one of the mesh is missing.
    pub(crate) fn find(
        &self,
        wanted: impl Iterator<Item = ([u32; 3], u32)>,
        stored: impl Iterator<Item = Stored>,
        error: f64,
        any_winding: bool,
    ) -> Result<(Vec<[u32; 3]>, ByIntegers), String> {
        let mut wanted: Vec<(u32, [u32; 3], bool)> =
            wanted.map(|(corners, number)| (number, corners, false)).collect();
        wanted.sort_unstable();
        let (mut found, mut exact) = (Vec::new(), 0);
        for (number, corners) in stored {
            let from = wanted.partition_point(|&(source, ..)| source < number);
            let candidates = wanted[from..].iter_mut().take_while(|(source, ..)| *source == number);
            let mut free = candidates.filter(|(.., used)| !used);
            let near = |at: [u32; 3], exact: &mut usize| {
                let turns = (0..3).map(|turn| [0, 1, 2].map(|k| at[(k + turn) % 3]));
                let mut near = turns
                    .filter(|at| (0..3).all(|k| self.is_near(corners[k], at[k], error, exact)));
                let first = near.next()?;
                let away = |at: &[u32; 3]| (0..3).map(|k| self.square(corners[k], at[k])).sum();
                let (mut best, mut least): ([u32; 3], f64) = (first, away(&first));
                for at in near {
                    let here = away(&at);
                    if here < least {
                        (best, least) = (at, here);
                    }
                }
                Some(best)
            };
            let turned = |[a, b, c]: [u32; 3]| [a, c, b];
            let slot = free.find_map(|slot| {
                let at = slot.1;
                let as_it_is = near(at, &mut exact);
                let at = match as_it_is {
                    None if any_winding => near(turned(at), &mut exact),
                    found => found,
                }?;
                slot.2 = true;
                Some(at)
            });
            let what = || {
                format!(
                    "the triangle stored as {number}, at {:?} of the local frame, is not the \
                     input's within {error:e}",
                    corners[0]
                )
            };
            found.push(slot.ok_or_else(what)?);
        }
        match wanted.iter().find(|(.., used)| !used) {
            Some((number, ..)) => Err(format!("triangle {number} of the mesh is not stored")),
            None => Ok((found, exact)),
        }
    }

    /// The squared distance of a stored place from the input's vertex.
    fn square(&self, stored: [f64; 3], vertex: u32) -> f64 {
        let there = self.place(vertex);
        (0..3).map(|k| (stored[k] - there[k]) * (stored[k] - there[k])).sum()
    }

    /// Whether a stored place is within `error` of the input's vertex. All factors are powers of
    /// two, so only the difference and its square are rounded.
    fn is_near(&self, stored: [f64; 3], vertex: u32, error: f64, exact: &mut usize) -> bool {
        is_within(stored, self.place(vertex), [error, -self.moved[0], -self.moved[1]], exact)
    }
}

/// Whether two places are no farther apart than a sum.
pub(crate) fn is_within(
    stored: [f64; 3],
    there: [f64; 3],
    allowed: [f64; 3],
    exact: &mut usize,
) -> bool {
    let sum: f64 = allowed.iter().sum();
    let doubt = 4.0 * f64::EPSILON * allowed[0].abs();
    let square: f64 = (0..3).map(|k| (stored[k] - there[k]) * (stored[k] - there[k])).sum();
    let (least, most) = ((sum - doubt).max(0.0), (sum + doubt).max(0.0));
    if sum > doubt && square < least * least * (1.0 - 1e-14) {
        return true;
    }
    if square > most * most * (1.0 + 1e-14) && square > 1e-250 {
        return false;
    }
    *exact += 1;
    let allowed = allowed.into_iter().fold(Dyadic::from(0.0), |sum, x| &sum + &Dyadic::from(x));
    let square = (0..3).fold(Dyadic::from(0.0), |sum, k| {
        let way = &Dyadic::from(stored[k]) - &Dyadic::from(there[k]);
        &sum + &(&way * &way)
    });
    allowed.sign() >= 0 && square <= &allowed * &allowed
}
