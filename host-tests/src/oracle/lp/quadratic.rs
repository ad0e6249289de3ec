//! The exact optimum of the regularised program, `objective · x + eps·|x|²/2`.

use glam::DVec3;
use num_bigint::Sign;
use num_traits::Zero;

use super::exact::{self, Integer, Vector, integer, shifted};
use super::{Program, subsets};

/// The one optimum of `program` with `eps = 2^-exponent`, each coordinate rounded to `f64`; `None`
/// if infeasible.
///
/// For a large exponent (300, say) and inputs of few digits this is the linear program's optimum
/// nearest to the origin: below some positive `eps` the regularised optimum no longer moves.
///
/// A set of independent constraints, taken as tight, gives one point `x` with `eps·x + objective =
/// Σ λᵢ·nᵢ`. If it is feasible and no `λ` is negative then it is the optimum; some set gives it.
///
/// # Panics
/// As [`super::solve`].
#[must_use]
pub fn optimum(program: &Program, exponent: u32) -> Option<DVec3> {
    let normals: Vec<Vector> = program.constraints.iter().map(|h| shifted(h.normal)).collect();
    let offsets: Vec<Integer> = program.constraints.iter().map(|h| integer(h.offset)).collect();
    // The unconstrained optimum −objective/eps, in the same units as `normals` and `offsets`.
    let pull = shifted(-program.objective).times(&(Integer::from(1) << exponent));
    for size in 0..=3usize.min(normals.len()) {
        for set in subsets(normals.len(), size) {
            let Some((multipliers, determinant)) = multipliers(&set, &normals, &offsets, &pull)
            else {
                continue;
            };
            if multipliers.iter().any(|m| m.sign() == Sign::Minus) {
                continue;
            }
            // x = pull + Σ λ n, all times the determinant. Normals, offsets and x are all in units
            // of 2^-SHIFT.
            let point = set
                .iter()
                .zip(&multipliers)
                .fold(pull.times(&determinant), |sum, (&idx, multiplier)| {
                    sum.plus(&normals[idx].times(multiplier))
                });
            let unit = Integer::from(1) << exact::SHIFT.unsigned_abs();
            let weight = &determinant * unit;
            if normals.iter().zip(&offsets).all(|(n, d)| n.dot(&point) >= d * &weight) {
                return Some(exact::point(&point, &weight));
            }
        }
    }
    None
}

/// Multipliers times their common denominator, and that denominator, which is positive; `None` if
/// the normals of `set` are dependent. They solve `G λ = d − N·pull` with the Gram matrix `G` of
/// the normals, by Cramer's rule.
fn multipliers(
    set: &[usize],
    normals: &[Vector],
    offsets: &[Integer],
    pull: &Vector,
) -> Option<(Vec<Integer>, Integer)> {
    let unit = Integer::from(1) << exact::SHIFT.unsigned_abs();
    let size = set.len();
    let gram = |row: usize, column: usize| {
        if row < size && column < size {
            normals[set[row]].dot(&normals[set[column]])
        } else {
            Integer::from(u8::from(row == column))
        }
    };
    let column = |c: usize| Vector([gram(0, c), gram(1, c), gram(2, c)]);
    let right = |row: usize| {
        set.get(row)
            .map_or_else(Integer::zero, |&idx| &offsets[idx] * &unit - normals[idx].dot(pull))
    };
    let (a, b, c) = (column(0), column(1), column(2));
    let r = Vector([right(0), right(1), right(2)]);
    let determinant = a.dot(&b.cross(&c));
    if determinant.is_zero() {
        return None;
    }
    let all = [r.dot(&b.cross(&c)), a.dot(&r.cross(&c)), a.dot(&b.cross(&r))];
    Some((all.into_iter().take(size).collect(), determinant))
}
