//! Linear programs in one, two and three variables, for the vertex that replaces a collapsed edge.
//!
//! Minimise `c·x` subject to `nᵢ·x ≥ dᵢ`: Seidel's incremental algorithm. Constraints are inserted
//! one by one. If the optimum so far violates the next, the new optimum lies on its plane, which
//! leaves a program with one variable less:
//!
//! ```text
//! minimise ─ insertion ─ plane ─ insertion ─ line ─ interval
//! ```
//!
//! # The second term
//! Where a star is flat the optimum is a whole face. A vanishing second term chooses from it: the
//! objective is `c·x + eps·|x|²/2`, and its optimum is unique, namely the projection of the *pull*
//! `−c/eps` onto the polyhedron. On a plane or a line it is the point nearest to the pull, too, so
//! that the same scheme serves. Below some positive `eps`, which depends on the constraints, the
//! answer is the linear optimum nearest to the origin and no longer moves.
//!
//! The pull lies as far out as `1/eps`, and digits that pass through it are lost. So it only gives
//! directions: a point on a plane is the plane's foot plus the pull's component along the plane; a
//! point on a line is the foot of the line, from the two planes alone, plus a parameter; a vertex
//! is where that parameter is cut off. A returned vertex is within about 1e-15 of its planes for
//! every `eps`.
//!
//! # Infinity
//! The regularised program has an optimum whenever it is feasible, also where the linear one
//! descends for ever. If the objective falls along a unit ray with slope `s`, then the regularised
//! optimum `x` has `eps·|x| ≥ s`: multiply its Karush–Kuhn–Tucker condition `c + eps·x = Σ λᵢnᵢ` by
//! the ray. So a near optimum proves that no steep ray exists; only for a far one a second program,
//! the projection of `−c` onto the cone `nᵢ·x ≥ 0` of all rays, decides. The result is the steepest
//! ray, and zero if there is none.
//!
//! # Decisions
//! *Two orders, one loop.* In Seidel's random order ([`Order::Shuffled`]) a violated constraint
//! meets all before it, and the expected work is linear, whatever the program. The default
//! ([`Order::MostViolated`]) inserts a violated constraint that is chosen by a rule. It meets only
//! those that were inserted: four or five for a star. The rule uses no chance, and it avoids lines
//! where nearly coplanar planes meet. The price is that no bound on the expected time holds; the
//! worst case is cubic in the number of constraints.
//!
//! | ns per solve, 10 planes, `eps` = 1e-6 | noisy | smooth | flat | aligned | crease | ridge | corner | mean |
//! | --- | --- | --- | --- | --- | --- | --- | --- | --- |
//! | shuffled | 634 | 700 | 380 | 94 | 582 | 562 | 530 | 497 |
//! | most violated, far points pulled back to the star | 433 | 478 | 245 | 80 | 394 | 436 | 581 | 378 |
//!
//! `cargo bench -p meshsweep-lab --bench lp` prints both rows. Far points that are not pulled back
//! took 447 ns instead of 319 (historical: no command prints that).
//!
//! *No symbolic `eps`.* With an infinitesimal one, a flat star whose planes differ by rounding
//! would send the vertex to the far end of the star, for the objective does fall in that direction.
//! A finite `eps` weighs the slope against the distance.
//!
//! Source: R. Seidel, *Small-dimensional linear programming and convex hulls made easy*, Discrete &
//! Computational Geometry 6 (1991), §2.

mod half_space;
mod insertion;
mod interval;
mod line;
mod order;
mod plane;
mod tolerance;

use glam::DVec3;
pub use half_space::HalfSpace;
use insertion::insert;
use order::Run;
pub use order::{Order, UnknownOrder, Work};
use tolerance::DESCENT;

/// What a program came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outcome {
    /// The regularised optimum. It violates no constraint by more than 1e-12, times `1 + |x|₁`;
    /// where constraints contradict each other by less than 1e-10 it may violate those by as
    /// much.
    Optimal(DVec3),
    /// No point satisfies all constraints, or every such point is more than 1e9 away; or the input
    /// was not finite.
    Infeasible,
    /// The linear objective falls for ever along a ray, by more than 1e-5 of its own length per
    /// unit.
    Unbounded,
}

/// Minimises `objective · x + eps·|x|²/2` over the intersection of `constraints`, which may be
/// empty.
///
/// The frame has its origin at the star's middle and the star's radius as unit: the second term
/// pulls towards the origin, and tolerances are fractions of the radius. If `x*` is any optimum of
/// the linear program then the answer exceeds its value by at most `eps·|x*|²/2`; where several are
/// optimal, the answer tends to the one nearest to the origin.
///
/// Choose `eps` between 1e-3 and 1e-9 times the objective's length, best 1e-6. It is the slope
/// below which the star counts as flat: a face that is level to within `eps` yields the point
/// nearest to the origin. Above 1e-5 most vertices need the test for a ray, which doubles the time;
/// below 1e-9 the rounding of `objective / eps` (1e-16 of it) moves the answer on flat stars by
/// more than 1e-7.
///
/// Deterministic: the same input and the same `order` give the same bits. `constraints` are
/// permuted.
///
/// A half-space without normal and with a positive offset makes the program infeasible. Parallel,
/// equal and redundant half-spaces are no special case. If `eps` is not positive or any number is
/// not finite: [`Outcome::Infeasible`].
///
/// About 300 ns for a star of 10 planes; no allocation. For the growth with the number of
/// constraints see [`Order`].
#[must_use]
pub fn minimise(
    objective: DVec3,
    constraints: &mut [HalfSpace],
    eps: f64,
    order: Order,
) -> Outcome {
    if !(are_finite(constraints) && objective.is_finite()) {
        return Outcome::Infeasible;
    }
    let mut run = Run::start(order, constraints);
    let optimum = optimum::<false>(&mut run, -objective / eps, constraints);
    outcome(objective, eps, optimum, |pull| optimum_of_cone(&mut run, pull, constraints))
}

/// [`minimise`] for a program that the caller knows to be bounded, without the test for a ray: half
/// the time where `eps` is large.
///
/// A star's program is: its objective is the sum of its own constraints' normals, so it cannot fall
/// below the sum of their offsets. `None` where [`minimise`] says [`Outcome::Infeasible`].
#[must_use]
#[inline]
pub fn minimise_bounded(
    objective: DVec3,
    constraints: &mut [HalfSpace],
    eps: f64,
    order: Order,
) -> Option<DVec3> {
    minimise_counted(objective, constraints, eps, order).0
}

/// [`minimise_bounded`], and what it cost.
#[must_use]
#[inline]
pub fn minimise_counted(
    objective: DVec3,
    constraints: &mut [HalfSpace],
    eps: f64,
    order: Order,
) -> (Option<DVec3>, Work) {
    if !(eps > 0.0 && are_finite(constraints) && objective.is_finite()) {
        return (None, Work::default());
    }
    let mut run = Run::start(order, constraints);
    let optimum = optimum::<false>(&mut run, -objective / eps, constraints);
    (optimum, Work { tests: run.tests })
}

fn optimum_of_cone(run: &mut Run, pull: DVec3, constraints: &mut [HalfSpace]) -> Option<DVec3> {
    optimum::<true>(run, pull, constraints)
}

/// The point nearest to `pull` that satisfies `constraints`.
#[inline(always)]
fn optimum<const CONE: bool>(
    run: &mut Run,
    pull: DVec3,
    constraints: &mut [HalfSpace],
) -> Option<DVec3> {
    insert::<CONE>(run, pull, constraints, |run, h, _, inserted| {
        plane::nearest::<CONE>(run, h, pull, inserted)
    })
}

/// The outcome of a program with the given regularised optimum. `on_rays` projects onto its cone of
/// rays to infinity.
#[inline(always)]
fn outcome(
    objective: DVec3,
    eps: f64,
    optimum: Option<DVec3>,
    on_rays: impl FnOnce(DVec3) -> Option<DVec3>,
) -> Outcome {
    let Some(optimum) = optimum.filter(|point| eps > 0.0 && point.is_finite()) else {
        return Outcome::Infeasible;
    };
    let length_sq = objective.length_squared();
    let proven =
        eps * eps * optimum.length_squared() <= DESCENT * DESCENT * length_sq || length_sq == 0.0;
    let steepest = |ray: DVec3| ray.length_squared() > DESCENT * DESCENT;
    if !proven && on_rays(-objective / length_sq.sqrt()).is_some_and(steepest) {
        return Outcome::Unbounded;
    }
    Outcome::Optimal(optimum)
}

/// One sum and one test: a sum with a NaN or an infinity in it is never finite.
fn are_finite(constraints: &[HalfSpace]) -> bool {
    let sum = |h: &HalfSpace| (h.normal.x + h.normal.y) + (h.normal.z + h.offset);
    constraints.iter().map(sum).sum::<f64>().is_finite()
}
