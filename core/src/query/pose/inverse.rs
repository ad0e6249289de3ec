//! The inverse of a pose's matrix, nearly a rotation.

use crate::geom::{dot, transposed};
use crate::num::tolerance::{POSE_DEFECT, POSED_STRETCH, U64};
use crate::query::error::QueryError;

type Row = [f64; 3];

/// A pose's matrix, nearly a rotation, and its approximate inverse. Derivation:
/// `core/docs/rounding.md` §15.
pub(crate) struct PoseInverse {
    rows: [Row; 3],
    columns: [Row; 3],
    /// The matrix changes lengths by a factor within `1 ± stretch`.
    pub(crate) stretch: f64,
}

impl PoseInverse {
    /// [`QueryError::PoseOutOfDomain`] if the columns are far from orthonormal.
    pub(crate) fn new(rows: [Row; 3]) -> Result<PoseInverse, QueryError> {
        let columns = transposed(&rows);
        let stretch = defect(&columns) + POSED_STRETCH * U64;
        if stretch.is_nan() || stretch > POSE_DEFECT {
            return Err(QueryError::PoseOutOfDomain);
        }
        Ok(PoseInverse { rows, columns, stretch })
    }

    /// The vector that the matrix takes nearly to `v`. Callers bound the residual.
    pub(crate) fn apply(&self, [vx, vy, vz]: Row) -> Row {
        let mut at = [0.0; 3];
        // The transposed matrix is nearly the inverse. The second step removes most of the error.
        for _ in 0..2 {
            let [a, b, c] = self.rows.map(|row| dot(row, at));
            let left = [vx - a, vy - b, vz - c];
            let [a, b, c] = self.columns.map(|column| dot(column, left));
            let [x, y, z] = at;
            at = [x + a, y + b, z + c];
        }
        at
    }
}

/// How far the columns are from orthonormal: the Frobenius norm of `RᵀR − 1`.
fn defect(columns: &[Row; 3]) -> f64 {
    let &[a, b, c] = columns;
    let lengths = [dot(a, a) - 1.0, dot(b, b) - 1.0, dot(c, c) - 1.0];
    let angles = [dot(a, b), dot(b, c), dot(c, a)];
    libm::sqrt(dot(lengths, lengths) + 2.0 * dot(angles, angles))
}
