//! Every tolerance of the solver, with its reason.
//!
//! Normals are unit vectors and the caller's frame has its origin in the star and the star's radius
//! as unit, so a plain number is a fraction of the star. Where a point far out is tested, the
//! tolerance grows with [`scale`], as its rounding error does.

use glam::DVec3;

/// A point may lie this far outside a half-space before that counts as a violation.
///
/// The points computed here are within about 1e-15 of the planes that define them, and
/// single-precision storage later costs 6e-8. Much smaller: duplicates of a tight plane that differ
/// by rounding are inserted and meet it in a line that is noise. Larger: the vertex may cut its
/// planes by that much.
pub(super) const VIOLATION: f64 = 1e-12;

/// Half-spaces that contradict each other by no more than this are taken to touch: the vertex then
/// violates both by at most this.
///
/// Slabs without width, and planes through one point whose offsets are rounded, may exclude each
/// other by some 1e-16 over the sine of an angle. Smaller: such stars are `Infeasible`. Larger:
/// vertices that cut planes; beyond 6e-8 the caller's exact check would reject what is accepted
/// here.
pub(super) const CONTRADICTION: f64 = 1e-10;

/// Below this sine two planes, or a plane and a line, are parallel.
///
/// Must stay below [`VIOLATION`]: then parallel planes that agree at one point agree at every point
/// to within what counts as no violation, so that nothing is lost by ignoring their line of
/// intersection, which is at least a radius of `VIOLATION / PARALLEL` away. Must stay well above
/// 2e-16, the rounding of a unit normal, for the sine of anything smaller is noise.
pub(super) const PARALLEL: f64 = 1e-13;

/// Steepest descent towards infinity, as a fraction of the length of the objective, that may go
/// unnoticed.
///
/// If the program descends along a ray with slope `s`, the regularised optimum is at least
/// `s·|c|/eps` away. A nearer optimum therefore needs no further test; a farther one costs a second
/// program. Smaller: that test is run for ordinary vertices (when `eps·|x| > DESCENT·|c|`). Larger:
/// flatter descents to infinity are answered by a point.
pub(super) const DESCENT: f64 = 1e-5;

/// The factor by which rounding at `point` exceeds rounding in the star.
#[inline(always)]
pub(super) fn scale(point: DVec3) -> f64 {
    1.0 + point.x.abs() + point.y.abs() + point.z.abs()
}
