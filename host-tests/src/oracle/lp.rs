//! Exact answers to linear and quadratic programs in three variables, by trying every set of tight
//! constraints.
//!
//! All inputs are `f64` and thus rational; all arithmetic is on big integers. Every binary number
//! is multiplied by `2^SHIFT` first, and points are kept in homogeneous coordinates, so that
//! nothing is ever reduced.
//!
//! Sources: the fundamental theorem of linear programming (Schrijver, *Theory of Linear and Integer
//! Programming*, 1986, §8.3: a polyhedron has points if and only if one of its minimal faces does),
//! Farkas' lemma with Carathéodory's theorem (§7.1 and §7.7: the objective is bounded below if and
//! only if it is a non-negative combination of at most three independent normals), and the
//! Karush–Kuhn–Tucker conditions.

pub mod exact;
pub mod programs;
pub mod quadratic;
pub mod random;
pub mod stars;

use std::cmp::Ordering;

use exact::{Integer, Vector, shifted};
use glam::DVec3;
use meshsweep::lp::HalfSpace;
use num_bigint::Sign;
use num_traits::Zero;

/// A program: minimise `objective · x` over `constraints`.
#[derive(Clone, Debug)]
pub struct Program {
    /// What to minimise.
    pub objective: DVec3,
    /// Subject to these.
    pub constraints: Vec<HalfSpace>,
}

impl Program {
    /// The same program with its digits below `2^-SHIFT` rounded away, so that the oracle can read
    /// it.
    #[must_use]
    pub fn representable(mut self) -> Self {
        self.objective = exact::representable(self.objective);
        for h in &mut self.constraints {
            h.normal = exact::representable(h.normal);
            h.offset = exact::representable(DVec3::splat(h.offset)).x;
        }
        self
    }
}

/// What a linear program comes to, without rounding or regularisation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    /// No point satisfies all constraints.
    Infeasible,
    /// There are such points, and the objective has no lower bound on them.
    Unbounded,
    /// The least value of the objective, and a sum of multipliers that prove it: if every offset
    /// fell by `δ`, the value would fall by at most `δ` times that.
    Optimal {
        /// The least value, rounded to the nearest `f64` or its neighbour.
        value: f64,
        /// Sum of the multipliers of one optimal basis.
        multipliers: f64,
        /// Distance from the origin of the nearest computed point that has this value.
        distance: f64,
    },
}

/// A constraint `normal · x >= offset` with whole numbers.
#[derive(Clone, Debug)]
struct Constraint {
    normal: Vector,
    offset: Integer,
}

/// The exact solution of `program`.
///
/// Cost: about `m⁴/20` big-integer products for `m` constraints.
///
/// # Panics
/// If an input is not finite or has digits below `2^-SHIFT`.
#[must_use]
pub fn solve(program: &Program) -> Verdict {
    let constraints = constraints(&program.constraints, 0.0);
    let Some(faces) = minimal_faces(&constraints) else { return Verdict::Infeasible };
    let objective = shifted(program.objective);
    let Some(multipliers) = dual(&objective, &constraints) else { return Verdict::Unbounded };
    // Points carry a positive weight, so fractions compare by cross products.
    let values: Vec<Integer> = faces.iter().map(|(point, _)| objective.dot(point)).collect();
    let less = |a: usize, b: usize| (&values[a] * &faces[b].1).cmp(&(&values[b] * &faces[a].1));
    let best = (0..faces.len())
        .min_by(|&a, &b| less(a, b))
        .expect("a polyhedron with points has a minimal face");
    let optimal = (0..faces.len()).filter(|&idx| less(idx, best) == Ordering::Equal);
    let distance = optimal
        .map(|idx| exact::point(&faces[idx].0, &faces[idx].1).length())
        .fold(f64::INFINITY, f64::min);
    let value = exact::ratio(&values[best], &faces[best].1) / exact::unit();
    Verdict::Optimal { value, multipliers, distance }
}

/// Whether some point satisfies all `constraints`, exactly, after every offset has grown by
/// `tightening`. Those without a normal stay as they are.
///
/// # Panics
/// As [`solve`].
#[must_use]
pub fn is_feasible(half_spaces: &[HalfSpace], tightening: f64) -> bool {
    minimal_faces(&constraints(half_spaces, tightening)).is_some()
}

fn constraints(half_spaces: &[HalfSpace], tightening: f64) -> Vec<Constraint> {
    let tighten = exact::integer(tightening);
    let exact = |h: &HalfSpace| {
        let (normal, offset) = (shifted(h.normal), exact::integer(h.offset));
        let offset = if normal.is_zero() { offset } else { offset + &tighten };
        Constraint { normal, offset }
    };
    half_spaces.iter().map(exact).collect()
}

/// One point, with its positive weight, of every minimal face of the polyhedron; `None` if the
/// polyhedron is empty.
///
/// A minimal face is an affine space on which as many independent constraints are tight as there
/// are independent normals. It satisfies a constraint everywhere or nowhere, for no normal has a
/// component along it.
fn minimal_faces(constraints: &[Constraint]) -> Option<Vec<(Vector, Integer)>> {
    let rank = rank(constraints);
    let mut faces = Vec::new();
    for tight in subsets(constraints.len(), rank) {
        let tight: Vec<&Constraint> = tight.iter().map(|&idx| &constraints[idx]).collect();
        let Some((point, weight)) = meet(&tight) else { continue };
        if constraints.iter().all(|c| c.normal.dot(&point) >= &c.offset * &weight) {
            faces.push((point, weight));
        }
    }
    (!faces.is_empty()).then_some(faces)
}

fn rank(constraints: &[Constraint]) -> usize {
    let independent = |&size: &usize| {
        subsets(constraints.len(), size).iter().any(|set| {
            let tight: Vec<&Constraint> = set.iter().map(|&idx| &constraints[idx]).collect();
            meet(&tight).is_some()
        })
    };
    (1..=3).rev().find(independent).unwrap_or(0)
}

/// The point nearest to the origin where all planes of `tight` meet, with a positive weight; `None`
/// if the normals are dependent.
fn meet(tight: &[&Constraint]) -> Option<(Vector, Integer)> {
    let (point, weight) = match tight {
        [] => (Vector::zero(), Integer::from(1)),
        [a] => (a.normal.times(&a.offset), a.normal.dot(&a.normal)),
        [a, b] => {
            let along = a.normal.cross(&b.normal);
            let point = b
                .normal
                .cross(&along)
                .times(&a.offset)
                .plus(&along.cross(&a.normal).times(&b.offset));
            (point, along.dot(&along))
        }
        [a, b, c] => {
            let point = b.normal.cross(&c.normal).times(&a.offset);
            let point = point.plus(&c.normal.cross(&a.normal).times(&b.offset));
            let point = point.plus(&a.normal.cross(&b.normal).times(&c.offset));
            (point, a.normal.dot(&b.normal.cross(&c.normal)))
        }
        _ => return None,
    };
    match weight.sign() {
        Sign::NoSign => None,
        Sign::Plus => Some((point, weight)),
        Sign::Minus => Some((point.times(&Integer::from(-1)), -weight)),
    }
}

/// The least sum of multipliers with which `objective` is a non-negative combination of independent
/// normals, or `None` if it is none.
fn dual(objective: &Vector, constraints: &[Constraint]) -> Option<f64> {
    (0..=3usize.min(constraints.len()))
        .flat_map(|size| subsets(constraints.len(), size))
        .filter_map(|set| {
            let normals: Vec<&Vector> = set.iter().map(|&idx| &constraints[idx].normal).collect();
            combination(objective, &normals)
        })
        .min_by(f64::total_cmp)
}

/// The sum of the multipliers with which `objective` is a non-negative combination of `normals`.
fn combination(objective: &Vector, normals: &[&Vector]) -> Option<f64> {
    let (numerators, denominator) = match normals {
        [] => return objective.is_zero().then_some(0.0),
        [a] => {
            if !objective.cross(a).is_zero() {
                return None;
            }
            (vec![objective.dot(a)], a.dot(a))
        }
        [a, b] => {
            let along = a.cross(b);
            if !objective.dot(&along).is_zero() {
                return None;
            }
            (
                vec![objective.cross(b).dot(&along), a.cross(objective).dot(&along)],
                along.dot(&along),
            )
        }
        [a, b, c] => (
            vec![
                objective.dot(&b.cross(c)),
                objective.dot(&c.cross(a)),
                objective.dot(&a.cross(b)),
            ],
            a.dot(&b.cross(c)),
        ),
        _ => return None,
    };
    if denominator.is_zero() || numerators.iter().any(|n| n.sign() == -denominator.sign()) {
        return None;
    }
    let sum: Integer = numerators.iter().sum();
    Some(exact::ratio(&sum, &denominator))
}

/// All sets of `size` indices below `count`, each ascending.
#[must_use]
pub fn subsets(count: usize, size: usize) -> Vec<Vec<usize>> {
    match size {
        0 => vec![Vec::new()],
        1 => (0..count).map(|a| vec![a]).collect(),
        2 => (0..count).flat_map(|b| (0..b).map(move |a| vec![a, b])).collect(),
        _ => (0..count)
            .flat_map(|c| (0..c).flat_map(move |b| (0..b).map(move |a| vec![a, b, c])))
            .collect(),
    }
}
